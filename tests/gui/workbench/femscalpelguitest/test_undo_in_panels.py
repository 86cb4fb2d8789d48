# SPDX-License-Identifier: LGPL-2.1-or-later
"""What happens to the document while a panel is open: undo and redo by keys, deletion in the tree."""

import FreeCAD
import FreeCADGui
import ObjectsFemScalpel
from PySide import QtCore, QtGui

import femmesh_bridge
from femscalpelobjects.memory import memory
from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest, QTest, is_ready, spin, value, wait_until, widget
from .mesh_content import content_of
from .test_crack_panel import long_box
from .test_undo import AnyOrder, UndoTest, press_redo, press_undo, step
from femscalpeltest.meshes import grid_box


def status_bar():
    return FreeCADGui.getMainWindow().statusBar().currentMessage()


def select(obj):
    FreeCADGui.Selection.clearSelection()
    FreeCADGui.Selection.addSelection(obj.Document.Name, obj.Name)


def delete(obj):
    """Selects an object and presses Delete."""
    select(obj)
    FreeCADGui.runCommand("Std_Delete")
    spin(0.1)


class WithPanel(UndoTest):
    """Two cracks, one behind the other; the first was moved."""

    def setUp(self):
        super().setUp()
        self.states = [self.state()]
        self.first = self.add_crack(self.mesh, 1.3)
        self.states.append(self.state())
        self.second = self.add_crack(self.first, 3.2)
        self.states.append(self.state())
        self.move(self.first, 1.7)
        self.states.append(self.state())

    def open_new(self, source):
        select(source)
        self.run_command("FemScalpel_Crack")
        choose("patch", "Whole")
        self.type_place(4.7)
        self.wait_for_preview()

    def type_place(self, at):
        for name, number in zip(("originX", "normalX", "normalY", "normalZ"), (at, *X)):
            type_into(name, repr(number))

    def edit(self, obj):
        FreeCADGui.getDocument(self.doc.Name).setEdit(obj.Name)
        self.wait_for_preview()

    def assertMadeOf(self, made, source):
        """That a crack is what the same makes of the mesh that its source has now."""
        memory.forget(self.doc)
        before = content_of(made)
        made.touch()
        self.doc.recompute()
        self.assertEqual(made.Source, source)
        self.assertEqual(content_of(made), before)


X = (1.0, 0.1, 0.2)


class NewOperation(WithPanel):
    def test_the_source_changes(self):
        """Undo gives the source another mesh: the preview, and OK, are of that."""
        self.open_new(self.second)
        before = widget("status").text()
        press_undo()
        self.assertState(self.states[2], "undone")
        wait_until(lambda: widget("status").text() != before, "the preview of the other mesh")
        self.wait_for_preview()
        press_redo()
        self.assertState(self.states[3], "redone")
        wait_until(lambda: is_settled() and widget("status").text() == before, "the preview of the first mesh")
        press_undo()
        press_ok()
        self.assertFalse(FreeCADGui.Control.activeDialog())
        self.assertEqual(self.doc.UndoNames[0], "Crack")
        self.assertMadeOf(self.doc.Crack002, self.second)
        self.assertFalse(self.doc.RedoNames)
        press_undo()
        self.assertState(self.states[2], "undone in the end")

    def test_the_source_goes(self):
        self.open_new(self.second)
        for k in (2, 1):
            press_undo()
            self.assertState(self.states[k], "undone")
        wait_until(lambda: not FreeCADGui.Control.activeDialog(), "the end of the panel")
        wait_until(lambda: "Crack001 is not there any more" in status_bar(), "the reason")
        screenshot("panel_closed_by_undo")
        self.assertIsNone(in_scene("FemScalpelRest"))
        for k in (2, 3):
            press_redo()
            self.assertState(self.states[k], "redone")

    def test_the_source_is_deleted_in_the_tree(self):
        self.open_new(self.second)
        before = len(self.doc.Objects)
        delete(self.second)
        if len(self.doc.Objects) < before:
            wait_until(lambda: not FreeCADGui.Control.activeDialog(), "the end of the panel")
        else:  # FreeCAD deletes nothing while a panel is open
            press_cancel()
        self.assertUpToDate()

    def test_the_source_loses_its_mesh(self):
        self.open_new(self.second)
        with step(self.doc, "Beside"):
            self.first.PlanePlacement = FreeCAD.Placement(FreeCAD.Vector(60, 0, 0), self.first.PlanePlacement.Rotation)
        wait_until(lambda: "has no mesh any more" in widget("status").text(), "the message")
        self.assertFalse(ok_button().isEnabled())
        self.assertEqual(faces_drawn("FemScalpelRest") + faces_drawn("FemScalpelBand"), 0)
        screenshot("source_without_mesh")
        press_undo()
        self.assertState(self.states[3], "undone")
        self.wait_for_preview()
        self.assertTrue(ok_button().isEnabled())
        press_cancel()
        self.assertState(self.states[3], "cancelled")

    def test_nothing_is_shown_over_the_preview(self):
        """Undo shows meshes again that the panel had hidden."""
        self.open_new(self.second)
        for _ in range(2):
            press_undo()
            spin(0.1)
            if FreeCADGui.Control.activeDialog():
                switches = [o.ViewObject.SwitchNode.whichChild.getValue() for o in self.doc.Objects if is_mesh(o)]
                self.assertEqual(set(switches), {-1})


def is_mesh(obj):
    return obj.isDerivedFrom("Fem::FemMeshObject")


def ok_button():
    boxes = button_boxes()
    return next(b.button(QtGui.QDialogButtonBox.Ok) for b in boxes if b.button(QtGui.QDialogButtonBox.Ok))


class Edited(WithPanel):
    def test_its_numbers_are_undone(self):
        self.edit(self.first)
        self.assertAlmostEqual(value("originX"), 1.7)
        press_undo()
        self.assertState(self.states[2], "undone")
        wait_until(lambda: abs(value("originX") - 1.3) < 1e-9, "the number in the field")
        self.wait_for_preview()
        screenshot("edit_undone")
        press_redo()
        wait_until(lambda: abs(value("originX") - 1.7) < 1e-9, "the number in the field")
        self.wait_for_preview()
        press_undo()
        wait_until(lambda: abs(value("originX") - 1.3) < 1e-9, "the number in the field")
        self.wait_for_preview()
        type_into("originX", "2.1")
        self.wait_for_preview()
        press_ok()
        self.assertAlmostEqual(self.first.PlanePlacement.Base.x, 2.1)
        self.assertUpToDate()
        press_undo()
        self.assertState(self.states[2], "undone after OK")

    def test_it_goes(self):
        self.edit(self.second)
        for k in (2, 1):
            press_undo()
            self.assertState(self.states[k], "undone")
        wait_until(lambda: not FreeCADGui.Control.activeDialog(), "the end of the panel")
        wait_until(lambda: "Crack001 is not there any more" in status_bar(), "the reason")
        for k in (2, 3):
            press_redo()
            self.assertState(self.states[k], "redone")

    def test_what_was_typed_stays_where_undo_is_about_something_else(self):
        self.edit(self.second)
        type_into("originX", "4.1")
        self.wait_for_preview()
        press_undo()
        self.assertState(self.states[2], "undone")
        spin(0.2)
        self.assertAlmostEqual(value("originX"), 4.1)
        self.wait_for_preview()
        press_cancel()
        self.assertState(self.states[2], "cancelled")
        press_redo()
        self.assertState(self.states[3], "redone")


class Others(GuiTest):
    def test_groups_are_listed_anew(self):
        mesh = self.add_mesh(long_box())
        self.run_command("FemScalpel_GroupInspector")
        table = widget("groups")
        wait_until(lambda: table.rowCount() > 0, "the list of groups")
        self.doc.openTransaction("Rename")
        ObjectsFemScalpel.renameGroup(mesh, "LEFT", "PORT")
        self.doc.commitTransaction()
        wait_until(lambda: table.findItems("PORT", QtCore.Qt.MatchExactly), "the new name")
        press_undo()
        wait_until(lambda: table.findItems("LEFT", QtCore.Qt.MatchExactly), "the old name")
        self.assertFalse(table.findItems("PORT", QtCore.Qt.MatchExactly))

    def test_the_mesh_to_add_goes(self):
        self.add_mesh(long_box())
        self.doc.openTransaction("Add")
        added = self.doc.addObject("Fem::FemMeshObject", "Rib")
        added.FemMesh = femmesh_bridge.to_femmesh(grid_box((4, 4, 4), (2.0, 2.0, 2.0)))
        self.doc.recompute()
        self.doc.commitTransaction()
        select(self.doc.Mesh)
        self.run_command("FemScalpel_Merge")
        wait_until(lambda: widget("addition").currentData() == "Rib", "the mesh to add")
        wait_until(is_ready, "the preview")
        press_undo()
        self.assertIsNone(self.doc.getObject("Rib"))
        wait_until(lambda: "no other FEM mesh" in widget("geometryError").text(), "the message")
        self.assertFalse(ok_button().isEnabled())

    def test_followed_geometry_goes(self):
        self.add_mesh(long_box())
        self.doc.openTransaction("Box")
        self.doc.addObject("Part::Box", "Box").Length = 6
        self.doc.recompute()
        self.doc.commitTransaction()
        select(self.doc.Mesh)
        self.run_command("FemScalpel_Crack")
        choose("patch", "Whole")
        self.wait_for_preview()
        panel_pick("pickGeometry", self.doc.Box, "Face2")
        wait_until(lambda: is_shown("followed") and "Box" in widget("followed").text(), "what it follows")
        self.wait_for_preview()
        press_undo()
        self.assertIsNone(self.doc.getObject("Box"))
        wait_until(lambda: "not there any more" in widget("geometryError").text(), "the message")
        self.assertFalse(ok_button().isEnabled())
        click("unlink")
        self.wait_for_preview()


def panel_pick(button, obj, name):
    """Presses a button that picks, and picks a part of an object."""
    click(button)
    FreeCADGui.Selection.addSelection(obj.Document.Name, obj.Name, name)
    spin(0.1)


class AnyOrderInPanels(AnyOrder):
    """As AnyOrder, by panels and keys; undo and redo are pressed also while a panel is open."""

    def make(self):
        meshes = [self.mesh, *self.cracks()]
        ends = [m for m in meshes if not any(getattr(o, "Source", None) == m for o in meshes)]
        usable = [m for m in ends if m.FemMesh.NodeCount and "Invalid" not in m.State]
        if len(meshes) >= 4 or not usable:
            return False
        select(usable[0])
        FreeCADGui.runCommand("FemScalpel_Crack")
        spin(0)
        choose("patch", "Whole")
        return self.in_panel()

    def edit(self):
        usable = [o for o in self.cracks() if o.Source.FemMesh.NodeCount]
        if not usable:
            return False
        FreeCADGui.getDocument(self.doc.Name).setEdit(self.random.choice(usable).Name)
        spin(0)
        return self.in_panel()

    def in_panel(self):
        """Types, presses undo and redo meanwhile, and ends the panel somehow. Whether something was made."""
        self.done[-1] += " in a panel"
        for _ in range(self.random.randint(0, 2)):
            self.random.choice((self.undo, self.redo, lambda: spin(0.1)))()
        spin(0.1)
        if not FreeCADGui.Control.activeDialog():
            return False
        type_into("originX", repr(self.anywhere()))
        for name, number in zip(("normalX", "normalY", "normalZ"), X):
            type_into(name, repr(number))
        self.random.choice((self.undo, self.redo, lambda: None, lambda: None))()
        spin(0.1)
        if not FreeCADGui.Control.activeDialog():
            return False
        if self.random.random() < 0.7:
            wait_until(is_ready, "what the panel says")
            count = self.doc.UndoCount
            if ok_button().isEnabled() and self.revived <= set(self.doc.Objects):
                self.done.append("OK")
                press_ok()
                if not FreeCADGui.Control.activeDialog():
                    self.assertEqual(self.doc.UndoCount, count + 1)
                    return True
        self.done.append("Cancel")
        press_cancel()
        self.assertFalse(FreeCADGui.Control.activeDialog())
        return False

    def delete(self):
        ends = [o for o in self.cracks() if not any(other.Source == o for other in self.cracks())]
        if not ends:
            return False
        before = set(self.doc.Objects)
        delete(self.random.choice(ends))
        self.doc.recompute()
        return set(self.doc.Objects) != before

    def test_any_order(self):
        super().test_any_order()
        # What a slow one gives: all computed anew, one behind the other.
        before = self.state()
        memory.forget(self.doc)
        for crack in self.cracks():
            crack.touch()
        self.doc.recompute()
        self.assertState(before, "computed anew")
