# SPDX-License-Identifier: LGPL-2.1-or-later
"""FreeCAD's FEM examples, cracked and solved; takes some minutes: freecadcmd -t TestFemScalpelExamples."""

from femscalpeltest.test_examples import Examples, ExamplesByGroupName, ExamplesWithFiniteCracks  # noqa: F401
