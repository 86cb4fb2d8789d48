# SPDX-License-Identifier: LGPL-2.1-or-later
"""What every operator lets its user choose: one row of `OPTIONS` for each option.

An option is a member of `OperatorOptions` in the engine (operators/options.h), bound under its name, and a row here;
all operators and the methods of a session have it then, in their signatures and docstrings.
"""

import dataclasses
import functools
import inspect
import os
from dataclasses import dataclass
from typing import Any, Callable, Iterable, Optional, Union

from . import _arguments, _engine
from .signatures import Argument, takes
from .skin import Shape, check_skin

METHODS = ("snap", "deform")

#: Whether elements near the tool are bisected first: None, False or a length.
RefineOption = Union[None, bool, float]
#: The shape a mesh was made from: None, a Shape, or what one is made of.
ShapeOption = Union[None, Shape, str, os.PathLike, Any]


def _method(value):
    if not isinstance(value, str) or value not in METHODS:
        raise _arguments.about(
            "method", ValueError(f"method must be 'snap' or 'deform', not {_arguments.describe(value)}")
        )
    return value


def _transition(value):
    return None if value is None else _arguments.whole(value, "transition", 1, 20)


def check_feature_angle(value):
    """Degrees, or ValueError."""
    value = _arguments.real(value, "feature_angle")
    if not 0 < value < 180:
        raise _arguments.about(
            "feature_angle", ValueError(f"feature_angle must be between 0 and 180 degrees, not {value}")
        )
    return value


def check_preserve(value):
    """A list of names or None, or TypeError."""
    if value is None:
        return None
    try:
        names = None if isinstance(value, str) else list(value)
    except TypeError:
        names = None
    if names is None:
        raise _arguments.about(
            "preserve", TypeError(f"preserve must be a list of group names, not {_arguments.describe(value)}")
        )
    for k, name in enumerate(names):
        if not isinstance(name, str):
            raise _arguments.about(
                "preserve", TypeError(f"preserve[{k}] must be the name of a group, not {_arguments.describe(name)}")
            )
    return [_arguments.text(name, "preserve") for name in names]


def check_before_refining(value):
    """A callable or None, or TypeError."""
    if value is not None and not callable(value):
        raise _arguments.about(
            "before_refining", TypeError(f"before_refining must be callable, not {_arguments.describe(value)}")
        )
    return value


def check_refine(value):
    """Nothing: automatic; 0: never; or a length."""
    if value is None:
        return None
    if value is False:
        return 0.0
    if value is True:
        raise _arguments.about(
            "refine",
            TypeError(
                "refine must be None (where the tool is finer than the mesh), False (never) or a length, not True"
            ),
        )
    if (size := _arguments.real(value, "refine")) <= 0:
        raise _arguments.about(
            "refine", ValueError(f"refine must be a positive length, not {size}; False is for never")
        )
    return size


@dataclass(frozen=True)
class Option(Argument):
    """A choice that all operators offer: a parameter, and a member of the engine's options of the same name."""

    #: What the engine takes; raises TypeError or ValueError that names the parameter.
    check: Callable[[Any], Any] = None


OPTIONS = (
    Option(
        "name",
        None,
        "str",
        "",
        str,
        lambda value: _arguments.text(value, "name"),
    ),
    Option(
        "method",
        "snap",
        '{"snap", "deform"}',
        '"snap" moves nodes near the tool onto it and splits what still crosses; it always succeeds on a sound mesh. '
        '"deform" only moves nodes (the paper, 3.1.1) and may end in QualityError.',
        str,
        _method,
    ),
    Option(
        "transition",
        None,
        "int, optional",
        "How many rings of nodes around those on the tool may move (the paper's bandwidth i, 3.1.2), 1 to 20. When not "
        'given: with "deform" as in the paper, the largest distance of an interface node from the tool over the mean '
        'edge length, at least 2; with "snap", which moves nodes by less than an edge and splits the rest, 2: more do '
        "not make better elements.",
        Optional[int],
        _transition,
    ),
    Option(
        "feature_angle",
        30.0,
        "float",
        "Degrees; a skin edge sharper than this is a feature line that keeps its shape.",
        float,
        check_feature_angle,
    ),
    Option(
        "strict",
        False,
        "bool",
        "For a mesh read from a CalculiX deck: what its cards say is carried over to new nodes and elements, and where "
        "that is not possible the report warns with file and line. With strict=True that is an Error.",
        bool,
        lambda value: _arguments.flag(value, "strict"),
    ),
    Option(
        "preserve",
        None,
        "names, optional",
        "The groups whose boundary keeps its shape when nodes move; the boundaries of others may drift, which leaves "
        "more freedom for the elements' shape. All are kept when not given; ``preserve=()`` keeps none. The skin and "
        "its feature lines are kept always, and so is what a deck's cards name by number.",
        Optional[Iterable[str]],
        check_preserve,
    ),
    Option(
        "band_only",
        False,
        "bool",
        "For previews: the result's mesh is only the elements near the tool, exactly as the whole operation would make "
        "them, with their numbers, coordinates and groups (what was refined or converted farther off is left out). The "
        "report is that of the whole operation, but without what carrying a CalculiX deck over has to say. With a "
        ":class:`Scalpel` this costs little more than the elements near the tool.",
        bool,
        lambda value: _arguments.flag(value, "band_only"),
    ),
    Option(
        "refine",
        None,
        "None, False or number",
        "Whether elements near the tool are bisected first, as :func:`refine` does. None: where the tool is finer than "
        "the mesh, that is where edges are longer than half its radius (of a crack within a part of a tool, than a "
        'quarter of that part\'s width); a plane has no radius, and method "deform" never refines of itself. A number: '
        "where edges are longer than this; of a crack within a part of a tool, around its front. False: never. "
        "``result.report.refinement`` says what was done.",
        RefineOption,
        check_refine,
    ),
    Option(
        "skin",
        None,
        "Shape, path or FreeCAD shape, optional",
        "The CAD shape the mesh was made from: a :class:`Shape`, a path or a FreeCAD shape. Nodes of the skin that are "
        "born or move come to lie on its faces and edges, not on the mesh's triangles, so that the skin gets better "
        "than the input's; all others stay where they are. Edges between triangles of one face are no feature lines, "
        "whatever their angle. What of the skin lies on no face of the shape is kept as it is, with a warning.",
        ShapeOption,
        check_skin,
    ),
    Option(
        "second_order",
        False,
        "bool",
        "Of hexahedra, prisms and pyramids of first order in a CalculiX deck: what a crack, a hole or a cut makes of "
        "them, tetrahedra that would be stiffer in bending, becomes second order, with one ring of elements around, "
        "and an ``*EQUATION`` card keeps the edges straight where elements of first order are beside these.",
        bool,
        lambda value: _arguments.flag(value, "second_order"),
    ),
    Option(
        "before_refining",
        None,
        "callable, optional",
        "Called with a :class:`RefinementEstimate` each time before elements are bisected first: what that comes to. "
        "An exception that it raises ends the operation.",
        Optional[Callable[[Any], None]],
        check_before_refining,
    ),
)


def _engine_options(values) -> _engine.Options:
    """The engine's options of their values by name."""
    out = _engine.Options()
    for option in OPTIONS:
        setattr(out, option.name, option.check(values[option.name]))
    return out


def takes_options(name, after=None):
    """Makes an operator of a function that takes the engine's options as its keyword `options`.

    `name` is the default of the option of that name; `after` as for femscalpel.signatures.takes(). Options are checked
    before the other arguments.
    """
    table = [dataclasses.replace(o, default=name) if o.name == "name" else o for o in OPTIONS]

    def decorate(function):
        @functools.wraps(function)
        def operator(*args, options, **kwargs):
            return function(*args, options=_engine_options(options), **kwargs)

        return takes(after, options=table)(operator)

    return decorate


def on_session(operator):
    """The method of a session that an operator is."""

    @functools.wraps(operator)
    def method(self, *args, **kwargs):
        return operator(self, *args, **kwargs)

    first, *others = inspect.signature(operator).parameters.values()
    method.__signature__ = inspect.signature(operator).replace(
        parameters=[first.replace(name="self", annotation=inspect.Parameter.empty), *others]
    )
    del method.__wrapped__
    method.__doc__ = f"As :func:`femscalpel.{operator.__name__}`, on the session's mesh."
    return method
