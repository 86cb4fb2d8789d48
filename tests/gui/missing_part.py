# SPDX-License-Identifier: LGPL-2.1-or-later
"""Looks at what the workbench says in FreeCAD's window when a part of it is missing: run_missing_part.py starts this,
in FreeCAD, on a workbench from which it took one. FEMSCALPEL_TESTS is the case and a regular expression of the message.

The only command must be the one that says what is missing, the message must come once and by the command, its button
must copy the command, and FreeCAD must have written the reason and no traceback.
"""

import os
import time
import traceback
import unittest

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

CASE, EXPECTED, COMMAND = os.environ["FEMSCALPEL_TESTS"].split(" ", 2)


def spin(seconds):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        FreeCADGui.updateGui()
        time.sleep(0.01)


def picture(widget, name):
    os.makedirs(os.environ["FEMSCALPEL_SCREENSHOTS"], exist_ok=True)
    widget.grab().save(os.path.join(os.environ["FEMSCALPEL_SCREENSHOTS"], f"{CASE}_{name}.png"))


class Box:
    """Waits for the message box; takes its texts and pictures, and presses a button."""

    def __init__(self, button):
        self.texts, self._button = [], button
        self._timer = QtCore.QTimer()
        self._timer.timeout.connect(self._look)
        self._timer.start(50)

    def _look(self):
        window = FreeCADGui.getMainWindow()
        for box in window.findChildren(QtGui.QMessageBox, "FemScalpelMissing"):
            if box.isVisible():
                self._timer.stop()
                self.texts += [box.text(), box.informativeText()]
                picture(box, "message")
                picture(window, "window")
                button = box.findChild(QtGui.QPushButton, self._button) if self._button else None
                (button or box.button(QtGui.QMessageBox.Ok)).click()


def report_view():
    view = FreeCADGui.getMainWindow().findChild(QtGui.QTextEdit, "Report view")
    return view.toPlainText() if view else ""


class MissingPart(unittest.TestCase):
    def test_says_which_and_stays_quiet(self):
        expected = EXPECTED.replace("_", " ")
        box = Box(None)
        FreeCADGui.activateWorkbench("FemScalpelWorkbench")
        spin(1.5)
        self.assertEqual(len(box.texts), 2, "no message came when the workbench was chosen")
        self.assertRegex(box.texts[0], expected)
        self.assertIn(COMMAND, box.texts[1])
        self.assertRegex(report_view().replace("\n", " "), expected)
        self.assertNotIn("Traceback", report_view())
        again = Box("copyCommand")
        FreeCADGui.activateWorkbench("PartWorkbench")
        FreeCADGui.activateWorkbench("FemScalpelWorkbench")
        spin(0.5)
        self.assertEqual(again.texts, [], "the message came by itself a second time")
        FreeCADGui.runCommand("FemScalpel_WhatIsMissing")
        spin(0.5)
        self.assertRegex(again.texts[0], expected)
        self.assertIn(COMMAND, QtGui.QApplication.clipboard().text())
        listed = [c for c in FreeCADGui.listCommands() if c.startswith("FemScalpel_")]
        self.assertEqual(listed, ["FemScalpel_WhatIsMissing"])
        bars = FreeCADGui.getMainWindow().findChildren(QtGui.QToolBar)
        toolbar = next(bar for bar in bars if bar.objectName() == "FemScalpel")
        self.assertEqual(len(toolbar.actions()), 1)
        tests = [t for t in FreeCAD.__unit_test__ if "FemScalpel" in t]
        self.assertEqual(tests, [], "tests are listed that cannot run")


def run():
    with open(os.environ["FEMSCALPEL_TEST_RESULT"], "w") as out:
        try:
            suite = unittest.defaultTestLoader.loadTestsFromTestCase(MissingPart)
            unittest.TextTestRunner(stream=out, verbosity=2).run(suite)
        except Exception:
            out.write(traceback.format_exc())
    QtGui.QApplication.instance().exit(0)
    os._exit(0)


QtCore.QTimer.singleShot(1500, run)
