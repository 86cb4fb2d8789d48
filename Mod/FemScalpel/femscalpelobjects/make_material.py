# SPDX-License-Identifier: LGPL-2.1-or-later
"""The functions of ObjectsFemScalpel that add material, round edges and move walls."""

from femscalpel.signatures import takes
from femscalpel.tools import TOOLS

from . import checked, operator_options, tool_properties
from .fillet import Fillet
from .making import check_source, make, placement_of
from .merge import Merge
from .reshape import Reshape


@takes(options=operator_options.arguments("feature_angle", "refine", "group_name", group_name="ADD"))
def makeMerge(
    doc,
    source,
    addition,
    name="Merge",
    keep="mesh",
    tolerance=0.0,
    prefix="",
    join_groups=True,
    *,
    options,
):
    """Adds a parametric mesh object to `doc`: the mesh of `source` with that of `addition`, joined where they meet.

    The mesh is made anew also when the addition or its placement changes. See femscalpel.merge for what can be joined
    and how. The new mesh groups are ``group_name_SEAM``, the nodes both share, and ``group_name_ADDED``, the addition's
    elements; those of the addition come along.

    Parameters
    ----------
    doc, source, name
        As for makeCrack().
    addition : Fem::FemMeshObject
        The mesh to add, where its placement puts it: also one that FreeCAD has made of a part by Gmsh or Netgen, or
        one of FemScalpel's. If the source is a solid mesh without face elements, those on the addition's skin are left
        out, and their groups become groups of nodes.
    keep : {"mesh", "addition"}
        Which of two solids that overlap stays as it is; the overlap is cut off the other.
    tolerance : float
        What is nearer than this to the other's surface touches it, in mm; 0: automatic.
    prefix : str
        Of groups of the addition whose name the source has for others; `group_name` and "_" when empty.
    join_groups : bool
        Whether groups of one name and kind become one.
    {options}

    Returns and raises as makeCrack(), also when `addition` is not a FEM mesh object of `doc`.
    """
    check_source(doc, source)
    check_source(doc, addition, "addition")
    return make(
        doc,
        Merge,
        source,
        name,
        options,
        Addition=addition,
        Keep=keep,
        Tolerance=tolerance,
        GroupPrefix=prefix,
        JoinGroups=join_groups,
    )


@takes(options=operator_options.arguments(group_name="FILLET"))
def makeFillet(doc, source, along, radius=1.0, name="Fillet", *, options):
    """Adds a parametric mesh object to `doc`: the mesh of `source` with edges rounded, convex or concave.

    The new mesh group is ``group_name_FACE``; see femscalpel.fillet.

    Parameters
    ----------
    doc, source, name
        As for makeCrack().
    along : str, or sequence of App.Vector or three numbers
        The edge: the name of a mesh group of segments or nodes, or points near edges of the mesh. Each edge is rounded
        as far as it goes on without a corner.
    radius : float
        Of the ball that rolls along the edge, in mm.
    {options}

    Returns and raises as makeCrack().
    """
    check_source(doc, source)
    points = () if isinstance(along, str) else checked.vectors(along, "along")
    if not (along if isinstance(along, str) else points):
        raise ValueError("along is empty; give the name of a group, or points near edges")
    return make(
        doc,
        Fillet,
        source,
        name,
        options,
        Along=along if isinstance(along, str) else "",
        AlongPoints=points,
        Radius=radius,
    )


@takes(
    inputs=tool_properties.arguments(),
    options=operator_options.arguments("feature_angle", "preserve", "group_name", group_name="SHAPE"),
    after=tool_properties.places(face="preserve", last="face"),
)
def makeReshape(
    doc,
    source,
    group,
    onto=None,
    by=None,
    scale=None,
    name="Reshape",
    placement=None,
    origin=None,
    axis=None,
    *,
    inputs,
    options,
):
    """Adds a parametric mesh object to `doc`: the mesh of `source` with a wall moved.

    The new mesh group is ``group_name_WALL``, the wall's nodes; see femscalpel.reshape. Where the mesh was made from a
    geometry, FreeCAD does not find the nodes of a wall that was moved by that any more: the property OffShape says
    which faces these are. Loads and supports there have to be given by mesh group.

    Parameters
    ----------
    doc, source, name
        As for makeCrack().
    group : str
        What is moved: a mesh group of faces (of a shell: of edges on its border), or of nodes.
    onto : str, optional
        "Plane", "Cylinder", "Sphere", ...: the surface to move it onto, the name of a tool's class in femscalpel, as
        for makeRefine().
    by : App.Vector or three numbers, optional
        The vector to move it by, in mm.
    scale : (float, App.Vector or three numbers), optional
        A factor for the distances from a point, and that point. Just one of `onto`, `by` and `scale` is given.
    placement, origin, axis
        Of the surface `onto`, as for makeCurvedCrack().
    {inputs}
    {options}

    Returns and raises as makeCrack().
    """
    check_source(doc, source)
    if sum(motion is not None for motion in (onto, by, scale)) != 1:
        raise ValueError("give one of onto, by and scale")
    if onto is not None:
        motion = {"Motion": "Onto", "ToolShape": checked.one_of(onto, "onto", list(TOOLS))}
    elif by is not None:
        motion = {"Motion": "By", "MoveBy": checked.vector(by, "by")}
    else:
        factor, centre = checked.pair(scale, "scale", "a factor and a point")
        motion = {"Motion": "Scale", "ScaleFactor": factor, "ScaleCentre": checked.vector(centre, "scale's point")}
    return make(
        doc,
        Reshape,
        source,
        name,
        options,
        Group=group,
        AxisPlacement=placement_of(source, placement, origin, axis, "axis"),
        **tool_properties.to_properties(inputs),
        **motion,
    )
