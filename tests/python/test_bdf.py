# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nastran decks: what another reader makes of ours, and closed loops through Python."""

import numpy as np
import pytest

import femscalpel as fs
from meshes import box_with_groups, quadratic, grid_box


def second_order_brick(kind):
    """One element of a kind with mid-side nodes where its edges say, its corners off a cube's."""
    corners = {"hexahedron20": 8, "wedge15": 6, "pyramid13": 5, "tetra10": 4}[kind]
    edges = {
        8: [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)],
        6: [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
        5: [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)],
        4: [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
    }[corners]
    base = {
        8: [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 2), (1, 0, 2), (1, 1, 2), (0, 1, 2)],
        6: [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 2), (1, 0, 2), (0, 1, 2)],
        5: [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 0.5, 2)],
        4: [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 2)],
    }[corners]
    points = np.array(base, float)
    points = np.concatenate([points, [points[list(e)].mean(axis=0) for e in edges]])
    return fs.Mesh(points, {kind: [range(len(points))]})


@pytest.mark.parametrize("kind", ["hexahedron20", "wedge15", "pyramid13", "tetra10"])
def test_order_of_middle_nodes(tmp_path, kind):
    """As the guide to Nastran has it: edges of the base, upright ones, edges of the top."""
    path = tmp_path / "a.bdf"
    fs.write(second_order_brick(kind), path)
    text = path.read_text().split("BEGIN BULK\n")[1]
    card = text[text.index("\nC") + 1 :].replace("\n+       ", "").split("\n")[0].ljust(8 * 23)
    nodes = [int(card[k : k + 8]) for k in range(24, len(card.rstrip()), 8)]
    points = {n + 1: p for n, p in enumerate(second_order_brick(kind).points)}
    edges = {
        "hexahedron20": "12 23 34 41 15 26 37 48 56 67 78 85",
        "wedge15": "12 23 31 14 25 36 45 56 64",
        "pyramid13": "12 23 34 41 15 25 35 45",
        "tetra10": "12 23 31 14 24 34",
    }[kind].split()
    corners = len(nodes) - len(edges)
    for node, (a, b) in zip(nodes[corners:], edges):
        ends = [points[nodes[int(k) - 1]] for k in (a, b)]
        np.testing.assert_array_equal(points[node], np.mean(ends, axis=0))


@pytest.mark.parametrize("make", [box_with_groups, lambda: quadratic(grid_box())])
def test_read_by_pynastran(tmp_path, make):
    bdf = pytest.importorskip("pyNastran.bdf.bdf", reason="pyNastran is not installed")
    mesh = make()
    path = tmp_path / "box.bdf"
    fs.write(mesh, path)
    model = bdf.read_bdf(str(path), xref=False, debug=None)
    assert sorted(model.nodes) == sorted(mesh.node_ids)
    (cells,) = mesh.cells.values()
    for number, nodes in zip(next(iter(mesh.cell_ids.values())).tolist(), mesh.node_ids[cells]):
        assert [n for n in model.elements[number].node_ids if n] == nodes.tolist()
    for number, point in zip(mesh.node_ids.tolist(), mesh.points):
        np.testing.assert_array_equal(model.nodes[number].xyz, point)
    sets = model.case_control_deck.subcases[0].params
    filled = [g for g in mesh.groups.all() if len(g)]
    for name, (value, _, kind) in sets.items():
        if kind == "SET-type":
            listed = set(value) if isinstance(value, (list, tuple)) else {value}
            assert any(expanded(listed) == set(g.ids.tolist()) for g in filled), name
    assert sum(kind == "SET-type" for _, _, kind in sets.values()) == len(filled)


def expanded(values):
    out = set()
    for v in values:
        if isinstance(v, str):
            first, last = v.split("THRU")
            out |= set(range(int(first), int(last) + 1))
        else:
            out.add(int(v))
    return out


def test_losses_are_told(tmp_path):
    mesh = box_with_groups()
    mesh.unit = "mm"
    moved = fs.Mesh(mesh.points + 1 / 3e6 + 1000, mesh.cells)
    moved.add_group("SIDE", "facet", [(1, 1)])
    with pytest.warns(
        UserWarning, match="facet group 'SIDE'; the last digits of the coordinates of 210 nodes .they are off by"
    ):
        fs.write(moved, tmp_path / "box.nas")
    with pytest.warns(UserWarning, match="box.dat does not hold the unit 'mm'"):
        fs.write(mesh, tmp_path / "box.dat")
    assert np.abs(fs.read(tmp_path / "box.nas").points - moved.points).max() < 1e-10


def test_cracked(tmp_path):
    result = fs.crack(box_with_groups(), fs.Plane(origin=(3, 2.5, 2.2), normal=(0.1, 0.2, 1)), name="CRACK")
    with pytest.warns(UserWarning, match="last digits"):
        fs.write(result.mesh, tmp_path / "cracked.bdf")
    back = fs.read(tmp_path / "cracked.bdf")
    np.testing.assert_array_equal(back.cell_ids["tetra"], result.mesh.cell_ids["tetra"])
    np.testing.assert_array_equal(back.cells["tetra"], result.mesh.cells["tetra"])
    for group in result.mesh.groups.all():
        np.testing.assert_array_equal(np.sort(back.groups[group.name, group.kind].ids), np.sort(group.ids))
