# SPDX-License-Identifier: LGPL-2.1-or-later
"""Input of edges of a mesh: by clicks near them, or by a group."""

import FreeCAD

from ..translate import translate
from ..view import picking
from ..view.marks import Marks
from .panel_input import PanelInput


class EdgeInput(PanelInput):
    """Points near feature lines of the mesh, or the name of a group of segments or nodes."""

    UI = "edge_input.ui"

    def __init__(self, source_object):
        super().__init__(source_object)
        self.marks = None
        self._points = []
        self.buttons = {"edge": self.form.pickEdge}
        self._connect_buttons()
        self.form.clearEdges.clicked.connect(lambda: self.set_along([]))
        self.list_groups(source_object)
        self.form.edge.currentIndexChanged.connect(lambda *_: self._tell())

    def list_groups(self, source_object):
        box, femmesh = self.form.edge, source_object.FemMesh
        chosen = box.currentData()
        names = [femmesh.getGroupName(g) for g in femmesh.Groups if femmesh.getGroupElementType(g) in ("Edge", "Node")]
        names += [chosen] if chosen else []  # which is an error where it is gone
        blocked = box.blockSignals(True)
        box.clear()
        box.addItem("", None)
        for name in dict.fromkeys(names):
            box.addItem(name, name)
        box.setCurrentIndex(max(box.findData(chosen), 0) if chosen else 0)
        box.blockSignals(blocked)
        self._show()

    def along(self):
        """The name of a group, or a list of points."""
        return self.form.edge.currentData() or [tuple(point) for point in self._points]

    def set_along(self, along):
        """Enters a name or points; `changed` follows."""
        self._points = [] if isinstance(along, str) else [FreeCAD.Vector(*point) for point in along]
        blocked = self.form.edge.blockSignals(True)
        self.form.edge.setCurrentIndex(max(self.form.edge.findData(along), 0) if isinstance(along, str) else 0)
        self.form.edge.blockSignals(blocked)
        self._tell()

    def _tell(self):
        self._show()
        self.changed.emit()

    def _show(self):
        text = {
            0: translate("FemScalpel", "none picked yet"),
            1: translate("FemScalpel", "1 picked place"),
        }.get(
            len(self._points)
        ) or translate("FemScalpel", "%1 picked places").replace("%1", str(len(self._points)))
        self.form.edge.setItemText(0, text)
        self.form.clearEdges.setEnabled(bool(self._points))
        self.form.stays.setVisible(bool(self._points) and self.form.edge.currentData() is None)
        if self.marks is not None:
            self.marks.mark([tuple(p) for p in self._points] if self.form.edge.currentData() is None else [])

    def error(self):
        if self.along():
            return ""
        return translate("FemScalpel", "Press Pick and click near the edge, or choose a group.")

    def add_handles(self, view):
        self.marks = Marks(view)
        self._show()

    # Picking.

    def _ask(self, kind):
        return translate("FemScalpel", "Click the mesh near the edge to round. Escape stops.")

    def _picked(self, kind, click):
        if not click.name and click.point == FreeCAD.Vector():  # in the tree
            raise picking.PickError(translate("FemScalpel", "Click the mesh itself, near the edge."))
        node = picking.node_at(click, self.source) if click.name.startswith("Node") else None
        return node[1] if node is not None else click.point

    def take(self, picked):
        self.set_along([*self._points, picked])

    def close(self):
        if self.marks is not None:
            self.marks.close()
            self.marks = None
        super().close()
