# SPDX-License-Identifier: LGPL-2.1-or-later
"""CalculiX's own decks of hexahedra (Debian package calculix-ccx-test), cracked a third through and solved, with
the steps and loads they come with, beside the same decks not cracked.

    PYTHONPATH=build/release/Mod/FemScalpel /usr/bin/python3 tests/python/hexahedral_decks.py [NAME ...]

All decks that hold a C3D8 or C3D20 of any kind, or those named. Of each: the elements converted, the nodes doubled, the
smallest mean ratio near the crack, the steps with reactions, and how far the sums of the supports' reactions are from
those of the deck as it comes, relative to the largest. Where a displacement or a temperature is prescribed, a crack
changes what it takes to hold it.
"""

import gzip
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import femscalpel as fs

DECKS = Path("/usr/share/doc/calculix-ccx-test/examples/test")
#: Procedures whose steps end in equilibrium with what acts at their end, by what CalculiX prints of supports.
PROCEDURES = {"*STATIC": "RF", "*VISCO": "RF", "*HEAT TRANSFER": "RFL", "*COUPLED TEMPERATURE-DISPLACEMENT": "RF"}
#: How far the crack reaches, relative to the width.
DEPTH = 0.35
HELD = "HELD_NODES"


def deck_text(name):
    path = next(p for p in (DECKS / f"{name}.inp", DECKS / f"{name}.inp.gz") if p.exists())
    return gzip.open(path, "rt").read() if path.suffix == ".gz" else path.read_text()


def names_of_all():
    """Decks with hexahedra."""
    pattern = re.compile(r"^\*ELEMENT\b.*TYPE *= *C3D(8|20)", re.IGNORECASE | re.MULTILINE)
    names = sorted(p.name.split(".")[0] for p in (*DECKS.glob("*.inp"), *DECKS.glob("*.inp.gz")))
    return [n for n in names if pattern.search(deck_text(n))]


def keyword(line):
    """Of a card, in capitals with single blanks; nothing of other lines."""
    return " ".join(line.split(",")[0].upper().split()) if line.startswith("*") and line[1:2] != "*" else ""


def held_nodes(lines):
    """What stands in front of the degrees of freedom of all *BOUNDARY cards: numbers and names of sets."""
    found, inside = {}, False
    for line in lines:
        if line.startswith("*"):
            inside = keyword(line) == "*BOUNDARY" or (inside and line.startswith("**"))
        elif inside and line.strip():
            found[line.split(",")[0].strip().upper()] = None
    return list(found)


def with_totals(text, mesh):
    """The deck, made to print the sum of the supports' reactions at the end of every step that has one."""
    lines = text.splitlines()
    sets = {g.name.upper(): g.ids.tolist() for g in mesh.groups.all() if g.kind == "node"}
    named = [[int(n)] if n.isdigit() else sets.get(n, []) for n in held_nodes(lines)]
    held = sorted({n for numbers in named for n in numbers})
    out, prints, first = [], None, True
    for line in lines:
        card = keyword(line)
        if card == "*STEP" and first and held:
            out += [f"*NSET, NSET={HELD}", *(f"{n}," for n in held)]
            first = False
        if card == "*STEP":
            prints = "U"  # of other steps not what an earlier step asked for
        prints = PROCEDURES.get(card, prints)
        if card == "*END STEP" and held:
            out += [f"*NODE PRINT, NSET={HELD}, TOTALS=YES, GLOBAL=YES, FREQUENCY=99999", prints]
        out.append(line)
    return "\n".join(out) + "\n"


def largest_block(mesh):
    """Points of the nodes of the most hexahedra that hang together."""
    cells = np.concatenate([c[:, :8] for k, c in mesh.cells.items() if k.startswith("hexahedron")])
    label = np.arange(mesh.node_count)
    while True:
        lowest = label[cells].min(axis=1)
        before = label.copy()
        np.minimum.at(label, cells, lowest[:, None])
        if (label == before).all():
            break
    of_cells = label[cells[:, 0]]
    values, counts = np.unique(of_cells, return_counts=True)
    return mesh.points[np.unique(cells[of_cells == values[counts.argmax()]])]


def half_crack(mesh):
    """A plane, a little oblique, across the longest side of the largest block, and the half of it that is to open."""
    points = largest_block(mesh)
    low, high = points.min(axis=0), points.max(axis=0)
    longest, second, third = np.argsort(low - high, kind="stable")
    at = (low + high) / 2
    at[longest] += 0.04 * (high - low)[longest]
    at[second] += (DEPTH - 0.5) * (high - low)[second]
    normal, inward = np.zeros(3), np.zeros(3)
    normal[[longest, third]] = 1, 0.1
    inward[second] = -1
    return fs.Plane(at, normal), fs.HalfPlane(at, inward)


def totals(folder):
    """Of every step that ends in equilibrium: the sum of the supports' reactions, or of the heat that flows there, and
    the sum of their absolute values."""
    found, rows, inside = [], [], ""
    for line in (folder / "run.dat").read_text().splitlines():
        words = line.split()
        if f"for set {HELD} and time" in line:
            inside = words[0] if words[0] in ("forces", "heat", "total") else ""
            rows = rows if inside == "total" else []
        elif words and not words[0][-1].isdigit():
            inside = ""
        elif inside == "total" and words:
            found.append((np.array(words, float), np.abs(rows).sum()))
        elif inside and words:
            rows.append(np.array(words[1:], float))
    return found


def eigenvalues(folder):
    """Frequencies, or buckling factors, of the last step of a .dat file that has them."""
    found, inside = [], False
    for line in (folder / "run.dat").read_text().splitlines():
        words = line.split()
        if "E I G E N V A L U E   O U T P U T" in line or "B U C K L I N G   F A C T O R" in line:
            found, inside = [], True
        elif "P A R T I C I P A T I O N" in line:
            inside = False
        elif inside and len(words) in (2, 5, 6) and words[0].isdigit():
            found.append(float(words[1] if len(words) == 2 else words[-2]))
    return found


def solve(folder):
    done = subprocess.run(
        ["ccx", "run"],
        cwd=folder,
        env=dict(os.environ, OMP_NUM_THREADS="1"),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        timeout=300,
    )
    assert done.returncode == 0 and "Job finished" in done.stdout and "*ERROR" not in done.stdout, done.stdout[-2000:]
    return totals(folder)


def solve_as_it_comes(folder, text):
    """The mesh of a deck, and the sums of its reactions."""
    folder.mkdir()
    (folder / "run.inp").write_text(text)
    (folder / "run.inp").write_text(with_totals(text, fs.read(folder / "run.inp")))
    before = solve(folder)
    return fs.read(folder / "run.inp"), before


def solve_cracked(folder, mesh):
    """The result of the crack, and the sums of reactions then."""
    folder.mkdir()
    plane, half = half_crack(mesh)
    result = fs.crack(mesh, plane, within=half, strict=True)
    fs.write(result.mesh, folder / "run.inp")
    return result, solve(folder)


def imbalance(before, after):
    """Largest difference of the sums, relative to the largest sum of any step; without loads, whose sum is zero, to
    what the supports exert on each other."""
    assert len(before) == len(after) > 0
    size = max(np.abs(total).max() for total, _ in before)
    absolute = max(size for _, size in before + after)
    if size < 1e-6 * absolute:
        size = absolute
    return max(np.abs(a - b).max() for (a, _), (b, _) in zip(after, before)) / (size or 1.0)


def last_words(error):
    return f"{type(error).__name__}: " + " | ".join(str(error).split("\n")[-12:])[-400:]


def compare(name, folder):
    """A line on a deck."""
    try:
        mesh, before = solve_as_it_comes(folder / "before", deck_text(name))
    except (fs.Error, AssertionError, subprocess.TimeoutExpired) as error:
        return "as it comes " + last_words(error)
    try:
        result, after = solve_cracked(folder / "after", mesh)
    except (fs.Error, AssertionError, subprocess.TimeoutExpired) as error:
        return last_words(error)
    report = result.report
    return (
        f"converted {sum(report.converted.values())}, doubled {report.nodes_doubled}, minimum "
        f"{report.quality.after.minimum:.2f}, {len(before)} steps, "
        + (f"off by {imbalance(before, after):.1e}" if before else "without reactions")
    )


def main():
    for name in sys.argv[1:] or names_of_all():
        with tempfile.TemporaryDirectory() as folder:
            print(f"{name:<16} {compare(name, Path(folder))}", flush=True)


if __name__ == "__main__":
    main()
