# SPDX-License-Identifier: LGPL-2.1-or-later
"""The type stub of the compiled module says what the module has: names, parameters, defaults."""

import ast
import pathlib
import re
import sys
import types

import pytest

import femscalpel
from femscalpel import _engine

ROOT = pathlib.Path(__file__).resolve().parents[2]
STUB = ROOT / "src" / "python" / "femscalpel" / "_engine.pyi"
sys.path.insert(0, str(ROOT / "src" / "bindings"))
import make_stub

REMEDY = f"run src/bindings/make_stub.py with {pathlib.Path(femscalpel.__file__).parents[1]} in PYTHONPATH"


#: Three numbers, as pybind11 3 says that they may be given.
NUMBERS = "typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], " '"FixedSize(3)"]'

INNERMOST = r"[\[(][^\[\]()]*[\])]"


def hidden(match):
    return "_" * len(match[0])


def module_signatures(name, doc):
    """[[(parameter, default or None), ...], ...] of what pybind11 writes into a docstring, an entry for each overload.

    What stands in quotes and brackets is hidden first, so that each comma left is one between parameters.
    """
    out = []
    for line in re.findall(rf"^(?:\d+\. )?{name}\((.*)\) -> ", doc, re.M):
        if line == "*args, **kwargs":
            continue
        bare = re.sub(r"'[^']*'", hidden, line)
        while re.search(INNERMOST, bare):
            bare = re.sub(INNERMOST, hidden, bare)
        parameters = []
        for part in re.finditer(r"[^,]+", bare):
            called, value = line[slice(*part.span())].split(":")[0].strip(), part[0].find(" = ")
            parameters.append((called, None if value < 0 else line[part.start() + value + 3 : part.end()]))
        out.append(parameters)
    return out


def stub_signatures(body, name):
    """The same of a stub, in which parameters without a name of their own must be positional only."""
    out = []
    for node in body:
        if not isinstance(node, ast.FunctionDef) or node.name != name:
            continue
        a = node.args
        assert not (a.vararg or a.kwarg or a.kwonlyargs)
        for argument in a.args:
            assert not re.fullmatch(r"arg\d+", argument.arg), f"{name}: {argument.arg} can be given by place only"
        every = a.posonlyargs + a.args
        values = [None] * (len(every) - len(a.defaults)) + [ast.unparse(d) for d in a.defaults]
        for argument in every:
            assert argument.annotation or argument.arg == "self", f"{name}: {argument.arg} has no type"
        assert node.returns, f"{name}: no return type"
        out.append([(argument.arg, value) for argument, value in zip(every, values)])
    return out


def differences(module, tree):
    """What is not the same in module (or class) and stub, as text."""
    out = []
    stubbed = {node.name: node for node in tree.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
    has = {n: v for n, v in vars(module).items() if not n.startswith("_") or (n == "__init__" and is_bound(v))}
    for name in sorted(set(has) - set(stubbed)):
        out.append(f"{name} is not in the stub")
    for name in sorted(set(stubbed) - set(has)):
        out.append(f"{name} is in the stub only")
    for name in sorted(set(has) & set(stubbed)):
        value = has[name]
        if isinstance(value, type):
            bases = [b.__name__ for b in value.__bases__ if b.__name__ not in ("pybind11_object", "object")]
            if [ast.unparse(b) for b in stubbed[name].bases] != bases:
                out.append(f"{name} has the bases {bases}")
            out += [f"{name}: {text}" for text in differences(value, stubbed[name])]
        elif isinstance(value, property):
            kinds = {ast.unparse(d) for n in tree.body if getattr(n, "name", "") == name for d in n.decorator_list}
            if kinds != ({"property", f"{name}.setter"} if value.fset else {"property"}):
                out.append(f"{name} is a property, {'' if value.fset else 'not '}to be set")
        else:
            real, written = module_signatures(name, value.__doc__), stub_signatures(tree.body, name)
            if real != written:
                out.append(f"{name} has the parameters {real}, in the stub {written}")
    return out


def is_bound(value):
    return "Initialize self" not in (value.__doc__ or "")


def test_stub_has_every_name_parameter_and_default():
    assert differences(_engine, ast.parse(STUB.read_text())) == [], REMEDY


def test_stub_is_what_the_script_makes():
    assert STUB.read_text() == make_stub.stub(_engine), REMEDY


def test_stub_is_beside_the_package():
    package = pathlib.Path(femscalpel.__file__).parent
    assert (package / "py.typed").is_file()
    assert (package / "_engine.pyi").read_text() == STUB.read_text()


def module_with(doc):
    """A module that has one function, `move`, with this docstring."""
    function = types.FunctionType((lambda: None).__code__, {}, "move")
    function.__doc__ = doc
    return types.SimpleNamespace(move=function)


MOVE = (
    "move(mesh: femscalpel._engine.Mesh, arg1: List[Tuple[str, float]], by: float = 1.5, how: str = 'a, b') -> None\n"
)


@pytest.mark.parametrize(
    "doc, message",
    [
        (MOVE, ""),
        (MOVE.replace(", by", ", far: bool, by"), "far"),
        (MOVE.replace("1.5", "2.5"), "2.5"),
        (MOVE.replace(" = 1.5", ""), "('by', None)"),
        (MOVE.replace("how", "why"), "why"),
        ("move(*args, **kwargs)\nOverloaded function.\n\n1. " + MOVE + "\n2. move() -> None\n", "[]"),
    ],
)
def test_differences_are_seen(doc, message):
    stub = "\n".join(make_stub.function("move", MOVE, set()))
    assert stub == (
        "def move(mesh: Mesh, arg1: Sequence[tuple[str, float]], /, by: float = 1.5, how: str = 'a, b') -> None: ..."
    )
    found = differences(module_with(doc), ast.parse(stub))
    assert len(found) == bool(message) and message in "".join(found)


@pytest.mark.parametrize(
    "given, kind, spellings",
    [
        (True, "Sequence[float]", ["List[float[3]]", "Annotated[list[float], FixedSize(3)]", NUMBERS]),
        (
            True,
            "tuple[float, Sequence[float]] | None",
            [
                "Optional[Tuple[float, List[float[3]]]]",
                "Optional[tuple[float, Annotated[list[float], FixedSize(3)]]]",
                f"tuple[typing.SupportsFloat | typing.SupportsIndex, {NUMBERS}] | None",
            ],
        ),
        (False, "Sequence[float]", ["List[float[3]]", 'typing.Annotated[list[float], "FixedSize(3)"]']),
        (
            True,
            "Sequence[tuple[str, ArrayLike]]",
            [
                "List[Tuple[str, numpy.ndarray[numpy.int64]]]",
                "list[tuple[str, numpy.ndarray[numpy.int64]]]",
                "collections.abc.Sequence[tuple[str, typing.Annotated[numpy.typing.ArrayLike, numpy.int64]]]",
            ],
        ),
        (False, "NDArray[np.float64]", ["numpy.ndarray[numpy.float64]", "numpy.typing.NDArray[numpy.float64]"]),
        (True, "int", ["int", "typing.SupportsInt | typing.SupportsIndex"]),
        (True, "str | os.PathLike[str]", ["os.PathLike", "os.PathLike | str | bytes"]),
        (
            False,
            "Callable[[Mesh], None] | None",
            ["Callable[[femscalpel._engine.Mesh], None]", "collections.abc.Callable[[femscalpel._engine.Mesh], None]"],
        ),
    ],
)
def test_types_are_the_same_however_pybind11_spells_them(given, kind, spellings):
    assert [make_stub.python_type(spelling, given) for spelling in spellings] == [kind] * len(spellings)


@pytest.mark.parametrize("unknown", ["int | str", "typing.Annotated[list[float], 'sorted']", "numpy.typing.ArrayLike"])
def test_a_type_spelt_in_a_new_way_is_an_error(unknown):
    with pytest.raises(ValueError, match="does not know"):
        make_stub.python_type(unknown, True)


def test_missing_names_are_seen():
    assert differences(types.SimpleNamespace(), ast.parse("def move() -> None: ...")) == ["move is in the stub only"]
    assert differences(module_with(MOVE), ast.parse("")) == ["move is not in the stub"]


def test_what_the_script_does_not_know_is_an_error():
    with pytest.raises(ValueError, match="std::set"):
        make_stub.function("move", "move(arg0: std::set<int>) -> None\n", set())
    with pytest.raises(ValueError, match="MORE_EXACT .* cell_types.return"):
        make_stub.stub(module_with(MOVE))
