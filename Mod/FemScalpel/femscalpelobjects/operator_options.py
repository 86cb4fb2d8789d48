# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the objects offer of the operators' options: one row of `OPTIONS` for each.

A row gives the option to the functions of ObjectsFemScalpel, to the objects' properties, and to femscalpel's operators
when an object is computed. What an option means is said in femscalpel/options.py.
"""

from dataclasses import dataclass, replace
from numbers import Real
from typing import Any, Callable, Dict, Tuple

import FreeCAD

import femscalpel
from femscalpel.signatures import Argument

from .geometry import geometry_of
from .on_shape import bookkeeping_groups

METHODS = femscalpel.options.METHODS


@dataclass(frozen=True)
class OperatorOption:
    """An option of operators that make an object's mesh."""

    argument: Argument  #: of the functions of ObjectsFemScalpel
    #: (type, name, text, values it is set to when it is added) of properties; of an enumeration, first its list.
    properties: Tuple[tuple, ...]
    to_properties: Callable[[Any], Dict[str, Any]]  #: values of properties, from the argument's; may raise ValueError
    keyword: str  #: of femscalpel's operators
    read: Callable[[Any, Any], Any]  #: its value, from an object and the mesh it works on; may raise ValueError


def _refine_properties(refine):
    if refine is None:
        return {"Refine": "Automatic"}
    if refine is False:
        return {"Refine": "Never"}
    if isinstance(refine, bool) or not isinstance(refine, (Real, FreeCAD.Units.Quantity)) or not refine > 0:
        raise ValueError(f"refine must be None, False or a positive length, not {refine!r}")
    return {"Refine": "Size", "RefineSize": refine}


def _read_refine(obj, mesh):
    return {"Automatic": None, "Never": False, "Size": obj.RefineSize.Value}[obj.Refine]


def _read_preserve(obj, mesh):
    """The geometry is kept whatever PreservedGroups says: FreeCAD finds what it needs by it."""
    return None if "*" in obj.PreservedGroups else [*obj.PreservedGroups, *bookkeeping_groups(mesh)]


OPTIONS = (
    OperatorOption(
        Argument("method", "snap", '{"snap", "deform"}', "See femscalpel.crack."),
        (
            (
                "App::PropertyEnumeration",
                "Method",
                "snap: move and split, always succeeds; deform: only move nodes",
                list(METHODS),
                "snap",
            ),
        ),
        lambda method: {"Method": method},
        "method",
        lambda obj, mesh: obj.Method,
    ),
    OperatorOption(
        Argument("transition", 0, "int", "Rings of elements around the tool that may move; 0: automatic."),
        (
            (
                "App::PropertyIntegerConstraint",
                "Transition",
                "Rings of elements around the tool that may move; 0: automatic",
                (0, 0, 1000, 1),
            ),
        ),
        lambda transition: {"Transition": transition},
        "transition",
        lambda obj, mesh: obj.Transition or None,
    ),
    OperatorOption(
        Argument("group_name", None, "str", "Prefix of the new mesh groups."),
        (("App::PropertyString", "GroupName", "Prefix of the new groups"),),
        lambda group_name: {"GroupName": group_name},
        "name",
        lambda obj, mesh: obj.GroupName,
    ),
    OperatorOption(
        Argument("feature_angle", 30.0, "float", "Degrees; skin edges sharper than this keep their shape."),
        (("App::PropertyAngle", "FeatureAngle", "Skin edges sharper than this keep their shape", 30),),
        lambda angle: {"FeatureAngle": angle},
        "feature_angle",
        lambda obj, mesh: obj.FeatureAngle.Value,
    ),
    OperatorOption(
        Argument(
            "preserve",
            None,
            "names of mesh groups, optional",
            "The groups whose border keeps its shape; all when not given. Borders of others may drift.",
        ),
        (
            (
                "App::PropertyStringList",
                "PreservedGroups",
                "Mesh groups whose border keeps its shape; *: all. The borders of others "
                "may drift, those of all if the list is empty",
                ["*"],
            ),
        ),
        lambda preserve: {"PreservedGroups": ["*"] if preserve is None else preserve},
        "preserve",
        _read_preserve,
    ),
    OperatorOption(
        Argument(
            "refine",
            None,
            "None, False or float",
            "Whether elements near the tool are divided first: None: where the tool is finer than the mesh; False: "
            "never; a number: where edges are longer than so many mm.",
        ),
        (
            (
                "App::PropertyEnumeration",
                "Refine",
                "Whether elements near the tool are divided first. Automatic: where the tool is finer than "
                "the mesh; Size: where edges are longer than RefineSize",
                ["Automatic", "Never", "Size"],
                "Automatic",
            ),
            (
                "App::PropertyLength",
                "RefineSize",
                "Longest edge at the tool (of a crack that ends inside, at its front) if Refine is Size",
                1,
            ),
        ),
        _refine_properties,
        "refine",
        _read_refine,
    ),
)

#: Of every object whose operator takes a skin, and no argument of a function.
KEEP_TO_SHAPE = (
    "App::PropertyBool",
    "KeepToShape",
    "The skin is taken to be that of the geometry the mesh was made from, not the mesh's triangles: "
    "new and moved nodes are made on it, which makes a coarse skin better",
)


def skin_of(obj):
    """What femscalpel's operators take as `skin`: the geometry the mesh of `obj` was made from, if KeepToShape says
    so."""
    if not obj.KeepToShape:
        return None
    geometry = geometry_of(obj)
    if geometry is None:
        raise ValueError(
            "KeepToShape is set, but the mesh does not know the geometry it was made from (its property Part or Shape)"
        )
    return geometry.Shape


def _chosen(names):
    return [option for option in OPTIONS if not names or option.argument.name in names]


def arguments(*names, without=(), **defaults):
    """The options of these names, or all but those of `without`, as arguments of a function of ObjectsFemScalpel;
    `defaults` by name, where they are its own."""
    chosen = [option.argument for option in _chosen(names) if option.argument.name not in without]
    return [replace(a, default=defaults.get(a.name, a.default)) for a in chosen]


def inputs(*names, **values):
    """Properties (type, name, text, values) of the options of these names, or of all. `values`: by property, what it is
    set to in place of its default; of GroupName, first the text, and it comes last."""
    rows = [row for option in _chosen(names) for row in option.properties]
    rows = [(*row[:3], *values[row[1]]) if row[1] in values and row[1] != "GroupName" else row for row in rows]
    named = [(*row[:2], *values["GroupName"]) for row in rows if row[1] == "GroupName"]
    return (*(row for row in rows if row[1] != "GroupName"), *named)


def to_properties(given):
    """Values of properties for values of arguments, both by name. Raises ValueError for what no property takes."""
    out = {}
    for option in OPTIONS:
        if option.argument.name in given:
            out.update(option.to_properties(given[option.argument.name]))
    return out


def values(obj, mesh, *names):
    """The options of these names, or all, as keyword arguments of femscalpel's operators on `mesh`."""
    return {o.keyword: o.read(obj, mesh) for o in _chosen(names)}


def keywords(obj, mesh, *names):
    """As values(), and the skin."""
    return {**values(obj, mesh, *names), "skin": skin_of(obj)}
