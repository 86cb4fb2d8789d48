# SPDX-License-Identifier: LGPL-2.1-or-later
"""The operators: they take a mesh and a tool, and give a new mesh and a report."""

from dataclasses import dataclass
from typing import Callable, Iterable, Optional, Sequence, Tuple, Union

import numpy as np

from . import _arguments, _engine
from ._engine import QualityError, RefinementEstimate
from .mesh import Mesh, check_mesh
from .options import (
    RefineOption,
    ShapeOption,
    check_before_refining,
    check_feature_angle,
    check_preserve,
    check_refine,
    on_session,
    takes_options,
)
from .report import Report
from .skin import check_skin
from .tools import Faces, Plane, Tool, check_tool
from .within import Within, check_within


@dataclass(frozen=True, eq=False)
class Result:
    """What an operator returns."""

    mesh: Mesh  #: the new mesh
    report: Report  #: what was done to get it

    @classmethod
    def _wrap(cls, returned) -> "Result":
        mesh, fields = returned
        result = Mesh._wrap(mesh)
        return cls(result, Report._from_engine(fields, result.instances))


def _run(operator, mesh, *arguments) -> Result:
    """The Result of an engine's operator on a mesh or a session."""
    subject = mesh._session if isinstance(mesh, Scalpel) else check_mesh(mesh)
    return Result._wrap(operator(subject, *arguments))


@takes_options("CRACK", after={"within": "band_only"})
def crack(mesh: Mesh, tool: Union[Tool, Faces], within: Optional[Within] = None, *, options) -> Result:
    """Cracks a mesh along a tool, or along a part of it.

    Element faces (edges, in a shell mesh) are brought onto the tool, then each side gets its own copy of the
    nodes on it. The lips are coincident; the original nodes stay with the negative side. Only elements near the
    tool change: everything else keeps its number, its coordinates bit for bit and its groups. Every group of
    the input is in the result. `mesh` itself is not changed. It may have cracks already, also across the new one: their
    lips are skin like any other, and where cracks cross, every piece of the material has nodes of its own. The lips of
    the older crack keep their plane and area, but need not match node for node there any more; the report warns of
    that.

    Shells that lie in the tool's surface come apart from those that stand on them: a plate stays with the negative
    side, or, where others are joined to it on the negative side only, with the positive.

    Beams (trusses, rods, cables: segments that are no edges of other elements) are divided on the tool and come apart
    there; where nothing else opens, ``name_N`` and ``name_P`` are node groups of their ends. Springs, dashpots and gaps
    of a CalculiX deck stay whole; other files do not tell them from beams.

    Parameters
    ----------
    mesh : Mesh
        Triangles (shells) and tetrahedra, linear or quadratic, near the tool; anything elsewhere.
    tool : Tool or Faces
        For example :class:`Plane`; or :class:`Faces` that the mesh has already.
    name : str
        Prefix of the new groups: ``name_P`` and ``name_N``, the lip faces on the tool's positive and negative
        side, and, if the sides hang together at some nodes, ``name_FRONT`` with these. The groups' names must be new
        and fit 24 characters.
    within : Disk, Ellipse, Polygon, HalfPlane or CylinderPart, optional
        The part of the tool that cracks; the whole when not given. Its border is the crack front: nodes there lie on it
        and stay single, and ``name_FRONT`` is an element group of segments along it, in order (in a shell mesh, the
        nodes at its tips). It may reach out of the mesh.
    {options}

    Returns
    -------
    Result
        ``result.mesh`` and ``result.report``; ``print(result.report.to_text())`` shows the group table.

    Raises
    ------
    ToolError
        The name is bad or taken, `preserve` names a group the mesh does not have, or the tool cuts nothing: the message
        says where it passes instead.
    UnsupportedElementError
        A quadrangle, prism, pyramid or hexahedron near the tool has so poor a shape that no sound triangles or
        tetrahedra can be made of it.
    QualityError
        No valid mesh can be made this way.
    Error
        With strict=True: a card of the deck cannot follow; the message lists all of them.
    TypeError, ValueError
        An argument of the wrong type or out of range, named in the message.

    Other Python threads run meanwhile; they must not change the mesh's groups.

    Examples
    --------
    >>> result = crack(mesh, Plane(origin=(7.3, 5, 5), normal=(0.9, 0.3, 0.2)))
    >>> result.mesh.groups["CRACK_P"].ids
    """
    if isinstance(tool, Faces):
        if within is not None:
            raise _arguments.about("within", ValueError("within has no meaning for a crack along faces"))
        return _run(_engine.crack_along_faces, mesh, tool.group, options)
    return _run(_engine.crack, mesh, check_tool(tool), options, check_within(within))


def _tools(tools) -> list:
    if isinstance(tools, Tool):
        return [tools]
    try:
        tools = list(tools)
    except TypeError:
        raise _arguments.about(
            "tools",
            TypeError(
                f"tools must be a tool such as femscalpel.Cylinder, or a sequence of tools, not "
                f"{_arguments.describe(tools)}"
            ),
        ) from None
    if not tools:
        raise _arguments.about("tools", ValueError("tools is empty; give at least one tool"))
    return [check_tool(tool, f"tools[{k}]") for k, tool in enumerate(tools)]


def _depth(depth) -> Optional[float]:
    return None if depth is None else _arguments.real(depth, "depth")


@takes_options("HOLE", after={"depth": "preserve"})
def drill(mesh: Mesh, tools: Union[Tool, Sequence[Tool]], depth: Optional[float] = None, *, options) -> Result:
    """Drills one or several holes.

    What lies on the negative side of a tool (inside a cylinder) is removed, with everything only the removed elements
    carried; the walls lie on the tools. Elements away from the holes keep their numbers, coordinates and groups. A
    group that loses all its members stays, empty, and the report warns. `mesh` itself is not changed.

    Parameters
    ----------
    mesh : Mesh
        Triangles (shells) and tetrahedra, linear or quadratic, near the tools; anything elsewhere.
    tools : Tool or sequence of Tool
        For example :class:`Cylinder`. Holes may overlap.
    name : str
        Prefix of the new groups: ``name_WALL``, the faces (segments, in a shell mesh; the ends of beams, where there is
        nothing else) on the tools, normals out of the material; with several tools also one for each hole,
        ``name_WALL1``, ...; ``name_BOTTOM`` of blind holes.
    method : {"snap", "deform"}
        "deform" (the paper, 3.2) moves nodes only, and is for a single through hole.
    transition, feature_angle, strict, preserve, band_only, refine, skin, second_order
        As for :func:`crack`.
    depth : number, optional
        Blind holes with a flat bottom: all material is removed from afar up to this far beyond the cylinder's origin
        along its axis. Through holes when not given, and, with a warning, where that is beyond the part.

    Returns
    -------
    Result
        The report's node sets are IHN and EHN (nodes of the hole, interior and on the skin), ITN and ETN.

    Raises
    ------
    ToolError
        The name is bad or taken, or a tool misses the mesh, or would remove all of it.
    UnsupportedElementError, QualityError, Error, TypeError, ValueError
        As for :func:`crack`.

    Examples
    --------
    >>> result = drill(mesh, Cylinder(origin=(6, 5, 10), axis=(0, 0, -1), radius=2), depth=4)
    >>> result.mesh.groups["HOLE_WALL"].ids
    """
    return _run(_engine.drill, mesh, _tools(tools), options, _depth(depth))


@takes_options("FILLET", after={"radius": "along"})
def fillet(mesh: Mesh, along: Union[str, Sequence, np.ndarray], radius: float, *, options) -> Result:
    """Rounds edges of a part.

    The new face is that of a ball which rolls along the edge and touches the faces on both sides: convex edges lose
    material, concave ones gain it. Its nodes lie on the cylinder (of a straight edge) or torus (of a circular one)
    exactly. Where the edge ends at a plane face, the new face runs out through that; a concave edge may also end in a
    plane face that stands across it. At other corners the rounding stops where the faces still reach as far as the ball
    touches them, in a flat face across the edge. Elements between the edge and the lines where the ball touches the
    faces are replaced by new ones, which are in the groups of those they replace; where groups meet along a concave
    edge, each gets half of what is added, and along a straight convex one their plane border ends at the new face.
    Edges that meet at a corner of three plane faces are rounded at once: two, between faces at the same angle, meet in
    a plane, as mitred; three in the triangle of a ball. The mesh is refined there first, to four elements over the arc
    at least. `mesh` itself is not changed.

    Parameters
    ----------
    mesh : Mesh
        Solids, or a plane mesh of shells, linear or quadratic; what is not tetrahedra or triangles near the edge
        becomes so first.
    along : str, list or array of int, tuple of three numbers, or array of shape (n, 3)
        The edges: a group of segments or nodes, numbers of nodes, or a point or points near feature lines of the skin.
        Each is rounded as far as it goes on without a corner. It must be straight or an arc of a circle, between
        planes, or cylinders and cones about the circle's axis. In a plane mesh, corners of its outline.
    radius : number
        Of the ball.
    name : str
        Prefix of the new groups: ``name_FACE``, the triangles (segments, in a plane mesh) of the new face, normals out
        of the material; ``name_END``, those of flat faces in which it stops at corners.
    method, transition, feature_angle, strict, preserve, band_only, refine, skin, second_order
        As for :func:`crack`; `feature_angle` also says what is an edge.

    Returns
    -------
    Result
        Groups of what lay on the edge lose that; the report says so.

    Raises
    ------
    ToolError
        The name is bad or taken, there is no such edge, a convex and a concave one meet, or the radius is too large for
        the faces beside it.
    UnsupportedElementError, QualityError, Error, TypeError, ValueError
        As for :func:`crack`; also where elements of different groups meet beside the edge.

    Examples
    --------
    >>> result = fillet(mesh, [(10, 0, 5)], radius=2)
    >>> result.mesh.groups["FILLET_FACE"].ids
    """
    return _run(_engine.fillet, mesh, *_along(along), _arguments.real(radius, "radius"), options)


def _along(along) -> tuple:
    """(group, node numbers, points) of fillet()'s parameter."""
    none = np.empty((0, 3))
    if isinstance(along, str):
        return _arguments.text(along, "along"), [], none
    given = _arguments.describe(along)
    message = f"along must be a group's name, node numbers or an array of points of shape (n, 3), not {given}"
    try:
        values = np.asarray(along)
    except (TypeError, ValueError):
        raise _arguments.about("along", TypeError(message)) from None
    if values.dtype.kind in "iuf" and values.size == 0:
        raise _arguments.about("along", ValueError("along is empty: name a group, nodes or points of the edge"))
    is_point = isinstance(along, tuple) and values.shape == (3,)  # also one of integers
    if values.ndim == 1 and np.issubdtype(values.dtype, np.integer) and not is_point:
        return "", [int(n) for n in values], none
    if values.dtype.kind not in "iufO":
        raise _arguments.about("along", TypeError(message))
    try:
        points = np.array(along, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise _arguments.about("along", TypeError(message)) from None
    if points.shape == (3,):
        points = points.reshape(1, 3)
    if points.ndim != 2 or points.shape[1] != 3:
        raise _arguments.about("along", TypeError(message))
    for k, point in enumerate(points):
        if not np.isfinite(point).all():
            where = f"along[{k}]" if len(points) > 1 or not is_point else "along"
            raise _arguments.about(
                "along", ValueError(f"{where} is {tuple(point.tolist())}; the coordinates of a point must be finite")
            )
    return "", [], points


def _walls(tool, width, other, bottom) -> tuple:
    """The two positional and the last argument of the engine's cut()."""
    if width is None and other is None:
        raise ValueError("give either width or other: the slot's width around a plane, or its other wall")
    if width is not None and other is not None:
        raise _arguments.about(
            "other", ValueError("other must not be given with width: a slot has a width, or two walls of its own")
        )
    if bottom is not None:
        check_tool(bottom, "bottom")
    if other is not None:
        return check_tool(tool), check_tool(other, "other"), bottom
    if not isinstance(tool, Plane):
        raise _arguments.about(
            "tool", TypeError(f"tool must be a femscalpel.Plane when width is given, not {_arguments.describe(tool)}")
        )
    return tool, _arguments.real(width, "width"), bottom


@takes_options("CUT")
def cut(
    mesh: Mesh,
    tool: Tool,
    width: Optional[float] = None,
    other: Optional[Tool] = None,
    bottom: Optional[Tool] = None,
    *,
    options,
) -> Result:
    """Cuts a slot: an incision between two planes.

    The elements between the planes are removed, with everything only they carried; both walls are flat. `mesh` itself
    is not changed.

    Parameters
    ----------
    mesh : Mesh
        Triangles (shells) and tetrahedra, linear or quadratic, near the planes; anything elsewhere.
    tool : Tool
        With `width`: the :class:`Plane` in the middle of the slot. With `other`: the wall on the positive side.
    width : number, optional
        Width of the slot.
    other : Tool, optional
        The second wall. What lies on the negative side of both `tool` and `other` is removed: their normals point into
        the material that stays. They need not be parallel; then they make a notch.
    bottom : Tool, optional
        Where the slot ends: it stays on the negative side of this plane (or cylinder: a circular saw). Through the
        whole part when not given.
    name : str
        Prefix of the new groups: ``name_P`` and ``name_N``, the walls on the positive and negative side of the slot's
        middle plane (of `tool` and `other`), normals out of the material, and ``name_BOTTOM``.
    method : {"snap"}
        "deform" is for a single surface only.
    transition, feature_angle, strict, preserve, band_only, refine, skin, second_order
        As for :func:`crack`.

    Returns
    -------
    Result
        The report's node sets are ICN and ECN (nodes of the walls, interior and on the skin), ITN and ETN.

    Raises
    ------
    ToolError
        The name is bad or taken, the width is not positive, a plane misses the mesh, or nothing or everything
        would be removed.
    UnsupportedElementError, QualityError, Error, TypeError, ValueError
        As for :func:`crack`.

    Examples
    --------
    >>> saw = cut(mesh, Plane((5, 0, 0), (1, 0, 0)), width=0.2, bottom=Plane((0, 0, 3), (0, 0, -1)))
    >>> saw.mesh.groups["CUT_BOTTOM"].ids
    """
    first, second, bottom = _walls(tool, width, other, bottom)
    return _run(_engine.cut, mesh, first, second, options, bottom)


def merge(
    mesh: Mesh,
    other: Mesh,
    name: str = "ADD",
    keep: str = "mesh",
    tolerance: Optional[float] = None,
    prefix: str = "",
    join_groups: bool = True,
    feature_angle: float = 30.0,
    strict: bool = False,
    keep_side: Optional[Sequence[float]] = None,
    method: str = "conform",
    refine: RefineOption = None,
    before_refining: Optional[Callable[[RefinementEstimate], None]] = None,
) -> Result:
    """Joins another mesh to a mesh: a stiffener, a doubler, a bracket.

    Where the surfaces of the two meet, both get the same nodes and edges: the line is made edges of the mesh as a crack
    would be, but not opened; the addition is divided likewise, and the two share its nodes. Elsewhere everything of the
    mesh keeps its number, its coordinates bit for bit and its groups. `mesh` and `other` themselves are not changed.

    Shells meet in lines: where the border of one is on the other (a T), where borders meet (an L), where they cross (an
    X); several pieces of an addition at once. Beams (line elements) end on shells or solids: a node of the mesh is
    moved to where they do, or made there. Beams that lie in a shell, or on a solid's skin, become edges of it, and are
    divided where it has nodes. On a solid they carry no moment, and shells along their border turn as about a hinge:
    nodes of solids have no rotations. The report says so. Solids touch or overlap; what is filled in behind the contact
    has the nodes of the other's skin.

    Parameters
    ----------
    mesh : Mesh
        The mesh that is added to, shells or solids, linear or quadratic. Quadrangles, prisms, pyramids and hexahedra
        become triangles and tetrahedra where the two meet (``report.converted``). Double nodes, as the lips of a
        crack, may not run across the line where they do.
    other : Mesh
        What is added. One of another order is brought to the mesh's. If both have a CalculiX deck, the addition's
        sections, materials, orientations and element types are taken over; the report names the cards that are not. An
        element set that has a section in its own deck does not join one of that name, but gets the prefix.
    name : str
        Prefix of the new groups: ``name_SEAM``, the nodes that the two share, and ``name_ADDED``, the addition's
        elements.
    keep : {"mesh", "addition"}
        Which of two solids that overlap or touch stays as it is; the overlap is cut off the other, and its elements
        behind the contact are made anew: a border of groups that runs through these becomes uneven, which is reported.
    tolerance : float, optional
        What is nearer than this to the other's surface touches it, and is moved there. A tenth of the shorter mean
        edge length when not given.
    prefix : str
        Of groups of the addition whose name the mesh has for others; the name and "_" when not given.
    join_groups : bool
        Whether groups of one name and kind become one. What a solver is told to do at a group of the mesh's nodes or
        facets, as a support or a load, it does at the addition's then, too; the report names such groups.
    feature_angle, strict
        As for :func:`crack`.
    keep_side : (x, y, z), optional
        Of shells that pass through the mesh, only what is on the side of this point stays. All of them when not given.
    method : {"conform", "tie"}
        With "tie" the two get no common nodes: both stay as they are, elements of any type, and may only touch. Groups
        of facets, ``name_TIE_MESH`` and ``name_TIE_ADDED``, are where they do: faces of solids, sides of shells, and
        edges of shells that stand on the other. A CalculiX deck gets the ``*SURFACE`` and ``*TIE`` cards that hold them
        together; else the report says them.
    refine : None, False or number
        Whether elements are bisected first where the two meet. None: those of the one that are more than 2.5 times as
        long as the other's; where elements come out poor, once more; but neither to more than 20 times as many
        elements as it had, which is an error. A number: elements of both with longer edges than this. False: none.
        ``result.report.refinement`` says what was done.
    before_refining : callable, optional
        As for :func:`crack`.

    Returns
    -------
    Result
        The report's groups are those of both meshes, before as the mesh had them.

    Raises
    ------
    ToolError
        The name is bad or taken, or the two do not meet: one is inside the other, a piece of the addition is apart, or
        the addition crosses itself.
    UnsupportedElementError
        A quadrangle, prism, pyramid or hexahedron where the two meet has so poor a shape that no sound triangles or
        tetrahedra can be made of it.
    QualityError
        No valid mesh can be made this way: the message says where.

    Examples
    --------
    >>> result = merge(caisson, stiffener, name="RIB")
    >>> result.mesh.groups["RIB_SEAM"].ids
    """
    addition = check_mesh(other, "other")
    if keep not in ("mesh", "addition"):
        raise _arguments.about(
            "keep", ValueError(f"keep must be 'mesh' or 'addition', not {_arguments.describe(keep)}")
        )
    if method not in ("conform", "tie"):
        raise _arguments.about(
            "method", ValueError(f"method must be 'conform' or 'tie', not {_arguments.describe(method)}")
        )
    options = _engine.Options()
    options.name = _arguments.text(name, "name")
    options.feature_angle = _arguments.real(feature_angle, "feature_angle")
    options.strict = _arguments.flag(strict, "strict")
    options.refine = check_refine(refine)
    options.before_refining = check_before_refining(before_refining)
    if tolerance is not None and (tolerance := _arguments.real(tolerance, "tolerance")) <= 0:
        raise _arguments.about("tolerance", ValueError(f"tolerance must be a positive length, not {tolerance}"))
    result = _run(
        _engine.merge,
        mesh,
        addition,
        options,
        keep == "addition",
        tolerance,
        _arguments.text(prefix, "prefix"),
        _arguments.flag(join_groups, "join_groups"),
        None if keep_side is None else list(_arguments.vector(keep_side, "keep_side")),
        method == "tie",
    )
    if method == "conform" and not isinstance(mesh, Scalpel):
        _check_shells_joined(mesh, addition, result.mesh)
    return result


def _check_shells_joined(mesh, addition, result):
    """QualityError where nodes of two shells lie on each other and are not one, as where they cross at few degrees."""
    if max(mesh.dimension, addition.dimension) != 2 or len(_first_double(mesh)) or len(_first_double(addition)):
        return
    double = _first_double(result)
    if len(double):
        x, y, z = double
        raise QualityError(
            f"nodes of the two shells would lie on each other near ({x:.6g} {y:.6g} {z:.6g}) without being one, as "
            "where they cross at an angle of a few degrees. Turn the addition, or give a smaller tolerance"
        )


def _first_double(mesh):
    """The place of a node that another one lies on; empty where there is none."""
    size = float(np.ptp(mesh.points, axis=0).max(initial=0.0)) or 1.0
    places = np.round(mesh.points / (1e-9 * size))
    order = np.lexsort(places.T)
    same = np.flatnonzero((places[order][1:] == places[order][:-1]).all(axis=1))
    return mesh.points[order[same[0]]] if len(same) else ()


def refine(
    mesh: Mesh,
    near: Union[Tool, Sequence[Tool], np.ndarray],
    size: float,
    gradation: float = 0.5,
    reach: float = 0.0,
    relax: bool = True,
    max_elements: int = 5_000_000,
    feature_angle: float = 30.0,
    strict: bool = False,
    skin: ShapeOption = None,
    before_refining: Optional[Callable[[RefinementEstimate], None]] = None,
) -> Result:
    """Bisects elements near a tool until their edges are short enough.

    For a tool that is finer than the mesh, or for sharp stresses around it. No edge is longer afterwards than
    ``size + gradation * max(0, d - reach)``, where d is its distance from the tool. Always the longest edge of an
    element is bisected, with everything on it, so shapes stay good. Children inherit their parent's groups; a new
    node is in the node groups both ends of its edge are in. Nothing of the input moves; curved second-order
    elements are divided along their own geometry. `mesh` itself is not changed.

    Parameters
    ----------
    mesh : Mesh
        Triangles and tetrahedra, linear or quadratic, where it is refined; anything elsewhere.
    near : Tool, sequence of Tool, or array of shape (n, 3)
        What to refine around: tools, or points.
    size : float
        Longest edge wanted there, in the mesh's unit.
    gradation : float
        How much longer edges may be per unit of distance; 0 refines the whole mesh to `size`.
    reach : float
        `size` holds up to this distance from the tool.
    relax : bool
        Moves new nodes inside the material, in flat faces and on straight edges for better shape.
    max_elements : int
        ToolError rather than a mesh of more elements: a size much too small is easily given.
    feature_angle : float
        Degrees; a skin edge sharper than this is a feature line.
    strict, skin, before_refining
        As for :func:`crack`.

    Returns
    -------
    Result
        The report's quality is that of the elements that were divided. Without any it has a warning.

    Raises
    ------
    ToolError
        A parameter is out of range, or `max_elements` would be passed.
    UnsupportedElementError
        A quadrangle, prism, pyramid or hexahedron with an edge to be bisected has too poor a shape to be split.
    QualityError
        The mesh has flat or inverted elements near the tool.
    """
    engine_mesh = check_mesh(mesh)
    tools, points = _near(near)
    return Result._wrap(
        _engine.refine(
            engine_mesh,
            tools,
            points,
            _arguments.real(size, "size"),
            _arguments.real(gradation, "gradation"),
            _arguments.real(reach, "reach"),
            _arguments.flag(relax, "relax"),
            _arguments.whole(max_elements, "max_elements", 1),
            _arguments.real(feature_angle, "feature_angle"),
            _arguments.flag(strict, "strict"),
            check_skin(skin),
            check_before_refining(before_refining),
        )
    )


def _near(near) -> tuple:
    """(tools, points) of refine()'s parameter."""
    none = np.empty((0, 3))
    given = _arguments.describe(near)
    message = f"near must be a tool, a sequence of tools or an array of points of shape (n, 3), not {given}"
    if isinstance(near, Tool):
        return [near], none
    if isinstance(near, (list, tuple)) and any(isinstance(t, Tool) for t in near):
        return [check_tool(t, f"near[{k}]") for k, t in enumerate(near)], none
    try:
        points = _arguments.coordinates(near, "near")
    except TypeError:
        raise _arguments.about("near", TypeError(message)) from None
    if points.shape == (3,):
        points = points.reshape(1, 3)
    if points.ndim != 2 or points.shape[1] != 3:
        raise _arguments.about("near", TypeError(message))
    return [], points


def reshape(
    mesh: Mesh,
    group: str,
    onto: Optional[Tool] = None,
    by: Optional[Sequence[float]] = None,
    scale: Optional[Tuple[float, Sequence[float]]] = None,
    name: str = "SHAPE",
    feature_angle: float = 30.0,
    preserve: Optional[Iterable[str]] = None,
    strict: bool = False,
) -> Result:
    """Moves a wall: a face to another plane, a hole to another radius or place.

    The wall is what a group covers. The elements around it follow, as far as needed; where they get long, short or poor
    they are divided and merged. All else keeps its number, its coordinates bit for bit and its groups. `mesh` itself is
    not changed.

    Nodes of the wall, mid-side nodes too, come to lie on `onto`; with `by` and `scale` on the plane, cylinder or sphere
    that the wall lies on, moved likewise, each of its smooth parts for itself. Walls of other shapes are carried as
    they are. What of the motion runs along the wall itself does not count: a hole in a plate that is scaled stays
    as long as the plate is thick.

    Surfaces beside the wall, feature lines and borders of groups that end at it stay what they are: the wall's rim
    slides on them, and planes and straight lines go on beyond where they ended. So a face that is moved along its
    normal takes its side walls along in their own planes, and becomes smaller or larger if these are not parallel. A
    wall that is carried as it is cannot do that: surfaces beside it have to run along the motion, or it is an error.

    Parameters
    ----------
    mesh : Mesh
        Shells or solids, linear or quadratic; what is not triangles or tetrahedra near the wall becomes so first.
    group : str
        What is moved. In a solid: a group of faces or facets of solids (also between two groups inside the
        material), or of nodes, which stands for the faces of the skin all of whose corners are members. In a mesh of
        shells: of segments or facets on their border, or of its nodes.
    onto : Tool, optional
        The surface to move it onto: each node goes the shortest way that what it keeps to leaves.
    by : three numbers, optional
        The vector to move it by.
    scale : (factor, centre), optional
        Distances from the point `centre` are multiplied by `factor`. Just one of `onto`, `by` and `scale` is given.
    name : str
        Prefix of the new group ``name_WALL``: the nodes of the wall.
    feature_angle : float
        Degrees; a skin edge sharper than this is a feature line that keeps its shape.
    preserve, strict
        As for :func:`crack`.

    Returns
    -------
    Result
        The report's node sets are WALL and BAND: nodes of the wall, and others that moved or were born (corners). Its
        quality is that of the elements that were changed.

    Raises
    ------
    ToolError
        The group is none of the mesh or covers nothing, none or more than one of `onto`, `by` and `scale` is given, or
        the wall cannot get there: it would meet another, turn elements inside out, or leave what is beside it. The
        error's `parameter` is the one at fault.
    UnsupportedElementError, QualityError, Error, TypeError, ValueError
        As for :func:`crack`.

    Examples
    --------
    >>> wider = reshape(mesh, "HOLE_WALL", onto=Cylinder((6, 5, 0), (0, 0, 1), 2.5))
    >>> longer = reshape(mesh, "END", by=(0.5, 0, 0))
    """
    if onto is not None:
        check_tool(onto, "onto")
    if by is not None:
        by = _arguments.vector(by, "by")
    return _run(
        _engine.reshape,
        mesh,
        _arguments.text(group, "group"),
        onto,
        by,
        _scale(scale),
        _arguments.text(name, "name"),
        check_feature_angle(feature_angle),
        check_preserve(preserve),
        _arguments.flag(strict, "strict"),
    )


def _scale(scale) -> Optional[tuple]:
    """(factor, centre) of reshape()'s parameter."""
    if scale is None:
        return None
    try:
        factor, centre = scale
    except (TypeError, ValueError):
        raise _arguments.about(
            "scale",
            TypeError(f"scale must be a factor and a point, (1.2, (0, 0, 0)), not {_arguments.describe(scale)}"),
        ) from None
    return _arguments.real(factor, "scale"), _arguments.vector(centre, "scale")


class Scalpel:
    """Repeated operations on one mesh.

    Keeps what does not depend on the tool (adjacency, numbering, group measures), so that a further tool
    position costs only its band and the output. The session works on a copy: changing the mesh's groups
    afterwards does not reach it.
    """

    __slots__ = ("_session",)

    def __init__(self, mesh: Mesh):
        self._session = _engine.Scalpel(check_mesh(mesh))

    @property
    def mesh(self) -> Mesh:
        """A copy of the mesh the session works on."""
        return Mesh._wrap(self._session.mesh)

    crack = on_session(crack)
    drill = on_session(drill)
    cut = on_session(cut)
    fillet = on_session(fillet)
    merge = on_session(merge)
    reshape = on_session(reshape)
