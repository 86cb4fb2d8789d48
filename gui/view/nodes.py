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


def material(rgb, transparency=0.0):
    """An SoMaterial."""
    node = coin.SoMaterial()
    node.diffuseColor.setValue(*rgb)
    node.ambientColor.setValue(*[0.4 * c for c in rgb])
    node.transparency.setValue(transparency)
    return node


def paint(parent, rgb, style_node):
    """Gives what follows in `parent` one colour, whatever the light."""
    light = coin.SoLightModel()
    light.model = coin.SoLightModel.BASE_COLOR
    for node in (light, material(rgb), style_node):
        parent.addChild(node)


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


class Part:
    """A named node of the scene whose content can be hidden; hidden at first."""

    def __init__(self, name, root=None):
        self.root = coin.SoSeparator() if root is None else root
        self.root.setName(name)
        self._switch = coin.SoSwitch()
        self._switch.whichChild = -1
        self._inside = coin.SoSeparator()
        self._switch.addChild(self._inside)
        self.root.addChild(self._switch)

    @property
    def is_shown(self):
        """Whether the content is drawn."""
        return self._switch.whichChild.getValue() == 0

    def reveal(self):
        """Shows the content."""
        self._switch.whichChild = 0

    def hide(self):
        """Shows nothing."""
        self._switch.whichChild = -1


class FaceNode(Part):
    """Faces in one colour or in one colour each, with their edges if wanted; `in_front` of faces at the same place."""

    def __init__(self, name, rgb, transparency=0.0, edges=None, in_front=False):
        super().__init__(name)
        inside = self._inside
        self._coordinates = coin.SoCoordinate3()
        inside.addChild(self._coordinates)
        if edges is not None:
            wires = coin.SoSeparator()
            paint(wires, edges, style(1.0))
            self._lines = coin.SoIndexedLineSet()
            wires.addChild(self._lines)
            inside.addChild(wires)
        else:
            self._lines = None
        if transparency:
            # With nothing opaque in the view Coin would not blend: the first corner as a point of one pixel.
            speck = coin.SoSeparator()
            paint(speck, rgb, style())
            point = coin.SoIndexedPointSet()
            point.coordIndex.setValue(0)
            speck.addChild(point)
            inside.addChild(speck)
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
        self._order = np.empty(0, np.int64)

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
            set_values(
                self._lines.coordIndex, np.column_stack([edges, np.full(len(edges), -1)]).astype(np.int32).ravel()
            )
        self.colour(rgb)
        self.reveal()

    def colour(self, rgb):
        """Colours the faces shown anew."""
        if rgb is None:
            self._packed.whichChild = -1
            self._binding.value = coin.SoMaterialBinding.OVERALL
            return
        set_values(self._colours.orderedRGBA, packed(rgb[self._order], self._alpha).tolist())
        self._packed.whichChild = 0
        self._binding.value = coin.SoMaterialBinding.PER_FACE


class _UnlitNode(Part):
    """Lines or points in one colour."""

    def __init__(self, name, rgb, style_node, shape):
        super().__init__(name)
        self._style = style_node
        paint(self._inside, rgb, style_node)
        self._coordinates = coin.SoCoordinate3()
        self._inside.addChild(self._coordinates)
        self._shape = shape
        self._inside.addChild(shape)

    def show(self, points):
        """Shows lines (n, 2, 3) or points (n, 3)."""
        self._set_number(len(points))
        if not len(points):
            self.hide()
            return
        set_values(self._coordinates.point, np.ascontiguousarray(points.reshape(-1, 3), np.float32))
        self.reveal()

    def _set_number(self, number):
        raise NotImplementedError


class LineNode(_UnlitNode):
    """Lines of two points in one colour."""

    def __init__(self, name, rgb, width):
        super().__init__(name, rgb, style(width), coin.SoLineSet())

    def dash(self):
        """Draws dashed lines from now on."""
        self._style.linePattern = 0x0F0F

    def _set_number(self, number):
        set_values(self._shape.numVertices, np.full(number, 2, np.int32))


class PointNode(_UnlitNode):
    """Points in one colour."""

    def __init__(self, name, rgb, size):
        super().__init__(name, rgb, style(point_size=size), coin.SoPointSet())

    def _set_number(self, number):
        self._shape.numPoints = number
