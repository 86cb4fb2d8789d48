# SPDX-License-Identifier: LGPL-2.1-or-later
"""Beams that end on shells and solids."""

import numpy as np
import pytest

import femscalpel as fs
from calculix_runs import solve
from merge_parts import check_untouched, half_pipe, plate, worst
from meshes import grid_box, quadratic, tetra_volumes
from test_physics import needs_ccx
from test_merge import check_middles, second_order_triangles
from test_merge_decks import cards
from test_tie import hexahedra, with_deck


def beam(start, end, count=4, name="BEAM"):
    points = np.linspace(start, end, count + 1)
    cells = np.stack([np.arange(count), np.arange(1, count + 1)], axis=1)
    return fs.Mesh(points, {"line": cells}, groups={name: ("element", np.arange(1, count + 1))})


def joint_node(mesh):
    (number,) = mesh.groups["ADD_SEAM"].ids
    return int(np.flatnonzero(mesh.node_ids == number)[0])


@pytest.fixture(scope="module")
def floor():
    return plate((0, 0, 0), (10, 0, 0), (0, 10, 0), (10, 10), "FLOOR", jitter=0.2)


PLACES = {
    "in a triangle": (5.3, 4.4, 0),
    "near a node": (4.05, 5.04, 0),
    "on the border": (0, 4.4, 0),
    "near a corner": (0.05, 0.03, 0),
    "in a corner": (0, 0, 0),
    "in an element at the border": (0.3, 3.6, 0),
}


@pytest.mark.parametrize("height", [0, 0.03, -0.02])
@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("place", PLACES)
def test_on_a_shell(floor, place, order, height):
    base = second_order_triangles(floor) if order == 2 else floor
    at = np.array(PLACES[place])
    post = beam(at + [0, 0, height], at + [0, 1, 3])
    result = fs.merge(base, post)
    mesh = result.mesh
    mesh.validate()
    node = joint_node(mesh)
    assert mesh.points[node] == pytest.approx(at, abs=0.06 if place == "near a corner" else 1e-9)
    triangles, lines = ("triangle6", "line3") if order == 2 else ("triangle", "line")
    assert node in mesh.cells[triangles] and node in mesh.cells[lines] and mesh.cells[lines].shape[0] == 4
    assert np.abs(mesh.points[mesh.cells[triangles]][:, :, 2]).max() == 0
    points = mesh.points[mesh.cells[triangles][:, :3]]
    area = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])[:, 2] / 2
    assert area.min() > 0 and area.sum() == pytest.approx(100, rel=1e-12)
    assert worst(mesh) > 0.25
    assert len(mesh.groups["ADD_ADDED"]) == len(mesh.groups["BEAM"]) == 4
    assert not result.report.warnings
    check_untouched(base, mesh, lambda x: np.linalg.norm(x - at, axis=1) > 3.5)
    if order == 2:
        check_middles(mesh.points, mesh.cells["triangle6"], ((0, 1), (1, 2), (2, 0)))
        check_middles(mesh.points, mesh.cells["line3"], ((0, 1),))


@pytest.mark.parametrize("seed", range(40))
def test_random_beams(seed):
    rng = np.random.default_rng(seed)
    n = rng.integers(6, 20)
    base = (
        plate((0, 0, 0), (10, 0, 0), (0, 10, 0), (n, n), "FLOOR", rng.uniform(0, 0.2), seed),
        half_pipe(5, 10, (rng.integers(14, 40), rng.integers(4, 14)), "FLOOR"),
        grid_box((n // 2, n // 2, 3), (10.0, 10.0, 4.0)),
    )[seed % 3]
    if seed % 3 == 1:
        angle, x = rng.uniform(0.1, 3), rng.uniform(0.1, 9.9)
        ends = [np.array([x, r * np.cos(angle), r * np.sin(angle)]) for r in (5, 7)]
    else:
        ends = [np.append(rng.uniform(0.1, 9.9, 2), z) for z in ((4, 6) if seed % 3 == 2 else (0, 2))]
    result = fs.merge(base, beam(*ends, count=rng.integers(1, 5)))
    mesh = result.mesh
    mesh.validate()
    node = joint_node(mesh)
    assert np.linalg.norm(mesh.points[node] - ends[0]) < 0.1
    assert node in mesh.cells["line"]
    assert worst(mesh) > min(0.16, 0.9 * worst(base))
    if seed % 3 == 2:
        assert node in mesh.cells["tetra"]
        volumes = tetra_volumes(mesh.points, mesh.cells["tetra"])
        assert volumes.min() > 0 and volumes.sum() == pytest.approx(400, rel=1e-9)
    else:
        area = lambda m: np.linalg.norm(  # noqa: E731
            np.cross(*(m.points[m.cells["triangle"][:, k]] - m.points[m.cells["triangle"][:, 0]] for k in (1, 2))),
            axis=1,
        ).sum()
        assert area(mesh) == pytest.approx(area(base), rel=1e-9 if seed % 3 == 0 else 5e-3)


def test_a_frame_with_four_feet(floor):
    corners = [(2.2, 2.3, 0), (7.1, 2.4, 0), (7.3, 7.2, 0), (2.4, 7.7, 0)]
    points = np.array(corners + [(4.8, 5.1, 3)])
    frame = fs.Mesh(points, {"line": [(k, 4) for k in range(4)]})
    mesh = fs.merge(floor, frame).mesh
    assert len(mesh.groups["ADD_SEAM"]) == 4
    found = mesh.points[np.isin(mesh.node_ids, mesh.groups["ADD_SEAM"].ids)]
    assert np.sort(found, axis=0) == pytest.approx(np.sort(points[:4], axis=0), abs=1e-9)
    # A beam whose both ends are there, and two that end at one place.
    arch = fs.Mesh(
        np.array([corners[0], (4, 4, 2), corners[2], corners[2], (9, 9, 2)]), {"line": [(0, 1), (1, 2), (3, 4)]}
    )
    mesh = fs.merge(floor, arch).mesh
    assert len(mesh.groups["ADD_SEAM"]) == 2 and mesh.cells["line"][1, 1] == mesh.cells["line"][2, 0]


def test_on_a_solid_it_is_told_that_nothing_turns():
    for base in (grid_box((6, 5, 4), (6.0, 5.0, 4.0)), quadratic(grid_box((6, 5, 4), (6.0, 5.0, 4.0)))):
        result = fs.merge(base, beam((3.3, 2.4, 4), (3.3, 2.4, 7)))
        (warning,) = result.report.warnings
        assert "1 beams end on nodes of solids" in warning and "no moment" in warning
        kind = "tetra10" if "tetra10" in result.mesh.cells else "tetra"
        assert tetra_volumes(result.mesh.points, result.mesh.cells[kind]).sum() == pytest.approx(120)


def test_on_a_node_of_hexahedra_nothing_changes():
    base = hexahedra((0, 0, 0), (2, 2, 4), (2, 2, 4), "LOW")
    mesh = fs.merge(base, beam((1, 1, 4), (1, 1, 6))).mesh
    assert mesh.node_count == base.node_count + 4
    assert (mesh.points[: base.node_count] == base.points).all()
    beside = fs.merge(base, beam((1.3, 1.2, 4), (1, 1, 6)))
    assert beside.report.converted["hexahedron"] > 0 and len(beside.mesh.groups["ADD_SEAM"]) == 1
    beside.mesh.validate()


@pytest.mark.parametrize(
    "base, other, options, parameter, words",
    [
        ("floor", beam((5, 5, 1), (5, 5, 3)), {}, "other", "is 1 off"),
        ("floor", beam((50, 5, 1), (50, 5, 3)), {}, "other", "no beam of the addition ends"),
        ("box", beam((3.3, 2.4, 2), (3.3, 2.4, 7)), {}, "other", "ends inside the solid"),
        ("floor", beam((5, 5, 0), (5, 5, 3)), {"method": "tie"}, "method", "'conform'"),
        ("floor", beam((5, 5, 0), (5, 5, 3)), {"keep_side": (0, 0, 1)}, "keep_side", "not for beams"),
        ("beam", beam((5, 5, 0), (5, 5, 3)), {}, "other", "cannot be joined"),
    ],
)
def test_what_cannot_be_joined(floor, base, other, options, parameter, words):
    base = {"floor": floor, "box": grid_box((6, 5, 4), (6.0, 5.0, 4.0)), "beam": beam((0, 0, 0), (5, 5, 0))}[base]
    with pytest.raises(fs.Error) as caught:
        fs.merge(base, other, **options)
    assert words in str(caught.value) and caught.value.parameter == parameter


@needs_ccx
def test_a_post_on_a_plate(tmp_path):
    """A plate held all around, a post on its middle that is pushed sideways: its foot turns and its tip moves as on a
    mesh that had a node there already, within 5 %: under a moment at a point, that depends on the elements there."""
    tip = {}
    for name, counts, jitter in (("had", (16, 16), 0), ("gets", (15, 17), 0.15)):
        folder = tmp_path / name
        folder.mkdir()
        base = second_order_triangles(plate((0, 0, 0), (10, 0, 0), (0, 10, 0), counts, "FLOOR", jitter=jitter))
        base.add_group("FLOOR", "element", base.cell_ids["triangle6"])
        x = base.points
        held = (x[:, 0] < 1e-9) | (x[:, 0] > 10 - 1e-9) | (x[:, 1] < 1e-9) | (x[:, 1] > 10 - 1e-9)
        base.add_group("HELD", "node", base.node_ids[held])
        deck = "*MATERIAL, NAME=M\n*ELASTIC\n210000., 0.3\n*SHELL SECTION, ELSET=FLOOR, MATERIAL=M\n0.2\n"
        deck += "*STEP\n*STATIC\n*BOUNDARY\nHELD, 1, 6\n*END STEP\n"
        post = beam((5, 5, 0), (5, 5, 4))
        post.add_group("TIP", "node", [5])
        own = "*MATERIAL, NAME=M\n*ELASTIC\n70000., 0.3\n"
        own += "*BEAM SECTION, ELSET=BEAM, MATERIAL=M, SECTION=RECT\n0.4, 0.4\n1., 0., 0.\n"
        (folder / "post").mkdir()
        result = fs.merge(with_deck(folder, base, deck), with_deck(folder / "post", post, own))
        assert not result.report.warnings
        fs.write(result.mesh, folder / "out.inp")
        text = (folder / "out.inp").read_text()
        assert cards(text, "BEAMSECTION") == [
            ["*BEAM SECTION, ELSET=BEAM, MATERIAL=ADD_M, SECTION=RECT", "0.4, 0.4", "1., 0., 0."]
        ]
        text = text.replace("*END STEP", "*CLOAD\nTIP, 1, 1.\n*NODE PRINT, NSET=TIP\nU\n*END STEP")
        u, _ = solve(folder, text)
        (tip[name],) = u.values()
    print(f"\npost: {tip}")
    bending = 4**3 / (3 * 70000 * 0.4**4 / 12)
    assert tip["gets"][0] == pytest.approx(tip["had"][0], rel=0.05)
    assert tip["gets"][0] > 1.1 * bending
