# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parts of a panel that can be folded, and fields that know what they are called."""

from PySide import QtCore, QtGui

from .. import preferences
from ..event_filter import EventFilter


class Section(EventFilter):
    """Rows of a grid under a header that folds them away; the user's choice is kept. A message in it unfolds it.

    Parameters
    ----------
    grid : QGridLayout
        Of two columns, in the box layout `rows`; what is in its `numbers` moves into the section.
    name : str
        Of the preference, and of the header after "section".
    """

    def __init__(self, rows, grid, numbers, name, title, tip, is_open):
        super().__init__(rows)
        self._name = name
        self._header, self._content = QtGui.QToolButton(), QtGui.QWidget()
        inside = QtGui.QGridLayout(self._content)
        inside.setContentsMargins(0, 0, 0, 0)
        inside.setColumnStretch(1, 1)
        moved, placed = [], by_row(grid)
        for at, row in enumerate(numbers):
            for column, columns, box in placed.get(row, ()):
                if column < 2 and box not in moved:
                    moved.append(box)
                    inside.addWidget(box, at, column, 1, 2 if column == 0 and columns > 1 else 1)
                    box.installEventFilter(self)
        header = self._header
        header.setObjectName("section" + name)
        header.setText(title)
        header.setToolTip(tip)
        header.setCheckable(True)
        header.setAutoRaise(True)
        header.setToolButtonStyle(QtCore.Qt.ToolButtonTextBesideIcon)
        header.setSizePolicy(QtGui.QSizePolicy.Expanding, QtGui.QSizePolicy.Fixed)
        place = rows.indexOf(grid) + 1
        there = [rows.indexOf(box) for box in _widgets_of(rows) if isinstance(box, QtGui.QToolButton)]
        while place in there:
            place += 2  # behind the sections that are there
        rows.insertWidget(place, header)
        rows.insertWidget(place + 1, self._content)
        header.setChecked(preferences.is_unfolded(name, is_open))
        self._fold(header.isChecked())
        header.toggled.connect(self._fold)
        header.clicked.connect(lambda on: preferences.set_unfolded(self._name, on))

    def _fold(self, is_open):
        self._header.setArrowType(QtCore.Qt.DownArrow if is_open else QtCore.Qt.RightArrow)
        self._content.setVisible(is_open)

    def filtered(self, receiver, event):
        if event.type() == QtCore.QEvent.ShowToParent and receiver.objectName().endswith("Error"):
            self._header.setChecked(True)
        return False


def name_fields(form):
    """Ties the labels of a form to the fields behind them, and names all fields for screen readers."""
    kinds = (QtGui.QAbstractSpinBox, QtGui.QComboBox, QtGui.QLineEdit, QtGui.QAbstractItemView)
    for layout in form.findChildren(QtGui.QLayout):
        for row in _rows_of(layout):
            label = None
            for box in row:
                if isinstance(box, QtGui.QLabel):
                    label = box
                elif isinstance(box, kinds) and label is not None:
                    if label.text() and not label.objectName().endswith("Error"):
                        label.setBuddy(box)
                        if len(label.text()) > 2:  # not x, y, z
                            box.setAccessibleName(label.text())
                    label = None
    for kind in kinds:
        for box in form.findChildren(kind):
            if not box.accessibleName():
                box.setAccessibleName(box.toolTip())


def _rows_of(layout):
    """The widgets of a layout, row by row."""
    if isinstance(layout, QtGui.QGridLayout):
        for _, boxes in sorted(by_row(layout).items()):
            yield [box for _, _, box in boxes]
    elif isinstance(layout, QtGui.QHBoxLayout):
        yield sorted(_widgets_of(layout), key=layout.indexOf)


def _widgets_of(layout):
    """The widgets in a layout. Not by its items: PySide 2 keeps what it makes of these when they are gone, and hands it
    out for what comes to lie in their place, such as a field."""
    return [w for w in layout.parentWidget().children() if isinstance(w, QtGui.QWidget) and layout.indexOf(w) >= 0]


def by_row(grid):
    """(column, number of columns, widget) by row, from left to right; what spans several rows is in its first."""
    out = {}
    for box in _widgets_of(grid):
        row, column, _, columns = grid.getItemPosition(grid.indexOf(box))
        out.setdefault(row, []).append((column, columns, box))
    return {row: sorted(boxes, key=lambda place: place[0]) for row, boxes in out.items()}
