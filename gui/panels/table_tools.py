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
        self._headers = {}  # widths of headers when they were seen last
        self._fitted = None  # the table's width that the columns were fitted to
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
        line.setSpacing(3)
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

    def arrange(self):
        """To be called when the table has other rows: sorts and filters them as before, and fits the columns."""
        self._sort()
        self._hide_rows()
        self.fit()

    def fit(self):
        """Columns as wide as what is in them. Where that is too much, columns without anything in them go, then the
        names have less, then the columns that can be spared go; only then can one scroll sideways.

        What comes out is a function of the contents and of the table's own width: the room of the other scroll bar is
        kept free whether that is there or not. If it were not, the columns would bring the bar, the bar other columns,
        and these would take it away again, without an end.
        """
        table = self._table
        self._fitted = table.width()
        room = table.contentsRect().width() - table.verticalScrollBar().sizeHint().width()
        wanted = [self._wanted(column) for column in range(table.columnCount())]
        narrowest = min(wanted[0], self._narrowest())
        shown = set(range(len(wanted)))
        for column in self._empty():
            if sum(wanted[k] for k in shown) > room:
                shown.discard(column)
        rest = lambda: sum(wanted[k] for k in shown if k)  # noqa: E731
        for column in self._spare:
            if rest() + narrowest > room:
                shown.discard(column)
        wanted[0] = max(narrowest, min(wanted[0], room - rest()))
        self._lay_out(wanted, shown)
        fits = wanted[0] + rest() <= room
        policy = QtCore.Qt.ScrollBarAlwaysOff if fits else QtCore.Qt.ScrollBarAlwaysOn
        if table.horizontalScrollBarPolicy() != policy:
            table.setHorizontalScrollBarPolicy(policy)
        if fits:
            table.horizontalScrollBar().setValue(0)

    def _wanted(self, column):
        """Pixels for all that is in a column and for its header."""
        if column in self._unnamed:
            return _PATCH
        table, header = self._table, self._table.horizontalHeader()
        if not table.isColumnHidden(column):  # those of hidden ones are told as 0
            self._headers[column] = header.sectionSizeHint(column)
        return max(table.sizeHintForColumn(column), self._headers.get(column, 0), header.minimumSectionSize())

    def _narrowest(self):
        """Pixels that are left for names, with the box to tick beside them."""
        table = self._table
        first = table.item(0, 0) if table.rowCount() else None
        ticks = first is not None and first.data(QtCore.Qt.CheckStateRole) is not None
        return _NARROWEST + (table.style().pixelMetric(QtGui.QStyle.PM_IndicatorWidth) + 8 if ticks else 0)

    def _empty(self):
        """Columns with a header and rows, but nothing in them."""
        table = self._table
        rows = range(table.rowCount())
        named = [k for k in range(1, table.columnCount()) if k not in self._unnamed]
        texts = lambda column: (table.item(row, column) for row in rows)  # noqa: E731
        return [k for k in named if rows and not any(item is not None and item.text() for item in texts(k))]

    def _lay_out(self, widths, shown):
        """Gives the table these widths and columns, and touches only what differs."""
        table = self._table
        for column, width in enumerate(widths):
            if table.isColumnHidden(column) == (column in shown):
                table.setColumnHidden(column, column not in shown)
        for column in sorted(shown)[:-1]:  # the last one has what is left
            if table.columnWidth(column) != widths[column]:
                table.setColumnWidth(column, widths[column])

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
        if event.type() == QtCore.QEvent.Resize:
            if self._table.width() != self._fitted:
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
