# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cracks along faces that a mesh has: elements of any type, none moved."""

import numpy as np
import pytest
from contact_cases import TETRA_OF_CUBE
from meshes import quadratic
from mixed_meshes import EDGES, FACES, grid, outer_area, prisms_of, second_order
from test_conversion import deck, largest_error, needs_ccx
from test_double_nodes import both, facing, with_springs

import femscalpel as fs

KINDS = ("hexahedron", "hexahedron20", "tetra", "tetra10", "wedge", "wedge15")


def box(kind, counts=(6, 4, 4), jitter=0.0):
    points, cells = grid(counts, jitter)
    order = 2 if kind[-1].isdigit() else 1
    name = kind.rstrip("0123456789")
    if name == "tetra":
        cells = cells[:, TETRA_OF_CUBE].reshape(-1, 4)
    elif name == "wedge":
        cells = prisms_of(cells)
    if kind == "tetra10":
        mesh = quadratic(fs.Mesh(points, {"tetra": cells}))
        return fs.Mesh(mesh.points, mesh.cells)
    if order == 2:
        points, cells = second_order(points, cells, name)
    return fs.Mesh(points, {kind: cells})


def name_nodes(mesh, name, chosen):
    mesh.add_group(name, "node", mesh.node_ids[chosen])


def lip_area(mesh, group):
    ids = mesh.groups[group, "element"].ids
    return sum(v[np.isin(mesh.cell_ids[k], ids)].sum() for k, v in fs.measure(mesh).items() if len(v))


@pytest.mark.parametrize("kind", KINDS)
def test_part_of_a_section(kind):
    mesh = box(kind)
    x = mesh.points
    name_nodes(mesh, "SECTION", (x[:, 0] == 3) & (x[:, 2] >= 2))
    result = fs.crack(mesh, fs.Faces("SECTION"), name="T")
    after = result.mesh
    assert lip_area(after, "T_N") == pytest.approx(8) == lip_area(after, "T_P")
    assert outer_area(after) == pytest.approx(128 + 16)
    front = after.groups["T_FRONT", "element"]
    ((line, segments),) = [(k, c) for k, c in after.cells.items() if k.startswith("line")]
    assert len(front.ids) == 4 and (segments[1:, 0] == segments[:-1, 1]).all()
    on_front = after.points[segments]
    assert (on_front[..., 0] == 3).all() and (on_front[..., 2] == 2).all()
    assert result.report.nodes_doubled == after.node_count - mesh.node_count > 0
    # The copies are those of the positive side, in the groups of the originals.
    new = after.node_ids[mesh.node_count :]
    for name, sign in (("T_N", -1), ("T_P", 1)):
        ids = after.groups[name, "element"].ids
        nodes = np.unique(np.concatenate([c[np.isin(after.cell_ids[k], ids)].ravel() for k, c in after.cells.items()]))
        assert np.isin(after.node_ids[nodes], new).any() == (sign > 0)
    assert set(new) <= set(after.groups["SECTION", "node"].ids)
    assert (after.points[: mesh.node_count] == mesh.points).all()


@pytest.mark.parametrize("kind", KINDS)
def test_around_elements_chosen_at_random(kind):
    """They come off all around, and nothing else does."""
    rng = np.random.default_rng(7)
    for _ in range(6):
        mesh = box(kind, (5, 4, 3), 0.15)
        ((_, cells),) = mesh.cells.items()
        chosen = rng.random(len(cells)) < rng.uniform(0.1, 0.6)
        faces = [
            (number, k + 1)
            for number, cell in zip(mesh.cell_ids[kind][chosen], cells[chosen])
            for k in range(len(FACES[kind.rstrip("0123456789")]))
        ]
        mesh.add_group("FACES", "facet", np.array(faces))
        mesh.add_group("ALL", "element", mesh.cell_ids[kind])
        after = fs.crack(mesh, fs.Faces("FACES"), name="T").mesh
        assert not np.intersect1d(after.cells[kind][chosen], after.cells[kind][~chosen]).size
        count = {}
        for cell in after.cells[kind][~chosen]:
            for face in FACES[kind.rstrip("0123456789")]:
                key = frozenset(cell[list(face)].tolist())
                count[key] = count.get(key, 0) + 1
        before = {}
        for cell in cells[~chosen]:
            for face in FACES[kind.rstrip("0123456789")]:
                key = frozenset(cell[list(face)].tolist())
                before[key] = before.get(key, 0) + 1
        assert sorted(count.values()) == sorted(before.values())
        assert fs.measure(after)[kind].sum() == pytest.approx(60, rel=1e-9)
        assert lip_area(after, "T_N") == pytest.approx(lip_area(after, "T_P"))


@pytest.mark.parametrize("kind", ["hexahedron", "hexahedron20", "wedge", "wedge15"])
def test_a_plane_between_elements_converts_none(kind):
    mesh = box(kind)
    mesh.add_group("ALL", "element", mesh.cell_ids[kind])
    for normal in ((1, 0, 0), (-1, 0, 0)):
        result = fs.crack(mesh, fs.Plane((3, 2, 2), normal), name="T")
        assert not result.report.converted and len(result.mesh.cells[kind]) == len(mesh.cells[kind])
        assert outer_area(result.mesh) == pytest.approx(128 + 32)
        ids = result.mesh.groups["T_P", "element"].ids
        lip = np.isin(result.mesh.cell_ids["quad8" if kind[-1].isdigit() else "quad"], ids)
        assert lip.sum() == 16
        # New nodes, at elements that the normal points to.
        new = np.arange(mesh.node_count, result.mesh.node_count)
        at = [c for c in result.mesh.cells[kind] if np.isin(c, new).any()]
        assert all(result.mesh.points[c][:, 0].mean() * normal[0] > 3 * normal[0] for c in at)
        part = fs.crack(mesh, fs.Plane((3, 2, 2), normal), name="T", band_only=True).mesh
        assert 0 < len(part.cells[kind]) < len(mesh.cells[kind])
    assert fs.crack(mesh, fs.Plane((3.2, 2, 2), (1, 0, 0)), name="T").report.converted


def test_shells_beside_the_solids_are_cut_too():
    points, cubes = grid((4, 2, 2))
    flat, squares = grid((4, 2))
    for shift in (0.5, 0):  # through the shells' middle, and between them
        shells = flat + (shift, 0, 5)
        mesh = fs.Mesh(np.vstack([points, shells]), {"hexahedron": cubes, "quad": squares + len(points)})
        mesh.add_group("SHELLS", "element", mesh.cell_ids["quad"])
        after = fs.crack(mesh, fs.Plane((2, 1, 1), (1, 0, 0)), name="T").mesh
        ids = after.groups["SHELLS", "element"].ids
        rows = [row for k, c in after.cells.items() for row in c[np.isin(after.cell_ids[k], ids)]]
        left, right = (
            {n for row in rows if sign * (after.points[row][:, 0].mean() - 2) > 0 for n in row} for sign in (-1, 1)
        )
        assert left and right and not left & right


def test_double_nodes_are_followed_where_a_plane_is_between():
    """Springs and pairs across the contact: both sides do the same, and new pairs have theirs."""
    mesh = both("hexahedra")
    points = mesh.points.copy()
    points[:, 0] = np.round(points[:, 0])
    flat = fs.Mesh(points, mesh.cells)
    for name, kind in (("LOW", "element"), ("UP", "element"), ("CON_A", "node"), ("CON_B", "node")):
        flat.add_group(name, kind, mesh.groups[name, kind].ids)
    flat = with_springs(flat)
    after = fs.crack(flat, fs.Plane((3, 2.5, 4), (1, 0, 0)), name="T").mesh
    springs = after.node_ids[after.cells["line"][np.isin(after.cell_ids["line"], after.groups["SPRINGS"].ids)]]
    assert len(springs) > len(flat.cell_ids["line"])
    assert facing(after) == set(map(tuple, springs.tolist()))


def test_elements_on_the_faces_get_twins_in_their_groups():
    mesh = box("hexahedron")
    quads = np.array([f for c in mesh.cells["hexahedron"] for f in c[np.array(FACES["hexahedron"])]])
    x = mesh.points[quads]
    on = quads[(x[..., 0] == 3).all(axis=1)]
    _, first = np.unique(np.sort(on, axis=1), axis=0, return_index=True)
    out = fs.Mesh(mesh.points, {"hexahedron": mesh.cells["hexahedron"], "quad": on[first]})
    out.add_group("WALL", "element", out.cell_ids["quad"])
    result = fs.crack(out, fs.Faces("WALL"), name="T")
    after = result.mesh
    assert len(after.groups["WALL", "element"].ids) == 32 == len(after.cells["quad"])
    assert len(after.groups["T_N", "element"].ids) == 16 == len(after.groups["T_P", "element"].ids)
    (wall,) = [g for g in result.report.groups if g.name == "WALL"]
    assert (wall.measure_before, wall.measure_after) == (16, 32)
    assert outer_area(after) == pytest.approx(128 + 32)


def test_shells():
    points, cells = grid((6, 4))
    mesh = fs.Mesh(points, {"quad": cells})
    name_nodes(mesh, "LINE", (points[:, 0] == 3) & (points[:, 1] >= 2))
    after = fs.crack(mesh, fs.Faces("LINE"), name="T").mesh
    assert after.node_count == mesh.node_count + 2 and len(after.cells["line"]) == 4
    ((tip,),) = [after.points[np.isin(after.node_ids, after.groups["T_FRONT", "node"].ids)].tolist()]
    assert tip == [3, 2, 0]


def test_what_cannot_be_parted_is_told():
    mesh = box("hexahedron")
    x = mesh.points
    name_nodes(mesh, "OUTSIDE", x[:, 0] == 0)
    name_nodes(mesh, "ROW", (x[:, 0] == 3) & (x[:, 1] == 2))
    name_nodes(mesh, "ONE", (x[:, 0] == 3) & (np.abs(x[:, 1:] - 1.5) < 1).all(axis=1))
    mesh.add_group("ALL", "element", mesh.cell_ids["hexahedron"])
    name_nodes(mesh, "MIDDLE", x[:, 0] == 3)
    for group, text in (
        ("OUTSIDE", "lies on the outside"),
        ("ROW", "covers no face"),
        ("ONE", "none could be opened"),
        ("ALL", "has hexahedron elements"),
        ("NONE", "has no group 'NONE'"),
    ):
        with pytest.raises(fs.ToolError, match=text):
            fs.crack(mesh, fs.Faces(group))
    with pytest.raises(ValueError, match="within has no meaning"):
        fs.crack(mesh, fs.Faces("MIDDLE"), within=fs.Disk((3, 2, 2), 1))
    once = fs.crack(mesh, fs.Faces("MIDDLE"), name="A").mesh
    with pytest.raises(fs.ToolError, match="open there already"):
        fs.crack(once, fs.Faces("MIDDLE"), name="B")
    assert repr(fs.Faces("MIDDLE")) == "Faces('MIDDLE')"


@needs_ccx
@pytest.mark.parametrize("kind, label", [("hexahedron", "C3D8"), ("hexahedron20", "C3D20"), ("tetra10", "C3D10")])
def test_the_deck_follows(tmp_path, kind, label):
    """With the lips tied a linear field is exact, and loads on both sides stay."""
    mesh = box(kind, (6, 4, 4), 0.15)
    ((_, cells),) = mesh.cells.items()
    section = np.nonzero((np.abs(mesh.points[:, 0] - 3) < 0.5) & (mesh.points[:, 2] > 1.5))[0]
    sets = ["*NSET, NSET=SECTION", *(str(n + 1) for n in section)]
    sets += ["*SOLID SECTION, ELSET=EALL, MATERIAL=M"]
    mesh = deck(tmp_path, mesh.points, cells, label, "\n".join(sets))
    result = fs.crack(mesh, fs.Faces("SECTION"), name="T")
    assert result.report.nodes_doubled > 0 and not result.report.warnings
    assert largest_error(tmp_path, result.mesh, (6, 4, 4), (0, 1, 2)) < 1e-7


@pytest.mark.parametrize("kind", ["hexahedron", "hexahedron20"])
def test_faces_with_all_corners_on_the_border_stay_closed(kind):
    """In second order, too: a node in the middle comes apart with its corners. Elements on such faces follow."""
    mesh = box(kind)
    name = kind.replace("hexahedron", "quad").replace("20", "8")
    whole = box(kind)
    whole.add_group("MIDDLE", "node", whole.node_ids[whole.points[:, 2] == 2])
    opened = fs.crack(whole, fs.Faces("MIDDLE"), name="T").mesh
    lips = opened.cells[name][np.isin(opened.cell_ids[name], opened.groups["T_N", "element"].ids)]
    rng = np.random.default_rng(2)
    for _ in range(20):
        some = lips[rng.random(len(lips)) < 0.4]
        both = fs.Mesh(mesh.points, {kind: mesh.cells[kind], name: some})
        both.add_group("WALL", "element", both.cell_ids[name])
        try:
            result = fs.crack(both, fs.Faces("WALL"), name="T")
        except fs.ToolError as error:
            assert "none could be opened" in str(error)
            continue
        after = result.mesh
        assert lip_area(after, "T_N") == pytest.approx(lip_area(after, "T_P"))
        assert outer_area(after) == pytest.approx(128 + 2 * lip_area(after, "T_N"))
        faces = [frozenset(map(int, f)) for c in after.cells[kind] for f in c[np.array(FACES["hexahedron"])]]
        times = {f: faces.count(f) for f in set(faces)}
        lip = np.isin(after.cell_ids[name], [*after.groups["T_N"].ids, *after.groups["T_P"].ids])
        for row, on_lip in zip(after.cells[name], lip):
            assert times[frozenset(map(int, row[:4]))] == (1 if on_lip else 2)
        if kind == "hexahedron20":  # a node in the middle belongs to one pair of corners
            edges = {}
            for cell in after.cells[kind]:
                for k, (a, b) in enumerate(EDGES["hexahedron"]):
                    assert edges.setdefault(frozenset((cell[a], cell[b])), cell[8 + k]) == cell[8 + k]


@pytest.mark.parametrize("how", ["faces", "plane"])
@pytest.mark.parametrize("axis, lips", [(0, "quad"), (2, "triangle")])
def test_prisms_written_as_hexahedra_part_as_prisms(how, axis, lips):
    points, hexahedra = grid((4, 3, 4), 0)
    collapsed = [
        row
        for h in hexahedra
        for row in ((h[0], h[1], h[2], h[2], h[4], h[5], h[6], h[6]), (h[0], h[2], h[3], h[3], h[4], h[6], h[7], h[7]))
    ]
    mesh = fs.Mesh(points, {"hexahedron": np.array(collapsed)})
    mesh.add_group("G", "node", mesh.node_ids[points[:, axis] == 2])
    tool = fs.Faces("G") if how == "faces" else fs.Plane(2 * np.eye(3)[axis], np.eye(3)[axis])
    result = fs.crack(mesh, tool, name="T")
    assert result.report.nodes_doubled == (points[:, axis] == 2).sum() and not result.report.warnings
    sides = [set(c) for c in result.mesh.cells["hexahedron"]]
    below = result.mesh.points[result.mesh.cells["hexahedron"]][:, :, axis].mean(axis=1) < 2
    one, other = (set().union(*(s for s, b in zip(sides, below) if b == which)) for which in (True, False))
    assert not one & other and lips in result.mesh.cells and len(result.mesh.cells) == 2


def test_of_several_elements_on_a_face_those_of_the_group_are_the_lips():
    points, hexahedra = grid((2, 2, 2), 0)
    index = {tuple(p): n for n, p in enumerate(np.round(points, 9))}
    quads = [[index[1, j + a, k + b] for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))] for j in (0, 1) for k in (0, 1)]
    mesh = fs.Mesh(points, {"hexahedron": hexahedra, "quad": np.array([q[::-1] for q in quads] + quads)})
    ids = mesh.cell_ids["quad"]
    mesh.add_group("OTHER", "element", ids[:4])
    mesh.add_group("G", "element", ids[4:])
    after = fs.crack(mesh, fs.Faces("G"), name="T").mesh
    assert {g.name: len(g) for g in after.groups.all()} == {"G": 8, "OTHER": 8, "T_N": 4, "T_P": 4}
    assert np.isin(after.groups["T_N"].ids, after.groups["G"].ids).all()
    lip = after.cells["quad"][np.isin(after.cell_ids["quad"], after.groups["T_N"].ids)]
    left = set(after.cells["hexahedron"][after.points[after.cells["hexahedron"]][:, :, 0].mean(axis=1) < 1].ravel())
    assert set(lip.ravel()) <= left  # the quads of G face the positive side


def test_shells_that_stay_joined_have_one_lip():
    """A square is cut out of a floor beside a wall: along the wall the rest of the floor and the wall hold together."""
    number, points, quads = {}, [], []

    def node(*place):
        if place not in number:
            number[place] = len(points)
            points.append(place)
        return number[place]

    for j in range(6):
        quads += [[node(i, j, 0), node(i + 1, j, 0), node(i + 1, j + 1, 0), node(i, j + 1, 0)] for i in (-2, -1, 0, 1)]
        quads += [[node(0, j, k), node(0, j, k + 1), node(0, j + 1, k + 1), node(0, j + 1, k)] for k in (0, 1)]
    around = [(-2, 2), (-1, 2), (0, 2), (0, 3), (-1, 3), (-2, 3)]
    lines = [[number[*a, 0], number[*b, 0]] for a, b in zip(around, around[1:])]
    mesh = fs.Mesh(np.array(points, float), {"quad": np.array(quads), "line": np.array(lines)})
    mesh.add_group("G", "element", mesh.cell_ids["line"])
    after = fs.crack(mesh, fs.Faces("G"), name="T").mesh
    for lip in ("T_N", "T_P"):
        segments = np.sort(after.cells["line"][np.isin(after.cell_ids["line"], after.groups[lip].ids)], axis=1)
        assert len(segments) == 5 and len(np.unique(segments, axis=0)) == 5
