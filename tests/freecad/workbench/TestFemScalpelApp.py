# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tests without a window: freecadcmd -t TestFemScalpelApp, or in FreeCAD's test workbench."""

import femscalpeltest
from femscalpeltest.gathering import test_cases

globals().update(test_cases(femscalpeltest, leave_out=("test_examples",)))  # which take long: TestFemScalpelExamples
