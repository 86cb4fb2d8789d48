# SPDX-License-Identifier: LGPL-2.1-or-later
"""Edges that equations keep straight, beside pyramids of second order and between elements of second and of first
order: bars pulled along x, cracked in a plane through x, have a uniform stress as before."""

import re
import subprocess

import numpy as np
import pytest

import femscalpel as fs
from mixed_meshes import FACES, grid, second_order

LENGTH, WIDTH = 24, 3
STRAIN = 1e-3
HOLD = "NX, 1, 1\nNY, 2, 2\nNZ, 3, 3\n"
STEP = "*BOUNDARY\n" + HOLD + "*STEP\n*STATIC\n@*END STEP\n"
ALL = {"C3D8": dict(second_order=True), "C3D20": {}}


def numbers(ids):
    return "".join(f"{n},\n" for n in ids)


def bar_of(points, cells, label="C3D8", model="", steps=STEP, **sets):
    """A deck; `@` in the steps is the load and what is printed."""
    text = "*NODE, NSET=NALL\n" + "".join("%d, %.12g, %.12g, %.12g\n" % (i + 1, *x) for i, x in enumerate(points))
    text += f"*ELEMENT, TYPE={label}, ELSET=EALL\n"
    for e, c in enumerate(cells):
        words = [str(e + 1)] + [str(n + 1) for n in c]
        text += ", ".join(words[:12]) + (",\n" + ", ".join(words[12:]) if len(words) > 12 else "") + "\n"
    sets = dict(NX=points[:, 0] == 0, NY=points[:, 1] == 0, NZ=points[:, 2] == 0, **sets)
    for name, is_in in sets.items():
        text += f"*NSET, NSET={name}\n" + numbers(np.flatnonzero(is_in) + 1)
    text += "*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.3\n*SOLID SECTION, ELSET=EALL, MATERIAL=M\n" + model
    load = "*DLOAD\n"
    for e, c in enumerate(cells):
        for f, face in enumerate([(0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)]):
            if len({c[k] for k in face}) > 2 and all(points[c[k]][0] == LENGTH for k in face):
                load += f"{e + 1}, P{f + 1}, {-1000 * STRAIN}\n"
    return text + steps.replace("@", load + "*NODE PRINT, NSET=NALL\nU\n")


def bar(label="C3D8", jitter=0.1, **more):
    points, cells = grid((LENGTH, WIDTH, WIDTH), jitter=jitter)
    if label == "C3D20":
        points, cells = second_order(points, cells, "hexahedron")
    more = {k: v(points) if callable(v) and k != "cells" else v for k, v in more.items()}
    return bar_of(points, cells, label, **more)


def read(folder, text):
    (folder / "in.inp").write_text(text)
    return fs.read(folder / "in.inp")


def cracked(mesh, x=12, **options):
    at = (x, 1.6, 1.5)
    return fs.crack(mesh, fs.Plane(at, (0, 1, 0.15)), within=fs.Disk(at, 1.4), refine=False, **options)


def errors(folder, mesh):
    """Of the displacements in each step, as parts of the largest. Those that are printed in local directions are not
    looked at."""
    fs.write(mesh, folder / "out.inp")
    done = subprocess.run(["ccx", "out"], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert done.returncode == 0 and "*ERROR" not in done.stdout, done.stdout[-2000:]
    place = dict(zip(mesh.node_ids.tolist(), mesh.points))
    out = []
    for line in (folder / "out.dat").read_text().splitlines():
        words = line.split()
        if words and words[0] == "displacements":
            out.append(0.0)
        elif len(words) == 4 and out:
            exact = STRAIN * place[int(words[0])] * (1, -0.3, -0.3)
            out[-1] = max(out[-1], np.abs(np.array(words[1:], float) - exact).max() / (STRAIN * LENGTH))
    assert out
    return out


def equations(folder, mesh):
    """Terms of the equations of a written deck."""
    fs.write(mesh, folder / "equations.inp")
    out, rows = [], None
    for line in (folder / "equations.inp").read_text().splitlines():
        if line.startswith("*") and not line.startswith("**"):
            rows = line.startswith("*EQUATION")
        elif rows and not line.startswith("**"):
            words = [w for w in re.split(r"[,\s]+", line) if w]
            if len(words) == 1:
                out.append([])
            else:
                out[-1] += [(int(words[k]), int(words[k + 1]), float(words[k + 2])) for k in range(0, len(words), 3)]
    return out


TURNS = {
    "rotated": "TYPE=R\n0.6, 0.8, 0., -0.8, 0.6, 0.\n",
    "swapped": "TYPE=R\n0., 0., 1., 1., 0., 0.\n",
    "any": "TYPE=R\n1., 1., 0.3, -0.2, 1., 0.7\n",
    "cylinder": "TYPE=C\n0., 0., 0., 0., 0., 1.\n",
    "through": "TYPE=C\n0., 1., 2.5, 1., 1., 2.5\n",
}


@pytest.mark.parametrize("label", ALL)
@pytest.mark.parametrize("turn", TURNS)
def test_turned_nodes(tmp_path, label, turn):
    """*TRANSFORM on some of the nodes: the terms are in local directions, which differ from node to node."""
    turned = lambda p: (p[:, 2] > WIDTH - 0.4) & (p[:, 1] > 0.3) & (p[:, 0] > 0.3)
    mesh = read(tmp_path, bar(label, model="*TRANSFORM, NSET=NT, " + TURNS[turn], NT=turned))
    result = cracked(mesh, **ALL[label])
    assert result.report.warnings == []
    assert any(len({n for n, _, _ in e}) < len(e) for e in equations(tmp_path, result.mesh)) or turn == "swapped"
    assert max(errors(tmp_path, result.mesh)) < 1e-6


@pytest.mark.parametrize("label", ALL)
@pytest.mark.parametrize("turn, hold", [("rotated", "NZ, 3, 3\n"), ("swapped", "NZ, 1, 1\n"), ("cylinder", "NZ, 3\n")])
@pytest.mark.parametrize("at_times", [False, True])
def test_turned_and_supported_nodes(tmp_path, label, turn, hold, at_times):
    """Only the supported direction has no equation, or, where the support is of some steps, the node no support."""
    inner = lambda p: (p[:, 2] == 0) & (p[:, 1] > 0) & (p[:, 0] > 0)
    edge = lambda p: (p[:, 2] == 0) & ((p[:, 1] == 0) | (p[:, 0] == 0))
    holds = "NX, 1, 1\nNY, 2, 2\nNE, 3, 3\n"
    steps = "*BOUNDARY\n" + holds + hold.replace("NZ", "NT") + "*STEP\n*STATIC\n@*END STEP\n"
    if at_times:
        steps += "*STEP\n*STATIC\n*BOUNDARY, OP=NEW\n" + holds + "@*END STEP\n"
    model = "*TRANSFORM, NSET=NT, " + TURNS[turn]
    mesh = read(tmp_path, bar(label, model=model, steps=lambda p: steps, NT=inner, NE=edge))
    result = cracked(mesh, **ALL[label])
    alone = at_times and turn == "swapped" and label == "C3D20"  # a middle one, of which no end is in NT
    assert [w.partition(" holds ")[0] for w in result.report.warnings] == ["*BOUNDARY"] * alone
    assert max(errors(tmp_path, result.mesh)) < 1e-6


def test_a_transform_without_directions_is_told(tmp_path):
    model = "*TRANSFORM, NSET=NT\n0., 0., 0., 0., 1., 0.\n"
    mesh = read(tmp_path, bar(model=model, NT=lambda p: p[:, 2] == WIDTH))
    (warning,) = cracked(mesh, second_order=True).report.warnings
    assert "*TRANSFORM" in warning
    with pytest.raises(fs.Error, match=r"in.inp:\d+: \*TRANSFORM"):
        cracked(mesh, second_order=True, strict=True)


FIXED = STEP + "*STEP\n*STATIC\n*BOUNDARY, FIXED\nNALL, 1, 3\n@*END STEP\n"
#: The first holds what the second lets go.
NEW = (
    "*STEP\n*STATIC\n*BOUNDARY\n" + HOLD + "NE, 1, 1, 0.\n17, 2, 3\n@*END STEP\n"
    "*STEP\n*STATIC\n*BOUNDARY, OP=NEW\n" + HOLD + "@*END STEP\n"
)


@pytest.mark.parametrize("label", ALL)
@pytest.mark.parametrize("steps", [FIXED, NEW], ids=["fixed", "new"])
def test_supports_of_some_steps(tmp_path, label, steps):
    """The middles of straight edges leave such supports where these are written, and are in them in the mesh."""
    mesh = read(tmp_path, bar(label, steps=lambda p: steps, NE=lambda p: p[:, 2] == WIDTH))
    result = cracked(mesh, **ALL[label])
    assert errors(tmp_path, result.mesh)[-1] < 1e-6
    if steps == FIXED:
        assert max(errors(tmp_path, result.mesh)) < 1e-6
    text = (tmp_path / "out.inp").read_text()
    assert "_NOT_TIED1" in text
    again = fs.read(tmp_path / "out.inp")
    assert not any(name.endswith("_NOT_TIED1") for name in again.groups)
    fs.write(again, tmp_path / "again.inp")
    assert (tmp_path / "again.inp").read_text() == text


def test_a_middle_held_in_some_steps_without_its_ends_is_told(tmp_path):
    """No equation can keep its edge straight in the other steps."""
    middle = min(e[0][0] for e in equations(tmp_path, cracked(read(tmp_path, bar("C3D20"))).mesh))
    held = f"*BOUNDARY\n{middle}, 2, 2, 0.\n"
    steps = "*BOUNDARY\n" + HOLD + f"*STEP\n*STATIC\n{held}@*END STEP\n"
    mesh = read(tmp_path, bar("C3D20", steps=lambda p: steps))
    assert not cracked(mesh).report.warnings  # in all steps
    later = "*BOUNDARY\n" + HOLD + f"*STEP\n*STATIC\n@*END STEP\n*STEP\n*STATIC\n{held}@*END STEP\n"
    mesh = read(tmp_path, bar("C3D20", steps=lambda p: later))
    (warning,) = cracked(mesh).report.warnings
    assert f"node {middle}," in warning and "some steps" in warning
    with pytest.raises(fs.Error, match="some steps"):
        cracked(mesh, strict=True)


def test_beside_a_distributing_coupling(tmp_path):
    """Its surface's nodes are not dependent."""
    points, cells = grid((LENGTH, WIDTH, WIDTH))
    top = [e + 1 for e, c in enumerate(cells) if (points[c[4:]][:, 2] == WIDTH).all()]
    model = "*NODE\n6000, 10.5, 2., 5.\n*SURFACE, NAME=TOP\n" + "".join(f"{e}, S2\n" for e in top)
    model += "*COUPLING, REF NODE=6000, SURFACE=TOP, CONSTRAINT NAME=C\n*DISTRIBUTING\n1, 3\n"
    mesh = read(tmp_path, bar(jitter=0, model=model))
    assert max(errors(tmp_path, cracked(mesh, second_order=True).mesh)) < 1e-6


def test_beside_equations_in_one_direction(tmp_path):
    def model(points):
        first, *others = np.flatnonzero((points[:, 2] == WIDTH) & (points[:, 1] > 0)) + 1
        return "*EQUATION\n" + "".join(f"2\n{n}, 3, 1., {first}, 3, -1.\n" for n in others)

    mesh = read(tmp_path, bar(jitter=0, model=model))
    assert max(errors(tmp_path, cracked(mesh, second_order=True).mesh)) < 1e-6


def test_elements_with_a_node_twice_stay_of_first_order(tmp_path):
    """Prisms given as hexahedra."""
    points, cells = grid((LENGTH, WIDTH, WIDTH), jitter=0.1)
    prisms = [h[list(k)] for h in cells for k in ((0, 1, 2, 2, 4, 5, 6, 6), (0, 2, 3, 3, 4, 6, 7, 7))]
    result = cracked(read(tmp_path, bar_of(points, prisms)), second_order=True)
    assert {"tetra10", "hexahedron"} <= set(result.mesh.cells)
    assert max(errors(tmp_path, result.mesh)) < 1e-6


@pytest.mark.parametrize("second", [False, True])
def test_a_second_operation_at_the_rim_of_the_first(tmp_path, second):
    """Its equations are made anew."""
    first = cracked(read(tmp_path, bar()), second_order=True).mesh
    fs.write(first, tmp_path / "first.inp")
    rim = [n for e in equations(tmp_path, first) for n, _, _ in e]
    x = first.points[np.isin(first.node_ids, rim)][:, 0].max() - 0.5
    assert 12 < x < LENGTH - 2
    for mesh in (first, fs.read(tmp_path / "first.inp")):
        result = cracked(mesh, x, second_order=second, name="SECOND")
        assert all("*EQUATION" not in w for w in result.report.warnings)
        assert max(errors(tmp_path, result.mesh)) < 1e-6


def test_a_crack_along_the_rim_parts_the_mesh(tmp_path):
    """No equation goes across."""
    mesh = cracked(read(tmp_path, bar(jitter=0)), second_order=True).mesh
    rim = {n for e in equations(tmp_path, mesh) for n, _, _ in e}
    x = mesh.points[np.isin(mesh.node_ids, list(rim))][:, 0].max()
    mesh.add_group("ACROSS", "node", mesh.node_ids[abs(mesh.points[:, 0] - x) < 1e-9])
    result = fs.crack(mesh, fs.Faces("ACROSS"), name="SECOND")
    assert result.report.warnings == []
    after = result.mesh
    group = {n: n for n in after.node_ids.tolist()}

    def first(n):
        while group[n] != n:
            n = group[n]
        return n

    together = [[n for n, _, _ in e] for e in equations(tmp_path, after)]
    for kind, cells in after.cells.items():
        if kind.rstrip("0123456789") in FACES:
            together += after.node_ids[cells].tolist()
    for nodes in together:
        for n in nodes:
            group[first(n)] = first(nodes[0])
    assert len({first(n) for n in group}) == 2


def test_removed_elements_at_the_rim_are_told(tmp_path):
    points, cells = grid((LENGTH, WIDTH, WIDTH))
    mesh = cracked(read(tmp_path, bar(jitter=0)), second_order=True).mesh
    x = max(mesh.points[np.isin(mesh.node_ids, [n for n, _, _ in e])][:, 0].max() for e in equations(tmp_path, mesh))
    at = np.array([points[c].mean(axis=0) for c in cells])
    gone = np.flatnonzero((abs(at[:, 0] - x) < 2) & (at[:, 2] > WIDTH - 1)) + 1
    steps = STEP.replace("*STATIC\n", "*STATIC\n*MODEL CHANGE, TYPE=ELEMENT, REMOVE\nGONE\n")
    text = bar(jitter=0, model="*ELSET, ELSET=GONE\n" + numbers(gone), steps=lambda p: steps)
    mesh = read(tmp_path, text)
    (warning,) = cracked(mesh, second_order=True).report.warnings
    assert "*MODEL CHANGE" in warning and "straight" in warning
    with pytest.raises(fs.Error, match=r"in.inp:\d+: \*MODEL CHANGE"):
        cracked(mesh, second_order=True, strict=True)
