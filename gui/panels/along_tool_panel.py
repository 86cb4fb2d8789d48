# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the task panels share whose tool is any of femscalpel's table."""

import numpy as np

from ..view.preview_data import Surface
from .tool_input import ToolInput
from .tool_panel import ToolPanel


class AlongToolPanel(ToolPanel):
    """Asks for one of the tools SHAPES, the first at first. `faces`: (object, names of its faces) to begin with."""

    #: Set by subclasses.
    SHAPES = ()

    def __init__(self, source_object, edited=None, faces=None):
        self._first_faces = faces
        super().__init__(source_object, edited)

    def make_geometry(self):
        geometry = ToolInput(self.source_object, self.SHAPES, self.SHAPES[0])
        geometry.set_faces(None)
        if self._first_faces:
            geometry.start_with(self._first_faces)
        return geometry

    def tool(self):
        return self.geometry.tool()

    def read(self, obj):
        super().read(obj)
        self.geometry.read(obj)

    def arguments(self):
        return {**self.geometry.arguments(self._text_of), **super().arguments()}

    def settings(self):
        return {**self.geometry.settings(self._text_of), **super().settings()}

    def update(self):
        if not self._closed and self.source is not None:
            self._hide_parts(not self.geometry.is_picking())
        super().update()

    def in_the_way(self):
        part = self.geometry.part()
        others = [other for other in super().in_the_way() if other != part]
        return others if part is None else [*others, part]

    def beside(self):
        face = self.geometry.face()
        if face is None:
            return None
        points, triangles = face.tessellate(0.002 * self.geometry.size)
        rows = np.column_stack([np.array(triangles), np.full(len(triangles), -1)])
        nothing = np.zeros(len(rows))
        return Surface.make(np.array([tuple(p) for p in points]), rows, nothing, nothing.astype(int))
