# SPDX-License-Identifier: LGPL-2.1-or-later
"""Quadrangles and hexahedra near a tool become triangles, tetrahedra and pyramids: CalculiX itself says whether what is
made fits together. With the lips of a crack tied and a linear displacement prescribed outside, it must be linear
everywhere."""

import itertools
import re
import shutil

import mixed_cases
import numpy as np
import pytest
from calculix_runs import solve
from mixed_meshes import grid, outer_area, prisms_of, second_order, worst_of

import femscalpel as fs

needs_ccx = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")

GRADIENT = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 10.0]]) * 1e-3


def deck(folder, points, cells, label, section):
    lines = ["*NODE, NSET=NALL"] + ["%d, %.15g, %.15g, %.15g" % (n + 1, *x) for n, x in enumerate(points)]
    lines.append(f"*ELEMENT, TYPE={label}, ELSET=EALL")
    for e, cell in enumerate(cells):
        row = [str(e + 1)] + [str(n + 1) for n in cell]
        lines.append(", ".join(row[:16]) + ("," if len(row) > 16 else ""))
        lines += [", ".join(row[16:])] if len(row) > 16 else []
    lines += ["*MATERIAL, NAME=M", "*ELASTIC", "1000, 0.3", section, ""]
    (folder / "in.inp").write_text("\n".join(lines))
    return fs.read(folder / "in.inp")


def largest_error(folder, mesh, size, axes):
    """Of the displacement, where it is prescribed to be linear outside and lips are tied."""
    fs.write(mesh, folder / "out.inp")
    used = np.zeros(mesh.node_count, bool)
    for cells in mesh.cells.values():
        used[np.unique(cells)] = True
    x, ids = mesh.points, mesh.node_ids
    dependent = {int(n) for n in re.findall(r"(?m)^3\n(\d+), ", (folder / "out.inp").read_text())}  # of edges' ends
    outside = ((x < 1e-9) | (x > np.array(size) - 1e-9))[:, axes].any(axis=1)
    boundary = [
        f"{ids[n]}, {k + 1}, {k + 1}, {(GRADIENT @ x[n])[k]:.14e}"
        for n, k in itertools.product(np.flatnonzero(outside & used & ~np.isin(ids, list(dependent))), axes)
    ]
    at, ties = {}, []
    for n in np.flatnonzero(used & ~outside):
        first = at.setdefault(tuple(np.round(x[n], 7)), ids[n])
        ties += [f"2\n{ids[n]}, {k + 1}, 1., {first}, {k + 1}, -1." for k in axes if first != ids[n]]
    assert ties
    text = (folder / "out.inp").read_text() + "\n".join(
        [
            "*EQUATION",
            *ties,
            "*NSET, NSET=ALL_OF_THEM",
            *map(str, ids[used]),
            "*STEP",
            "*STATIC",
            "*BOUNDARY",
            *boundary,
        ]
        + ["*NODE PRINT, NSET=ALL_OF_THEM", "U", "*END STEP", ""]
    )
    # Read and written once more: what is written for pyramids goes by the supports then.
    (folder / "all.inp").write_text(text)
    fs.write(fs.read(folder / "all.inp"), folder / "all.inp")
    displacements, _ = solve(folder, (folder / "all.inp").read_text())
    assert len(displacements) == used.sum()
    return max(abs(displacements[i] - GRADIENT @ p)[list(axes)].max() for i, p in zip(ids, x) if i in displacements)


@needs_ccx
@pytest.mark.parametrize(
    "label, jitter",
    # CalculiX's C3D8I and C3D8R are exact only where they are parallelepipeds.
    [("C3D8", 0.2), ("C3D8I", 0), ("C3D8R", 0), ("C3D20", 0.2), ("C3D20R", 0.2)],
)
def test_patch_of_hexahedra(tmp_path, label, jitter):
    points, cells = grid((15, 6, 5), jitter)
    if "20" in label:
        points, cells = second_order(points, cells, "hexahedron")
    mesh = deck(tmp_path, points, cells, label, "*SOLID SECTION, ELSET=EALL, MATERIAL=M")
    result = fs.crack(mesh, fs.Plane((4.7, 3, 2.5), (1, 0.2, 0.1)))
    kinds = {k for k, c in result.mesh.cells.items() if len(c)}
    assert kinds >= ({"tetra10", "pyramid13", "hexahedron20"} if "20" in label else {"tetra", "pyramid", "hexahedron"})
    assert largest_error(tmp_path, result.mesh, (15, 6, 5), (0, 1, 2)) < 1e-7
    back = fs.read(tmp_path / "out.inp")
    assert {k: len(back.cells[k]) for k in back.cells} == {
        k: len(c) for k, c in result.mesh.cells.items() if k[:3] in ("tet", "pyr", "hex")
    }


@needs_ccx
@pytest.mark.parametrize("label, jitter", [("C3D8", 0.2), ("C3D8I", 0), ("C3D8R", 0)])
def test_patch_with_a_second_order_band(tmp_path, label, jitter):
    points, cells = grid((15, 6, 5), jitter)
    mesh = deck(tmp_path, points, cells, label, "*SOLID SECTION, ELSET=EALL, MATERIAL=M")
    result = fs.crack(mesh, fs.Plane((4.7, 3, 2.5), (1, 0.2, 0.1)), second_order=True)
    kinds = {k for k, c in result.mesh.cells.items() if len(c)}
    assert kinds == {"triangle6", "tetra10", "pyramid13", "hexahedron20", "hexahedron"}
    group = next(g for g in result.report.groups if g.name == "EALL")
    assert group.measure_after == pytest.approx(group.measure_before, rel=1e-12)
    assert group.count_after == sum(len(result.mesh.cells[k]) for k in kinds - {"triangle6"})
    assert result.report.nodes_added == result.mesh.node_count - mesh.node_count
    assert largest_error(tmp_path, result.mesh, (15, 6, 5), (0, 1, 2)) < 1e-7


def test_a_second_order_band_leaves_springs_and_beams(tmp_path):
    """Between its nodes; of segments only those on its edges follow."""
    points, cells = grid((20, 2, 2))
    deck(tmp_path, points, cells, "C3D8", "*SOLID SECTION, ELSET=EALL, MATERIAL=M")
    at = {tuple(x): n + 1 for n, x in enumerate(points.tolist())}
    text = (tmp_path / "in.inp").read_text() + (
        f"*ELEMENT, TYPE=SPRINGA, ELSET=SPRING\n501, {at[9, 0, 0]}, {at[8, 0, 0]}\n502, {at[9, 0, 0]}, {at[8, 2, 2]}\n"
        "*SPRING, ELSET=SPRING\n\n1.\n"
        f"*ELEMENT, TYPE=T3D2, ELSET=ROD\n503, {at[9, 2, 0]}, {at[7, 0, 2]}\n504, {at[9, 2, 2]}, {at[8, 2, 2]}\n"
        "*SOLID SECTION, ELSET=ROD, MATERIAL=M\n1.\n*STEP\n*STATIC\n*END STEP\n"
    )
    (tmp_path / "rods.inp").write_text(text)
    mesh = fs.read(tmp_path / "rods.inp")
    result = fs.crack(mesh, fs.Plane((10.4, 1, 1), (1, 0.1, 0)), second_order=True)
    assert sorted(result.mesh.cell_ids["line"]) == [501, 502, 503]
    assert sorted(result.mesh.cell_ids["line3"]) == [504]


def test_a_second_order_band_needs_a_deck():
    points, cells = grid((6, 3, 3))
    mesh = fs.Mesh(points, {"hexahedron": cells})
    with pytest.raises(fs.ToolError, match="CalculiX deck"):
        fs.crack(mesh, fs.Plane((2.7, 1, 1), (1, 0.2, 0.1)), second_order=True)
    assert "hexahedron20" not in fs.crack(mesh, fs.Plane((3, 1, 1), (1, 0, 0)), second_order=True).mesh.cells


@needs_ccx
@pytest.mark.parametrize("label", ["CPS4", "CPE4R", "CPS8R", "CPE8"])
def test_patch_of_quadrangles(tmp_path, label):
    points, cells = grid((14, 6), 0 if label.endswith("4R") else 0.2)
    if "8" in label:
        points, cells = second_order(points, cells, "quad")
    mesh = deck(tmp_path, points, cells, label, "*SOLID SECTION, ELSET=EALL, MATERIAL=M\n0.1")
    result = fs.crack(mesh, fs.Plane((4.7, 3, 0), (1, 0.2, 0)))
    assert result.report.converted and result.report.quality.after.minimum > 0.4
    assert largest_error(tmp_path, result.mesh, (14, 6, 1), (0, 1)) < 1e-7
    assert ("TYPE=%s6" if "8" in label else "TYPE=%s3") % label[:3] in (tmp_path / "out.inp").read_text()


@pytest.mark.parametrize("order", [1, 2])
def test_what_is_beyond_the_pyramids_stays_to_the_last_bit(order):
    points, cells = grid((16, 5, 4), 0.2)
    kind = "hexahedron"
    if order == 2:
        points, cells = second_order(points, cells, kind)
        kind = "hexahedron20"
    mesh = fs.Mesh(points, {kind: cells})
    result = fs.crack(mesh, fs.Plane((5.3, 2, 2), (1, 0.2, 0.1)))
    place = dict(zip(result.mesh.node_ids, result.mesh.points))
    ids, left = result.mesh.node_ids, dict(zip(result.mesh.cell_ids[kind], result.mesh.cells[kind]))
    was = dict(zip(mesh.cell_ids[kind], mesh.cells[kind]))
    assert 60 < len(left) == len(was) - result.report.converted[kind]
    for number, nodes in left.items():
        assert (ids[nodes] == mesh.node_ids[was[number]]).all()
        assert all((place[i] == x).all() for i, x in zip(mesh.node_ids[was[number]], points[was[number]]))
    volume = sum(v.sum() for k, v in fs.measure(result.mesh).items() if k[:3] in ("tet", "pyr", "hex"))
    assert volume == pytest.approx(320, rel=1e-9)


@pytest.mark.parametrize("kind", ["wedge", "mixed"])
def test_conversion_goes_on_where_pyramids_would_be_poor(kind):
    """Two warped faces of one prism were to have pyramids, which came out with a mean ratio of 0.02."""
    mesh, tool, *_ = mixed_cases.make(kind, 4)
    result = fs.crack(mesh, tool)
    assert worst_of(result.mesh) > 0.1
    assert any(k.startswith("pyramid") for k in result.mesh.cells)


def block(kind, order):
    """A block 18 by 8 by 6 with the groups ALL and END (the nodes at x = 18)."""
    points, cells = grid((18, 8, 6))
    if kind == "wedge":
        cells = prisms_of(cells)
    name = kind
    if order == 2:
        points, cells = second_order(points, cells, kind)
        name = {"hexahedron": "hexahedron20", "wedge": "wedge15"}[kind]
    mesh = fs.Mesh(points, {name: cells})
    mesh.add_group("ALL", "element", mesh.cell_ids[name])
    mesh.add_group("END", "node", mesh.node_ids[points[:, 0] == 18])
    return mesh


def check_converted(mesh, result, lost, kind):
    (record,) = [g for g in result.report.groups if g.name == "ALL"]
    assert record.count_before == len(mesh.groups["ALL", "element"].ids)
    assert record.measure_before - record.measure_after == pytest.approx(lost, rel=0.03)
    assert result.report.quality.after.minimum > 0.3 and worst_of(result.mesh) > 0.2
    names = {k.rstrip("0123456789") for k in result.mesh.cells}
    assert {kind, "tetra", "pyramid"} <= names or (kind == "wedge" and {kind, "tetra"} <= names)
    outer_area(result.mesh)  # which fails where faces do not fit
    assert sum(result.report.converted.values()) > 0


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("kind", ["hexahedron", "wedge"])
def test_an_edge_of_hexahedra_is_rounded(kind, order):
    mesh = block(kind, order)
    result = fs.fillet(mesh, (18, 8, 3), 1.2, name="T")
    check_converted(mesh, result, (1 - np.pi / 4) * 1.2**2 * 6, kind)
    x = result.mesh.points[np.unique(result.mesh.cells["triangle" if order == 1 else "triangle6"])]
    assert np.allclose(np.hypot(x[:, 0] - 16.8, x[:, 1] - 6.8), 1.2, atol=1e-9)


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("kind", ["hexahedron", "wedge"])
def test_a_wall_of_hexahedra_is_moved(kind, order):
    mesh = block(kind, order)
    result = fs.reshape(mesh, "END", by=(-0.7, 0, 0), name="T")
    check_converted(mesh, result, 0.7 * 48, kind)
    on = np.isin(result.mesh.node_ids, result.mesh.groups["END", "node"].ids)
    assert np.allclose(result.mesh.points[on, 0], 17.3)


def test_a_corner_and_a_border_of_quadrangles():
    points, cells = grid((18, 8))
    mesh = fs.Mesh(points, {"quad": cells})
    mesh.add_group("END", "node", mesh.node_ids[points[:, 0] == 18])
    rounded = fs.fillet(mesh, (18, 8, 0), 1.2, name="T").mesh
    moved = fs.reshape(mesh, "END", by=(0.7, 0, 0), name="T").mesh
    for after, area in ((rounded, 144 - (1 - np.pi / 4) * 1.2**2), (moved, 144 + 0.7 * 8)):
        assert {"quad", "triangle"} <= set(after.cells) and worst_of(after) > 0.4
        total = sum(v.sum() for k, v in fs.measure(after).items() if k in ("quad", "triangle"))
        assert total == pytest.approx(area, abs=0.02)


@pytest.mark.parametrize("refine", [None, 4, 2])
@pytest.mark.parametrize("at", [(25, 10, 0), (25, 15, 0), (25, 11, 0)])
def test_hole_between_the_nodes_of_hexahedra(at, refine):
    """It parts none of their nodes, but some of the tetrahedra that they become when these are refined."""
    points, cells = grid((4, 2, 2))
    result = fs.drill(fs.Mesh(10 * points, {"hexahedron": cells}), fs.Cylinder(at, (0, 0, 1), 4), refine=refine)
    volume = sum(v.sum() for k, v in fs.measure(result.mesh).items() if k[:3] in ("tet", "pyr", "hex"))
    assert 40 * 20 * 20 - volume == pytest.approx(np.pi * 4**2 * 20, rel=0.12 if refine == 4 else 0.04)
    assert result.report.converted["hexahedron"] > 0 and worst_of(result.mesh) > 0.1
