# SPDX-License-Identifier: LGPL-2.1-or-later
"""What all tables of the panels can do: be sorted, filtered by name, copied and saved, with columns that fit."""

import csv
import io

from PySide import QtCore, QtGui

from .. import saving
from ..event_filter import EventFilter
from ..translate import translate

#: Role of what a cell is sorted by and saved as, where that is not its text.
VALUE = int(QtCore.Qt.UserRole) + 1
_NARROWEST = 80  # pixels that are left for names
_PATCH = 18


def cell(text, value=None):
    """A cell of a table; with a `value`, a number, it is sorted by that, saved as that, and flush right."""
    item = QtGui.QTableWidgetItem(text)
    if value is not None:
        item.setData(VALUE, value)
        item.setTextAlignment(int(QtCore.Qt.AlignRight | QtCore.Qt.AlignVCenter))
    return item


def _header(table, column):
    """The text of a header. By the model: PySide 2 at times takes an item for what was at the same place in memory."""
    return str(table.model().headerData(column, QtCore.Qt.Horizontal) or "")


class TableTools(EventFilter):
    """A line over `table` with a filter and buttons. A click on a header sorts, another one the other way round; the
    first column has the names. `title`: what is saved, also the suggested file's name; `spare`: columns that are not
    shown where there is no room for all, the first one first. Columns without a header are patches of colour."""

    def __init__(self, table, title, spare=()):
        super().__init__(table)
        self._table, self._title, self._spare, self._order = table, title, spare, None
        headers = (_header(table, column) for column in range(table.columnCount()))
        self._unnamed = [column for column, text in enumerate(headers) if not text]
        self.filter = QtGui.QLineEdit()
        self.filter.setObjectName("filter")
        self.filter.setPlaceholderText(translate("FemScalpel", "Filter by name"))
        self.filter.setClearButtonEnabled(True)
        self.filter.textChanged.connect(lambda *_: self._hide_rows())
        # A widget, not a layout in a layout: PySide 2 keeps what it makes of the items of such, and hands it out for
        # whatever comes to lie in their place, such as a field of another panel.
        bar = QtGui.QWidget()
        line = QtGui.QHBoxLayout(bar)
        line.setContentsMargins(0, 0, 0, 0)
        line.addWidget(self.filter, 1)
        for name, text, tip, run in (
            (
                "copyTable",
                translate("FemScalpel", "Copy"),
                translate("FemScalpel", "Copies all rows that are shown, for a spreadsheet"),
                self.copy,
            ),
            (
                "saveTable",
                translate("FemScalpel", "CSV…"),
                translate("FemScalpel", "Saves all rows that are shown as CSV"),
                self.save,
            ),
        ):
            button = QtGui.QToolButton()
            button.setObjectName(name)
            button.setText(text)
            button.setToolTip(tip)
            button.clicked.connect(run)
            line.addWidget(button)
        layout = table.parentWidget().layout()
        layout.insertWidget(layout.indexOf(table), bar)
        header = table.horizontalHeader()
        header.setSectionsClickable(True)
        header.sectionClicked.connect(self._sort_by)
        header.setStretchLastSection(True)
        table.verticalHeader().hide()
        table.verticalHeader().setDefaultSectionSize(table.fontMetrics().height() + 6)
        table.setWordWrap(False)
        table.setTextElideMode(QtCore.Qt.ElideMiddle)  # what names of groups differ in is often their end
        table.setHorizontalScrollMode(QtGui.QAbstractItemView.ScrollPerPixel)
        table.installEventFilter(self)
        table.viewport().installEventFilter(self)

    def arrange(self):
        """To be called when the table has other rows: sorts and filters them as before, and fits the columns."""
        self._sort()
        self._hide_rows()
        self.fit()

    def fit(self):
        """Columns as wide as what is in them; where that is too much the names have less, and the columns that can be
        spared go."""
        table = self._table
        for column in self._spare:
            table.setColumnHidden(column, False)
        table.resizeColumnsToContents()
        for column in self._unnamed:
            table.setColumnWidth(column, _PATCH)
        width, room = table.columnWidth(0), table.viewport().width()
        narrowest = min(width, _NARROWEST)
        last = table.columnCount() - 1  # it has what is left, so that its width says nothing
        total = sum(table.columnWidth(column) for column in range(1, last))
        total += max(table.sizeHintForColumn(last), table.horizontalHeader().sectionSizeHint(last))
        for column in self._spare:
            if total + narrowest > room:
                total -= table.columnWidth(column)
                table.setColumnHidden(column, True)
        table.setColumnWidth(0, max(narrowest, min(width, room - total)))

    def rows(self):
        """The header and the rows that are shown, as lists of texts and numbers."""
        table, header = self._table, self._table.verticalHeader()
        columns = [k for k in range(table.columnCount()) if k not in self._unnamed]
        lines = [[_header(table, k) for k in columns]]
        for row in map(header.logicalIndex, range(table.rowCount())):
            if not table.isRowHidden(row):
                lines.append([_value(table.item(row, k)) for k in columns])
        return lines

    def copy(self):
        """Puts the shown rows onto the clipboard."""
        saving.copy("\n".join("\t".join(map(str, line)) for line in self.rows()) + "\n")

    def save(self):
        """Saves the shown rows as CSV."""
        saving.save(self._title, self._title, {"CSV": (".csv", self._as_csv)})

    def _as_csv(self):
        text = io.StringIO()
        csv.writer(text, lineterminator="\n").writerows(self.rows())
        return text.getvalue()

    def _sort_by(self, column):
        if column in self._unnamed:
            return
        same = self._order is not None and self._order[0] == column
        self._order = column, same and not self._order[1]
        self._sort()

    def _sort(self):
        # The rows are only shown in another order: panels know them by their numbers.
        table, down = self._table, self._table.verticalHeader()
        order = list(range(table.rowCount()))
        if self._order is not None:
            column, descending = self._order
            order.sort(key=lambda row: _key(table.item(row, column)), reverse=descending)
            across = table.horizontalHeader()
            across.setSortIndicatorShown(True)
            across.setSortIndicator(column, QtCore.Qt.DescendingOrder if descending else QtCore.Qt.AscendingOrder)
        for place, row in enumerate(order):
            at = down.visualIndex(row)
            if at != place:
                down.moveSection(at, place)

    def _hide_rows(self):
        wanted = self.filter.text().strip().lower()
        for row in range(self._table.rowCount()):
            self._table.setRowHidden(row, wanted not in self._table.item(row, 0).text().lower())

    def filtered(self, receiver, event):
        if event.type() == QtCore.QEvent.Resize and receiver is not self._table:
            self.fit()
        elif event.type() == QtCore.QEvent.ShortcutOverride and event.matches(QtGui.QKeySequence.Copy):
            event.accept()  # FreeCAD would copy objects of the document
            return True
        elif event.type() == QtCore.QEvent.KeyPress and event.matches(QtGui.QKeySequence.Copy):
            self.copy()
            return True
        return False


def _value(item):
    value = item.data(VALUE)
    return item.text() if value is None else value


def _key(item):
    """Numbers before texts; texts as people sort them, numbers in them by value."""
    value = item.data(VALUE)
    if value is not None:
        return 0, value, ()
    parts, digits = [], ""
    for character in item.text().lower() + " ":
        if character.isdigit() and character.isascii():
            digits += character
            continue
        if digits:
            parts.append((0, int(digits), ""))
            digits = ""
        parts.append((1, 0, character))
    return 1, 0, tuple(parts)
