# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run by demo.py in freecadcmd: a document with the caisson's meshes, cracked by parametric objects in analyses."""

import ast
import os
import traceback

import FreeCAD
import ObjectsFem
import ObjectsFemScalpel
import femmesh_bridge
import femscalpel


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
    doc.saveAs(os.path.join(out, "caisson.FCStd"))
    print("\ndocument saved")


try:
    main()
except Exception:
    traceback.print_exc()
