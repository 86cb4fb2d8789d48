# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tests without a window: freecadcmd -t TestFemScalpelApp, or in FreeCAD's test workbench."""

import importlib
import pkgutil

import femscalpeltest

# Every test case of the package, so that none is forgotten, but the examples, which take long: TestFemScalpelExamples.
for found in pkgutil.iter_modules(femscalpeltest.__path__):
    if found.name.startswith("test_") and found.name != "test_examples":
        module = importlib.import_module(f"femscalpeltest.{found.name}")
        globals().update((f"{found.name}_{name}", case) for name, case in vars(module).items() if getattr(case, "__module__", "") == module.__name__)
