# SPDX-License-Identifier: LGPL-2.1-or-later
"""Does whole jobs in FreeCAD's window with mouse and keys alone, and counts what is clicked and typed."""

import FreeCADGui
from PySide import QtCore, QtGui

from .gui_testing import QTest, button_boxes, is_shown, spin, wait_until, widget


class Hands:
    """A mouse and a keyboard that count."""

    def __init__(self):
        self.clicks = self.numbers = 0

    def click(self, box, place=None, double=False):
        """Clicks at a widget; a double click counts as two."""
        place = place or QtCore.QPoint(box.width() // 2, box.height() // 2)
        if QtGui.QApplication.activeWindow() is None:  # nobody activates it where there is no window manager
            FreeCADGui.getMainWindow().activateWindow()
            wait_until(lambda: QtGui.QApplication.activeWindow() is not None, "the main window")
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
        spin(0.6)  # Qt takes no release of the mouse so soon after it has opened the list
        self.click(entries.viewport(), entries.visualRect(index).center())
        wait_until(lambda: box.currentIndex() == row and not entries.isVisible(), "the entry of the list")

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
    """(viewport, place) of an object in FreeCAD's tree, which is unfolded for that."""
    flags = QtCore.Qt.MatchExactly | QtCore.Qt.MatchRecursive
    trees = [tree for tree in FreeCADGui.getMainWindow().findChildren(QtGui.QTreeWidget) if tree.isVisible()]
    for _ in range(10):
        for tree in trees:
            found = tree.findItems(label, flags)
            if found:
                tree.scrollToItem(found[0])
                spin(0.05)
                return tree.viewport(), tree.visualItemRect(found[0]).center()
            for item in tree.findItems("*", QtCore.Qt.MatchWildcard | QtCore.Qt.MatchRecursive):
                item.setExpanded(True)
        spin(0.1)
    raise AssertionError(f"the tree has no {label}")


def line_of(name):
    """The line of text of a field."""
    return widget(name).findChild(QtGui.QLineEdit)


def button_of_panel(choice):
    """OK, Cancel or Close of the task panel."""
    box = next(box for box in button_boxes() if box.button(choice))
    button = box.button(choice)
    button.box = box  # it would go with what Python has made of the box
    return button


class Window:
    """What is done in FreeCAD's window, by `hands`."""

    def __init__(self, hands):
        self.hands = hands

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
        bars = FreeCADGui.getMainWindow().findChildren(QtGui.QToolBar, "FemScalpel")
        action = FreeCADGui.Command.get(command).getAction()[0]
        wait_until(action.isEnabled, command)
        self.hands.click(next(box for bar in bars for box in [bar.widgetForAction(action)] if box is not None))

    def enter(self, **numbers):
        """Clicks at fields and types."""
        for name, number in numbers.items():
            self.hands.click(line_of(name))
            self.hands.type(number)

    def press_ok(self):
        """A click at OK, until the panel is gone."""
        self.hands.click(button_of_panel(QtGui.QDialogButtonBox.Ok))
        wait_until(lambda: not FreeCADGui.Control.activeDialog(), "the end of the panel")

    def show_tree(self):
        """A click at the tab of the tree, where the panel has covered it."""
        for bar in FreeCADGui.getMainWindow().findChildren(QtGui.QTabBar):
            for tab in range(bar.count()):
                if bar.tabText(tab) in ("Model", "Modell") and bar.isVisible() and bar.currentIndex() != tab:
                    self.hands.click(bar, bar.tabRect(tab).center())
                    return

    def open_in_tree(self, label):
        """A double click at an object in the tree."""
        self.show_tree()
        self.hands.click(*tree_place(label), double=True)

    def solve(self, solver, is_solved, picture=lambda: None):
        """Has CalculiX solve by the panel of FreeCAD's solver object, and closes that."""
        self.open_in_tree(solver.Label)
        wait_until(lambda: is_shown("pb_write_inp"), "the solver's panel")
        self.hands.click(widget("pb_write_inp"))
        wait_until(widget("pb_run_ccx").isEnabled, "the deck")
        self.hands.click(widget("pb_run_ccx"))
        wait_until(is_solved, "the result")
        picture()
        self.hands.click(button_of_panel(QtGui.QDialogButtonBox.Close))
