# SPDX-License-Identifier: LGPL-2.1-or-later
"""Gives objects of FemScalpel their view provider that have none: those of documents saved without a window, such as
by freecadcmd, or by a FreeCAD whose window did not know FemScalpel."""

import FreeCAD
from PySide import QtCore

_observers = []  # kept, as FreeCAD holds no reference


def watch():
    """Does so from now on whenever a document is opened."""
    if not _observers:
        _observers.append(_Opened())
        FreeCAD.addDocumentObserver(_observers[0])


class _Opened:
    """Document observer. FreeCAD has no word for the end of opening; a new document is looked at once it is whole."""

    def slotCreatedDocument(self, document):
        name = document.Name
        QtCore.QTimer.singleShot(0, lambda: self._look(name))

    def _look(self, name):
        document = FreeCAD.listDocuments().get(name)
        if document is not None and document.Restoring:
            QtCore.QTimer.singleShot(50, lambda: self._look(name))
        elif document is not None:
            attach(document)


def attach(document):
    """Does so for the objects of a document. It counts as unchanged, as what is seen of it alone is another."""
    bare = [obj for obj in document.Objects if "NodeSetCounts" in obj.PropertiesList and _is_bare(obj)]
    if not bare:
        return
    # Only now, as FreeCAD's start should not wait for it.
    from femscalpelobjects.ours import is_ours

    from .mesh_operation import ViewProviderMeshOperation

    for obj in filter(is_ours, bare):
        ViewProviderMeshOperation(obj.ViewObject)
        obj.ViewObject.signalChangeIcon()


def _is_bare(obj):
    proxy = getattr(obj.ViewObject, "Proxy", None)
    return obj.ViewObject is not None and (proxy is None or isinstance(proxy, int))  # what FreeCAD begins with
