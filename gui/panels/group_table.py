# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fills a table widget with a group report."""

from PySide import QtCore

from ..translate import translate
from .table_tools import TableTools, cell

_STATES = ("new", "became empty", "reduced", "changed", "kept", "untouched")
_UNITS = {1: "mm", 2: "mm²", 3: "mm³"}


def set_up(table):
    """Gives the table its columns; returns its TableTools."""
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
    return TableTools(table, translate("FemScalpel", "Groups"), (1, 4))


def fill(table, records, tools):
    """Shows femscalpel.GroupRecord rows, those that changed first or as the user has sorted them by `tools`; keeps the
    selected group."""
    chosen = selected(table)
    order = sorted(records, key=lambda r: _STATES.index(r.status))
    blocked = table.blockSignals(True)
    table.clearSelection()
    table.setRowCount(len(order))
    for row, record in enumerate(order):
        cells = (
            cell(record.name),
            cell(_kind(record)),
            cell(str(record.count_before), record.count_before),
            cell(str(record.count_after), record.count_after),
            cell(*_change(record)),
            cell(_status(record.status)),
        )
        cells[0].setData(QtCore.Qt.UserRole, (record.name, record.kind))
        for column, item in enumerate(cells):
            item.setToolTip(f"{record.name}: {_kind(record)}; {_tip(record)}")
            table.setItem(row, column, item)
        if (record.name, record.kind) == chosen:
            table.selectRow(row)
    table.blockSignals(blocked)
    tools.arrange()


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
    """As text, and the number, None where there is none."""
    if record.kind == "node" or not record.measure_before:
        return "", None
    change = (record.measure_after - record.measure_before) / record.measure_before
    return "0" if abs(change) < 1e-12 else f"{change:+.1e}", change


def _tip(record):
    text = (
        translate("FemScalpel", "%1 nodes moved; boundary at most %2 mm from where it was")
        .replace("%1", str(record.nodes_moved))
        .replace("%2", f"{record.boundary_drift:.3g}")
    )
    if record.kind != "node" and record.dimension:
        text = f"{record.measure_before:.6g} → {record.measure_after:.6g} {_UNITS[record.dimension]}; {text}"
    return text
