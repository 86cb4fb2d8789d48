# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shape and size of elements."""

from typing import Dict

import numpy as np

from .mesh import Mesh, check_mesh


def mean_ratio(mesh: Mesh) -> Dict[str, np.ndarray]:
    """Mean ratio of every element by type, in the order of ``mesh.cells``: 1 equilateral, 0 flat, negative inverted.

    By the corner nodes: 12 (3V)^(2/3) / sum of squared edge lengths for tetrahedra, 4 sqrt(3) A / that sum for
    triangles (Liu and Joe, BIT 34, 1994). Other shapes: the smallest over their corners, scaled so that the regular
    element has 1. 1 for points and segments.
    """
    return check_mesh(mesh).mean_ratios()


def measure(mesh: Mesh) -> Dict[str, np.ndarray]:
    """Length, area or volume of every element by type, in the order of ``mesh.cells``, in the mesh's unit.

    Volumes are signed. Quadratic elements are integrated on their own curved shape. 0 for points.
    """
    return check_mesh(mesh).measures()
