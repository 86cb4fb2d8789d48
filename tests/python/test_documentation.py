# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pages name files that are there, and everything public has its place in the rendered documentation."""

import os
import pathlib
import re
import shutil
import subprocess
import sys

import pytest

import femscalpel

ROOT = pathlib.Path(__file__).resolve().parents[2]
API = ROOT / "resources" / "docs" / "api"
PAGES = (
    "README.md",
    "CONTRIBUTING.md",
    *(f"resources/docs/{p}.md" for p in ("architecture", "formats", "groups", "material", "paper", "tour")),
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


def snippets(page):
    """The page's blocks of Python."""
    return re.findall(r"^```python\n(.*?)^```$", (ROOT / page).read_text(), re.M | re.S)


MATERIAL = snippets("resources/docs/material.md")
WORKBENCH = pathlib.Path(femscalpel.__file__).parents[1]


def run_alone(command, folder):
    """What a command prints, in a folder of its own."""
    environment = {**os.environ, "PYTHONPATH": str(WORKBENCH), "FREECAD_USER_HOME": str(folder)}
    done = subprocess.run(
        command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=600
    )
    said = done.stdout + done.stderr
    assert done.returncode == 0 and "Traceback" not in said and "Exception while" not in said, said[-3000:]
    return done.stdout


def test_examples_of_shells_and_beams_run_as_they_stand(tmp_path):
    (tmp_path / "example.py").write_text(MATERIAL[0])
    said = run_alone([sys.executable, "example.py"], tmp_path)
    assert "RIB_SEAM" in said and re.search(r"\d+ beams share \d+ nodes with the plate", said)
    deck = femscalpel.read(tmp_path / "stiffened.inp")
    beams, nodes = map(int, re.search(r"(\d+) beams share (\d+)", said).groups())
    assert len(deck.groups["BEAM"]) == beams == nodes - 1 and min(femscalpel.mean_ratio(deck)["triangle"]) > 0.2


def test_examples_of_solids_run_as_they_stand(tmp_path):
    (tmp_path / "example.py").write_text(MATERIAL[1])
    said = run_alone([sys.executable, "example.py"], tmp_path)
    assert re.search(r"% of the motion works.*: by=\(", said)
    part = femscalpel.read(tmp_path / "part.med")
    assert {"RIGHT", "BOSS_RIGHT", "BOSS_ADDED", "ROUND_FACE", "HOLE_WALL"} <= set(part.groups)
    assert part.points[:, 0].max() == 135 and part.points[:, 2].max() == 55


@pytest.mark.skipif(not shutil.which("freecadcmd"), reason="FreeCAD is not installed")
def test_the_example_in_freecad_runs_as_it_stands(tmp_path):
    assert len(MATERIAL) == 3
    (tmp_path / "example.py").write_text(MATERIAL[2])
    said = run_alone(["freecadcmd", "example.py", "-M", str(WORKBENCH)], tmp_path)
    for label in ("Merge", "Fillet", "Drill", "Reshape"):
        assert re.search(rf"^{label} [1-9]\d+ \['Up-to-date'\]$", said, re.M), said[-2000:]


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
