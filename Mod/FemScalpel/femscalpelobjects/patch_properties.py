# SPDX-License-Identifier: LGPL-2.1-or-later
"""Properties that say which part of a plane or cylinder cracks, and the shape they mean."""

import FreeCAD

import femscalpel

from .tool_properties import direction_of

#: Parts of a plane, by the name of their class in femscalpel.
PATCHES = ("Whole", "Disk", "Ellipse", "Polygon", "HalfPlane")
PATCH_INPUTS = (
    (
        "App::PropertyEnumeration",
        "Patch",
        "Part of the plane that cracks; placed by PlanePlacement, its border is the crack front",
        list(PATCHES),
        "Whole",
    ),
    ("App::PropertyLength", "PatchRadius", "Of the disk; of the ellipse along the placement's x axis", 1),
    ("App::PropertyLength", "PatchSecondRadius", "Of the ellipse along the placement's y axis", 0.5),
    (
        "App::PropertyVectorList",
        "PatchCorners",
        "Of the polygon, in order around it, in the placement's own axes (z = 0)",
    ),
)

CYLINDER_PART_INPUTS = (
    ("App::PropertyBool", "Bounded", "Whether only a part of the cylinder cracks, from Low to High"),
    ("App::PropertyDistance", "Low", "Where the crack begins, along the placement's z axis from its origin"),
    ("App::PropertyDistance", "High", "Where the crack ends", 1),
    ("App::PropertyAngle", "StartAngle", "Where the crack begins, about the z axis from the placement's x axis"),
    ("App::PropertyAngle", "EndAngle", "Where the crack ends; 360 degrees beyond StartAngle: all around", 360),
)


def patch_of(obj):
    """What the properties PATCH_INPUTS mean for `within` of femscalpel.crack: None for the whole plane."""
    placement = obj.PlanePlacement
    along = placement.Rotation.multVec(FreeCAD.Vector(1, 0, 0))
    if obj.Patch == "Disk":
        return femscalpel.Disk(placement.Base, obj.PatchRadius.Value)
    if obj.Patch == "Ellipse":
        return femscalpel.Ellipse(placement.Base, (obj.PatchRadius.Value, obj.PatchSecondRadius.Value), along)
    if obj.Patch == "Polygon":
        return femscalpel.Polygon(
            [placement.multVec(FreeCAD.Vector(corner.x, corner.y, 0)) for corner in obj.PatchCorners]
        )
    if obj.Patch == "HalfPlane":
        return femscalpel.HalfPlane(placement.Base, along)
    return None


def fronts_of(obj):
    """Tools that cross the plane in the patch's border, where femscalpel has such: nodes on them have to stay there."""
    placement = obj.PlanePlacement
    normal = direction_of(placement)
    if obj.Patch == "Disk":
        return [femscalpel.Cylinder(placement.Base, normal, obj.PatchRadius.Value)]
    if obj.Patch == "HalfPlane":
        return [femscalpel.Plane(placement.Base, placement.Rotation.multVec(FreeCAD.Vector(1, 0, 0)))]
    if obj.Patch == "Polygon":
        corners = [placement.multVec(FreeCAD.Vector(corner.x, corner.y, 0)) for corner in obj.PatchCorners]
        sides = [(b - a).cross(normal) for a, b in zip(corners, corners[1:] + corners[:1])]
        return [femscalpel.Plane(corner, side) for corner, side in zip(corners, sides) if side.Length > 0]
    return []


def cylinder_part_of(obj):
    """What the properties CYLINDER_PART_INPUTS mean for `within` of femscalpel.crack: None for the whole cylinder."""
    if not obj.Bounded:
        return None
    along, start, end = (obj.Low.Value, obj.High.Value), obj.StartAngle.Value, obj.EndAngle.Value
    if end - start == 360:
        return femscalpel.CylinderPart(along)
    return femscalpel.CylinderPart(along, (start, end), obj.AxisPlacement.Rotation.multVec(FreeCAD.Vector(1, 0, 0)))


def part_fronts_of(obj):
    """As fronts_of(), for a part of a cylinder."""
    if not obj.Bounded:
        return []
    placement, axis = obj.AxisPlacement, direction_of(obj.AxisPlacement)
    ends = [femscalpel.Plane(placement.Base + axis * height, axis) for height in (obj.Low.Value, obj.High.Value)]
    if obj.EndAngle.Value - obj.StartAngle.Value == 360:
        return ends
    around = [FreeCAD.Rotation(FreeCAD.Vector(0, 0, 1), angle.Value) for angle in (obj.StartAngle, obj.EndAngle)]
    return ends + [
        femscalpel.Plane(placement.Base, (placement.Rotation * turn).multVec(FreeCAD.Vector(0, 1, 0)))
        for turn in around
    ]
