# SPDX-License-Identifier: LGPL-2.1-or-later
"""Keeps what is under the mouse, or has the focus, where it is while messages come and go above it."""

import FreeCADGui
from PySide import QtCore, QtGui

# How often it is looked whether something has moved, and after how many milliseconds again: layouts settle one after
# the other, those of the task boxes last.
_LOOKS, _BETWEEN = 15, 10


class Steady:
    """Scrolls a panel by as much as the field under the mouse would move, so that a click meets what it was meant for.

    `forms`: those of the panel.
    """

    def __init__(self, forms):
        self._forms, self._held, self._left = forms, None, 0
        self._asking = None

    def hold(self):
        """To be called before messages come or go."""
        is_waiting = self._held is not None
        if not is_waiting:
            box = self._of_ours(QtGui.QApplication.widgetAt(QtGui.QCursor.pos()))
            box = box or self._of_ours(QtGui.QApplication.focusWidget())
            if box is None:
                return
            self._held = box, _height(box)
        self._left = _LOOKS
        if not is_waiting:
            QtCore.QTimer.singleShot(0, self._put_back)

    def show(self, question):
        """Sees to it that a widget that asks something, if it is there in the end, is in sight whatever is held."""
        self._asking = question
        self.hold()
        if self._held is None:
            QtCore.QTimer.singleShot(_LOOKS * _BETWEEN, self._bring_into_sight)

    def _bring_into_sight(self):
        question, self._asking = self._asking, None
        try:
            area = self._area() if question is not None and question.isVisible() and self._forms else None
        except RuntimeError:  # it is gone
            return
        if area is not None:
            area.ensureWidgetVisible(question, 0, 0)

    def _put_back(self):
        if self._held is None:
            return
        (box, height), self._left = self._held, self._left - 1
        try:
            moved = _height(box) - height if box.isVisible() else 0
        except RuntimeError:  # it is gone
            self._held = None
            return
        area = self._area() if moved else None
        if area is not None:
            area.verticalScrollBar().setValue(area.verticalScrollBar().value() + moved)
        if self._left > 0:
            QtCore.QTimer.singleShot(_BETWEEN, self._put_back)
        else:
            self._held = None
            self._bring_into_sight()

    def _of_ours(self, box):
        return box if box is not None and any(form.isAncestorOf(box) for form in self._forms) else None

    def _area(self):
        areas = FreeCADGui.getMainWindow().findChildren(QtGui.QScrollArea)
        return next((area for area in areas if area.isVisible() and area.isAncestorOf(self._forms[0])), None)

    def close(self):
        """Looks no more."""
        self._forms, self._held = [], None


def _height(box):
    return box.mapToGlobal(QtCore.QPoint(0, 0)).y()
