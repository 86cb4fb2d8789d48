# SPDX-License-Identifier: LGPL-2.1-or-later
"""Loads the compiled module, or says in plain words why it cannot be loaded."""

import importlib
import re
import sys
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path

FOLDER = Path(__file__).parent
_LIBRARY = re.compile(r"(\S+): cannot open shared object file")
_NEWER = re.compile(r"version [`']((?:GLIBC|GLIBCXX|CXXABI)_[\d.]+)' not found")
_PYTHON = re.compile(r"\.(?:cpython-|cp)(\d)(\d+)")


def explanation(error, folder=FOLDER):
    """Why `folder`/_engine cannot be loaded: a sentence for people, of the ImportError it gave."""
    python = f"Python {sys.version_info.major}.{sys.version_info.minor}"
    if error.name == "numpy" or "numpy" in str(error).lower():
        return f"NumPy is missing or does not work in {sys.executable} ({python}): {error}."
    built = sorted(f.name for f in folder.glob("_engine.*") if f.suffix in (".so", ".pyd"))
    if not built:
        return f"its compiled part (a file _engine.*) is not in {folder}."
    if not any(name == "_engine" + suffix for name in built for suffix in EXTENSION_SUFFIXES):
        others = [f"Python {m[1]}.{m[2]}" if (m := _PYTHON.search(name)) else "another Python" for name in built]
        return f"its compiled part in {folder} is for {' and '.join(others)}, but this is {python}."
    if found := _LIBRARY.search(str(error)):
        return f"its compiled part in {folder} needs the library {found[1]}, which is not installed."
    if found := _NEWER.search(str(error)):
        return f"its compiled part in {folder} was built for a newer system than this (it needs {found[1]})."
    return f"its compiled part in {folder} cannot be loaded: {error}."


def load():
    """Imports NumPy and the compiled module.

    Raises
    ------
    ImportError
        Saying which is missing, or for which Python the compiled module is.
    """
    try:
        importlib.import_module("numpy")
        importlib.import_module(__package__ + "._engine")
    except ImportError as error:
        raise ImportError("FemScalpel: " + explanation(error), name=__package__ + "._engine") from error
