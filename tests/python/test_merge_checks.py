# SPDX-License-Identifier: LGPL-2.1-or-later
"""What cannot be merged is refused for the true reason, and what one should know of a merge is said."""

import re

import numpy as np
import pytest

import femscalpel as fs
from merge_cases import KINDS, in_one_line
from merge_parts import block, plate, rod, shell, solid, worst
from meshes import grid_box, quadratic
from test_tie import face_areas, hexahedra


def floor():
    return plate((0, 0, 0), (10, 0, 0), (0, 10, 0), (10, 10), "FLOOR")


def box():
    return grid_box((6, 5, 4), (6.0, 5.0, 4.0))


def side_by_side(first, second, kind):
    """Two meshes as one, without common nodes."""
    points = np.concatenate([first.points, second.points])
    return points, np.concatenate([first.cells[kind], second.cells[kind] + first.node_count])


def rib(start, along):
    return plate(start, along, (0, 0, 2), (8, 2), "RIB")


FIRST = rib((1, 3, 0), (8, 0, 0))


@pytest.mark.parametrize(
    "second, words",
    [
        (rib((1, 3, 5), (8, 0, 0)), "a piece of the addition, at .* does not meet the mesh"),
        (rib((3.3, 0.7, 0), (0, 8, 0)), "crosses itself, or lies on itself, at"),
        (FIRST, "crosses itself, or lies on itself, at"),
    ],
)
def test_shells_in_pieces(second, words):
    addition = shell(*side_by_side(FIRST, second, "triangle"), "RIB")
    with pytest.raises(fs.ToolError, match=words) as caught:
        fs.merge(floor(), addition)
    assert caught.value.parameter == "other"


@pytest.mark.parametrize(
    "origin, words",
    [((4.5, 3.5, 24), "a piece of the addition, at"), ((1.8, 1.7, 4.1), "crosses itself, or lies on itself, at")],
)
def test_solids_in_pieces(origin, words):
    pieces = (block(at, (1.2, 1.1, 1.5), (2, 2, 2), "A") for at in ((1.5, 1.5, 4), origin))
    addition = solid(*side_by_side(*pieces, "tetra"), "A")
    with pytest.raises(fs.ToolError, match=words) as caught:
        fs.merge(box(), addition)
    assert caught.value.parameter == "other"


def test_a_beam_that_nothing_holds():
    points = [[2.2, 2.3, 0], [2, 2, 2], [7, 7, 3], [8, 8, 4]]
    with pytest.raises(fs.ToolError, match="a piece of the addition, at"):
        fs.merge(floor(), fs.Mesh(points, {"line": [[0, 1], [2, 3]]}))


def test_other_elements_close_to_the_seam():
    tetrahedra, bricks = box(), hexahedra((0, 0, -4), (6, 5, 4), (6, 5, 4), "HEX")
    points = np.concatenate([tetrahedra.points, bricks.points])
    _, first, place = np.unique(np.round(points, 9), axis=0, return_index=True, return_inverse=True)
    place = place.reshape(-1)
    cells = {"tetra": place[tetrahedra.cells["tetra"]]}
    cells["hexahedron"] = place[bricks.cells["hexahedron"] + tetrahedra.node_count]
    beside = block((6.5, 2.6, -1), (1, 1.7, 2.5), (2, 3, 3), "A")
    result = fs.merge(fs.Mesh(points[first], cells), beside)
    assert result.report.converted["hexahedron"] == 120
    volume = sum(v.sum() for k, v in fs.measure(result.mesh).items() if k in ("tetra", "pyramid", "hexahedron"))
    assert volume == pytest.approx(244.25, rel=1e-9)


@pytest.mark.parametrize(
    "addition",
    [
        block((3, -1, 4), (2, 2, 2), (2, 2, 2), "A"),
        rod((1, 2.5, 5), 1, 4, (2, 4), "A", [[0, 0, 1], [0, 1, 0], [-1, 0, 0]]),
    ],
    ids=["edge on edge", "a rod that lies on a face"],
)
def test_solids_that_touch_in_a_line(addition):
    with pytest.raises(fs.QualityError, match="touch in a line or a point alone") as caught:
        fs.merge(box(), addition)
    assert caught.value.parameter == "other"


def test_nothing_is_left_of_what_lies_inside_with_its_top_in_the_skin():
    with pytest.raises(fs.ToolError, match="the addition lies inside the mesh: nothing of it would be left"):
        fs.merge(box(), block((3, 2.5, 3), (1.1, 1.3, 1), (2, 2, 2), "A"))


def test_a_layer_whose_four_sides_are_flush():
    result = fs.merge(box(), block((3, 2.5, 3), (6, 5, 2), (6, 5, 2), "A"))
    assert fs.measure(result.mesh)["tetra"].sum() == pytest.approx(150, rel=1e-12)


def facets(mesh, height):
    """Faces of tetrahedra at a height, as numbers of elements and faces."""
    local = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))
    found = [
        (number, k + 1)
        for number, cell in zip(mesh.cell_ids["tetra"], mesh.cells["tetra"])
        for k, face in enumerate(local)
        if np.allclose(mesh.points[cell[list(face)], 2], height)
    ]
    return np.array(found)


def test_faces_that_are_inside_afterwards_are_told():
    mesh, addition = box(), block((3, 2.6, 4), (2.2, 1.7, 1.5), (3, 3, 2), "A")
    mesh.add_group("PRESSED", "facet", facets(mesh, 4))
    mesh.add_group("BELOW", "facet", facets(mesh, 0))
    addition.add_group("BOTTOM", "facet", facets(addition, 4))
    addition.add_group("TOP", "facet", facets(addition, 5.5))
    warnings = fs.merge(mesh, addition).report.warnings
    (inside,) = [w for w in warnings if "inside now" in w]
    (empty,) = [w for w in warnings if "is empty now" in w]
    assert "faces of 'PRESSED'" in inside and "group 'BOTTOM'" in empty
    mesh.remove_group("PRESSED")
    addition.remove_group("BOTTOM")
    assert not fs.merge(mesh, addition).report.warnings


@pytest.mark.parametrize(
    "addition, words",
    [
        (block((3, 2.5, 1), (1, 1, 1), (2, 2, 2), "A"), "the addition is inside the mesh"),
        (plate((1.2, 1.3, 1), (3.3, 2, 0), (0, 0, 2), (6, 2), "FIN"), "the addition is inside the mesh"),
        (block((3, 2.5, -1), (9, 9, 9), (3, 3, 3), "A"), "the mesh is inside the addition"),
        (block((30, 2.5, 3), (6, 5, 2), (6, 5, 2), "A"), "the addition does not meet the mesh"),
    ],
)
def test_one_inside_the_other(addition, words):
    with pytest.raises(fs.ToolError, match=words) as caught:
        fs.merge(box(), addition)
    assert caught.value.parameter == "other"


def test_faces_where_the_two_meet_leave_the_groups_of_the_one_that_is_cut():
    mesh, addition = box(), block((3, 2.6, 4), (2.2, 1.7, 1.5), (3, 3, 2), "A")
    mesh.add_group("TOP", "facet", facets(mesh, 4))
    result = fs.merge(mesh, addition, keep="addition")
    assert face_areas(result.mesh, "TOP")[0] == pytest.approx(6 * 5 - 2.2 * 1.7)
    assert not any("inside now" in w for w in result.report.warnings)


def all_nodes(mesh, name):
    mesh.add_group(name, "node", mesh.node_ids)
    return mesh


@pytest.mark.parametrize("second_order", [False, True])
@pytest.mark.parametrize("keep", ["mesh", "addition"])
def test_a_group_of_all_nodes_has_those_of_what_is_filled_in(keep, second_order):
    """*INITIAL CONDITIONS are given to such a group: a node without a temperature is at zero."""
    order = quadratic if second_order else lambda mesh: mesh
    mesh, addition = all_nodes(order(box()), "NALL"), block((3, 2.6, 2.7), (2.2, 1.7, 2.5), (3, 3, 3), "A")
    all_nodes(addition, "AALL")
    number = "tetra10" if second_order else "tetra"
    mesh.add_group("BODY", "element", mesh.cell_ids[number])
    result = fs.merge(mesh, addition, keep=keep).mesh
    for elements, nodes in (("BODY", "NALL"), ("ADD_ADDED", "AALL")):
        cells = result.cells[number][np.isin(result.cell_ids[number], result.groups[elements].ids)]
        if not second_order or nodes == "NALL":  # mid-side nodes that the addition had not are in no group of it
            assert set(result.node_ids[np.unique(cells)]) <= set(result.groups[nodes].ids)


def test_a_group_of_corners_gets_no_mid_side_nodes():
    mesh, addition = quadratic(box()), block((3, 2.6, 2.7), (2.2, 1.7, 2.5), (3, 3, 3), "A")
    mesh.add_group("CORNERS", "node", mesh.node_ids[np.unique(mesh.cells["tetra10"][:, :4])])
    mesh.add_group("BODY", "element", mesh.cell_ids["tetra10"])
    result = fs.merge(mesh, addition, keep="addition").mesh
    cells = result.cells["tetra10"][np.isin(result.cell_ids["tetra10"], result.groups["BODY"].ids)]
    corners, group = set(result.node_ids[np.unique(cells[:, :4])]), set(result.groups["CORNERS"].ids)
    assert corners <= group
    assert group.isdisjoint(set(result.node_ids[result.points[:, 2] < 3.99]) - corners)


def test_the_total_of_a_load_on_all_nodes_stays(tmp_path):
    """What is filled in brings new nodes into the set."""
    mesh = all_nodes(box(), "NALL")
    fs.write(mesh, tmp_path / "mesh.inp")
    deck = "*STEP\n*STATIC\n*CLOAD\nNALL, 1, 1.\n*END STEP\n"
    (tmp_path / "mesh.inp").write_text((tmp_path / "mesh.inp").read_text() + deck)
    addition = block((3, 2.6, 2.7), (2.2, 1.7, 2.5), (3, 3, 3), "A")
    result = fs.merge(fs.read(tmp_path / "mesh.inp"), addition, keep="addition")
    fs.write(result.mesh, tmp_path / "out.inp")
    card = (tmp_path / "out.inp").read_text().split("*CLOAD\n")[1].splitlines()[0]
    assert card == "NALL_LOAD1, 1, 1."
    assert set(result.mesh.groups["NALL_LOAD1"].ids) <= set(mesh.node_ids)


def grid_faces(mesh):
    cells = mesh.cells["tetra"]
    return {tuple(face) for k in range(4) for face in np.sort(np.delete(cells, k, axis=1), axis=1)}


def halves():
    """With a border at x = 3, facets and triangles on it."""
    plain = box()
    on = np.array([face for face in sorted(grid_faces(plain)) if np.allclose(plain.points[list(face), 0], 3)])
    mesh = fs.Mesh(plain.points, {**plain.cells, "triangle": on})
    mesh.add_group("BAFFLE", "element", mesh.cell_ids["triangle"])
    ids, x = mesh.cell_ids["tetra"], mesh.points[mesh.cells["tetra"]].mean(axis=1)[:, 0]
    mesh.add_group("LEFT", "element", ids[x < 3])
    mesh.add_group("RIGHT", "element", ids[x > 3])
    local = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))
    mesh.add_group("MIDDLE", "facet", [
        (number, k + 1)
        for number, cell in zip(ids[x < 3], mesh.cells["tetra"][x < 3])
        for k, face in enumerate(local)
        if np.allclose(mesh.points[cell[list(face)], 0], 3)
    ])  # fmt: skip
    return mesh


@pytest.mark.parametrize("height", [2.7, 4])
def test_borders_that_run_through_what_is_filled_in_are_told(height):
    addition = block((3, 2.6, height), (2.2, 1.7, 5.2 - height), (3, 3, 3), "A")
    assert not any("border" in w or "gone" in w for w in fs.merge(halves(), addition).report.warnings)
    result = fs.merge(halves(), addition, keep="addition")
    (border,) = [w for w in result.report.warnings if "is uneven there" in w]
    (faces,) = [w for w in result.report.warnings if "are gone" in w]
    filled = grid_faces(result.mesh)
    assert all(tuple(sorted(face)) in filled for face in result.mesh.cells["triangle"])
    assert "the border of 'LEFT', 'RIGHT' runs through" in border
    assert "of 'BAFFLE', 'MIDDLE'" in faces
    beside = block((1, 2.6, height), (1.1, 1.7, 5.2 - height), (2, 3, 3), "A")
    assert not any("uneven" in w for w in fs.merge(halves(), beside, keep="addition").report.warnings)


def test_shells_inside_a_solid_are_told():
    fin = plate((2, 2.6, 2.5), (2, 0.3, 0), (0, 0, 3), (4, 6), "FIN")
    (inside,) = [w for w in fs.merge(box(), fin).report.warnings if "inside the solid" in w]
    assert "do not hold to it" in inside
    trimmed = fs.merge(box(), fin, keep_side=(3, 2.7, 9))
    assert not any("inside the solid" in w for w in trimmed.report.warnings)
    on = plate((2, 2.6, 4), (2, 0.3, 0), (0, 0, 1.5), (4, 3), "FIN")
    assert not any("inside the solid" in w for w in fs.merge(box(), on).report.warnings)


def test_an_inverted_element_of_the_addition_is_not_the_meshs():
    good = block((3, 2.6, 4), (2.2, 1.7, 1.5), (3, 3, 2), "A")
    cells = good.cells["tetra"].copy()
    cells[3] = cells[3][[1, 0, 2, 3]]
    with pytest.raises(fs.QualityError, match="the addition already has 1 flat or inverted") as caught:
        fs.merge(box(), fs.Mesh(good.points, {"tetra": cells}))
    assert caught.value.parameter == "other"


def test_a_word_on_refinement_names_no_option_that_there_is_not():
    fine = block((5, 3.1, 3), (6, 4, 0.4), (32, 24, 2), "A")
    (text,) = [w for w in fs.merge(grid_box((10, 6, 3), (10.0, 6.0, 3.0)), fine).report.warnings if "finer" in w]
    assert text.startswith("the addition is finer than the mesh, which was refined first, to edges of")
    assert text.endswith("elements") and "refine=" not in text and "where they meet: from" in text


@pytest.mark.parametrize("options, parameter", [
    ({"prefix": "a b\n"}, "prefix"), ({"name": "a" * 200}, "name"), ({"name": "a b", "method": "tie"}, "name"),
])  # fmt: skip
def test_names_that_solvers_do_not_accept(options, parameter):
    with pytest.raises(fs.ToolError) as caught:
        fs.merge(box(), block((3, 2.6, 4), (2.2, 1.7, 1.5), (3, 3, 2), "A"), **options)
    assert caught.value.parameter == parameter


def node_groups(mesh, **groups):
    """The mesh with node groups of those points for which a function of the coordinates is true."""
    mesh = mesh.copy()
    for name, is_in in groups.items():
        mesh.add_group(name, "node", mesh.node_ids[is_in(mesh.points)])
    return mesh


def test_groups_of_nodes_that_become_one_are_told():
    """The mesh's may be held, and the addition's is then, too."""
    low = lambda z: lambda points: np.abs(points[:, 2] - z) < 1e-9
    mesh = node_groups(box(), BOTTOM=low(0), TOP=low(4))
    boss = node_groups(block((2, 2, 4), (2, 2, 1), (4, 4, 2), "BOSS"), BOTTOM=low(4), OTHER=low(5))
    for method in ("conform", "tie"):
        told = [w for w in fs.merge(mesh, boss, method=method).report.warnings if "which are one now" in w]
        assert (
            len(told) == 1
            and told[0].startswith("both have groups 'BOTTOM', which")
            and "at 25 nodes or facets of the addition" in told[0]
        )
        apart = fs.merge(mesh, boss, method=method, join_groups=False)
        assert not [w for w in apart.report.warnings if "which are one now" in w]
        assert len(apart.mesh.groups["BOTTOM"].ids) == 42


def test_shells_on_solids_turn_as_about_a_hinge_and_this_is_told():
    on_solid = fs.merge(box(), plate((1, 2, 4), (4, 0, 0), (0, 0, 2), (6, 3), "RIB"))
    assert [w for w in on_solid.report.warnings if "as about a hinge" in w]
    assert not [w for w in fs.merge(floor(), FIRST).report.warnings if "hinge" in w]


@pytest.mark.parametrize("angle", [0.12, 0.15, 0.3])
def test_shells_that_cross_at_a_small_angle_keep_their_planes(angle):
    """What is near the other for a whole edge and more is not put onto it: it passes."""
    across = plate((2, 2, -2 * angle), (5, 1, 0), (0, 4, 4 * angle), (6, 5), "RIB")
    mesh = fs.merge(floor(), across).mesh
    nodes = np.unique(mesh.cells["triangle"][np.isin(mesh.cell_ids["triangle"], mesh.groups["ADD_ADDED"].ids)])
    normal = np.cross((5, 1, 0), (0, 4, 4 * angle))
    off = (mesh.points[nodes] - (2, 2, -2 * angle)) @ normal / np.linalg.norm(normal)
    assert np.abs(off).max() < 1e-12
    seam = mesh.points[np.isin(mesh.node_ids, mesh.groups["ADD_SEAM"].ids)]
    np.testing.assert_allclose(seam[:, 1], 4 + 0.2 * (seam[:, 0] - 2), atol=1e-12)


def test_a_seam_across_a_crack_is_refused():
    """It would hold to one of the lips, and to nothing along an edge beside the other."""
    cracked = fs.crack(floor(), fs.Plane((5, 0, 0), (1, 0.1, 0)), within=fs.Disk((5, 0, 0), 4)).mesh
    with pytest.raises(fs.QualityError, match="the seam is no edge of the mesh between .* crosses double nodes there"):
        fs.merge(cracked, plate((1.1, 2.2, 0), (7, 0.5, 0), (0, 0, 3), (8, 3), "RIB"))
    beside = fs.merge(cracked, plate((1.1, 6.2, 0), (7, 0.5, 0), (0, 0, 3), (8, 3), "RIB"))
    assert len(beside.mesh.groups["ADD_SEAM"].ids) > 8


def cylinder(start, along, radius, size, order):
    """As Gmsh meshes it."""
    gmsh = pytest.importorskip("gmsh")
    gmsh.initialize()
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.option.setNumber("Mesh.MeshSizeMax", size)
        gmsh.option.setNumber("Mesh.MeshSizeMin", size / 2)
        gmsh.model.occ.addCylinder(*start, *along, radius)
        gmsh.model.occ.synchronize()
        gmsh.model.mesh.generate(3)
        gmsh.model.mesh.setOrder(order)
        tags, points, _ = gmsh.model.mesh.getNodes()
        index = np.zeros(int(tags.max()) + 1, int)
        index[tags] = np.arange(len(tags))
        kind, count = {1: (4, 4), 2: (11, 10)}[order]
        cells = index[gmsh.model.mesh.getElementsByType(kind)[1]].reshape(-1, count)
    finally:
        gmsh.finalize()
    if order == 2:
        cells[:, [8, 9]] = cells[:, [9, 8]]
    return fs.Mesh(points.reshape(-1, 3), {"tetra10" if order == 2 else "tetra": cells})


@pytest.mark.parametrize("keep", ["mesh", "addition"])
@pytest.mark.parametrize("radius", [1.2, 1.9])
def test_a_branch_of_coarse_curved_elements(radius, keep):
    """Edges of a third of the radius: refused as too coarse but with finer ones."""
    mesh, branch = cylinder((0, 0, 0), (0, 0, 8), 2, 0.7, 2), cylinder((0, 0, 4), (6, 0, 0), radius, 0.7, 2)
    result = fs.merge(mesh, branch, keep=keep)
    assert worst(result.mesh) > 0.12
    assert result.report.quality.after.minimum > 0.12


def test_no_element_of_hardly_a_volume_is_filled_in():
    """Cylinders of one radius touch each other along their whole length at two places."""
    mesh, branch = cylinder((0, 0, 0), (0, 0, 8), 2, 1, 1), cylinder((0, 0, 4), (6, 0, 0), 2, 0.8, 1)
    try:
        result = fs.merge(mesh, branch)
    except fs.QualityError as error:
        assert re.search("where the two meet|cannot be joined|skins of the two meet at a sharp angle", str(error))
    else:
        assert worst(result.mesh) > 0.02


@pytest.mark.parametrize("within", [fs.Disk((2.9, 2.5, 4), 1.4), None], ids=["a crack that ends inside", "two parts"])
def test_a_solid_across_a_crack(within):
    mesh = grid_box((12, 10, 8), (6.0, 5.0, 4.0))
    cracked = fs.crack(mesh, fs.Plane((3.1, 2.5, 2), (1, 0, 0.1)), within=within).mesh
    with pytest.raises(fs.QualityError, match="double nodes, .*lips") as caught:
        fs.merge(cracked, block((3, 2.6, 4), (2.2, 1.7, 1.5), (3, 3, 2), "A"))
    at = np.array(re.search(r"at \(([^)]*)\)", str(caught.value)).group(1).split(), float)
    assert abs(fs.Plane((3.1, 2.5, 2), (1, 0, 0.1)).distance(at)) < 1e-3


@pytest.mark.parametrize(
    "angle, at", [(0.6, (4, 7.2)), (0.6, (6.3, 6.9)), (2.5, (3.3, 1.1)), (2.5, (5.2, 6.5)), (1.2, (4, 7.2))]
)
@pytest.mark.parametrize("tilt", [0, -0.2, 0.3])
def test_a_rib_that_hangs_over_the_border(angle, at, tilt):
    floor = plate((0, 0, 0), (10, 0, 0), (0, 8, 0), (12, 10), "FLOOR")
    along = np.array([np.cos(angle), np.sin(angle), 0])
    up = np.array([-np.sin(angle) * np.sin(tilt), np.cos(angle) * np.sin(tilt), np.cos(tilt)])
    hanging = plate(np.array([*at, 0]) - 4 * along, 8 * along, 3 * up, (17, 5), "RIB")
    result = fs.merge(floor, hanging)
    assert in_one_line(result.mesh)
    # Nodes of the rib that are nearer to the border than a tenth of an edge go there.
    assert fs.measure(result.mesh)["triangle"].sum() == pytest.approx(80 + 24, rel=1e-4)
    (of_floor,) = (g for g in result.report.groups if g.name == "FLOOR")
    assert of_floor.measure_after == pytest.approx(80, rel=1e-9)


@pytest.mark.parametrize("seed", [92, 272])
def test_a_rib_that_ends_beside_the_border(seed):
    result = fs.merge(*KINDS["quadrangles"](np.random.default_rng(seed)))
    assert in_one_line(result.mesh)


def test_a_seam_across_the_lips_of_a_crack():
    cracked = fs.crack(grid_box((7, 6, 3), (10.0, 8.0, 4.0)), fs.Plane((5, 4, 2), (1, 0, 0.1))).mesh
    rng, found = np.random.default_rng(1), []
    for _ in range(2):
        at, size, counts = (rng.uniform(4, 6), rng.uniform(3, 5), 4), rng.uniform(2, 4, 3), rng.integers(2, 6, 3)
        with pytest.raises(fs.QualityError, match="double nodes") as caught:
            fs.merge(cracked, block(at, size, counts, "A"))
        found.append(str(caught.value))
    assert found[1].startswith("the seam runs across double nodes, of a crack's lips or a contact, at ")


def uneven_plate(counts, place, seed, amount):
    """Triangles over the unit square, its inner nodes moved about, brought to `place(u, v)`."""
    rng, (n, m) = np.random.default_rng(seed), counts
    at = np.stack(np.meshgrid(np.arange(n + 1) / n, np.arange(m + 1) / m), axis=-1)
    at[1:-1, 1:-1] += rng.uniform(-amount, amount, at[1:-1, 1:-1].shape) / (n, m)
    node = np.arange(at[..., 0].size).reshape(at.shape[:2])
    a, b, c, d = (x.ravel() for x in (node[:-1, :-1], node[:-1, 1:], node[1:, 1:], node[1:, :-1]))
    first = rng.random(a.size) < 0.5
    cells = [np.where(first, (a, b, c), (a, b, d)).T, np.where(first, (a, c, d), (b, c, d)).T]
    return fs.Mesh(np.array([place(u, v) for u, v in at.reshape(-1, 2)]), {"triangle": np.concatenate(cells)})


def test_ribs_that_cross_a_border_at_a_small_angle():
    """Near the border they are not taken to run along it, as every sixth was at 10 to 35 degrees, and refused."""
    for seed in range(40):
        rng = np.random.default_rng(seed)
        n, angle, y = rng.integers(6, 14), np.radians(rng.uniform(10, 35)), rng.uniform(0.35, 0.6)
        way = np.array((np.sin(angle), np.cos(angle), 0))
        start, end = np.array((1, y, 0)) - 0.4 * way, np.array((1, y, 0)) + rng.uniform(0.05, 0.3) * way
        plate = uneven_plate((n, n), lambda u, v: (u, v, 0), seed, 0.15)
        rib = uneven_plate(
            (rng.integers(4, 12), 3), lambda u, v: start + u * (end - start) + (0, 0, 0.3 * v), seed, 0.1
        )
        result = fs.merge(plate, rib, name="RIB")
        assert result.report.quality.after.minimum > 0.1, seed
        # On the plate, up to its border.
        seam = result.mesh.points[np.isin(result.mesh.node_ids, result.mesh.groups["RIB_SEAM", "node"].ids)]
        assert abs(seam[:, 2]).max() < 1e-9
        assert seam[:, 0].max() == pytest.approx(1, abs=1e-9), seed
