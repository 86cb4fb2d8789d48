# SPDX-License-Identifier: LGPL-2.1-or-later
"""What sets up and tries other releases of Debian: packages that are there, lacking or a choice; counts of tests."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "releases"))
import counts  # noqa: E402

LIST = "# Packages.\n[build]\ncmake\nqt5-tools | qt6-tools\ngone\n\n[test]\npytest\n"


@pytest.fixture
def setup(tmp_path):
    """Runs setup.sh in a release of Debian with cmake, qt6-tools and pytest, where `installed` are installed; gives the
    exit status, what was said, and the packages that apt-get was to install."""
    (tmp_path / "resources").mkdir()
    (tmp_path / "bin").mkdir()
    (tmp_path / "resources" / "setup.sh").write_text((ROOT / "resources" / "setup.sh").read_text())
    (tmp_path / "resources" / "debian-packages.txt").write_text(LIST)
    programs = {
        "id": "echo 0",
        "dpkg-query": 'for last; do :; done; case " $INSTALLED " in *" $last "*) echo install ok installed ;; esac',
        "apt-cache": 'case $2 in cmake | qt6-tools | pytest) v=1.0 ;; *) v="(none)" ;; esac; echo "  Candidate: $v"',
        "apt-get": f'echo "$*" | grep -q install && echo "$*" >>{tmp_path}/installed; true',
    }
    for name, text in programs.items():
        (tmp_path / "bin" / name).write_text(f"#!/bin/sh\n{text}\n")
        (tmp_path / "bin" / name).chmod(0o755)

    def run(*sections, installed=""):
        (tmp_path / "installed").unlink(missing_ok=True)
        done = subprocess.run(
            ["sh", str(tmp_path / "resources" / "setup.sh"), *sections],
            env={**os.environ, "PATH": f"{tmp_path}/bin:/usr/bin:/bin", "INSTALLED": installed},
            capture_output=True,
            text=True,
            check=False,
        )
        log = tmp_path / "installed"
        packages = log.read_text().split("--no-install-recommends")[1].split() if log.exists() else []
        return done.returncode, done.stderr, packages

    return run


def test_what_a_release_lacks_is_left_out_and_said(setup):
    code, said, packages = setup()
    assert code == 0
    assert packages == ["cmake", "qt6-tools", "pytest"]
    assert said == "setup.sh: this release of Debian has no package gone; what needs it is left out\n"


def test_only_what_is_missing_of_the_sections(setup):
    assert setup("test")[2] == ["pytest"]
    assert setup("build", installed="cmake qt5-tools")[2] == []
    assert setup("build", "test", installed="cmake qt5-tools gone") == (0, "", ["pytest"])
    assert setup(installed="cmake qt6-tools gone pytest") == (0, "", [])


def test_no_such_section(setup):
    code, said, packages = setup("tests")
    assert (code, packages) == (1, [])
    assert "there is no section [tests] in" in said and said.endswith("give build, test\n")


def test_the_packages_are_all_in_a_section():
    lines = (ROOT / "resources" / "debian-packages.txt").read_text().splitlines()
    before = lines[: next(k for k, line in enumerate(lines) if line.startswith("["))]
    assert not [line for line in before if line and not line.startswith("#")]


def block(name, output, status):
    rule = "-" * 58
    head = f"{rule}\n\n1/9 Testing: {name}\n1/9 Test: {name}\nOutput:\n"
    return head + f"{rule}\n{output}\n<end of output>\n{rule}\nTest time =   0.10 sec\n{rule}\n{status}\n"


def test_counts_of_a_run_of_ctest():
    log = (
        block("Med.Reads", "[ OK ]", "Test Passed.")
        + block(
            "Inp.Decks", "skipped", "Test Pass Reason:\nSkip regular expression found in output.\nRegex=[[  SKIPPED ]]"
        )
        + block("Crack.Bad", "no", "Test Failed.")
        + block("python.test_a", "1 failed, 7 passed, 2 skipped in 3.10s", "Test Failed.")
        + block("python.test_b", "5 passed in 0.1s", "Test Passed.")
        + block("freecad.App", "Ran 73 tests in 9.1s\n\nOK (skipped=3)", "Test Passed.")
        + block("gui.All", "Ran 59 tests in 99.1s\n\nFAILED (failures=1, errors=2)", "Test Failed.")
        + block("gui.stuck", "", "Test Failed.")
    )
    found = [counts.count(*test) for test in counts.read_log(log)]
    assert [(kind, dict(c)) for kind, c in found] == [
        ("C++", {"passed": 1}),
        ("C++", {"skipped": 1}),
        ("C++", {"failed": 1}),
        ("Python", {"failed": 1, "passed": 7, "skipped": 2}),
        ("Python", {"passed": 5}),
        ("FreeCADCmd", {"skipped": 3, "failed": 0, "passed": 70}),
        ("window", {"skipped": 0, "failed": 3, "passed": 56}),
        ("window", {"failed": 1}),
    ]
