# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes and their groups."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Dict, List, NamedTuple, Optional, Tuple, Union

import numpy as np

from . import _arguments, _engine
from .fields import Field, fields_of, set_fields

KINDS = ("node", "element", "facet")

#: Element types by meshio's name: (dimension, nodes, corner nodes). Node order is meshio's and VTK's.
CELL_TYPES: Dict[str, Tuple[int, int, int]] = _engine.cell_types()


def _check_kind(kind: str, name: str = "kind") -> str:
    if not isinstance(kind, str) or kind not in KINDS:
        raise _arguments.about(
            name, ValueError(f"{name} must be one of {', '.join(map(repr, KINDS))}, not {_arguments.describe(kind)}")
        )
    return kind


class Group:
    """A named set of nodes, elements or facets of one mesh.

    A group is a handle: it finds its members in the mesh whenever it is asked, and raises
    :class:`femscalpel.Error` once the mesh has no such group any more.
    """

    __slots__ = ("_mesh", "_name", "_kind")

    def __init__(self, mesh: "_engine.Mesh", name: str, kind: str):
        self._mesh = mesh
        self._name = name
        self._kind = kind

    @property
    def name(self) -> str:
        """Name, unique among the groups of the same kind."""
        return self._name

    @property
    def kind(self) -> str:
        """ "node", "element" (of any dimension, also mixed) or "facet"."""
        return self._kind

    @property
    def ids(self) -> np.ndarray:
        """Members, int64, in mesh order; a new array that is yours.

        Node or element numbers, shape (n,). For a facet group shape (n, 2): element number and local face
        number as in CalculiX, from 1. Takes one pass over the mesh.
        """
        return self._mesh.group_ids(self._name, self._kind)

    def __len__(self) -> int:
        return len(self.ids)

    def __repr__(self) -> str:
        n = len(self)
        return f"<Group {self._name!r}: {n} {self._kind}{'' if n == 1 else 's'}>"


class Groups(Mapping):
    """The groups of a mesh by name, as ``mesh.groups``.

    A name is unique within a kind only: a node group and an element group may both be called "FIX".
    ``groups["FIX"]`` is the first of them, ``groups["FIX", "node"]`` the one of that kind. Iterating
    gives every name once; :meth:`all` gives every group.
    """

    __slots__ = ("_mesh",)

    def __init__(self, mesh: "_engine.Mesh"):
        self._mesh = mesh

    def __getitem__(self, key: Union[str, Tuple[str, str]]) -> Group:
        name, kind = key if isinstance(key, tuple) and len(key) == 2 else (key, None)
        for group_name, group_kind in self._mesh.groups():
            if group_name == name and kind in (None, group_kind):
                return Group(self._mesh, group_name, group_kind)
        raise KeyError(key)

    def __iter__(self) -> Iterator[str]:
        return iter(dict.fromkeys(name for name, _ in self._mesh.groups()))

    def __len__(self) -> int:
        return len({name for name, _ in self._mesh.groups()})

    def all(self, kind: Optional[str] = None) -> Tuple[Group, ...]:
        """Every group, or every group of one kind, in the mesh's order."""
        if kind is not None:
            _check_kind(kind)
        return tuple(Group(self._mesh, n, k) for n, k in self._mesh.groups() if kind in (None, k))

    def __repr__(self) -> str:
        return "<Groups " + ", ".join(f"{name!r} ({kind})" for name, kind in self._mesh.groups()) + ">"


def _group_entries(groups) -> list:
    """`groups` of Mesh() as a list of (name, kind, ids)."""
    if isinstance(groups, Mapping):
        groups = [(name, *members) for name, members in groups.items()]
    out = []
    for entry in groups:
        if isinstance(entry, Group):
            entry = (entry.name, entry.kind, entry.ids)
        if not isinstance(entry, (tuple, list)) or len(entry) != 3:
            raise _arguments.about(
                "groups",
                TypeError(
                    "groups must be {name: (kind, ids)} or a list of (name, kind, ids), "
                    f"not contain {_arguments.describe(entry)}"
                ),
            )
        name, kind, ids = entry
        _arguments.text(name, "groups: name")
        out.append(
            (name, _check_kind(kind, f"groups[{name!r}]: kind"), _arguments.integers(ids, f"groups[{name!r}]: ids"))
        )
    return out


class ElementaryGroup(NamedTuple):
    """Entities that belong to exactly the same groups, from :meth:`Mesh.elementary_groups`."""

    #: "node", "element" or "facet".
    kind: str
    #: Of the entities: 0 for nodes, 0 to 3 for elements, 1 (edge) or 2 (face) for facets.
    dimension: int
    #: Names of the groups, all of this kind, in the mesh's order.
    groups: Tuple[str, ...]
    #: Members as in :attr:`Group.ids`, in mesh order.
    ids: np.ndarray


class Instance(NamedTuple):
    """How an instance of a part is numbered in a mesh read from a deck of parts (Abaqus/CAE), from
    :attr:`Mesh.instances`."""

    #: As in the deck; empty for what the assembly itself has (reference points).
    name: str
    #: Name of the part; empty for the assembly.
    part: str
    #: Number in the mesh less number in the part, of nodes and of elements alike: node 17 of the instance is
    #: ``17 + offset``.
    offset: int
    #: First and last node number in the mesh as it was read; (0, 0) without nodes.
    nodes: Tuple[int, int]
    #: First and last element number in the mesh as it was read; (0, 0) without elements.
    elements: Tuple[int, int]


class Mesh:
    """A finite-element mesh with numbers and groups.

    Nodes and elements are given once, here or by :func:`femscalpel.read`, and never change afterwards; an
    operator makes a new mesh. Arrays handed out are read-only views on the mesh's own memory (no copy) and
    keep the mesh alive. Groups, name and unit can be changed; do not change them while another thread
    works on the mesh.

    Parameters
    ----------
    points : (n, 3) array of float
        Node coordinates. Copied, like every array here.
    cells : dict of str to (m, k) array of int
        Nodes of the elements by type, as indices into `points`. Types and node order are meshio's:
        "tetra", "triangle6", "line", ...
    node_ids : (n,) array of int, optional
        Node numbers, positive and unique; 1 to n by default.
    cell_ids : dict of str to (m,) array of int, optional
        Element numbers by type, positive and unique in the mesh; by default consecutive from 1 over all
        types in the order of `cells`.
    groups : dict of str to (kind, ids), or iterable of (name, kind, ids), optional
        See :meth:`add_group`. The second form allows one name for groups of different kinds.
    name : str, optional

    Raises
    ------
    TypeError, ValueError
        An argument of the wrong type or shape, named in the message.
    femscalpel.Error
        A coordinate that is not finite, a number used twice, a node index out of range, an unknown element
        type, a group member the mesh does not have.

    Examples
    --------
    >>> mesh = Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], {"tetra": [[0, 1, 2, 3]]},
    ...             groups={"FIX": ("node", [1, 2, 3])})
    """

    __slots__ = ("_engine_mesh", "__weakref__")

    def __init__(self, points, cells, node_ids=None, cell_ids=None, groups=(), name: str = "mesh"):
        points = _arguments.coordinates(points, "points")
        if points.size == 0:
            points = points.reshape(0, 3)
        if points.ndim != 2 or points.shape[1] != 3:
            raise _arguments.about("points", ValueError(f"points must have the shape (n, 3), not {points.shape}"))
        if node_ids is None:
            node_ids = np.arange(1, len(points) + 1)
        node_ids = _arguments.integers(node_ids, "node_ids")
        if node_ids.shape != (len(points),):
            raise _arguments.about(
                "node_ids",
                ValueError(
                    f"node_ids must have the shape ({len(points)},), one number per point, not {node_ids.shape}"
                ),
            )
        if not isinstance(cells, Mapping):
            raise _arguments.about(
                "cells", TypeError(f"cells must be a dict of element type to array, not {_arguments.describe(cells)}")
            )
        if cell_ids is not None and not isinstance(cell_ids, Mapping):
            raise _arguments.about(
                "cell_ids",
                TypeError(f"cell_ids must be a dict of element type to array, not {_arguments.describe(cell_ids)}"),
            )
        blocks = []
        next_id = 1
        for cell_type, nodes in cells.items():
            if cell_type not in CELL_TYPES:
                raise _engine.Error(f"unknown element type {cell_type!r} in cells; known are {', '.join(CELL_TYPES)}")
            where = f"[{cell_type!r}]"
            nodes = _arguments.integers(nodes, "cells" + where)
            width = CELL_TYPES[cell_type][1]
            if nodes.size == 0:
                nodes = nodes.reshape(0, width)
            if nodes.ndim != 2 or nodes.shape[1] != width:
                raise _arguments.about(
                    "cells", ValueError(f"cells{where} must have the shape (m, {width}), not {nodes.shape}")
                )
            if cell_ids is None:
                ids = np.arange(next_id, next_id + len(nodes))
                next_id += len(nodes)
            elif cell_type in cell_ids:
                ids = _arguments.integers(cell_ids[cell_type], "cell_ids" + where)
            elif len(nodes) == 0:
                ids = np.empty(0, np.int64)
            else:
                raise _arguments.about(
                    "cell_ids", ValueError(f"cell_ids must have an entry {cell_type!r}, as cells has")
                )
            if ids.shape != (len(nodes),):
                raise _arguments.about(
                    "cell_ids",
                    ValueError(
                        f"cell_ids{where} must have the shape ({len(nodes)},), one number per element, not {ids.shape}"
                    ),
                )
            blocks.append((cell_type, nodes, ids))
        if cell_ids is not None:
            for cell_type in cell_ids:
                if cell_type not in cells:
                    raise _arguments.about(
                        "cell_ids", ValueError(f"cell_ids has an entry {cell_type!r} that cells has not")
                    )
        engine_mesh = _engine.Mesh(points, node_ids, blocks, _group_entries(groups))
        engine_mesh.name = _arguments.text(name, "name")
        self._engine_mesh = engine_mesh

    @classmethod
    def _wrap(cls, engine_mesh: "_engine.Mesh") -> "Mesh":
        mesh = cls.__new__(cls)
        mesh._engine_mesh = engine_mesh
        return mesh

    @property
    def points(self) -> np.ndarray:
        """Node coordinates: (n, 3) float64, read-only view."""
        return self._engine_mesh.points

    def _move_nodes(self, points):
        """Puts all nodes where (n, 3) float64 says. Checks nothing: for differences in the last digits."""
        self._engine_mesh.move_nodes(points)

    @property
    def node_ids(self) -> np.ndarray:
        """Node numbers: (n,) int64, read-only view."""
        return self._engine_mesh.node_ids

    @property
    def cells(self) -> Dict[str, np.ndarray]:
        """Nodes of the elements by type, for the types the mesh has: (m, k) int64 indices into points, read-only
        views."""
        return self._engine_mesh.cells

    @property
    def cell_ids(self) -> Dict[str, np.ndarray]:
        """Element numbers by type, unique in the mesh: (m,) int64, read-only views."""
        return self._engine_mesh.cell_ids

    @property
    def groups(self) -> Groups:
        """The groups by name; see :class:`Groups`. Bookkeeping groups of a file format are not shown."""
        return Groups(self._engine_mesh)

    @property
    def fields(self) -> Tuple[Field, ...]:
        """Values on nodes and elements, as a .med file has them; see :class:`Field`. Operators carry them over
        (`Result.report.fields` says what was kept and what made), and :func:`femscalpel.write` writes them to .med.

        Can be set to other fields. Raises :class:`femscalpel.Error`, TypeError or ValueError, and changes nothing, when
        they do not fit the mesh.
        """
        return fields_of(self._engine_mesh)

    @fields.setter
    def fields(self, value: Iterable):
        set_fields(self._engine_mesh, value)

    @property
    def instances(self) -> Tuple[Instance, ...]:
        """The instances of parts the mesh was read from, with their numbers, in the deck's order; see
        :class:`Instance`. Empty for other files."""
        return tuple(Instance(*entry) for entry in self._engine_mesh.instances())

    @property
    def input_warnings(self) -> Tuple[str, ...]:
        """What was odd in the file the mesh was read from, had to be written out, or was not read, with file and
        line."""
        return tuple(self._engine_mesh.input_warnings())

    @property
    def has_deck(self) -> bool:
        """Whether the mesh carries the cards of the CalculiX or Abaqus input file it was read from;
        :func:`femscalpel.write` writes them to .inp."""
        return self._engine_mesh.has_solver_input

    @property
    def deck_places(self) -> List[List[Tuple[int, int, str, bool]]]:
        """Where the lines of each card of the deck come from, which messages name: first line, number of lines, file,
        and whether an operator made them of that place; empty without a deck.

        A deck of parts or with included files has other lines once it is written; set to the mesh read from there,
        messages about it name the user's files again. Cards that do not have so many lines stay as they are."""
        return self._engine_mesh.deck_places()

    @deck_places.setter
    def deck_places(self, value: List[List[Tuple[int, int, str, bool]]]):
        self._engine_mesh.set_deck_places([[tuple(lines) for lines in card] for card in value])

    @property
    def dimension(self) -> int:
        """Largest dimension of any element, 0 to 3; -1 without elements."""
        return self._engine_mesh.dimension

    @property
    def node_count(self) -> int:
        """Number of nodes."""
        return self._engine_mesh.node_count

    @property
    def cell_count(self) -> int:
        """Number of elements of all types."""
        return self._engine_mesh.cell_count

    @property
    def name(self) -> str:
        """Name of the mesh, as MED files state it."""
        return self._engine_mesh.name

    @name.setter
    def name(self, value: str):
        self._engine_mesh.name = _arguments.text(value, "name")

    @property
    def unit(self) -> str:
        """Unit of the coordinates as the file states it; may be empty."""
        return self._engine_mesh.unit

    @unit.setter
    def unit(self, value: str):
        self._engine_mesh.unit = _arguments.text(value, "unit")

    def add_group(self, name: str, kind: str, ids: Iterable = ()) -> Group:
        """Adds a group and returns it.

        `kind` is "node", "element" or "facet"; `ids` are node numbers, element numbers, or for facets an
        (n, 2) array of element number and local face number as in CalculiX, from 1. Repeats count once.

        Raises :class:`femscalpel.Error`, and adds nothing, when a group of that name and kind exists or the
        mesh has no such node, element or face.
        """
        _arguments.text(name, "name")
        self._engine_mesh.add_group(name, _check_kind(kind), _arguments.integers(ids, "ids"))
        return Group(self._engine_mesh, name, kind)

    def remove_group(self, name: str, kind: Optional[str] = None) -> None:
        """Removes a group; its nodes and elements stay. Raises KeyError when there is none."""
        group = self._find(name, kind)
        self._engine_mesh.remove_group(group.name, group.kind)

    def rename_group(self, old: str, new: str, kind: Optional[str] = None) -> Group:
        """Renames a group. In a deck that the mesh was read from the set keeps the name that cards name it by.

        Raises KeyError when there is none, :class:`femscalpel.Error` when `new` is taken.
        """
        group = self._find(old, kind)
        self._engine_mesh.rename_group(group.name, _arguments.text(new, "new"), group.kind)
        return Group(self._engine_mesh, new, group.kind)

    def _find(self, name: str, kind: Optional[str]) -> Group:
        return self.groups[name] if kind is None else self.groups[name, _check_kind(kind)]

    def elementary_groups(self) -> Tuple[ElementaryGroup, ...]:
        """The disjoint classes that the overlapping groups fall into, as a tuple of :class:`ElementaryGroup`.

        Every node, element and facet of a group is in exactly one of them; what is in no group is in none. Nodes
        come first, then elements of dimension 0 to 3, then facets. Linear time.

        See Also
        --------
        femscalpel.virtual_boundary : what of the mesh a group covers
        """
        return tuple(ElementaryGroup(*entry) for entry in _engine.elementary_groups(self._engine_mesh))

    def copy(self) -> "Mesh":
        """An independent copy."""
        return Mesh._wrap(self._engine_mesh.copy())

    def __copy__(self) -> "Mesh":
        return self.copy()

    def __deepcopy__(self, memo) -> "Mesh":
        return self.copy()

    def validate(self) -> None:
        """Checks numbers, connectivity, coordinates and groups; raises :class:`femscalpel.Error` at the first fault."""
        self._engine_mesh.validate()

    def __repr__(self) -> str:
        cells = ", ".join(f"{len(ids)} {cell_type}" for cell_type, ids in self.cell_ids.items()) or "no elements"
        groups = len(self._engine_mesh.groups())
        return f"<Mesh {self.name!r}: {self.node_count} nodes, {cells}, {groups} group{'' if groups == 1 else 's'}>"


def check_mesh(mesh, name: str = "mesh") -> "_engine.Mesh":
    """The engine's side of `mesh`; TypeError that names the parameter when it is something else."""
    if not isinstance(mesh, Mesh):
        raise _arguments.about(name, TypeError(f"{name} must be a femscalpel.Mesh, not {_arguments.describe(mesh)}"))
    return mesh._engine_mesh
