# SPDX-License-Identifier: LGPL-2.1-or-later
"""FreeCAD runs this file when it starts. It has put this folder on sys.path by then, so that scripts, macros and saved
documents can import ObjectsFemScalpel, femmesh_bridge and femscalpel; nothing else needs to be set up but FreeCAD's
list of tests."""

import FreeCAD

FreeCAD.__unit_test__ += ["TestFemScalpelApp"]
