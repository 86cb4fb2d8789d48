# SPDX-License-Identifier: LGPL-2.1-or-later
"""Faces that hang together, and those that float alone, by NumPy alone."""

import numpy as np


def areas(faces, points):
    """Areas (n,) of faces (n, 4), -1 ends a triangle; of points (k, 3)."""
    a, b, c = (points[faces[:, k]] for k in range(3))
    d = points[np.where(faces[:, 3] < 0, faces[:, 2], faces[:, 3])]
    return np.linalg.norm(np.cross(c - a, d - b), axis=1) / 2


def together(faces, node_count):
    """A label (n,) for each face, the same for those that hang together by nodes: the row of one of them."""
    label = np.arange(len(faces))
    if not len(faces):
        return label
    corner = faces >= 0
    owner, nodes = np.repeat(label, corner.sum(axis=1)), faces[corner]
    order = np.argsort(nodes, kind="stable")
    owner, nodes = owner[order], nodes[order]
    first = np.flatnonzero(np.append(True, nodes[1:] != nodes[:-1]))
    of_node = np.empty(node_count + 1, np.int64)
    of_node[-1] = len(faces)  # what a triangle lacks
    while True:
        before = label
        of_node[nodes[first]] = np.minimum.reduceat(label[owner], first)
        label = of_node[faces].min(axis=1)
        label = label[label]  # labels are rows: this doubles how far one reaches
        if (label == before).all():
            return label


def islands(faces, points, made, least):
    """Mask (n,) of the faces that hang together with none of the nodes `made`, a mask, and of which those that hang
    together have less than the area `least`."""
    label = together(faces, len(points))
    count = len(faces)
    area = np.bincount(label, areas(faces, points), count)
    near = np.bincount(label, np.append(made, False)[faces].any(axis=1), count) > 0
    return (~near & (area < least))[label]
