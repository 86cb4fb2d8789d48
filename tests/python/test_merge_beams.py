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
        assert "1 beam ends on a node of solids" in warning and "no moment" in warning
        kind = "tetra10" if "tetra10" in result.mesh.cells else "tetra"
        assert tetra_volumes(result.mesh.points, result.mesh.cells[kind]).sum() == pytest.approx(120)


def test_on_a_node_of_hexahedra_nothing_changes():
    base = hexahedra((0, 0, 0), (2, 2, 4), (2, 2, 4), "LOW")
    mesh = fs.merge(base, beam((1, 1, 4), (1, 1, 6))).mesh
    assert mesh.node_count == base.node_count + 4
    assert (mesh.points[: base.node_count] == base.points).all()


def test_off_the_nodes_of_hexahedra_those_there_become_tetrahedra():
    base = hexahedra((0, 0, 0), (8, 8, 8), (8, 8, 8), "LOW")
    result = fs.merge(base, beam((1.3, 1.2, 8), (1, 1, 10)))
    kinds = {k: len(c) for k, c in result.mesh.cells.items()}
    assert kinds["tetra"] > 0 and kinds["pyramid"] > 0 and kinds["hexahedron"] > 0
    assert result.report.converted == {"hexahedron": 512 - kinds["hexahedron"]}
    assert min(v.min() for k, v in fs.measure(result.mesh).items() if len(v)) > 0
    foot = np.nonzero((result.mesh.points == (1.3, 1.2, 8)).all(axis=1))[0]
    assert len(foot) == 1 and foot in result.mesh.cells["tetra"] and foot in result.mesh.cells["line"]


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


def edges_of_shells(mesh):
    """Edges of triangles and faces of tetrahedra, by corners."""
    out = set()
    for name, count in (("triangle", 3), ("triangle6", 3), ("tetra", 4), ("tetra10", 4)):
        cells = np.asarray(mesh.cells.get(name, np.empty((0, count), int)))[:, :count]
        for i in range(count):
            for j in range(i):
                out |= {(min(p), max(p)) for p in cells[:, [i, j]].tolist()}
    return out


def check_joined_along(mesh, count, length):
    """All beams, of a length in sum, are edges of shells or solids; mid-side nodes, too."""
    mesh.validate()
    kind = "line3" if len(mesh.cells.get("line3", ())) else "line"
    beams = np.asarray(mesh.cells[kind])
    known = edges_of_shells(mesh)
    assert len(beams) >= count and all((min(p), max(p)) in known for p in beams[:, :2].tolist())
    ends = mesh.points[beams[:, :2]]
    assert np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum() == pytest.approx(length, rel=2e-3)
    seam = np.flatnonzero(np.isin(mesh.node_ids, mesh.groups["ADD_SEAM"].ids))
    assert set(beams[:, :2].reshape(-1)) <= set(seam)
    if kind == "line3":
        assert set(beams[:, 2]) <= set(np.asarray(mesh.cells["triangle6"]).reshape(-1))
    assert len(mesh.groups["BEAM"]) == len(mesh.groups["ADD_ADDED"]) == len(beams)


ALONG = {
    "across": ((1.3, 2.2, 0), (8.1, 7.7, 0), 5),
    "fine": ((1.3, 2.2, 0), (8.1, 7.7, 0), 40),
    "one": ((0.4, 6.2, 0), (9.7, 5.3, 0), 1),
    "border": ((0, 0, 0), (10, 0, 0), 7),
    "a little off": ((1.3, 2.2, 0.02), (8.1, 7.7, -0.03), 5),
}


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("case", ALONG)
def test_along_a_shell(floor, case, order):
    base = second_order_triangles(floor) if order == 2 else floor
    start, end, count = ALONG[case]
    result = fs.merge(base, beam(start, end, count))
    mesh = result.mesh
    check_joined_along(mesh, count, np.linalg.norm(np.subtract(end, start)))
    assert not result.report.warnings and worst(mesh) > 0.25
    assert np.abs(mesh.points[:, 2]).max() == 0
    assert result.report.nodes_added == mesh.node_count - base.node_count
    count_before, count_after = (sum(map(len, m.cells.values())) for m in (base, mesh))
    assert result.report.elements_added - result.report.elements_removed == count_after - count_before
    way = np.subtract(end, start) / np.linalg.norm(np.subtract(end, start))
    check_untouched(base, mesh, lambda x: np.linalg.norm(np.cross(x - start, way), axis=1) > 4.5)


def test_along_edges_that_are_there_nothing_changes(tmp_path):
    base = plate((0, 0, 0), (10, 0, 0), (0, 10, 0), (10, 10), "FLOOR")
    for floor in (base, second_order_triangles(base)):
        mesh = fs.merge(floor, beam((0, 3, 0), (10, 3, 0), 10)).mesh
        check_joined_along(mesh, 10, 10)
        assert mesh.node_count == floor.node_count and (mesh.points == floor.points).all()
        assert sum(len(c) for n, c in mesh.cells.items() if n.startswith("line")) == 10
        # In a solver's input they are beams, too, not edges of the shells they lie on.
        fs.write(mesh, tmp_path / "plate.inp")
        again = fs.read(tmp_path / "plate.inp")
        assert len(again.groups["BEAM"]) == 10 and again.groups["BEAM"].kind == "element"


@pytest.mark.parametrize("seed", range(30))
def test_random_beams_along(seed):
    rng = np.random.default_rng(seed)
    n = rng.integers(6, 16)
    if seed % 3 == 1:
        base = half_pipe(5, 10, (rng.integers(14, 40), rng.integers(4, 14)), "FLOOR")
        angle, x = np.sort(rng.uniform(0.1, 3, 2)), np.sort(rng.uniform(0.2, 9.8, 2))
        count = int(np.ceil(np.hypot(5 * (angle[1] - angle[0]), x[1] - x[0]) / 0.4))
        t = np.linspace(0, 1, count + 1)
        angles, places = angle[0] + t * (angle[1] - angle[0]), x[0] + t * (x[1] - x[0])
        points = np.stack([places, 5 * np.cos(angles), 5 * np.sin(angles)], axis=1)
        cells = [(k, k + 1) for k in range(count)]
        ring = fs.Mesh(points, {"line": cells}, groups={"BEAM": ("element", range(1, count + 1))})
    else:
        base = plate((0, 0, 0), (10, 0, 0), (0, 10, 0), (n, n), "FLOOR", rng.uniform(0, 0.2), seed)
        if seed % 3 == 2:
            base = grid_box((n // 2, n // 2, 3), (10.0, 10.0, 4.0))
        z = 4 if seed % 3 == 2 else 0
        ring = beam([*rng.uniform(0.3, 9.7, 2), z], [*rng.uniform(0.3, 9.7, 2), z], rng.integers(1, 9))
    lengths = np.linalg.norm(np.diff(ring.points[np.asarray(ring.cells["line"])], axis=1), axis=2)
    mesh = fs.merge(base, ring).mesh
    check_joined_along(mesh, len(lengths), lengths.sum())
    assert worst(mesh) > min(0.15, 0.9 * worst(base))


def test_a_ring_with_struts(floor):
    """What lies is joined along, what rises at its ends."""
    points = np.array([(1.2, 1.3, 0), (8.2, 1.4, 0), (8.5, 8.1, 0), (1.4, 8.3, 0), (5, 5, 3.0), (3, 5.5, 0)])
    frame = fs.Mesh(points, {"line": [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (2, 4), (4, 5)]})
    mesh = fs.merge(floor, frame).mesh
    known = edges_of_shells(mesh)
    beams = np.asarray(mesh.cells["line"])
    rising = np.abs(mesh.points[beams][:, :, 2]).max(axis=1) > 0
    assert rising.sum() == 3 and all((min(p), max(p)) in known for p in beams[~rising].tolist())
    foot = np.flatnonzero((np.abs(mesh.points - points[5]) < 1e-9).all(axis=1))
    assert len(foot) == 1 and foot[0] in np.asarray(mesh.cells["triangle"])


def test_beams_that_bow_off_the_shell_are_told(floor):
    points = np.array([(1.2, 1.3, 0), (8.2, 1.4, 0), (4.7, 1.35, 0.9)])
    bowed = fs.Mesh(points, {"line3": [(0, 1, 2)]})
    (warning,) = fs.merge(second_order_triangles(floor), bowed).report.warnings
    assert warning.startswith("1 beam, as at (") and "4.7 1.35" in warning and "joined at the ends alone" in warning


def test_beams_along_solids_are_told_not_to_be_held_against_turning():
    (warning,) = fs.merge(grid_box((6, 5, 4), (6.0, 5.0, 4.0)), beam((1.1, 1.2, 4), (5.2, 4.1, 4), 3)).report.warnings
    assert "3 beams lie on the skin of solids" in warning and "nothing holds them against turning" in warning


@needs_ccx
def test_a_stiffened_plate_is_as_stiff_as_one_meshed_with_its_stiffener(tmp_path):
    """A plate held at two sides and pushed down in the middle, with a beam from side to side: laid through elements at
    a slant, it bends as one whose edges the beam is on, within 3 %; and much less than the plate alone. The deck's
    section holds for what the beams were divided into."""
    down = {}
    for case, first, last in (("edges", 5, 5), ("slant", 4.7, 5.3), ("none", None, None)):
        folder = tmp_path / case
        (folder / "beam").mkdir(parents=True)
        base = second_order_triangles(plate((0, 0, 0), (10, 0, 0), (0, 10, 0), (12, 12), "FLOOR"))
        base.add_group("FLOOR", "element", base.cell_ids["triangle6"])
        base.add_group("HELD", "node", base.node_ids[np.isin(base.points[:, 0], (0, 10))])
        base.add_group("MIDDLE", "node", base.node_ids[(base.points == (5, 5, 0)).all(axis=1)])
        deck = "*MATERIAL, NAME=M\n*ELASTIC\n210000., 0.3\n*SHELL SECTION, ELSET=FLOOR, MATERIAL=M\n0.1\n"
        deck += "*STEP\n*STATIC\n*BOUNDARY\nHELD, 1, 6\n*END STEP\n"
        mesh = with_deck(folder, base, deck)
        if first is not None:
            own = "*MATERIAL, NAME=M\n*ELASTIC\n210000., 0.3\n"
            own += "*BEAM SECTION, ELSET=BEAM, MATERIAL=M, SECTION=RECT\n0.2, 0.6\n0., 1., 0.\n"
            stiffener = beam((0, first, 0), (10, last, 0), 7)
            result = fs.merge(mesh, with_deck(folder / "beam", stiffener, own))
            assert not result.report.warnings and len(result.mesh.groups["BEAM"]) >= 12
            mesh = result.mesh
        fs.write(mesh, folder / "out.inp")
        load = "*CLOAD\nMIDDLE, 3, -1.\n*NODE PRINT, NSET=MIDDLE\nU\n*END STEP"
        u, _ = solve(folder, (folder / "out.inp").read_text().replace("*END STEP", load))
        (move,) = u.values()
        down[case] = -move[2]
    print(f"\nstiffener: {down}")
    assert down["slant"] == pytest.approx(down["edges"], rel=0.03)
    assert down["none"] > 3 * down["slant"]
