# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields: values on the nodes and elements of a mesh."""

from collections.abc import Iterable
from typing import List, NamedTuple, Optional, Tuple

import numpy as np

from . import _arguments, _engine

SUPPORTS = ("node", "element", "element nodes", "element points")


class Localization(NamedTuple):
    """Where the integration points of an element type are, in coordinates of a reference element."""

    name: str
    #: Element type, as in :attr:`Mesh.cells`.
    cell_type: str
    #: Nodes of the reference element, in the order of :attr:`Mesh.cells`: (nodes, dimension).
    element: np.ndarray
    #: (points, dimension)
    points: np.ndarray
    #: (points,)
    weights: np.ndarray


class FieldPart(NamedTuple):
    """Values of one time step on nodes, or on elements of one type."""

    #: "node", "element", "element nodes" (one value per node of each element, in the order of :attr:`Mesh.cells`) or
    #: "element points" (one per integration point).
    support: str
    #: Element type, as in :attr:`Mesh.cells`; empty for nodes.
    cell_type: str
    #: Numbers of the nodes or elements that have values: (n,).
    ids: np.ndarray
    #: (n, components), for "element nodes" and "element points" (n, points, components); float64 or int64.
    values: np.ndarray
    #: Of "element points"; None where the file does not say where they are.
    localization: Optional[Localization] = None
    #: What the file calls the choice of `ids`; empty if all have values.
    profile: str = ""


class FieldStep(NamedTuple):
    """A field at one time."""

    #: Number of the time step; -1: none.
    number: int
    #: -1: none.
    iteration: int
    time: float
    parts: Tuple[FieldPart, ...]


class Field(NamedTuple):
    """Values on a mesh, at one or several times, from :attr:`Mesh.fields`. Read-only views on the mesh's own memory."""

    name: str
    components: Tuple[str, ...]
    #: One for each component; may be empty.
    units: Tuple[str, ...]
    steps: Tuple[FieldStep, ...]
    time_unit: str = ""
    #: What a file stores the values as: "float64", "float32", "int32" or "int64".
    dtype: str = "float64"


def fields_of(engine_mesh: "_engine.Mesh") -> Tuple[Field, ...]:
    """The fields of a mesh of the engine."""
    known = {}
    for name, cell_type, dimension, element, points, weights in engine_mesh.localizations():
        shape = (-1, dimension)
        known[name] = Localization(name, cell_type, element.reshape(shape), points.reshape(shape), weights)

    def part_of(support, cell_type, ids, values, localization, profile) -> FieldPart:
        where = known.get(localization)
        if where is None and localization:
            where = Localization(localization, cell_type, np.empty((0, 0)), np.empty((0, 0)), np.empty(0))
        return FieldPart(support, cell_type, ids, values, where, profile)

    out = []
    for name, components, units, time_unit, dtype, steps in engine_mesh.fields():
        all_steps = tuple(
            FieldStep(number, iteration, time, tuple(part_of(*part) for part in parts))
            for number, iteration, time, parts in steps
        )
        out.append(Field(name, tuple(components), tuple(units), all_steps, time_unit, dtype))
    return tuple(out)


def _part_entry(field: Field, part: FieldPart, localizations: dict) -> tuple:
    if not isinstance(part, FieldPart):
        raise _arguments.about(
            "fields", TypeError(f"parts of field {field.name!r} must be FieldPart, not {_arguments.describe(part)}")
        )
    ids = _arguments.integers(part.ids, "fields")
    values = np.asarray(part.values)
    per_point = 3 if part.support in ("element nodes", "element points") else 2
    if values.ndim != per_point or len(values) != len(ids) or values.shape[-1] != len(field.components):
        raise _arguments.about(
            "fields",
            ValueError(
                f"values of field {field.name!r} on {part.support!r} must have the shape (ids, "
                f"{'points, ' if per_point == 3 else ''}components), not {values.shape}"
            ),
        )
    whole = field.dtype.startswith("int")
    if values.dtype.kind not in ("iu" if whole else "fiu"):
        raise _arguments.about(
            "fields", TypeError(f"values of field {field.name!r} must be {field.dtype}, not {values.dtype}")
        )
    name = ""
    if part.localization is not None:
        where = part.localization
        name = where.name
        element, points, weights = (np.asarray(a, float) for a in where[2:])
        if len(weights):
            entry = (where.name, where.cell_type, points.shape[-1], element, points, weights)
            other = localizations.setdefault(name, entry)
            if other[1] != entry[1] or any(not np.array_equal(a, b) for a, b in zip(other[3:], entry[3:])):
                raise _arguments.about("fields", ValueError(f"there are two localizations {name!r}"))
    points = values.shape[1] if per_point == 3 else 1
    return part.support, part.cell_type, ids, points, values, name, part.profile


def set_fields(engine_mesh: "_engine.Mesh", fields: Iterable[Field]) -> None:
    """Gives a mesh of the engine other fields; errors as of :attr:`Mesh.fields`."""
    localizations: dict = {}
    entries: List[tuple] = []
    for field in fields:
        if not isinstance(field, Field):
            raise _arguments.about("fields", TypeError(f"fields must be Field, not {_arguments.describe(field)}"))
        steps = [
            (s.number, s.iteration, float(s.time), [_part_entry(field, p, localizations) for p in s.parts])
            for s in field.steps
        ]
        entries.append((field.name, list(field.components), list(field.units), field.time_unit, field.dtype, steps))
    engine_mesh.set_fields(entries, list(localizations.values()))
