# SPDX-License-Identifier: LGPL-2.1-or-later
"""CalculiX for the demo: writes the caisson's input deck, runs ccx, reads displacements, stresses and totals."""

import os
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from caisson import Model

ELEMENT_TYPES = {
    "tetra": "C3D4",
    "tetra10": "C3D10",
    "triangle": "S3",
    "triangle6": "S6",
    "quad": "S4",
    "quad8": "S8R",
}

# Corners of face 1 to 4 of a tetrahedron, as CalculiX numbers them.
TETRA_FACES = np.array([[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]])

# The deck behind its mesh: it names groups, never numbers.
STEEL = """*MATERIAL, NAME={name}
*ELASTIC
{modulus:.1f}, 0.3
*DENSITY
7.85e-9
"""

LOADS = """*BOUNDARY
SUPPORTS, 1, 3
*STEP
*STATIC
** Floor pressure 0.6 MPa, equipment on a line along the roof, two concentrated loads, dead weight.
{pressure}
*DLOAD
MAT_S355, GRAV, 9810., 0., 0., -1.
MAT_S460, GRAV, 9810., 0., 0., -1.
*CLOAD
LINE_LOAD, 3, {line_load:.6g}
POINT_LOAD, 3, -8000.
*NODE FILE, OUTPUT={output}
U
*EL FILE
S
{prints}*EL PRINT, ELSET=MAT_S355, TOTALS=ONLY
ELSE
*EL PRINT, ELSET=MAT_S460, TOTALS=ONLY
ELSE
*END STEP
"""

SUPPORT_NAMES = [f"SUPPORT_{k}" for k in range(1, 7)]


def write_deck(model: Model, path: Path) -> None:
    """Writes a complete CalculiX deck: the body's elements, every group as a set or surface, loads, one static step.

    Groups of the body's elements become ELSETs, groups of faces of a solid SURFACEs, all others NSETs.
    """
    solid = any(name.startswith("tetra") for name in model.cells)
    bodies = [n for n in ELEMENT_TYPES if n in model.cells and n.startswith("tetra") == solid]
    body_ids = np.concatenate([model.cell_ids[name] for name in bodies])
    lines = ["*HEADING", f"Caisson hung on six T stiffeners, {'solid' if solid else 'shell'} model; mm, N, MPa, t"]
    lines.append("*NODE, NSET=ALL_NODES")
    used = np.unique(np.concatenate([model.cells[name].ravel() for name in bodies]))
    lines += ["%d, %.17g, %.17g, %.17g" % (n + 1, *model.points[n]) for n in used.tolist()]
    for name in bodies:
        lines.append(f"*ELEMENT, TYPE={ELEMENT_TYPES[name]}, ELSET=ALL")
        # CalculiX's node order in a C3D10 is VTK's.
        table = np.column_stack([model.cell_ids[name], model.cells[name] + 1])
        lines += [", ".join(map(str, row)) for row in table.tolist()]
    faces = _faces_of_tetrahedra(model, bodies[0]) if solid else {}
    rows = {name: dict(zip(ids.tolist(), range(len(ids)))) for name, ids in model.cell_ids.items()}
    for name, (kind, ids) in model.groups.items():
        if kind == "node":
            lines += _set("NSET", name, ids)
        elif np.isin(ids[0], body_ids):
            lines += _set("ELSET", name, ids)
        else:
            block = next(b for b in model.cells if int(ids[0]) in rows[b])
            nodes = model.cells[block][[rows[block][i] for i in ids.tolist()]]
            if block.startswith("triangle"):
                lines.append(f"*SURFACE, NAME={name}, TYPE=ELEMENT")
                lines += ["%d, S%d" % faces[tuple(sorted(n))] for n in nodes[:, :3].tolist()]
            else:
                lines += _set("NSET", name, np.unique(nodes) + 1)
    for name, modulus in (("S355", 210000.0), ("S460", 210000.0)):
        lines.append(STEEL.format(name=name, modulus=modulus).rstrip())
        if solid:
            lines.append(f"*SOLID SECTION, ELSET=MAT_{name}, MATERIAL={name}")
        else:
            lines += [f"*SHELL SECTION, ELSET=MAT_{name}, MATERIAL={name}", "24."]
    edges = next(name for name in model.cells if name.startswith("line"))
    line_nodes = len(np.unique(model.cells[edges][np.isin(model.cell_ids[edges], model.groups["LINE_LOAD"][1])]))
    lines.append(
        LOADS.format(
            pressure="*DSLOAD\nPRESSURE, P, 0.6" if solid else "*DLOAD\nPRESSURE, P, 0.6",
            line_load=-30000.0 / line_nodes,
            output="3D" if solid else "2D",
            prints="".join(f"*NODE PRINT, NSET={s}, TOTALS=ONLY\nRF\n" for s in SUPPORT_NAMES),
        ).rstrip()
    )
    path.write_text("\n".join(lines) + "\n")


def _set(card: str, name: str, ids: np.ndarray) -> list[str]:
    ids = ids.tolist()
    return [f"*{card}, {card}={name}"] + [", ".join(map(str, ids[k : k + 12])) + "," for k in range(0, len(ids), 12)]


def _faces_of_tetrahedra(model: Model, body: str) -> dict[tuple[int, int, int], tuple[int, int]]:
    """Sorted corner rows of every face -> (element number, face number); of two elements the first one."""
    corners = model.cells[body][:, :4]
    found: dict[tuple[int, int, int], tuple[int, int]] = {}
    for face in range(4, 0, -1):
        keys = np.sort(corners[:, TETRA_FACES[face - 1]], axis=1)
        found.update(zip(map(tuple, keys.tolist()), ((i, face) for i in model.cell_ids[body].tolist())))
    return found


@dataclass
class Solution:
    """One static step. Forces in N, energy in N mm, displacement and stress per node number."""

    displacement: dict[int, np.ndarray] = field(default_factory=dict)  # (3,), mm
    stress: dict[int, np.ndarray] = field(default_factory=dict)  # xx yy zz xy yz zx, MPa
    reactions: dict[str, np.ndarray] = field(default_factory=dict)  # support -> (3,), N
    energy: float = 0.0  # elastic; the loads' work is twice that

    def von_mises(self) -> dict[int, float]:
        ids = list(self.stress)
        s = np.array([self.stress[i] for i in ids])
        value = np.sqrt(
            0.5 * ((s[:, 0] - s[:, 1]) ** 2 + (s[:, 1] - s[:, 2]) ** 2 + (s[:, 2] - s[:, 0]) ** 2)
            + 3 * (s[:, 3:] ** 2).sum(1)
        )
        return dict(zip(ids, value.tolist()))


def run(decks: list[Path]) -> list[Solution]:
    """Runs ccx on all decks at once, each in its directory, and reads the results.

    Raises RuntimeError with ccx's last words.
    """
    threads = max(1, (os.cpu_count() or 1) // len(decks))
    environment = dict(os.environ, OMP_NUM_THREADS=str(threads))
    running = []
    for deck in decks:
        with deck.with_suffix(".log").open("w") as log:
            running.append(
                subprocess.Popen(
                    ["ccx", deck.stem], cwd=deck.parent, env=environment, stdout=log, stderr=subprocess.STDOUT
                )
            )
    codes = [process.wait() for process in running]
    return [_results(deck, code) for deck, code in zip(decks, codes)]


def _results(deck: Path, code: int) -> Solution:
    log = deck.with_suffix(".log").read_text(errors="replace")
    if code != 0 or "Job finished" not in log or "*ERROR" in log:
        last = [line for line in log.splitlines() if line.strip()][-12:]
        raise RuntimeError(f"ccx failed on {deck}:\n" + "\n".join(last))
    solution = Solution()
    _read_frd(deck.with_suffix(".frd"), solution)
    _read_totals(deck.with_suffix(".dat"), solution)
    return solution


def _read_frd(path: Path, solution: Solution) -> None:
    """Nodal DISP and STRESS of the last increment of an ASCII .frd file (CalculiX CrunchiX manual, ch. 11)."""
    target = None
    with path.open() as file:
        for line in file:
            if line.startswith(" -4"):
                target = {"DISP": solution.displacement, "STRESS": solution.stress}.get(line[5:13].strip())
                if target is not None:
                    target.clear()
            elif line.startswith(" -3"):
                target = None
            elif target is not None and line.startswith(" -1"):
                values = line[13:].rstrip("\n")
                target[int(line[3:13])] = np.array([float(values[k : k + 12]) for k in range(0, len(values), 12)])


def _read_totals(path: Path, solution: Solution) -> None:
    """Total reaction per support and elastic energy from the .dat file."""
    title = ""
    for line in path.read_text().splitlines():
        if line.strip().startswith("total"):
            title = line
        elif line.strip() and title:
            values = np.array([float(v) for v in line.split()])
            name = title.split(" for set ")[1].split()[0]
            if "force" in title:
                solution.reactions[name] = values
            elif "energy" in title:
                solution.energy += values[-1]
            title = ""
