# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shows a mesh as a ghost and chosen shapes of it in colours of their own."""

import numpy as np
from pivy import coin

from . import colours
from .label import LabelNode
from .nodes import FaceNode, LineNode, PointNode

NAME = "FemScalpelInspector"


class GroupScene:
    """The nodes under one separator called "FemScalpelInspector": FemScalpelGhost, and one FemScalpelShape for each shape."""

    def __init__(self, view):
        self._view = view
        self.root = coin.SoSeparator()
        self.root.setName(NAME)
        pick = coin.SoPickStyle()
        pick.style = coin.SoPickStyle.UNPICKABLE
        self.root.addChild(pick)
        blend = coin.SoTransparencyType()
        blend.value = coin.SoTransparencyType.DELAYED_BLEND
        self.root.addChild(blend)
        for light in lights():
            self.root.addChild(light)
        self._shapes = coin.SoSeparator()
        self.root.addChild(self._shapes)
        self.ghost = FaceNode("FemScalpelGhost", colours.NEUTRAL, transparency=0.75)
        self.root.addChild(self.ghost.root)
        self.label = LabelNode("FemScalpelLabel")
        self.root.addChild(self.label.root)
        view.getSceneGraph().addChild(self.root)

    def close(self):
        """Takes everything out of the view."""
        try:
            graph = self._view.getSceneGraph()
        except (RuntimeError, AttributeError):
            return
        if graph.findChild(self.root) >= 0:
            graph.removeChild(self.root)

    def show(self, shapes):
        """Shows (GroupShape, colour) pairs, the first at the bottom, and no others. A colour is one, or one per face."""
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


def lights():
    """Lights beside FreeCAD's own, which leaves faces seen at an angle too dark to tell colours apart."""
    for direction, intensity in (((0.6, 1.0, -0.8), 0.45), ((-1.0, -0.3, -0.3), 0.45), ((0.2, -0.4, 1.0), 0.3)):
        light = coin.SoDirectionalLight()
        light.direction.setValue(*direction)
        light.intensity = intensity
        yield light


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
