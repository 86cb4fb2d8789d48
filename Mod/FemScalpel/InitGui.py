# SPDX-License-Identifier: LGPL-2.1-or-later
"""FreeCAD runs this file by exec() when its window starts: it adds the workbench."""

import FreeCAD
import FreeCADGui


class FemScalpelWorkbench(FreeCADGui.Workbench):
    """Cracks, drills and cuts FEM meshes."""

    def __init__(self):
        from femscalpelgui.translate import icon, translate

        self.__class__.MenuText = "FemScalpel"
        self.__class__.ToolTip = translate("FemScalpel", "Cracks, drills and cuts FEM meshes and keeps their groups")
        self.__class__.Icon = icon("FemScalpel")

    def Initialize(self):
        import femscalpel_parts

        if femscalpel_parts.missing():
            from femscalpelgui import missing_part as commands
        else:
            from femscalpelgui import commands, help

            help.watch_whats_this()

        toolbar, menu = commands.register()
        self.appendToolbar("FemScalpel", toolbar)
        self.appendMenu("&FemScalpel", menu)

    def Activated(self):
        import femscalpel_parts

        if femscalpel_parts.missing():
            from femscalpelgui import missing_part

            missing_part.show_once()

    def GetClassName(self):
        return "Gui::PythonWorkbench"


# exec() gives functions no sight of this file's names, so everything is done at its top level.
import femscalpel_parts

femscalpel_parts.find_parts()
from femscalpelgui.translate import ICONS, PREFERENCES, TRANSLATIONS

FreeCADGui.addLanguagePath(TRANSLATIONS)
FreeCADGui.updateLocale()
FreeCADGui.addIconPath(ICONS)
if femscalpel_parts.missing():
    from femscalpelgui import missing_part

    FreeCAD.Console.PrintWarning(femscalpel_parts.missing().text() + "\n")
    missing_part.watch_documents()
else:
    from femscalpelgui.viewproviders import attaching

    attaching.watch()
    FreeCADGui.addPreferencePage(PREFERENCES, "FemScalpel")
    FreeCAD.__unit_test__ += ["TestFemScalpelGui"]
FreeCADGui.addWorkbench(FemScalpelWorkbench())
