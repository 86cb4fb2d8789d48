# SPDX-License-Identifier: LGPL-2.1-or-later
"""A new user's job with mouse and keys: a bracket of second-order tetrahedra with a whole analysis is cracked, drilled
and slotted, all of it undone and redone, the first operation edited, the bracket solved and meshed anew."""

import os

import FreeCAD
import FreeCADGui
import ObjectsFem
from femmesh.gmshtools import GmshTools
from PySide import QtGui

from femscalpeltest.documents import geometry_link, need, solver_of
from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest, spin, wait_until, widget
from .hands import Hands, Window
from .mesh_content import content_of
from .test_panels_fit import scroll_area
from .test_undo import press_redo, press_undo

_THEMES = os.path.join(FreeCAD.getResourceDir(), "Gui", "Stylesheets")


class Bracket(GuiTest):
    """An L of two plates: its foot is held, its top pushed."""

    def setUp(self):
        need("gmsh", "Gmsh")
        need("ccx", "CalculiX")
        super().setUp()
        FreeCADGui.activateWorkbench("StartWorkbench")
        self.addCleanup(FreeCADGui.setLocale, "en")
        application = QtGui.QApplication.instance()
        self.addCleanup(application.setStyleSheet, application.styleSheet())
        doc = self.doc
        foot, upright = doc.addObject("Part::Box", "Foot"), doc.addObject("Part::Box", "Upright")
        foot.Length, foot.Width, foot.Height = 60, 30, 8
        upright.Length, upright.Width, upright.Height = 8, 30, 50
        self.part = doc.addObject("Part::Fuse", "Bracket")
        self.part.Base, self.part.Tool, self.part.Refine = foot, upright, True
        doc.recompute()
        self.mesh = ObjectsFem.makeMeshGmsh(doc, "BracketMesh")
        setattr(self.mesh, geometry_link(self.mesh), self.part)
        self.mesh.CharacteristicLengthMax, self.mesh.ElementOrder = 6, "2nd"
        GmshTools(self.mesh).create_mesh()
        self.analysis = ObjectsFem.makeAnalysis(doc, "Analysis")
        steel = ObjectsFem.makeMaterialSolid(doc, "Steel")
        steel.Material = {"Name": "Steel", "YoungsModulus": "210000 MPa", "PoissonRatio": "0.30"}
        fixed, force = ObjectsFem.makeConstraintFixed(doc, "Fixed"), ObjectsFem.makeConstraintForce(doc, "Force")
        fixed.References = [(self.part, self.face(lambda face: face.CenterOfMass.z < 1e-6))]
        top = self.face(lambda face: face.CenterOfMass.z > 50 - 1e-6)
        force.References, force.Force = [(self.part, top)], 500
        force.Direction = (self.part, [self.face(lambda face: face.CenterOfMass.x > 60 - 1e-6)])
        force.Reversed = True
        solver = ObjectsFem.makeSolverCalculixCcxTools(doc)
        for member in (solver, steel, fixed, force, self.mesh):
            self.analysis.addObject(member)
        self.part.ViewObject.Visibility = False
        doc.recompute()
        doc.clearUndos()
        self.solver = solver_of(doc) or solver
        self.look()
        self.window = Window(Hands())

    def face(self, wanted):
        """The name of the face of the part of which wanted(face) holds."""
        return next(f"Face{k}" for k, face in enumerate(self.part.Shape.Faces, 1) if wanted(face))

    def shot(self, what):
        screenshot(f"bracket_{self.where}_{what}")

    def state(self):
        meshes = [o for o in self.doc.Objects if o.isDerivedFrom("Fem::FemMeshObject")]
        return [m.Name for m in self.analysis.Group], {m.Name: (content_of(m), m.ViewObject.Visibility) for m in meshes}

    def crack(self):
        self.window.press("FemScalpel_Crack")
        self.wait_for_preview()
        spin(0.4)
        self.assertLessEqual(scroll_area().horizontalScrollBar().maximum(), 2, "the panel is wider than its dock")
        self.shot("1_crack")
        box = widget("patch")
        self.window.hands.choose(box, box.findData("Disk"))
        self.shot("1b_disk")
        self.window.enter(
            originX="4", originY="15", originZ="22", normalX="0", normalY="0", normalZ="1", patchRadius="2.5"
        )
        self.wait_for_preview()
        self.shot("2_crack")
        self.window.press_ok()
        self.shot("3_cracked")

    def drill(self):
        self.window.press("FemScalpel_Drill")
        self.wait_for_panel()
        self.window.enter(originX="36", originY="15", originZ="8", normalX="0", normalY="0", normalZ="1", radius="4")
        self.wait_for_preview()
        self.shot("4_drill")
        self.window.press_ok()
        self.shot("5_drilled")

    def slot(self):
        self.window.press("FemScalpel_Incision")
        self.wait_for_panel()
        box = widget("slotEnd")
        self.window.hands.choose(box, box.findData("Point"))
        self.window.enter(originX="50", originY="15", originZ="4", normalX="0", normalY="1", normalZ="0")
        self.window.enter(slotWidth="3", slotTurn="0")
        self.wait_for_preview()
        self.shot("6_slot")
        self.window.press_ok()
        self.shot("7_slotted")

    def wait_for_panel(self):
        wait_until(is_settled, "the panel")

    def results(self):
        return self.doc.findObjects("Fem::FemResultObject")

    def job(self):
        states = [self.state()]
        self.window.choose_workbench()
        for operation in (self.crack, self.drill, self.slot):
            operation()
            states.append(self.state())
        self.assertEqual([o.Label for o in self.analysis.Group if o.isDerivedFrom("Fem::FemMeshObject")], [self.last()])
        cut = self.doc.Incision if self.doc.getObject("Incision") else self.doc.Cut
        self.assertFalse(cut.Pieces, "it falls into pieces")
        for expected in states[2::-1]:
            press_undo()
            self.assertEqual(self.state(), expected)
        self.shot("8_undone")
        for expected in states[1:]:
            press_redo()
            self.assertEqual(self.state(), expected)
        # The first is edited, what follows goes with it.
        self.window.open_in_tree(self.doc.Crack.Label)
        self.wait_for_preview()
        self.window.enter(patchRadius="3")
        self.wait_for_preview()
        self.shot("9_edit")
        self.window.press_ok()
        self.assertAlmostEqual(self.doc.Crack.PatchRadius.Value, 3)
        self.assertNotIn("Touched", cut.State)
        self.assertGreater(cut.FemMesh.GroupCount, 0)
        self.window.solve(self.solver, self.results, lambda: self.shot("10_solved"))
        result = self.results()[0]
        self.assertEqual(len(result.NodeNumbers), cut.FemMesh.NodeCount)
        self.assertTrue(1e-3 < max(result.DisplacementLengths) < 10, max(result.DisplacementLengths))
        spin(0.2)
        self.shot("11_result")
        # The part is meshed anew.
        before = content_of(cut)
        self.mesh.CharacteristicLengthMax = 5
        GmshTools(self.mesh).create_mesh()
        self.doc.recompute()
        self.assertIn("Up-to-date", cut.State)
        self.assertNotEqual(content_of(cut), before)
        self.shot("12_meshed_anew")

    def last(self):
        return next(o.Label for o in reversed(self.doc.Objects) if o.isDerivedFrom("Fem::FemMeshObjectPython"))

    def test_english(self):
        self.where = "en_light"
        self.job()

    def test_german_and_dark(self):
        self.where = "de_dark"
        FreeCADGui.setLocale("de")
        with open(os.path.join(_THEMES, "Dark-blue.qss"), encoding="utf-8") as file:
            QtGui.QApplication.instance().setStyleSheet(file.read())
        spin(0.2)
        self.job()
