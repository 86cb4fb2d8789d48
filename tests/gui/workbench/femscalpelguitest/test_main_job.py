# SPDX-License-Identifier: LGPL-2.1-or-later
"""The main job: from opening the workbench to a disk crack solved by CalculiX, by mouse and keys alone, which are
counted."""

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from femscalpeltest.documents import need
from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest, QTest, is_shown, spin, wait_until, widget

#: What the job may take.
CLICKS, NUMBERS = 15, 4


class Hands:
    """A mouse and a keyboard that count."""

    def __init__(self):
        self.clicks = self.numbers = 0

    def click(self, box, place=None, double=False):
        """Clicks at a widget; a double click counts as two."""
        place = place or QtCore.QPoint(box.width() // 2, box.height() // 2)
        QTest.mouseMove(box, place)
        QTest.mouseClick(box, QtCore.Qt.LeftButton, QtCore.Qt.NoModifier, place)
        self.clicks += 1
        if double:
            QTest.mouseDClick(box, QtCore.Qt.LeftButton, QtCore.Qt.NoModifier, place)
            self.clicks += 1
        spin(0.1)

    def choose(self, box, row):
        """Chooses an entry of a combo box."""
        self.click(box)
        entries = box.view()
        wait_until(entries.isVisible, "the list")
        index = box.model().index(row, 0)
        entries.scrollTo(index)
        spin(0.2)
        self.click(entries.viewport(), entries.visualRect(index).center())

    def type(self, text):
        """Types a number where the focus is, in place of what is there, and goes on with Tab."""
        box = QtGui.QApplication.focusWidget()
        QTest.keyClick(box, QtCore.Qt.Key_A, QtCore.Qt.ControlModifier)
        for key in text:
            QTest.keyClick(box, key)
        QTest.keyClick(box, QtCore.Qt.Key_Tab)
        self.numbers += 1
        spin(0.05)


def tree_place(label):
    """(viewport, place) of an object in FreeCAD's tree."""
    for tree in FreeCADGui.getMainWindow().findChildren(QtGui.QTreeWidget):
        found = tree.findItems(label, QtCore.Qt.MatchExactly | QtCore.Qt.MatchRecursive) if tree.isVisible() else []
        if found:
            tree.scrollToItem(found[0])
            spin(0.05)
            return tree.viewport(), tree.visualItemRect(found[0]).center()
    raise AssertionError(f"the tree has no {label}")


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
        self.hands = Hands()

    def choose_workbench(self):
        """Two clicks in FreeCAD's own selector, which from 1.0 on may be of another kind."""
        window = FreeCADGui.getMainWindow()
        boxes = [b for b in window.findChildren(QtGui.QComboBox) if b.isVisible() and b.findText("FemScalpel") >= 0]
        if not boxes:
            self.hands.clicks += 2
            FreeCADGui.activateWorkbench("FemScalpelWorkbench")
            return
        self.hands.choose(boxes[0], boxes[0].findText("FemScalpel"))
        wait_until(lambda: FreeCADGui.activeWorkbench().name() == "FemScalpelWorkbench", "the workbench")

    def press(self, command):
        """A click at a button of the toolbar."""
        bars = FreeCADGui.getMainWindow().findChildren(QtGui.QToolBar)
        bar = next(b for b in bars if b.objectName() == "FemScalpel" or b.windowTitle() == "FemScalpel")
        wait_until(bar.isVisible, "the toolbar")
        action = next(a for a in bar.actions() if a.objectName() == command or command in a.data().__repr__())
        wait_until(action.isEnabled, command)
        self.hands.click(bar.widgetForAction(action))

    def test_disk_crack_solved(self):
        import ObjectsFemScalpel  # noqa: F401  what opening the document would do

        hands = self.hands
        self.choose_workbench()
        self.press("FemScalpel_Crack")
        self.wait_for_preview()
        screenshot("main_job_1_panel")
        box = widget("patch")
        hands.choose(box, box.findData("Disk"))
        self.assertEqual(box.currentData(), "Disk")
        # The place along the beam, turned across it, and the radius.
        hands.click(line_of("originX"))
        hands.type("4000")
        hands.click(line_of("patchRadius"))
        hands.type("300")
        self.wait_for_preview()
        screenshot("main_job_2_preview")
        hands.click(ok_button())
        wait_until(lambda: not FreeCADGui.Control.activeDialog(), "the end of the panel")
        screenshot("main_job_3_cracked")
        crack = self.doc.Crack
        self.assertIn(crack, self.doc.Analysis.Group)
        self.assertGreater(crack.FrontLength.Value, 0)
        solver = next(o for o in self.doc.Objects if "Solver" in o.TypeId)
        self.show_tree()
        hands.click(*tree_place(solver.Label), double=True)
        wait_until(lambda: is_shown("pb_write_inp"), "the solver's panel")
        hands.click(widget("pb_write_inp"))
        wait_until(widget("pb_run_ccx").isEnabled, "the deck")
        hands.click(widget("pb_run_ccx"))
        wait_until(lambda: self.doc.findObjects("Fem::FemResultObject"), "the result")
        screenshot("main_job_4_solved")
        hands.click(button_of_panel(QtGui.QDialogButtonBox.Close))
        result = self.doc.findObjects("Fem::FemResultObject")[0]
        self.assertEqual(len(result.NodeNumbers), crack.FemMesh.NodeCount)
        largest = max(result.DisplacementLengths)
        self.assertTrue(1 < largest < 1000, largest)
        FreeCAD.Console.PrintMessage(f"MAIN JOB: {hands.clicks} clicks, {hands.numbers} typed numbers\n")
        self.assertLessEqual(hands.clicks, CLICKS)
        self.assertLessEqual(hands.numbers, NUMBERS)

    def show_tree(self):
        """A click at the tab of the tree, where the panel has covered it."""
        for bar in FreeCADGui.getMainWindow().findChildren(QtGui.QTabBar):
            for tab in range(bar.count()):
                if bar.tabText(tab) == "Model" and bar.isVisible() and bar.currentIndex() != tab:
                    self.hands.click(bar, bar.tabRect(tab).center())
                    return


def line_of(name):
    """The line of text of a field."""
    return widget(name).findChild(QtGui.QLineEdit)


def button_of_panel(choice):
    boxes = [b for b in FreeCADGui.getMainWindow().findChildren(QtGui.QDialogButtonBox) if b.isVisible()]
    return next(b.button(choice) for b in boxes if b.button(choice))


def ok_button():
    return button_of_panel(QtGui.QDialogButtonBox.Ok)
