# SPDX-License-Identifier: LGPL-2.1-or-later
"""Picked geometry stays linked; fields take expressions."""

import math
from unittest import mock

import FreeCAD
import FreeCADGui
import Part
from PySide import QtCore, QtGui

import ObjectsFemScalpel

from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest, QTest
from femscalpeltest.meshes import box_with_groups


def expression_dialog():
    """FreeCAD's own dialog for an expression; None while it is not to be seen."""
    dialogs = (w for w in QtGui.QApplication.topLevelWidgets() if w.objectName() == "DlgExpressionInput")
    return next((dialog for dialog in dialogs if dialog.isVisible()), None)


class Following(GuiTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.add_mesh(box_with_groups())
        self.part = self.doc.addObject("Part::Box", "Box")
        self.part.Length, self.part.Width, self.part.Height = 3.3, 2, 2
        self.doc.recompute()
        self.doc.clearUndos()

    def open_panel(self, command="FemScalpel_Crack"):
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(self.doc.Name, "Mesh")
        self.run_command(command)
        self.wait_for_preview()

    def pick(self, button, *names):
        click(button)
        for name in names:
            FreeCADGui.Selection.addSelection(self.doc.Name, "Box", name)
            spin(0.1)

    def crack_from_face(self):
        self.open_panel()
        self.pick("pickGeometry", "Face2")
        self.wait_for_preview()
        press_ok()
        return self.doc.Crack

    def x_of(self, obj):
        return round(obj.PlanePlacement.Base.x, 9)

    def test_plane_from_a_face(self):
        self.open_panel()
        self.assertFalse(is_shown("followed"))
        self.pick("pickGeometry", "Face2")
        self.assertEqual(widget("followed").text(), "from Box.Face2")
        self.wait_for_preview()
        screenshot("following_face")
        press_ok()
        crack = self.doc.Crack
        self.assertEqual((crack.Follow, crack.FollowedName, self.x_of(crack)), ("Geometry", "Box.Face2", 3.3))
        self.part.Length = 3.7
        self.doc.recompute()
        self.assertEqual((self.x_of(crack), crack.State), (3.7, ["Up-to-date"]))
        crack.ViewObject.doubleClicked()
        self.wait_for_preview()
        self.assertEqual(widget("followed").text(), "from Box.Face2")
        type_into("offset", "0.2 mm")  # in the geometry's axes
        click("flip")
        self.assertEqual(widget("followed").text(), "from Box.Face2")
        self.wait_for_preview()
        press_ok()
        self.assertEqual((crack.Follow, self.x_of(crack)), ("Geometry", 3.9))
        self.part.Length = 3.3
        self.doc.recompute()
        self.assertEqual(self.x_of(crack), 3.5)
        self.assertAlmostEqual(crack.PlanePlacement.Rotation.multVec(FreeCAD.Vector(0, 0, 1)).x, -1)

    def test_by_hand(self):
        crack = self.crack_from_face()
        crack.ViewObject.doubleClicked()
        self.wait_for_preview()
        type_into("originX", "3.1 mm")
        self.assertIn("No longer follows Box.Face2", widget("followed").text())
        self.assertFalse(is_shown("unlink"))
        self.wait_for_preview()
        press_ok()
        self.assertEqual((crack.Follow, self.x_of(crack)), ("Numbers", 3.1))
        self.part.Length = 3.7
        self.doc.recompute()
        self.assertEqual(self.x_of(crack), 3.1)

    def test_unlink(self):
        crack = self.crack_from_face()
        crack.ViewObject.doubleClicked()
        self.wait_for_preview()
        click("unlink")
        self.assertFalse(is_shown("followed"))
        self.wait_for_preview()
        press_ok()
        self.assertEqual((crack.Follow, self.x_of(crack)), ("Numbers", 3.3))
        self.doc.undo()
        self.assertEqual((crack.Follow, crack.FollowedName), ("Geometry", "Box.Face2"))
        self.part.Length = 3.7
        self.doc.recompute()
        self.assertEqual(self.x_of(crack), 3.7)

    def test_broken(self):
        crack = self.crack_from_face()
        self.doc.removeObject("Box")
        self.doc.recompute()
        self.assertIn("Invalid", crack.State)
        crack.ViewObject.doubleClicked()
        self.assertIn("Box.Face2, where this was picked", self.wait_for_message("geometryError"))
        screenshot("following_broken")
        click("unlink")
        self.wait_for_preview()
        press_ok()
        self.assertEqual((crack.State, crack.Follow, self.x_of(crack)), (["Up-to-date"], "Numbers", 3.3))

    def test_vertices(self):
        self.open_panel()
        choose("patch", "Whole")
        self.pick("pickNodes", "Vertex5", "Vertex6", "Vertex7")
        self.assertEqual(widget("followed").text(), "from Box.Vertex5, Box.Vertex6, Box.Vertex7")
        self.wait_for_preview()
        press_ok()
        self.part.Length = 3.7
        self.doc.recompute()
        self.assertEqual(self.x_of(self.doc.Crack), 3.7)

    def test_axis_and_radius(self):
        rod = self.doc.addObject("Part::Cylinder", "Rod")
        rod.Radius, rod.Height, rod.Placement.Base = 0.8, 9, FreeCAD.Vector(3, 2.5, -1)
        self.doc.recompute()
        self.open_panel("FemScalpel_Drill")
        click("pickGeometry")
        FreeCADGui.Selection.addSelection(self.doc.Name, "Rod", "Face1")
        spin(0.1)
        self.assertEqual(widget("followed").text(), "from Rod.Face1, size included")
        self.wait_for_preview()
        press_ok()
        drill = self.doc.Drill
        rod.Radius, rod.Placement.Base = 0.9, FreeCAD.Vector(3.2, 2.5, -1)
        self.doc.recompute()
        self.assertEqual((drill.Radius.Value, round(drill.AxisPlacement.Base.x, 9)), (0.9, 3.2))
        drill.ViewObject.doubleClicked()
        self.wait_for_preview()
        type_into("radius", "0.7 mm")
        self.assertEqual(widget("followed").text(), "from Rod.Face1")
        self.wait_for_preview()
        press_ok()
        self.assertEqual((drill.Radius.Value, drill.SizeFollows, drill.Follow), (0.7, False, "Geometry"))

    def test_sketch_and_its_size(self):
        sketch = self.doc.addObject("Sketcher::SketchObject", "Outline")
        axes = FreeCAD.Rotation(FreeCAD.Vector(0, 1, 0), FreeCAD.Vector(0, 0, 1), FreeCAD.Vector(1, 0, 0), "XYZ")
        sketch.Placement = FreeCAD.Placement(FreeCAD.Vector(3.3, 2, 2), axes)
        corners = [FreeCAD.Vector(*xy, 0) for xy in ((-1.2, -1), (1.7, -0.8), (1.1, 0.9), (-0.3, 1.4))]
        for a, b in zip(corners, corners[1:] + corners[:1]):
            sketch.addGeometry(Part.LineSegment(a, b))
        self.doc.recompute()
        self.open_panel()
        click("pickGeometry")
        FreeCADGui.Selection.addSelection(self.doc.Name, "Outline", "Edge1")
        spin(0.1)
        self.assertEqual(widget("followed").text(), "from Outline, size included")
        click("flip")
        self.assertEqual(widget("followed").text(), "from Outline, size included")
        self.wait_for_preview()
        press_ok()
        crack = self.doc.Crack
        for number in range(4):
            sketch.delGeometry(0)
        corners = [1.1 * corner for corner in corners]
        for a, b in zip(corners, corners[1:] + corners[:1]):
            sketch.addGeometry(Part.LineSegment(a, b))
        self.doc.recompute()
        self.assertEqual(crack.State, ["Up-to-date"])
        for corner, local in zip(corners, crack.PatchCorners):
            place = crack.PlanePlacement.multVec(local)
            self.assertLess(place.distanceToPoint(FreeCAD.Vector(3.3, 2 + corner.x, 2 + corner.y)), 1e-9)

    def enter_expression(self, name, text):
        """Enters an expression by FreeCAD's own dialog."""
        box = widget(name)
        box.setFocus()
        QTest.keyClick(box, QtCore.Qt.Key_Equal)
        wait_until(expression_dialog, "the dialog of expressions")
        dialog = expression_dialog()
        line = widget("expression", dialog)
        line.setFocus()
        QTest.keyClicks(line, text)
        spin(0.2)
        # FreeCAD 1.1 has a box of buttons in place of one of its own name.
        box = dialog.findChild(QtGui.QDialogButtonBox)
        ok = box.button(QtGui.QDialogButtonBox.Ok) if box else widget("okBtn", dialog)
        QTest.mouseClick(ok, QtCore.Qt.LeftButton)
        spin(0.2)

    def enter_new_expression(self, name, *texts):
        """Enters expressions in the panel's own dialog, of which all but the last are refused."""
        self.answer_new_expression(name, texts, lambda box: QTest.keyClick(box, QtCore.Qt.Key_Equal))

    def answer_new_expression(self, name, texts, ask):
        left, labels = list(texts), []

        def answer():
            dialog = QtGui.QApplication.activeModalWidget()
            if dialog is not None:
                labels.append(dialog.labelText())
                dialog.setTextValue(left.pop(0))
                dialog.accept()

        timer = QtCore.QTimer()
        timer.timeout.connect(answer)
        timer.start(100)
        box = widget(name)
        box.setFocus()
        ask(box)
        wait_until(lambda: not left, "the dialog")
        timer.stop()
        spin(0.2)
        for label in labels[1:]:
            self.assertIn("mm^2", label)

    def drill(self):
        self.open_panel("FemScalpel_Drill")
        press_ok()
        self.doc.clearUndos()
        self.doc.Drill.ViewObject.doubleClicked()
        self.wait_for_preview()
        return self.doc.Drill

    def test_expression(self):
        drill = self.drill()
        old = drill.Radius.Value
        self.enter_expression("radius", "Box.Length / 5")
        self.enter_expression("originX", "Box.Length")
        self.assertEqual((round(value("radius"), 9), value("originX")), (0.66, 3.3))
        self.wait_for_preview()
        screenshot("expression")
        press_ok()
        self.assertEqual(dict(drill.ExpressionEngine).keys(), {"Radius", ".AxisPlacement.Base.x"})
        self.assertEqual((round(drill.Radius.Value, 9), drill.AxisPlacement.Base.x), (0.66, 3.3))
        self.part.Length = 3.5
        self.doc.recompute()
        self.assertEqual((round(drill.Radius.Value, 9), drill.AxisPlacement.Base.x), (0.7, 3.5))
        self.part.Length = 3.3
        self.doc.recompute()
        self.doc.undo()
        self.assertEqual((drill.ExpressionEngine, drill.Radius.Value), ([], old))

    def test_expression_of_a_new_object(self):
        names = [o.Name for o in self.doc.Objects]
        self.open_panel("FemScalpel_Drill")
        self.enter_new_expression("radius", "Box.Length * Box.Length", "Box.Length / 5")
        self.assertAlmostEqual(value("radius"), 0.66)
        press_cancel()
        self.assertEqual([o.Name for o in self.doc.Objects], names)
        self.assertEqual(self.doc.UndoNames, [])
        self.open_panel("FemScalpel_Drill")
        self.enter_new_expression("radius", "Box.Length / 5")
        self.assertAlmostEqual(value("radius"), 0.66)
        type_into("radius", "2 mm")  # in vain
        self.assertAlmostEqual(value("radius"), 0.66)
        self.wait_for_preview()
        press_ok()
        self.assertEqual([o.Name for o in self.doc.Objects], [*names, "Drill"])
        self.assertEqual(dict(self.doc.Drill.ExpressionEngine).keys(), {"Radius"})
        self.part.Length = 3.5
        self.doc.recompute()
        self.assertAlmostEqual(self.doc.Drill.Radius.Value, 0.7)

    def test_mark_of_a_new_object(self):
        """Fields that take expressions have FreeCAD's f(x) icon, which asks for one and shows that there is one."""

        def picture(icon):
            return icon.pixmap(16).toImage()

        def mark(name):
            return widget(name).findChild(QtGui.QAction, "expression")

        unset, entered = (QtGui.QIcon(f":/icons/bound-expression{end}.svg") for end in ("-unset", ""))
        self.assertNotEqual(picture(unset), picture(entered))
        self.open_panel("FemScalpel_Drill")
        for name in ("originX", "originY", "originZ", "normalX", "normalY", "normalZ", "radius"):
            widget(name).setFocus()
            spin(0)
            self.assertEqual(picture(mark(name).icon()), picture(unset), name)
            self.assertTrue(mark(name).isVisible())
        self.assertFalse(mark("originX").isVisible())  # not where it would hide digits
        icon_box = next(b for b in widget("radius").findChildren(QtGui.QToolButton) if b.isVisible())

        def press(box):
            QtCore.QTimer.singleShot(0, lambda: QTest.mouseClick(icon_box, QtCore.Qt.LeftButton))

        self.answer_new_expression("radius", ("Box.Length / 5",), press)
        self.assertAlmostEqual(value("radius"), 0.66)
        self.assertEqual(picture(mark("radius").icon()), picture(entered))
        self.assertEqual(mark("radius").toolTip(), "= Box.Length / 5")
        widget("originX").setFocus()
        spin(0)
        self.assertTrue(mark("radius").isVisible())
        screenshot("new_expression")
        widget("radius").setFocus()
        spin(0)
        self.answer_new_expression("radius", ("",), press)
        self.assertEqual(picture(mark("radius").icon()), picture(unset))
        self.wait_for_preview()

    def test_cancelled_expression(self):
        drill = self.drill()
        old = drill.Radius.Value
        self.enter_expression("radius", "Box.Length / 5")
        self.assertAlmostEqual(value("radius"), 0.66)
        press_cancel()
        self.assertEqual((drill.ExpressionEngine, drill.Radius.Value, drill.State), ([], old, ["Up-to-date"]))
        self.assertEqual((self.doc.UndoNames, self.doc.RedoNames), ([], []))

    def test_one_step_to_undo(self):
        drill = self.drill()
        self.enter_expression("radius", "Box.Length / 5")
        self.wait_for_preview()
        press_ok()
        self.assertEqual((self.doc.UndoNames, self.doc.RedoNames), (["Drill"], []))
        self.assertAlmostEqual(drill.Radius.Value, 0.66)

    def z_of(self, obj):
        return obj.PlanePlacement.Rotation.multVec(FreeCAD.Vector(0, 0, 1))

    def test_direction_and_offset_of_a_new_object(self):
        self.open_panel()
        choose("patch", "Whole")
        self.enter_new_expression("normalY", "Box.Width / Box.Length")
        self.enter_new_expression("offset", "Box.Height / 4")
        x = value("originX")
        slope = 2 / 3.3
        self.wait_for_preview()
        screenshot("expression_of_a_normal")
        press_ok()
        crack = self.doc.Crack
        self.assertEqual(dict(crack.ExpressionEngine).keys(), {".Direction.y", "Offset"})
        for height, width in ((2, 2), (3, 1), (2, 2)):
            self.part.Height, self.part.Width = height, width
            self.doc.recompute()
            normal = FreeCAD.Vector(1, width / 3.3, 0).normalize()
            self.assertLess((self.z_of(crack) - normal).Length, 1e-6)
            self.assertAlmostEqual(crack.PlanePlacement.Base.x, x + height / 4 * normal.x, places=6)
            self.assertEqual(crack.State, ["Up-to-date"])
        crack.ViewObject.doubleClicked()  # again, and nothing is another
        self.wait_for_preview()
        self.assertAlmostEqual(value("normalY") / value("normalX"), slope, places=2)
        self.assertAlmostEqual(value("offset"), 0.5)
        before = crack.PlanePlacement.Base.x
        press_ok()
        self.assertAlmostEqual(crack.PlanePlacement.Base.x, before, places=6)
        self.assertEqual(dict(crack.ExpressionEngine).keys(), {".Direction.y", "Offset"})

    def test_turn(self):
        self.open_panel()
        choose("patch", "Ellipse")
        self.wait_for_preview()
        press_ok()
        crack = self.doc.Crack
        crack.ViewObject.doubleClicked()
        self.wait_for_preview()
        self.enter_expression("patchTurn", "Box.Length / 1 mm * 10 deg")
        self.assertAlmostEqual(value("patchTurn"), 33)
        self.wait_for_preview()
        press_ok()
        plain, x = FreeCAD.Rotation(FreeCAD.Vector(0, 0, 1), self.z_of(crack)), FreeCAD.Vector(1, 0, 0)
        for length in (3.3, 5.0):
            self.part.Length = length
            self.doc.recompute()
            along = plain.inverted().multVec(crack.PlanePlacement.Rotation.multVec(x))
            self.assertAlmostEqual(math.degrees(math.atan2(along.y, along.x)), 10 * length, places=4)

    def test_turn_of_a_slot_with_a_bottom(self):
        self.open_panel("FemScalpel_Incision")
        choose("slotEnd", "Point")
        self.enter_new_expression("slotTurn", "Box.Length / 1 mm * 10 deg")
        self.wait_for_preview()
        press_ok()
        cut = self.doc.Incision
        for length in (3.3, 6.0, 3.3):
            self.part.Length = length
            self.doc.recompute()
            mouth = cut.BottomPlacement.Rotation.multVec(FreeCAD.Vector(0, 0, -1))
            plain = FreeCAD.Rotation(FreeCAD.Vector(0, 0, 1), self.z_of(cut)).inverted().multVec(mouth)
            self.assertAlmostEqual(math.degrees(math.atan2(plain.y, plain.x)), 10 * length, places=4)

    def test_vector(self):
        self.run_command("FemScalpel_Reshape")
        wait_until(is_ready, "the panel")
        choose("wall", "TOP")
        choose("motion", "By")
        self.enter_new_expression("vectorZ", "Box.Length / 33")
        self.wait_for_preview()
        self.assertAlmostEqual(value("vectorZ"), 0.1)
        press_ok()
        self.part.Length = 6.6
        self.doc.recompute()
        self.assertAlmostEqual(self.doc.Reshape.MoveBy.z, 0.2)

    def test_zero_direction(self):
        self.open_panel()
        choose("patch", "Whole")
        self.enter_new_expression("normalX", "Box.Length / 1 mm - 2.3")
        self.wait_for_preview()
        press_ok()
        self.part.Length = 2.3
        self.doc.recompute()
        self.assertIn("Invalid", self.doc.Crack.State)
        wait_until(lambda: "Direction, as its expressions say it, is zero" in report_view(), "the reason")
        self.part.Length = 3.3
        self.doc.recompute()
        self.assertEqual(self.doc.Crack.State, ["Up-to-date"])

    def test_expression_ends_following(self):
        crack = self.crack_from_face()
        crack.ViewObject.doubleClicked()
        self.wait_for_preview()
        self.enter_expression("originX", "Box.Length - 0.2 mm")
        self.assertIn("No longer follows", widget("followed").text())
        self.assertFalse(widget("offset").isEnabled())
        self.wait_for_preview()
        press_ok()
        self.assertEqual((crack.Follow, self.x_of(crack)), ("Numbers", 3.1))

    def test_macro(self):
        lines, real = [], FreeCADGui.doCommand
        with mock.patch.object(FreeCADGui, "doCommand", lambda line: (lines.append(line), real(line))):
            self.crack_from_face()
        self.doc.removeObject("Crack")
        self.part.Length = 3.7
        self.doc.recompute()
        for line in lines:
            exec(line, {"FreeCAD": FreeCAD, "ObjectsFemScalpel": ObjectsFemScalpel})
        self.assertEqual((self.doc.Crack.Follow, self.x_of(self.doc.Crack)), ("Geometry", 3.7))
