# SPDX-License-Identifier: LGPL-2.1-or-later
"""What an operator did, as data, as text and as CSV."""

import csv
import dataclasses
import json
import math
import os
from dataclasses import dataclass
from typing import Dict, List, NamedTuple, Optional, Tuple

import numpy as np

from .mesh import Instance


class ElementQuality(NamedTuple):
    """An element number and its mean ratio."""

    id: int
    mean_ratio: float


@dataclass(frozen=True, eq=False)
class QualitySummary:
    """Shape quality of a set of elements: mean ratio of the corner nodes, 1 equilateral, 0 degenerate."""

    count: int  #: number of elements
    minimum: float
    mean: float
    histogram: np.ndarray  #: (20,) int64; bar k counts mean ratios in [k, k + 1) / 20
    worst: List[ElementQuality]  #: at most ten, worst first

    @classmethod
    def _from_engine(cls, fields: dict) -> "QualitySummary":
        return cls(**{**fields, "worst": [ElementQuality(*e) for e in fields["worst"]]})


class Refinement(NamedTuple):
    """A refinement that came first, because the tool was finer than the mesh or a size was given."""

    size: float  #: longest edge wanted near the tool; of several sizes the smallest
    elements_before: int  #: of the whole mesh, all kinds
    elements_after: int  #: by refining alone


class Quality(NamedTuple):
    """Quality of the elements near the tool, or converted or divided first; and of what they became."""

    before: QualitySummary
    after: QualitySummary


@dataclass(frozen=True)
class GroupRecord:
    """What happened to one group.

    A measure is the sum of lengths, areas or volumes of the members of the group's highest dimension, in the
    mesh's unit; 0 for node groups.
    """

    name: str
    kind: str  #: "node", "element" or "facet"
    dimension: int  #: of the largest members; 0 for nodes
    count_before: int
    count_after: int
    measure_before: float
    measure_after: float
    nodes_moved: int  #: nodes of the group, or of its elements, that changed place
    boundary_kept: bool  #: False: its boundary was allowed to drift (`preserve`)
    boundary_drift: float  #: largest distance of its boundary nodes from the boundary's old shape
    #: Nodes near the tool on the group's virtual boundary that may move on a surface ...
    nodes_on_surface: int
    nodes_on_line: int  #: ... along a line ...
    nodes_fixed: int  #: ... and not at all, the tool apart.
    status: str  #: "untouched", "kept", "changed", "reduced" (lost members to a tool), "became empty" or "new"


@dataclass(frozen=True)
class HeldNodes:
    """Nodes that something holds a little beside the tool: it goes through them where they are, or ends there."""

    count: int
    largest: float  #: how far they are off the tool, in the mesh's unit
    groups: List[str]  #: whose boundary holds them
    features: List[str]  #: what else does: "the skin", "a corner", ...


@dataclass(frozen=True)
class StraightenedEdges:
    """Mid-side nodes left in the middle of straight edges beside the surface, curve or curved tool they belong to, as
    no sound curved element found room there."""

    count: int  #: of nodes
    largest: float  #: how far they are off it, in the mesh's unit


@dataclass(frozen=True)
class PoorPlace:
    """A place where elements came out with a mean ratio below 0.02 (and below a tenth of the worst there was), as what
    is kept there and the tool leave no room for better ones."""

    elements: List[int]  #: numbers of the input's elements that they are parts of, worst first
    mean_ratio: float  #: of the worst
    place: Tuple[float, float, float]  #: its middle
    groups: List[str]  #: whose boundary is kept there: without them in `preserve`, there is room
    features: List[str]  #: what else is kept: "the skin", "a feature line", ...
    gap: float  #: between the tool and what is kept, at the worst: the tool moved by so much goes through it
    room: float  #: how large that would have to be for good elements


class FieldRecord(NamedTuple):
    """What became of a field's values on one support. Nodes or elements are counted over all time steps."""

    name: str
    support: str  #: "node", "element", "element nodes" or "element points"
    steps: int
    kept: int  #: bit for bit: of what the operator did not touch
    doubled: int  #: new nodes with the value of the one they double
    parts: int  #: elements that changed or are new: their own or their parent's value, or made of that
    made: int  #: nodes that are new or moved: interpolated in the mesh as it was
    outside: int  #: of all these, at places where there was nothing: the value of the nearest point of the mesh
    absent: int  #: new nodes and elements without a value, as there was nothing
    removed: int  #: values of nodes and elements that are gone
    farthest: float  #: how far those outside are off, in the mesh's unit


class Extent(NamedTuple):
    """How long, or large, something is that an operator has made."""

    what: str  #: "crack" (one of its lips), "front", "wall", "bottom", "end", "seam" or "face"
    group: str  #: name of its group
    dimension: int  #: 1: `measure` is a length, 2: an area
    measure: float  #: in the mesh's unit


# Groups that operators make, by what their names end with. The other lip, or wall of a slot, _N, is as large as _P.
_MADE = {
    "_P": "crack",
    "_FRONT": "front",
    "_WALL": "wall",
    "_BOTTOM": "bottom",
    "_END": "end",
    "_SEAM": "seam",
    "_FACE": "face",
}


@dataclass(frozen=True, eq=False, repr=False)
class Report:
    """What an operator did; the same for all operators. Lengths are in the mesh's unit."""

    operation: str  #: "crack", ...
    name: str  #: prefix of the groups it made
    method: str  #: "snap" or "deform"
    transition: int  #: number of rings around the tool that were allowed to move
    #: Node numbers: ICN, ECN (interface), ITN, ETN (transition), as in the paper. Of mid-side nodes those that moved,
    #: in the set of their edge: interface if it lies on the tool, else transition.
    node_sets: Dict[str, np.ndarray]
    #: Number of nodes by constraint: the tool's kind ("plane"), "tangent plane" (on the skin or a shell), of these
    #: "line" and "fixed"; "group boundary"; "free". A node can count twice.
    constraints: Dict[str, int]
    quality: Quality  #: near the tool, before and after
    groups: List[GroupRecord]
    held: HeldNodes
    straightened: StraightenedEdges  #: count 0 when all curved edges are where they belong
    poor: List[PoorPlace]  #: empty when all is well; of a merged mesh also those of the addition, by its own numbers
    refinement: Optional[Refinement]  #: part of what the counts below say
    welded_pairs: int  #: of double nodes near the tool that stayed pairs: each side did as the other
    #: Quadrangles, prisms, pyramids, hexahedra near the tool that became triangles and tetrahedra first, by type: part
    #: of what the counts below say
    converted: Dict[str, int]
    beams_cut: int  #: places where the tool passes through a beam: a segment that is no edge of another element
    nodes_added: int  #: by splitting and by doubling
    nodes_split: int  #: of them, born on split edges
    nodes_doubled: int  #: of them, copies of interface nodes
    nodes_moved: int
    nodes_removed: int
    elements_added: int
    elements_removed: int
    max_displacement: float
    fields: List[FieldRecord]  #: of a mesh with fields: one for each field and support
    seconds: Dict[str, float]  #: by step, in order
    warnings: List[str]
    #: Of a mesh from a deck of parts: which numbers are whose, as the mesh was read. See :attr:`Mesh.instances`.
    instances: Tuple[Instance, ...] = ()

    @classmethod
    def _from_engine(cls, fields: dict, instances: Tuple[Instance, ...] = ()) -> "Report":
        fields = dict(fields, instances=instances)
        before, after = (QualitySummary._from_engine(fields.pop(key)) for key in ("quality_before", "quality_after"))
        groups = [GroupRecord(**g) for g in fields.pop("groups")]
        fields["held"] = HeldNodes(**fields["held"])
        fields["straightened"] = StraightenedEdges(**fields["straightened"])
        fields["fields"] = [FieldRecord(*f) for f in fields["fields"]]
        fields["poor"] = [PoorPlace(**p) for p in fields["poor"]]
        if fields["refinement"] is not None:
            fields["refinement"] = Refinement(*fields["refinement"])
        return cls(quality=Quality(before, after), groups=groups, **fields)

    @property
    def constraints_by_group(self) -> Dict[str, Dict[str, int]]:
        """Constraint counts of each group: how many nodes near the tool its boundary keeps on a "surface", on a "line"
        or "fixed". Groups of one name but several kinds are told apart by `groups`, which has the same numbers."""
        counts: Dict[str, Dict[str, int]] = {}
        for g in self.groups:
            sums = counts.setdefault(g.name, {"surface": 0, "line": 0, "fixed": 0})
            for key, count in zip(sums, (g.nodes_on_surface, g.nodes_on_line, g.nodes_fixed)):
                sums[key] += count
        return counts

    @property
    def extents(self) -> List[Extent]:
        """Area or length of what the operator has made: a crack and its front, a hole's wall, a seam, ..."""
        found = {g.name: g for g in self.groups if g.status == "new" and g.kind != "node" and g.dimension > 0}
        made = dict(_MADE, _P="wall") if self.operation == "cut" else _MADE
        named = [(what, found.get(self.name + suffix)) for suffix, what in made.items()]
        return [Extent(what, g.name, g.dimension, g.measure_after) for what, g in named if g is not None]

    def to_text(self) -> str:
        """Summary, warnings, the table of groups and, for decks of parts, that of their instances as aligned text."""
        before, after = self.quality
        also = ", or converted or divided first" if self.converted or self.refinement else ""
        facts = [
            (
                "nodes",
                f"{self.nodes_added} added ({self.nodes_split} on split edges, {self.nodes_doubled} doubled), "
                f"{self.nodes_removed} removed, {self.nodes_moved} moved by at most {self.max_displacement:.4g}",
            ),
            ("elements", f"{self.elements_added} added, {self.elements_removed} removed"),
            ("node sets", _counts({name: len(ids) for name, ids in self.node_sets.items()})),
            ("constraints", _counts(self.constraints)),
            (
                "mean ratio",
                f"minimum {before.minimum:.3f} -> {after.minimum:.3f}, mean {before.mean:.3f} -> {after.mean:.3f} "
                f"({before.count} -> {after.count} elements near the tool{also})",
            ),
            (
                "seconds",
                f"{sum(self.seconds.values()):.3f}"
                + (f" ({_counts({k: f'{s:.3f}' for k, s in self.seconds.items()})})" if self.seconds else ""),
            ),
        ]
        if self.extents:
            facts.insert(
                0, ("made", "; ".join(f"{e.what} of {_MEASURES[e.dimension]} {e.measure:.6g}" for e in self.extents))
            )
        if self.refinement is not None:
            size, elements_before, elements_after = self.refinement
            facts.insert(
                0,
                (
                    "refined",
                    f"first, to edges of {size:.4g} near the tool: {elements_before} -> {elements_after} elements",
                ),
            )
        if self.welded_pairs:
            facts.insert(0, ("double nodes", f"{self.welded_pairs} pairs stayed pairs"))
        if self.converted:
            facts.insert(0, ("converted", f"first, to triangles or tetrahedra: {_counts(self.converted)}"))
        if self.beams_cut:
            facts.insert(0, ("beams", f"cut in {self.beams_cut} places"))
        for field in self.fields:
            counts = {key: count for key, count in field._asdict().items() if isinstance(count, int) and count}
            counts.pop("steps", None)
            facts.append(("field", f"{field.name} ({field.support}, {field.steps} steps): {_counts(counts)}"))
        title = f"{self.operation} {self.name}".rstrip()
        lines = [f"{title}: method {self.method}, transition {self.transition}"]
        lines += [f"  {label:<12} {fact}" for label, fact in facts]
        lines += [f"  {'warning':<12} {warning}" for warning in self.warnings] or [f"  {'warnings':<12} none"]
        return "\n".join(lines + ["", *self._group_table(), *self._instance_table()]) + "\n"

    def _instance_table(self) -> List[str]:
        """How parts' numbers became the mesh's; nothing for meshes that are not of parts."""
        if not self.instances:
            return []
        rows = [("instance", "part", "numbers", "nodes", "elements")]
        for name, part, offset, *ranges in self.instances:
            spans = (f"{first} to {last}" if first else "none" for first, last in ranges)
            rows.append((name or "(assembly)", part, f"+{offset}" if offset else "as in part", *spans))
        lines = _aligned(rows, left=2)
        return ["", lines[0], "-" * len(lines[0]), *lines[1:]]

    def _group_table(self) -> List[str]:
        header = (
            "group",
            "kind",
            "status",
            "count",
            "->",
            "after",
            "measure",
            "->",
            "after",
            "change",
            "moved",
            "drift",
            "surface/line/fixed",
        )
        rows = [header]
        for g in self.groups:
            measured = g.kind != "node" and g.dimension > 0
            if measured and g.measure_before:
                change = f"{(g.measure_after - g.measure_before) / g.measure_before:+.1e}"
            else:
                change = "-"
            unit = {0: "", 1: "L", 2: "A", 3: "V"}[g.dimension] if measured else ""
            rows.append(
                (
                    g.name,
                    g.kind + (f" {unit}" if unit else ""),
                    g.status,
                    str(g.count_before),
                    "->",
                    str(g.count_after),
                    f"{g.measure_before:.6g}" if measured else "-",
                    "->",
                    f"{g.measure_after:.6g}" if measured else "-",
                    change,
                    str(g.nodes_moved),
                    f"{g.boundary_drift:.2g}" + ("" if g.boundary_kept else " free"),
                    f"{g.nodes_on_surface}/{g.nodes_on_line}/{g.nodes_fixed}",
                )
            )
        lines = _aligned(rows, left=3)
        return [lines[0], "-" * len(lines[0]), *lines[1:]] if self.groups else ["no groups"]

    def to_csv(self, file) -> None:
        """Writes the table of groups as CSV, one row per group, columns as in :class:`GroupRecord`.

        `file` is a path, or an open text file.
        """
        if isinstance(file, (str, os.PathLike)):
            with open(file, "w", newline="", encoding="utf-8") as opened:
                self.to_csv(opened)
            return
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow([field.name for field in dataclasses.fields(GroupRecord)])
        writer.writerows(dataclasses.astuple(group) for group in self.groups)

    def to_dict(self, node_ids: bool = True) -> dict:
        """All of the report as dictionaries, lists, numbers and texts, `extents` among them.

        With `node_ids` False, `node_sets` has the number of nodes in place of their numbers.
        """
        data = {field.name: getattr(self, field.name) for field in dataclasses.fields(self)}
        data["node_sets"] = {name: ids if node_ids else len(ids) for name, ids in self.node_sets.items()}
        data["extents"] = self.extents
        return _plain(data)

    def to_json(self, file=None, node_ids: bool = True) -> Optional[str]:
        """Writes the report as JSON, as :meth:`to_dict` has it; what is no number is null.

        `file` is a path, or an open text file; without one the text is returned.
        """
        text = json.dumps(self.to_dict(node_ids), indent=1, allow_nan=False, ensure_ascii=False) + "\n"
        if file is None:
            return text
        if isinstance(file, (str, os.PathLike)):
            with open(file, "w", encoding="utf-8") as opened:
                opened.write(text)
        else:
            file.write(text)
        return None

    def __str__(self) -> str:
        return self.to_text()

    def __repr__(self) -> str:
        return (
            f"<Report {self.operation} {self.name!r}: {self.nodes_added} nodes added, {self.nodes_moved} moved, "
            f"mean ratio at least {self.quality.after.minimum:.3f}, {len(self.warnings)} warnings>"
        )


_MEASURES = {1: "length", 2: "area", 3: "volume"}


def _plain(value):
    """A value made of what JSON has."""
    if dataclasses.is_dataclass(value):
        return {field.name: _plain(getattr(value, field.name)) for field in dataclasses.fields(value)}
    if isinstance(value, dict):
        return {key: _plain(entry) for key, entry in value.items()}
    if hasattr(value, "_asdict"):
        return _plain(value._asdict())
    if isinstance(value, np.ndarray):
        return _plain(value.tolist())
    if isinstance(value, (list, tuple)):
        return [_plain(entry) for entry in value]
    if isinstance(value, np.generic):
        return _plain(value.item())
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _aligned(rows: List[Tuple[str, ...]], left: int) -> List[str]:
    """Rows of a table as lines; the first `left` columns are flush left, the others right."""
    widths = [max(map(len, column)) for column in zip(*rows)]
    return [
        " ".join(cell.ljust(w) if i < left else cell.rjust(w) for i, (cell, w) in enumerate(zip(row, widths))).rstrip()
        for row in rows
    ]


def _counts(values: dict) -> str:
    return ", ".join(f"{key} {value}" for key, value in values.items()) or "none"
