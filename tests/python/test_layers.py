# SPDX-License-Identifier: LGPL-2.1-or-later
"""The engine's folders include each other one way only, and what is outside it uses the engine, never the other way."""

import ast
import collections
import pathlib
import re
import xml.etree.ElementTree

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
ENGINE = ROOT / "src" / "engine"

#: Folder -> folders it may include, besides itself and the engine's own cancel.h and error.h.
MAY_USE = {
    "mesh": set(),
    "groups": {"mesh"},
    "fields": {"mesh"},
    "deck": {"mesh", "groups"},
    "tools": set(),
    "deformation": {"mesh", "groups", "tools"},
    "cutting": {"mesh", "groups", "deck", "tools", "deformation"},
    "operators": {"mesh", "groups", "fields", "deck", "tools", "deformation", "cutting"},
    "fracture": {"mesh", "groups", "fields", "deck"},
    "io": {"mesh", "groups", "fields", "deck"},
}


def includes(form=r'"([^"]+)"'):
    for path in sorted(ENGINE.rglob("*.h")) + sorted(ENGINE.rglob("*.cpp")):
        for name in re.findall(rf"^\s*#\s*include\s*{form}", path.read_text(), re.M):
            yield path.relative_to(ENGINE), pathlib.PurePath(name)


def test_folders_are_known():
    assert {p.name for p in ENGINE.iterdir() if p.is_dir()} == set(MAY_USE)


def test_includes_run_one_way():
    wrong = collections.defaultdict(list)
    for path, name in includes():
        if len(name.parts) < 2 or path.parts[0] == name.parts[0]:
            continue
        if name.parts[0] not in MAY_USE.get(path.parts[0], ()):  # cancel.h and error.h, beside the folders, use none
            wrong[f"{path.parts[0]} -> {name.parts[0]}"].append(f"{path}: {name}")
    assert not wrong


def test_every_include_of_the_engine_is_there():
    assert all((ENGINE / name).is_file() for _, name in includes())


def test_headers_of_the_engine_are_included_in_quotes():
    assert not [(path, name) for path, name in includes(r"<([^>]+)>") if (ENGINE / name).is_file()]


def test_picture_in_the_documentation_agrees():
    found = collections.Counter()
    for path, name in includes():
        if len(path.parts) > 1 and len(name.parts) > 1 and path.parts[0] != name.parts[0]:
            found[path.parts[0], name.parts[0]] += 1
    svg = "{http://www.w3.org/2000/svg}"
    drawn, folders = {}, set()
    for group in xml.etree.ElementTree.parse(ROOT / "resources" / "docs" / "includes.svg").iter(f"{svg}g"):
        if group.get("class") == "edge":
            drawn[tuple(group.findtext(f"{svg}title").split("->"))] = int(group.findtext(f"{svg}text"))
        elif group.get("class") == "node":
            folders.add(group.findtext(f"{svg}title"))
    remedy = "run resources/docs/make_include_picture.py, which draws it anew"
    assert folders == set(MAY_USE), remedy
    assert drawn == found, remedy


def test_headers_of_a_folder_make_no_circle():
    uses = collections.defaultdict(set)
    for path, name in includes():
        if path.suffix == ".h":
            uses[str(path)].add(str(name))
    assert_no_circle(uses)


def test_every_header_of_the_engine_is_in_a_test():
    """Directly: what is only included by another header is not what a test is about."""
    headers = {str(p.relative_to(ENGINE)) for p in ENGINE.rglob("*.h")}
    tested = set()
    for path in (ROOT / "tests" / "cpp").iterdir():
        if path.suffix in (".h", ".cpp"):
            tested |= set(re.findall(r'^\s*#\s*include\s*"([^"]+)"', path.read_text(), re.M)) & headers
    assert len(headers) > 100
    assert not headers - tested


def imports_of(path, packages):
    """Modules of one of the packages that a Python file imports, also inside functions, as dotted names."""
    package = path.relative_to(packages).parent.parts
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else ()
            module = ".".join((*base, *(node.module or "").split("."))).strip(".")
            yield module
            yield from (f"{module}.{alias.name}" for alias in node.names)


@pytest.mark.parametrize("folder", ["src/python/femscalpel", "Mod/FemScalpel/femscalpelobjects", "gui"])
def test_python_modules_import_each_other_in_no_circle(folder):
    folder = ROOT / folder
    uses = collections.defaultdict(set)
    files = {".".join(p.relative_to(folder.parent).with_suffix("").parts): p for p in folder.rglob("*.py")}
    for name, path in files.items():
        uses[name] = {other for other in imports_of(path, folder.parent) if other in files}
    assert sum(map(len, uses.values())) > 5
    assert_no_circle(uses)


def assert_no_circle(uses):
    """`uses`: name -> names it needs."""
    done, under_way = set(), []

    def visit(name):
        assert name not in under_way, " -> ".join([*under_way[under_way.index(name) :], name])
        if name in done:
            return
        under_way.append(name)
        for other in sorted(uses[name]):
            visit(other)
        under_way.pop()
        done.add(name)

    for name in sorted(uses):
        visit(name)
