#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes the type stub of the compiled module, src/python/femscalpel/_engine.pyi, from what the module says of itself.

    PYTHONPATH=build/release/Mod/FemScalpel /usr/bin/python3 src/bindings/make_stub.py

pybind11 puts the signature of every function into its docstring: names where the binding has py::arg (a parameter
without a name can only be given by its place), defaults, and types, which its versions spell differently: the stub is
the same from each. What C++ types leave open - a dict of what? may it
be None? - is in the tables here. tests/python/test_stub.py compares stub and module.
"""

import ast
import importlib
import pathlib
import re

STUB = pathlib.Path(__file__).resolve().parents[1] / "python" / "femscalpel" / "_engine.pyi"

HEADER = """\
# SPDX-License-Identifier: LGPL-2.1-or-later
# Made by src/bindings/make_stub.py. The package femscalpel says what everything is for.
import os
from collections.abc import Callable, Sequence
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

"""

#: Classes that bindings take by pointer, which may be None.
MAY_BE_NONE = ("CadShape", "Within")

#: What an operator returns, of which the module says "tuple": mesh and report.
RESULT = "tuple[Mesh, dict[str, Any]]"
BY_TYPE = "dict[str, NDArray[np.{}]]"
#: "function.parameter" or "function.return" -> its type, where the module's own says less.
MORE_EXACT = {
    "Error.parameter.return": "str | None",
    "Mesh.cells.return": BY_TYPE.format("int64"),
    "Mesh.cell_ids.return": BY_TYPE.format("int64"),
    "Mesh.mean_ratios.return": BY_TYPE.format("float64"),
    "Mesh.measures.return": BY_TYPE.format("float64"),
    "cell_types.return": "dict[str, tuple[int, int, int]]",
    "cut.bottom": "Tool | None",
    "elementary_groups.return": "list[tuple[str, int, tuple[str, ...], NDArray[np.int64]]]",
    "pieces.return": "list[dict[str, Any]]",
    "pieces.changed": "Mesh | None",
    "virtual_boundaries.return": (
        "list[\n    tuple[dict[str, NDArray[np.int64]], dict[str, NDArray[np.int64]], dict[str, NDArray[np.int64]], "
        "NDArray[np.int64]]\n]"
    ),
}

#: Spellings of types by pybind11 2.13 and 3, in this order, and what 2.10 writes, which `python_type` reads.
NEWER = [
    (r"typing\.(?=[A-Z])(?<!numpy\.typing\.)|collections\.abc\.", ""),
    (r"\bSupports(Float|Int) \| SupportsIndex", lambda match: match[1].lower()),
    (r"os\.PathLike \| str \| bytes", "os.PathLike"),
    (
        r"Annotated\[numpy\.typing\.ArrayLike, (numpy\.\w+)\]|numpy\.typing\.NDArray\[(numpy\.\w+)\]",
        r"numpy.ndarray[\1\2]",
    ),
    (r'Annotated\[(?:list|Sequence)\[(\w+)\], "?FixedSize\((\d+)\)"?\]', r"List[\1[\2]]"),
    (r"\b(?:list|Sequence)\[", "List["),
    (r"\b(tuple|dict)\[", lambda match: match[1].capitalize() + "["),
    (r"^(.*) \| None$", r"Optional[\1]"),
]


def split(text):
    """Parts of `text` between commas that are in no brackets or quotes."""
    parts, depth, quote = [""], 0, ""
    for c in text:
        if quote:
            quote = "" if c == quote else quote
        elif c in "'\"":
            quote = c
        depth += (c in "[(") - (c in "])") if not quote else 0
        if c == "," and depth == 0 and not quote:
            parts.append("")
        else:
            parts[-1] += c
    return [p.strip() for p in parts if p.strip()]


def signatures(name, doc):
    """[(parameters, return type)] of a function of the module, one for each overload; parameters as text."""
    found = re.findall(rf"^(?:\d+\. )?{re.escape(name)}\((.*)\) -> (.*)$", doc or "", re.M)
    if not found:
        raise ValueError(f"{name} has no signature in its docstring: {doc!r}")
    return [(split(parameters), returned) for parameters, returned in found if parameters != "*args, **kwargs"]


def python_type(text, given):
    """The type that pybind11 calls `text`; `given` to the function, or returned by it."""
    text = text.strip().replace("femscalpel._engine.", "")
    for newer, older in NEWER:
        text = re.sub(newer, older, text)
    if text == "tuple" and not given:
        return RESULT
    if text == "os.PathLike":
        return "str | os.PathLike[str]"
    if array := re.fullmatch(r"numpy\.ndarray\[numpy\.(\w+)\]", text):
        return "ArrayLike" if given else f"NDArray[np.{array[1]}]"
    if re.fullmatch(r"List\[float\[\d+\]\]", text):  # of fixed length; the package makes tuples of what is returned
        return "Sequence[float]"
    if outer := re.fullmatch(r"(List|Tuple|Optional|Dict)\[(.*)\]", text):
        inner = ", ".join(python_type(part, given) for part in split(outer[2]))
        if outer[1] == "Optional":
            return f"{inner} | None"
        return ("Sequence" if given and outer[1] == "List" else outer[1].lower()) + f"[{inner}]"
    if function := re.fullmatch(r"Callable\[\[(.*)\], (.*)\]", text):
        taken = ", ".join(python_type(part, False) for part in split(function[1]))
        return f"Callable[[{taken}], {python_type(function[2], given)}] | None"
    if re.fullmatch(r"[A-Za-z_]\w*", text):
        return f"{text} | None" if given and text in MAY_BE_NONE else text
    raise ValueError(f"a type that this script does not know: {text!r}")


def default(text):
    """The default value `text` as a stub has it: what is no literal is `...`."""
    try:
        ast.literal_eval(text)
    except (SyntaxError, ValueError):
        return "..."
    return text


def function(name, doc, used, owner=""):
    """Lines of a function's stub; keys of MORE_EXACT that it has are added to `used`."""

    def exact(key, otherwise):
        used.add(f"{owner}{name}.{key}")
        return MORE_EXACT.get(f"{owner}{name}.{key}", otherwise)

    overloads, lines = signatures(name, doc), []
    for parameters, returned in overloads:
        names, by_place = [], 0
        for k, parameter in enumerate(parameters):
            head, _, value = parameter.partition(" = ")
            called, _, kind = head.partition(": ")
            if owner and k == 0:
                names.append("self")
                continue
            names.append(
                f"{called}: {exact(called, python_type(kind, True))}" + (f" = {default(value)}" if value else "")
            )
            if re.fullmatch(r"arg\d+", called):
                by_place = len(names)
        if by_place:
            names.insert(by_place, "/")
        lines += ["@overload"] if len(overloads) > 1 else []
        returns = exact("return", python_type(returned, False))
        line = f"def {name}({', '.join(names)}) -> {returns}: ..."
        if len(line) > 110 and names:  # one parameter a line, as black does
            line = f"def {name}(\n    " + ",\n    ".join(names) + f",\n) -> {returns}: ..."
        lines += line.split("\n")
    return lines


def property_lines(owner, name, value, used):
    """Lines of a property's stub."""
    key = f"{owner}{name}.return"
    used.add(key)
    returned = MORE_EXACT.get(key, python_type(value.fget.__doc__.split("\n")[0].rpartition(" -> ")[2], False))
    lines = ["@property", f"def {name}(self) -> {returned}: ..."]
    if value.fset:
        lines += [f"@{name}.setter", f"def {name}(self, value: {returned}) -> None: ..."]
    return lines


def class_lines(kind, used):
    """Lines of a class' stub."""
    bases = [b.__name__ for b in kind.__bases__ if b.__name__ not in ("pybind11_object", "object")]
    body = []
    for name, value in sorted(vars(kind).items()):
        if isinstance(value, property):
            body += property_lines(f"{kind.__name__}.", name, value, used)
        elif (name == "__init__" or not name.startswith("_")) and " -> " in (value.__doc__ or ""):
            body += function(name, value.__doc__, used, f"{kind.__name__}.")
    head = f"class {kind.__name__}" + (f"({', '.join(bases)})" if bases else "") + ":"
    return [head, *("    " + line for line in body)] if body else [f"{head} ..."]


def stub(module):
    """The text of the stub of `module`."""
    public = [(name, value) for name, value in sorted(vars(module).items()) if not name.startswith("_")]
    classes = [value for _, value in public if isinstance(value, type)]
    classes.sort(key=lambda kind: (len(kind.__mro__), kind.__name__))  # bases first
    used, parts = set(), []
    parts += ["\n".join(class_lines(kind, used)) for kind in classes]
    parts += ["\n".join(function(n, v.__doc__, used)) for n, v in public if not isinstance(v, type)]
    if stale := sorted(set(MORE_EXACT) - used):
        raise ValueError(f"MORE_EXACT in {__file__} names what the module does not have: {', '.join(stale)}")
    return HEADER + "\n" + "\n\n".join(parts) + "\n"


if __name__ == "__main__":
    STUB.write_text(stub(importlib.import_module("femscalpel._engine")))
