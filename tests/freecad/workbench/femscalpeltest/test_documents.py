# SPDX-License-Identifier: LGPL-2.1-or-later
"""Documents of other releases of FreeCAD, and those whose objects have lost what they are."""

import os
import shutil
import subprocess
from unittest import mock

import FreeCAD

import femscalpel_documents
import ObjectsFemScalpel
from femscalpelobjects import contents

from .documents import DocumentTest
from .meshes import box_with_groups

_OPEN = """
import os, sys
sys.path.append({workbench!r})
import FreeCAD
document = FreeCAD.openDocument({path!r})
print("proxy:", document.Crack.Proxy, flush=True)
import ObjectsFemScalpel
FreeCAD.closeDocument(document.Name)
print("proxy:", FreeCAD.openDocument({path!r}).Crack.Proxy, flush=True)
os._exit(0)
"""


class Documents(DocumentTest):
    def setUp(self):
        super().setUp()
        self.box = self.doc.addObject("Part::Box", "Box")
        self.source = self.add_source(box_with_groups())
        self.source.addProperty("App::PropertyLink", "Part")
        self.source.Part = self.box
        self.crack = ObjectsFemScalpel.makeCrack(self.doc, self.source, origin=(3.3, 2.5, 2), normal=(0.9, 0.3, 0.2))
        self.doc.recompute()

    def reopen(self):
        path = os.path.join(self.folder.name, "document.FCStd")
        self.doc.saveAs(path)
        FreeCAD.closeDocument(self.doc.Name)
        self.doc = FreeCAD.openDocument(path)
        return path

    def test_link_to_geometry_that_another_release_renames(self):
        self.assertEqual(self.crack.Part, self.box)
        self.source.removeProperty("Part")
        self.source.addProperty("App::PropertyLinkGlobal", "Shape")  # as FreeCAD 1.0 does with documents of 0.20
        self.source.Shape = self.box
        self.reopen()
        self.assertEqual((self.doc.Crack.Shape, self.doc.Crack.Part), (self.doc.Box, None))
        self.assertEqual(self.doc.Crack.State, ["Up-to-date"])

    def test_what_freecad_counts_is_no_input(self):
        before = contents.inputs_of(self.crack)
        if "_ElementMapVersion" not in self.crack.PropertiesList:  # up to 0.21
            self.crack.addProperty("App::PropertyString", "_ElementMapVersion")
        self.crack._ElementMapVersion = "99"
        self.assertEqual(contents.inputs_of(self.crack), before)

    def test_saved_without_femscalpel(self):
        self.crack.Proxy = None
        with mock.patch.object(FreeCAD, "Console") as console:
            self.reopen()
        ((text,),) = (call.args for call in console.PrintWarning.call_args_list)
        self.assertRegex(text, r"Document .*: its objects of FemScalpel \(Crack\) have lost what they are .*was saved")

    def test_opened_before_femscalpel_was_imported(self):
        self.crack.Proxy = None
        fresh = mock.patch.object(femscalpel_documents, "_observers", [])
        with mock.patch.object(FreeCAD, "Console") as console, fresh:
            femscalpel_documents.watch()
            femscalpel_documents.watch()
            FreeCAD.removeDocumentObserver(femscalpel_documents._observers[0])
        ((text,),) = (call.args for call in console.PrintWarning.call_args_list)
        self.assertIn("Close it without saving, and open it again now", text)

    def test_nothing_is_said_of_others(self):
        with mock.patch.object(FreeCAD, "Console") as console:
            self.reopen()
        console.PrintWarning.assert_not_called()

    def test_only_on_the_path_of_python(self):
        script = os.path.join(self.folder.name, "open.py")
        with open(script, "w") as file:
            file.write(_OPEN.format(workbench=os.path.dirname(femscalpel_documents.__file__), path=self.reopen()))
        done = subprocess.run(
            [shutil.which("freecadcmd") or shutil.which("FreeCADCmd"), script],
            env={**os.environ, "FREECAD_USER_HOME": self.folder.name},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            errors="replace",
        )
        said = done.stdout + done.stderr
        first, second = (line for line in said.splitlines() if line.startswith("proxy:"))
        self.assertIn("Crack", second)
        # FreeCAD does not import what is no add-on, from some release on.
        self.assertEqual("it was opened while FreeCAD did not know FemScalpel" in said, first == "proxy: None", said)
