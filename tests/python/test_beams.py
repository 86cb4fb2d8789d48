# SPDX-License-Identifier: LGPL-2.1-or-later
"""Beams, trusses, rods: cut by cracks, trimmed by holes and slots; springs stay whole."""

import numpy as np
import pytest

import femscalpel as fs
import beam_cases
from calculix_runs import solve
from meshes import grid_box, quadratic


def chain(count=8, **kwargs):
    """Beams along x."""
    return fs.Mesh([[x, 0.0, 0.0] for x in range(count + 1)], {"line": [[k, k + 1] for k in range(count)]}, **kwargs)


@pytest.mark.parametrize("kind", beam_cases.KINDS)
@pytest.mark.parametrize("seed", range(15))
def test_random_tools(kind, seed):
    what, tool, within, mesh, width, operate = beam_cases.run_case(kind, seed)
    try:
        result = operate()
    except fs.ToolError as error:
        assert any(why in str(error) for why in ("misses", "only touches", "outside")), error
        return
    assert beam_cases.check(what, tool, within, mesh, result, width) == []


def test_crack_through_beams_alone():
    result = fs.crack(chain(groups={"ALL": ("element", range(1, 9))}), fs.Plane((4.2, 0, 0), (1, 0, 0)))
    mesh = result.mesh
    assert (mesh.node_count, len(mesh.cells["line"]), result.report.beams_cut) == (11, 9, 1)
    ends = [mesh.points[np.isin(mesh.node_ids, mesh.groups[g].ids)] for g in ("CRACK_N", "CRACK_P")]
    assert [g.kind for g in (mesh.groups["CRACK_N"], mesh.groups["CRACK_P"])] == ["node", "node"]
    assert np.allclose(ends[0], [[4.2, 0, 0]]) and np.array_equal(*ends)
    assert set(mesh.groups["CRACK_N"].ids).isdisjoint(mesh.groups["CRACK_P"].ids)
    assert len(mesh.groups["ALL"].ids) == 9
    assert "cut in 1 places" in result.report.to_text()


def test_crack_in_a_node_of_beams():
    result = fs.crack(chain(), fs.Plane((4, 0, 0), (1, 0, 0)))
    assert (result.mesh.node_count, len(result.mesh.cells["line"])) == (10, 8)


def test_a_crack_beside_beams_leaves_them():
    mesh = chain()
    with pytest.raises(fs.ToolError, match="only outside the part"):
        fs.crack(mesh, fs.Plane((4.2, 0, 0), (1, 0, 0)), within=fs.Disk((4.2, 3, 0), 1))


@pytest.mark.parametrize("slot", [False, True])
def test_what_is_removed_of_beams(slot):
    mesh = chain(groups={"ALL": ("element", range(1, 9))})
    if slot:
        result = fs.cut(mesh, fs.Plane((4.2, 0, 0), (1, 0, 0)), width=1)
    else:
        result = fs.drill(mesh, fs.Cylinder((4.2, 0, 0), (0, 0, 1), 0.5))
    group = next(g for g in result.report.groups if g.name == "ALL")
    assert group.measure_after == pytest.approx(7, abs=1e-12)
    x = np.sort(result.mesh.points[:, 0])
    assert np.allclose(x, [0, 1, 2, 3, 3.7, 4.7, 5, 6, 7, 8])
    walls = [g for g in result.mesh.groups if g not in ("ALL",)]
    on_walls = {n for g in walls for n in result.mesh.groups[g].ids}
    assert len(on_walls) == 2 and all(
        result.mesh.groups[g].kind == "node" for g in walls if len(result.mesh.groups[g].ids)
    )


def test_beam_that_stands_on_a_solid_in_the_plane():
    """The solid is all on one side: the beam is taken off it, which stays as it is."""
    box = grid_box((2, 2, 2), (2.0, 2.0, 2.0))
    points = np.concatenate([box.points, [[1, 1, 4]]])
    top = int(np.nonzero((box.points == (1, 1, 2)).all(axis=1))[0][0])
    mesh = fs.Mesh(points, {**box.cells, "line": [[top, len(points) - 1]]})
    result = fs.crack(mesh, fs.Plane((0, 0, 2), (0, 0, 1)))
    assert np.array_equal(result.mesh.cells["tetra"], mesh.cells["tetra"])
    assert result.mesh.cells["line"][0][0] == mesh.node_count
    assert np.array_equal(result.mesh.points[-1], (1, 1, 2))


FRAME = """*NODE, NSET=N
1, 0, 0, 0
2, 0, 0, 5
3, 8, 0, 5
4, 8, 0, 0
5, 0, 0, 2.5
6, 4, 0, 5
7, 8, 0, 2.5
*ELEMENT, TYPE=B32R, ELSET=POSTS
1, 1, 5, 2
2, 3, 7, 4
*ELEMENT, TYPE=B32R, ELSET=BEAM
3, 2, 6, 3
*ELEMENT, TYPE=SPRINGA, ELSET=BRACE
4, 1, 3
*SPRING, ELSET=BRACE

1.
*BEAM SECTION, SECTION=RECT, ELSET=POSTS, MATERIAL=STEEL
.2, .2
0, 1, 0
*BEAM SECTION, SECTION=RECT, ELSET=BEAM, MATERIAL=STEEL
.2, .2
0, 1, 0
*MATERIAL, NAME=STEEL
*ELASTIC
210000, .3
*BOUNDARY
1, 1, 6
4, 1, 6
*STEP
*STATIC
*CLOAD
2, 1, 10.
*NODE PRINT, NSET=N
U
*END STEP
"""


def test_frame_of_calculix(tmp_path):
    """A portal cut through its beam: sections follow, the spring stays whole, both posts stand on their own."""
    deck = tmp_path / "frame.inp"
    deck.write_text(FRAME)
    result = fs.crack(fs.read(str(deck)), fs.Plane((3, 0, 0), (1, 0, 0)))
    assert result.report.beams_cut == 1
    written = tmp_path / "cracked.inp"
    fs.write(result.mesh, str(written))
    text = written.read_text()
    assert text.count("SPRINGA") == 1 and "4, 1, 3" in text
    displacements, _ = solve(tmp_path, text)
    # The left post stands as if it were alone, and nothing pulls at the right one.
    alone = FRAME.replace("2, 3, 7, 4\n", "").replace("3, 2, 6, 3\n", "").replace("4, 1, 3\n", "")
    for card in ("*ELEMENT, TYPE=B32R, ELSET=BEAM\n", "*ELEMENT, TYPE=SPRINGA, ELSET=BRACE\n", "4, 1, 6\n*STEP"):
        assert card in alone
        alone = alone.replace(card, card[card.find("*STEP") :] if "*STEP" in card else "")
    alone = alone.replace("*SPRING, ELSET=BRACE\n\n1.\n", "").replace("ELSET=BEAM, ", "ELSET=POSTS, ")
    post, _ = solve(tmp_path, alone)
    assert displacements[2][0] == pytest.approx(post[2][0], rel=0.05)  # the joint of beams in solid form is stiffer
    assert post[2][0] > 10
    assert np.linalg.norm(displacements[3]) < 1e-6


@pytest.mark.parametrize("tool", [fs.Sphere((4, 0, 0), 1), fs.Cylinder((4, 0, 0), (0, 0, 1), 1)])
@pytest.mark.parametrize("method", ["snap", "deform"])
def test_a_wall_in_the_middle_of_a_beam(tool, method):
    """Halves, quarters, ... of a beam are where it is looked at first."""
    mesh = fs.Mesh([[0, 0, 0], [10, 0, 0], [6, 0, 0], [2, 1, 0]], {"line": [[0, 1], [2, 3]]})
    result = fs.drill(mesh, tool, method=method)
    ends = np.sort(result.mesh.points[result.mesh.cells["line"]][:, :, 0][:, :], axis=1)
    assert [3, 0] not in ends.tolist() and sorted(e.tolist() for e in ends if e[0] in (0, 5))[0] == [0, 3]
    assert [5, 10] in ends.tolist()


def test_holes_far_smaller_than_beams():
    mesh = fs.Mesh([[0, 0, 0], [1000, 0, 0]], {"line": [[0, 1]]})
    for at in (500.0, 0.7, 999.5):
        for result in (
            fs.cut(mesh, fs.Plane((at, 0, 0), (1, 0, 0)), width=0.5),
            fs.drill(mesh, fs.Sphere((at, 0, 0), 0.25)),
        ):
            x = np.sort(result.mesh.points[:, 0])
            assert np.allclose(x, [0, at - 0.25, at + 0.25, 1000], rtol=0, atol=1e-9)


def test_far_from_the_origin():
    rng = np.random.default_rng(1)
    for _ in range(300):
        origin, normal = 1e6 * rng.normal(size=3), rng.normal(size=3)
        normal /= np.linalg.norm(normal)
        beside = origin + 0.3 * np.cross(normal, rng.normal(size=(20, 3)))
        points = np.stack([beside - normal / 20, beside + normal / 20], axis=1).reshape(-1, 3)
        mesh = fs.Mesh(points, {"line": np.arange(40).reshape(-1, 2)})
        cells = fs.crack(mesh, fs.Plane(origin, normal)).mesh.cells["line"]
        assert len(cells) == 40 and len(np.unique(cells)) == 80


def test_a_beam_in_the_crack_joins_no_sides():
    mesh = fs.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [2, 1, 0]], {"line": [[0, 1], [1, 2], [2, 3]]})
    cells = fs.crack(mesh, fs.Plane((1, 0, 0), (1, 0, 0))).mesh.cells["line"]
    assert cells.tolist() == [[0, 1], [1, 2], [4, 3]]


def test_bottom_of_a_hole_that_only_beams_elsewhere_cross():
    mesh = fs.Mesh([[-2, 0, 1], [2, 0, 1], [9, 0, -1], [9, 0, 2]], {"line": [[0, 1], [2, 3]]})
    result = fs.drill(mesh, fs.Cylinder((0, 0, 1.5), (0, 0, -1), 0.5), depth=1.5)
    assert np.allclose(np.sort(result.mesh.points[:, 0]), [-2, -0.5, 0.5, 2, 9, 9])


@pytest.mark.parametrize("at", [0.9, 1.2, 0.5, 1.0])
def test_beams_on_mid_side_nodes(at):
    """They stay with the material, on their side."""
    box = quadratic(grid_box((2, 2, 2), (2.0, 2.0, 2.0)))
    tets = box.cells["tetra10"]
    for node in np.unique(tets[:, 4:])[::3]:
        for side in (-1, 1):
            far = box.points[node] + (7 * side, 0, 0)
            mesh = fs.Mesh(np.vstack([box.points, [far]]), {"tetra10": tets, "line": [[node, box.node_count]]})
            after = fs.crack(mesh, fs.Plane((at, 1, 1), (1, 0, 0))).mesh
            beams = [n for n in after.cells["line"] if len(box.points) + 1 in after.node_ids[n]]
            (end,) = [n for n in beams[0] if after.node_ids[n] != box.node_count + 1]
            start = box.points[node][0]
            if (start - at) * side < 0:
                assert abs(after.points[end][0] - at) < 1e-9  # it was cut
                continue
            assert np.array_equal(after.points[end], box.points[node])
            around = after.cells["tetra10"][(after.cells["tetra10"] == end).any(axis=1)]
            assert len(around) and ((after.points[around].mean(axis=1)[:, 0] - at) * side > 0).all()


SPAN = """*NODE, NSET=NALL
1, 0, 0, 0
2, 10, 0, 0
3, 0, 5, 0
4, 3, 5, 0
*ELEMENT, TYPE=B31, ELSET=BEAM
1, 1, 2
2, 3, 4
*NSET, NSET=SUPPORTS
1, 2
*MATERIAL, NAME=STEEL
*ELASTIC
210000, .3
*BEAM SECTION, SECTION=RECT, ELSET=BEAM, MATERIAL=STEEL
.4, .1
0, 0, 1
*NORMAL
1, 1, 0, -0.6, 0.8
1, 2, 0, -0.8, 0.6
*BOUNDARY
{supports}
*STEP
*STATIC
*END STEP
"""


@pytest.mark.parametrize("supports", ["SUPPORTS, 1, 3", "1, 1, 3\n2, 1, 3"])
def test_supports_at_both_ends_of_a_beam(tmp_path, supports):
    """There are none between them; what is for all nodes is for new ones, and they get a normal."""
    deck = tmp_path / "span.inp"
    deck.write_text(SPAN.format(supports=supports))
    result = fs.crack(fs.read(str(deck)), fs.Plane((5, 0, 0), (1, 0, 0)), strict=True)
    assert result.mesh.groups["SUPPORTS"].ids.tolist() == [1, 2]
    assert result.mesh.groups["NALL"].ids.tolist() == [1, 2, 3, 4, 5, 6]
    fs.write(result.mesh, str(deck))
    text = deck.read_text()
    normal = np.array([0, -0.7, 0.7]) / np.hypot(0.7, 0.7)
    for element, node in ((1, 5), (3, 6)):
        line = next(
            x for x in text.splitlines() if x.replace(" ", "").startswith(f"{element},{node},") and x.count(",") == 4
        )
        assert np.allclose([float(w) for w in line.split(",")[2:]], normal)
    assert text.split("*BOUNDARY")[1].split("*STEP")[0].strip() == supports


def test_what_names_a_beam_or_hangs_on_it(tmp_path):
    deck = tmp_path / "bolt.inp"
    deck.write_text(
        "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 2, 0, 0\n4, 1, 1, 0\n6, 1.5, 0, 1\n*ELEMENT, TYPE=B31, ELSET=BEAM\n"
        "1, 1, 2\n2, 2, 3\n*ELEMENT, TYPE=SPRINGA, ELSET=SPRING\n3, 2, 4\n*SPRING, ELSET=SPRING\n\n10.\n"
        "*PRE-TENSION SECTION, NODE=6, ELEMENT=2\n*STEP\n*STATIC\n*END STEP\n"
    )
    mesh = fs.read(str(deck))
    hole = fs.drill(mesh, fs.Sphere((1, 0, 0), 0.3))
    assert mesh.cell_ids["line"].tolist() == [1, 2, 3] and sorted(hole.mesh.cell_ids["line"].tolist()) != [1, 2, 3]
    assert 3 not in hole.mesh.cell_ids["line"]
    assert any("1 spring, dashpot or gap ends inside" in w for w in hole.report.warnings)
    assert any("PRE-TENSION" in w and "element 2" in w for w in hole.report.warnings)
    assert any("was divided" in w for w in fs.crack(mesh, fs.Plane((1.5, 0, 0), (1, 0, 0))).report.warnings)
