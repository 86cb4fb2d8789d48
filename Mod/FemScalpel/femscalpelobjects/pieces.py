# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a part falls into when an operator parts it, and what holds each piece.

Knows nothing of FreeCAD but what find_supports() is given.
"""

from dataclasses import dataclass
from typing import Dict, List, Optional, Tuple

import numpy as np

import femscalpel

# Constraints that can keep a piece from moving freely: FreeCAD's types, or those of their proxies.
_SUPPORTS = {
    "Fem::ConstraintFixed",
    "Fem::ConstraintDisplacement",
    "Fem::ConstraintSpring",
    "Fem::ConstraintRigidBody",
    "Fem::ConstraintContact",
    "Fem::ConstraintTie",
}
# Directions of a displacement constraint.
_MOTIONS = ("x", "y", "z", "rotx", "roty", "rotz")
# Pieces and groups that are named; the rest are counted.
_MOST_PIECES = 4
_MOST_NAMES = 5


@dataclass(frozen=True, eq=False)
class Part:
    """One piece."""

    share: float  #: of length, area or volume; 0 where its elements are of a lower dimension than others
    dimension: int  #: of its largest elements
    elements: int  #: how many
    axis: int  #: along which the pieces lie one behind the other: 0, 1, 2; -1 where they do not
    side: int  #: -1 the first along it, 1 the last, 0 between
    nodes: np.ndarray  #: numbers, ascending
    groups: Tuple[str, ...]  #: of the source that it has something of


@dataclass(frozen=True, eq=False)
class Parting:
    """More pieces than there were."""

    before: int  #: how many the source has
    parts: List[Part]  #: the largest first
    dimension: int  #: of the largest elements


def parting_of(mesh, before, changed=None, gone=(), known=None):
    """The Parting of a mesh, or of what it becomes by `changed` and `gone` (see femscalpel.pieces), whose source had
    `before` pieces; None when there are no more now. `known`: (name, kind) of the groups that are named; all when not
    given."""
    found = femscalpel.pieces(mesh, changed, gone)
    if len(found) <= before:
        return None
    dimension = found[0].dimension
    total = sum(piece.measure for piece in found if piece.dimension == dimension) or 1.0
    axis, middle, width = _lie_along(mesh, found)
    parts = []
    for piece in found:
        share = piece.measure / total if piece.dimension == dimension else 0.0
        offset = piece.place[axis] - middle if axis >= 0 else 0.0
        side = 0 if len(found) > 2 and abs(offset) < 0.3 * width else int(np.sign(offset))
        groups = dict.fromkeys(name for name, kind in piece.groups if known is None or (name, kind) in known)
        parts.append(Part(share, piece.dimension, len(piece.elements), axis, side, piece.nodes, tuple(groups)))
    return Parting(before, parts, dimension)


def _lie_along(mesh, found):
    """(axis along which the pieces' centres are farthest apart, the middle between the outermost, their distance);
    axis -1 where they are no farther apart than a twentieth of the mesh."""
    places = np.array([piece.place for piece in found])
    spread = np.ptp(places, axis=0)
    axis = int(np.argmax(spread))
    if spread[axis] <= 0.05 * np.linalg.norm(np.ptp(mesh.points, axis=0)):
        return -1, 0.0, 0.0
    return axis, (places[:, axis].min() + places[:, axis].max()) / 2, spread[axis]


# --- what holds them


def find_supports(obj) -> Optional[Dict[str, np.ndarray]]:
    """{label: numbers of the nodes} of the constraints that can hold something, in the analysis that has the mesh
    object `obj`, one that is made from it, or one that it is made from; None without an analysis."""
    mesh = obj
    while mesh is not None:
        for user in mesh.InListRecursive:
            if user.isDerivedFrom("Fem::FemAnalysis"):
                return _supports_of(user, obj.FemMesh)
        mesh = getattr(mesh, "Source", None)
    return None


def _supports_of(analysis, femmesh):
    found = {}
    for member in analysis.Group:
        kind = getattr(getattr(member, "Proxy", None), "Type", "") or member.TypeId
        if kind not in _SUPPORTS or getattr(member, "Suppressed", False) or not _restrains(member):
            continue
        try:
            nodes = _nodes_of(member, femmesh)
        except Exception:  # FreeCAD says what is wrong with a reference when it solves
            continue
        found[member.Label] = np.unique(np.fromiter(nodes, np.int64, len(nodes)))
    return found


def _restrains(member):
    """False for a displacement constraint that leaves all directions free."""
    if not member.isDerivedFrom("Fem::ConstraintDisplacement"):
        return True
    return any(getattr(member, name + "Fix", False) or not getattr(member, name + "Free", True) for name in _MOTIONS)


def _nodes_of(member, femmesh):
    """Numbers of the nodes that FreeCAD's solver writers find for a constraint: those of its group, or by geometry."""
    from .geometry import element_of

    for group in femmesh.Groups:
        if femmesh.getGroupName(group).startswith(member.Name + "_") and (femmesh.getGroupElementType(group) == "Node"):
            return list(femmesh.getGroupElements(group))
    nodes = set()
    for part, names in member.References:
        for name in names:
            shape = element_of(part, name)
            nodes.update(getattr(femmesh, "getNodesBy" + shape.ShapeType)(shape))
    return list(nodes)


def holders(parting, supports) -> Optional[List[List[str]]]:
    """For each piece the labels of the `supports` that act on nodes of it; None without an analysis."""
    if supports is None:
        return None
    return [[label for label, nodes in supports.items() if np.isin(nodes, part.nodes).any()] for part in parting.parts]


def is_unsafe(held):
    """Whether something may fly off, as far as is known: `held` as holders() gives it."""
    return held is None or not all(held)


# --- in words


def as_given(context, text):
    """In place of FreeCAD's translate(): English."""
    return text


def sentence_of(parting, held, translate=as_given):
    """What the part falls into, and what holds the pieces, as sentences."""
    items = items_of(parting, held, translate)
    if len(items) > 1:
        last = translate("FemScalpel", "%1 and %2").replace("%2", items[-1]).replace("%1", items[-2])
        items = [*items[:-2], last]
    if parting.before > 1:
        text = translate("FemScalpel", "The mesh has %1 pieces now, %3 before: %2.")
    else:
        text = translate("FemScalpel", "The part falls into %1 pieces: %2.")
    text = text.replace("%1", str(len(parting.parts))).replace("%3", str(parting.before))
    text = text.replace("%2", ", ".join(items))
    if held is not None and not all(held):
        text += " " + translate(
            "FemScalpel", "What nothing holds has no solution: hold it, or let the tool end inside the part."
        )
    return text


def items_of(parting, held, translate=as_given):
    """A text for each piece, such as "61 % of the volume (right, +x; held by FIXED)"; for many small ones, one
    together."""
    count = len(parting.parts)
    shown = count if count <= _MOST_PIECES + 1 else _MOST_PIECES
    items = []
    for number, part in enumerate(parting.parts[:shown]):
        facts = [_place(part, translate), _held(part, None if held is None else held[number], translate)]
        items.append(f"{_size(part, parting.dimension, translate)} ({'; '.join(fact for fact in facts if fact)})")
    if shown < count:
        loose = 0 if held is None else sum(not labels for labels in held[shown:])
        text = translate("FemScalpel", "%1 smaller ones").replace("%1", str(count - shown))
        if loose:
            text += " (" + translate("FemScalpel", "nothing holds %1 of them").replace("%1", str(loose)) + ")"
        items.append(text)
    return items


def _size(part, dimension, translate):
    if part.dimension < dimension:
        text = (
            translate("FemScalpel", "%1 shell elements")
            if part.dimension == 2
            else translate("FemScalpel", "%1 beam elements")
        )
        return text.replace("%1", str(part.elements))
    text = {
        3: translate("FemScalpel", "%1 % of the volume"),
        2: translate("FemScalpel", "%1 % of the area"),
        1: translate("FemScalpel", "%1 % of the length"),
    }[dimension]
    percent = 100 * part.share
    number = "< 1" if percent < 0.5 else "> 99" if percent >= 99.5 else f"{percent:.0f}"
    return text.replace("%1", number)


def _place(part, translate):
    return {
        (0, -1): translate("FemScalpel", "left, -x"),
        (0, 1): translate("FemScalpel", "right, +x"),
        (1, -1): translate("FemScalpel", "front, -y"),
        (1, 1): translate("FemScalpel", "back, +y"),
        (2, -1): translate("FemScalpel", "bottom, -z"),
        (2, 1): translate("FemScalpel", "top, +z"),
    }.get((part.axis, part.side), translate("FemScalpel", "middle") if part.axis >= 0 else "")


def _held(part, labels, translate):
    if labels is None:
        if not part.groups:
            return translate("FemScalpel", "in no group")
        return translate("FemScalpel", "with groups %1").replace("%1", _names(part.groups, translate))
    if not labels:
        return translate("FemScalpel", "nothing holds it")
    return translate("FemScalpel", "held by %1").replace("%1", _names(labels, translate))


def _names(names, translate):
    listed, more = ", ".join(names[:_MOST_NAMES]), len(names) - _MOST_NAMES
    if more <= 0:
        return listed
    return translate("FemScalpel", "%1 and %2 more").replace("%2", str(more)).replace("%1", listed)
