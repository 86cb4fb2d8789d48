# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes with what a FemMesh does not hold: a deck's cards, fields, groups of element faces, point elements, the
numbers of the file.

A mesh that was imported has its file in the document, whole. What FemScalpel makes of such a mesh is made of that, and
is exported with it: the cards of a deck come out again after a crack and a hole.
"""

import json
import os
import tempfile
from collections import Counter
from itertools import chain

import numpy as np

import femscalpel
from femscalpel.mesh import CELL_TYPES

from .group_names import names_of
from .memory import memory
from .ours import is_ours

#: The property of a mesh object that holds the file.
PROPERTY = "WholeMesh"
_PLACES = "WholeMeshPlaces"
_OUTPUT = 8
# Of the mesh's size: nodes that differ by less are where they were.
_SAME = 1e-9
# FreeCAD's words for groups of elements of a dimension.
_TYPES = {1: "Edge", 2: "Face", 3: "Volume"}
# Along which nodes are compared: the axes, and some that no model knows.
_DIRECTIONS = np.array([(1, 0, 0), (0, 1, 0), (0, 0, 1), (0.31, 0.59, 0.74), (-0.67, 0.36, 0.65)]).T


def keep(obj, mesh):
    """Puts a femscalpel.Mesh into the document, as the whole of the mesh that `obj` shows."""
    if PROPERTY not in obj.PropertiesList:
        text = "The file of the mesh, whole: with what FreeCAD's FemMesh cannot hold"
        obj.addProperty("App::PropertyFileIncluded", PROPERTY, "FEM Mesh", text, _OUTPUT)
        obj.setEditorMode(PROPERTY, 1)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, obj.Name + _ending(mesh))
        femscalpel.write(mesh, path)
        setattr(obj, PROPERTY, path)
    if mesh.has_deck:
        if _PLACES not in obj.PropertiesList:
            text = "Where the cards of the file were in the user's: what messages name"
            obj.addProperty("App::PropertyString", _PLACES, "FEM Mesh", text, _OUTPUT)
            obj.setEditorMode(_PLACES, 2)
        setattr(obj, _PLACES, json.dumps(mesh.deck_places))


def _ending(mesh):
    """Of the format that holds all of a mesh: decks their cards, .vtu groups of element faces, .med fields."""
    if mesh.has_deck:
        return ".inp"
    return ".vtu" if mesh.groups.all("facet") and not mesh.fields else ".med"


def whole_of(obj):
    """The whole femscalpel.Mesh of a mesh object, or None where nothing is known of it but its FemMesh, or that is
    another one by now: moved, changed by hand, or made of such a mesh.

    Of an object of FemScalpel it is made anew where it is not remembered. Raises femscalpel.Error.
    """
    if is_ours(obj):
        return _made_whole(obj)
    path = getattr(obj, PROPERTY, "")
    if not path:
        return None
    mesh = femscalpel.read(path)
    if mesh.has_deck and getattr(obj, _PLACES, ""):
        mesh.deck_places = json.loads(getattr(obj, _PLACES))
    for kind, old, new in names_of(obj):
        mesh.rename_group(old, new, kind)
    return mesh if is_shown(mesh, obj.FemMesh) and has_groups_of(mesh, obj.FemMesh) else None


def _made_whole(obj):
    """whole_of() of an object of FemScalpel."""
    proxy = obj.Proxy
    made = memory.of(obj.Document, proxy.shown.inputs) if proxy.shown is not None else None
    if made is not None and made.token == proxy.shown.token and made.whole is not None:
        return made.whole
    mesh = whole_of(obj.Source) if obj.Source is not None else None
    if mesh is None:
        return None
    tools = proxy.tools(obj)
    result, on_shape = proxy.result(obj, mesh, tools, proxy.where_nodes_may_move(obj, mesh, tools))
    points = on_shape.put_back(result.mesh, tools, proxy.meant_to_leave(result.report))
    if not np.array_equal(points, result.mesh.points) or not is_shown(result.mesh, obj.FemMesh):
        return None
    _take_places(result.mesh, obj.FemMesh)
    return result.mesh


def _take_places(mesh, femmesh):
    """Gives the nodes of a mesh that was made anew the places that are shown. FreeCAD saves those with all digits, but
    of a placement the axis and the angle, of which it makes a rotation that differs in the last one."""
    numbers, there = _nodes_of(femmesh)
    there = there[np.argsort(numbers)]
    if np.array_equal(mesh.points, there):
        return
    tolerance = _SAME * np.ptp(mesh.points, axis=0).max(initial=0.0)
    points = np.empty_like(there)
    # One by one; else in the order of a direction that no model knows, in which nodes of one place may be exchanged.
    along = _DIRECTIONS[:, -1]
    for ours, theirs in (
        (np.arange(len(there)),) * 2,
        (np.argsort(mesh.points @ along, kind="stable"), np.argsort(there @ along, kind="stable")),
    ):
        points[ours] = there[theirs]
        if (abs(points - mesh.points) <= tolerance).all():
            mesh._move_nodes(points)
            return


def is_shown(mesh, femmesh):
    """Whether a FemMesh is that of a femscalpel.Mesh: as many nodes, as many elements of the highest dimension, and the
    nodes in the same places. Not with the same numbers: FreeCAD gives new ones when it saves a document, and what is
    made anew of properties that were saved, with 16 digits, may count its nodes in another order."""
    elements = {3: femmesh.VolumeCount, 2: femmesh.FaceCount, 1: femmesh.EdgeCount}.get(mesh.dimension, 0)
    highest = [len(ids) for name, ids in mesh.cell_ids.items() if CELL_TYPES[name][0] == mesh.dimension]
    if mesh.node_count != femmesh.NodeCount or mesh.dimension and sum(highest) != elements:
        return False
    _, there = _nodes_of(femmesh)
    size = np.ptp(mesh.points, axis=0).max(initial=0.0)
    away = np.sort(mesh.points @ _DIRECTIONS, axis=0) - np.sort(there @ _DIRECTIONS, axis=0)
    return bool((abs(away) <= _SAME * size).all())


def has_groups_of(mesh, femmesh):
    """Whether a FemMesh has the groups of the femscalpel.Mesh it shows: as many members, and of nodes those in the same
    places."""
    there, members = Counter(), {}
    for index in femmesh.Groups:
        name, kind = femmesh.getGroupName(index), femmesh.getGroupElementType(index)
        numbers = femmesh.getGroupElements(index)
        there[name, kind] += len(numbers)
        if kind == "Node":
            members.setdefault(name, []).append(np.array(numbers, int))
    counts, places = Counter(), {}
    dimension_of, place_of = _table(_dimensions(mesh)), _table([(mesh.node_ids, mesh.points)])
    for group in mesh.groups.all():
        if group.kind == "node" and len(group):
            counts[group.name, "Node"] = len(group)
            places[group.name] = place_of(group.ids)
        elif group.kind == "element" and len(group):
            dimensions = np.bincount(dimension_of(group.ids), minlength=4)
            counts.update({(group.name, kind): int(dimensions[d]) for d, kind in _TYPES.items()})
    if +counts != +there:
        return False
    size = np.ptp(mesh.points, axis=0).max(initial=0.0)
    shown_at = _table([_nodes_of(femmesh)])
    for name, points in places.items():
        shown = shown_at(np.concatenate(members[name]))
        if (abs(shown.mean(axis=0) - points.mean(axis=0)) > _SAME * size).any():
            return False
    return True


def _nodes_of(femmesh):
    """Numbers and places of the nodes of a FemMesh."""
    nodes = femmesh.Nodes
    numbers = np.fromiter(nodes, int, len(nodes))
    return numbers, np.fromiter(chain.from_iterable(nodes.values()), float, 3 * len(nodes)).reshape(-1, 3)


def _dimensions(mesh):
    """Numbers of elements with their dimensions, for each type."""
    return [(ids, np.full(len(ids), CELL_TYPES[kind][0])) for kind, ids in mesh.cell_ids.items()]


def _table(parts):
    """A function from numbers to values; `parts` are (numbers, values) of all there are."""
    if not parts:
        return lambda numbers: np.empty(0, int)
    numbers, values = (np.concatenate(part) for part in zip(*parts))
    order = np.argsort(numbers, kind="stable")
    numbers, values = numbers[order], values[order]
    return lambda wanted: values[np.searchsorted(numbers, wanted)]


def left_behind(obj):
    """What to tell of something that is made of the FemMesh of a mesh object, where that was imported with more than a
    FemMesh holds; in a list, empty where there is nothing to tell."""
    if not is_more_lost(obj):
        return []
    return [
        f"{obj.Label} is not the mesh that was imported any more, as it was moved or changed: what its file held "
        f"beside nodes, elements and groups (a deck's cards, as materials and sections; fields; groups of element "
        f"faces) is left behind"
    ]


def is_more_lost(obj):
    """Whether a mesh object was imported, or made of meshes of which the first was, with more in the file than nodes,
    elements and groups of them. Raises femscalpel.Error."""
    while is_ours(obj) and obj.Source is not None:
        obj = obj.Source
    path = getattr(obj, PROPERTY, "")
    if not path:
        return False
    mesh = femscalpel.read(path)
    return mesh.has_deck or bool(mesh.fields) or bool(mesh.groups.all("facet")) or "vertex" in mesh.cells


def shortened(message, document):
    """A message of the engine without the folder where FreeCAD keeps the files of a document that is open."""
    folder = document.TransientDir
    return message.replace(folder + "/", "").replace(folder + os.sep, "") if folder else message
