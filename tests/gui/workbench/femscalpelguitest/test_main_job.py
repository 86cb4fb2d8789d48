# SPDX-License-Identifier: LGPL-2.1-or-later
"""The main job: from opening the workbench to a disk crack solved by CalculiX, by mouse and keys alone, which are
counted."""

import FreeCAD
import FreeCADGui

from femscalpeltest.documents import need
from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest, widget
from .hands import Hands, Window

#: What the job may take.
CLICKS, NUMBERS = 15, 4


class MainJob(GuiTest):
    def setUp(self):
        need("ccx", "CalculiX")
        super().setUp()
        FreeCADGui.activateWorkbench("StartWorkbench")
        from femexamples import ccx_cantilever_faceload

        FreeCAD.closeDocument(self.doc.Name)
        self.doc = FreeCAD.newDocument("Bracket")
        self.doc.UndoMode = 1
        ccx_cantilever_faceload.setup(self.doc, "ccxtools")
        self.doc.recompute()
        self.look()

    def results(self):
        return self.doc.findObjects("Fem::FemResultObject")

    def test_disk_crack_solved(self):
        window = Window(Hands())
        window.choose_workbench()
        window.press("FemScalpel_Crack")
        self.wait_for_preview()
        screenshot("main_job_1_panel")
        box = widget("patch")
        window.hands.choose(box, box.findData("Disk"))
        self.assertEqual(box.currentData(), "Disk")
        window.enter(originX="4000", patchRadius="300")
        self.wait_for_preview()
        screenshot("main_job_2_preview")
        window.press_ok()
        screenshot("main_job_3_cracked")
        crack = self.doc.Crack
        self.assertIn(crack, self.doc.Analysis.Group)
        self.assertAlmostEqual(crack.PatchRadius.Value, 300)
        self.assertGreater(crack.FrontLength.Value, 0)
        solver = next(o for o in self.doc.Objects if "Solver" in o.TypeId)
        window.solve(solver, self.results, lambda: screenshot("main_job_4_solved"))
        result = self.results()[0]
        self.assertEqual(len(result.NodeNumbers), crack.FemMesh.NodeCount)
        largest = max(result.DisplacementLengths)
        self.assertTrue(1 < largest < 1000, largest)
        clicks, numbers = window.hands.clicks, window.hands.numbers
        FreeCAD.Console.PrintMessage(f"MAIN JOB: {clicks} clicks, {numbers} typed numbers\n")
        self.assertLessEqual(clicks, CLICKS)
        self.assertLessEqual(numbers, NUMBERS)
