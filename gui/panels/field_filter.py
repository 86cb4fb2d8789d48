# SPDX-License-Identifier: LGPL-2.1-or-later
"""How the fields of the task panels take the mouse wheel and the Enter key."""

from PySide import QtCore, QtGui

from ..event_filter import EventFilter

_ENTER = (QtCore.Qt.Key_Return, QtCore.Qt.Key_Enter)
_CHANGING = (QtCore.Qt.Key_Backspace, QtCore.Qt.Key_Delete, QtCore.Qt.Key_Up, QtCore.Qt.Key_Down)


class FieldFilter(EventFilter):
    """Event filter of the fields of some forms.

    The wheel changes a field that has the focus only; else it scrolls the panel. Enter in a field in which something
    was typed confirms that; the next one is for the panel, whose OK it presses.
    """

    def __init__(self, forms):
        super().__init__()
        self._typed = None  # the field in which something was typed since it was confirmed
        for form in forms:
            for kind in (QtGui.QAbstractSpinBox, QtGui.QComboBox):
                for field in form.findChildren(kind):
                    field.setFocusPolicy(QtCore.Qt.StrongFocus)  # none by the wheel
                    field.installEventFilter(self)
            for field in form.findChildren(QtGui.QLineEdit):
                field.installEventFilter(self)

    def filtered(self, receiver, event):
        if event.type() == QtCore.QEvent.Wheel:
            if not isinstance(receiver, QtGui.QLineEdit) and not receiver.hasFocus():
                event.ignore()
                return True
        elif event.type() == QtCore.QEvent.KeyPress:
            field = receiver.parent() if isinstance(receiver.parent(), QtGui.QAbstractSpinBox) else receiver
            if event.key() not in _ENTER:
                if event.text().isprintable() and event.text() or event.key() in _CHANGING:
                    self._typed = field
            elif self._typed is field and not isinstance(field, QtGui.QComboBox):
                self._typed = None
                if isinstance(field, QtGui.QAbstractSpinBox):
                    field.interpretText()
                field.selectAll()
                return True
        elif event.type() == QtCore.QEvent.FocusOut:
            self._typed = None
        return False
