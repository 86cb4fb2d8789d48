# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run by demo.py in freecadcmd: a document with the caisson's meshes, cracked by parametric objects in analyses, and
with a stiffener added to one."""

import ast
import os
import traceback

import FreeCAD
import ObjectsFem
import ObjectsFemScalpel
import femmesh_bridge
import femscalpel
import numpy as np


def stiffener():
    """A shell plate of 320 x 60, to stand on the caisson's roof."""
    x, z = (a.ravel() for a in np.meshgrid(np.linspace(0, 320, 10), np.linspace(0, 60, 3), indexing="ij"))
    corners = [(3 * i + j, 3 * i + j + 3, 3 * i + j + 4, 3 * i + j + 1) for i in range(9) for j in range(2)]
    triangles = [t for a, b, c, d in corners for t in ((a, b, c), (a, c, d))]
    return femscalpel.Mesh(np.column_stack([x, 0 * x, z]), {"triangle": triangles})


def add_stiffener(doc, crack):
    """The cracked shell with a stiffener on its roof, as a parametric object; moving the stiffener's placement moves
    it."""
    plate = doc.addObject("Fem::FemMeshObject", "Stiffener")
    plate.FemMesh = femmesh_bridge.to_femmesh(stiffener())
    plate.Placement = FreeCAD.Placement(FreeCAD.Vector(233, 247, 348), FreeCAD.Rotation())
    merge = ObjectsFemScalpel.makeMerge(doc, crack, plate, name="ShellStiffened", group_name="RIB")
    doc.recompute()
    print(f"\nShell, stiffened: {merge.FemMesh.NodeCount} nodes, {merge.FemMesh.GroupCount} groups")
    if merge.FemMesh.NodeCount <= crack.FemMesh.NodeCount:
        raise RuntimeError(f"{merge.Label} was not computed: {merge.getStatusString()}")


def main():
    out = os.environ["FEMSCALPEL_DEMO_OUTPUT"]
    plane = ast.literal_eval(os.environ["FEMSCALPEL_DEMO_PLANE"])
    doc = FreeCAD.newDocument("Caisson")
    for kind in ("Shell", "Solid"):
        source = doc.addObject("Fem::FemMeshObject", kind)
        source.FemMesh = femmesh_bridge.to_femmesh(femscalpel.read(os.path.join(out, f"caisson_{kind.lower()}.med")))
        analysis = ObjectsFem.makeAnalysis(doc, kind + "Analysis")
        analysis.addObject(source)
        crack = ObjectsFemScalpel.makeCrack(doc, source, name=kind + "Crack", **plane)
        doc.recompute()
        ObjectsFemScalpel.putIntoAnalysis(crack)
        print(
            f"\n{kind}: {source.FemMesh.NodeCount} nodes, {source.FemMesh.GroupCount} groups; cracked: "
            f"{crack.FemMesh.NodeCount} nodes, {crack.FemMesh.GroupCount} groups, in {analysis.Label}"
        )
        if crack.FemMesh.NodeCount <= source.FemMesh.NodeCount:
            raise RuntimeError(f"{crack.Label} was not computed: {crack.State}")
        if kind == "Shell" and not source.FemMesh.QuadrangleCount:  # shells are merged where they are triangles
            add_stiffener(doc, crack)
    doc.saveAs(os.path.join(out, "caisson.FCStd"))
    print("\ndocument saved")


try:
    main()
except Exception:
    traceback.print_exc()
