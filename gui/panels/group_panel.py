# SPDX-License-Identifier: LGPL-2.1-or-later
"""What task panels have in common whose tool is a group of the mesh."""

from .tool_panel import ToolPanel


class GroupPanel(ToolPanel):
    """Offers groups, and keeps the one that is chosen while the mesh is read anew. Its geometry has fill(), group() and
    forget_group()."""

    def offered_from(self):
        """What the geometry finds the groups in."""
        return self.source

    def loaded(self):
        self._fill()
        super().loaded()

    def _fill(self):
        chosen = self.edited.Group if self.edited is not None else None
        self.geometry.fill(self.offered_from(), self.geometry.group() or chosen)

    def document_changed(self, stepped):
        if stepped:
            self.geometry.forget_group()
            if self.source is not None:
                self._fill()
        super().document_changed(stepped)
