# SPDX-License-Identifier: LGPL-2.1-or-later
"""Placements of tools that follow picked geometry: faces, edges, vertices, datums and sketches.

As with FreeCAD's own attachment the geometry gives axes (see picked_geometry.py), and the placement keeps its place in
them: it is the geometry's axes * FollowOffset. FreeCAD's names of faces and edges may mean others after a change of a
part, so a change that may have renumbered them is an error, unless what is followed is where it was.
"""

import FreeCAD

from .picked_geometry import axes_of, name_of, topology_of
from .said import said

NUMBERS, GEOMETRY = "Numbers", "Geometry"

FOLLOW_INPUTS = (
    (
        "App::PropertyEnumeration",
        "Follow",
        "Numbers: the placement is as entered; Geometry: it follows FollowedGeometry",
        [NUMBERS, GEOMETRY],
        NUMBERS,
    ),
    (
        "App::PropertyLinkSubListGlobal",
        "FollowedGeometry",
        "Face, edge, datum or sketch, or two or three vertices that the placement follows",
    ),
    ("App::PropertyPlacement", "FollowOffset", "The placement in the axes of FollowedGeometry"),
    ("App::PropertyBool", "SizeFollows", "Whether the radius, or the outline, is that of FollowedGeometry, too"),
    ("App::PropertyString", "FollowedName", "What FollowedGeometry was called when it was picked"),
    ("App::PropertyString", "FollowedTopology", "Which faces and edges its parts had then"),
    # Where an expression says any of these, they are all that says the placement; else they mean nothing.
    ("App::PropertyVector", "Direction", "Where expressions say it: the normal of the plane, or the axis; any length"),
    ("App::PropertyVector", "Origin", "Where expressions say the direction: the point of the tool without Offset"),
    ("App::PropertyDistance", "Offset", "Where expressions say it: how far the tool is from Origin along Direction"),
    ("App::PropertyAngle", "Turn", "Where expressions say it: by how much the tool is turned about Direction"),
)
#: The last of these, which expressions may say.
EXPRESSED = ("Direction", "Offset", "Turn")
#: Names of these properties: the mesh depends on them only by way of the numbers.
FOLLOW_PROPERTIES = tuple(name for _, name, *_ in FOLLOW_INPUTS)

#: Properties that may follow.
NUMBERS_THAT_FOLLOW = (
    "PlanePlacement",
    "AxisPlacement",
    "Radius",
    "Patch",
    "PatchRadius",
    "PatchSecondRadius",
    "PatchCorners",
)

# What counts as the same place, as part of the distances there are, and the same direction.
_SAME = 1e-12


def set_up(obj):
    """Hides what is not for users, and locks the numbers that follow."""
    if "FollowedTopology" not in obj.PropertiesList:
        return
    for name in ("FollowedName", "FollowedTopology", "Direction", "Origin", "Offset", "Turn"):
        obj.setEditorMode(name, 2)
    for name in ("FollowedGeometry", "FollowOffset", "SizeFollows"):
        obj.setEditorMode(name, 0 if follows(obj) else 2)
    obj.setEditorMode(placement_property(obj), 1 if follows(obj) else 0)


def placement_property(obj):
    """The name of the property that follows."""
    return "PlanePlacement" if "PlanePlacement" in obj.PropertiesList else "AxisPlacement"


def follows(obj):
    """Whether the numbers of an object of FemScalpel follow geometry."""
    return "FollowedTopology" in obj.PropertiesList and obj.Follow == GEOMETRY


def is_expressed(obj):
    """Whether expressions say the direction, the offset or the turn of an object of FemScalpel."""
    return any(path.lstrip(".").split(".")[0] in EXPRESSED for path, _ in obj.ExpressionEngine)


def _expressed(obj):
    """The placement that expressions say. ValueError where the direction is zero."""
    direction, here = FreeCAD.Vector(obj.Direction), getattr(obj, placement_property(obj))
    if not direction.Length > 0:
        raise ValueError("Direction, as its expressions say it, is zero; give it a length")
    z = FreeCAD.Vector(0, 0, 1)
    rotation = FreeCAD.Rotation(z, direction) * FreeCAD.Rotation(z, obj.Turn.Value)
    base = obj.Origin + FreeCAD.Vector(direction).normalize() * obj.Offset.Value
    paths = [path.lstrip(".") for path, _ in obj.ExpressionEngine]
    if any(path.startswith(f"{placement_property(obj)}.Base.") for path in paths):
        base = here.Base  # as on any other object
    return FreeCAD.Placement(base, rotation)


def targets_of(obj):
    """What an object follows as [(document object, name of its part or "")]."""
    return [(part, name) for part, names in obj.FollowedGeometry for name in (names or ("",))]


def link(obj, targets, offset=None):
    """Has `obj` follow `targets`, as targets_of(); with `offset` in their axes, else from where it is now. Its size
    follows, too, if it is theirs. ValueError where there is nothing that can be followed; nothing is changed then."""
    if "Follow" not in obj.PropertiesList:
        raise ValueError(f"'{obj.Label}' has no placement that can follow geometry")
    for part, _ in targets:
        if part.Document != obj.Document:
            raise ValueError(f"'{part.Label}' is in another document; '{obj.Label}' can follow only what is in its own")
        if part == obj or obj in part.OutListRecursive:
            raise ValueError(f"'{part.Label}' is made from '{obj.Label}', which cannot follow it")
    axes = axes_of(targets)
    here = getattr(obj, placement_property(obj))
    obj.Follow = NUMBERS  # so that nothing is taken for a change by hand meanwhile
    obj.FollowedGeometry = [(part, name) for part, name in targets]
    obj.FollowedName, obj.FollowedTopology = name_of(targets), topology_of(targets)
    obj.FollowOffset = axes.placement.inverse().multiply(here) if offset is None else FreeCAD.Placement(offset)
    _move(obj, axes.placement.multiply(obj.FollowOffset))
    obj.SizeFollows = _size_is_of(obj, axes)
    obj.Follow = GEOMETRY
    set_up(obj)


def unlink(obj):
    """The numbers stay as they are from now on."""
    obj.Follow = NUMBERS
    obj.FollowedGeometry = []
    obj.SizeFollows = False
    obj.FollowedName = obj.FollowedTopology = ""
    set_up(obj)


def problem_of(obj):
    """What is wrong with the geometry that an object follows, "" where nothing is."""
    try:
        if "Direction" in obj.PropertiesList and is_expressed(obj):
            _expressed(obj)
        _axes(obj)
    except ValueError as error:
        return str(error)
    return ""


def follow(obj):
    """Takes the numbers from the geometry, where they follow any. ValueError where that is broken; they stay then."""
    if "Direction" in obj.PropertiesList and is_expressed(obj):
        _move(obj, _expressed(obj))
        return
    axes = _axes(obj)
    if axes is None:
        return
    sizes = _sizes(obj, axes) if obj.SizeFollows else {}
    _move(obj, axes.placement.multiply(obj.FollowOffset))
    for name, value in sizes.items():
        if not _same_size(getattr(obj, name), value):
            setattr(obj, name, value)
    topology = topology_of(targets_of(obj))
    if topology != obj.FollowedTopology:
        obj.FollowedTopology = topology


def changed_by_hand(obj, prop):
    """Ends following where `prop` was set to something else than the geometry says, with a word in the report view."""
    if not follows(obj):
        return
    try:
        axes = _axes(obj)
    except ValueError:
        axes = None
    place = placement_property(obj)
    if prop == place:
        if axes is None or not _same(getattr(obj, place), axes.placement.multiply(obj.FollowOffset)):
            name = obj.FollowedName
            unlink(obj)
            text = said(f"{place} was set, so it does not follow {name} any more")
            FreeCAD.Console.PrintWarning(f"{obj.Label}: {text}\n")
    elif obj.SizeFollows and axes is not None and not _size_is_of(obj, axes):
        obj.SizeFollows = False
        text = said(f"{prop} was set, so it is not that of {obj.FollowedName} any more")
        FreeCAD.Console.PrintWarning(f"{obj.Label}: {text}\n")


def _axes(obj):
    """The Axes that an object follows now, None where it follows none. ValueError, see follow()."""
    if not follows(obj):
        return None
    place, name = placement_property(obj), obj.FollowedName
    advice = "pick it again in the operation's panel, or set Follow to Numbers"
    targets = targets_of(obj)
    if not targets or len(targets) != name.count(",") + 1:
        raise ValueError(f"{name or 'FollowedGeometry'}, which {place} follows, is not there any more; {advice}")
    try:
        axes = axes_of(targets)
    except ValueError as error:
        raise ValueError(f"{place} cannot follow {name}: {error}; {advice}") from None
    if topology_of(targets) != obj.FollowedTopology:
        before = getattr(obj, place).multiply(obj.FollowOffset.inverse())
        if not _same(before, axes.placement, 1e-9):
            raise ValueError(
                f"{name}, which {place} follows, may be another face, edge or vertex now: its part has others than "
                f"before; {advice}"
            )
    if obj.SizeFollows:
        try:
            _sizes(obj, axes)
        except ValueError as error:
            raise ValueError(f"{error}; {advice}") from None
    return axes


def _move(obj, placement):
    """Sets the placement, and takes others along that go with it; leaves it to the last bit where it is the same."""
    place = placement_property(obj)
    old = getattr(obj, place)
    if _same(old, placement):
        return
    if "BottomPlacement" in obj.PropertiesList and not obj.Through:
        obj.BottomPlacement = placement.multiply(old.inverse()).multiply(obj.BottomPlacement)
    setattr(obj, place, placement)


def _same(one, other, tolerance=_SAME):
    size = max(1.0, one.Base.Length, other.Base.Length)
    turn = one.Rotation.inverted().multiply(other.Rotation)
    return one.Base.distanceToPoint(other.Base) <= tolerance * size and all(
        turn.multVec(axis).distanceToPoint(axis) <= tolerance * 10
        for axis in (FreeCAD.Vector(1, 0, 0), FreeCAD.Vector(0, 0, 1))
    )


def _size_is_of(obj, axes):
    """Whether the size of an object is what the geometry says."""
    try:
        sizes = _sizes(obj, axes)
    except ValueError:
        return False
    return bool(sizes) and all(_same_size(getattr(obj, name), value) for name, value in sizes.items())


def _sizes(obj, axes):
    """The properties that say the size, by name, as the geometry has them. ValueError where it has no such."""
    if "Patch" not in obj.PropertiesList:
        if axes.radius is None:
            raise ValueError(f"{name_of(targets_of(obj))} has no radius any more")
        return {"Radius": axes.radius}
    kinds = {"Disk": "circle", "Ellipse": "ellipse", "Polygon": "polygon with straight sides"}
    if obj.Patch not in kinds:
        return {}
    outline, out = axes.outline, None
    if outline is not None and obj.Patch == "Polygon" and outline.corners:
        back = obj.FollowOffset.inverse()
        out = {"PatchCorners": [back.multVec(corner) for corner in outline.corners]}
    elif outline is not None and outline.radii:
        if obj.Patch == "Disk" and outline.radii[0] == outline.radii[1]:
            out = {"PatchRadius": outline.radii[0]}
        elif obj.Patch == "Ellipse":
            out = {"PatchRadius": outline.radii[0], "PatchSecondRadius": outline.radii[1]}
    if out is None:
        raise ValueError(f"{name_of(targets_of(obj))} is no {kinds[obj.Patch]} any more")
    return out


def _same_size(here, value):
    if isinstance(value, list):
        size = max([1.0, *(corner.Length for corner in value)])
        return len(here) == len(value) and all(
            FreeCAD.Vector(a.x, a.y, 0).distanceToPoint(FreeCAD.Vector(b.x, b.y, 0)) <= 1e-9 * size
            for a, b in zip(here, value)
        )
    return abs(here.Value - value) <= 1e-9 * max(1.0, abs(value))
