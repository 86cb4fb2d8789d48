#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Times FemMesh -> crack -> FemMesh in FreeCAD, and the recomputation of a crack object, on the reference crack.

Run by Python, starts FreeCADCmd on itself. Prints the seconds of processor time (user and system) of each step.
"""

import argparse
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

ORIGIN, NORMAL = (7.3, 5, 5), (0.9, 0.3, 0.2)


def main():
    build = pathlib.Path(__file__).resolve().parents[2] / "build" / "release"
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("mesh", nargs="?", default=build / "tests" / "meshes" / "two_boxes_505k.inp")
    parser.add_argument("--workbench", default=build / "Mod" / "FemScalpel")
    parser.add_argument("--freecadcmd", default="freecadcmd")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as home:
        times = pathlib.Path(home) / "times.txt"
        environment = {
            **os.environ,
            "FREECAD_USER_HOME": home,
            "PYTHONPATH": str(arguments.workbench),
            "FEMSCALPEL_BENCH_MESH": str(arguments.mesh),
            "FEMSCALPEL_BENCH_TIMES": str(times),
        }
        # FreeCAD prints a line per group; what is measured goes to a file of its own.
        done = subprocess.run(
            [arguments.freecadcmd, __file__],
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
        )
        if not times.exists() or not times.read_text().endswith("done\n"):
            sys.exit(f"{done.stdout[-3000:]}\nFreeCAD did not finish (exit status {done.returncode})")
        print(times.read_text().removesuffix("done\n"), end="")


def measure():
    import FreeCAD
    import ObjectsFemScalpel
    import femmesh_bridge
    import femscalpel

    def processor_time():
        used = resource.getrusage(resource.RUSAGE_SELF)
        return used.ru_utime + used.ru_stime

    lines, last = [], processor_time()

    def lap(step):
        nonlocal last
        seconds, last = processor_time() - last, processor_time()
        lines.append(f"{step:<40} {seconds:6.2f} s\n")
        return seconds

    mesh = femscalpel.read(os.environ["FEMSCALPEL_BENCH_MESH"])
    femmesh = femmesh_bridge.to_femmesh(mesh)
    lines.append(f"{len(mesh.cells['tetra'])} tetrahedra\n")
    last = processor_time()
    converted = femmesh_bridge.from_femmesh(femmesh)
    total = lap("FemMesh -> mesh")
    result = femscalpel.crack(converted, femscalpel.Plane(ORIGIN, NORMAL))
    total += lap("crack")
    femmesh_bridge.to_femmesh(result.mesh)
    total += lap("mesh -> FemMesh")
    lines.append(f"{'in all':<40} {total:6.2f} s\n")

    document = FreeCAD.newDocument()
    source = document.addObject("Fem::FemMeshObject", "Source")
    source.FemMesh = femmesh
    crack = ObjectsFemScalpel.makeCrack(document, source, origin=ORIGIN, normal=NORMAL)
    last = processor_time()
    document.recompute()
    lap("crack object, first recomputation")
    for k in range(1, 3):
        placement = crack.PlanePlacement
        placement.Base = FreeCAD.Vector(ORIGIN[0] + 0.1 * k, *ORIGIN[1:])
        crack.PlanePlacement = placement
        last = processor_time()
        document.recompute()
        lap("crack object, plane moved")
    if crack.NodesDoubled == 0:
        raise RuntimeError("the crack object has no crack")
    measure_comparison(mesh, lap)
    pathlib.Path(os.environ["FEMSCALPEL_BENCH_TIMES"]).write_text("".join(lines) + "done\n")


def measure_comparison(mesh, lap):
    """What it takes to see that a FemMesh is still that of an imported mesh with 50 groups."""
    import femmesh_bridge
    from femscalpelobjects import whole

    elements = mesh.cell_ids["tetra"]
    for k in range(25):
        mesh.add_group(f"ELEMENTS_{k}", "element", elements[k * len(elements) // 25 : (k + 1) * len(elements) // 25])
        mesh.add_group(f"NODES_{k}", "node", mesh.node_ids[k::10])
    femmesh = femmesh_bridge.to_femmesh(mesh)
    lap("50 groups more")
    is_same = whole.is_shown(mesh, femmesh)
    lap("nodes and elements compared")
    is_same = whole.has_groups_of(mesh, femmesh) and is_same
    lap("groups compared")
    if not is_same:
        raise RuntimeError("the FemMesh is not taken for that of its mesh")


if "FEMSCALPEL_BENCH_TIMES" in os.environ:
    try:
        measure()
    except BaseException:
        import traceback

        traceback.print_exc()
else:
    main()
