# SPDX-License-Identifier: LGPL-2.1-or-later
"""The operators: they take a mesh and a tool, and give a new mesh and a report."""

from dataclasses import dataclass
from typing import Iterable, Optional

from . import _arguments, _engine
from .mesh import Mesh, check_mesh
from .report import Report
from .tools import Tool, check_tool

METHODS = ("snap", "deform")


@dataclass(frozen=True, eq=False)
class Result:
    """What an operator returns."""

    mesh: Mesh  #: the new mesh
    report: Report  #: what was done to get it

    @classmethod
    def _wrap(cls, returned) -> "Result":
        mesh, fields = returned
        return cls(Mesh._wrap(mesh), Report._from_engine(fields))


def _crack_options(name, method, transition, feature_angle, strict, preserve, band_only) -> tuple:
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
    return name, method, transition, feature_angle, preserve, strict, band_only


def crack(mesh: Mesh, tool: Tool, name: str = "CRACK", method: str = "snap", transition: Optional[int] = None,
          feature_angle: float = 30.0, strict: bool = False, preserve: Optional[Iterable[str]] = None,
          band_only: bool = False) -> Result:
    """Cracks a mesh along the whole of a tool.

    Element faces (edges, in a shell mesh) are brought onto the tool, then each side gets its own copy of the
    nodes on it. The lips are coincident; the original nodes stay with the negative side. Only elements near the
    tool change: everything else keeps its number, its coordinates bit for bit and its groups. Every group of
    the input is in the result. `mesh` itself is not changed.

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
        How many rings of elements around the tool may move; computed when not given.
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

    Returns
    -------
    Result
        ``result.mesh`` and ``result.report``; ``print(result.report.to_text())`` shows the group table.

    Raises
    ------
    ToolError
        The name is bad or taken, `preserve` names a group the mesh does not have, or the tool misses the mesh.
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
    return Result._wrap(_engine.crack(check_mesh(mesh), check_tool(tool),
                                      *_crack_options(name, method, transition, feature_angle, strict, preserve, band_only)))


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

    def crack(self, tool: Tool, name: str = "CRACK", method: str = "snap", transition: Optional[int] = None,
              feature_angle: float = 30.0, strict: bool = False, preserve: Optional[Iterable[str]] = None,
              band_only: bool = False) -> Result:
        """As :func:`femscalpel.crack`, on the session's mesh."""
        return Result._wrap(self._session.crack(
            check_tool(tool), *_crack_options(name, method, transition, feature_angle, strict, preserve, band_only)))
