# SPDX-License-Identifier: LGPL-2.1-or-later
"""The elements of a mesh over its types, and numbers for sets of groups, for drawing."""

import copy

import numpy as np

import femscalpel
from femscalpel.mesh import CELL_TYPES

from . import faces as mesh_faces


class Families:
    """Numbers for sets of groups; the same set gets the same number as long as this object lives."""

    def __init__(self):
        self.names = [()]
        self._number = {(): 0}

    def number(self, names):
        if names not in self._number:
            self._number[names] = len(self.names)
            self.names.append(names)
        return self._number[names]


class Cells:
    """The elements of a mesh of dimension 2 and 3, joined over their types, or a chosen part of them."""

    def __init__(self, mesh, keep=None):
        """`keep(cell_type, connectivity)` gives a mask of the elements wanted."""
        self.blocks, ids, quality, dimension = [], [], [], []
        ratios = femscalpel.mean_ratio(mesh)
        all_ids = mesh.cell_ids
        for cell_type, connectivity in mesh.cells.items():
            if CELL_TYPES[cell_type][0] < 2:
                continue
            nodes = mesh_faces.corners(cell_type, connectivity)
            chosen = slice(None) if keep is None else np.flatnonzero(keep(cell_type, nodes))
            nodes = nodes[chosen]
            self.blocks.append((cell_type, nodes))
            ids.append(all_ids[cell_type][chosen])
            quality.append(ratios[cell_type][chosen])
            dimension.append(np.full(len(nodes), CELL_TYPES[cell_type][0]))
        self.ids = np.concatenate(ids) if ids else np.empty(0, np.int64)
        self.quality = np.concatenate(quality) if quality else np.empty(0)
        self.dimension = np.concatenate(dimension) if dimension else np.empty(0, np.int64)
        self._index()

    def _index(self):
        self._order = np.argsort(self.ids)
        self._ascending = self.ids[self._order]

    def __len__(self):
        return len(self.ids)

    def positions(self, ids):
        """Positions of elements by number, -1 for those that are not here."""
        if not len(self.ids):
            return np.full(len(ids), -1)
        at = np.minimum(np.searchsorted(self._ascending, ids), len(self.ids) - 1)
        return np.where(self._ascending[at] == ids, self._order[at], -1)

    def find(self, ids):
        """Positions of elements by number, of those that are here."""
        at = self.positions(ids)
        return at[at >= 0]

    def block(self, kind):
        """(position of the first element of a type, the corners of all of it)."""
        first = 0
        for name, nodes in self.blocks:
            if name == kind:
                return first, nodes
            first += len(nodes)
        return first, np.empty((0, 1), np.int64)

    def with_some_of(self, other, chosen):
        """These, then the elements of another Cells with the same numbers of nodes that a mask chooses."""
        out = copy.copy(self)
        out.blocks = self.blocks + [(kind, nodes) for (kind, _), nodes in zip(other.blocks, other.each(chosen))]
        for name in ("ids", "quality", "dimension"):
            setattr(out, name, np.concatenate([getattr(self, name), getattr(other, name)[chosen]]))
        out._index()
        return out

    def each(self, chosen):
        """The corners of the elements that a mask chooses, of one type after the other."""
        first = 0
        for _, nodes in self.blocks:
            yield nodes[chosen[first : first + len(nodes)]]
            first += len(nodes)

    def per_cell(self, function):
        """function(connectivity) of every block, joined."""
        parts = [function(nodes) for _, nodes in self.blocks]
        return np.concatenate(parts) if parts else np.empty(0)

    def families(self, mesh, numbers):
        """Family number of every element; `numbers` is a Families."""
        out = np.zeros(len(self.ids), np.int64)
        for group in mesh.elementary_groups():
            if group.kind == "element" and group.dimension >= 2:
                out[self.find(group.ids)] = numbers.number(group.groups)
        return out

    def surface(self, node_count, families):
        """(faces, owner, family) of the outer faces; a face with an element of its own on it has that one's family."""
        faces, owner = mesh_faces.outer_faces(self.blocks, node_count)
        family = families[owner]
        if len(faces) and (self.dimension == 3).any() and (self.dimension == 2).any():
            skins, first = [], 0
            for cell_type, nodes in self.blocks:
                if CELL_TYPES[cell_type][0] == 2:
                    rows, at = mesh_faces.faces_of(cell_type, nodes)
                    skins.append((rows, at + first))
                first += len(nodes)
            rows, at = mesh_faces.joined(skins)
            on, found = mesh_faces.find(mesh_faces.face_keys(faces, node_count), mesh_faces.face_keys(rows, node_count))
            family = np.where(on & (families[at[found]] > 0), families[at[found]], family)
        return faces, owner, family
