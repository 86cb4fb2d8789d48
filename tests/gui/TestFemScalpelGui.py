# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tests of the workbench in FreeCAD's window; run by run_gui_tests.py, or from FreeCAD's own list of tests."""

from test_crack_panel import CrackCommand, CrackMessages, CrackPicks  # noqa: F401
from test_inspection import GroupInspector, MeshQuality  # noqa: F401
from test_other_commands import CylindricalCrack, Export, Preferences  # noqa: F401
from test_macro import Macro  # noqa: F401
