# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tests in FreeCAD's window: `freecad -t TestFemScalpelGui`, which tests/gui/run_gui_tests.py runs on a virtual screen."""

import importlib
import pkgutil

import femscalpelguitest

# Every test case of the package, so that none is forgotten.
for found in pkgutil.iter_modules(femscalpelguitest.__path__):
    if found.name.startswith("test_"):
        module = importlib.import_module(f"femscalpelguitest.{found.name}")
        globals().update((f"{found.name}_{name}", case) for name, case in vars(module).items() if getattr(case, "__module__", "") == module.__name__)
