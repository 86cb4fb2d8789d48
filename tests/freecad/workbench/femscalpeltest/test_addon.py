# SPDX-License-Identifier: LGPL-2.1-or-later
"""The add-on's package.xml as FreeCAD reads it, and which command is named when a part is missing."""

import unittest
import unittest.mock
from pathlib import Path

import FreeCAD
import femscalpel
import femscalpel_parts


class PackageXml(unittest.TestCase):
    def setUp(self):
        self.metadata = FreeCAD.Metadata(str(femscalpel_parts.HERE / "package.xml"))

    def test_says_what_the_addon_manager_asks_for(self):
        self.assertEqual(self.metadata.Name, "FemScalpel")
        self.assertEqual(self.metadata.Version, femscalpel.__version__)
        self.assertEqual(femscalpel_parts.version(), femscalpel.__version__)
        self.assertEqual(
            {url["type"] for url in self.metadata.Urls}, {"repository", "bugtracker", "documentation", "readme"}
        )
        self.assertTrue(self.metadata.Author[0]["name"])
        self.assertTrue(self.metadata.Maintainer[0]["email"])
        self.assertEqual(self.metadata.License[0]["name"], "LGPL-2.1-or-later")
        text = (femscalpel_parts.HERE / "package.xml").read_text()
        self.assertRegex(text, r"<date>\d{4}-\d\d-\d\d</date>")  # which FreeCAD 0.20 does not hand on
        self.assertEqual([d["package"] for d in self.metadata.Depend], ["FEM Workbench", "numpy"])

    def test_the_workbench_and_its_icon_are_where_it_says(self):
        (workbench,) = self.metadata.Content["workbench"]
        folder = femscalpel_parts.HERE / workbench.Subdirectory
        self.assertTrue((folder / "InitGui.py").exists())
        self.assertTrue((femscalpel_parts.HERE / self.metadata.Icon).exists())
        self.assertTrue((folder / workbench.Icon).exists())
        self.assertIn(f"class {workbench.Classname}(", (folder / "InitGui.py").read_text())
        self.assertIn("fem", workbench.Tag)
        self.assertEqual(workbench.FreeCADMin, "0.20.0")
        self.assertTrue(workbench.supportsCurrentFreeCAD())


class Command(unittest.TestCase):
    """Of a missing part: by where the workbench came from."""

    def test_nothing_is_missing_here(self):
        self.assertIsNone(femscalpel_parts.missing())

    def test_of_a_package(self):
        found = {}
        for folder in ("/usr/lib/freecad-femscalpel/FemScalpel", "/home/me/.local/share/FreeCAD/Mod/FemScalpel"):
            with unittest.mock.patch.object(femscalpel_parts, "HERE", Path(folder)):
                found[folder.split("/")[1]] = femscalpel_parts.command_for("1.2.3")
        self.assertEqual(found["usr"], "sudo apt-get install --reinstall ./freecad-femscalpel_1.2.3-1*.deb")
        self.assertEqual(found["home"], "sudo apt-get install ./freecad-femscalpel_1.2.3-1*.deb")

    def test_of_a_clone(self):
        with unittest.mock.patch.object(femscalpel_parts, "CLONE", Path("/home/my me/FemScalpel")):
            self.assertEqual(femscalpel_parts.command_for("1"), "sh '/home/my me/FemScalpel/resources/build.sh'")
