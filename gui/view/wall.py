# SPDX-License-Identifier: LGPL-2.1-or-later
"""Walls of a mesh: what groups can be moved, which of them a point of the skin is in, and what surface they lie on."""

from dataclasses import dataclass

import numpy as np

from femscalpel.mesh import CELL_TYPES

# How far nodes may be off a plane that is taken for theirs, and off a round surface, as a part of its size.
_CLOSE, _FAR = 1e-3, 0.03


@dataclass(frozen=True)
class Fit:
    """The surface that a wall lies on."""

    shape: str  #: "Plane", "Cylinder" or "Sphere"
    origin: np.ndarray
    direction: np.ndarray  #: of the normal or axis
    radius: float = 0.0

    def __post_init__(self):
        for name in ("origin", "direction"):
            object.__setattr__(self, name, np.round(getattr(self, name), 12) + 0.0)  # no -0
        object.__setattr__(self, "radius", round(float(self.radius), 12))


def walls(mesh):
    """Names of the groups that can be walls: of faces (of a shell: segments), facets or nodes."""
    top = max((CELL_TYPES[name][0] for name in mesh.cells), default=0)
    bulk = [np.empty(0, np.int64)] + [ids for name, ids in mesh.cell_ids.items() if CELL_TYPES[name][0] == top]
    bulk = np.concatenate(bulk)
    names = [
        group.name
        for group in mesh.groups.all()
        if len(group.ids) and not (group.kind == "element" and np.isin(group.ids, bulk).any())
    ]
    return list(dict.fromkeys(names))


def best_first(source, names):
    """The same names, of which the first can be moved: it lies on a surface that can be told, and is no lip of a crack,
    whose nodes have others in their place. The others stay in their order."""
    _, inverse, counts = np.unique(source.mesh.points, axis=0, return_inverse=True, return_counts=True)
    doubled = counts[inverse.reshape(-1)] > 1
    no_lips = [name for name in names if not doubled[nodes_of(source.mesh, name)].mean() > 0.5]
    first = next((name for name in no_lips if fit(source, name) is not None), (no_lips or names or [None])[0])
    return sorted(names, key=lambda name: name != first)


def nodes_of(mesh, name):
    """Boolean array: the nodes of the groups of a name that can be a wall."""
    nodes = np.zeros(mesh.node_count, bool)
    for group in mesh.groups.all():
        if group.name != name:
            continue
        if group.kind == "node":
            nodes |= np.isin(mesh.node_ids, group.ids)
        elif group.kind == "element":
            for cell_type, ids in mesh.cell_ids.items():
                if CELL_TYPES[cell_type][0] < 3:
                    nodes[mesh.cells[cell_type][np.isin(ids, group.ids)]] = True
    return nodes


def wall_at(source, point):
    """Name of the smallest wall that the face of the skin nearest to a point is in, or None."""
    face = source.skin[np.argmin(((source.skin_centres - point) ** 2).sum(axis=1))]
    corners = face[face >= 0]
    found = [
        (nodes.sum(), name) for name in walls(source.mesh) if (nodes := nodes_of(source.mesh, name))[corners].all()
    ]
    return min(found)[1] if found else None


def fit(source, name):
    """The Fit of a wall, or None where it is no plane, cylinder or sphere."""
    nodes = nodes_of(source.mesh, name)
    points = source.points[nodes]
    if len(points) < 3:
        return None
    middle = points.mean(axis=0)
    _, spread, axes = np.linalg.svd(points - middle, full_matrices=False)
    if not (source.cells.dimension == 3).any():
        return _of_shell(source, points, axes, spread)
    if spread[2] <= _CLOSE * spread[0]:
        return Fit("Plane", middle, _upright(axes[2]))
    faces = source.skin[:, :3][nodes[source.skin[:, :3]].all(axis=1)]
    found = _sphere(points)
    if found is None and len(faces):
        _, strength, directions = np.linalg.svd(_normals(source, faces), full_matrices=False)
        if strength[2] <= 0.5 * strength[0]:  # triangles across a cylinder are tilted a little
            found = _cylinder(points, directions[2])
    return found


def _normals(source, faces):
    a, b, c = (source.points[faces[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    return normals / np.linalg.norm(normals, axis=1)[:, None]


def _of_shell(source, points, axes, spread):
    """The Fit of a shell's border: across a straight one a plane, through a round one a cylinder."""
    if spread[1] <= _CLOSE * spread[0]:
        middle = points.mean(axis=0)
        beside = source.skin[np.argmin(((source.skin_centres - middle) ** 2).sum(axis=1))]
        return Fit("Plane", middle, _upright(np.cross(axes[0], _normals(source, beside[None, :3])[0])))
    return _cylinder(points, axes[2]) if spread[2] <= _CLOSE * spread[0] else None


def _centre(points):
    """Of the circle or sphere nearest to points of two or three coordinates."""
    equations = np.column_stack([2 * points, np.ones(len(points))])
    return np.linalg.lstsq(equations, (points**2).sum(axis=1), rcond=None)[0][:-1]


def _cylinder(points, axis):
    """The cylinder nearest to points, from a first guess of its axis on: Gauss-Newton's method, in the end with the
    nearer points only."""
    across = np.linalg.svd(axis[None, :])[2][1:]
    centre = _centre(points @ across.T) @ across + axis * (points @ axis).mean()
    near = np.ones(len(points), bool)
    for turn in range(30):
        x, y = ((points - centre) @ across.T).T
        z, distance = (points - centre) @ axis, np.hypot(x, y)
        radius = distance[near].mean()
        if turn > 10:
            near = _nearer(distance, radius)
        slopes = np.column_stack([-x, -y, -x * z, -y * z, -distance]) / distance[:, None]
        step = np.linalg.lstsq(slopes[near], (radius - distance)[near], rcond=None)[0]
        centre = centre + step[:2] @ across
        axis = axis + step[2:4] @ across
        axis = axis / np.linalg.norm(axis)
        across = np.linalg.svd(axis[None, :])[2][1:]
    if np.abs(distance - radius).max() > _FAR * min(radius, np.ptp(points, axis=0).max()):
        return None
    axis = _upright(axis)
    along = (points - centre) @ axis
    return Fit("Cylinder", centre + axis * (along.min() + along.max()) / 2, axis, radius)


def _sphere(points):
    near = np.ones(len(points), bool)
    for _ in range(10):
        centre = _centre(points[near])
        distance = np.linalg.norm(points - centre, axis=1)
        radius = distance[near].mean()
        near = _nearer(distance, radius)
    if np.abs(distance - radius).max() > _FAR * min(radius, np.ptp(points, axis=0).max()):
        return None
    return Fit("Sphere", centre, np.array((0.0, 0.0, 1.0)), radius)


def _nearer(distance, radius):
    """Boolean array: points that are not off the surface by much more than most; operators may have moved a few on the
    skin's triangles, which are inside or outside it."""
    off = np.abs(distance - radius)
    return off <= max(3 * np.median(off), 1e-9 * radius)


def _upright(axis):
    """A direction, or the opposite one: its largest component is positive, and what is nearly zero is zero."""
    axis = np.where(np.abs(axis) < 1e-9, 0.0, axis)
    axis = axis / np.linalg.norm(axis)
    return axis if axis[np.argmax(np.abs(axis))] > 0 else -axis
