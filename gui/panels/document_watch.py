# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tells a panel what becomes of the document while it is open: undo, redo, the tree and macros go on."""

import FreeCAD
from PySide import QtCore

from femscalpelobjects import contents

_WAIT = 50  # milliseconds between two looks whether FreeCAD is done


def is_gone(obj):
    """Whether a document object is no longer in its document: deleted, or undone."""
    try:
        return obj.Document.getObject(obj.Name) != obj
    except (ReferenceError, RuntimeError, AttributeError, TypeError):
        return True


class DocumentWatch:
    """Calls `told(gone, stepped)` once FreeCAD is done with whatever has changed a document: whether objects are gone,
    and whether undo or redo have changed properties of the object `edited`, which may be None. Nothing is told of what
    happens while is_busy()."""

    def __init__(self, document, edited, told, is_busy):
        self._document, self._edited, self._told, self._is_busy = document, edited, told, is_busy
        self._gone = self._changed = self._stepped = self._is_waiting = False
        FreeCAD.addDocumentObserver(self)

    def close(self):
        """Listens no more."""
        FreeCAD.removeDocumentObserver(self)
        self._told = None

    def hurry(self):
        """Tells at once what there is to tell."""
        if self._is_waiting:
            self._tell()

    # What FreeCAD tells, of all documents, from within what it is doing.

    def slotDeletedObject(self, obj):
        if self._is_ours(obj.Document):
            self._gone = True
            self._soon()

    def slotChangedObject(self, obj, prop):
        if prop in contents.OF_CONTENTS:
            if self._is_ours(obj.Document):
                self._soon()
        elif obj == self._edited and obj.Document.Transacting and prop not in contents.ASIDE - {"ExpressionEngine"}:
            self._changed = self._changed or obj.getGroupOfProperty(prop) != "Result"

    def slotUndoDocument(self, document):
        if self._is_ours(document):
            self._stepped = self._stepped or self._changed
            self._changed = False
            self._soon()

    slotRedoDocument = slotUndoDocument

    def slotAbortTransaction(self, document):
        self._changed = False

    def _is_ours(self, document):
        return self._told is not None and document == self._document and not self._is_busy()

    def _soon(self):
        if not self._is_waiting:
            self._is_waiting = True
            QtCore.QTimer.singleShot(0, self._tell)

    def _tell(self):
        self._is_waiting = False
        if self._told is None:
            return
        try:
            if self._document.Recomputing or self._document.Transacting or self._is_busy():
                self._is_waiting = True
                QtCore.QTimer.singleShot(_WAIT, self._tell)
                return
        except ReferenceError:  # it was closed
            return
        gone, stepped = self._gone, self._stepped
        self._gone = self._stepped = False
        self._told(gone, stepped)
