# SPDX-License-Identifier: LGPL-2.1-or-later
"""What CalculiX makes of cracked decks: glued, a crack must not be felt; open, it must."""

import re
import shutil
import subprocess

import numpy as np
import pytest

import femscalpel as fs
from meshes import box_with_groups, grid_box, quadratic

needs_ccx = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")

PLANE = fs.Plane(origin=(3.3, 2.5, 2), normal=(0.9, 0.3, 0.2))
MATERIAL = "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., {poisson}\n"
SOLID = MATERIAL.format(poisson=0.3) + "*SOLID SECTION, ELSET=ALL, MATERIAL=STEEL\n{thickness}"
SHELL = MATERIAL.format(poisson=0.3) + "*SHELL SECTION, ELSET=ALL, MATERIAL=STEEL\n0.1\n"

GRADIENT = 1e-3 * np.array([[1.3, -0.7, 0.4], [0.9, -1.1, 0.6], [-0.5, 0.8, 0.7]])
SHIFT = np.array([2e-3, -1e-3, 3e-3])


def plate(counts=(8, 6), size=(6.0, 5.0)):
    """Triangles on a rectangle in the xy plane, diagonals in turn."""
    nx, ny = counts
    x, y = np.meshgrid(np.linspace(0, size[0], nx + 1), np.linspace(0, size[1], ny + 1), indexing="ij")
    index = np.arange(x.size).reshape(x.shape)
    triangles = []
    for i in range(nx):
        for j in range(ny):
            a, b, c, d = index[i, j], index[i + 1, j], index[i + 1, j + 1], index[i, j + 1]
            triangles += [(a, b, c), (a, c, d)] if (i + j) % 2 else [(a, b, d), (b, c, d)]
    return fs.Mesh(np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)]), {"triangle": triangles})


def quadratic_of(mesh):
    """The same triangles with mid-side nodes."""
    cells = mesh.cells["triangle"]
    pairs = np.sort(np.stack([cells[:, e] for e in ([0, 1], [1, 2], [2, 0])], axis=1), axis=2)
    unique, inverse = np.unique(pairs.reshape(-1, 2), axis=0, return_inverse=True)
    nodes = np.concatenate([cells, mesh.node_count + inverse.reshape(-1, 3)], axis=1)
    return fs.Mesh(np.concatenate([mesh.points, mesh.points[unique].mean(axis=1)]), {"triangle6": nodes})


MODELS = {
    "C3D4": (grid_box, SOLID.format(thickness="")),
    "C3D10": (lambda: quadratic(grid_box()), SOLID.format(thickness="")),
    "CPS3": (plate, SOLID.format(thickness="0.1\n")),
    "CPS6": (lambda: quadratic_of(plate()), SOLID.format(thickness="0.1\n")),
    "CPE3": (plate, SOLID.format(thickness="0.1\n")),
    "S3": (plate, SHELL),
    "S6": (lambda: quadratic_of(plate()), SHELL),
}


class Model:
    """One deck in a folder: a mesh, the material, and what a test adds to it."""

    def __init__(self, folder, kind, cracked, plane=PLANE):
        make, material = MODELS[kind]
        mesh = make()
        mesh.add_group("ALL", "element", np.concatenate(list(mesh.cell_ids.values())))
        self.flat = not kind.startswith("C3D")
        self.folder = folder
        path = folder / "input.inp"
        fs.write(mesh, path)
        text = path.read_text()
        for written in ("S3", "S6"):
            text = text.replace(f"TYPE={written},", f"TYPE={kind},").replace(f"TYPE={written}\n", f"TYPE={kind}\n")
        path.write_text(text + material)
        self.original = fs.read(path)
        self.mesh = self.original
        self.pairs = []
        if cracked:
            result = fs.crack(self.original, plane)
            self.mesh = result.mesh
            fs.write(self.mesh, folder / "model.inp")
            self.pairs = lip_pairs(self.mesh)
            assert len(self.pairs) == result.report.nodes_doubled > 0
        else:
            fs.write(self.mesh, folder / "model.inp")
        text = (folder / "model.inp").read_text()
        assert f"TYPE={kind}" in text and material in text
        self.point = dict(zip(self.mesh.node_ids.tolist(), self.mesh.points))

    def skin(self):
        """Numbers of the nodes on the box's surface or the plate's border; of doubled ones the original."""
        low, high = np.min(list(self.point.values()), axis=0), np.max(list(self.point.values()), axis=0)
        axes = [0, 1] if self.flat else [0, 1, 2]
        copies = {p for p, _ in self.pairs}
        return [
            n
            for n, x in self.point.items()
            if n not in copies and (np.minimum(np.abs(x - low), np.abs(x - high))[axes] < 1e-9).any()
        ]

    def run(self, cards, step):
        """Runs ccx; returns the text of its .dat file."""
        path = self.folder / "run.inp"
        path.write_text((self.folder / "model.inp").read_text() + cards + "*STEP\n*STATIC\n" + step + "*END STEP\n")
        done = subprocess.run(
            ["ccx", "run"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )
        assert done.returncode == 0 and "Job finished" in done.stdout and "*ERROR" not in done.stdout, done.stdout[
            -2000:
        ]
        return (self.folder / "run.dat").read_text()


def lip_pairs(mesh):
    """(copy on the positive side, original on the negative side) of every doubled node, from the lips' groups."""

    def nodes(name):
        members = mesh.groups[name, "element"].ids
        found = [mesh.cells[kind][np.isin(ids, members)].ravel() for kind, ids in mesh.cell_ids.items()]
        return {tuple(mesh.points[i]): int(mesh.node_ids[i]) for i in np.unique(np.concatenate(found))}

    positive, negative = nodes("CRACK_P"), nodes("CRACK_N")
    assert positive.keys() == negative.keys(), "the lips do not coincide"
    return [(p, negative[x]) for x, p in positive.items() if p != negative[x]]


def equations(pairs):
    """Cards that glue pairs of nodes."""
    return "".join(f"*EQUATION\n2\n{p},{k},1.,{n},{k},-1.\n" for p, n in pairs for k in (1, 2, 3))


def table(dat, title):
    """{node: values} of the printed table whose heading holds `title`."""
    lines = iter(dat.splitlines())
    for line in lines:
        if title in line:
            break
    else:
        raise AssertionError(f"{title!r} is not in the results")
    next(lines)
    rows = {}
    for line in lines:
        if not line.strip():
            break
        number, *values = line.split()
        rows[int(number)] = np.array(values, float)
    return rows


def affine(model):
    """The prescribed displacement at each node: {number: (3,)}; in the plane for a plate."""
    gradient, shift = GRADIENT.copy(), SHIFT.copy()
    if model.flat:
        gradient[2], gradient[:, 2], shift[2] = 0, 0, 0
    return {n: gradient @ x + shift for n, x in model.point.items()}


def deviation(model, glue="", slip=0.0):
    """Largest distance of any node's displacement from the affine field prescribed on the skin, relative to the largest
    displacement.

    CalculiX prints seven digits, too few to see 1e-8. So it is made to take the difference itself, in double precision:
    every node gets a companion node with the equation d = u - expected * r, r being a degree of freedom held at 1, and
    d is what is printed. `slip` is added to one prescribed value, to prove that the companions do notice.
    """
    expected = affine(model)
    size = max(np.linalg.norm(u) for u in expected.values())
    directions = (1, 2) if model.flat else (1, 2, 3)
    first = max(expected) + 1
    reference = first + max(expected)
    cards = ["*NODE, NSET=COMPANIONS\n"]
    cards += ["%d, %.12g, %.12g, 0.\n" % (first + n, 50 + n % 7, n // 7) for n in expected]
    cards += [f"*NODE\n{reference + 1}, -50., 0., 0.\n", glue]
    for n, u in expected.items():
        for k in directions:
            cards.append(f"*EQUATION\n3\n{first + n},{k},1.,{n},{k},-1.,{reference + 1},1,{u[k - 1]:.12e}\n")
    held = [f"*BOUNDARY\n{reference + 1},1,1,1.\n"]
    prescribed = {(n, k): expected[n][k - 1] for n in model.skin() for k in (1, 2, 3)}
    prescribed[next(iter(prescribed))] += slip * size
    held += [f"{n},{k},{k},{u:.12e}\n" for (n, k), u in prescribed.items()]  # more would not fit 20 characters
    dat = model.run("".join(cards), "".join(held) + "*NODE PRINT, NSET=COMPANIONS\nU\n")
    rows = table(dat, "displacements")
    assert len(rows) == len(expected)
    return max(np.linalg.norm(v[: len(directions)]) for v in rows.values()) / size


TIE = "*TIE, NAME=GLUE, POSITION TOLERANCE=1e-6, ADJUST=NO\nCRACK_P, CRACK_N\n"


@needs_ccx
@pytest.mark.parametrize("kind", MODELS)
class TestPatch:
    """Displacements u = A x + b prescribed on the skin: the solution is affine inside, whatever the mesh."""

    def test_uncracked(self, tmp_path, kind):
        assert deviation(Model(tmp_path, kind, cracked=False)) <= 1e-8

    def test_measures_1e_8(self, tmp_path, kind):
        assert 0.99e-8 <= deviation(Model(tmp_path, kind, cracked=False), slip=1e-8) <= 2e-8

    def test_glued_by_equations(self, tmp_path, kind):
        if kind == "S6":
            pytest.skip("CalculiX makes 15-node wedges of S6; an equation joins only their nodes at half the thickness")
        model = Model(tmp_path, kind, cracked=True)
        assert deviation(model, equations(model.pairs)) <= 1e-8

    def test_glued_by_tie(self, tmp_path, kind):
        if kind[:3] != "C3D":
            pytest.skip("CalculiX leaves the edges of plane elements and shells untied")
        model = Model(tmp_path, kind, cracked=True)
        assert deviation(model, TIE) <= 1e-8

    def test_open(self, tmp_path, kind):
        model = Model(tmp_path, kind, cracked=True)
        # Its skin glued, and so held, both sides have their support, and only the lips inside open.
        skin = set(model.skin())
        glue = equations([(p, n) for p, n in model.pairs if n in skin])
        assert deviation(model, glue) > 1e-3


def block_solution(model, glue=""):
    """A block, or plate, held at both ends and loaded unevenly on top: displacements and nodal reactions."""
    points = model.point
    ends = [n for n, x in points.items() if x[0] in (0.0, 6.0)]
    up = 1 if model.flat else 2
    top = max(x[up] for x in points.values())
    copies = {p: n for p, n in model.pairs}
    loaded = [n for n, x in points.items() if x[up] == top and 0 < x[0] < 6 and n not in copies]
    step = "*BOUNDARY\n" + "".join(f"{n},1,3\n" for n in ends)
    step += "*CLOAD\n" + "".join(f"{n},{up + 1},{-1000 - 100 * points[n][0]:.12g}\n" for n in loaded)
    if model.flat:
        step = step.replace(
            "*CLOAD\n", "".join(f"{n},3,3\n" for n in points if n not in copies and n not in ends) + "*CLOAD\n"
        )
    sets = (
        "*NSET, NSET=WHOLE\n"
        + "".join(f"{n},\n" for n in points)
        + "*NSET, NSET=ENDS\n"
        + "".join(f"{n},\n" for n in ends)
    )
    dat = model.run(sets + glue, step + "*NODE PRINT, NSET=WHOLE\nU\n*NODE PRINT, NSET=ENDS\nRF\n")
    displacements, reactions = table(dat, "displacements"), table(dat, "forces")
    assert len(displacements) == len(points) and len(reactions) == len(ends)
    load = sum(1000 + 100 * points[n][0] for n in loaded)
    assert sum(v[up] for v in reactions.values()) == pytest.approx(load, rel=1e-6)
    return displacements, reactions


def merged(model):
    """The cracked model's mesh with each doubled node made one again."""
    index = {int(n): i for i, n in enumerate(model.mesh.node_ids)}
    to = np.arange(model.mesh.node_count)
    for p, n in model.pairs:
        to[index[p]] = index[n]
    kept = np.unique(to)
    new = np.full(len(to), -1)
    new[kept] = np.arange(len(kept))
    body = next(k for k in model.mesh.cells if k.startswith("tetra"))
    ids = model.mesh.cell_ids[body]
    return fs.Mesh(
        model.mesh.points[kept],
        {body: new[to[model.mesh.cells[body]]]},
        model.mesh.node_ids[kept],
        {body: ids},
        {"ALL": ("element", ids)},
    )


def differences(one, other):
    """Largest difference of displacements and of reactions, over the nodes both have, relative to the largest value."""
    result = []
    for a, b in zip(one, other):
        size = max(np.abs(v).max() for v in b.values())
        common = a.keys() & b.keys()
        assert len(common) >= min(len(a), len(b))
        result.append(max(np.abs(a[n] - b[n]).max() for n in common) / size)
    return result


@needs_ccx
@pytest.mark.parametrize("kind", ["C3D4", "C3D10"])
class TestLoadedBlock:
    def test_crack_along_element_faces(self, tmp_path, kind):
        """The mesh has faces on the plane already: nothing but the doubling is done, so the input mesh is the
        reference."""
        plane = fs.Plane((3, 0, 0), (1, 0, 0))
        for name in ("whole", "cracked"):
            (tmp_path / name).mkdir()
        whole = block_solution(Model(tmp_path / "whole", kind, cracked=False))
        model = Model(tmp_path / "cracked", kind, cracked=True, plane=plane)
        for glue in (equations(model.pairs), TIE):
            assert max(differences(block_solution(model, glue), whole)) <= 1e-6
        displacement, reaction = differences(block_solution(model), whole)
        assert displacement > 0.3 and reaction > 0.1

    def test_crack_anywhere(self, tmp_path, kind):
        """The crack changes the mesh near the plane; the reference is that mesh with its lips' nodes merged."""
        model = Model(tmp_path, kind, cracked=True)
        glued = [block_solution(model, glue) for glue in (equations(model.pairs), TIE)]
        opened = block_solution(model)
        fs.write(merged(model), tmp_path / "model.inp")
        with (tmp_path / "model.inp").open("a") as deck:
            deck.write(MODELS[kind][1])
        gone = {p for p, _ in model.pairs}
        model.point = {n: x for n, x in model.point.items() if n not in gone}
        model.pairs = []
        reference = block_solution(model)
        for solution in glued:
            assert max(differences(solution, reference)) <= 1e-6
        displacement, reaction = differences(opened, reference)
        assert displacement > 0.3 and reaction > 0.1


def groups_of(mesh):
    return {
        (g.name, g.kind): set(map(tuple, g.ids.tolist())) if g.kind == "facet" else set(g.ids.tolist())
        for g in mesh.groups.all()
    }


@pytest.mark.parametrize("suffix", [".inp", ".med"])
def test_every_group_survives_crack_and_file(tmp_path, suffix):
    """Groups of all kinds, overlapping and empty, through reading, cracking, writing and reading again."""
    box = box_with_groups()
    points, ids = box.points, box.cell_ids["tetra"]
    first = int(ids.max()) + 1
    skin = [row[[0, 2, 1]] for row in box.cells["tetra"] if (points[row[[0, 1, 2]]][:, 2] == 0).all()]
    cells, cell_ids = {**box.cells}, {**box.cell_ids}
    groups = [(g.name, g.kind, g.ids) for g in box.groups.all()]
    if suffix == ".med":  # in a deck, a triangle would be a shell
        cells["triangle"], cell_ids["triangle"] = np.array(skin), np.arange(first, first + len(skin))
        groups += [
            ("FLOOR", "element", cell_ids["triangle"]),
            ("MIXED", "element", np.concatenate([cell_ids["triangle"][::2], ids[::3]])),
        ]
    else:
        groups += [
            ("SIDES", "facet", [(int(i), 1 + k % 4) for k, i in enumerate(ids[::5])]),
            ("THIRD", "element", ids[::3]),
        ]
    source = fs.Mesh(points, cells, box.node_ids, cell_ids, groups)
    fs.write(source, tmp_path / ("in" + suffix))
    mesh = fs.read(tmp_path / ("in" + suffix))
    assert groups_of(mesh) == groups_of(source)
    result = fs.crack(mesh, PLANE)
    assert groups_of(mesh).keys() <= groups_of(result.mesh).keys()
    for key, members in groups_of(result.mesh).items():
        assert bool(members) == (key[0] != "EMPTY"), key
    fs.write(result.mesh, tmp_path / ("out" + suffix))
    back = groups_of(fs.read(tmp_path / ("out" + suffix)))
    for key, members in groups_of(result.mesh).items():
        if suffix == ".inp" and key[0].startswith("CRACK_"):  # faces of solids: surfaces and node sets
            assert len(back[key[0], "facet"]) == len(members) and back[key[0], "node"]
        else:
            assert back[key] == members, key
