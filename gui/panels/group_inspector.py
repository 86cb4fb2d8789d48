# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panel: the groups of a mesh, what they cover, and what uses them."""

import FreeCAD
import FreeCADGui
import numpy as np
from PySide import QtCore, QtGui

import femscalpel

from .. import preferences
from ..group_use import users_of_groups
from ..macro import record_import
from ..translate import QT_TRANSLATE_NOOP, translate
from ..view import colours
from ..view.group_shape import GroupShape, elements_shape, facets_shape, nodes_shape
from . import fields
from .inspection_panel import InspectionPanel
from .narrow import share_by_captions
from .table_tools import TableTools, cell

WHAT = ("groups", "elementary")
PARTS = ("members", "bounding", "linking", "isolated")
_NAME, _COLOUR, _KIND, _SIZE, _MEASURE, _USERS = range(6)


class _Entry:
    """A group, or an elementary group, in the list."""

    def __init__(self, name, kind, dimension, ids, names):
        self.name, self.kind, self.dimension, self.ids, self.names = name, kind, dimension, ids, names

    def shape(self, mesh):
        """Its members as a GroupShape."""
        if self.kind == "node":
            return nodes_shape(mesh, self.ids)
        return facets_shape(mesh, self.ids) if self.kind == "facet" else elements_shape(mesh, self.ids)


class GroupInspectorPanel(InspectionPanel):
    """Shows the groups of the mesh of one object; renames them."""

    TITLE = QT_TRANSLATE_NOOP("FemScalpel", "Group inspector")
    ICON, UI = "FemScalpel_GroupInspector", "group_inspector.ui"
    LARGE = (*InspectionPanel.LARGE, "entries", "_shapes")

    def set_up(self):
        for text, data in zip((translate("FemScalpel", "Groups"), translate("FemScalpel", "Elementary groups")), WHAT):
            self.panel.what.addItem(text, data)
        parts = (
            translate("FemScalpel", "Members"),
            translate("FemScalpel", "Bounding (BE)"),
            translate("FemScalpel", "Linking (LE)"),
            translate("FemScalpel", "Isolated (IE)"),
        )
        for text, data in zip(parts, PARTS):
            self.panel.part.addItem(text, data)
        headers = [
            translate("FemScalpel", "Group"),
            "",
            translate("FemScalpel", "Kind"),
            translate("FemScalpel", "Size"),
            translate("FemScalpel", "Measure"),
            translate("FemScalpel", "Used by"),
        ]
        share_by_captions((self.panel.all, self.panel.none, self.panel.only))
        table = self.panel.groups
        table.setColumnCount(len(headers))
        table.setHorizontalHeaderLabels(headers)
        self._tools = TableTools(table, translate("FemScalpel", "Groups"), (_KIND,))
        self.entries, self._shapes = [], {}
        self.panel.what.currentIndexChanged.connect(lambda *_: self._list())
        self.panel.part.currentIndexChanged.connect(lambda *_: self._draw())
        self.panel.all.clicked.connect(lambda: self._tick(lambda row: not table.isRowHidden(row)))
        self.panel.none.clicked.connect(lambda: self._tick(lambda row: False))
        self.panel.only.clicked.connect(self._only_selected)
        table.itemChanged.connect(self._changed)
        table.cellDoubleClicked.connect(lambda row, column: self._choose_colour(row) if column == _COLOUR else None)

    def loaded(self):
        whole = self.source.whole()
        self.scene.ghost.show(whole.points, whole.faces)
        self.scene.beams.show(whole.beams)
        self._measures = femscalpel.measure(self.source.mesh)
        self._list_anew()

    def _elementary(self):
        return self.panel.what.currentData() == WHAT[1]

    def _list(self):
        if self.source is None:
            return
        mesh = self.source.mesh
        if self._elementary():
            self.entries = [
                _Entry(" ∩ ".join(g.groups), g.kind, g.dimension, g.ids, g.groups) for g in mesh.elementary_groups()
            ]
        else:
            self.entries = [_Entry(g.name, g.kind, None, g.ids, (g.name,)) for g in mesh.groups.all()]
        self._shapes = {}
        self.panel.part.setEnabled(not self._elementary())
        users = users_of_groups(self.source_object)
        table = self.panel.groups
        blocked = table.blockSignals(True)
        table.setRowCount(len(self.entries))
        for row, entry in enumerate(self.entries):
            dimension, measure = self._dimension_and_measure(entry)
            cells = (
                cell(entry.name),
                cell(""),
                cell(_kind(entry.kind, dimension)),
                cell(str(len(entry.ids)), len(entry.ids)),
                cell(_measure_text(measure, dimension), measure),
                cell(", ".join(label for name in entry.names for label in users.get(name, ()))),
            )
            tip = "\n".join(filter(None, (item.text() for item in cells)))
            for column, item in enumerate(cells):
                flags = QtCore.Qt.ItemIsEnabled | QtCore.Qt.ItemIsSelectable
                if column == _NAME:
                    item.setCheckState(QtCore.Qt.Unchecked)
                    flags |= QtCore.Qt.ItemIsUserCheckable
                    if not self._elementary():
                        flags |= QtCore.Qt.ItemIsEditable
                item.setFlags(flags)
                if column == _COLOUR:
                    item.setBackground(_qcolour(self._colour(row)))
                    item.setToolTip(translate("FemScalpel", "Double-click to change the colour"))
                else:
                    item.setToolTip(tip)
                table.setItem(row, column, item)
        table.blockSignals(blocked)
        self._tools.arrange()
        self.panel.status.setText(
            translate("FemScalpel", "%1 groups, %2 nodes, %3 elements.")
            .replace("%1", str(len(self.entries)))
            .replace("%2", str(mesh.node_count))
            .replace("%3", str(mesh.cell_count))
        )
        self._draw()

    def _colour(self, row):
        chosen = preferences.group_colour(self.entries[row].name)
        return colours.distinct_rgb(row) if chosen is None else np.array(chosen)

    def _choose_colour(self, row):
        name = self.entries[row].name
        title = translate("FemScalpel", "Colour of %1").replace("%1", name)
        chosen = QtGui.QColorDialog.getColor(_qcolour(self._colour(row)), self.panel, title)
        if self._closed or not chosen.isValid():
            return
        preferences.set_group_colour(name, chosen.getRgbF()[:3])
        self.panel.groups.item(row, _COLOUR).setBackground(_qcolour(self._colour(row)))
        self._draw()

    def _dimension_and_measure(self, entry):
        """The dimension of its largest members, and their measure, None where there is none."""
        if entry.kind != "element":
            return entry.dimension, None
        dimensions, total = {}, {}
        for name, ids in self.source.mesh.cell_ids.items():
            chosen = np.isin(ids, entry.ids)
            if chosen.any():
                dimension = femscalpel.mesh.CELL_TYPES[name][0]
                dimensions[dimension] = True
                total[dimension] = total.get(dimension, 0.0) + float(self._measures[name][chosen].sum())
        if not dimensions:
            return None, None
        dimension = max(dimensions)
        return dimension, total[dimension] if dimension else None

    def _tick(self, wanted):
        table = self.panel.groups
        blocked = table.blockSignals(True)
        for row in range(table.rowCount()):
            table.item(row, _NAME).setCheckState(QtCore.Qt.Checked if wanted(row) else QtCore.Qt.Unchecked)
        table.blockSignals(blocked)
        self._draw()

    def _only_selected(self):
        rows = {index.row() for index in self.panel.groups.selectionModel().selectedRows()}
        self._tick(lambda row: row in rows)

    def ticked(self):
        """Rows whose box is ticked."""
        return [
            row
            for row in range(self.panel.groups.rowCount())
            if self.panel.groups.item(row, _NAME).checkState() == QtCore.Qt.Checked
        ]

    def _changed(self, item):
        if item.column() != _NAME:
            return
        entry = self.entries[item.row()]
        if not self._elementary() and item.text() != entry.name:
            # Not from within the table's own notification.
            QtCore.QTimer.singleShot(0, lambda: self._rename(entry, item.text()))
        else:
            self._draw()

    def _draw(self):
        if self.source is None:
            return
        part = PARTS[0] if self._elementary() else self.panel.part.currentData()
        shapes = []
        for row in self.ticked():
            key = row, part
            if key not in self._shapes:
                self._shapes[key] = self._shape(self.entries[row], part)
            shapes.append((self._shapes[key], self._colour(row)))
        self.scene.show(shapes)
        self.legend_in_view.show_entries([(self._colour(row), self.entries[row].name) for row in self.ticked()])

    def _shape(self, entry, part):
        mesh = self.source.mesh
        if part == PARTS[0]:
            return entry.shape(mesh)
        boundary = femscalpel.virtual_boundary(mesh, entry.name, entry.kind)
        piece = getattr(boundary, part)
        source = self.source
        faces = [
            np.column_stack([source.rows(piece.triangles.ravel()).reshape(-1, 3), np.full(len(piece.triangles), -1)]),
            source.rows(piece.quads.ravel()).reshape(-1, 4),
        ]
        lines = mesh.points[source.rows(piece.edges.ravel()).reshape(-1, 2)].astype(np.float32)
        nodes = mesh.points[source.rows(piece.nodes)].astype(np.float32)
        return GroupShape(
            mesh.points.astype(np.float32), np.concatenate(faces).astype(np.int64), lines.reshape(-1, 2, 3), nodes
        )

    def _rename(self, entry, name):
        if self._closed or self.source is None:
            return
        fields.show_error(self.panel.error, "")
        try:
            record_import()
            document = (
                "FreeCAD.ActiveDocument"
                if FreeCAD.ActiveDocument == self.document
                else f"FreeCAD.getDocument({self.document.Name!r})"
            )
            FreeCADGui.doCommand(
                f"ObjectsFemScalpel.renameGroup({document}.getObject({self.source_object.Name!r}), "
                f"{entry.name!r}, {name!r}, kind={entry.kind!r})"
            )
            self.source.mesh.rename_group(entry.name, name, entry.kind)
            self.know_mesh()
        except Exception as error:
            fields.show_error(self.panel.error, str(error))
        self._list_anew({entry.name: name})

    def _list_anew(self, renamed=()):
        """Lists the groups, and ticks those again that were ticked, some of them by another name."""
        shown = {self.entries[row].name for row in self.ticked()}
        shown |= {new for old, new in dict(renamed).items() if old in shown}
        self._list()
        if shown:
            self._tick(lambda row: self.entries[row].name in shown)


def _measure_text(measure, dimension):
    return "" if measure is None else f"{measure:.6g} {('', 'mm', 'mm²', 'mm³')[dimension]}"


def _qcolour(rgb):
    return QtGui.QColor.fromRgbF(*[float(c) for c in rgb])


def _kind(kind, dimension):
    if kind == "node":
        return translate("FemScalpel", "nodes")
    if kind == "facet":
        return translate("FemScalpel", "facets")
    return {
        1: translate("FemScalpel", "edges"),
        2: translate("FemScalpel", "faces"),
        3: translate("FemScalpel", "volumes"),
        0: translate("FemScalpel", "points"),
        None: translate("FemScalpel", "empty"),
    }[dimension]
