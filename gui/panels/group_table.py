# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fills a table widget with a group report."""

from PySide import QtCore, QtGui

from ..translate import translate

_UNITS = {1: "mm", 2: "mm²", 3: "mm³"}


def set_up(table):
    """Gives the table its columns."""
    headers = [
        translate("FemScalpel", "Group"),
        translate("FemScalpel", "Kind"),
        translate("FemScalpel", "Before"),
        translate("FemScalpel", "After"),
        translate("FemScalpel", "Change"),
        translate("FemScalpel", "Status"),
    ]
    table.setColumnCount(len(headers))
    table.setHorizontalHeaderLabels(headers)
    table.verticalHeader().hide()
    table.verticalHeader().setDefaultSectionSize(table.fontMetrics().height() + 6)
    table.setWordWrap(False)
    table.horizontalHeader().setStretchLastSection(True)


def fill(table, records):
    """Shows femscalpel.GroupRecord rows, those that changed first; keeps the selected group."""
    chosen = selected(table)
    order = sorted(
        records, key=lambda r: ("new", "became empty", "reduced", "changed", "kept", "untouched").index(r.status)
    )
    blocked = table.blockSignals(True)
    table.clearSelection()
    table.setRowCount(len(order))
    for row, record in enumerate(order):
        cells = (
            record.name,
            _kind(record),
            str(record.count_before),
            str(record.count_after),
            _change(record),
            _status(record.status),
        )
        for column, text in enumerate(cells):
            item = QtGui.QTableWidgetItem(text)
            if column in (2, 3, 4):
                item.setTextAlignment(int(QtCore.Qt.AlignRight | QtCore.Qt.AlignVCenter))
            if column == 0:
                item.setData(QtCore.Qt.UserRole, (record.name, record.kind))
            item.setToolTip(_tip(record))
            table.setItem(row, column, item)
        if (record.name, record.kind) == chosen:
            table.selectRow(row)
    table.resizeColumnsToContents()
    table.blockSignals(blocked)


def selected(table):
    """(name, kind) of the selected group, or None."""
    rows = table.selectionModel().selectedRows() if table.selectionModel() else []
    item = table.item(rows[0].row(), 0) if rows else None
    data = item.data(QtCore.Qt.UserRole) if item is not None else None
    return tuple(data) if data else None


def _kind(record):
    names = {"node": translate("FemScalpel", "nodes"), "facet": translate("FemScalpel", "facets")}
    dimensions = {
        0: translate("FemScalpel", "points"),
        1: translate("FemScalpel", "edges"),
        2: translate("FemScalpel", "faces"),
        3: translate("FemScalpel", "volumes"),
    }
    return names.get(record.kind) or dimensions[record.dimension]


def _status(status):
    return {
        "new": translate("FemScalpel", "new"),
        "became empty": translate("FemScalpel", "became empty"),
        "reduced": translate("FemScalpel", "reduced"),
        "changed": translate("FemScalpel", "changed"),
        "kept": translate("FemScalpel", "kept"),
        "untouched": translate("FemScalpel", "untouched"),
    }[status]


def _change(record):
    if record.kind == "node" or not record.measure_before:
        return ""
    change = (record.measure_after - record.measure_before) / record.measure_before
    return "0" if abs(change) < 1e-12 else f"{change:+.1e}"


def _tip(record):
    text = (
        translate("FemScalpel", "%1 nodes moved; boundary at most %2 mm from where it was")
        .replace("%1", str(record.nodes_moved))
        .replace("%2", f"{record.boundary_drift:.3g}")
    )
    if record.kind != "node" and record.dimension:
        text = f"{record.measure_before:.6g} → {record.measure_after:.6g} {_UNITS[record.dimension]}; {text}"
    return text
