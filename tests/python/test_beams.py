# SPDX-License-Identifier: LGPL-2.1-or-later
"""Beams, trusses, rods: cut by cracks, trimmed by holes and slots; springs stay whole."""

import numpy as np
import pytest

import femscalpel as fs
import beam_cases
from calculix_runs import solve
from meshes import grid_box


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
