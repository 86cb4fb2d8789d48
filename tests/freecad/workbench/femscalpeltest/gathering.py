# SPDX-License-Identifier: LGPL-2.1-or-later
"""Finds the test cases of a package for FreeCAD's lists of tests, so that none is forgotten."""

import importlib
import pkgutil
import unittest


def test_cases(package, leave_out=()):
    """{name: class} of all test cases in the modules test_* of a package, but those `leave_out`; names hold the
    module's."""
    cases = {}
    for found in pkgutil.iter_modules(package.__path__):
        if found.name.startswith("test_") and found.name not in leave_out:
            module = importlib.import_module(f"{package.__name__}.{found.name}")
            for name, case in vars(module).items():
                if (
                    isinstance(case, type)
                    and issubclass(case, unittest.TestCase)
                    and case.__module__ == module.__name__
                ):
                    cases[f"{found.name}_{name}"] = case
    return cases
