# SPDX-License-Identifier: LGPL-2.1-or-later
"""The operators: they take a mesh and a tool, and give a new mesh and a report."""

import os
from dataclasses import dataclass
from typing import Any, Iterable, Optional, Sequence, Union

import numpy as np

from . import _arguments, _engine
from .mesh import Mesh, check_mesh
from .report import Report
from .skin import Shape, check_skin
from .tools import Plane, Tool, check_tool
from .within import Within, check_within

METHODS = ("snap", "deform")

#: Whether elements near the tool are bisected first: None, False or a length.
RefineOption = Union[None, bool, float]
#: The shape a mesh was made from: None, a Shape, or what one is made of.
ShapeOption = Union[None, Shape, str, os.PathLike, Any]


@dataclass(frozen=True, eq=False)
class Result:
    """What an operator returns."""

    mesh: Mesh  #: the new mesh
    report: Report  #: what was done to get it

    @classmethod
    def _wrap(cls, returned) -> "Result":
        mesh, fields = returned
        return cls(Mesh._wrap(mesh), Report._from_engine(fields))


def _common_options(name, method, transition, feature_angle, strict, preserve, band_only, refine, skin) -> tuple:
    _arguments.text(name, "name")
    if method not in METHODS:
        raise ValueError(f"method must be 'snap' or 'deform', not {_arguments.describe(method)}")
    if transition is not None:
        transition = _arguments.whole(transition, "transition", 1)
    feature_angle = _arguments.real(feature_angle, "feature_angle")
    if not 0 < feature_angle < 180:
        raise ValueError(f"feature_angle must be between 0 and 180 degrees, not {feature_angle}")
    if preserve is not None:
        if isinstance(preserve, str) or not isinstance(preserve, Iterable):
            raise TypeError(f"preserve must be a list of group names, not {_arguments.describe(preserve)}")
        preserve = [_arguments.text(group, "preserve") for group in preserve]
    if not isinstance(strict, bool):
        raise TypeError(f"strict must be True or False, not {_arguments.describe(strict)}")
    if not isinstance(band_only, bool):
        raise TypeError(f"band_only must be True or False, not {_arguments.describe(band_only)}")
    return name, method, transition, feature_angle, preserve, strict, band_only, _refine_size(refine), check_skin(skin)


def _refine_size(refine) -> Optional[float]:
    """Nothing: automatic; 0: never; or a length."""
    if refine is None:
        return None
    if refine is False:
        return 0.0
    if refine is True:
        raise TypeError(
            "refine must be None (where the tool is finer than the mesh), False (never) or a length, not True"
        )
    if (size := _arguments.real(refine, "refine")) <= 0:
        raise ValueError(f"refine must be a positive length, not {size}; False is for never")
    return size


def crack(
    mesh: Mesh,
    tool: Tool,
    name: str = "CRACK",
    method: str = "snap",
    transition: Optional[int] = None,
    feature_angle: float = 30.0,
    strict: bool = False,
    preserve: Optional[Iterable[str]] = None,
    band_only: bool = False,
    within: Optional[Within] = None,
    refine: RefineOption = None,
    skin: ShapeOption = None,
) -> Result:
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

    Parameters
    ----------
    mesh : Mesh
        Triangles (shells) and tetrahedra, linear or quadratic, near the tool; anything elsewhere.
    tool : Tool
        For example :class:`Plane`.
    name : str
        Prefix of the new groups: ``name_P`` and ``name_N``, the lip faces on the tool's positive and negative
        side, and, if the sides hang together at some nodes, ``name_FRONT`` with these. The groups' names must be new
        and fit 24 characters.
    method : {"snap", "deform"}
        "snap" moves nodes near the tool onto it and splits what still crosses; it always succeeds on a sound
        mesh. "deform" only moves nodes (the paper, 3.1.1) and may end in QualityError.
    transition : int, optional
        How many rings of nodes around those on the tool may move (the paper's bandwidth i, 3.1.2), 1 to 20. When not
        given: with "deform" as in the paper, the largest distance of an interface node from the tool over the mean edge
        length, at least 2; with "snap", which moves nodes by less than an edge and splits the rest, 2: more do not make
        better elements.
    feature_angle : float
        Degrees; a skin edge sharper than this is a feature line that keeps its shape.
    strict : bool
        For a mesh read from a CalculiX deck: what its cards say is carried over to new nodes and elements, and
        where that is not possible the report warns with file and line. With strict=True that is an Error.
    preserve : names, optional
        The groups whose boundary keeps its shape when nodes move; the boundaries of others may drift, which leaves
        more freedom for the elements' shape. All are kept when not given; ``preserve=()`` keeps none. The skin and
        its feature lines are kept always, and so is what a deck's cards name by number.
    band_only : bool
        For previews: the result's mesh is only the elements near the tool, exactly as the whole operation would make
        them, with their numbers, coordinates and groups. The report is that of the whole operation, but without what
        carrying a CalculiX deck over has to say. With a :class:`Scalpel` this costs little more than the elements near
        the tool.

    within : Disk, Ellipse, Polygon, HalfPlane or CylinderPart, optional
        The part of the tool that cracks; the whole when not given. Its border is the crack front: nodes there lie on it
        and stay single, and ``name_FRONT`` is an element group of segments along it, in order (in a shell mesh, the
        nodes at its tips). It may reach out of the mesh.
    refine : None, False or number
        Whether elements near the tool are bisected first, as :func:`refine` does. None: where the tool is finer than
        the mesh, that is where edges are longer than half its radius (of a crack within a part of a tool, than a
        quarter of that part's width); a plane has no radius, and method "deform" never refines of itself. A number:
        where edges are longer than this; of a crack within a part of a tool, around its front. False: never.
        ``result.report.refinement`` says what was done.
    skin : Shape, path or FreeCAD shape, optional
        The CAD shape the mesh was made from. Nodes of the skin that are born or move come to lie on its faces and
        edges, not on the mesh's triangles, so that the skin gets better than the input's; all others stay where they
        are. Edges between triangles of one face are no feature lines, whatever their angle. What of the skin lies on no
        face of the shape is kept as it is, with a warning.

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
        The band around the tool reaches quadrangles, prisms, pyramids or hexahedra.
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
    return Result._wrap(
        _engine.crack(
            check_mesh(mesh),
            check_tool(tool),
            _common_options(name, method, transition, feature_angle, strict, preserve, band_only, refine, skin),
            check_within(within),
        )
    )


def _tools(tools) -> list:
    if isinstance(tools, Tool):
        return [tools]
    try:
        tools = list(tools)
    except TypeError:
        raise TypeError(
            f"tools must be a tool such as femscalpel.Cylinder, or a sequence of tools, not "
            f"{_arguments.describe(tools)}"
        ) from None
    if not tools:
        raise ValueError("tools is empty; give at least one tool")
    return [check_tool(tool, f"tools[{k}]") for k, tool in enumerate(tools)]


def _depth(depth) -> Optional[float]:
    return None if depth is None else _arguments.real(depth, "depth")


def drill(
    mesh: Mesh,
    tools: Union[Tool, Sequence[Tool]],
    name: str = "HOLE",
    method: str = "snap",
    transition: Optional[int] = None,
    feature_angle: float = 30.0,
    strict: bool = False,
    preserve: Optional[Iterable[str]] = None,
    depth: Optional[float] = None,
    band_only: bool = False,
    refine: RefineOption = None,
    skin: ShapeOption = None,
) -> Result:
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
        Prefix of the new groups: ``name_WALL``, the faces (segments, in a shell mesh) on the tools, normals out of the
        material; with several tools also one for each hole, ``name_WALL1``, ...; ``name_BOTTOM`` of blind holes.
    method : {"snap", "deform"}
        "deform" (the paper, 3.2) moves nodes only, and is for a single through hole.
    transition, feature_angle, strict, preserve, band_only, refine, skin
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
    return Result._wrap(
        _engine.drill(
            check_mesh(mesh),
            _tools(tools),
            _common_options(name, method, transition, feature_angle, strict, preserve, band_only, refine, skin),
            _depth(depth),
        )
    )


def _walls(tool, width, other, bottom) -> tuple:
    """The two positional and the last argument of the engine's cut()."""
    if (width is None) == (other is None):
        raise ValueError("give either width or other: the slot's width around a plane, or its other wall")
    if bottom is not None:
        check_tool(bottom, "bottom")
    if other is not None:
        return check_tool(tool), check_tool(other, "other"), bottom
    if not isinstance(tool, Plane):
        raise TypeError(f"tool must be a femscalpel.Plane when width is given, not {_arguments.describe(tool)}")
    return tool, _arguments.real(width, "width"), bottom


def cut(
    mesh: Mesh,
    tool: Tool,
    width: Optional[float] = None,
    other: Optional[Tool] = None,
    bottom: Optional[Tool] = None,
    name: str = "CUT",
    method: str = "snap",
    transition: Optional[int] = None,
    feature_angle: float = 30.0,
    strict: bool = False,
    preserve: Optional[Iterable[str]] = None,
    band_only: bool = False,
    refine: RefineOption = None,
    skin: ShapeOption = None,
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
    transition, feature_angle, strict, preserve, band_only, refine, skin
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
    return Result._wrap(
        _engine.cut(
            check_mesh(mesh),
            first,
            second,
            _common_options(name, method, transition, feature_angle, strict, preserve, band_only, refine, skin),
            bottom,
        )
    )


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
    strict, skin
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
        An edge to be bisected is one of a quadrangle, prism, pyramid or hexahedron.
    QualityError
        The mesh has flat or inverted elements near the tool.
    """
    engine_mesh = check_mesh(mesh)
    tools, points = _near(near)
    for name, value in (("relax", relax), ("strict", strict)):
        if not isinstance(value, bool):
            raise TypeError(f"{name} must be True or False, not {_arguments.describe(value)}")
    return Result._wrap(
        _engine.refine(
            engine_mesh,
            tools,
            points,
            _arguments.real(size, "size"),
            _arguments.real(gradation, "gradation"),
            _arguments.real(reach, "reach"),
            relax,
            _arguments.whole(max_elements, "max_elements", 1),
            _arguments.real(feature_angle, "feature_angle"),
            strict,
            check_skin(skin),
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
        points = np.array(near, dtype=np.float64)
    except (TypeError, ValueError):
        raise TypeError(message) from None
    if points.shape == (3,):
        points = points.reshape(1, 3)
    if points.ndim != 2 or points.shape[1] != 3:
        raise TypeError(message)
    return [], points


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

    def crack(
        self,
        tool: Tool,
        name: str = "CRACK",
        method: str = "snap",
        transition: Optional[int] = None,
        feature_angle: float = 30.0,
        strict: bool = False,
        preserve: Optional[Iterable[str]] = None,
        band_only: bool = False,
        within: Optional[Within] = None,
        refine: RefineOption = None,
        skin: ShapeOption = None,
    ) -> Result:
        """As :func:`femscalpel.crack`, on the session's mesh."""
        return Result._wrap(
            self._session.crack(
                check_tool(tool),
                _common_options(name, method, transition, feature_angle, strict, preserve, band_only, refine, skin),
                check_within(within),
            )
        )

    def drill(
        self,
        tools: Union[Tool, Sequence[Tool]],
        name: str = "HOLE",
        method: str = "snap",
        transition: Optional[int] = None,
        feature_angle: float = 30.0,
        strict: bool = False,
        preserve: Optional[Iterable[str]] = None,
        depth: Optional[float] = None,
        band_only: bool = False,
        refine: RefineOption = None,
        skin: ShapeOption = None,
    ) -> Result:
        """As :func:`femscalpel.drill`, on the session's mesh."""
        return Result._wrap(
            self._session.drill(
                _tools(tools),
                _common_options(name, method, transition, feature_angle, strict, preserve, band_only, refine, skin),
                _depth(depth),
            )
        )

    def cut(
        self,
        tool: Tool,
        width: Optional[float] = None,
        other: Optional[Tool] = None,
        bottom: Optional[Tool] = None,
        name: str = "CUT",
        method: str = "snap",
        transition: Optional[int] = None,
        feature_angle: float = 30.0,
        strict: bool = False,
        preserve: Optional[Iterable[str]] = None,
        band_only: bool = False,
        refine: RefineOption = None,
        skin: ShapeOption = None,
    ) -> Result:
        """As :func:`femscalpel.cut`, on the session's mesh."""
        first, second, bottom = _walls(tool, width, other, bottom)
        return Result._wrap(
            self._session.cut(
                first,
                second,
                _common_options(name, method, transition, feature_angle, strict, preserve, band_only, refine, skin),
                bottom,
            )
        )
