# SPDX-License-Identifier: LGPL-2.1-or-later
"""What Python says when the compiled module cannot be loaded, and that all files agree on the version."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import femscalpel
from femscalpel._loading import explanation

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = Path(femscalpel.__file__).parent
HERE = f"Python {sys.version_info.major}.{sys.version_info.minor}"


@pytest.fixture
def package(tmp_path):
    """A copy of the package with its compiled module: (folder, the module's file)."""
    folder = tmp_path / "femscalpel"
    shutil.copytree(PACKAGE, folder, ignore=shutil.ignore_patterns("__pycache__"))
    return folder, next(folder.glob("_engine.*.so"))


def said(folder, *before):
    """The last line Python writes when it imports the package in `folder`."""
    done = subprocess.run(
        [sys.executable, "-c", "; ".join([*before, "import femscalpel"])],
        env={"PYTHONPATH": str(folder.parent), "PATH": "/usr/bin", "LC_ALL": "C.UTF-8"},
        capture_output=True,
        text=True,
        check=False,
    )
    return done.stderr.strip().splitlines()[-1] if done.stderr else ""


def test_the_copy_works(package):
    assert said(package[0]) == ""


def test_no_compiled_module(package):
    folder, module = package
    module.unlink()
    assert said(folder) == f"ImportError: FemScalpel: its compiled part (a file _engine.*) is not in {folder}."


def test_compiled_for_another_python(package):
    folder, module = package
    module.rename(folder / "_engine.cpython-399-x86_64-linux-gnu.so")
    assert said(folder).endswith(f"its compiled part in {folder} is for Python 3.99, but this is {HERE}.")


def test_a_library_is_missing(package):
    folder, module = package
    module.write_bytes(module.read_bytes().replace(b"libTKernel.so", b"libTKernal.so"))
    assert re.search(r"needs the library libTKernal\.so\.\S+, which is not installed\.$", said(folder))


def test_numpy_is_missing(package):
    line = said(package[0], "import sys", "sys.modules['numpy'] = None")
    assert f"NumPy is missing or does not work in {sys.executable} ({HERE})" in line


def test_built_for_a_newer_system(package):
    error = ImportError("/lib/libc.so.6: version `GLIBC_2.99' not found (required by /x/_engine.so)")
    assert explanation(error, package[0]).endswith("was built for a newer system than this (it needs GLIBC_2.99).")


def test_what_else_is_said_as_it_is(package):
    assert "undefined symbol: foo" in explanation(ImportError("undefined symbol: foo"), package[0])


def test_all_files_have_the_same_version():
    found = {
        "CMakeLists.txt": re.search(r"project\(FemScalpel VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1],
        "package.xml": re.search(r"<version>(.*)</version>", (ROOT / "package.xml").read_text())[1],
        "__init__.py": femscalpel.__version__,
    }
    assert len(set(found.values())) == 1, found
