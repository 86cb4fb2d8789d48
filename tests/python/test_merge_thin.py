# SPDX-License-Identifier: LGPL-2.1-or-later
"""Thin plates on coarse blocks: how far these are refined, and what a user can choose of that."""

import numpy as np
import pytest

import femscalpel as fs
from merge_parts import block, check_conforming, plate, worst
from meshes import grid_box

TURN = np.array([[np.cos(0.3), -np.sin(0.3), 0], [np.sin(0.3), np.cos(0.3), 0], [0, 0, 1]])
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
