# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tests in FreeCAD's window: `freecad -t TestFemScalpelGui`, which tests/gui/run_gui_tests.py runs on a virtual screen."""

from femscalpelguitest.test_crack_panel import CrackCommand, CrackMessages, CrackPicks  # noqa: F401
from femscalpelguitest.test_every_command import EveryCommand  # noqa: F401
from femscalpelguitest.test_inspection import GroupInspector, MeshQuality  # noqa: F401
from femscalpelguitest.test_macro import Macro  # noqa: F401
from femscalpelguitest.test_other_commands import CylindricalCrack, Drill, Export, Preferences, Refine  # noqa: F401
from femscalpelguitest.test_tour import Tour  # noqa: F401
