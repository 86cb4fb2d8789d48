# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shows a mesh as a ghost and chosen shapes of it in colours of their own."""

import numpy as np
from pivy import coin

from . import colours
from .label import LabelNode
from .nodes import FaceNode, LineNode, PointNode
from .overlay import Picture

NAME = "FemScalpelInspector"


class GroupScene(Picture):
    """The nodes under one separator called "FemScalpelInspector": FemScalpelGhost, FemScalpelBeams, and one
    FemScalpelShape for each shape."""

    def __init__(self, view):
        super().__init__(view, NAME)
        self._shapes = coin.SoSeparator()
        self.root.addChild(self._shapes)
        self.ghost = FaceNode("FemScalpelGhost", colours.NEUTRAL, transparency=0.75)
        self.beams = LineNode("FemScalpelBeams", colours.BEAM, 4.0)
        for part in (self.ghost, self.beams):
            self.root.addChild(part.root)
        self.label = LabelNode("FemScalpelLabel")
        self.root.addChild(self.label.root)
        self.open()

    def show(self, shapes):
        """Shows (GroupShape, colour) pairs, the first at the bottom, and no others. A colour is one, or one per
        face."""
        self._shapes.removeAllChildren()
        for shape, rgb in shapes:
            single = rgb if np.ndim(rgb) == 1 else colours.NEUTRAL
            holder = coin.SoSeparator()
            holder.setName("FemScalpelShape")
            faces = FaceNode("FemScalpelShapeFaces", single, edges=tuple(0.4 * c for c in single))
            faces.show(shape.points, shape.faces, rgb if np.ndim(rgb) == 2 else None)
            lines = LineNode("FemScalpelShapeLines", single, 5.0)
            lines.show(shape.lines)
            points = PointNode("FemScalpelShapePoints", single, 8.0)
            points.show(shape.nodes)
            for part in (faces, lines, points):
                holder.addChild(part.root)
            self._shapes.addChild(holder)


def zoom_to(view, low, high):
    """Turns the camera's attention to a box without turning it."""
    camera = view.getCameraNode()
    box = coin.SbBox3f(*[float(x) for x in low], *[float(x) for x in high])
    camera.viewAll(_box_node(box), coin.SbViewportRegion(*view.getSize()))


def _box_node(box):
    corners = coin.SoSeparator()
    place = coin.SoTranslation()
    place.translation.setValue(box.getCenter())
    corners.addChild(place)
    cube = coin.SoCube()
    cube.width, cube.height, cube.depth = (max(x, 1e-9) for x in box.getSize())
    corners.addChild(cube)
    return corners
