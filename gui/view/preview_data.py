# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the preview draws and says, as arrays. Made off the GUI thread; makes no use of FreeCAD and Coin."""

import functools
from dataclasses import dataclass, field
from typing import Dict, List, Tuple

import numpy as np

import femscalpel
from femscalpel.mesh import CELL_TYPES
from femscalpelobjects.pieces import parting_of

from . import faces as mesh_faces
from .band import Band, centres, segments
from .cells import Cells, Families
from .islands import areas, islands as islands_of
from .group_shape import elements_shape, group_shape, joined, nodes_shape


# The part of the mesh's outer faces that what hangs together has at least to be no island.
_SMALL = 0.1


@dataclass(frozen=True, eq=False)
class Surface:
    """Faces to draw: rows index `points`."""

    points: np.ndarray  #: (n, 3) float32
    faces: np.ndarray  #: (m, 4), -1 ends a triangle
    quality: np.ndarray  #: (m,) mean ratio of the element behind
    family: np.ndarray  #: (m,) index into a list of families
    lip: np.ndarray  #: (m,) bool: on the tool
    island: np.ndarray = None  #: (m,) bool: far from what was made, and small; None for none
    beams: np.ndarray = field(default_factory=lambda: np.empty((0, 2, 3), np.float32))  #: lines beside them

    @classmethod
    def make(cls, points, faces, quality, family, lip=None, **others):
        rows, used = mesh_faces.compact(faces, points)
        return cls(used, rows, quality, family, np.zeros(len(faces), bool) if lip is None else lip, **others)

    def without_lip(self):
        """The faces that are not on the tool."""
        return self._part(~self.lip)

    def parted(self):
        """(the faces that are no islands, those that are)."""
        if self.island is None:
            return self, self._part(np.zeros(len(self.faces), bool))
        return self._part(~self.island), self._part(self.island)

    def _part(self, kept):
        return Surface(self.points, self.faces[kept], self.quality[kept], self.family[kept], self.lip[kept])


@dataclass(frozen=True, eq=False)
class PreviewData:
    """One state of the preview. Lines are (k, 2, 3) float32 coordinates, points (k, 3)."""

    result: object  #: femscalpel.Result
    rest: Tuple[Surface, Surface]  #: unchanged part on the negative and on the positive side
    band: Tuple[Surface, Surface]  #: changed part likewise
    families: List[Tuple[str, ...]]  #: names of groups by family
    borders: np.ndarray  #: lines between groups
    beams: np.ndarray  #: lines that are elements of their own
    outline: np.ndarray  #: lines around the new surface
    front: np.ndarray  #: lines where the crack ends inside the part
    moved: np.ndarray  #: points
    in_front: np.ndarray  #: (k,) bool: moved points on the new surface, or in front of it when it is cut open
    replaced: np.ndarray  #: numbers of the source's elements that the changed part stands for
    removed: Surface  #: outer faces of elements that go
    worst: np.ndarray  #: edges of the worst element
    worst_centre: np.ndarray  #: (3,) float32
    worst_ratio: float
    parting: object = None  #: femscalpelobjects.pieces.Parting where the part is known to fall into more pieces
    lip_area: int = 0  #: number of faces (edges of a shell) on the new surface
    seconds: Dict[str, float] = field(default_factory=dict)


# Part of the size of a mesh within which nearest_inside() looks for the middle of the material.
_AROUND = 0.15


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
        lines, ids = segments(mesh)
        free = mesh_faces.free_lines(lines, self.skin, node_count)
        #: Ends and numbers of the segments that are no edges of the skin.
        self.beams, self.beam_ids = lines[free], ids[free]
        self.borders, self.border_faces = mesh_faces.border_edges(self.skin, self.skin_family, node_count)
        low, high = (self.points.min(axis=0), self.points.max(axis=0)) if node_count else (np.zeros(3), np.ones(3))
        self.low, self.high = low, high
        self.size = float(np.linalg.norm(high - low)) or 1.0
        #: Of the elements: 2 where any has nodes in the middle of edges.
        self.order = 2 if any(nodes > corners for _, nodes, corners in map(CELL_TYPES.get, mesh.cells)) else 1

    def rows(self, node_ids):
        """Rows of nodes by number, -1 for numbers the mesh does not have."""
        at = np.minimum(np.searchsorted(self._ascending, node_ids), len(self._ascending) - 1)
        return np.where(self._ascending[at] == node_ids, self._order[at], -1)

    @functools.cached_property
    def longest(self):
        """What no element is longer than."""
        sizes = self.cells.per_cell(lambda nodes: np.linalg.norm(np.ptp(self.points[nodes], axis=1), axis=1))
        return float(sizes.max()) if len(sizes) else 0.0

    @functools.cached_property
    def pieces(self):
        """How many pieces the mesh is in."""
        return len(femscalpel.pieces(self.mesh))

    @functools.cached_property
    def area(self):
        """Of the outer faces."""
        return float(areas(self.skin, self.points).sum())

    def edge_length(self):
        """Mean length of the edges of the outer faces; of a mesh without such a twentieth of its size."""
        if not len(self.skin):
            return self.size / 20
        return float(np.linalg.norm(self.points[self.skin[:, 0]] - self.points[self.skin[:, 1]], axis=1).mean())

    def nearest_inside(self, place):
        """The middle of an element near a place that may lie outside the part, not just under the skin; None where the
        mesh has neither faces nor volumes."""
        middles = self.cells.per_cell(lambda nodes: self.points[nodes].mean(axis=1))
        if not len(middles):
            return None
        middles = middles[self.cells.dimension == self.cells.dimension.max()]
        nearest = middles[np.linalg.norm(middles - place, axis=1).argmin()]
        around = middles[np.linalg.norm(middles - nearest, axis=1) <= _AROUND * self.size]
        return around[np.linalg.norm(around - around.mean(axis=0), axis=1).argmin()]

    def whole(self):
        """The unchanged mesh as a Surface."""
        beams = self.points[self.beams].astype(np.float32)
        return Surface.make(self.points, self.skin, self.skin_quality, self.skin_family, beams=beams)


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


def make_preview(source, result, tool, removed_region=None, whole=False):
    """The PreviewData of a result.

    Parameters
    ----------
    source : PreviewSource
    result : femscalpel.Result
        Of the whole mesh, or of its band alone if nothing was divided or converted before the operation itself.
    tool : femscalpel.Tool, or anything
        Whose distance(points) is zero on what the operator made.
    removed_region : object, optional
        Its distance(points) is negative where the operator removes material.
    whole : bool
        The result is of the whole mesh: elements that it lacks are gone.
    """
    report, band = result.report, Band(source, result, whole, removed_region)
    points, cells, distance = band.points, band.cells, tool.distance(band.points)
    faces, owner, family, lip = band.outer_faces(distance)
    positive = (cells.per_cell(lambda nodes: distance[nodes].mean(axis=1)) > 0)[owner]
    stays = band.stays[source.skin_owner]
    beyond = tool.distance(source.skin_centres) > 0
    on_tool = np.abs(distance) <= 1e-7 * source.size
    edges, on_front = _outline(band, report, faces, lip, positive, on_tool)
    made = np.zeros(len(points), bool)
    made[edges] = True
    # What is seen when it is cut open: of a crack one side, of a hole the changed elements.
    removes = band.gone.any()
    opened = (~positive | removes, stays & ~beyond & ~removes)
    islands = [np.zeros(len(positive), bool), np.zeros(len(stays), bool)]
    found = islands_of(np.concatenate([faces[opened[0]], source.skin[opened[1]]]), points, made, _SMALL * source.area)
    islands[0][opened[0]], islands[1][opened[1]] = np.split(found, [opened[0].sum()])
    sides = tuple(
        Surface.make(
            points,
            faces[side],
            cells.quality[owner[side]],
            family[side],
            lip[side],
            island=islands[0][side] & ~lip[side],
        )
        for side in (~positive, positive)
    )
    rest = tuple(
        Surface.make(
            source.points,
            source.skin[side],
            source.skin_quality[side],
            source.skin_family[side],
            island=islands[1][side],
        )
        for side in (stays & ~beyond, stays & beyond)
    )
    lines = points[edges].astype(np.float32).reshape(-1, 2, 3)
    drawn = np.zeros(len(points), bool) if lip.any() else on_tool
    worst, centre, ratio = _worst(report, result.mesh)
    return PreviewData(
        result=result,
        rest=rest,
        band=sides,
        families=list(source.families.names),
        borders=np.concatenate([_kept_borders(source, stays), _band_borders(points, faces, family, lip, drawn)]),
        beams=band.beams(faces, report),
        outline=lines[~on_front],
        front=lines[on_front],
        moved=band.moved.astype(np.float32),
        in_front=removes | (tool.distance(band.moved) > -1e-7 * source.size),
        replaced=source.cells.ids[band.replaced],
        removed=_removed(source, band.gone),
        worst=worst,
        worst_centre=centre,
        worst_ratio=ratio,
        parting=_parting(source, band, whole),
        lip_area=int(lip.sum()),
    )


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


def _parting(source, band, whole):
    """The Parting that is shown, if any; None also where it is not known."""
    if whole:
        return parting_of(band.mesh, source.pieces, known={(g.name, g.kind) for g in source.mesh.groups.all()})
    gone = band.gone_for_sure()
    return None if gone is None else parting_of(source.mesh, source.pieces, band.mesh, gone)


def _removed(source, gone):
    if not gone.any():
        return Surface.make(source.points, np.empty((0, 4), np.int64), np.empty(0), np.empty(0, np.int64))
    blocks = [(kind, nodes) for (kind, _), nodes in zip(source.cells.blocks, source.cells.each(gone))]
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


def _outline(band, report, faces, lip, positive, on_tool):
    """Edges (k, 2) around the lips; of a shell, the lips themselves. Which of them are on the front."""
    mesh, points, number, total = band.mesh, band.points, band.number, band.total
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
    edges = edges.reshape(-1, 2)
    return edges, front[edges].all(axis=1)


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


class _Telling:
    """A femscalpel.Scalpel whose operators call `before_refining`."""

    _SILENT = ("reshape",)  # it never refines first

    def __init__(self, scalpel, before_refining):
        self._scalpel, self.before_refining = scalpel, before_refining

    def __getattr__(self, name):
        value = getattr(self._scalpel, name)
        if name in self._SILENT or not callable(value):
            return value
        return functools.partial(value, before_refining=self.before_refining)


class _RefinesFirst(Exception):
    """The band alone will not do: elements away from the tool are divided, too."""


def _stop(estimate):
    raise _RefinesFirst


def preview_of(source, operate, surface, region, whole, before_refining=None):
    """The PreviewData of what operate() makes of the Scalpel; `before_refining` as of femscalpel's operators."""
    telling = _Telling(source.scalpel, before_refining)
    if whole:
        result = operate(telling)
    else:
        try:
            result = operate(_Telling(source.scalpel, _stop), True)
            whole = bool(result.report.converted)
        except _RefinesFirst:
            whole = True
        if whole:
            result = operate(telling, False)
    return make_preview(source, result, surface(result) if callable(surface) else surface, region, whole)
