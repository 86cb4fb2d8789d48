# SPDX-License-Identifier: LGPL-2.1-or-later
"""The row of a form that says which geometry its numbers follow, with a button that ends it."""

from PySide import QtGui

from femscalpelobjects import following
from femscalpelobjects.picked_geometry import axes_of, name_of, shape_of

from ..translate import translate
from . import fields
from .document_watch import is_gone


class Followed:
    """What the position in `form` follows: `targets` as following.targets_of(), empty where it is numbers. Calls
    `changed()` when the user ends it."""

    def __init__(self, form, changed):
        self.targets, self._name, self._broken, self._changed = [], "", False, changed
        self.row = QtGui.QWidget()
        layout = QtGui.QHBoxLayout(self.row)
        layout.setContentsMargins(0, 0, 0, 0)
        self._label = QtGui.QLabel()
        self._label.setObjectName("followed")
        self._label.setWordWrap(True)
        self._unlink = QtGui.QPushButton(translate("FemScalpel", "Unlink"))
        self._unlink.setObjectName("unlink")
        self._unlink.setToolTip(translate("FemScalpel", "The numbers stay as they are when the geometry changes"))
        self._unlink.clicked.connect(self._end)
        layout.addWidget(self._label, 1)
        layout.addWidget(self._unlink)
        form.layout().insertWidget(form.layout().indexOf(form.hint) + 1, self.row)
        self._show("")

    def read(self, obj):
        """Follows what a document object does."""
        if not following.follows(obj):
            return
        self._name, self._broken = obj.FollowedName, bool(following.problem_of(obj))
        self.targets = [] if self._broken else following.targets_of(obj)
        self._show_name()

    def start(self, targets):
        """From now on the numbers follow `targets`, or nothing."""
        self.targets, self._name, self._broken = list(targets), name_of(targets) if targets else "", False
        self._show_name()

    def end_by_hand(self):
        """The numbers were entered otherwise."""
        if not self._name:
            return
        text = translate("FemScalpel", "No longer follows %1: other numbers were entered.").replace("%1", self._name)
        self.targets, self._name, self._broken = [], "", False
        self._show(text)

    def look_again(self):
        """The geometry may be gone, or another. Returns whether that ends that it is followed."""
        try:
            if self.targets:
                axes_of(self.targets)
            is_broken = any(is_gone(part) for part, _ in self.targets)
        except ValueError:
            is_broken = True
        if is_broken:
            self.targets, self._broken = [], True
            self._show_name()
        return is_broken

    def error(self):
        """What is wrong with what is followed, "" when nothing is."""
        if not self._broken:
            return ""
        return translate(
            "FemScalpel",
            "%1, where this was picked, is not there any more or may be another one. Pick it again, or press Unlink: "
            "then the numbers stay.",
        ).replace("%1", self._name)

    def say_size(self, is_its):
        """Says whether the size is that of the geometry, too."""
        if self._name:
            self._show_name(is_its)

    def _end(self):
        self.start(())
        self._changed()

    def _show_name(self, with_size=False):
        text = translate("FemScalpel", "from %1, size included") if with_size else translate("FemScalpel", "from %1")
        self._show(text.replace("%1", self._name) if self._name else "")

    def _show(self, text):
        self._label.setText(text)
        self._label.setStyleSheet(f"QLabel {{ {fields.ERROR} padding: 3px; }}" if self._broken else "")
        self._unlink.setVisible(bool(self._name))
        self.row.setVisible(bool(text))


def vertex_at(click):
    """The place of the vertex of a part that a Click means, None where it is no such."""
    name = click.name.split(".")[-1]
    if click.on_mesh or not name.startswith("Vertex"):
        return None
    return shape_of(click.obj, name).Point
