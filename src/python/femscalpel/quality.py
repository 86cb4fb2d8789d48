# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shape and size of elements."""

from typing import Dict

import numpy as np

from .mesh import Mesh, check_mesh


def mean_ratio(mesh: Mesh) -> Dict[str, np.ndarray]:
    """Mean ratio of every element by type, in the order of ``mesh.cells``: 1 equilateral, 0 flat, negative inverted.

    By the corner nodes: 12 (3V)^(2/3) / sum of squared edge lengths for tetrahedra, 4 sqrt(3) A / that sum for
    triangles (Liu and Joe, BIT 34, 1994). Other shapes: the smallest over their corners, scaled so that the regular
    element has 1; negative for quadrangles that cross themselves. 1 for points and segments.
    """
    return check_mesh(mesh).mean_ratios()


def measure(mesh: Mesh) -> Dict[str, np.ndarray]:
    """Length, area or volume of every element by type, in the order of ``mesh.cells``, in the mesh's unit.

    Volumes are signed. Quadratic elements are integrated on their own curved shape. 0 for points.
    """
    return check_mesh(mesh).measures()


# Corner nodes at each corner: the corner, then its neighbours along the edges, so that a regular element counts
# positive.
_CORNERS = {
    "tetra": ((0, 1, 2, 3), (1, 2, 0, 3), (2, 0, 1, 3), (3, 0, 2, 1)),
    "pyramid": ((0, 1, 3, 4), (1, 2, 0, 4), (2, 3, 1, 4), (3, 0, 2, 4)),
    "wedge": ((0, 1, 2, 3), (1, 2, 0, 4), (2, 0, 1, 5), (3, 5, 4, 0), (4, 3, 5, 1), (5, 4, 3, 2)),
    "hexahedron": (
        (0, 1, 3, 4),
        (1, 2, 0, 5),
        (2, 3, 1, 6),
        (3, 0, 2, 7),
        (4, 7, 5, 0),
        (5, 4, 6, 1),
        (6, 5, 7, 2),
        (7, 6, 4, 3),
    ),
    "triangle": ((0, 1, 2), (1, 2, 0), (2, 0, 1)),
    "quad": ((0, 1, 3), (1, 2, 0), (2, 3, 1), (3, 0, 2)),
}
# Ends of the edges in the order of their mid-side nodes.
_EDGES = {
    shape: [frozenset(map(int, e)) for e in edges.split()]
    for shape, edges in {
        "tetra": "01 12 02 03 13 23",
        "pyramid": "01 12 23 03 04 14 24 34",
        "wedge": "01 12 02 34 45 35 03 14 25",
        "hexahedron": "01 12 23 03 45 56 67 47 04 15 26 37",
        "triangle": "01 12 02",
        "quad": "01 12 23 03",
    }.items()
}
_COUNT = {"tetra": 4, "pyramid": 5, "wedge": 6, "hexahedron": 8, "triangle": 3, "quad": 4}
# What the smallest corner of the regular element has.
_REGULAR = {
    "tetra": np.sqrt(0.5),
    "pyramid": np.sqrt(0.5),
    "wedge": np.sqrt(0.75),
    "hexahedron": 1.0,
    "triangle": np.sqrt(0.75),
    "quad": 1.0,
}
# Faces of solids, turning the same way round.
_FACES = {
    "tetra": ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)),
    "pyramid": ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
    "wedge": ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)),
    "hexahedron": ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)),
}

# Elements worked on at a time.
_PIECE = 50_000


def scaled_jacobian(mesh: Mesh) -> Dict[str, np.ndarray]:
    """Scaled Jacobian of every element by type, in the order of ``mesh.cells``: 1 regular, 0 flat, negative inverted.

    The smallest determinant of the unit edge vectors at a corner, divided by that of the regular element (Knupp,
    SIAM J. Sci. Comput. 23, 2001). Of triangles and quadrangles the sine of the smallest or largest corner angle,
    likewise divided; a corner that is turned over against the element's normal counts negative. 1 for points and
    segments.

    Second-order elements count by their straight edges and by the directions in which their curved edges leave the
    corners, whichever is worse: where it is not positive, the element's own Jacobian is not positive at a corner (0 at
    that of a quarter-point element).
    """

    def of(shape, points):
        corners, middles = points[:, : _COUNT[shape]], points[:, _COUNT[shape] :]
        smallest = np.full(len(points), np.inf)
        for corner in _CORNERS[shape]:
            start = corners[:, corner[0]]
            straight = [corners[:, k] - start for k in corner[1:]]
            smallest = np.minimum(smallest, determinant(shape, straight, corners))
            if middles.shape[1]:
                # The derivative of the parabola through both ends and the mid-side node.
                bent = [
                    4 * (middles[:, _EDGES[shape].index(frozenset((corner[0], k)))] - start) - e
                    for k, e in zip(corner[1:], straight)
                ]
                smallest = np.minimum(smallest, determinant(shape, bent, corners))
        return smallest / _REGULAR[shape]

    def determinant(shape, edges, corners):
        length = np.prod([np.linalg.norm(e, axis=1) for e in edges], axis=0)
        normal = np.cross(edges[0], edges[1])
        if len(edges) == 3:
            size = np.einsum("ij,ij->i", normal, edges[2])
        else:
            # Along the element's normal: of a quadrangle by its diagonals, of a triangle by two edges.
            whole = np.cross(corners[:, 2] - corners[:, 0], corners[:, -1] - corners[:, 1])
            # Where the diagonals are parallel, the element crosses itself.
            turned = np.einsum("ij,ij->i", normal, whole) <= 0
            size = np.linalg.norm(normal, axis=1) * np.where(turned, -1, 1)
        return size / np.where(length > 0, length, 1)

    return _by_type(mesh, of, _CORNERS, 1.0)


def smallest_angle(mesh: Mesh) -> Dict[str, np.ndarray]:
    """Smallest angle in degrees of every element by type, in the order of ``mesh.cells``.

    Of solids the smallest dihedral angle, between the planes of two faces that share an edge (70.53 for the regular
    tetrahedron), of triangles and quadrangles the smallest corner angle. By the corner nodes; a quadrangular face
    counts by its mean plane. NaN for points and segments.
    """

    def of(shape, points):
        smallest = np.full(len(points), np.inf)
        if shape not in _FACES:
            for a, b, c in _CORNERS[shape]:
                smallest = np.minimum(smallest, _angle(points[:, b] - points[:, a], points[:, c] - points[:, a]))
            return smallest
        faces = _FACES[shape]
        normals = []
        for face in faces:
            if len(face) == 3:
                normals.append(
                    np.cross(points[:, face[1]] - points[:, face[0]], points[:, face[2]] - points[:, face[0]])
                )
            else:
                normals.append(
                    np.cross(points[:, face[2]] - points[:, face[0]], points[:, face[3]] - points[:, face[1]])
                )
        for i, a in enumerate(faces):
            for j in range(i):
                if len(set(a) & set(faces[j])) == 2:
                    smallest = np.minimum(smallest, 180 - _angle(normals[i], normals[j]))
        return smallest

    return _by_type(mesh, of, _CORNERS, np.nan)


def _angle(a, b):
    return np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), np.einsum("ij,ij->i", a, b)))


def _by_type(mesh, function, known, otherwise):
    check_mesh(mesh)
    out = {}
    for name, nodes in mesh.cells.items():
        shape = name.rstrip("0123456789")
        if shape in known:
            # In pieces, so that Ctrl-C does not wait for NumPy, and memory stays small.
            pieces = [function(shape, mesh.points[nodes[k : k + _PIECE]]) for k in range(0, len(nodes), _PIECE)]
            out[name] = np.concatenate(pieces) if pieces else np.empty(0)
        else:
            out[name] = np.full(len(nodes), otherwise)
    return out
