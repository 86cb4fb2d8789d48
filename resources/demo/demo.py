# SPDX-License-Identifier: LGPL-2.1-or-later
"""FemScalpel's demo: cracks a stiffener of a caisson, as shell and as solid model, and solves it before and after.

    demo.py [--quadrangles] OUTPUT_FOLDER

With --quadrangles, the shell model is of quadrangles instead of triangles. Started by run.sh, which builds the package
and gives the pictures a (virtual) display.
"""

import argparse
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import femscalpel as fs
import numpy as np

import calculix
import caisson
import pictures

# Crosses the hanger of STIFFENER_1 only: the plane rises above all other hangers and stays clear of the box.
PLANE = {"origin": (200, -50, 430), "normal": (-0.33, -0.30, 1)}
MAGNIFICATION = 200
# For shells ccx averages stresses over the thickness (OUTPUT=2D), so that bending cancels out.
STRESS_NAMES = {"solid": "von Mises stress", "shell": "von Mises stress, membrane part"}
WORKBENCH = Path(fs.__file__).resolve().parents[1]
start = time.monotonic()


def say(text: str) -> None:
    print(f"[{time.monotonic() - start:5.1f} s] {text}", flush=True)


def crack_file(source: Path, target: Path) -> tuple[fs.Mesh, fs.Result]:
    """What a user's script does: read, crack, write."""
    mesh = fs.read(source)
    result = fs.crack(mesh, fs.Plane(**PLANE), name="CRACK")
    fs.write(result.mesh, target)
    return mesh, result


def compare(
    before: calculix.Solution, after: calculix.Solution, mesh: fs.Mesh, cracked: fs.Mesh, stress_name: str
) -> list[str]:
    """Table of results before and after; raises RuntimeError where equilibrium says they cannot be right."""

    def largest(values, mesh, group=None):
        numbers = values if group is None else [n for n in mesh.groups[group].ids.tolist() if n in values]
        return max(float(np.linalg.norm(values[n])) for n in numbers)

    pairs = [
        ("largest displacement, mm", *(largest(s.displacement, m) for s, m in ((before, mesh), (after, cracked))), 4),
        (
            "largest displacement of GAUGE_FLOOR, mm",
            *(largest(s.displacement, m, "GAUGE_FLOOR") for s, m in ((before, mesh), (after, cracked))),
            4,
        ),
        (
            f"{stress_name} at GAUGE_HANGER_1, MPa",
            *(largest(s.von_mises(), m, "GAUGE_HANGER_1") for s, m in ((before, mesh), (after, cracked))),
            2,
        ),
        ("work of the loads, J", 2e-3 * before.energy, 2e-3 * after.energy, 3),
    ]
    for name in calculix.SUPPORT_NAMES:
        pairs.append(
            (f"vertical reaction at {name}, kN", before.reactions[name][2] / 1e3, after.reactions[name][2] / 1e3, 2)
        )
    total = [sum(s.reactions[n][2] for n in calculix.SUPPORT_NAMES) / 1e3 for s in (before, after)]
    pairs.append(("all supports, kN", *total, 2))
    if abs(total[1] - total[0]) > 1e-4 * total[0]:
        raise RuntimeError(
            f"the supports carry {total[0]} kN before and {total[1]} kN after: a load or support was lost"
        )
    if abs(after.reactions["SUPPORT_1"][2]) > 0.01 * before.reactions["SUPPORT_1"][2]:
        raise RuntimeError("SUPPORT_1 still carries load: the crack did not open")
    lines = [f"    {'':55} {'before':>10} {'after':>10}"]
    return lines + [f"    {label:55} {a:10.{digits}f} {b:10.{digits}f}" for label, a, b, digits in pairs]


def count_elements(mesh: fs.Mesh) -> str:
    """Elements of the body, as "6214 triangles"."""
    names = {"tetra": "tetrahedra"} if any(k.startswith("tetra") for k in mesh.cells) else {}
    names = names or {"quad": "quadrangles", "triangle": "triangles"}
    counts = {k.rstrip("0123456789"): len(ids) for k, ids in mesh.cell_ids.items()}
    return " and ".join(f"{counts[k]} {word}" for k, word in names.items() if counts.get(k))


def solve(decks: tuple[Path, Path], mesh: fs.Mesh, cracked: fs.Mesh, kind: str) -> list[calculix.Solution]:
    """Solves both decks and prints what they have in common; without CalculiX says so and returns nothing."""
    if not shutil.which("ccx"):
        say(f"{kind}: CalculiX (ccx) is not installed: nothing is solved, and not drawn how the crack opens")
        return []
    say(f"{kind}: ccx solves {' and '.join(path.name for path in decks)}")
    solutions = calculix.run(list(decks))
    print("\n" + "\n".join(compare(*solutions, mesh, cracked, STRESS_NAMES[kind])) + "\n", flush=True)
    return solutions


def run_variant(solid: bool, size: float, out: Path, quadrangles: bool = False) -> None:
    kind = "solid" if solid else "shell"
    say(f"{kind}: meshing the caisson with Gmsh")
    model = caisson.make_model(solid, size, order=2, quadrangles=quadrangles)
    mesh = fs.Mesh(model.points, model.cells, cell_ids=model.cell_ids, groups=model.groups, name=f"caisson_{kind}")
    mesh.unit = "mm"
    files = {
        suffix: (out / f"caisson_{kind}{suffix}", out / f"caisson_{kind}_cracked{suffix}")
        for suffix in (".med", ".inp", ".vtu")
    }
    fs.write(mesh, files[".med"][0])
    calculix.write_deck(model, files[".inp"][0])

    say(f"{kind}: read, crack, write {files['.med'][0].name}")
    mesh, result = crack_file(*files[".med"])
    for written, path in zip((mesh, result.mesh), files[".vtu"]):
        fs.write(written, path)
    report = result.report
    (out / f"caisson_{kind}_report.txt").write_text(report.to_text())
    report.to_csv(out / f"caisson_{kind}_groups.csv")
    print("\n" + "\n".join("    " + line for line in report.to_text().splitlines()))
    interface = len(report.node_sets["ICN"]) + len(report.node_sets["ECN"])
    print(
        f"    In the terms of the paper's Figure 10: {interface} nodes on the crack plane, "
        f"{report.constraints.get('plane', 0)} plane and {report.constraints.get('tangent plane', 0)} tangent-plane "
        f"constraints.\n"
    )

    say(f"{kind}: read, crack, write {files['.inp'][0].name}, a whole CalculiX deck")
    deck, cracked_deck = crack_file(*files[".inp"])
    if cracked_deck.report.nodes_added != report.nodes_added:
        raise RuntimeError(
            f"the crack added {report.nodes_added} nodes to the MED mesh, {cracked_deck.report.nodes_added} to the deck"
        )
    solutions = solve(files[".inp"], deck, cracked_deck.mesh, kind)

    say(f"{kind}: pictures")
    title = f"Caisson, {kind} model: {count_elements(result.mesh)}, {len(mesh.groups)} groups"
    drawn = [pictures.prepare(m) for m in (mesh, result.mesh)]
    pictures.mesh_picture(out / f"caisson_{kind}_groups.png", title, *drawn)
    if solutions:
        states = [
            (m, pictures.by_node(m, s.displacement), pictures.by_node(m, s.von_mises()))
            for m, s in zip(drawn, solutions)
        ]
        pictures.opened_picture(
            out / f"caisson_{kind}_opened.png", f"Caisson, {kind} model", states, MAGNIFICATION, STRESS_NAMES[kind]
        )
    pictures.quality_picture(
        out / f"caisson_{kind}_quality.png", f"Caisson, {kind} model: quality near the crack", report.quality
    )


def write_document(out: Path) -> None:
    """Makes caisson.FCStd with FreeCAD: both source meshes, and on each a parametric crack."""
    say("FreeCAD: caisson.FCStd with parametric cracks")
    environment = dict(os.environ, FEMSCALPEL_DEMO_OUTPUT=str(out), FEMSCALPEL_DEMO_PLANE=repr(PLANE))
    script = Path(__file__).with_name("make_document.py")
    # The script comes first: FreeCAD 0.20 hands the arguments before it to Python, which does not know -M.
    done = subprocess.run(
        ["freecadcmd", str(script), "-M", str(WORKBENCH)],
        env=environment,
        text=True,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        check=False,
    )
    (out / "freecad.log").write_text(done.stdout)
    if "document saved" not in done.stdout:
        raise RuntimeError("freecadcmd failed:\n" + done.stdout[-2000:])
    print(
        "\n".join("    " + line for line in done.stdout.splitlines() if line.startswith(("Shell", "Solid"))), flush=True
    )


def main() -> int:
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("output", type=Path)
    arguments.add_argument("--quadrangles", action="store_true")
    options = arguments.parse_args()
    out = options.output.resolve()
    out.mkdir(parents=True, exist_ok=True)
    print(f"FemScalpel {fs.__version__} demo; results go to {out}")
    run_variant(False, 36, out, options.quadrangles)
    run_variant(True, 27, out)
    write_document(out)
    say("done. Look at:")
    for path in sorted(out.iterdir()):
        if path.suffix in (".png", ".med", ".vtu", ".inp", ".FCStd", ".txt", ".csv"):
            print(f"    {path}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
