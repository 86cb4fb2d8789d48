# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is seen of the tool, also outside the material; and that nothing is in its way."""

import math
import unittest

import FreeCAD
import numpy as np

import femscalpel as fs
from femscalpelgui.panels import fields, incision
from femscalpelgui.view.band import Band
from femscalpelgui.view.islands import together
from femscalpelgui.view.preview_data import PreviewSource
from femscalpeltest.meshes import grid_box
from .gui_testing import *  # noqa: F403
from .test_crack_panel import CrackTest
from .test_themes import READABLE, best_contrast, picture_of


def pane():
    """Corners of the pane of a plane, in its own axes; the first is also the last."""
    return [point.getValue() for point in in_scene("FemScalpelPane").point.getValues()]


def is_drawn(name):
    """Whether the part of the scene of that name is not switched off."""
    return shapes_in(name, coin.SoSwitch)[0].whichChild.getValue() >= 0


def in_marks():
    """Points of the lines that say how a tool's extents and angles count, in its own axes."""
    return [p.getValue() for p in shapes_in("FemScalpelMarkLines", coin.SoCoordinate3)[0].point.getValues()]


def green(picture, centre, radius):
    """Number of pixels of a picture within so many of a point of the model that have the handles' colour."""
    at = on_screen(centre)
    rows, columns = np.ogrid[: picture.shape[0], : picture.shape[1]]
    near = (rows - at.y()) ** 2 + (columns - at.x()) ** 2 <= radius**2
    red, green, blue = (picture[..., k].astype(int) for k in range(3))
    return int((near & (green > red + 50) & (green > blue + 50)).sum())


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
        self.assertAlmostEqual(min(x for x, _, _ in pane()), -max(x for x, _, _ in pane()))
        for width in (0.4, 0.9):
            type_into("slotWidth", f"{width} mm")
            heights = {round(z, 4) for _, _, z in pane()}
            self.assertEqual(heights, {-width / 2, width / 2})  # both walls
        choose("slotEnd", "Point")
        self.assertEqual(min(x for x, _, _ in pane()), 0)  # the bottom
        self.assertGreater(max(x for x, _, _ in pane()), 1)
        type_into("slotTurn", "30 deg")
        turn = FreeCAD.Rotation(*shapes_in("FemScalpelHandles", coin.SoRotation)[0].rotation.getValue().getValue())
        self.assertAlmostEqual(math.degrees(turn.Angle), 30, places=3)
        screenshot("slot_seen")
        choose("slotEnd", "Through")
        self.assertAlmostEqual(min(x for x, _, _ in pane()), -max(x for x, _, _ in pane()))

    def test_depth_has_an_end(self):
        self.run_command("FemScalpel_Drill")
        self.wait_for_preview()

        def heights():
            return sorted({round(p.getValue()[2], 4) for p in in_scene("FemScalpelWall").point.getValues()})

        self.assertEqual(len(heights()), 2)
        self.assertAlmostEqual(sum(heights()), 0, places=3)
        click("through")
        type_into("holeDepth", "1.7 mm")
        self.assertAlmostEqual(heights()[-1], 1.7, places=3)
        marks = in_marks()
        self.assertAlmostEqual(max(z for _, _, z in marks), 1.7, places=3)  # the arrow's tip, and its end
        self.assertAlmostEqual(min(z for _, _, z in marks), 0, places=3)
        self.assertTrue(is_drawn("FemScalpelZero"))
        self.assertFalse(is_drawn("FemScalpelZeroAngle"))
        self.wait_for_preview()
        screenshot("blind_hole_seen")
        click("through")
        self.assertAlmostEqual(sum(heights()), 0, places=3)
        self.assertFalse(is_drawn("FemScalpelToolMarks"))

    def test_part_of_a_cylinder(self):
        self.run_command("FemScalpel_CylindricalCrack")
        wait_until(is_settled, "the panel")
        self.assertFalse(is_drawn("FemScalpelToolMarks"))
        click("bounded")
        for name, text in (
            ("partLow", "-0.6 mm"),
            ("partHigh", "1.1 mm"),
            ("partStart", "20 deg"),
            ("partEnd", "110 deg"),
        ):
            type_into(name, text)
        wait_until(is_settled, "the panel")
        wall = np.array([p.getValue() for p in in_scene("FemScalpelWall").point.getValues()])
        self.assertAlmostEqual(wall[:, 2].min(), -0.6, places=5)
        self.assertAlmostEqual(wall[:, 2].max(), 1.1, places=5)
        angles = np.degrees(np.arctan2(wall[:, 1], wall[:, 0]))
        zero = shapes_in("FemScalpelZeroAngle", coin.SoTranslation)[0].translation.getValue().getValue()
        angles -= math.degrees(math.atan2(zero[1], zero[0]))
        self.assertAlmostEqual(angles.min(), 20, places=2)
        self.assertAlmostEqual(angles.max(), 110, places=2)
        self.assertTrue(is_drawn("FemScalpelZero"))
        screenshot("cylinder_part_seen")
        click("bounded")
        self.assertFalse(is_drawn("FemScalpelToolMarks"))

    def test_turn_of_a_part(self):
        self.run_command("FemScalpel_Crack")
        self.wait_for_preview()
        choose("patch", "Disk")
        self.assertFalse(is_drawn("FemScalpelToolMarks"))
        choose("patch", "Ellipse")
        self.assertTrue(is_drawn("FemScalpelToolMarks") and is_drawn("FemScalpelZeroAngle"))

        def towards():
            """The angle of the tip of the arrow."""
            marks = in_marks()
            return math.degrees(math.atan2(marks[-2][1], marks[-2][0]))

        for turn in (40, -70):
            type_into("patchTurn", f"{turn} deg")
            self.assertAlmostEqual(towards(), turn, places=2)
        self.wait_for_preview()
        screenshot("turn_seen")

    def test_handles_keep_their_size(self):
        self.open_panel()

        def length():
            return shapes_in("FemScalpelHandles", coin.SoScale)[0].scaleFactor.getValue().getValue()[0]

        before = length() / pixel()
        for factor in (0.25, 3):
            view().getCameraNode().height = view().getCameraNode().height.getValue() * factor
            wait_until(lambda: abs(length() / pixel() - before) < 0.03 * before, "handles of that size again")
            self.assertAlmostEqual(before, 70, delta=1)

    def test_handles_do_not_cover_a_small_tool(self):
        self.run_command("FemScalpel_Drill")
        self.wait_for_preview()
        choose("refine", "Never")
        view().viewTop()
        self.enter_drill(0.9)
        wait_until(lambda: green(canvas_picture(), (7, 2.5, 2), 30), "handles at the tool")
        for radius in (0.12, 0.02):
            self.enter_drill(radius)
            wait_until(is_settled, "the panel")
            picture = canvas_picture()
            over = green(picture, (7, 2.5, 2), max(radius / pixel(), 4))
            # What is smaller than a few pixels has a point of some pixels in its place.
            self.assertEqual(over, 0) if radius > 0.1 else self.assertTrue(0 < over < 20, over)
            self.assertGreater(green(picture, (7, 2.5, 2), 200), 100)  # they are beside it
            screenshot(f"small_tool_{radius}")
        aside = FreeCAD.Vector(*in_scene("FemScalpelAside").translation.getValue().getValue())
        across = np.array(aside) / aside.Length  # in the tool's axes, which are the model's but for the turn about z
        out = np.array((7, 2.5, 2)) + aside.Length * across
        tip = np.array((0.5**0.5, 0.5**0.5, 0)) * 70 * pixel()
        drag(out + tip, out + tip + (0.3, 0.3, 0))
        self.assertAlmostEqual(value("radius"), 0.02 + 0.3 * 2**0.5, delta=0.1)

    def enter_drill(self, radius):
        numbers = dict(originX=7, originY=2.5, originZ=2, normalX=0, normalY=0, normalZ=1, radius=radius)
        for name, number in numbers.items():
            type_into(name, repr(number))

    def test_handles_take_no_clicks_meant_for_nodes(self):
        self.open_panel()
        view().viewFront()
        view().fitAll()
        for name, number in (("originX", 7.0), ("originY", 0.0), ("originZ", 2.0)):
            type_into(name, repr(number))
        wait_until(is_settled, "the panel")
        click("pickNodes")
        self.assertEqual(green(canvas_picture(), (7, 0, 2), 60), 0)
        click_at((7.0, 0.0, 2.0))  # where the ball was
        self.assertIn("node 2 of 3", widget("hint").text())
        press_cancel()
        self.assertGreater(green(canvas_picture(), (7, 0, 2), 60), 50)

    def test_no_shards(self):
        for command, further in (("FemScalpel_Drill", self.blind), ("FemScalpel_Incision", self.down_to_the_point)):
            with self.subTest(command=command):
                self.run_command(command)
                self.wait_for_preview()
                choose("refine", "Never")
                further()
                self.wait_for_preview()
                screenshot("no_shards_" + command)
                index = np.array(shapes_in("FemScalpelBand", coin.SoIndexedFaceSet)[0].coordIndex.getValues())
                faces = np.array([(*face, -1) for face in np.split(index, np.flatnonzero(index < 0) + 1) if len(face)])
                self.assertEqual(len(set(together(faces[:, :4], faces.max() + 1))), 1)
                press_cancel()

    def blind(self):
        self.enter_drill(1.1)
        click("through")
        type_into("holeDepth", "0.6 mm")

    def down_to_the_point(self):
        choose("slotEnd", "Point")
        type_into("slotWidth", "0.5 mm")

    def test_moved_nodes_do_not_hide_the_lip(self):
        self.open_panel()
        choose("patch", "Disk")
        type_into("patchRadius", "1.2 mm")
        for name, number in (("originX", 7.3), ("normalX", 1.0), ("normalY", 0.1), ("normalZ", 0.15)):
            type_into(name, repr(number))
        choose("refine", "Never")
        self.wait_for_preview()
        self.assertGreater(moved_drawn(), 10)
        if widget("worst").isChecked():
            click("worst")
        view().viewRight()
        pictures = []
        for _ in range(2):
            pictures.append(canvas_picture().astype(int))
            screenshot(f"lip_{len(pictures)}")
            click("moved")
        at, radius = on_screen((7.3, 2.5, 2)), 1.2 / pixel()
        rows, columns = np.nonzero(abs(pictures[0] - pictures[1]).max(axis=2) > 30)
        self.assertGreater(len(rows), 0)
        self.assertGreater(min((rows - at.y()) ** 2 + (columns - at.x()) ** 2), (0.9 * radius) ** 2)

    def test_faces_of_parts_do_not_show_through(self):
        part = self.doc.addObject("Part::Box", "Beside")  # where the mesh is, but not what it was made from
        part.Length, part.Width, part.Height = 14, 5, 4
        part.ViewObject.ShapeColor = (1.0, 0.0, 0.0)
        self.doc.recompute()
        self.open_panel()
        choose("look", "whole")
        pictures = []
        for visible in (True, False):
            part.ViewObject.Visibility = visible
            pictures.append(canvas_picture().astype(int))
            screenshot(f"with_part_{visible}")
        differs = abs(pictures[0] - pictures[1]).max(axis=2) > 30
        self.assertLess(differs.sum(), 0.004 * differs.size)  # its outline

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


class WhatIsReplaced(unittest.TestCase):
    def test_elements_that_are_gone_away_from_the_tool(self):
        # A preview has only the elements near the tool: improving takes others away, which must not be drawn.
        mesh = grid_box((14, 10, 8), (14.0, 5.0, 4.0))
        source, centre = PreviewSource(mesh), (7.13, 2.57, 2.05)
        for normal, up in (((1, 0, 0), (0, 0, 1)), ((1, 0.2, 0.1), (0, 0.1, 1))):
            plane, bottom = fs.Plane(centre, normal), fs.Plane(centre, up)
            for width in (0.2, 0.35, 0.5):
                with self.subTest(normal=normal, width=width):
                    keywords = {"width": width, "bottom": bottom, "refine": False}
                    near = source.scalpel.cut(plane, band_only=True, **keywords)
                    all_of_it = source.scalpel.cut(plane, **keywords).mesh
                    there = np.zeros(len(source.cells), bool)
                    for ids in all_of_it.cell_ids.values():
                        there[source.cells.find(ids)] = True
                    band = Band(source, near, removed_region=incision._Slot(plane, width, bottom))
                    drawn = ~(band.gone | band.replaced)
                    self.assertFalse((drawn & ~there).any())
                    self.assertFalse((~drawn & there & band._lacking).any())
