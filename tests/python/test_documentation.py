# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pages name files that are there, and everything public has its place in the rendered documentation."""

import pathlib
import re
import sys

import pytest

import femscalpel

ROOT = pathlib.Path(__file__).resolve().parents[2]
API = ROOT / "resources" / "docs" / "api"
PAGES = (
    "README.md",
    "CONTRIBUTING.md",
    *(f"resources/docs/{p}.md" for p in ("architecture", "formats", "groups", "paper", "tour")),
)
SUFFIXES = "h|cpp|py|pyi|ui|svg|ts|md|rst|txt|sh|geo"

sys.path.insert(0, str(API))
import check_doxygen_log


def files():
    """Paths of all files of the repository, relative to it."""
    for folder in ("src", "Mod", "gui", "resources", "tests"):
        yield from (str(path.relative_to(ROOT)) for path in (ROOT / folder).rglob("*"))
    yield from (path.name for path in ROOT.iterdir())


ALL = list(files())


def missing(text):
    """Names of files and folders of the repository, in backquotes, that are not there; bare names may be anywhere."""
    out = []
    for name in re.findall(rf"`([\w.][\w./-]*/|[\w./-]+\.(?:{SUFFIXES}))`", text):
        if not any(f"{path}/".endswith(f"/{name.rstrip('/')}/") or path == name.rstrip("/") for path in ALL):
            out.append(name)
    return out


@pytest.mark.parametrize("page", ("CONTRIBUTING.md", "resources/docs/architecture.md"))
def test_named_files_are_there(page):
    text = (ROOT / page).read_text()
    assert len(re.findall("`", text)) > 100
    assert missing(text) == []


def test_missing_files_are_seen():
    assert missing("`src/engine/`, `tool.h`, `tests/cpp/test_mesh.cpp`, `ctest -R x.py`, `fs.Plane`") == []
    assert missing("`src/motor/`, `tol.h`, `python/test_mesh.cpp`") == ["src/motor/", "tol.h", "python/test_mesh.cpp"]


@pytest.mark.parametrize("page", PAGES)
def test_links_lead_somewhere(page):
    for link in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", (ROOT / page).read_text()):
        assert (ROOT / page).parent.joinpath(link).exists(), link


def test_everything_public_has_its_place_in_the_pages():
    page = (API / "python" / "index.rst").read_text()
    named = re.findall(r"^\.\. auto(?:class|function|exception):: (\w+)$", page, re.M)
    assert page.count("\n.. every tool\n") == 1  # which conf.py replaces
    assert sorted([*named, *femscalpel.tools.TOOLS]) == sorted(femscalpel.__all__)


def test_what_doxygen_may_say():
    may = "a.h:1: warning: Member size() const (function) of class femscalpel::Rows is not documented.\n"
    class_ = "a.h:2: warning: Compound femscalpel::Rows is not documented.\n"
    free = "a.h:3: warning: Member f(int x) (function) of namespace femscalpel is not documented.\n"
    wrong = "a.h:4: warning: argument 'y' of command @param is not found in the argument list of femscalpel::f(int x)\n"
    assert check_doxygen_log.faults(may + class_ + "\n" + free + wrong) == [line[:-1] for line in (class_, free, wrong)]
