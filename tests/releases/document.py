# SPDX-License-Identifier: LGPL-2.1-or-later
"""Saves a document with FemScalpel's objects, or opens documents that other releases of FreeCAD have saved, looks at
all of their objects, recomputes them and writes the solver's deck. Run by 'freecadcmd document.py -M WORKBENCH', an
absolute path; what it does is in the environment:

    SAVE=document.FCStd           makes and saves it
    OPEN=a.FCStd:b.FCStd          opens these; prints a line each, which begins with "document: "
"""

import os
import tempfile
import traceback
from pathlib import Path

import FreeCAD
import numpy as np


def made(document):
    """The objects whose mesh FemScalpel makes, each with what it depends on before it."""
    return [o for o in document.Objects if "NodeSetCounts" in o.PropertiesList]


def content(obj):
    """What must be the same of a mesh in all releases: coordinates, sorted, and how much is in which group."""
    femmesh = obj.FemMesh
    points = np.array([tuple(point) for point in femmesh.Nodes.values()])
    groups = {femmesh.getGroupName(g): len(femmesh.getGroupElements(g)) for g in femmesh.Groups}
    return points[np.lexsort(points.T.round(6))], groups, femmesh.VolumeCount, femmesh.FaceCount


def check_same(before, after, what):
    """Raises unless both are the same but for rounding."""
    if before[1:] != after[1:] or before[0].shape != after[0].shape:
        raise RuntimeError(f"{what}: {before[0].shape, before[1:]} became {after[0].shape, after[1:]}")
    worst = float(abs(before[0] - after[0]).max())
    if worst > 1e-6 * float(np.ptp(before[0])):
        raise RuntimeError(f"{what}: nodes are {worst} off")


def deck_of(document):
    """The lines of the deck that FreeCAD writes for CalculiX."""
    from femtools import ccxtools

    solver = next(o for o in document.Analysis.Group if "Solver" in o.TypeId)
    with tempfile.TemporaryDirectory() as folder:
        tools = ccxtools.FemToolsCcx(document.Analysis, solver)
        tools.update_objects()
        tools.setup_working_dir(folder)
        if message := tools.check_prerequisites():
            raise RuntimeError(message)
        tools.write_inp_file()
        return Path(tools.inp_file_name).read_text().splitlines()


def loads_in(deck):
    """Number of loaded and of held nodes, and the sum of the loads."""
    section, loaded, held, total = "", set(), 0, np.zeros(3)
    for line in deck:
        if line.startswith("**") or not line.strip():
            continue
        if line.startswith("*"):
            section = line.upper()
        elif section.startswith("*CLOAD"):
            node, direction, value = line.split(",")[:3]
            loaded.add(node)
            total[int(direction) - 1] += float(value)
        elif section.startswith("*NSET") and "FIXED" in section:
            held += len([number for number in line.split(",") if number.strip()])
    return len(loaded), held, total


def check_loads(document, before=None):
    """What is loaded and held in the deck; it must be something, and as `before`, where that is given."""
    loaded, held, total = loads_in(deck_of(document))
    if not loaded or not held or not abs(total).max() > 0:
        raise RuntimeError(f"the deck has {loaded} loaded nodes, {held} held ones, and the load {total}")
    if before and (before[:2] != (loaded, held) or abs(before[2] - total).max() > 1e-6 * abs(total).max()):
        raise RuntimeError(f"loaded, held, load: {before} became {(loaded, held, total)}")
    return loaded, held, total


def save(path):
    """FreeCAD's cantilever with a crack in its analysis, refined further, and with a hole instead of the crack."""
    from femexamples import ccx_cantilever_faceload

    import ObjectsFemScalpel

    document = FreeCAD.newDocument("Document")
    ccx_cantilever_faceload.setup(document, "ccxtools")
    document.recompute()
    source = document.Mesh
    crack = ObjectsFemScalpel.makeCrack(document, source, origin=(4100, 500, 520), normal=(0.3, 0.1, 1))
    ObjectsFemScalpel.makeDrill(document, source, origin=(4000, 500, 0), axis=(0, 0, 1), radius=150)
    document.recompute()
    ObjectsFemScalpel.makeRefine(document, crack, origin=(4000, 500, 0), axis=(0, 0, 1), radius=150, size=300)
    document.recompute()
    ObjectsFemScalpel.putIntoAnalysis(crack)
    document.recompute()
    wrong = [f"{o.Label}: {o.getStatusString()}" for o in document.Objects if not o.isValid()]
    if wrong:
        raise RuntimeError("; ".join(wrong))
    check_loads(document)
    document.saveAs(path)
    print(f"\ndocument: saved {len(made(document))} objects", flush=True)


def look_at(path):
    """Opens, recomputes, writes the deck; returns what is to be said."""
    document = FreeCAD.openDocument(path)
    objects = made(document)
    if len(objects) != 3:
        raise RuntimeError(f"{len(objects)} objects instead of 3")
    for obj in objects:
        if not getattr(obj.Proxy, "Type", "").startswith("FemScalpel::"):
            raise RuntimeError(f"{obj.Label} has lost what it is: its Proxy is {obj.Proxy!r}")
        if not obj.isValid() or not obj.NodesDoubled and obj.Proxy.Type == "FemScalpel::Crack":
            raise RuntimeError(f"{obj.Label}: {obj.getStatusString()}")
    before = [content(obj) for obj in objects]
    loads = check_loads(document)
    objects[0].Source.touch()
    for obj in objects:
        obj.touch()
    document.recompute()
    for obj, old in zip(objects, before):
        if not obj.isValid():
            raise RuntimeError(f"{obj.Label} does not recompute: {obj.getStatusString()}")
        check_same(old, content(obj), obj.Label)
    check_loads(document, loads)
    FreeCAD.closeDocument(document.Name)
    return f"{len(objects)} objects, recomputed to the same; {loads[0]} nodes loaded, {loads[1]} held"


def main():
    release = ".".join(FreeCAD.Version()[:3]).split(" ")[0]
    if "SAVE" in os.environ:
        save(os.environ["SAVE"])
    for path in filter(None, os.environ.get("OPEN", "").split(":")):
        try:
            print(f"\ndocument: FreeCAD {release}: {Path(path).stem}: {look_at(path)}", flush=True)
        except Exception as error:
            traceback.print_exc()
            print(f"\ndocument: FreeCAD {release}: {Path(path).stem}: FAILED: {error}", flush=True)


try:
    main()
except BaseException:
    traceback.print_exc()
os._exit(0)
