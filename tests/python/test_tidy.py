# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which files tests/tidy.sh gives to clang-tidy, here a script that names them; and that no header escapes it."""

import pathlib
import re
import shutil
import subprocess

import pytest

needs_git = pytest.mark.skipif(not shutil.which("git"), reason="no git here")
ROOT = pathlib.Path(__file__).resolve().parents[2]


def test_every_header_is_looked_at():
    shown = re.search(r"^HeaderFilterRegex: '(.*)'$", (ROOT / ".clang-tidy").read_text(), re.M).group(1)
    headers = sorted((ROOT / "src").rglob("*.h"))
    included = {
        pathlib.PurePath(name).name
        for path in (ROOT / "src").rglob("*.cpp")
        for name in re.findall(r'^#include "(.*)"', path.read_text(), re.M)
    }
    while True:  # by way of other headers
        more = {
            pathlib.PurePath(name).name
            for path in headers
            if path.name in included
            for name in re.findall(r'^#include "(.*)"', path.read_text(), re.M)
        }
        if more <= included:
            break
        included |= more
    assert headers
    assert not [str(path) for path in headers if not re.search(shown, str(path)) or path.name not in included]
    assert not re.search(shown, "/usr/include/eigen3/Eigen/src/Core/Matrix.h")


class Tree:
    """A repository with a clang-tidy that names the file it is given and finds fault with what has BAD in it."""

    def __init__(self, folder):
        self.folder = folder / "tree"
        self.programs = folder / "programs"
        self.programs.mkdir()
        for name in "bash cat cp dirname find git grep mkdir nproc sed sort tail xargs".split():
            if path := shutil.which(name):
                (self.programs / name).symlink_to(path)
        self.write("tests/tidy.sh", (ROOT / "tests" / "tidy.sh").read_text())
        self.write("build/release/compile_commands.json", "[]")
        cmake = self.programs / "cmake"  # called with "--preset release -B FOLDER ..."
        cmake.write_text(
            '#!/bin/bash\nengine="$4/src/engine/CMakeFiles/femscalpel_engine.dir"\nmkdir -p "$engine"\n'
            'echo "[]" > "$4/compile_commands.json"\necho > "$engine/cmake_pch.hxx"\n'
        )
        cmake.chmod(0o755)
        self.write(".gitignore", "/build/\n")
        for name in ("src/engine/a.cpp", "src/engine/a.h", "src/bindings/b.cpp", "tests/cpp/c.cpp"):
            self.write(name, "")

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def add_tidy(self, name, version):
        path = self.programs / name
        path.write_text(
            "#!/bin/bash\n"
            f'if [ "$1" = --version ]; then echo "LLVM version {version}.0.6"; exit; fi\n'
            f'file="${{@: -1}}"; echo "{name} $file"; ! grep -q BAD "$file"\n'
        )
        path.chmod(0o755)

    def git(self, *arguments):
        who = ["-c", "user.name=A", "-c", "user.email=a@b.c", "-c", "commit.gpgsign=false"]
        subprocess.run(["git", *who, *arguments], cwd=self.folder, check=True, capture_output=True)

    def commit(self):
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "More")

    def tidy(self, *arguments):
        """What was looked at, the messages, the exit status."""
        ran = subprocess.run(
            ["bash", "tests/tidy.sh", *arguments],
            cwd=self.folder,
            env={"PATH": str(self.programs), "GIT_CEILING_DIRECTORIES": str(self.folder.parent)},
            capture_output=True,
            text=True,
        )
        lines = ran.stdout.splitlines()
        return (
            sorted(line for line in lines if line.startswith("clang-tidy")),
            [line for line in lines if line.startswith("tidy:")],
            ran.returncode,
        )


@pytest.fixture
def tree(tmp_path):
    return Tree(tmp_path)


def test_whole_by_the_newest(tree):
    tree.add_tidy("clang-tidy-16", 16)
    tree.add_tidy("clang-tidy", 14)
    looked, _, status = tree.tidy()
    assert looked == ["clang-tidy-16 src/bindings/b.cpp", "clang-tidy-16 src/engine/a.cpp"] and status == 0
    tree.add_tidy("clang-tidy", 17)
    assert tree.tidy("src/engine/a.cpp")[0] == ["clang-tidy src/engine/a.cpp"]


def test_findings_fail(tree):
    tree.add_tidy("clang-tidy", 19)
    tree.write("src/engine/a.cpp", "BAD")
    looked, said, status = tree.tidy()
    assert len(looked) == 2 and status != 0 and not any("nothing found" in line for line in said)


def test_too_old_is_said(tree):
    tree.add_tidy("clang-tidy", 14)
    looked, said, status = tree.tidy()
    assert not looked and "nothing was looked at" in said[0] and status == 0


def says_there_is_no_history(tree):
    looked, said, status = tree.tidy("--changed")
    return not looked and "no history" in said[0] and status == 0


def test_changed_without_repository_is_said(tree):
    tree.add_tidy("clang-tidy-16", 16)
    assert says_there_is_no_history(tree)


@needs_git
def test_changed_in_a_first_commit_is_said(tree):
    tree.add_tidy("clang-tidy-16", 16)
    tree.git("init", "-q")
    assert says_there_is_no_history(tree)
    tree.commit()
    assert says_there_is_no_history(tree)


@needs_git
def test_changed_since_the_parent_and_since_the_branch_began(tree):
    tree.add_tidy("clang-tidy-16", 16)
    tree.git("init", "-q")
    tree.commit()
    tree.git("update-ref", "refs/remotes/origin/main", "HEAD")
    for name in ("src/engine/a.h", "tests/cpp/c.cpp"):
        tree.write(name, "// changed\n")
    tree.commit()
    tree.write("src/engine/new.cpp", "")
    since_branch = ["clang-tidy-16 src/engine/a.h", "clang-tidy-16 src/engine/new.cpp"]
    assert tree.tidy("--changed")[::2] == (since_branch, 0)
    (tree.folder / "src/engine/a.cpp").unlink()
    tree.commit()
    assert tree.tidy("--changed")[::2] == (since_branch, 0)
    tree.git("update-ref", "-d", "refs/remotes/origin/main")
    assert tree.tidy("--changed")[::2] == (["clang-tidy-16 src/engine/new.cpp"], 0)
    tree.git("update-ref", "refs/remotes/origin/main", "HEAD")  # on main itself
    assert tree.tidy("--changed")[::2] == (["clang-tidy-16 src/engine/new.cpp"], 0)
    tree.write("README.md", "")
    tree.commit()
    tree.git("update-ref", "-d", "refs/remotes/origin/main")
    looked, said, status = tree.tidy("--changed")
    assert not looked and "0 file(s)" in said[0] and status == 0
