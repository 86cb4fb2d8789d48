# SPDX-License-Identifier: LGPL-2.1-or-later
"""Edges of meshes whose coordinates were rounded, as files have them; more by fillet_cases.py --digits 6."""

import numpy as np
import pytest

import femscalpel as fs
import fillet_cases
from meshes import grid_box
from rounding_cases import rounded
from test_fillet import face_points

#: Edges in planes, along circles, in walls, with groups, that meet.
CASES = [("convex", 0), ("convex", 1), ("concave", 1), ("bordered", 2), ("ended", 2), ("ended", 6), ("corner", 2),
         ("corner", 15), ("wall", 22)]  # fmt: skip


@pytest.mark.parametrize("rounding", [6, "single"])
@pytest.mark.parametrize("kind, seed", CASES)
def test_is_as_good_as_exact(kind, seed, rounding):
    out = fillet_cases.one(kind, seed, rounding)
    assert out.problem == "" and out.good


def test_a_face_that_is_curved_is_still_seen_to_be():
    """By more than rounding, and little otherwise: twice the angle that is let pass."""
    turn, _ = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))
    plain = grid_box((8, 5, 5), (8.0, 5.0, 5.0))
    x, y, z = plain.points.T
    for twist, accepted in ((0, True), (2e-3, False)):
        moved = plain.points.copy()
        moved[:, 2] -= twist * (x - 4) * np.minimum(y, 3)
        mesh = rounded(fs.Mesh(moved @ turn.T + 20, plain.cells), 6)
        edge = turn @ (4, 0, 0) + 20
        if accepted:
            assert len(face_points(fs.fillet(mesh, [edge], 1.0).mesh)) > 20
            continue
        with pytest.raises(fs.ToolError, match="a face beside the edge is not plane"):
            fs.fillet(mesh, [edge], 1.0)
