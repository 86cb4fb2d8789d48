# SPDX-License-Identifier: LGPL-2.1-or-later
"""fs.pieces: what a mesh falls into."""

import numpy as np
import pytest

import femscalpel as fs
from meshes import grid_box


def box(*counts_and_size):
    """6 x 5 x 4, if nothing else is said, with the node groups of both ends in x."""
    plain = grid_box(*counts_and_size)
    ids = 10 * np.arange(1, plain.node_count + 1)
    ends = {
        name: ("node", ids[plain.points[:, 0] == x]) for name, x in (("LOW", 0), ("HIGH", plain.points[:, 0].max()))
    }
    return fs.Mesh(plain.points, plain.cells, ids, None, ends)


def test_whole_body_is_one_piece():
    mesh = box()
    (piece,) = fs.pieces(mesh)
    assert piece.dimension == 3
    assert piece.measure == pytest.approx(fs.measure(mesh)["tetra"].sum())
    assert piece.place == pytest.approx(tuple(mesh.points.max(axis=0) / 2))
    np.testing.assert_array_equal(piece.nodes, mesh.node_ids)
    np.testing.assert_array_equal(piece.elements, np.sort(mesh.cell_ids["tetra"]))
    assert piece.groups == [("LOW", "node"), ("HIGH", "node")]
    assert "volume 120" in repr(piece)


def test_crack_through_the_part_makes_two():
    mesh = box()
    length = mesh.points[:, 0].max()
    result = fs.crack(mesh, fs.Plane((length / 3, 0, 0), (1, 0, 0)))
    assert result.report.warnings == fs.crack(mesh, fs.Plane((length / 3, 0, 0), (1, 0, 0))).report.warnings
    large, small = fs.pieces(result.mesh)
    assert large.measure == pytest.approx(2 * small.measure)
    assert large.place[0] == pytest.approx(2 * length / 3) and small.place[0] == pytest.approx(length / 6)
    assert {name for name, _ in large.groups} == {"HIGH", "CRACK_P"}
    assert {name for name, _ in small.groups} == {"LOW", "CRACK_N"}
    assert not set(large.nodes) & set(small.nodes) and not set(large.elements) & set(small.elements)
    assert len(large.nodes) + len(small.nodes) == result.mesh.node_count
    assert len(large.elements) + len(small.elements) == result.mesh.cell_count


def test_crack_that_ends_inside_leaves_one():
    mesh = box()
    x, y, z = mesh.points.max(axis=0) / 2
    result = fs.crack(mesh, fs.Plane((x, y, z), (1, 0, 0)), within=fs.HalfPlane((x, y, z), (0, 1, 0)))
    assert len(fs.pieces(result.mesh)) == 1


def test_shells_and_beams_are_pieces_of_their_own():
    points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [5, 0, 0], [7, 0, 0], [9, 9, 9]]
    cells = {"line": [[3, 4]], "triangle": [[0, 1, 2]], "vertex": [[5]]}
    shell, beam = fs.pieces(fs.Mesh(points, cells))
    assert (shell.dimension, shell.measure) == (2, pytest.approx(0.5))
    assert (beam.dimension, beam.measure, beam.place) == (1, 2, (6, 0, 0))
    assert shell.place == pytest.approx((1 / 3, 1 / 3, 0))
    assert fs.pieces(fs.Mesh([[0, 0, 0]], {})) == []


def test_many_pieces():
    count = 20000
    points = np.repeat(np.arange(count), 2)[:, None] + np.array([[0, 0, 0]] * 2 * count)
    points[1::2, 1] += 1
    found = fs.pieces(fs.Mesh(points, {"line": np.arange(2 * count).reshape(-1, 2)}))
    assert len(found) == count
    assert all(len(piece.nodes) == 2 and len(piece.elements) == 1 for piece in found)


@pytest.mark.parametrize("origin", [12.3, 13.0, 13.6])
def test_part_of_a_mesh_after_a_crack(origin):
    mesh, plane = box((30, 5, 4), (30.0, 5.0, 4.0)), fs.Plane((origin, 0, 0), (1, 0.1, 0.2))
    whole, band = fs.crack(mesh, plane), fs.crack(mesh, plane, band_only=True)
    assert band.mesh.cell_count < whole.mesh.cell_count
    gone = np.setdiff1d(mesh.cell_ids["tetra"], whole.mesh.cell_ids["tetra"])
    assert len(gone) == whole.report.elements_removed
    expected, found = fs.pieces(whole.mesh), fs.pieces(mesh, band.mesh, gone)
    assert len(found) == len(expected) == 2
    for a, b in zip(found, expected):
        np.testing.assert_array_equal(a.elements, b.elements)
        np.testing.assert_array_equal(a.nodes, b.nodes)
        assert a.measure == pytest.approx(b.measure) and a.place == pytest.approx(b.place)
        assert a.groups == [g for g in b.groups if not g[0].startswith("CRACK")]
    inner = fs.HalfPlane((origin, 2, 2), (0, 1, 0))
    band = fs.crack(mesh, plane, within=inner, band_only=True)
    assert len(fs.pieces(mesh, band.mesh, gone)) == 1


def test_arguments():
    with pytest.raises(TypeError, match="mesh must be a femscalpel.Mesh"):
        fs.pieces("mesh.med")
    with pytest.raises(TypeError, match="changed must be a femscalpel.Mesh"):
        fs.pieces(box(), "mesh.med")
    for gone, kind, text in (
        ([1], ValueError, "needs changed"),
        ([[1]], ValueError, "one-dimensional"),
        ([1.5], TypeError, "integers"),
    ):
        with pytest.raises(kind, match=text) as error:
            fs.pieces(box(), None, gone)
        assert error.value.parameter == "gone"
