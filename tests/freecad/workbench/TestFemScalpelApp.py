# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tests without a window: freecadcmd -t TestFemScalpelApp, or in FreeCAD's test workbench."""

from femscalpeltest.test_analysis import Analysis  # noqa: F401
from femscalpeltest.test_bridge import Bridge  # noqa: F401
from femscalpeltest.test_crack import CrackObject, Macro  # noqa: F401
from femscalpeltest.test_on_shape import OnShape  # noqa: F401
from femscalpeltest.test_operators import Operators  # noqa: F401
from femscalpeltest.test_finite_crack import FiniteCrack, NotchedCantilever  # noqa: F401
