# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields of the task panels: the wheel, the Enter key; the OK button, and what is said while a preview is made."""

import threading
from unittest import mock

import FreeCADGui
from PySide import QtCore, QtGui

from femscalpelgui.event_filter import EventFilter
from femscalpelgui.panels import tool_panel
from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest, QTest
from femscalpeltest.meshes import box_with_groups


def ok_button():
    boxes = button_boxes()
    return next(b.button(QtGui.QDialogButtonBox.Ok) for b in boxes if b.button(QtGui.QDialogButtonBox.Ok))


def turn_wheel(name):
    """Turns the mouse wheel over a field."""
    field = widget(name)
    place = field.rect().center()
    turned = QtCore.QPoint(0, 120)
    event = QtGui.QWheelEvent(
        place,
        field.mapToGlobal(place),
        QtCore.QPoint(),
        turned,
        QtCore.Qt.NoButton,
        QtCore.Qt.NoModifier,
        QtCore.Qt.NoScrollPhase,
        False,
    )
    QtGui.QApplication.sendEvent(field, event)
    spin(0)


def type_slowly(name, text):
    """Types into a field, and stays in it."""
    field = widget(name)
    field.setFocus()
    edit = field if isinstance(field, QtGui.QLineEdit) else field.findChild(QtGui.QLineEdit)
    edit.selectAll()
    QTest.keyClicks(field, text)


class Fields(GuiTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.add_mesh(box_with_groups())
        FreeCADGui.getMainWindow().activateWindow()
        self.run_command("FemScalpel_Crack")
        self.wait_for_preview()

    def test_wheel(self):
        for name, value_of in (
            ("originX", lambda: value("originX")),
            ("transition", lambda: widget("transition").value()),
            ("refine", lambda: widget("refine").currentIndex()),
        ):
            with self.subTest(field=name):
                if name == "refine":
                    choose("refine", "Never")
                widget("groupName").setFocus()
                before = value_of()
                turn_wheel(name)
                self.assertEqual(value_of(), before)
                self.assertFalse(widget(name).hasFocus())
                widget(name).setFocus()
                turn_wheel(name)
                self.assertNotEqual(value_of(), before)

    def test_enter(self):
        for name, text in (("originX", "4.1"), ("groupName", "OTHER"), ("transition", "3")):
            with self.subTest(field=name):
                type_slowly(name, text)
                QTest.keyClick(widget(name), QtCore.Qt.Key_Return)
                spin(0.1)
                self.assertTrue(FreeCADGui.Control.activeDialog(), "Enter in a field is taken for OK")
        self.assertAlmostEqual(value("originX"), 4.1)
        self.assertEqual((widget("groupName").text(), widget("transition").value()), ("OTHER", 3))
        self.assertEqual([o.Name for o in self.doc.Objects], ["Mesh"])
        self.wait_for_preview()
        press_ok()
        self.assertEqual((self.doc.Crack.GroupName, self.doc.Crack.Transition), ("OTHER", 3))
        self.assertAlmostEqual(self.doc.Crack.PlanePlacement.Base.x, 4.1)

    def test_ok_is_disabled_while_there_is_an_error(self):
        self.assertTrue(ok_button().isEnabled())
        type_into("originX", "500")
        self.wait_for_message("geometryError")
        self.assertFalse(ok_button().isEnabled())
        type_into("originX", "3.3")
        self.wait_for_preview()
        self.assertTrue(ok_button().isEnabled())
        type_into("groupName", "NO GOOD")
        self.wait_for_message("nameError")
        self.assertFalse(ok_button().isEnabled())
        type_into("groupName", "GOOD")
        self.wait_for_preview()
        for name in ("normalX", "normalY", "normalZ"):
            type_into(name, "0")
        self.assertFalse(ok_button().isEnabled())
        type_into("normalX", "1")
        self.wait_for_preview()
        press_ok()
        self.assertEqual(self.doc.Crack.GroupName, "GOOD")

    def test_what_is_said_while_it_computes(self):
        type_into("originX", "500")
        wait_until(lambda: "in red" in widget("status").text(), "the error")
        self.assertTrue(is_shown("geometryError"))
        go, preview_of = threading.Event(), tool_panel.preview_of

        def slow(*args):
            go.wait(30)
            return preview_of(*args)

        self.addCleanup(go.set)
        with mock.patch.object(tool_panel, "preview_of", slow):
            type_into("originX", "3.3")
            spin(0.1)
            self.assertEqual(widget("status").text(), "Computing the new mesh…")
            self.assertFalse(is_shown("geometryError"))
            self.assertTrue(ok_button().isEnabled())
            go.set()
            self.wait_for_preview()
            go.clear()
            type_into("originX", "3.4")
            wait_until(lambda: widget("status").text() == "Computing the new mesh…", "word of what takes long")
            go.set()
            self.wait_for_preview()


class EventFilters(GuiTest):
    def test_mistaken_objects(self):
        # PySide 2 at times passes what was at the same place in memory before.
        seen = []

        class Filter(EventFilter):
            def filtered(self, receiver, event):
                seen.append(event.type())
                return True

        button = QtGui.QPushButton()
        look = Filter()
        for receiver, event in (
            (button, QtGui.QSpacerItem(1, 1)),
            (QtGui.QSpacerItem(1, 1), QtCore.QEvent(QtCore.QEvent.Resize)),
            (button, QtCore.QEvent(QtCore.QEvent.KeyPress)),
        ):
            self.assertFalse(look.eventFilter(receiver, event))
        self.assertEqual(seen, [])
        self.assertTrue(look.eventFilter(button, QtCore.QEvent(QtCore.QEvent.Resize)))
        self.assertEqual(seen, [QtCore.QEvent.Resize])
