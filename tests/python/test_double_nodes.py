# SPDX-License-Identifier: LGPL-2.1-or-later
"""What touches with double nodes stays in pairs (paper, 2.2 and Figure 3.f): bodies in contact,
shells on each other, the lips of an earlier crack."""

import contact_cases
import numpy as np
import pytest
from test_conversion import deck, largest_error, needs_ccx

import femscalpel as fs

PLANE = fs.Plane((3.1, 2.5, 4.2), (1, 0.3, 0.4))


def both(kind="flat", seed=1):
    mesh = contact_cases.bodies(kind, np.random.default_rng(seed))
    contact_cases.add_contact(mesh)
    return mesh


@pytest.mark.parametrize("kind", contact_cases.KINDS)
def test_random_tools(kind):
    for seed in range(8):
        mesh, operate, removes = contact_cases.make(kind, seed)
        result = operate(mesh)
        assert contact_cases.check(kind, mesh, result, removes) == [], seed
        assert contact_cases.worst_of(result.mesh) > 0.1, seed


def test_crack_beside_a_contact():
    """It takes nodes of the contact along, on both sides."""
    mesh = both()
    result = fs.crack(mesh, fs.Plane((3, 2.5, 4.3), (0, 0, 1)))
    assert contact_cases.check("flat", mesh, result, False) == []
    assert result.report.welded_pairs == 42 and not result.report.warnings
    assert "42 pairs stayed pairs" in result.report.to_text()


def test_what_is_far_away_stays_to_the_last_bit():
    mesh = both()
    result = fs.crack(mesh, fs.Plane((1.1, 0, 0), (1, 0, 0)))
    after = result.mesh
    row = {i: k for k, i in enumerate(after.node_ids)}
    far = [k for k, x in enumerate(mesh.points) if x[0] > 4.5]
    assert far and all((after.points[row[mesh.node_ids[k]]] == mesh.points[k]).all() for k in far)
    cells = dict(zip(after.cell_ids["tetra"], after.node_ids[after.cells["tetra"]]))
    for number, cell in zip(mesh.cell_ids["tetra"], mesh.cells["tetra"]):
        if mesh.points[cell][:, 0].min() > 4.5:
            assert (cells[number] == mesh.node_ids[cell]).all()


def test_plane_in_the_contact_has_nothing_to_open():
    mesh = both()
    with pytest.raises(fs.ToolError, match="open already"):
        fs.crack(mesh, fs.Plane((3, 2.5, 4), (0, 0, 1)))


def test_divisions_that_do_not_match_stay_as_they_are():
    low, high = both().points, both(seed=2).points
    mesh = both()
    points = mesh.points.copy()
    moved = np.isin(mesh.node_ids, mesh.groups["CON_B", "node"].ids) & (points[:, 0] > 2.5)
    points[moved, :2] += 0.05
    assert len(low) == len(high)
    other = fs.Mesh(points, mesh.cells)
    result = fs.crack(other, PLANE)
    assert 0 < result.report.welded_pairs < 42


@needs_ccx
@pytest.mark.parametrize("kind", ["flat", "curved", "flat second", "hexahedra"])
@pytest.mark.parametrize("operate", [lambda m: fs.crack(m, PLANE), lambda m: fs.refine(m, PLANE, 0.6)])
def test_linear_field_across_the_contact(tmp_path, kind, operate):
    """All nodes at one place tied to each other; exact only if every one has its partner."""
    mesh = contact_cases.bodies(kind, np.random.default_rng(1))
    ((name, cells),) = mesh.cells.items()
    label = {"tetra": "C3D4", "tetra10": "C3D10", "hexahedron": "C3D8"}[name]
    mesh = deck(tmp_path, mesh.points, cells, label, "*SOLID SECTION, ELSET=EALL, MATERIAL=M")
    result = operate(mesh)
    assert result.report.welded_pairs > 40
    assert largest_error(tmp_path, result.mesh, (6, 5, 8), (0, 1, 2)) < 1e-7


def test_equations_between_pairs_follow(tmp_path):
    """Each pair is glued by equations, so is each new one."""
    mesh = both()
    a, b = (mesh.groups[g, "node"].ids for g in ("CON_A", "CON_B"))
    ((_, cells),) = mesh.cells.items()
    lines = [f"2\n{m}, {k}, 1., {n}, {k}, -1." for n, m in zip(a, b) for k in (1, 2, 3)]
    section = "\n".join(["*EQUATION", *lines, "*SOLID SECTION, ELSET=EALL, MATERIAL=M"])
    mesh = deck(tmp_path, mesh.points, cells, "C3D4", section)
    result = fs.refine(mesh, PLANE, 0.6)
    fs.write(result.mesh, tmp_path / "out.inp")
    text = (tmp_path / "out.inp").read_text().split("*EQUATION")[1:]
    related = set()
    for card in text:
        rows = card.split("*")[0].replace("\n", ",").split(",")
        numbers = [r.strip() for r in rows if r.strip()]
        for k in range(0, len(numbers), 7):
            related.add(frozenset((int(numbers[k + 1]), int(numbers[k + 4]))))
    places = {}
    for n, x in zip(result.mesh.node_ids, result.mesh.points):
        places.setdefault(tuple(x), []).append(int(n))
    pairs = [p for p in places.values() if len(p) == 2]
    assert len(pairs) > 60
    assert all(frozenset(p) in related for p in pairs)
    assert not [w for w in result.report.warnings if "relat" in w]
