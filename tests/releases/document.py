# SPDX-License-Identifier: LGPL-2.1-or-later
"""Saves a document with FemScalpel's objects, or opens documents that other releases of FreeCAD have saved, looks at
all of their objects, recomputes them and writes the solver's deck. What is in the file is taken until something
changes. Recomputed then, meshes may differ, as the compilers of other releases round otherwise; they must be as sound.
Run by 'freecadcmd document.py -M WORKBENCH', an absolute path; what it does is in the environment:

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


def same(before, after):
    """Whether both are the same but for rounding."""
    if before[1:] != after[1:] or before[0].shape != after[0].shape:
        return False
    return float(abs(before[0] - after[0]).max()) <= 1e-6 * float(np.ptp(before[0]))


def check_sound(obj, before, volume, worst):
    """What must hold of an object's mesh made anew, wherever it was made before with this volume and worst mean ratio:
    all groups are there, cracks and refinement keep the volume, and it is about as good."""
    after = content(obj)
    if set(after[1]) != set(before[1]) or any((after[1][name] == 0) != (n == 0) for name, n in before[1].items()):
        raise RuntimeError(f"{obj.Label}: the groups {before[1]} became {after[1]}")
    allowed = 1e-3 if obj.Proxy.Type == "FemScalpel::Drill" else 1e-9
    if abs(obj.FemMesh.Volume.Value - volume) > allowed * volume:
        raise RuntimeError(f"{obj.Label}: the volume {volume} became {obj.FemMesh.Volume.Value}")
    if obj.MinimumQuality < 0.5 * worst:
        raise RuntimeError(f"{obj.Label}: the smallest mean ratio was {worst}, and is {obj.MinimumQuality}")


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
    volumes = [obj.FemMesh.Volume.Value for obj in objects]
    worst = [obj.MinimumQuality for obj in objects]
    # Of documents of 0.20 FreeCAD 1 itself touches what is drawn by Part.
    touched = [obj for obj in document.Objects if "Touched" in obj.State]
    by_freecad = ", ".join(obj.Label for obj in touched)
    recomputed = document.recompute()
    if set(touched) & set(objects) or (recomputed and not touched):
        raise RuntimeError(f"{recomputed} objects recomputed though nothing changed")
    if not touched and not all(same(old, content(obj)) for obj, old in zip(objects, before)):
        raise RuntimeError("what was saved is not what is there")
    loads = check_loads(document)
    objects[0].Source.touch()
    for obj in objects:
        obj.touch()
    document.recompute()
    for obj, old, volume, quality in zip(objects, before, volumes, worst):
        if not obj.isValid():
            raise RuntimeError(f"{obj.Label} does not recompute: {obj.getStatusString()}")
        check_sound(obj, old, volume, quality)
    check_loads(document, loads)
    other = [obj.Label for obj, old in zip(objects, before) if not same(old, content(obj))]
    FreeCAD.closeDocument(document.Name)
    became = f"to other meshes as sound: {', '.join(other)}" if other else "to the same"
    kept = f"FreeCAD touched {by_freecad}" if touched else "as they were saved"
    return f"{len(objects)} objects, {kept}; touched, recomputed {became}; {loads[0]} nodes loaded, " f"{loads[1]} held"


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
