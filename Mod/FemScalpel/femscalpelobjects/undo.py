# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes meshes follow undo, redo and aborted transactions.

FreeCAD does not put the old mesh back: a FemMesh given to an object overwrites the one the transaction has kept (seen
with 0.20.2). The other properties do come back. So whenever an object's inputs are no longer those its mesh was made
from, it gets the mesh it had with these inputs, from memory. Where that does not have it any more the object is
computed again: in the window when that is idle; without one, at the next recompute.
"""

import FreeCAD

from . import contents
from .group_names import follow_all
from .memory import CLEARED, Shown, memory
from .ours import is_ours, made_of

if FreeCAD.GuiUp:
    from femscalpelgui import signs
    from femscalpelgui.idle import hold_shortcuts, release_shortcuts, when_idle
    from femscalpelgui.translate import translate


def mend(document):
    """Gives the objects of a document the meshes that go with their inputs. Returns those that memory has none for:
    they are touched."""
    follow_all(document)
    unknown, waiting = [], []
    for obj in _in_order(document):
        shown = obj.Proxy.shown
        if any(mesh in waiting for mesh in made_of(obj)):
            waiting.append(obj)
            continue
        if shown is None:
            continue
        inputs = contents.inputs_of(obj)
        if _waits(obj):
            _unmark(obj)
            continue
        if shown.inputs == inputs:
            if "Touched" in obj.State and "Invalid" not in obj.State:
                obj.purgeTouched()  # it is what FreeCAD has put back that has touched it
            continue
        made = memory.of(document, inputs)
        if made is None:
            obj.touch()
            unknown.append(obj)
            waiting.append(obj)
        else:
            obj.Proxy.give_back(obj, made)
    _describe_again(document)
    return unknown


def _describe_again(document):
    """Has what holds the pieces of parted meshes said as it is now."""
    for obj in _in_order(document):
        if not {"Touched", "Invalid"} & set(obj.State):
            obj.Proxy.describe_again(obj)


def _is_at_rest(document):
    return not (document.Transacting or document.Restoring or document.Recomputing)


def _waits(obj):
    """Whether what an object is made from has no mesh, as an operation that cannot be computed."""
    return any(is_ours(mesh) and not mesh.FemMesh.NodeCount for mesh in made_of(obj))


def _unmark(obj):
    """Takes away an error of an object that waits, which is of what was before: FreeCAD does not compute what depends
    on something that has failed, and the state of a document must not depend on how it came about."""
    if "Invalid" in obj.State:
        obj.Proxy.give_back(obj, CLEARED)
        obj.touch()


def _mend_and_compute(document):
    unknown = mend(document)
    if unknown:
        document.recompute(unknown + [o for obj in unknown for o in obj.InListRecursive])


def _in_order(document):
    """The objects of FemScalpel, each behind those its mesh is made from."""
    found = {}

    def add(obj):
        for mesh in made_of(obj):
            if mesh.Name not in found:
                add(mesh)
        if is_ours(obj):
            found[obj.Name] = obj

    for obj in document.Objects:
        add(obj)
    return list(found.values())


def _sign():
    return translate("FemScalpel", "FreeCAD takes the mesh over…")


class _Watch:
    """Document observer."""

    _is_signed = False  # whether the user is told that this takes a while

    def slotOpenTransaction(self, document, name):
        # Objects of a loaded document were never computed here; their meshes are up to date.
        for obj in _in_order(document):
            if obj.Proxy.shown is None and "Touched" not in obj.State and obj.FemMesh.NodeCount:
                obj.Proxy.shown = Shown(contents.inputs_of(obj), contents.unique(), loaded=True)

    def slotBeforeChangeObject(self, obj, prop):
        if prop == "FemMesh" and FreeCAD.GuiUp and obj.Document.Transacting and not self._is_signed:
            mesh = obj.FemMesh
            if mesh.NodeCount + mesh.FaceCount + mesh.VolumeCount > signs.QUICK:
                self._is_signed = True  # FreeCAD draws it as it was, then mend() as it is to be
                signs.begin(_sign())

    def slotChangedObject(self, obj, prop):
        if prop == "Group" and obj.isDerivedFrom("Fem::FemAnalysis") and _is_at_rest(obj.Document):
            _describe_again(obj.Document)
        if prop not in contents.OF_CONTENTS:
            return
        contents.forget(obj)
        if prop == "FemMesh" and is_ours(obj) and not obj.Proxy.is_giving and not obj.Document.Transacting:
            obj.Proxy.shown = None  # somebody else's

    def slotDeletedObject(self, obj):
        contents.forget(obj)

    def slotDeletedDocument(self, document):
        contents.forget_document(document)
        memory.forget(document)

    def slotBeforeRecomputeDocument(self, document):
        if FreeCAD.GuiUp and any(map(is_ours, document.Objects)):
            hold_shortcuts(document)

    def slotRecomputedDocument(self, document):
        for obj in _in_order(document):
            if _waits(obj):
                _unmark(obj)
        _describe_again(document)
        if FreeCAD.GuiUp:
            release_shortcuts()

    def _follow(self, document):
        try:
            unknown = None if document.Recomputing else mend(document)
        finally:
            if self._is_signed:
                self._is_signed = False
                signs.end(_sign())
        if unknown == []:
            return
        if FreeCAD.GuiUp:
            when_idle(document, _mend_and_compute)
        else:
            for obj in unknown or ():
                FreeCAD.Console.PrintWarning(f"{obj.Label}: its mesh follows at the next recompute\n")

    slotUndoDocument = slotRedoDocument = slotAbortTransaction = _follow


_watch = None


def start():
    """Starts watching, once."""
    global _watch
    if _watch is None:
        _watch = _Watch()
        FreeCAD.addDocumentObserver(_watch)
