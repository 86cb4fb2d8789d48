# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the functions of ObjectsFemScalpel share: new objects, and nothing left behind by a refused call."""

import FreeCAD

from . import checked, operator_options, tool_properties

if FreeCAD.GuiUp:
    from femscalpelgui.viewproviders.mesh_operation import ViewProviderMeshOperation


def check_source(doc, source, name="source"):
    """TypeError or ValueError, unless `source` is a FEM mesh object of the document `doc`; `name` is what the caller
    calls it."""
    checked.mesh_object(source, name, checked.document(doc))


def make_along_tool(doc, operation, source, name, tool, place, inputs, options, **properties):
    """As make(), of an operation with any tool: `tool` at the `place` (placement, origin, axis) with `inputs`."""
    check_source(doc, source)
    return make(
        doc,
        operation,
        source,
        name,
        options,
        ToolShape=tool,
        AxisPlacement=placement_of(source, *place, "axis"),
        **tool_properties.to_properties(inputs),
        **properties,
    )


def make(doc, operation, source, name, options, **properties):
    """The new object; nothing is left behind when a property does not take its value."""
    properties = {**properties, **operator_options.to_properties(options)}
    obj = doc.addObject("Fem::FemMeshObjectPython", checked.text(name, "name"))
    try:
        operation(obj)
        for key, value in properties.items():
            checked.set_property(obj, key, value)
        obj.Source = source
    except Exception:
        doc.removeObject(obj.Name)
        raise
    if FreeCAD.GuiUp and obj.ViewObject is not None:
        ViewProviderMeshOperation(obj.ViewObject)
    return obj


def placement_of(source, placement, origin, direction, name):
    """`placement`, or one whose z axis is `direction` through `origin`; `name` is what the caller calls the
    direction."""
    if placement is not None:
        if origin is not None or direction is not None:
            raise ValueError(f"give placement, or origin and {name}, not both")
        return checked.placement(placement)
    base = source.FemMesh.BoundBox.Center if origin is None else checked.vector(origin, "origin")
    direction = FreeCAD.Vector(0, 0, 1) if direction is None else checked.vector(direction, name)
    if not direction.Length > 0:
        raise ValueError(f"{name} is the zero vector; give a direction")
    return FreeCAD.Placement(base, FreeCAD.Rotation(FreeCAD.Vector(0, 0, 1), direction))
