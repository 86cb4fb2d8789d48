# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which groups' borders keep their shape: the choice that the panels of all operators with `preserve` have."""

from unittest import mock

import FreeCADGui
from PySide import QtCore

import femmesh_bridge
import femscalpel as fs
import ObjectsFemScalpel
from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest, QTest
from .mesh_content import content_of
from .test_crack_panel import long_box

NAMES = ["LEFT", "RIGHT", "CORE", "FIX", "TOP"]


def tick(name):
    """Clicks the box of a group in the list, after it was scrolled to."""
    box = widget("preserved")
    (item,) = box.findItems(name, QtCore.Qt.MatchExactly)
    box.scrollToItem(item)
    spin(0)
    place = box.visualItemRect(item)
    at = QtCore.QPoint(place.left() + 8, place.center().y())
    QTest.mouseClick(box.viewport(), QtCore.Qt.LeftButton, QtCore.Qt.NoModifier, at)
    spin(0)


def ticked():
    box = widget("preserved")
    items = [box.item(row) for row in range(box.count())]
    return [item.text() for item in items if item.checkState() == QtCore.Qt.Checked]


class Preserve(GuiTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.add_mesh(long_box())

    def open_panel(self, name):
        self.run_command(name)
        wait_until(is_ready, "the panel")

    def test_made_edited(self):
        self.open_panel("FemScalpel_Crack")
        choose("patch", "Whole")
        self.assertEqual(widget("preserve").currentData(), "All")
        self.assertFalse(is_shown("preserved"))
        for name, text in (("originX", "5.1"), ("normalY", "0.3"), ("normalZ", "0.2")):
            type_into(name, text)
        choose("preserve", "Ticked")
        self.assertCountEqual(ticked(), NAMES)
        for name in ("CORE", "LEFT", "RIGHT"):
            tick(name)
        self.assertEqual(ticked(), [name for name in NAMES if name in ("FIX", "TOP")])
        source = femmesh_bridge.from_femmesh(self.mesh.FemMesh)
        tool = fs.Plane((5.1, 2.5, 2), (1, 0.3, 0.2))
        some, all_kept = (fs.crack(source, tool, preserve=p).report for p in (("FIX", "TOP"), None))
        shown = [f"{r.nodes_moved} nodes moved, {r.nodes_added} added" for r in (some, all_kept)]
        self.assertNotEqual(*shown)
        wait_until(lambda: widget("status").text().startswith(shown[0]), "the preview")
        screenshot("preserve")
        press_ok()
        crack = self.doc.Crack
        self.assertEqual(sorted(crack.PreservedGroups), ["FIX", "TOP"])
        self.assertEqual(crack.NodesMoved, some.nodes_moved)
        before = content_of(crack)

        crack.ViewObject.doubleClicked()
        self.wait_for_preview()
        self.assertEqual(sorted(ticked()), ["FIX", "TOP"])
        choose("preserve", "All")
        wait_until(lambda: widget("status").text().startswith(shown[1]), "the preview with all borders")
        press_ok()
        self.assertEqual(crack.PreservedGroups, ["*"])
        self.assertEqual(crack.NodesMoved, all_kept.nodes_moved)
        self.doc.undo()
        self.assertEqual(sorted(crack.PreservedGroups), ["FIX", "TOP"])
        self.assertEqual(content_of(crack), before)

    def test_none_ticked_is_no_border(self):
        crack = ObjectsFemScalpel.makeCrack(self.doc, self.mesh, origin=(5.1, 2.5, 2), normal=(1, 0, 0), preserve=())
        self.doc.recompute()
        crack.ViewObject.doubleClicked()
        self.wait_for_preview()
        self.assertEqual(ticked(), [])
        press_ok()
        self.assertEqual(crack.PreservedGroups, [])

    def test_group_that_is_gone(self):
        crack = ObjectsFemScalpel.makeCrack(
            self.doc, self.mesh, origin=(5.1, 2.5, 2), normal=(1, 0, 0), preserve=["GONE", "TOP"]
        )
        crack.ViewObject.doubleClicked()
        self.assertIn("GONE", self.wait_for_message("preserveError"))
        tick("GONE")
        self.wait_for_preview()
        self.assertFalse(is_shown("preserveError"))
        press_ok()
        self.assertEqual(crack.PreservedGroups, ["TOP"])

    def test_every_panel_with_the_option(self):
        for command, made, enter in (
            ("CylindricalCrack", "CylindricalCrack", (("originX", "5.1"), ("normalX", "0"), ("normalZ", "1"))),
            ("Drill", "Drill", (("originX", "5.1"), ("normalX", "0"), ("normalZ", "1"))),
            ("Incision", "Incision", (("originX", "5.1"),)),
            ("Fillet", "Fillet", ()),
        ):
            with self.subTest(command=command):
                self.open_panel("FemScalpel_" + command)
                for name, text in enter:
                    type_into(name, text)
                if command == "Fillet":
                    click("pickEdge")
                    FreeCADGui.Selection.addSelection(self.doc.Name, "Mesh", "Elem103F1", 6.1, 0.0, 0.01)
                    spin(0.1)
                    type_into("filletRadius", "0.7")
                choose("preserve", "Ticked")
                tick("CORE")
                self.wait_for_preview()
                press_ok()
                obj = self.doc.getObject(made)
                self.assertEqual(sorted(obj.PreservedGroups), sorted(set(NAMES) - {"CORE"}))
                (core,) = (g for g in obj.Proxy.report.groups if g.name == "CORE")
                self.assertFalse(core.boundary_kept)
                self.doc.undo()

    def test_reshape(self):
        self.open_panel("FemScalpel_Reshape")
        choose("wall", "TOP")
        type_into("originZ", "4.2")
        with mock.patch.object(fs.Scalpel, "reshape", autospec=True, side_effect=fs.Scalpel.reshape) as reshape:
            choose("preserve", "Ticked")
            tick("CORE")
            names = sorted(set(NAMES) - {"CORE"})
            wait_until(
                lambda: reshape.called and sorted(reshape.call_args[1]["preserve"] or ()) == names, "the new preview"
            )
            self.wait_for_preview()
        press_ok()
        self.assertEqual(sorted(self.doc.Reshape.PreservedGroups), names)

    def test_panels_without_it(self):
        self.open_panel("FemScalpel_Refine")
        self.assertFalse(is_shown("preserve"))
