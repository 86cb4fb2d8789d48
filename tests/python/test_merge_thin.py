# SPDX-License-Identifier: LGPL-2.1-or-later
"""Thin plates on coarse blocks: how far these are refined, and what a user can choose of that."""

import numpy as np
import pytest

import femscalpel as fs
from merge_cases import in_one_line, with_middles
from merge_parts import block, check_conforming, plate, worst
from meshes import grid_box

TURN = np.array([[np.cos(0.3), -np.sin(0.3), 0], [np.sin(0.3), np.cos(0.3), 0], [0, 0, 1]])
KIND = ("triangle", "triangle6")
PLACE = (5.13, 4.87, 5)


@pytest.fixture(scope="module")
def base():
    return grid_box((10, 10, 5), (10.0, 10.0, 5.0))


def doubler(thickness):
    return block(PLACE, (6, 4, thickness), (12, 8, 1), "DOUBLER", TURN)


def elements(mesh):
    return sum(map(len, mesh.cells.values()))


@pytest.mark.parametrize("thickness, most", [(0.2, 2), (0.1, 2), (0.05, 3)])
def test_a_doubler_does_not_refine_the_block_in_vain(base, thickness, most):
    """Its own elements are flat: finer ones below are none the better."""
    thin = doubler(thickness)
    result = fs.merge(base, thin)
    check_conforming(result.mesh)
    assert elements(result.mesh) < most * (elements(base) + elements(thin))
    assert worst(result.mesh) > 0.3 * worst(thin)


@pytest.mark.parametrize("thickness", [0.2, 0.1, 0.05])
def test_a_standing_plate_refines_where_it_stands(base, thickness):
    rib = block(PLACE, (6, thickness, 4), (12, 1, 8), "RIB", TURN)
    result = fs.merge(base, rib)
    check_conforming(result.mesh)
    assert elements(result.mesh) < 2 * (elements(base) + elements(rib)) and worst(result.mesh) > 0.12


def test_refinement_is_the_users_to_choose(base):
    thin = doubler(0.05)
    never = fs.merge(base, thin, refine=False)
    assert never.report.refinement is None and elements(never.mesh) < 1.5 * (elements(base) + elements(thin))
    told = []
    sized = fs.merge(base, thin, refine=0.4, before_refining=told.append)
    assert sized.report.refinement.size == 0.4 and {t.size for t in told} == {0.4}
    assert elements(sized.mesh) > elements(never.mesh)
    check_conforming(sized.mesh)

    def stop(estimate):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        fs.merge(base, thin, refine=0.4, before_refining=stop)


@pytest.mark.parametrize("second_order", [False, True])
@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("turn", [0.2, 0.35, 1.1])
def test_narrow_elements_do_not_get_narrower(seed, turn, second_order):
    """A seam crosses all edges of narrow elements side by side: of its nodes there, half would be too many, also where
    they were mid-side nodes. These are not lost, and stay in their groups."""
    floor = plate((0, 0, 0), (10, 0, 0), (0, 10, 0), (11, 11), "FLOOR", 0.2, seed)
    along = 2.4 * np.array([np.cos(turn), np.sin(turn), 0])
    rib = plate((5, 5, -1) - along / 2, along, (-0.1 * along[1], 0.1 * along[0], 2.9), (20, 1), "RIB")
    if second_order:
        floor, rib = with_middles(floor), with_middles(rib)
    for mesh, name in ((floor, "ALL_OF_FLOOR"), (rib, "ALL_OF_RIB")):
        mesh.add_group(name, "node", mesh.node_ids)
    result = fs.merge(floor, rib).mesh
    check_conforming(result)
    assert in_one_line(result)
    assert worst(result) > 1.3 * worst(rib)
    in_use = np.unique(np.concatenate([c.reshape(-1) for c in result.cells.values()]))
    assert len(in_use) == result.node_count and set(floor.node_ids) <= set(result.node_ids)
    for name, group in (("ALL_OF_FLOOR", "FLOOR"), ("ALL_OF_RIB", "RIB")):
        elements = np.isin(result.cell_ids[KIND[second_order]], result.groups[group].ids)
        nodes = result.node_ids[np.unique(result.cells[KIND[second_order]][elements])]
        assert set(nodes) == set(result.groups[name].ids)


def test_an_addition_that_is_much_too_fine_is_refused_with_what_to_do():
    coarse = grid_box((3, 3, 3), (30.0, 30.0, 30.0))
    fine = block((15, 15, 30), (10, 0.02, 0.02), (500, 1, 1), "WIRE")
    words = "so much finer than the mesh.* Give refine=[0-9.]+, a longer edge"
    with pytest.raises(fs.ToolError, match=words) as caught:
        fs.merge(coarse, fine)
    assert caught.value.parameter == "refine"


@pytest.mark.parametrize(
    "other, options, parameter, words",
    [
        ("rib", dict(refine=-1), "refine", "must be a positive length"),
        ("rib", dict(refine=True), "refine", "not True"),
        ("rib", dict(refine=1e-7), "refine", "would make more than"),
        ("rib", dict(refine=0.2, method="tie"), "refine", "not for method='tie'"),
        ("beam", dict(refine=0.2), "refine", "not for beams"),
        ("rib", dict(before_refining=3), "before_refining", "must be callable"),
        ("rib", dict(tolerance=100), "tolerance", "all of it would count as touching"),
        ("rib", dict(tolerance=100, method="tie"), "tolerance", "all of it would count as touching"),
        ("beam", dict(tolerance=100), "tolerance", "all of it would count as touching"),
    ],
)
def test_what_is_wrong_is_named(other, options, parameter, words):
    floor = plate((0, 0, 0), (10, 0, 0), (0, 10, 0), (10, 10), "FLOOR")
    others = {
        "rib": plate((2, 5, 0), (6, 0, 0), (0, 0, 2), (6, 2), "RIB"),
        "beam": fs.Mesh(np.array([(5.0, 5, 0), (5, 5, 3)]), {"line": [(0, 1)]}),
    }
    with pytest.raises((fs.Error, TypeError, ValueError), match=words) as caught:
        fs.merge(floor, others[other], **options)
    assert caught.value.parameter == parameter
