# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tests in FreeCAD's window: `freecad -t TestFemScalpelGui`, which tests/gui/run_gui_tests.py runs on a virtual
screen."""

import femscalpelguitest
from femscalpeltest.gathering import test_cases

globals().update(test_cases(femscalpelguitest))
