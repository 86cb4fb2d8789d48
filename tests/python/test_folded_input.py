# SPDX-License-Identifier: LGPL-2.1-or-later
"""Second-order elements of the input that are folded at a corner, though not where solvers integrate."""

import subprocess

import numpy as np
import pytest

import femscalpel as fs
from meshes import grid_box, quadratic
from test_physics import needs_ccx, plate, quadratic_of

EDGES = {"tetra10": ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)), "triangle6": ((0, 1), (1, 2), (2, 0))}


def ratios(mesh, kind, at):
    """Smallest Jacobian of every element "corners" or "integration points", over that of the straight element."""
    n = 4 if kind == "tetra10" else 3
    if at == "corners":
        places = np.eye(n)
    else:
        near = (5 + 3 * 5**0.5) / 20 if n == 4 else 2 / 3
        places = np.full((n, n), (1 - near) / (n - 1)) + np.eye(n) * (near - (1 - near) / (n - 1))
    x = mesh.points[mesh.cells[kind]]
    slopes = np.vstack([-np.ones(n - 1), np.eye(n - 1)])

    def size(columns):
        if n == 4:
            return np.linalg.det(columns)
        return np.cross(columns[:, 0, :2], columns[:, 1, :2])

    straight = size(np.stack([x[:, k] - x[:, 0] for k in range(1, n)], axis=1))
    out = []
    for weights in places:
        gradient = [(4 * weights[i] - 1) * slopes[i] for i in range(n)]
        gradient += [4 * (weights[i] * slopes[j] + weights[j] * slopes[i]) for i, j in EDGES[kind]]
        out.append(size(np.einsum("nij,ik->nkj", x, np.array(gradient))) / straight)
    return np.min(out, axis=0)


def pushed(mesh, kind, chosen, by=0.256):
    """Mid-side nodes of the edges chosen(a, b) moved along them by a part of their length; and these nodes' indices."""
    points, moved = mesh.points.copy(), []
    for row in mesh.cells[kind]:
        for k, (i, j) in enumerate(EDGES[kind]):
            a, b = sorted((row[i], row[j]))
            middle = row[mesh.cells[kind].shape[1] - len(EDGES[kind]) + k]
            if middle not in moved and chosen(points[a], points[b]):
                points[middle] += (points[b] - points[a]) * by
                moved.append(middle)
    return fs.Mesh(points, mesh.cells, mesh.node_ids, mesh.cell_ids), moved


def box(by=0.256):
    """A box with mid-side nodes of short edges on the face x = 0, around its middle, pushed along them."""

    def chosen(a, b):
        middle = (a + b) / 2
        return (
            a[0] == b[0] == 0
            and abs(np.linalg.norm(a - b) - 1) < 1e-9
            and 1.2 < middle[2] < 3.8
            and 0.8 < middle[1] < 4.2
        )

    return pushed(quadratic(grid_box((4, 5, 5), (4.0, 5.0, 5.0))), "tetra10", chosen, by)


def sheet(by=0.3):
    return pushed(
        quadratic_of(plate()), "triangle6", lambda a, b: 1 < (a[0] + b[0]) / 2 < 5 and a[1] == b[1] and 1 < a[1] < 4, by
    )


MODELS = {"tetra10": box, "triangle6": sheet}
TOOLS = {
    "plane": lambda m, z: fs.crack(m, fs.Plane((2, 2.5, z), (0.1, 0.5, 2))),
    "across": lambda m, z: fs.crack(m, fs.Plane((2.2, z, 2.2), (0.3, 2, 0.1))),
    "hole": lambda m, z: fs.drill(m, fs.Cylinder((2, z, z), (0.05, 0.1, 1), 0.8), refine=False),
    "refined hole": lambda m, z: fs.drill(m, fs.Cylinder((0, z, 2.6), (1, 0.1, 0.05), 0.9)),
    "slot": lambda m, z: fs.cut(m, fs.Plane((2, z, 2.5), (0.1, 2, 0.5)), width=0.4),
    "refine": lambda m, z: fs.refine(m, fs.Plane((2, z, 2.5), (0.1, 2, 0.5)), size=0.5),
}


def folded_numbers(mesh, kind):
    return mesh.cell_ids[kind][ratios(mesh, kind, "corners") <= 0]


@pytest.mark.parametrize(
    "kind, tool", [(k, t) for k in MODELS for t in TOOLS if k == "tetra10" or t not in ("plane", "refined hole")]
)
def test_worked_through(kind, tool):
    mesh, _ = MODELS[kind]()
    folded = folded_numbers(mesh, kind)
    assert len(folded) > 10 and ratios(mesh, kind, "integration points").min() > 0.05
    sound, _ = MODELS[kind](0)
    before = dict(
        zip(mesh.cell_ids[kind], np.minimum(ratios(mesh, kind, "corners"), ratios(mesh, kind, "integration points")))
    )
    old = dict(zip(mesh.cell_ids[kind], mesh.points[mesh.cells[kind]]))
    worked = 0
    for z in (2.2, 2.5, 2.77):
        result, expected = TOOLS[tool](mesh, z), TOOLS[tool](sound, z)
        out = result.mesh
        # As good as without the folds, and no more elements.
        assert result.report.quality.after.minimum >= 0.9 * expected.report.quality.after.minimum
        assert out.cell_count <= 1.1 * expected.mesh.cell_count
        corners, inside = ratios(out, kind, "corners"), ratios(out, kind, "integration points")
        assert inside.min() > 0
        named = [w for w in result.report.warnings if "folded at a corner" in w]
        assert not named or str(folded[0]) in named[0]
        assert named or tool == "refined hole"
        for number, nodes, ratio in zip(out.cell_ids[kind], out.cells[kind], np.minimum(corners, inside)):
            if number in old and (out.points[nodes] == old[number]).all():
                continue
            # What changed is sound, or no worse than it was.
            assert ratio >= min(0.02, before.get(number, 0.02)) - 1e-9, number
            worked += number in folded or number not in old
    assert worked > 0


@pytest.mark.parametrize("kind", MODELS)
def test_untouched_elements_stay_bit_for_bit(kind):
    mesh, moved = MODELS[kind]()
    old = {n: x for n, x in zip(mesh.node_ids, mesh.points)}
    # A crack at the rim of the folded elements: of the pushed mid-side nodes most stay.
    result = fs.crack(mesh, fs.Plane((0, 1.4, 0), (0, 1, 0)))
    new = {n: x for n, x in zip(result.mesh.node_ids, result.mesh.points)}
    kept = [n for n in mesh.node_ids[moved] if (new[n] == old[n]).all()]
    assert len(moved) / 4 <= len(kept)
    (warning,) = [w for w in result.report.warnings if "folded at a corner" in w]
    gone = sorted(set(mesh.node_ids[moved]) - set(kept))
    assert all(str(n) in warning.split("node")[-1] for n in gone)
    # An element none of whose mid-side nodes had to move is what it was.
    for number, nodes in zip(result.mesh.cell_ids[kind], result.mesh.cells[kind]):
        row = mesh.cells[kind][mesh.cell_ids[kind] == number]
        if len(row) and number in folded_numbers(mesh, kind) and not set(mesh.node_ids[row[0]]) & set(gone):
            if (result.mesh.points[nodes[:3]] == mesh.points[row[0][:3]]).all():
                assert (result.mesh.points[nodes] == mesh.points[row[0]]).all()


@pytest.mark.parametrize("kind", MODELS)
def test_folded_where_solvers_integrate(kind):
    mesh, _ = MODELS[kind](0.6)
    bad = mesh.cell_ids[kind][ratios(mesh, kind, "integration points") <= 0]
    assert len(bad) > 0
    with pytest.raises(fs.QualityError, match=f"folded .elements? .*{bad[0]}.* where solvers integrate"):
        fs.crack(mesh, fs.Plane((2, 2.5, 2.5), (0.1, 2, 0.5)))


@pytest.mark.parametrize("kind", MODELS)
def test_held_middles_are_named(kind):
    """Mid-side nodes that are isolated members of a group cannot move: the elements are named, or left alone."""
    mesh, moved = MODELS[kind]()
    mesh.add_group("GAUGES", "node", mesh.node_ids[moved])
    old = mesh.points[moved]
    folded = folded_numbers(mesh, kind)
    for z in (0.2, 0.9, 2.2, 2.5, 2.77):
        try:
            result = fs.crack(mesh, fs.Plane((2, z, 2.5), (0.1, 2, 0.5)))
        except fs.QualityError as error:
            assert "folded at a corner" in str(error) and any(str(n) in str(error) for n in folded)
            continue
        assert ratios(result.mesh, kind, "integration points").min() > 0
        where = np.searchsorted(result.mesh.node_ids, mesh.node_ids[moved])
        assert (result.mesh.points[where] == old).all()


@needs_ccx
def test_solved(tmp_path):
    mesh, _ = box()
    mesh.add_group("ALL", "element", mesh.cell_ids["tetra10"])
    mesh.add_group("FIX", "node", mesh.node_ids[mesh.points[:, 2] == 0])
    mesh.add_group("TOP", "node", mesh.node_ids[mesh.points[:, 2] == 5])
    step = (
        "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3\n*SOLID SECTION, ELSET=ALL, MATERIAL=STEEL\n"
        "*STEP\n*STATIC\n*BOUNDARY\nFIX, 1, 3\nTOP, 3, 3, 0.001\n*NODE FILE\nU\n*END STEP\n"
    )
    for operation in (lambda m: m, lambda m: TOOLS["plane"](m, 2.5).mesh, lambda m: TOOLS["slot"](m, 2.5).mesh):
        out = operation(mesh)
        deck = fs.Mesh(
            out.points,
            {"tetra10": out.cells["tetra10"]},
            out.node_ids,
            {"tetra10": out.cell_ids["tetra10"]},
            {name: (out.groups[name].kind, out.groups[name].ids) for name in ("ALL", "FIX", "TOP")},
        )
        fs.write(deck, tmp_path / "run.inp")
        (tmp_path / "run.inp").write_text((tmp_path / "run.inp").read_text() + step)
        done = subprocess.run(["ccx", "run"], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        assert done.returncode == 0 and "*ERROR" not in done.stdout and "Job finished" in done.stdout, done.stdout[
            -2000:
        ]
