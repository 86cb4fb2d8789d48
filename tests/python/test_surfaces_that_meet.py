# SPDX-License-Identifier: LGPL-2.1-or-later
"""More surfaces at a place than a node can lie on."""

import femscalpel as fs
import pytest
from meshes import grid_box


@pytest.mark.parametrize("along", [[(0, 2.5, 4), (0, 0, 2), (7, 0, 4)], "END"])
def test_rounded_edges_that_meet_in_a_corner(along):
    """Made soundly or refused with the reason; they once read memory that was not theirs."""
    mesh = grid_box((28, 10, 8), (14.0, 5.0, 4.0))
    mesh.add_group("END", "node", mesh.node_ids[mesh.points[:, 0] == 0])
    try:
        rounded = fs.fillet(mesh, along, 0.5).mesh
    except fs.Error as error:
        assert len(str(error)) > 20
    else:
        assert min(ratios.min() for ratios in fs.mean_ratio(rounded).values()) > 0.05
