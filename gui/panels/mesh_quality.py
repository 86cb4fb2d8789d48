# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panel: quality of a mesh in colours, as a histogram, and its worst elements."""

import numpy as np
from PySide import QtGui

import femscalpel

from .. import preferences
from ..translate import QT_TRANSLATE_NOOP, translate
from ..view import faces as mesh_faces
from ..view.colours import quality_rgb
from ..view.group_scene import zoom_to
from ..view.group_shape import GroupShape, elements_shape
from .histogram import Histogram
from .inspection_panel import InspectionPanel
from .table_tools import TableTools, cell

#: Measures: name, function, value of the regular element, unit.
MEASURES = (
    ("mean ratio", femscalpel.mean_ratio, 1.0, ""),
    ("smallest angle", femscalpel.smallest_angle, 90.0, "°"),
    ("scaled Jacobian", femscalpel.scaled_jacobian, 1.0, ""),
)
_SHOWN = 30


class MeshQualityPanel(InspectionPanel):
    """Shows the quality of the mesh of one object; changes nothing."""

    TITLE = QT_TRANSLATE_NOOP("FemScalpel", "Mesh quality")
    ICON, UI = "FemScalpel_MeshQuality", "mesh_quality.ui"
    LARGE = (*InspectionPanel.LARGE, "values", "_ids", "_types")

    def set_up(self):
        titles = (
            translate("FemScalpel", "Mean ratio"),
            translate("FemScalpel", "Smallest angle (dihedral in solids)"),
            translate("FemScalpel", "Scaled Jacobian"),
        )
        for title, (name, *_) in zip(titles, MEASURES):
            self.panel.measure.addItem(title, name)
        self.histogram = Histogram()
        self.panel.histogramLayout.addWidget(self.histogram)
        self._set_limit()
        self.panel.worst.setColumnCount(3)
        self.panel.worst.setHorizontalHeaderLabels(
            [translate("FemScalpel", "Element"), translate("FemScalpel", "Type"), translate("FemScalpel", "Value")]
        )
        self.panel.worst.setEditTriggers(QtGui.QAbstractItemView.NoEditTriggers)
        self._tools = TableTools(self.panel.worst, translate("FemScalpel", "Worst elements"))
        self.panel.measure.currentIndexChanged.connect(lambda *_: (self._set_limit(), self._measure()))
        self.panel.onlyBad.toggled.connect(lambda *_: self._draw())
        self.panel.limit.valueChanged.connect(lambda *_: self._draw())
        self.panel.worst.itemSelectionChanged.connect(self._zoom)
        self.values = self._ids = self._types = np.empty(0)

    def loaded(self):
        self.scene.beams.show(self.source.whole().beams)
        self._measure()

    def _chosen(self):
        return MEASURES[max(self.panel.measure.currentIndex(), 0)]

    def _set_limit(self):
        """The user's threshold, in the unit of the measure."""
        _, _, regular, unit = self._chosen()
        limit = self.panel.limit
        blocked = limit.blockSignals(True)
        limit.setRange(-regular, regular)
        limit.setSuffix(unit)
        limit.setSingleStep(regular / 20)
        limit.setValue(preferences.quality_threshold() * regular)
        limit.blockSignals(blocked)

    def _measure(self):
        if self.source is None:
            return
        _, function, regular, unit = self._chosen()
        by_type = function(self.source.mesh)
        cells = self.source.cells
        self.values = np.concatenate([by_type[name] for name, _ in cells.blocks]) if cells.blocks else np.empty(0)
        self._types = np.repeat([name for name, _ in cells.blocks], [len(nodes) for _, nodes in cells.blocks])
        # Faces that solids stand behind are not elements to judge by.
        judged = cells.dimension == (3 if (cells.dimension == 3).any() else 2)
        counts, _ = np.histogram(np.clip(self.values[judged], 0, regular), 20, (0, regular))
        self._show_legend(regular, unit)
        self.histogram.show_counts(counts, low=0.0, high=regular, rgb=lambda middle: quality_rgb(middle / regular))
        judged = np.flatnonzero(judged)
        if not len(judged):
            self.panel.status.setText(translate("FemScalpel", "The mesh has neither faces nor volumes."))
            return
        values = self.values[judged]
        text = translate("FemScalpel", "%1 elements; smallest %2, mean %3.")
        for k, number in enumerate((len(values), f"{values.min():.3f}{unit}", f"{values.mean():.3f}{unit}"), 1):
            text = text.replace(f"%{k}", str(number))
        self.panel.status.setText(text)
        worst = judged[np.argsort(values, kind="stable")[:_SHOWN]]
        blocked = self.panel.worst.blockSignals(True)
        self.panel.worst.clearSelection()
        self.panel.worst.setRowCount(len(worst))
        for row, at in enumerate(worst):
            number, value = int(cells.ids[at]), float(self.values[at])
            entries = cell(str(number), number), cell(str(self._types[at])), cell(f"{value:.4f}{unit}", value)
            for column, entry in enumerate(entries):
                self.panel.worst.setItem(row, column, entry)
        self.panel.worst.blockSignals(blocked)
        self._tools.arrange()
        self._draw()

    def _show_legend(self, regular, unit):
        text = translate("FemScalpel", "%1: 0 to %2").replace("%1", self.panel.measure.currentText())
        rgb = quality_rgb(np.array((0.0, 0.15, 0.3, 0.5, 0.75, 1.0)))
        self.legend_in_view.show_entries([(rgb, text.replace("%2", f"{regular:g}{unit}"))])

    def _draw(self, extra=()):
        if self.source is None:
            return
        source, regular = self.source, self._chosen()[2]
        whole = source.whole()
        if self.panel.onlyBad.isChecked():
            bad = self.values < self.panel.limit.value()
            blocks, first, owners = [], 0, np.flatnonzero(bad)
            for name, nodes in source.cells.blocks:
                blocks.append((name, nodes[bad[first : first + len(nodes)]]))
                first += len(nodes)
            faces, owner = mesh_faces.outer_faces(blocks, source.mesh.node_count)
            values = self.values[owners[owner]]
            rows, points = mesh_faces.compact(faces, source.points)
            self.scene.ghost.show(whole.points, whole.faces)
        else:
            rows, points, values = whole.faces, whole.points, self.values[source.skin_owner]
            self.scene.ghost.hide()
        nothing = np.empty((0, 2, 3), np.float32), np.empty((0, 3), np.float32)
        self.scene.show([(GroupShape(points, rows, *nothing), quality_rgb(values / regular)), *extra])

    def _zoom(self):
        rows = self.panel.worst.selectionModel().selectedRows()
        if not rows or self.source is None:
            self.scene.label.hide()
            self._draw()
            return
        number = int(self.panel.worst.item(rows[0].row(), 0).text())
        shape = elements_shape(self.source.mesh, [number])
        low, high = shape.points.min(axis=0), shape.points.max(axis=0)
        around = 1.5 * (high - low).max()
        zoom_to(self.view, low - around, high + around)
        edges, _ = mesh_faces.face_edges(shape.faces)
        lines = shape.points[mesh_faces.unique_edges(edges, len(shape.points))]
        outline = GroupShape(shape.points, shape.faces[:0], lines, np.empty((0, 3), np.float32))
        self.scene.label.show((low + high) / 2, f"{number}: {self.panel.worst.item(rows[0].row(), 2).text()}")
        if not self.panel.onlyBad.isChecked():
            # It may lie inside the part.
            self.panel.limit.setValue(self.values[self.source.cells.find(np.array([number]))][0] + 1e-3)
            self.panel.onlyBad.setChecked(True)
        self._draw([(outline, np.array((0.0, 0.0, 0.0)))])

    def forget_widgets(self):
        super().forget_widgets()
        self.histogram = None
