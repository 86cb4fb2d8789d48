# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is seen of the tool, also outside the material; and that nothing is in its way."""

import math

import FreeCAD

from femscalpelgui.panels import fields
from .gui_testing import *  # noqa: F403
from .test_crack_panel import CrackTest
from .test_themes import READABLE, best_contrast, picture_of


def pane():
    """Corners of the pane of a plane, in its own axes; the first is also the last."""
    return [point.getValue() for point in in_scene("FemScalpelPane").point.getValues()]


class ToolIsSeen(CrackTest):
    def test_part_of_a_plane(self):
        self.run_command("FemScalpel_Crack")
        self.wait_for_preview()
        self.assertTrue(all(x >= 0 for x, _, _ in pane()))  # the half plane, on its side of the front
        self.assertEqual(min(x for x, _, _ in pane()), 0)
        screenshot("half_plane_seen")
        choose("patch", "Whole")
        self.assertAlmostEqual(sum(x for x, _, _ in pane()[:-1]), 0)
        choose("patch", "Disk")
        type_into("patchRadius", "1.3 mm")
        self.assertGreater(len(pane()), 40)
        for x, y, _ in pane():
            self.assertAlmostEqual(math.hypot(x, y), 1.3, places=5)
        choose("patch", "Ellipse")
        type_into("patchSecondRadius", "9 mm")  # beyond the material
        for x, y, _ in pane():
            self.assertAlmostEqual(math.hypot(x / 1.3, y / 9), 1, places=5)
        screenshot("ellipse_seen")

    def test_slot_down_to_the_point(self):
        self.run_command("FemScalpel_Incision")
        self.wait_for_preview()
        self.assertAlmostEqual(sum(x for x, _, _ in pane()[:-1]), 0)
        choose("slotEnd", "Point")
        self.assertEqual(min(x for x, _, _ in pane()), 0)  # the bottom
        self.assertGreater(max(x for x, _, _ in pane()), 1)
        type_into("slotTurn", "30 deg")
        turn = FreeCAD.Rotation(*shapes_in("FemScalpelHandles", coin.SoRotation)[0].rotation.getValue().getValue())
        self.assertAlmostEqual(math.degrees(turn.Angle), 30, places=3)
        screenshot("slot_seen")
        choose("slotEnd", "Through")
        self.assertAlmostEqual(sum(x for x, _, _ in pane()[:-1]), 0)

    def test_depth_has_an_end(self):
        self.run_command("FemScalpel_Drill")
        self.wait_for_preview()

        def heights():
            panes = [s for s in shapes_in("FemScalpelHandles", coin.SoCoordinate3) if s.point.getNum() > 90]
            return sorted({round(p.getValue()[2], 4) for p in panes[0].point.getValues()})

        self.assertEqual(len(heights()), 2)
        self.assertAlmostEqual(sum(heights()), 0, places=3)
        click("through")
        type_into("holeDepth", "1.7 mm")
        self.assertAlmostEqual(heights()[-1], 1.7, places=3)
        screenshot("blind_hole_seen")
        click("through")
        self.assertAlmostEqual(sum(heights()), 0, places=3)

    def test_cad_part_is_out_of_the_way(self):
        part = self.doc.addObject("Part::Box", "Box")
        part.Length, part.Width, part.Height = 14, 5, 4
        self.mesh.addProperty("App::PropertyLink", "Part")
        self.mesh.Part = part
        self.doc.recompute()
        switch = part.ViewObject.SwitchNode.whichChild
        before = switch.getValue()
        self.assertGreaterEqual(before, 0)
        self.open_panel()
        self.assertEqual(switch.getValue(), -1)
        self.assertTrue(part.ViewObject.Visibility)
        click("pickGeometry")
        self.assertEqual(switch.getValue(), before)  # it can be picked
        press_cancel()
        self.assertEqual(switch.getValue(), -1)
        press_cancel()
        self.assertEqual(switch.getValue(), before)

    def test_messages_in_dark_themes(self):
        application = QtGui.QApplication.instance()
        light = application.palette()
        dark = QtGui.QPalette(light)
        for role, colour in ((QtGui.QPalette.Window, "#2b2b2b"), (QtGui.QPalette.WindowText, "#eeeeee")):
            dark.setColor(role, QtGui.QColor(colour))
        self.addCleanup(application.setPalette, light)
        self.open_panel()
        type_into("originX", "500")
        self.wait_for_message("geometryError")
        self.assertIn(fields.ERROR, widget("geometryError").styleSheet())
        press_cancel()
        application.setPalette(dark)
        self.open_panel()
        type_into("originX", "500")
        self.wait_for_message("geometryError")
        picture = picture_of(widget("geometryError"))
        self.assertGreater(best_contrast(picture, picture.rect()), READABLE)
        screenshot("dark_error")
