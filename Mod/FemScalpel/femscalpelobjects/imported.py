# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mesh objects made of files, with groups and with what a FemMesh does not hold: see whole.py."""

import os
import warnings

import FreeCAD
import Fem

import femmesh_bridge
import femscalpel

from . import whole
from .analysis import transaction
from .said import said


def read(path, mesh=None, femmesh=None, progress=None):
    """(femscalpel.Mesh, Fem.FemMesh, sentences about what to know) of a file; can be called on any thread.

    `femmesh`: an empty one to fill; progress(fraction) may raise. Raises femscalpel.ReadError, or
    femscalpel.WriteError where a FemMesh cannot hold the elements.
    """
    kept = []
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        out = femscalpel.read(path, mesh)
    femmesh = femmesh_bridge.to_femmesh(out, into=femmesh or Fem.FemMesh(), progress=progress, tell=kept.append)
    sentences = [str(w.message) for w in told]
    if out.has_deck and not out.instances:
        sentences += [text for text in out.input_warnings if not any(text in told for told in sentences)]
    if kept:
        sentences.append(
            "not in FreeCAD's mesh, but kept with it for operations and export: "
            + "; ".join(k.split(" left out", 1)[0].removesuffix(" are").removesuffix(" is") for k in kept)
        )
    return out, femmesh, sentences


def add(doc, path, mesh, femmesh, sentences, name=None):
    """The new mesh object of what read() has read, as one step to undo."""
    stem = os.path.basename(path).split(".")[0]
    with transaction(doc, f"Import {os.path.basename(path)}"):
        obj = doc.addObject("Fem::FemMeshObject", name or stem or "Mesh")
        try:
            obj.Label = name or stem
            whole.keep(obj, mesh)
            obj.FemMesh = femmesh
        except Exception:
            doc.removeObject(obj.Name)
            raise
    tell(obj, sentences)
    obj.purgeTouched()
    return obj


def tell(obj, sentences):
    """Says in the report view what there is to know of a mesh object's file."""
    for sentence in sentences:
        FreeCAD.Console.PrintWarning(f"{obj.Label}: {said(sentence)}\n")


def export(obj, path):
    """Writes the mesh of an object, the whole of it where it was imported. Returns sentences about what the file does
    not hold; can be called on any thread. Raises as femscalpel.write()."""
    entire = whole.whole_of(obj)
    sentences = []
    if entire is None and whole.of_imported(obj):
        sentences.append(
            "the mesh is not the one that was imported any more: what the file held beside nodes, elements and groups "
            "(a deck's cards, fields, groups of element faces) is not written"
        )
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        femscalpel.write(femmesh_bridge.from_femmesh(obj.FemMesh) if entire is None else entire, path)
    return sentences + [str(w.message) for w in told]
