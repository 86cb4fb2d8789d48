# SPDX-License-Identifier: LGPL-2.1-or-later
"""Coin nodes filled from NumPy arrays. A node is made once and refilled, so that an update allocates little."""

import numpy as np
from pivy import coin

from . import faces as mesh_faces
from .colours import packed


def set_values(field, values):
    """Gives a multi-value field these values and no others."""
    field.setNum(len(values))
    if len(values):
        field.setValues(0, len(values), values)


def material(rgb, transparency=0.0, lit=True):
    """An SoMaterial; unlit things shine by themselves, so that lines keep their colour."""
    node = coin.SoMaterial()
    node.diffuseColor.setValue(*rgb)
    node.ambientColor.setValue(*[0.4 * c for c in rgb])
    node.transparency.setValue(transparency)
    if not lit:
        node.emissiveColor.setValue(*rgb)
    return node


def style(line_width=1.0, point_size=1.0):
    """An SoDrawStyle."""
    node = coin.SoDrawStyle()
    node.lineWidth.setValue(line_width)
    node.pointSize.setValue(point_size)
    return node


def two_sided():
    """Shape hints for faces of any orientation, lit on both sides and flat."""
    hints = coin.SoShapeHints()
    hints.vertexOrdering = coin.SoShapeHints.COUNTERCLOCKWISE
    hints.shapeType = coin.SoShapeHints.UNKNOWN_SHAPE_TYPE
    hints.faceType = coin.SoShapeHints.CONVEX
    hints.creaseAngle = 0.0
    return hints


class FaceNode:
    """Faces in one colour or in one colour each, with their edges if wanted; `in_front` of faces at the same place."""

    def __init__(self, name, rgb, transparency=0.0, edges=None, in_front=False):
        self.root = coin.SoSeparator()
        self.root.setName(name)
        self._switch = coin.SoSwitch()
        self._switch.whichChild = -1
        inside = coin.SoSeparator()
        self._coordinates = coin.SoCoordinate3()
        inside.addChild(self._coordinates)
        if edges is not None:
            wires = coin.SoSeparator()
            light = coin.SoLightModel()
            light.model = coin.SoLightModel.BASE_COLOR
            wires.addChild(light)
            wires.addChild(material(edges))
            wires.addChild(style(1.0))
            self._lines = coin.SoIndexedLineSet()
            wires.addChild(self._lines)
            inside.addChild(wires)
        else:
            self._lines = None
        offset = coin.SoPolygonOffset()
        offset.factor = 0.5 if in_front else 1.0
        offset.units = 0.5 if in_front else 1.0
        inside.addChild(offset)
        inside.addChild(two_sided())
        self._alpha = 1 - transparency
        self._material = material(rgb, transparency)
        inside.addChild(self._material)
        self._colours = coin.SoPackedColor()
        self._binding = coin.SoMaterialBinding()
        self._binding.value = coin.SoMaterialBinding.OVERALL
        self._packed = coin.SoSwitch()
        self._packed.addChild(self._colours)
        self._packed.whichChild = -1
        inside.addChild(self._packed)
        inside.addChild(self._binding)
        self._faces = coin.SoIndexedFaceSet()
        inside.addChild(self._faces)
        self._switch.addChild(inside)
        self.root.addChild(self._switch)
        self._order = np.empty(0, np.int64)

    @property
    def count(self):
        """Number of faces shown."""
        return len(self._order) if self._switch.whichChild.getValue() == 0 else 0

    def show(self, points, faces, rgb=None):
        """Shows faces; `rgb` (n, 3) has a colour for each, None is the node's own colour."""
        if not len(faces):
            self.hide()
            return
        index, self._order = mesh_faces.coin_index(faces)
        set_values(self._coordinates.point, np.ascontiguousarray(points, np.float32))
        set_values(self._faces.coordIndex, index)
        if self._lines is not None:
            edges, _ = mesh_faces.face_edges(faces)
            edges = mesh_faces.unique_edges(edges, len(points))
            set_values(self._lines.coordIndex, np.column_stack([edges, np.full(len(edges), -1)]).astype(np.int32).ravel())
        self.colour(rgb)
        self._switch.whichChild = 0

    def colour(self, rgb):
        """Colours the faces shown anew."""
        if rgb is None:
            self._packed.whichChild = -1
            self._binding.value = coin.SoMaterialBinding.OVERALL
            return
        set_values(self._colours.orderedRGBA, packed(rgb[self._order], self._alpha).tolist())
        self._packed.whichChild = 0
        self._binding.value = coin.SoMaterialBinding.PER_FACE

    def hide(self):
        """Shows nothing."""
        self._switch.whichChild = -1


class LineNode:
    """Lines in one colour."""

    def __init__(self, name, rgb, width):
        self.root = coin.SoSeparator()
        self.root.setName(name)
        self._switch = coin.SoSwitch()
        self._switch.whichChild = -1
        inside = coin.SoSeparator()
        light = coin.SoLightModel()
        light.model = coin.SoLightModel.BASE_COLOR
        inside.addChild(light)
        inside.addChild(material(rgb))
        inside.addChild(style(width))
        self._coordinates = coin.SoCoordinate3()
        inside.addChild(self._coordinates)
        self._lines = coin.SoLineSet()
        inside.addChild(self._lines)
        self._switch.addChild(inside)
        self.root.addChild(self._switch)
        self.count = 0

    def show(self, lines):
        """Shows lines (n, 2, 3)."""
        self.count = len(lines)
        self._switch.whichChild = 0 if self.count else -1
        if self.count:
            set_values(self._coordinates.point, np.ascontiguousarray(lines.reshape(-1, 3), np.float32))
            set_values(self._lines.numVertices, np.full(self.count, 2, np.int32))

    def hide(self):
        """Shows nothing."""
        self.show(np.empty((0, 2, 3), np.float32))


class PointNode:
    """Points in one colour."""

    def __init__(self, name, rgb, size):
        self.root = coin.SoSeparator()
        self.root.setName(name)
        self._switch = coin.SoSwitch()
        self._switch.whichChild = -1
        inside = coin.SoSeparator()
        light = coin.SoLightModel()
        light.model = coin.SoLightModel.BASE_COLOR
        inside.addChild(light)
        inside.addChild(material(rgb))
        inside.addChild(style(point_size=size))
        self._coordinates = coin.SoCoordinate3()
        inside.addChild(self._coordinates)
        self._points = coin.SoPointSet()
        inside.addChild(self._points)
        self._switch.addChild(inside)
        self.root.addChild(self._switch)
        self.count = 0

    def show(self, points):
        """Shows points (n, 3)."""
        self.count = len(points)
        self._switch.whichChild = 0 if self.count else -1
        if self.count:
            set_values(self._coordinates.point, np.ascontiguousarray(points, np.float32))
            self._points.numPoints = self.count

    def hide(self):
        """Shows nothing."""
        self.show(np.empty((0, 3), np.float32))


class LabelNode:
    """A text at a point, always in front."""

    def __init__(self, name, rgb):
        self.root = coin.SoAnnotation()
        self.root.setName(name)
        self._switch = coin.SoSwitch()
        self._switch.whichChild = -1
        inside = coin.SoSeparator()
        light = coin.SoLightModel()
        light.model = coin.SoLightModel.BASE_COLOR
        inside.addChild(light)
        inside.addChild(material(rgb))
        font = coin.SoFont()
        font.size = 20
        inside.addChild(font)
        self._place = coin.SoTranslation()
        inside.addChild(self._place)
        self._text = coin.SoText2()
        inside.addChild(self._text)
        self._switch.addChild(inside)
        self.root.addChild(self._switch)

    @property
    def text(self):
        """What is shown, "" when nothing is."""
        return self._text.string[0] if self._switch.whichChild.getValue() == 0 else ""

    def show(self, point, text):
        """Shows `text` at `point`."""
        self._place.translation.setValue(*[float(x) for x in point])
        self._text.string.setValue(text)
        self._switch.whichChild = 0

    def hide(self):
        """Shows nothing."""
        self._switch.whichChild = -1
