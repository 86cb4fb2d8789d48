# SPDX-License-Identifier: LGPL-2.1-or-later
"""FreeCAD runs this file when it starts. It has put this folder on sys.path by then, so that scripts, macros and saved
documents can import ObjectsFemScalpel, femmesh_bridge and femscalpel; what else needs to be set up is where a clone has
its parts, and FreeCAD's list of tests. What is missing is said here, or, where there will be a window, by InitGui.py in
its report view."""

import FreeCAD

import femscalpel_parts

if femscalpel_parts.missing():
    if FreeCAD.ConfigGet("RunMode") != "Gui":
        FreeCAD.Console.PrintWarning(femscalpel_parts.missing().text() + "\n")
else:
    import femscalpel_documents

    femscalpel_documents.watch()
    FreeCAD.__unit_test__ += ["TestFemScalpelApp"]
