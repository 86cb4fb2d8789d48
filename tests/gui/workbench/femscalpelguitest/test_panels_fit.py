# SPDX-License-Identifier: LGPL-2.1-or-later
"""Panels at the dock's default width: everything can be reached, sections fold, fields have names."""

import os

import femscalpel as fs
import ObjectsFem
import ObjectsFemScalpel
from femscalpelgui import preferences
from femscalpelgui.commands import COMMANDS
from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest, QTest
from .test_crack_panel import CrackTest, long_box

FIELDS = (QtGui.QAbstractSpinBox, QtGui.QComboBox, QtGui.QLineEdit, QtGui.QTableWidget, QtGui.QListWidget)


NARROW = 276  # pixels of the dock at FreeCAD's first start


def scroll_area():
    """The scroll area of the task panel."""
    areas = FreeCADGui.getMainWindow().findChildren(QtGui.QScrollArea)
    status = [w for w in FreeCADGui.getMainWindow().findChildren(QtGui.QLabel, "status") if w.isVisible()][-1]
    return next(area for area in areas if area.isVisible() and area.isAncestorOf(status))


def cut_off(area):
    """Texts of the buttons and boxes to tick that are wider than these."""
    boxes = [b for b in area.findChildren(QtGui.QAbstractButton) if b.isVisible()]
    wide = lambda b: max(b.fontMetrics().boundingRect(line).width() for line in b.text().split("\n"))  # noqa: E731
    return [b.text() for b in boxes if wide(b) > b.width() - 4]


def hidden_numbers(area):
    """Texts of the fields whose first digits are out of sight."""
    hidden = []
    for box in area.findChildren(QtGui.QAbstractSpinBox):
        line = box.findChild(QtGui.QLineEdit)
        digits = line.text().split(" ")[0]
        # The place of the cursor is where it is seen; the icon of expressions takes 22 pixels.
        room = line.width() - (26 if is_marked(line) else 4)
        first = line.cursorPosition() == 0 and line.fontMetrics().boundingRect(digits).width() <= room
        if box.isVisible() and not first and line.fontMetrics().boundingRect(line.text()).width() > room:
            hidden.append(line.text())
    return hidden


def is_marked(line):
    """Whether the icon of expressions is in a field: ours, or FreeCAD's."""
    own = line.findChild(QtGui.QAction, "expression")
    return own.isVisible() if own is not None else True


class EveryPanel(GuiTest):
    def setUp(self):
        super().setUp()
        self.addCleanup(FreeCADGui.setLocale, "en")
        mesh = self.add_mesh(long_box())
        ObjectsFem.makeAnalysis(self.doc, "Analysis").addObject(mesh)  # there is more to be said then

    def test_nothing_is_cut_off(self):
        """In the dock as wide as FreeCAD makes it at first, in every language, with all sections open; also in a theme
        with wide buttons."""
        application = QtGui.QApplication.instance()
        self.addCleanup(application.setStyleSheet, application.styleSheet())
        looks = [("en", None), ("de", None), ("fr", None)]
        looks += [("de", name) for name in ("Dark-blue.qss", "ProDark.qss") if os.path.exists(theme_file(name))]
        for language, theme in looks:
            FreeCADGui.setLocale(language)
            if theme:
                choose_theme(theme)
            spin(0.2)
            resize_panel(NARROW)
            for command in COMMANDS:
                if command is None or command.PANEL is None:
                    continue
                with self.subTest(command=command.NAME, language=language, theme=theme):
                    FreeCADGui.runCommand(command.NAME)
                    spin(0.2)
                    try:
                        self.assertTrue(widget("status").isVisible())
                        self.assertEqual(is_shown("intoAnalysis"), hasattr(command.PANEL, "OFFERED"))
                        for header in ("sectionAdvanced", "sectionRefinement"):
                            if is_shown(header):
                                widget(header).setChecked(True)
                        spin(0.1)
                        bar = scroll_area().horizontalScrollBar()
                        self.assertEqual(bar.maximum(), 0, "wider than the dock")
                        self.assertEqual(cut_off(scroll_area()), [])
                        screenshot(f"fits_{language}_{theme or ''}{command.page()}")
                    finally:
                        press_button(QtGui.QDialogButtonBox.Cancel, QtGui.QDialogButtonBox.Close)

    def test_numbers_are_seen_whole(self):
        """Also large ones, beside the icon of expressions, in panels of new objects and of those that are there."""
        large = long_box()
        self.doc.removeObject("Mesh")
        self.add_mesh(fs.Mesh(large.points * 1000 - 20000, large.cells))
        for command in COMMANDS:
            if command is None or command.PANEL is None or command.NAME == "FemScalpel_Merge":
                continue
            with self.subTest(command=command.NAME):
                FreeCADGui.Selection.clearSelection()
                FreeCADGui.Selection.addSelection(self.doc.Name, "Mesh")
                FreeCADGui.runCommand(command.NAME)
                wait_until(is_ready, "the panel")
                spin(0.1)
                self.assertEqual(hidden_numbers(scroll_area()), [])
                press_button(QtGui.QDialogButtonBox.Cancel, QtGui.QDialogButtonBox.Close)
            if FreeCADGui.Control.activeDialog():
                press_button(QtGui.QDialogButtonBox.Cancel, QtGui.QDialogButtonBox.Close)
        drill = ObjectsFemScalpel.makeDrill(self.doc, self.doc.Mesh, origin=(-13000, -17500, -18000), radius=1000)
        self.doc.recompute()
        drill.ViewObject.doubleClicked()
        self.wait_for_preview()
        screenshot("numbers_seen_whole")
        self.assertEqual(hidden_numbers(scroll_area()), [])
        press_cancel()

    def test_fields_have_names(self):
        for command in COMMANDS:
            if command is None or command.PANEL is None:
                continue
            with self.subTest(command=command.NAME):
                FreeCADGui.runCommand(command.NAME)
                spin(0.1)
                area = scroll_area()
                buddies = {id(label.buddy()) for label in area.findChildren(QtGui.QLabel) if label.buddy()}
                for kind in FIELDS:
                    for field in area.findChildren(kind):
                        if field.objectName().startswith("qt_"):
                            continue
                        self.assertTrue(field.accessibleName() or field.placeholderText(), field.objectName())
                self.assertTrue(buddies or command.NAME in ("FemScalpel_GroupInspector", "FemScalpel_MeshQuality"))
                press_button(QtGui.QDialogButtonBox.Cancel, QtGui.QDialogButtonBox.Close)


class Sections(CrackTest):
    def tearDown(self):
        super().tearDown()
        for name in ("Advanced", "Refinement"):
            FreeCAD.ParamGet(preferences.GROUP).RemBool("Unfolded" + name)

    def visible(self, name):
        return any(w.isVisible() for w in FreeCADGui.getMainWindow().findChildren(QtGui.QWidget, name))

    def test_fold_and_are_remembered(self):
        self.open_panel()
        self.assertTrue(self.visible("refine"))
        self.assertFalse(self.visible("method"))
        screenshot("sections_folded")
        click("sectionAdvanced")
        self.assertTrue(self.visible("method") and self.visible("transition") and self.visible("preserve"))
        self.assertFalse(self.visible("preserved"))  # that is about something else
        click("sectionRefinement")
        self.assertFalse(self.visible("refine"))
        screenshot("sections_unfolded")
        press_cancel()
        self.open_panel()
        self.assertTrue(self.visible("method"))
        self.assertFalse(self.visible("refine"))
        click("sectionAdvanced")
        self.assertFalse(self.visible("method"))

    def test_a_message_unfolds(self):
        self.open_panel()
        widget("sectionRefinement").setChecked(False)
        panel = [box for box in FreeCADGui.getMainWindow().findChildren(QtGui.QLabel, "refineError")][-1]
        self.assertFalse(panel.isVisible())
        choose("refine", "Size")
        widget("sectionRefinement").setChecked(False)
        widget("sectionAdvanced").setChecked(True)
        choose("method", "deform")
        choose("patch", "Disk")
        widget("sectionAdvanced").setChecked(False)
        type_into("offset", "0.1")
        self.assertTrue(self.wait_for_message("methodError"))
        self.assertTrue(self.visible("method"))

    def test_ok_is_grey_while_there_is_an_error(self):
        self.open_panel()
        boxes = button_boxes()
        ok = next(b.button(QtGui.QDialogButtonBox.Ok) for b in boxes if b.button(QtGui.QDialogButtonBox.Ok))
        self.assertTrue(ok.isEnabled())
        type_into("originX", "900")
        self.wait_for_message("geometryError")
        self.assertFalse(ok.isEnabled())
        type_into("originX", "7")
        self.wait_for_preview()
        self.assertTrue(ok.isEnabled())


class Messages(CrackTest):
    def place(self, name):
        return widget(name).mapToGlobal(QtCore.QPoint(0, 0)).y()

    def test_do_not_move_what_is_under_the_mouse(self):
        self.open_panel()
        field = widget("groupName")
        QtGui.QCursor.setPos(field.mapToGlobal(field.rect().center()))
        spin(0.3)
        before = self.place("groupName")
        for _ in range(2):
            widget("originX").setProperty("rawValue", 900)
            self.wait_for_message("geometryError")
            spin(0.3)
            self.assertEqual(self.place("groupName"), before)
            screenshot("message_beside_the_mouse")
            widget("originX").setProperty("rawValue", 7)
            self.wait_for_preview()
            spin(0.3)
            self.assertEqual(self.place("groupName"), before)
