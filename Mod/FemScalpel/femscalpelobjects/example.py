# SPDX-License-Identifier: LGPL-2.1-or-later
"""The example model: the caisson of the demo."""

import os

import FreeCAD
import ObjectsFem
import numpy as np

import femmesh_bridge
import femscalpel

PATH = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "resources", "examples", "caisson.npz")


def _read():
    """The femscalpel.Mesh that resources/demo/make_example.py has written."""
    cells, cell_ids, groups = {}, {}, {}
    with np.load(PATH) as arrays:
        for key in arrays.files:
            what, *names = key.split(" ", 2)
            if what == "cells":
                cells[names[0]] = arrays[key]
            elif what == "ids":
                cell_ids[names[0]] = arrays[key]
            elif what == "group":
                groups[names[1]] = names[0], arrays[key]
        return femscalpel.Mesh(arrays["points"], cells, cell_ids=cell_ids, groups=groups, name="caisson")


def open_example():
    """Makes a document "Caisson" with the mesh in an analysis, and returns it. Raises FileNotFoundError without the
    file."""
    mesh = femmesh_bridge.to_femmesh(_read())
    doc = FreeCAD.newDocument("Caisson")
    obj = doc.addObject("Fem::FemMeshObject", "Caisson")
    obj.FemMesh = mesh
    ObjectsFem.makeAnalysis(doc, "Analysis").addObject(obj)
    doc.recompute()
    doc.clearUndos()
    return doc
