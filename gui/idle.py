# SPDX-License-Identifier: LGPL-2.1-or-later
"""What waits until FreeCAD is idle: work on a document, and shortcuts that are pressed while one is computed.

FreeCAD handles events while it computes a document. Key presses it drops then, but not shortcuts: undo would take
objects away that are being computed.
"""

import FreeCAD
from PySide import QtCore, QtGui

from .event_filter import EventFilter

_WAIT = 50  # milliseconds between two looks whether FreeCAD is idle

_waiting = {}  # work by name of the document


def when_idle(document, work):
    """Calls work(document) once nothing is computed and no transaction is open; once, however often it is asked."""
    if not _waiting:
        QtCore.QTimer.singleShot(0, _work)
    _waiting[document.Name] = work


def _work():
    try:
        for name in list(_waiting):
            document = FreeCAD.listDocuments().get(name)
            if document is None:
                del _waiting[name]
            elif not _is_busy(document):
                _waiting.pop(name)(document)
    finally:
        if _waiting:
            QtCore.QTimer.singleShot(_WAIT, _work)


def _is_busy(document):
    return (
        any(other.Recomputing for other in FreeCAD.listDocuments().values())
        or document.Transacting
        or document.HasPendingTransaction
        or bool(FreeCAD.getActiveTransaction())
    )


def _is_computed(document):
    try:
        return document.Recomputing
    except ReferenceError:  # it is closed
        return False


def hold_shortcuts(document):
    """Shortcuts that are pressed from now on wait for release_shortcuts(), or until the document is no longer
    computed."""
    _holder.start(document)


def release_shortcuts():
    """Does what the shortcuts say that have waited."""
    _holder.stop()


class _Holder(EventFilter):
    def __init__(self):
        super().__init__()
        self._document = None
        self._held = []

    def start(self, document):
        if self._document is None:
            QtGui.QApplication.instance().installEventFilter(self)
        self._document = document

    def stop(self):
        if self._document is not None:
            QtGui.QApplication.instance().removeEventFilter(self)
            self._document = None
        if self._held:
            QtCore.QTimer.singleShot(0, self._send)

    def filtered(self, receiver, event):
        if event.type() != QtCore.QEvent.Shortcut:
            return False
        if not _is_computed(self._document):  # FreeCAD has not said that it ended
            self.stop()
            return False
        self._held.append((receiver, event.key(), event.shortcutId()))
        return True

    def _send(self):
        held, self._held = self._held, []
        for receiver, key, number in held:
            try:
                QtGui.QApplication.postEvent(receiver, QtGui.QShortcutEvent(key, number))
            except RuntimeError:  # a widget that is gone by now
                pass


_holder = _Holder()
