# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the preview draws, as arrays. Made off the GUI thread; knows neither FreeCAD nor Coin."""

import copy
from dataclasses import dataclass, field
from typing import Dict, List, Tuple

import numpy as np

import femscalpel
from femscalpel.mesh import CELL_TYPES

from . import faces as mesh_faces
from .group_shape import elements_shape, group_shape, joined, nodes_shape


@dataclass(frozen=True, eq=False)
class Surface:
    """Faces to draw: rows index `points`."""

    points: np.ndarray  #: (n, 3) float32
    faces: np.ndarray  #: (m, 4), -1 ends a triangle
    quality: np.ndarray  #: (m,) mean ratio of the element behind
    family: np.ndarray  #: (m,) index into a list of families
    lip: np.ndarray  #: (m,) bool: on the tool

    @classmethod
    def make(cls, points, faces, quality, family, lip=None):
        rows, used = mesh_faces.compact(faces, points)
        return cls(used, rows, quality, family, np.zeros(len(faces), bool) if lip is None else lip)

    def without_lip(self):
        """The faces that are not on the tool."""
        kept = ~self.lip
        return Surface(self.points, self.faces[kept], self.quality[kept], self.family[kept], self.lip[kept])


@dataclass(frozen=True, eq=False)
class PreviewData:
    """One state of the preview. Lines are (k, 2, 3) float32 coordinates, points (k, 3)."""

    result: object  #: femscalpel.Result
    rest: Tuple[Surface, Surface]  #: unchanged part on the negative and on the positive side
    band: Tuple[Surface, Surface]  #: changed part likewise
    families: List[Tuple[str, ...]]  #: names of groups by family
    borders: np.ndarray  #: lines between groups
    outline: np.ndarray  #: lines around the new surface
    front: np.ndarray  #: lines where the crack ends inside the part
    moved: np.ndarray  #: points
    replaced: np.ndarray  #: numbers of the source's elements that the changed part stands for
    removed: Surface  #: outer faces of elements that go
    worst: np.ndarray  #: edges of the worst element
    worst_centre: np.ndarray  #: (3,) float32
    worst_ratio: float
    lip_area: int = 0  #: number of faces (edges of a shell) on the new surface
    seconds: Dict[str, float] = field(default_factory=dict)


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

    def find(self, ids):
        """Positions of elements by number, of those that are here."""
        if not len(self.ids):
            return np.empty(0, np.int64)
        at = np.minimum(np.searchsorted(self._ascending, ids), len(self.ids) - 1)
        return self._order[at[self._ascending[at] == ids]]

    def with_some_of(self, other, chosen):
        """These, then the elements of another Cells with the same numbers of nodes that a mask chooses."""
        out = copy.copy(self)
        firsts = np.cumsum([0] + [len(nodes) for _, nodes in other.blocks])
        rest = [(kind, nodes[chosen[first : first + len(nodes)]]) for (kind, nodes), first in zip(other.blocks, firsts)]
        out.blocks = self.blocks + rest
        for name in ("ids", "quality", "dimension"):
            setattr(out, name, np.concatenate([getattr(self, name), getattr(other, name)[chosen]]))
        out._index()
        return out

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
            rows, at = mesh_faces._joined(skins)
            on, found = _find(mesh_faces.face_keys(faces, node_count), mesh_faces.face_keys(rows, node_count))
            family = np.where(on & (families[at[found]] > 0), families[at[found]], family)
        return faces, owner, family


class PreviewSource:
    """A mesh and everything about it that does not depend on the tool."""

    def __init__(self, mesh):
        self.mesh = mesh
        self.scalpel = femscalpel.Scalpel(mesh)
        self.points = mesh.points
        self.families = Families()
        self.cells = Cells(mesh)
        node_count = mesh.node_count
        self._order = np.argsort(mesh.node_ids)
        self._ascending = mesh.node_ids[self._order]
        self.cell_family = self.cells.families(mesh, self.families)
        self.skin, self.skin_owner, self.skin_family = self.cells.surface(node_count, self.cell_family)
        self.skin_centres = centres(self.skin, self.points)
        self.skin_quality = self.cells.quality[self.skin_owner]
        self.borders, self.border_faces = mesh_faces.border_edges(self.skin, self.skin_family, node_count)
        low, high = (self.points.min(axis=0), self.points.max(axis=0)) if node_count else (np.zeros(3), np.ones(3))
        self.low, self.high = low, high
        self.size = float(np.linalg.norm(high - low)) or 1.0

    def rows(self, node_ids):
        """Rows of nodes by number, -1 for numbers the mesh does not have."""
        at = np.minimum(np.searchsorted(self._ascending, node_ids), len(self._ascending) - 1)
        return np.where(self._ascending[at] == node_ids, self._order[at], -1)

    def edge_length(self):
        """Mean length of the edges of the outer faces; of a mesh without such a twentieth of its size."""
        if not len(self.skin):
            return self.size / 20
        return float(np.linalg.norm(self.points[self.skin[:, 0]] - self.points[self.skin[:, 1]], axis=1).mean())

    def whole(self):
        """The unchanged mesh as a Surface."""
        return Surface.make(self.points, self.skin, self.skin_quality, self.skin_family)


class MadeNodes:
    """In place of a tool for make_preview(), where there is none: the nodes of a group, which an operator has made."""

    def __init__(self, mesh, name, kind):
        if kind == "node":
            rows = np.isin(mesh.node_ids, mesh.groups[name, kind].ids)
        else:
            ids = mesh.groups[name, kind].ids
            found = [mesh.cells[t][np.isin(of_type, ids)].ravel() for t, of_type in mesh.cell_ids.items()]
            rows = np.unique(np.concatenate(found))
        self._places = set(map(tuple, mesh.points[rows].tolist()))

    def distance(self, points):
        """Zero at these nodes, and negative elsewhere: nothing is on the positive side."""
        out = np.full(len(points), -1.0)
        likely = np.ones(len(points), bool)
        for axis in range(3):
            likely &= np.isin(points[:, axis], [place[axis] for place in self._places])
        for row in np.flatnonzero(likely):
            out[row] = 0.0 if tuple(points[row].tolist()) in self._places else -1.0
        return out


def centres(faces, points):
    """Mean of the corners of faces."""
    triangle = faces[:, 3] < 0
    total = points[faces[:, 0]] + points[faces[:, 1]] + points[faces[:, 2]]
    total = np.where(triangle[:, None], total, total + points[faces[:, 3]])
    return total / np.where(triangle, 3.0, 4.0)[:, None]


def make_preview(source, result, tool, removed_region=None, whole=False, changed_only=False):
    """The PreviewData of a result.

    Parameters
    ----------
    source : PreviewSource
    result : femscalpel.Result
        Of the whole mesh, or of its band alone.
    tool : femscalpel.Tool, or anything
        Whose distance(points) is zero on what the operator made.
    removed_region : object, optional
        Its distance(points) is negative where the operator removes material.
    whole : bool
        The result is of the whole mesh: elements that it lacks are gone.
    changed_only : bool
        The result has no element that is as it was: those it lacks stay.
    """
    mesh, report = result.mesh, result.report
    node_count = source.mesh.node_count
    rows = source.rows(mesh.node_ids)
    new = rows < 0
    known = ~new
    moved = np.zeros(len(rows), bool)
    moved[known] = (mesh.points[known] != source.points[rows[known]]).any(axis=1)

    # One numbering for both: the source's rows, then the new nodes.
    number = np.where(new, node_count + np.cumsum(new) - 1, rows)
    points = np.concatenate([source.points, mesh.points[new]])
    points[number] = mesh.points
    total = len(points)

    near = np.zeros(total, bool)
    near[number[new | moved]] = True
    for ids in report.node_sets.values():
        at = source.rows(ids)
        near[at[at >= 0]] = True

    cells = Cells(mesh, lambda cell_type, nodes: near[number[nodes]].any(axis=1))
    cells.blocks = [(cell_type, number[nodes]) for cell_type, nodes in cells.blocks]
    replaced = np.zeros(len(source.cells), bool)
    if not changed_only:
        replaced = source.cells.per_cell(lambda nodes: near[nodes].any(axis=1)).astype(bool)
    replaced[source.cells.find(cells.ids)] = True
    removed = Surface.make(points, np.empty((0, 4), np.int64), np.empty(0), np.empty(0, np.int64))
    if removed_region is not None:
        inside = removed_region.distance(source.points) <= 1e-9 * source.size
        gone = source.cells.per_cell(lambda nodes: inside[nodes].all(axis=1)).astype(bool)
        replaced |= gone
        removed = _removed(source, gone)
    if whole:
        replaced |= ~np.isin(source.cells.ids, np.concatenate(list(mesh.cell_ids.values())))
    stays = ~replaced

    families = cells.families(mesh, source.families)
    if changed_only:
        beside = source.cells.per_cell(lambda nodes: near[nodes].any(axis=1)).astype(bool) & stays
        cells, families = cells.with_some_of(source.cells, beside), np.append(families, source.cell_family[beside])
        stays &= ~beside
    faces, owner, family = cells.surface(total, families)
    distance = tool.distance(points)
    on_tool = _all_corners(faces, np.abs(distance) <= 1e-7 * source.size)
    # A face between the band and the rest: all its nodes are the source's, but it is neither skin nor on the tool.
    old = _all_corners(faces, np.arange(total) < node_count)
    keys = mesh_faces.face_keys(faces, total)
    skin, at = _find(keys, mesh_faces.face_keys(source.skin, total))
    # The element of dimension 2 on an unchanged face may be outside the band.
    family = np.where(skin, source.skin_family[at], family)
    solid = cells.dimension[owner] == 3
    lip = solid & on_tool & ~skin
    shown = skin | lip | ~old | ~solid
    faces, owner, family, lip = faces[shown], owner[shown], family[shown], lip[shown]

    positive = (cells.per_cell(lambda nodes: distance[nodes].mean(axis=1)) > 0)[owner]
    band = tuple(
        Surface.make(points, faces[side], cells.quality[owner[side]], family[side], lip[side])
        for side in (~positive, positive)
    )
    stays = stays[source.skin_owner]
    beyond = tool.distance(source.skin_centres) > 0
    rest = tuple(
        Surface.make(source.points, source.skin[side], source.skin_quality[side], source.skin_family[side])
        for side in (stays & ~beyond, stays & beyond)
    )

    on_tool = np.abs(distance) <= 1e-7 * source.size
    outline, front = _outline(mesh, report, points, number, faces, lip, positive, on_tool)
    drawn = np.zeros(total, bool) if lip.any() else on_tool
    worst, centre, ratio = _worst(report, mesh)
    return PreviewData(
        result=result,
        rest=rest,
        band=band,
        families=list(source.families.names),
        borders=np.concatenate([_kept_borders(source, stays), _band_borders(points, faces, family, lip, drawn)]),
        outline=outline,
        front=front,
        moved=mesh.points[moved].astype(np.float32),
        replaced=source.cells.ids[replaced],
        removed=removed,
        worst=worst,
        worst_centre=centre,
        worst_ratio=ratio,
        lip_area=int(lip.sum()),
    )


def _find(keys, among):
    """Which of `keys` are among others, and where there."""
    if not len(among):
        return np.zeros(len(keys), bool), np.zeros(len(keys), np.int64)
    order = np.argsort(among)
    at = order[np.minimum(np.searchsorted(among[order], keys), len(among) - 1)]
    return among[at] == keys, at


def group_in_preview(source, data, name, kind):
    """The GroupShape of a group in a preview: its part in the changed mesh, and its part in the source beside that."""
    changed, mesh = data.result.mesh, source.mesh
    shapes = []
    if (name, kind) in [(g.name, g.kind) for g in changed.groups.all()]:
        shapes.append(group_shape(changed, name, kind))
    if (name, kind) in [(g.name, g.kind) for g in mesh.groups.all()] and kind != "facet":
        ids = mesh.groups[name, kind].ids
        if kind == "node":
            shapes.append(nodes_shape(mesh, ids[~np.isin(ids, changed.node_ids)]))
        else:
            shown = np.concatenate([data.replaced, *changed.cell_ids.values()])
            shapes.append(elements_shape(mesh, ids[~np.isin(ids, shown)]))
    return joined(*shapes) if len(shapes) == 2 else shapes[0] if shapes else None


def _all_corners(faces, mask):
    return mask[faces[:, 0]] & mask[faces[:, 1]] & mask[faces[:, 2]] & ((faces[:, 3] < 0) | mask[faces[:, 3]])


def _removed(source, gone):
    blocks, first = [], 0
    for cell_type, nodes in source.cells.blocks:
        blocks.append((cell_type, nodes[gone[first : first + len(nodes)]]))
        first += len(nodes)
    faces, owner = mesh_faces.outer_faces(blocks, source.mesh.node_count)
    at = np.flatnonzero(gone)
    return Surface.make(source.points, faces, source.cells.quality[at[owner]], source.cell_family[at[owner]])


def _kept_borders(source, stays):
    sides = source.border_faces
    kept = stays[sides[:, 0]] | ((sides[:, 1] >= 0) & stays[sides[:, 1]])
    return source.points[source.borders[kept]].astype(np.float32)


def _band_borders(points, faces, family, lip, drawn):
    """Borders between groups on the band; none between nodes that are `drawn` as the outline."""
    skin = ~lip
    edges, sides = mesh_faces.border_edges(faces[skin], family[skin], len(points))
    # Where a face ends alone it meets the rest, or the lip, which has its own line.
    return points[edges[(sides[:, 1] >= 0) & ~drawn[edges].all(axis=1)]].astype(np.float32)


def _outline(mesh, report, points, number, faces, lip, positive, on_tool):
    """Lines around the lips; of a shell, the lips themselves. Of them, those on the front."""
    total = len(points)
    if lip.any():
        chosen = lip & ~positive
        if not chosen.any():
            chosen = lip
        edges, sides = mesh_faces.border_edges(faces[chosen], np.zeros(int(chosen.sum()), np.int64), total)
        edges = edges[sides[:, 1] < 0]
    else:
        edges, _ = mesh_faces.face_edges(faces)
        edges = mesh_faces.unique_edges(edges[on_tool[edges].all(axis=1)], total) if len(edges) else edges
    front = np.zeros(total, bool)
    name = report.name + "_FRONT"
    known = [(g.name, g.kind) for g in report.groups]
    if (name, "node") in known:
        members = np.isin(mesh.node_ids, mesh.groups[name, "node"].ids)
        front[number[members]] = True
    if (name, "element") in known:  # segments: the front of a bounded crack in a solid
        for cell_type in ("line", "line3"):
            if cell_type in mesh.cells:
                members = np.isin(mesh.cell_ids[cell_type], mesh.groups[name, "element"].ids)
                front[number[np.unique(mesh.cells[cell_type][members][:, :2])]] = True
    on_front = front[edges].all(axis=1) if len(edges) else np.zeros(0, bool)
    lines = points[edges].astype(np.float32).reshape(-1, 2, 3)
    return lines[~on_front], lines[on_front]


def _worst(report, mesh):
    empty = np.empty((0, 2, 3), np.float32), np.zeros(3, np.float32), 1.0
    if not report.quality.after.worst:
        return empty
    number, ratio = report.quality.after.worst[0]
    for cell_type, ids in mesh.cell_ids.items():
        at = np.flatnonzero(ids == number)
        if len(at):
            nodes = mesh.cells[cell_type][at[0]]
            edges = mesh_faces.edges_of_element(cell_type, nodes)
            corners = mesh_faces.corners(cell_type, nodes[None])[0]
            return (
                mesh.points[edges].astype(np.float32),
                mesh.points[corners].mean(axis=0).astype(np.float32),
                float(ratio),
            )
    return empty
