# SPDX-License-Identifier: LGPL-2.1-or-later
"""Signatures and docstrings made from tables, for functions that take the same arguments."""

import functools
import inspect
import textwrap
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Argument:
    """An argument that functions take from a table."""

    name: str
    default: Any
    kind: str  #: what it may be, for docstrings
    text: str  #: likewise; empty where every function has its own
    annotation: Any = inspect.Parameter.empty


def bind(function, signature, args, kwargs) -> inspect.BoundArguments:
    """The arguments of a call; TypeError that names `function`, a name, where they do not fit."""
    try:
        return signature.bind(*args, **kwargs)
    except TypeError as error:
        raise TypeError(f"{function}() {error}") from None


def takes(after=None, **tables):
    """Gives a function the arguments of tables, lists of Argument, after its own.

    For each table the function has a keyword of that name, which gets a dict of the values by the arguments' names, and
    a line ``{name of the table}`` in its docstring. `after` says of an argument behind which other one it stands, where
    that is another place.
    """

    def decorate(function):
        whole = inspect.signature(function)
        own = [p for p in whole.parameters.values() if p.name not in tables]
        taken = [a for table in tables.values() for a in table]
        signature = whole.replace(parameters=_in_order(own, taken, after or {}))

        @functools.wraps(function)
        def taking(*args, **kwargs):
            bound = bind(function.__name__, signature, args, kwargs)
            bound.apply_defaults()
            values = bound.arguments
            taken = {key: {a.name: values.pop(a.name) for a in table} for key, table in tables.items()}
            return function(**values, **taken)

        taking.__signature__ = signature
        del taking.__wrapped__
        # Python from 3.13 on takes the indentation away itself.
        taking.__doc__ = inspect.cleandoc(function.__doc__)
        for key, table in tables.items():
            taking.__doc__ = taking.__doc__.replace(f"{{{key}}}\n", "".join(map(_described, table)))
        return taking

    return decorate


def _in_order(own, taken, after):
    """Parameters of a signature: `own`, then `taken`, each followed by those that stand after it."""
    kind = inspect.Parameter.POSITIONAL_OR_KEYWORD
    waiting = [p.replace(kind=kind) for p in own] + [
        inspect.Parameter(a.name, kind, default=a.default, annotation=a.annotation) for a in taken
    ]
    out = []

    def place(parameter):
        out.append(parameter)
        for p in waiting:
            if after.get(p.name) == parameter.name:
                place(p)

    for parameter in waiting:
        if parameter.name not in after:
            place(parameter)
    return out


def _described(argument):
    if not argument.text:
        return ""
    lines = textwrap.wrap(argument.text, 112)
    return "".join([f"{argument.name} : {argument.kind}\n", *(f"    {line}\n" for line in lines)])
