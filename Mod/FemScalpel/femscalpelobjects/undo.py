# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes meshes follow undo, redo and aborted transactions.

FreeCAD does not put the old mesh back: a FemMesh given to an object overwrites the one the transaction has kept (seen
with 0.20.2). The other properties do come back. So whenever an object's inputs are no longer those its mesh was made
from, it is recomputed.
"""

import FreeCAD

from .group_names import follow_all
from .ours import is_ours, made_of

# Not inputs.
_ASIDE = {
    "FemMesh",
    "Label",
    "Label2",
    "Visibility",
    "ExpressionEngine",
    "Placement",
    "Proxy",
    "Replaced",
    "ReplacedAdditions",
}


def _inputs(obj):
    """The values of the properties the mesh depends on, and the placements of what it is made from, comparable."""
    values = {
        name: obj.dumpPropertyContent(name)
        for name in obj.PropertiesList
        if name not in _ASIDE and obj.getGroupOfProperty(name) != "Result"
    }
    return {**values, "placements": [mesh.dumpPropertyContent("Placement") for mesh in made_of(obj)]}


class _Watch:
    """Document observer; knows what every object's mesh was made from."""

    def __init__(self):
        self._made_from = {}

    def _key(self, obj):
        return obj.Document.Name, obj.Name

    def slotRecomputedObject(self, obj):
        if is_ours(obj):
            self._made_from[self._key(obj)] = _inputs(obj)

    def slotOpenTransaction(self, document, name):
        # Objects of a loaded document were never recomputed here; their meshes are up to date.
        for obj in document.Objects:
            if is_ours(obj) and self._key(obj) not in self._made_from and "Touched" not in obj.State:
                self._made_from[self._key(obj)] = _inputs(obj)

    def slotDeletedDocument(self, document):
        self._made_from = {key: value for key, value in self._made_from.items() if key[0] != document.Name}

    def _mend(self, document):
        follow_all(document)
        outdated = [
            o
            for o in document.Objects
            if is_ours(o) and self._made_from.get(self._key(o), None) not in (None, _inputs(o))
        ]
        for obj in outdated:
            obj.touch()
        if outdated:
            document.recompute(outdated + [o for obj in outdated for o in obj.InListRecursive])

    slotUndoDocument = slotRedoDocument = slotAbortTransaction = _mend


_watch = None


def start():
    """Starts watching, once."""
    global _watch
    if _watch is None:
        _watch = _Watch()
        FreeCAD.addDocumentObserver(_watch)
