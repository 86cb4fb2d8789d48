# SPDX-License-Identifier: LGPL-2.1-or-later
"""What of a mesh an operator has changed, in one numbering with the mesh as it was."""

import itertools

import numpy as np

from femscalpel.mesh import CELL_TYPES

from . import faces as mesh_faces
from .cells import Cells


class Band:
    """The changed elements of a result, and which of the source's are as they were.

    Nodes are numbered as the source's rows, then the new ones.
    """

    def __init__(self, source, result, whole=False, removed_region=None):
        """`whole`, `removed_region`: as of make_preview()."""
        mesh, report = result.mesh, result.report
        self.source, self.mesh, self.report = source, mesh, report
        self.node_count = source.mesh.node_count
        rows = source.rows(mesh.node_ids)
        new = rows < 0
        moved = np.zeros(len(rows), bool)
        moved[~new] = (mesh.points[~new] != source.points[rows[~new]]).any(axis=1)
        self.moved = mesh.points[moved]
        #: Number of each node of the result.
        self.number = np.where(new, self.node_count + np.cumsum(new) - 1, rows)
        self.points = np.concatenate([source.points, mesh.points[new]])
        self.points[self.number] = mesh.points
        self.total = len(self.points)
        near = np.zeros(self.total, bool)
        near[self.number[new | moved]] = True
        for ids in report.node_sets.values():
            at = source.rows(ids)
            near[at[at >= 0]] = True
        self._near = near
        self._find_cells(near, whole, removed_region)

    def _find_cells(self, near, whole, removed_region):
        source, mesh = self.source, self.mesh
        cells = Cells(
            mesh,
            lambda kind, nodes: near[self.number[nodes]].any(axis=1) | ~self._as_before(kind, self.number[nodes]),
        )
        cells.blocks = [(kind, self.number[nodes]) for kind, nodes in cells.blocks]
        lacking = np.ones(len(source.cells), bool)
        for ids in mesh.cell_ids.values():
            lacking[source.cells.find(ids)] = False
        self._lacking = lacking
        #: Mask of the source's elements that are removed as a whole.
        self.gone = np.zeros(len(source.cells), bool)
        #: Mask of the source's elements that the changed ones stand for.
        self.replaced = np.zeros(len(source.cells), bool)
        self.replaced[source.cells.find(cells.ids)] = True
        if removed_region is not None:
            self.gone, cut = self._removed_by(removed_region, lacking)
            self.replaced |= cut
        if whole:
            self.replaced |= lacking
        # What the result lacks is as it was; near the changed elements it is drawn as they are.
        around = source.cells.per_cell(lambda nodes: near[nodes].any(axis=1)).astype(bool) & ~self.replaced
        overlapped = self._overlapped(cells, around & lacking)
        self.replaced |= overlapped
        around &= ~overlapped
        #: The changed elements, and the family of each.
        self.cells = cells.with_some_of(source.cells, around)
        self.families = np.append(cells.families(mesh, source.families), source.cell_family[around])
        #: Mask of the source's elements that are drawn as they were.
        self.stays = ~self.replaced & ~around

    def _overlapped(self, cells, chosen):
        """Mask of those `chosen` of the source's solids that changed elements, `cells`, stand for: they are on the same
        side of a face, or have not the face that another one that they stand for had. Improving takes elements away
        that the tool does not reach."""
        out = np.zeros(len(chosen), bool)
        faces, owner, keys, middles = self._solid_faces(self.source.cells, chosen)
        _, _, changed_keys, changed_middles = self._solid_faces(cells, np.ones(len(cells), bool))
        if not len(keys) or not len(changed_keys):
            return out
        corners = self.points[faces[:, :3]]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])

        def side(points):
            return np.einsum("ij,ij->i", normals, points - corners[:, 0])

        order = np.argsort(changed_keys)
        ascending, own = changed_keys[order], side(middles)
        # A face has two changed elements at most.
        for at in (np.searchsorted(ascending, keys), np.searchsorted(ascending, keys, "right") - 1):
            at = order[np.clip(at, 0, len(order) - 1)]
            out[owner[(changed_keys[at] == keys) & (own * side(changed_middles[at]) > 0)]] = True
        lost = np.unique(self._solid_faces(self.source.cells, self.replaced & ~self.gone)[2])
        # The lips of a crack along faces have no others on their faces.
        alone = ~np.isin(keys, changed_keys) & ~self._doubled()[faces[:, :3]].any(axis=1)
        while True:
            lost = np.union1d(lost, keys[out[owner]])
            more = owner[alone & ~out[owner] & np.isin(keys, lost)]
            if not len(more):
                return out
            out[more] = True

    def _doubled(self):
        """Mask of the nodes that others of the result are at the place of."""
        _, place, times = np.unique(self.mesh.points, axis=0, return_inverse=True, return_counts=True)
        out = np.zeros(self.total, bool)
        out[self.number[times[place.ravel()] > 1]] = True
        return out

    def _solid_faces(self, cells, chosen):
        """(faces, their elements, their keys, the middles of the elements) of the solids among Cells that a mask
        chooses."""
        faces, owners, middles, first = [np.empty((0, 4), np.int64)], [np.empty(0, np.int64)], [np.empty((0, 3))], 0
        for kind, nodes in cells.blocks:
            at = np.flatnonzero(chosen[first : first + len(nodes)])
            if CELL_TYPES[kind][0] == 3 and len(at):
                of_kind, owner = mesh_faces.faces_of(kind, nodes[at])
                faces.append(of_kind)
                owners.append(first + at[owner])
                middles.append(self.points[nodes[at]].mean(axis=1)[owner])
            first += len(nodes)
        faces = np.concatenate(faces)
        keys = mesh_faces.face_keys(faces, self.total)
        return faces, np.concatenate(owners), keys, np.concatenate(middles)

    def _as_before(self, kind, nodes):
        """Mask of the result's elements of a type that the source has, too, with the same nodes."""
        first, before = self.source.cells.block(kind)
        at = self.source.cells.positions(self.mesh.cell_ids[kind]) - first
        known = (at >= 0) & (at < len(before))
        same = np.zeros(len(nodes), bool)
        same[known] = (before[at[known]] == nodes[known]).all(axis=1)
        return same

    def _removed_by(self, region, lacking):
        """Masks of the source's elements that lie where region.distance() is negative; of these, and of the `lacking`
        ones that reach there."""
        cells, points, out = self.source.cells, self.source.points, []
        distance = region.distance(points)
        inside, near = distance <= 1e-9 * self.source.size, distance <= self.source.longest
        gone = cells.per_cell(lambda nodes: inside[nodes].all(axis=1)).astype(bool)
        unsure = lacking & ~gone & cells.per_cell(lambda nodes: near[nodes].any(axis=1)).astype(bool)
        for nodes in cells.each(unsure):
            corners = points[nodes]
            found = (region.distance(corners.mean(axis=1)) < 0) | inside[nodes].any(axis=1)
            for a, b in itertools.combinations(range(nodes.shape[1]), 2):
                found |= region.distance((corners[:, a] + corners[:, b]) / 2) < 0
            out.append(found)
        reaching = gone.copy()
        reaching[unsure] = np.concatenate([np.zeros(0, bool), *out])
        return gone, reaching

    def outer_faces(self, distance):
        """(faces, owner, family, mask of lips) of the changed elements, without those that others lie on.

        `distance` of every node: zero on what was made.
        """
        source, total = self.source, self.total
        faces, owner, family = self.cells.surface(total, self.families)
        on_tool = all_corners(faces, np.abs(distance) <= 1e-7 * source.size)
        skin, part_of = mesh_faces.with_parts(source.skin)
        on_skin, at = mesh_faces.find(mesh_faces.face_keys(faces, total), mesh_faces.face_keys(skin, total))
        if len(source.skin):
            # The element of dimension 2 on an unchanged face may be outside the band.
            family = np.where(on_skin, source.skin_family[part_of[at]], family)
        beside = mesh_faces.find(mesh_faces.face_keys(faces, total), mesh_faces.face_keys(self._faces_beside(), total))[
            0
        ]
        solid = self.cells.dimension[owner] == 3
        lip = solid & on_tool & ~on_skin & ~beside
        shown = ~beside | ~solid
        return faces[shown], owner[shown], family[shown], lip[shown]

    def gone_for_sure(self):
        """Numbers of all elements of the source that are gone, beside those that the result has; None where the counts
        say that this is not known to the last element."""
        source, report = self.source, self.report
        lines, line_ids = segments(source.mesh)
        lines_gone = self._near[lines].any(axis=1) & ~np.isin(line_ids, segments(self.mesh)[1])
        gone = np.concatenate([source.cells.ids[self._lacking & ~self.stays], line_ids[lines_gone]])
        return gone if len(gone) == report.elements_removed else None

    def _faces_beside(self):
        """Faces of the source's solids that are as they were and reach to the changed ones."""
        touched = np.zeros(self.total, bool)
        for _, nodes in self.cells.blocks:
            touched[nodes] = True
        found = []
        for (kind, _), nodes in zip(self.source.cells.blocks, self.source.cells.each(self.stays)):
            if CELL_TYPES[kind][0] == 3:
                found.append(mesh_faces.faces_of(kind, nodes[touched[nodes].sum(axis=1) > 2]))
        return mesh_faces.joined(found)[0]

    def beams(self, faces, report):
        """Lines (k, 2, 3) of segments that are no edge of `faces` or of the skin that stays, and were not made."""
        mesh = self.mesh
        made = {(g.name, g.kind) for g in report.groups if g.status == "new"}
        made = [np.empty(0, np.int64)] + [g.ids for g in mesh.groups.all("element") if (g.name, g.kind) in made]
        lines, ids = segments(mesh)
        kept = ~np.isin(ids, np.concatenate(made))
        lines, source = self.number[lines[kept]], self.source
        before = source.beams[~np.isin(source.beam_ids, ids)]
        lines = lines[mesh_faces.free_lines(lines, np.concatenate([faces, source.skin]), self.total)]
        return self.points[np.concatenate([before, lines])].astype(np.float32)


def all_corners(faces, mask):
    """Mask of the faces all of whose corners are in a mask of nodes."""
    return mask[faces[:, 0]] & mask[faces[:, 1]] & mask[faces[:, 2]] & ((faces[:, 3] < 0) | mask[faces[:, 3]])


def centres(faces, points):
    """Mean of the corners of faces."""
    triangle = faces[:, 3] < 0
    total = points[faces[:, 0]] + points[faces[:, 1]] + points[faces[:, 2]]
    total = np.where(triangle[:, None], total, total + points[faces[:, 3]])
    return total / np.where(triangle, 3.0, 4.0)[:, None]


def segments(mesh):
    """The segments of a mesh by their ends (k, 2), and their numbers."""
    kinds = [kind for kind in ("line", "line3") if kind in mesh.cells]
    lines = [np.empty((0, 2), np.int64)] + [np.asarray(mesh.cells[kind])[:, :2] for kind in kinds]
    return np.concatenate(lines), np.concatenate([np.empty(0, np.int64)] + [mesh.cell_ids[kind] for kind in kinds])
