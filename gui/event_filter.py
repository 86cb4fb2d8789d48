# SPDX-License-Identifier: LGPL-2.1-or-later
"""The base of all event filters."""

from PySide import QtCore, QtGui

_CLASSES = {
    QtCore.QEvent.KeyPress: QtGui.QKeyEvent,
    QtCore.QEvent.ShortcutOverride: QtGui.QKeyEvent,
    QtCore.QEvent.Shortcut: QtGui.QShortcutEvent,
    QtCore.QEvent.WhatsThisClicked: QtGui.QWhatsThisClickedEvent,
}


class EventFilter(QtCore.QObject):
    """Event filter whose `filtered(receiver, event)` says whether the event ends there.

    PySide 2 at times hands over an object of another class, one that was at the same place in memory before. Such
    events go on as if there were no filter.
    """

    def eventFilter(self, receiver, event):
        if not isinstance(event, QtCore.QEvent) or not isinstance(receiver, QtCore.QObject):
            return False
        if not isinstance(event, _CLASSES.get(event.type(), QtCore.QEvent)):
            return False
        return self.filtered(receiver, event)

    def filtered(self, receiver, event):
        raise NotImplementedError
