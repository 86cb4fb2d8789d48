# SPDX-License-Identifier: LGPL-2.1-or-later
"""Input of the groups whose border keeps its shape, in the panels' options."""

from PySide import QtCore, QtGui

from ..translate import translate

#: Rows of the list that are shown at once.
_ROWS = 6


class PreserveInput:
    """All groups, or those that are ticked in a list: the fields `preserve` and `preserved` of options.ui."""

    def __init__(self, options, names, changed):
        self._choice, self._list, self._changed = options.preserve, options.preserved, changed
        for text, data in (
            (translate("FemScalpel", "all kept"), "All"),
            (translate("FemScalpel", "kept where ticked"), "Ticked"),
        ):
            self._choice.addItem(text, data)
        for name in names:
            self._add(name)
        self._choice.setEnabled(bool(names))
        self._choose()
        self._choice.currentIndexChanged.connect(lambda *_: (self._choose(), changed()))
        self._list.itemChanged.connect(lambda *_: changed())

    def _add(self, name, tip=""):
        item = QtGui.QListWidgetItem(name)
        item.setFlags(QtCore.Qt.ItemIsEnabled | QtCore.Qt.ItemIsSelectable | QtCore.Qt.ItemIsUserCheckable)
        item.setCheckState(QtCore.Qt.Checked)
        item.setToolTip(tip)
        self._list.addItem(item)

    def _choose(self):
        self._list.setVisible(self._choice.currentData() == "Ticked")
        rows = min(max(self._list.count(), 2), _ROWS)
        self._list.setFixedHeight(rows * self._list.sizeHintForRow(0) + 2 * self._list.frameWidth() + 4)

    def _items(self):
        return [self._list.item(row) for row in range(self._list.count())]

    def list_groups(self, names):
        """The mesh has these groups now; new ones are ticked."""
        known = {item.text(): item for item in self._items()}
        blocked = self._list.blockSignals(True)
        for name in names:
            if name not in known:
                self._add(name)
        for name, item in known.items():
            if name not in names:
                self._list.takeItem(self._list.row(item))
        self._list.blockSignals(blocked)
        self._choice.setEnabled(self._list.count() > 0 or self._choice.currentData() == "Ticked")
        self._choose()

    def value(self):
        """None for all groups, or a list of names."""
        if self._choice.currentData() == "All":
            return None
        return [item.text() for item in self._items() if item.checkState() == QtCore.Qt.Checked]

    def set(self, names):
        """Enters what the property PreservedGroups holds, without telling anyone."""
        blocked = self._choice.blockSignals(True), self._list.blockSignals(True)
        if "*" not in names:
            known = {item.text() for item in self._items()}
            for name in names:
                if name not in known:
                    self._add(name, translate("FemScalpel", "The mesh has no such group any more."))
            for item in self._items():
                item.setCheckState(QtCore.Qt.Checked if item.text() in names else QtCore.Qt.Unchecked)
            self._choice.setEnabled(True)
        self._choice.setCurrentIndex(self._choice.findData("All" if "*" in names else "Ticked"))
        self._choose()
        self._choice.blockSignals(blocked[0]), self._list.blockSignals(blocked[1])
