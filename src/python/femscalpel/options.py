# SPDX-License-Identifier: LGPL-2.1-or-later
"""What every operator lets its user choose: one row of `OPTIONS` for each option.

An option is a member of `OperatorOptions` in the engine (operators/options.h), bound under its name, and a row here;
all operators and the methods of a session have it then, in their signatures and docstrings.
"""

import functools
import inspect
import os
import textwrap
from dataclasses import dataclass
from typing import Any, Callable, Iterable, Optional, Union

from . import _arguments, _engine
from .skin import Shape, check_skin

METHODS = ("snap", "deform")

#: Whether elements near the tool are bisected first: None, False or a length.
RefineOption = Union[None, bool, float]
#: The shape a mesh was made from: None, a Shape, or what one is made of.
ShapeOption = Union[None, Shape, str, os.PathLike, Any]


def _method(value):
    if value not in METHODS:
        raise _arguments.about(
            "method", ValueError(f"method must be 'snap' or 'deform', not {_arguments.describe(value)}")
        )
    return value


def _transition(value):
    return None if value is None else _arguments.whole(value, "transition", 1)


def _feature_angle(value):
    value = _arguments.real(value, "feature_angle")
    if not 0 < value < 180:
        raise _arguments.about(
            "feature_angle", ValueError(f"feature_angle must be between 0 and 180 degrees, not {value}")
        )
    return value


def _preserve(value):
    if value is None:
        return None
    if isinstance(value, str) or not isinstance(value, Iterable):
        raise _arguments.about(
            "preserve", TypeError(f"preserve must be a list of group names, not {_arguments.describe(value)}")
        )
    return [_arguments.text(group, "preserve") for group in value]


def _refine(value):
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
class Option:
    """A choice that all operators offer."""

    name: str  #: of the parameter, and of the engine's member
    annotation: Any
    default: Any
    check: Callable[[Any], Any]  #: what the engine takes; raises TypeError or ValueError that names the parameter
    kind: str  #: what it may be, for the docstrings
    text: str  #: likewise; empty if every operator has its own


OPTIONS = (
    Option("name", str, None, lambda value: _arguments.text(value, "name"), "str", ""),
    Option(
        "method",
        str,
        "snap",
        _method,
        '{"snap", "deform"}',
        '"snap" moves nodes near the tool onto it and splits what still crosses; it always succeeds on a sound mesh. '
        '"deform" only moves nodes (the paper, 3.1.1) and may end in QualityError.',
    ),
    Option(
        "transition",
        Optional[int],
        None,
        _transition,
        "int, optional",
        "How many rings of nodes around those on the tool may move (the paper's bandwidth i, 3.1.2), 1 to 20. When not "
        'given: with "deform" as in the paper, the largest distance of an interface node from the tool over the mean '
        'edge length, at least 2; with "snap", which moves nodes by less than an edge and splits the rest, 2: more do '
        "not make better elements.",
    ),
    Option(
        "feature_angle",
        float,
        30.0,
        _feature_angle,
        "float",
        "Degrees; a skin edge sharper than this is a feature line that keeps its shape.",
    ),
    Option(
        "strict",
        bool,
        False,
        lambda value: _arguments.flag(value, "strict"),
        "bool",
        "For a mesh read from a CalculiX deck: what its cards say is carried over to new nodes and elements, and where "
        "that is not possible the report warns with file and line. With strict=True that is an Error.",
    ),
    Option(
        "preserve",
        Optional[Iterable[str]],
        None,
        _preserve,
        "names, optional",
        "The groups whose boundary keeps its shape when nodes move; the boundaries of others may drift, which leaves "
        "more freedom for the elements' shape. All are kept when not given; ``preserve=()`` keeps none. The skin and "
        "its feature lines are kept always, and so is what a deck's cards name by number.",
    ),
    Option(
        "band_only",
        bool,
        False,
        lambda value: _arguments.flag(value, "band_only"),
        "bool",
        "For previews: the result's mesh is only the elements near the tool, exactly as the whole operation would make "
        "them, with their numbers, coordinates and groups. The report is that of the whole operation, but without what "
        "carrying a CalculiX deck over has to say. With a :class:`Scalpel` this costs little more than the elements "
        "near the tool.",
    ),
    Option(
        "refine",
        RefineOption,
        None,
        _refine,
        "None, False or number",
        "Whether elements near the tool are bisected first, as :func:`refine` does. None: where the tool is finer than "
        "the mesh, that is where edges are longer than half its radius (of a crack within a part of a tool, than a "
        'quarter of that part\'s width); a plane has no radius, and method "deform" never refines of itself. A number: '
        "where edges are longer than this; of a crack within a part of a tool, around its front. False: never. "
        "``result.report.refinement`` says what was done.",
    ),
    Option(
        "skin",
        ShapeOption,
        None,
        check_skin,
        "Shape, path or FreeCAD shape, optional",
        "The CAD shape the mesh was made from: a :class:`Shape`, a path or a FreeCAD shape. Nodes of the skin that are "
        "born or move come to lie on its faces and edges, not on the mesh's triangles, so that the skin gets better "
        "than the input's; all others stay where they are. Edges between triangles of one face are no feature lines, "
        "whatever their angle. What of the skin lies on no face of the shape is kept as it is, with a warning.",
    ),
)


def _engine_options(values) -> _engine.Options:
    """Takes the options out of the arguments of a call."""
    out = _engine.Options()
    for option in OPTIONS:
        setattr(out, option.name, option.check(values.pop(option.name)))
    return out


def _parameters(own, name, after):
    """The parameters of an operator with `own` and all options: those of `own` that are in `after` follow the option
    that it says, the others come first."""
    out = [p for p in own if p.name not in after]
    for option in OPTIONS:
        default = name if option.name == "name" else option.default
        out.append(
            inspect.Parameter(
                option.name, inspect.Parameter.POSITIONAL_OR_KEYWORD, default=default, annotation=option.annotation
            )
        )
        out += [p for p in own if after.get(p.name) == option.name]
    return [p.replace(kind=inspect.Parameter.POSITIONAL_OR_KEYWORD) for p in out]


def takes_options(name, after=None):
    """Makes an operator of a function that takes the engine's options as its last argument, `options`.

    `name` is the default of the option of that name, `after` says behind which option a parameter of the function's own
    stands in the signature, where that is not the beginning. Arguments are checked, options first.
    """

    def decorate(function):
        own = [p for p in inspect.signature(function).parameters.values() if p.name != "options"]
        signature = inspect.Signature(
            _parameters(own, name, after or {}), return_annotation=inspect.signature(function).return_annotation
        )

        @functools.wraps(function)
        def operator(*args, **kwargs):
            try:
                bound = signature.bind(*args, **kwargs)
            except TypeError as error:
                raise TypeError(f"{function.__name__}() {error}") from None
            bound.apply_defaults()
            options = _engine_options(bound.arguments)
            return function(**bound.arguments, options=options)

        operator.__signature__ = signature
        del operator.__wrapped__
        if operator.__doc__:
            operator.__doc__ = operator.__doc__.replace("    {options}\n", _documentation())
        return operator

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


def _documentation() -> str:
    """The options that have a text (the others every operator describes itself), as numpydoc parameters."""
    lines = []
    for option in OPTIONS:
        if option.text:
            lines.append(f"    {option.name} : {option.kind}\n")
            lines += [f"        {line}\n" for line in textwrap.wrap(option.text, 112)]
    return "".join(lines)
