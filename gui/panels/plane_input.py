# SPDX-License-Identifier: LGPL-2.1-or-later
"""Input of a plane."""

import FreeCAD

from ..translate import translate
from ..view import picking
from ..view.plane_handles import PlaneHandles
from . import fields
from .geometry_input import GeometryInput


class PlaneInput(GeometryInput):
    """A plane by point, normal and offset; by three nodes, a face, an edge, a datum, a sketch or the view."""

    UI = "plane_input.ui"
    NODES = 3

    def __init__(self, source_object):
        self._offset = self._part_radius = None
        self._part_movable, self._part_turn, self._outline = False, None, None
        self._slot_width = None
        super().__init__(source_object)
        self._offset = fields.Number(self.form.offset, self._offset_typed, step=fields.round_step(self.size / 100))
        self.form.flip.clicked.connect(self._flip)

    def origin(self):
        direction = self.direction()
        if not direction.Length > 0 or self._offset is None or self.is_fixed():
            return self.base()
        return self.base() + direction.normalize() * self._offset.value

    def _offset_typed(self):
        if self._offset.has_expression:  # else it is one from what is followed
            self.followed.end_by_hand()
        self._tell()

    def is_expressed(self):
        return super().is_expressed() or (self._offset is not None and self._offset.has_expression)

    def read_expressed(self, obj):
        super().read_expressed(obj)
        self._offset.set(obj.Offset.Value)

    def expressed(self, turn):
        return {**super().expressed(turn), "Offset": repr(self._offset.value)}

    def set_pose(self, origin, direction, radius=None, from_handle=False, follows=False):
        if not follows and self._is_elsewhere(origin, direction):
            self.followed.end_by_hand()
        if self._offset is not None:
            self._offset.set(0)
            if self._offset.has_expression and direction.Length > 0 and not self.is_fixed():
                origin = origin - FreeCAD.Vector(direction).normalize() * self._offset.value
        super().set_pose(origin, direction, radius, from_handle, follows=True)

    def _flip(self):
        self.set_pose(self.origin(), self.direction().negative(), follows=True)

    def show_part(self, movable, radius, turn, outline=None, width=None):
        """Says what handles a part of the plane has: `movable` ones; on its border, with the field of its `radius`, if
        any. `turn` says by how many degrees it is turned about the normal, None where that does not matter; outline()
        are its corners (x, y) then, None those of the whole plane. `width` is the field of a slot's."""
        self._part_movable, self._part_radius, self._part_turn = movable, radius, turn
        self._outline, self._slot_width = outline, width
        if self.handles is not None:
            self._turn_handles(self.handles)
            self.handles.set_pose(self.origin(), self.rotation(), self.radius())

    def _turn_handles(self, handles):
        handles.show_part(self._part_movable, self._part_turn.value if self._part_turn is not None else None)
        self._draw_outline(handles)

    def _draw_outline(self, handles):
        width = self._slot_width.value if self._slot_width is not None else 0.0
        handles.show_outline(self._outline() if self._outline is not None else None, width)

    def _tell(self, from_handle=False):
        self.form.offset.setEnabled(not self.is_fixed())
        super()._tell(from_handle)
        if self.handles is not None and from_handle:
            self._draw_outline(self.handles)  # the radius may be another
        elif self.handles is not None:
            self._turn_handles(self.handles)

    def radius(self):
        return self._part_radius.value if self._part_radius is not None else 0.0

    def _set_radius(self, radius):
        if self._part_radius is not None:
            self._part_radius.set(radius)

    def _make_handles(self, view):
        handles = PlaneHandles(view, self.size, self._dragged)
        self._turn_handles(handles)
        return handles

    def _ask_geometry(self):
        return translate(
            "FemScalpel", "Click a planar face, an edge (the plane is normal to it), a datum or a sketch. Escape stops."
        )

    def _from_nodes(self, points):
        return picking.plane_through(points)

    def _from_click(self, click):
        return picking.plane(click, self.source)

    def close(self):
        super().close()
        self._offset = self._part_radius = self._part_turn = self._outline = self._slot_width = None
