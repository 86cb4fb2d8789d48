# SPDX-License-Identifier: LGPL-2.1-or-later
"""Operates FreeCAD's window as a user does: types, clicks, picks, looks. Used by TestFemScalpelGui.

Screenshots go to the folder FEMSCALPEL_SCREENSHOTS, if that is set.
"""

import functools
import importlib
import os
import re
import time
import unittest

import FreeCAD
import FreeCADGui
import numpy as np
from pivy import coin
from PySide import QtCore, QtGui

from femscalpelgui.panels.view_panel import ViewPanel
from femscalpelgui.view.label import pixel_ratio
from femscalpelgui.view.screen import Screen

try:
    from PySide import QtTest
except ImportError:  # FreeCAD 0.20's shim has no QtTest
    QtTest = importlib.import_module("PySide2.QtTest" if QtCore.qVersion().startswith("5") else "PySide6.QtTest")

QTest = QtTest.QTest
PATIENCE = 60  # seconds until something that must happen counts as not happening


def spin(seconds=0.05):
    """Lets the window work."""
    end = time.monotonic() + seconds
    while True:
        FreeCADGui.updateGui()
        QtGui.QApplication.sendPostedEvents(None, QtCore.QEvent.DeferredDelete)
        if time.monotonic() >= end:
            return
        time.sleep(0.005)


class NotShown(AssertionError):
    """There is no such widget to be seen, perhaps not yet."""


def wait_until(condition, what):
    """Lets the window work until condition() holds; fails with `what` when it never does. A widget that is hidden
    meanwhile is waited for."""
    end = time.monotonic() + PATIENCE

    def holds():
        try:
            return condition()
        except NotShown:
            return False

    while not holds():
        if time.monotonic() > end:
            raise AssertionError(f"waited in vain for {what}")
        spin(0.01)


def widget(name, parent=None):
    """The visible widget of that object name."""
    top = parent or FreeCADGui.getMainWindow()
    found = [w for w in top.findChildren(QtGui.QWidget, name) if w.isVisible()]
    if not found and not name.startswith("section") and _unfold():
        found = [w for w in top.findChildren(QtGui.QWidget, name) if w.isVisible()]
    if not found:
        raise NotShown(f"no visible widget '{name}'")
    return found[-1]


def _unfold():
    """Opens all sections of the panel; whether any was closed."""
    headers = [
        box
        for box in FreeCADGui.getMainWindow().findChildren(QtGui.QToolButton)
        if box.objectName().startswith("section") and box.isVisible() and not box.isChecked()
    ]
    for box in headers:
        box.setChecked(True)  # no click, which would be remembered
    spin(0)
    return bool(headers)


def is_shown(name):
    """Whether a visible widget has that object name."""
    return any(w.isVisible() for w in FreeCADGui.getMainWindow().findChildren(QtGui.QWidget, name))


def type_into(name, text):
    """Replaces the text of a field, key by key, and leaves it with Tab."""
    field = widget(name)
    edit = field if isinstance(field, QtGui.QLineEdit) else field.findChild(QtGui.QLineEdit)
    edit.setFocus()
    edit.selectAll()
    QTest.keyClicks(edit, text)
    QTest.keyClick(edit, QtCore.Qt.Key_Tab)
    spin(0)


def click(name):
    """Clicks a button or check box."""
    box = widget(name)
    if isinstance(box, QtGui.QCheckBox):
        QTest.mouseClick(box, QtCore.Qt.LeftButton, QtCore.Qt.NoModifier, QtCore.QPoint(8, box.height() // 2))
    else:
        QTest.mouseClick(box, QtCore.Qt.LeftButton)
    spin(0)


def choose(name, data):
    """Chooses an entry of a combo box by its data, with the keyboard, once the box is there and has it."""
    wait_until(lambda: widget(name).findData(data) >= 0, f"{data!r} in the combo box '{name}'")
    box = widget(name)
    index = box.findData(data)
    box.setFocus()
    while box.currentIndex() != index:
        QTest.keyClick(box, QtCore.Qt.Key_Down if box.currentIndex() < index else QtCore.Qt.Key_Up)
    spin(0)


def click_row(name, text):
    """Clicks the row of a table or tree whose first cell is `text`."""
    table = widget(name)
    item = table.findItems(text, QtCore.Qt.MatchExactly)[0]
    table.scrollToItem(item)
    spin(0)
    QTest.mouseClick(table.viewport(), QtCore.Qt.LeftButton, QtCore.Qt.NoModifier, table.visualItemRect(item).center())
    spin(0)


def is_settled():
    """Whether the panel says what is about what is entered now: its result, or what is wrong."""
    return is_shown("status") and widget("status").property("femscalpelSettled") is not False


def is_ready():
    """Whether the panel has read its mesh, and says what is about what is entered now."""
    return is_settled() and widget("status").text() and "…" not in widget("status").text()


# The panel that was opened last. FreeCAD hands it the box of its buttons; one that is looked for among all widgets may
# come as something else, which PySide 2 has kept of what lay in its place before.
_opened = []


def _note_buttons(panel, box, modify=ViewPanel.modifyStandardButtons):
    _opened[:] = [panel]
    modify(panel, box)


ViewPanel.modifyStandardButtons = _note_buttons


def button_boxes():
    """The box of buttons of the panel that is open, in a list; none without a panel."""
    ours = [panel._box for panel in _opened if panel._box is not None and panel._box.isVisible()]
    if ours:
        return ours
    # One of FreeCAD's own panels.
    return [box for box in FreeCADGui.getMainWindow().findChildren(QtGui.QDialogButtonBox) if box.isVisible()]


def opened_panel():
    """The panel that was opened last."""
    return _opened[0]


def press_button(*choices):
    """Clicks OK, Cancel or Close of the task panel, whichever is there."""
    boxes = button_boxes()
    button = next(b.button(choice) for b in boxes for choice in choices if b.button(choice))
    QTest.mouseClick(button, QtCore.Qt.LeftButton)
    spin(0.05)


def press_ok():
    press_button(QtGui.QDialogButtonBox.Ok)


def press_cancel():
    press_button(QtGui.QDialogButtonBox.Cancel)


def value(name):
    """Number a unit-aware field shows: rounded to its decimals."""
    return widget(name).property("rawValue")


def view():
    """The active 3-D view."""
    return FreeCADGui.ActiveDocument.ActiveView


def canvas():
    """The widget that takes the 3-D view's mouse events."""
    window = FreeCADGui.getMainWindow().findChild(QtGui.QMdiArea).activeSubWindow()
    return next(w for w in window.findChildren(QtGui.QGraphicsView)).viewport()


def on_screen(point):
    """Where a point of the model is on the canvas."""
    width, height = canvas().width(), canvas().height()
    volume = view().getCameraNode().getViewVolume(width / height)
    projected = volume.projectToScreen(coin.SbVec3f(*point))
    if isinstance(projected, coin.SbVec3f):
        x, y, _ = projected.getValue()
    return QtCore.QPoint(round(x * width), round((1 - y) * height))


def click_at(point):
    """Clicks at a point of the model in the 3-D view."""
    spin(0.1)
    place = on_screen(point)
    QTest.mouseMove(canvas(), place)
    spin(0.05)
    QTest.mouseClick(canvas(), QtCore.Qt.LeftButton, QtCore.Qt.NoModifier, place)
    spin(0.1)


def pixel(point=(0, 0, 0)):
    """The length in the model of one pixel of the 3-D view at a point."""
    return Screen(view()).pixel(FreeCAD.Vector(*point)) * pixel_ratio()


def canvas_picture():
    """What the 3-D view shows, as (rows, columns, 3) of bytes."""
    spin(0.2)
    corner = canvas().mapToGlobal(QtCore.QPoint(0, 0))
    screen = QtGui.QApplication.primaryScreen()
    image = screen.grabWindow(0, corner.x(), corner.y(), canvas().width(), canvas().height()).toImage()
    image = image.convertToFormat(QtGui.QImage.Format_RGB888)
    bits = np.frombuffer(bytes(image.constBits()), np.uint8).reshape(image.height(), image.bytesPerLine())
    return bits[:, : 3 * image.width()].reshape(image.height(), image.width(), 3)


def drag(start, end, steps=8):
    """Drags with the left button from one point of the model to another, in the 3-D view."""
    a, b = on_screen(start), on_screen(end)
    QTest.mouseMove(canvas(), a)
    spin(0.02)
    QTest.mousePress(canvas(), QtCore.Qt.LeftButton, QtCore.Qt.NoModifier, a)
    for k in range(1, steps + 1):
        at = QtCore.QPoint(a.x() + (b.x() - a.x()) * k // steps, a.y() + (b.y() - a.y()) * k // steps)
        move = QtGui.QMouseEvent(
            QtCore.QEvent.MouseMove,
            at,
            canvas().mapToGlobal(at),
            QtCore.Qt.NoButton,
            QtCore.Qt.LeftButton,
            QtCore.Qt.NoModifier,
        )
        QtGui.QApplication.sendEvent(canvas(), move)
        spin(0.02)
    QTest.mouseRelease(canvas(), QtCore.Qt.LeftButton, QtCore.Qt.NoModifier, b)
    spin(0.05)


def in_scene(name):
    """The node of that name in the 3-D view, None when there is none."""
    search = coin.SoSearchAction()
    search.setName(coin.SbName(name))
    search.setSearchingAll(True)
    search.apply(view().getSceneGraph())
    path = search.getPath()
    return path.getTail() if path else None


def shapes_in(name, kind):
    """The nodes of a type that are drawn under the node of that name."""
    node = in_scene(name)
    if node is None:
        return []
    search = coin.SoSearchAction()
    search.setType(kind.getClassTypeId())
    search.setInterest(coin.SoSearchAction.ALL)
    search.apply(node)
    paths = search.getPaths()
    return [paths[k].getTail() for k in range(paths.getLength())]


def faces_drawn(name):
    """Number of faces drawn under the node of that name."""
    return sum(list(s.coordIndex.getValues()).count(-1) for s in shapes_in(name, coin.SoIndexedFaceSet))


def lines_drawn(name):
    """Number of two-point lines drawn under the node of that name."""
    return sum(s.numVertices.getNum() for s in shapes_in(name, coin.SoLineSet))


def points_drawn(name):
    """Number of points drawn under the node of that name."""
    return sum(s.numPoints.getValue() for s in shapes_in(name, coin.SoPointSet))


def moved_drawn():
    """Number of moved nodes that are marked."""
    return points_drawn("FemScalpelMoved") + points_drawn("FemScalpelMovedUnder")


def screenshot(name):
    """Keeps a picture of the whole window."""
    folder = os.environ.get("FEMSCALPEL_SCREENSHOTS")
    if folder:
        spin(0.15)
        os.makedirs(folder, exist_ok=True)
        QtGui.QApplication.primaryScreen().grabWindow(0).save(os.path.join(folder, name + ".png"))


def with_dialog(kind, handle, action):
    """Does something that must open a modal dialog of a class, for which handle(dialog) is called once; it must close
    it."""
    handled = []

    def look():
        dialog = QtGui.QApplication.activeModalWidget()
        if isinstance(dialog, kind) and not handled:
            handled.append(True)
            handle(dialog)

    timer = QtCore.QTimer()
    timer.timeout.connect(look)
    timer.start(50)
    try:
        action()
        spin(0.1)
    finally:
        timer.stop()
    if not handled:
        raise AssertionError(f"no {kind.__name__} came up")


def message_during(action):
    """Does something that must open a message box; closes the box and returns its text."""
    texts = []

    def close(box):
        texts.append(box.text())
        screenshot(f"message_{re.sub('[^a-z]+', '_', box.text().lower())[:40]}")
        box.button(QtGui.QMessageBox.Ok).click()

    with_dialog(QtGui.QMessageBox, close, action)
    return texts[0]


def report_view():
    """Text of FreeCAD's report view."""
    view = FreeCADGui.getMainWindow().findChild(QtGui.QTextEdit, "Report view")
    return view.toPlainText() if view else ""


def resize_panel(width):
    """Gives the dock with the task panel a width in pixels; False where it has none of its own: FreeCAD 1.1 lays the
    panel over the 3-D view."""
    window = FreeCADGui.getMainWindow()
    # FreeCAD 1.0 has the task panel beside the tree, not in one dock with it.
    panel = window.findChild(QtGui.QDockWidget, "Combo View") or window.findChild(QtGui.QDockWidget, "Tasks")
    if window.dockWidgetArea(panel) == QtCore.Qt.NoDockWidgetArea:
        return False
    window.resizeDocks([panel], [width], QtCore.Qt.Horizontal)
    return True


def theme_file(name):
    """The style sheet of a theme of that name; other releases of FreeCAD have others."""
    return os.path.join(FreeCAD.getResourceDir(), "Gui", "Stylesheets", name)


def choose_theme(name):
    """As FreeCAD does when a style sheet is chosen in the preferences."""
    with open(theme_file(name), encoding="utf-8") as file:
        QtGui.QApplication.instance().setStyleSheet(file.read())
    spin(0.1)


@functools.lru_cache(maxsize=None)
def without_start_page():
    """Lets FreeCAD come to rest, once, so that the Start page can be closed: FreeCAD 1.1 crashes where that is gone two
    seconds after it was made. It is not made from now on; the user's settings stay as they are."""
    settings = FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/Start")
    was = settings.GetBool("ShowOnStartup", True)
    settings.SetBool("ShowOnStartup", False)
    try:
        spin(0.5)
        if FreeCADGui.getMainWindow().findChild(QtCore.QObject, "StartView"):
            spin(2.5)
    finally:
        settings.SetBool("ShowOnStartup", was)


class GuiTest(unittest.TestCase):
    """A document with a window; afterwards no panel may be open and the report view must be free of errors."""

    def setUp(self):
        FreeCADGui.activateWorkbench("FemScalpelWorkbench")
        window = FreeCADGui.getMainWindow()
        without_start_page()
        self.dress()
        resize_panel(330)
        self.reported = len(report_view())
        window.findChild(QtGui.QDockWidget, "Report view").hide()
        window.findChild(QtGui.QMdiArea).closeAllSubWindows()  # the Start page
        window.statusBar().clearMessage()
        for bar in window.statusBar().findChildren(QtGui.QProgressBar):
            bar.hide()
        self.doc = FreeCAD.newDocument("GuiTest")
        self.doc.UndoMode = 1
        spin(0.05)

    def dress(self):
        """Gives the window the language and the theme that the runner was told."""
        if os.environ.get("FEMSCALPEL_LANGUAGE"):
            FreeCADGui.setLocale(os.environ["FEMSCALPEL_LANGUAGE"])
        if os.environ.get("FEMSCALPEL_THEME"):
            choose_theme(os.environ["FEMSCALPEL_THEME"])

    def tearDown(self):
        try:
            while FreeCADGui.Control.activeDialog():
                press_button(QtGui.QDialogButtonBox.Cancel, QtGui.QDialogButtonBox.Close)
        finally:  # FreeCAD would ask the next test whether to save them
            FreeCADGui.Selection.clearSelection()
            for name in list(FreeCAD.listDocuments()):
                FreeCAD.closeDocument(name)
        spin(0.05)
        new = report_view()[self.reported :]
        # FreeCAD 1.0 writes "pyException: " before what a recompute raised.
        self.assertNotRegex(new, r"Traceback|Error:|(?<!py)Exception")

    def add_mesh(self, mesh, name="Mesh"):
        """A FEM mesh object with a femscalpel.Mesh, in sight."""
        import femmesh_bridge

        obj = self.doc.addObject("Fem::FemMeshObject", name)
        obj.FemMesh = femmesh_bridge.to_femmesh(mesh)
        self.doc.recompute()
        self.doc.clearUndos()
        self.look()
        return obj

    def look(self):
        """Looks at everything from the front, right and above."""
        view().setAnimationEnabled(False)
        view().viewIsometric()
        view().fitAll()
        spin(0.05)

    def run_command(self, name):
        """Runs a command as a click on its button would; it must be active."""
        self.assertTrue(FreeCADGui.Command.get(name).isActive(), f"{name} is not active")
        FreeCADGui.runCommand(name)
        spin(0)

    def wait_for_preview(self):
        """Waits until the panel shows the result of what is entered now."""
        wait_until(lambda: is_settled() and re.match(r"\d+ ", widget("status").text()), "the preview")

    def wait_for_message(self, name):
        """Waits for a message beside a field and returns it."""
        wait_until(lambda: is_settled() and is_shown(name), f"the message {name}")
        return widget(name).text()
