# SPDX-License-Identifier: LGPL-2.1-or-later
"""Input of a cylinder: axis and radius."""

from ..translate import translate
from ..view import picking
from ..view.axis_handles import AxisHandles
from . import fields
from .geometry_input import GeometryInput


class AxisInput(GeometryInput):
    """An axis by point and direction, by two nodes, a cylindrical face, an edge or a point on a face; and a radius."""

    UI = "axis_input.ui"
    NODES = 2
    EDGES_OF_SKETCHES = True

    def __init__(self, source_object):
        self._radius = self._depth = self._part = None
        super().__init__(source_object)
        step = fields.round_step(self.size / 50)
        self._radius = fields.Number(self.form.radius, self._tell, fields.round_step(self.size / 10), step)

    def radius(self):
        return self._radius.value if self._radius is not None else 0.0

    def _set_radius(self, radius):
        self._radius.set(radius)

    def error(self):
        return super().error() or self.radius_error()

    def radius_error(self):
        """What is wrong with the radius, "" when nothing is."""
        return "" if self.radius() > 0 else translate("FemScalpel", "The radius must be larger than 0.")

    def show_depth(self, depth):
        """Says how far beyond the point what is seen of the cylinder ends, None: it does not."""
        self._depth = depth
        if self.handles is not None:
            self.handles.show_depth(depth)
            self.handles.set_pose(self.origin(), self.rotation(), self.radius())

    def show_part(self, part):
        """Says what part of the cylinder is meant, see AxisHandles.show_part()."""
        self._part = part
        if self.handles is not None:
            self.handles.show_part(part)

    def _make_handles(self, view):
        handles = AxisHandles(view, self.size, self._dragged)
        handles.show_depth(self._depth)
        handles.show_part(self._part)
        return handles

    def _ask_geometry(self):
        return translate(
            "FemScalpel",
            "Click a cylindrical face, a straight or circular edge, a datum line, or a point on a face "
            "(the axis is normal to it). Escape stops.",
        )

    def _from_nodes(self, points):
        return picking.axis_through(points)

    def _from_click(self, click):
        return picking.axis(click, self.source)

    def close(self):
        super().close()
        self._radius = None
