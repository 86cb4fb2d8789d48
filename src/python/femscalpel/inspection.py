# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a mesh holds, and what is odd in it."""

import json
from typing import Any, Dict, List, NamedTuple, Tuple

import numpy as np

from ._engine import Error
from .connected import pieces
from .mesh import CELL_TYPES, Mesh, check_mesh
from .quality import mean_ratio, measure, scaled_jacobian

#: Elements below this mean ratio are called poor.
POOR = 0.02
# Of the mesh's size: nodes this near to each other are at one place.
_ONE_PLACE = 1e-9
# Sizes beyond, whose cubes no number holds, are nonsense in any unit.
_LARGEST = 1e50
# Scaled Jacobian of what is folded: that of a quarter-point element is 0.
_FOLDED = -1e-6
_SIZES = ("", "length", "area", "volume")


class Info:
    """What a mesh holds, from :func:`info`."""

    def __init__(self, data: Dict[str, Any]):
        self._data = data

    def to_dict(self) -> Dict[str, Any]:
        """Name, unit, whether there is a deck, counts, bounding box, elements by type with their measure and least mean
        ratio, groups, fields, instances of parts, warnings of the file. A size too large for a number is None."""
        return self._data

    def to_json(self) -> str:
        """The same as JSON."""
        return json.dumps(self._data, indent=1)

    def to_text(self) -> str:
        """The same to read, a line each."""
        d = self._data
        unit = f" ({d['unit']})" if d["unit"] else ""
        low, high = d["bounding_box"] or ((), ())
        lines = [
            f"{d['name']}: {_counted(d['nodes'], 'node')}, {_counted(d['elements'], 'element')}"
            + (", with the cards of a deck" if d["deck"] else ""),
            f"from {_numbers(low)} to {_numbers(high)}{unit}" if low else "no nodes",
        ]
        for cell_type, e in d["types"].items():
            size = f", {_SIZES[e['dimension']]} {_number(e['measure'], '.6g')}" if e["dimension"] else ""
            quality = f", mean ratio at least {_number(e['least_mean_ratio'], '.3g')}" if e["dimension"] > 1 else ""
            lines.append(f"  {e['count']:>9} {cell_type}{size}{quality}")
        lines.append(_counted(len(d["groups"]), "group") + (":" if d["groups"] else ""))
        for g in d["groups"]:
            size = "".join(f", {_SIZES[int(k)]} {_number(v, '.6g')}" for k, v in g["measure"].items())
            lines.append(f"  {g['name']}  {_counted(g['count'], g['kind'])}{size}")
        if d["fields"]:
            lines.append("fields: " + ", ".join(f"{f['name']} ({_counted(f['steps'], 'step')})" for f in d["fields"]))
        if d["instances"]:
            lines.append("instances: " + ", ".join(f"{i['name']} of {i['part']}" for i in d["instances"] if i["part"]))
        return "\n".join(lines + [f"warning: {w}" for w in d["warnings"]])


def info(mesh: Mesh) -> Info:
    """What a mesh holds: counts, sizes, quality, groups, fields. Groups of elements have the length, area and volume of
    their members by dimension, in the mesh's unit.

    Raises TypeError when `mesh` is no :class:`Mesh`.
    """
    check_mesh(mesh)
    sizes, quality = measure(mesh), mean_ratio(mesh)
    types = {
        name: {
            "count": len(ids),
            "dimension": CELL_TYPES[name][0],
            "measure": _sum(sizes[name]),
            "least_mean_ratio": _finite(quality[name].min(initial=1.0)),
        }
        for name, ids in mesh.cell_ids.items()
    }
    points = mesh.points
    box = [points.min(0).tolist(), points.max(0).tolist()] if len(points) else None
    return Info(
        {
            "name": mesh.name,
            "unit": mesh.unit,
            "deck": mesh.has_deck,
            "nodes": mesh.node_count,
            "elements": mesh.cell_count,
            "bounding_box": box,
            "types": types,
            "groups": [_group(mesh, sizes, g) for g in mesh.groups.all()],
            "fields": [{"name": f.name, "components": list(f.components), "steps": len(f.steps)} for f in mesh.fields],
            "instances": [{"name": i.name, "part": i.part, "offset": i.offset} for i in mesh.instances],
            "warnings": list(mesh.input_warnings),
        }
    )


def _group(mesh, sizes, group):
    ids, total = group.ids, {}
    if group.kind == "element":
        for name, numbers in mesh.cell_ids.items():
            dimension = CELL_TYPES[name][0]
            own = sizes[name][np.isin(numbers, ids)]
            if dimension and len(own):
                total.setdefault(str(dimension), []).append(own)
    sums = {dimension: _sum(np.concatenate(own)) for dimension, own in total.items()}
    return {"name": group.name, "kind": group.kind, "count": len(ids), "measure": sums}


def _sum(values):
    with np.errstate(over="ignore", invalid="ignore"):
        return _finite(values.sum())


def _finite(value):
    """For JSON, which has no infinity."""
    return float(value) if np.isfinite(value) else None


def _number(value, form):
    return "unknown (too large)" if value is None else format(value, form)


class Finding(NamedTuple):
    """Something odd in a mesh, from :func:`check`."""

    #: "error": solvers will refuse it or compute nonsense; "warning": look at it; "note": often meant so.
    level: str
    text: str
    #: "node", "element" or "group": what `members` are.
    kind: str
    #: Node or element numbers, or names of groups, all of them.
    members: Tuple


def check(mesh: Mesh) -> List[Finding]:
    """What is odd in a mesh, the worst first: flat, inverted, folded and poor elements, elements on the same nodes,
    segments without a length, nodes at one place or of no element, several pieces, empty groups. Where coordinates are
    larger than 1e50, or the mesh smaller than 1e-50, only that is told.

    Nothing is changed, and an empty list is no proof that a solver will take the mesh. Raises TypeError when `mesh` is
    no :class:`Mesh`.
    """
    check_mesh(mesh)
    found = []
    try:
        mesh.validate()
    except Error as error:
        return [Finding("error", str(error), "element", ())]
    points = mesh.points
    far = mesh.node_ids[(np.abs(points) > _LARGEST).any(axis=1)].tolist()
    if far:
        _add(found, "error", "node", far, f"farther than {_LARGEST:g} from the origin, where nothing can be computed")
        return found
    size = np.ptp(points, axis=0).max() if len(points) else 0.0
    if 0 < size < 1 / _LARGEST:
        text = f"the mesh measures {size:.3g}, which is too small for anything to be computed"
        return [Finding("error", text, "element", ())]
    quality, folded = mean_ratio(mesh), scaled_jacobian(mesh)
    flat, crossing, bent, poor, short = [], [], [], [], []
    for name, ids in mesh.cell_ids.items():
        if CELL_TYPES[name][0] == 1:
            ends = points[mesh.cells[name][:, :2]]
            length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
            short += ids[length <= _ONE_PLACE * size].tolist()
        if CELL_TYPES[name][0] < 2:
            continue
        q, j = quality[name], folded[name]
        crosses = (q < 0) & name.startswith("quad")
        crossing += ids[crosses].tolist()
        flat += ids[(q <= 0) & ~crosses].tolist()
        bent += ids[(q > 0) & (j < _FOLDED)].tolist()
        poor += ids[(q > 0) & (j >= _FOLDED) & (q < POOR)].tolist()
    _add(found, "error", "element", flat, "flat or inverted")
    _add(found, "error", "element", crossing, "crossing itself" if len(crossing) == 1 else "crossing themselves")
    _add(found, "warning", "element", short, "of no length, as only springs and such can be")
    _add(found, "warning", "element", bent, "folded at a corner")
    _add(found, "warning", "element", poor, f"poor, with a mean ratio below {POOR}")
    _add(found, "warning", "element", _doubled_elements(mesh), "on the nodes of another one")
    _add(found, "note", "node", _at_one_place(mesh), "at the place of another one, as at the lips of a crack")
    _add(found, "note", "node", _unused(mesh), "of no element")
    parts = pieces(mesh)
    if len(parts) > 1:
        smallest = f", the smallest of {_counted(len(parts[-1].elements), 'element')}"
        found.append(Finding("note", f"the mesh is in {len(parts)} pieces{smallest}", "element", ()))
    empty = [g.name for g in mesh.groups.all() if not len(g)]
    if empty:
        found.append(Finding("note", "empty groups: " + ", ".join(empty), "group", tuple(empty)))
    return found


def _add(found, level, kind, numbers, what):
    if numbers:
        listed = ", ".join(map(str, numbers[:5])) + (", ..." if len(numbers) > 5 else "")
        verb = "is" if len(numbers) == 1 else "are"
        found.append(Finding(level, f"{_counted(len(numbers), kind)} {verb} {what}: {listed}", kind, tuple(numbers)))


def _doubled_elements(mesh):
    """Numbers of all but the first element on the same corners, by dimension."""
    out = []
    for name, nodes in mesh.cells.items():
        corners = np.sort(nodes[:, : CELL_TYPES[name][2]], axis=1)
        _, first = np.unique(corners, axis=0, return_index=True)
        again = np.ones(len(corners), bool)
        again[first] = False
        out += mesh.cell_ids[name][again].tolist()
    return out


def _at_one_place(mesh):
    """Numbers of the nodes that lie where a node before them lies."""
    points = mesh.points
    if not len(points):
        return []
    size = np.ptp(points, axis=0).max() or 1.0
    order = np.argsort(points @ (0.57, 0.61, 0.55), kind="stable")
    near, again = _ONE_PLACE * size, np.zeros(len(points), bool)
    along = (points @ (0.57, 0.61, 0.55))[order]
    step, left = 1, np.arange(len(order) - 1)
    while len(left):  # neighbours along a line, then those two further on, ...
        left = left[(left + step < len(order))]
        left = left[along[left + step] - along[left] <= 2 * near]
        a, b = order[left], order[left + step]
        same = np.linalg.norm(points[a] - points[b], axis=1) <= near
        again[np.maximum(a[same], b[same])] = True
        step += 1
    return mesh.node_ids[again].tolist()


def _unused(mesh):
    used = np.zeros(mesh.node_count, bool)
    for nodes in mesh.cells.values():
        used[nodes.ravel()] = True
    return mesh.node_ids[~used].tolist()


def _counted(number, what):
    return f"{number} {what}{'' if number == 1 else 's'}"


def _numbers(values):
    return "(" + ", ".join(f"{v:.6g}" for v in values) + ")"
