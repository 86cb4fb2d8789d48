# SPDX-License-Identifier: LGPL-2.1-or-later
"""Renaming the groups of a mesh, in a way that can be undone.

FreeCAD does not put an old mesh back when a transaction is undone (see undo.py). So what was renamed is kept in a
property of the object, RenamedGroups, which does come back, and the names in the mesh follow it.
"""

from .analysis import transaction
from .ours import is_ours

_PROPERTY = "RenamedGroups"  # "node:FIX" -> "SUPPORT": kind and first name, and what it is called now
_OUTPUT = 8

# What the mesh of each object shows now, as the property says it; by document and object.
_shown = {}


def rename_group(obj, old, new, kind=None):
    """See ObjectsFemScalpel.renameGroup()."""
    if is_ours(obj):
        raise ValueError(
            f"'{obj.Label}' makes its groups anew with its mesh. Rename the group in the source mesh, or change "
            f"GroupName"
        )
    if not new.strip():
        raise ValueError("the new name is empty")
    present = [(_kind(obj.FemMesh, g), obj.FemMesh.getGroupName(g)) for g in obj.FemMesh.Groups]
    kinds = [k for k, name in present if name == old and kind in (None, k)]
    if not kinds:
        raise ValueError(f"the mesh has no group '{old}'")
    kind = kinds[0]
    if (kind, new) in present:
        raise ValueError(f"the name '{new}' is taken: the mesh has a group of that name; choose another")
    with transaction(obj.Document, f"Rename group {old}"):
        if _PROPERTY not in obj.PropertiesList:
            obj.addProperty("App::PropertyMap", _PROPERTY, "FEM Mesh", "Mesh groups that were renamed", _OUTPUT)
            obj.setEditorMode(_PROPERTY, 2)
        names = dict(getattr(obj, _PROPERTY))
        _shown.setdefault(_key(obj), dict(names))
        first = next(
            (key for key, name in names.items() if name == old and key.startswith(kind + ":")), f"{kind}:{old}"
        )
        names[first] = new
        setattr(obj, _PROPERTY, names)
        follow(obj)


def names_of(obj):
    """The groups of the mesh that were renamed: (kind, first name, name now)."""
    names = dict(getattr(obj, _PROPERTY)) if _PROPERTY in obj.PropertiesList else {}
    return [(*key.split(":", 1), now) for key, now in names.items()]


def follow(obj):
    """Gives the groups of the mesh the names the object's property says."""
    wanted = dict(getattr(obj, _PROPERTY)) if _PROPERTY in obj.PropertiesList else {}
    shown = _shown.get(_key(obj), wanted)
    if shown == wanted:
        return
    names = {}
    for key in {*shown, *wanted}:
        kind, first = key.split(":", 1)
        names[kind, shown.get(key, first)] = wanted.get(key, first)
    femmesh = obj.FemMesh.copy()
    for group in femmesh.Groups:
        # All of them, so that they stay in order.
        old, group_type = femmesh.getGroupName(group), femmesh.getGroupElementType(group)
        name, members = names.get((_kind(femmesh, group), old), old), femmesh.getGroupElements(group)
        femmesh.removeGroup(group)
        femmesh.addGroupElements(femmesh.addGroup(name, group_type), list(members))
    obj.FemMesh = femmesh
    _shown[_key(obj)] = wanted


def follow_all(document):
    """follow() for every object of a document whose groups were renamed."""
    for obj in document.Objects:
        if _key(obj) in _shown:
            follow(obj)


def _key(obj):
    return obj.Document.Name, obj.Name


def _kind(femmesh, group):
    return "node" if femmesh.getGroupElementType(group) == "Node" else "element"
