# SPDX-License-Identifier: LGPL-2.1-or-later
"""A sign of life before the window's own thread is busy: the wait cursor, and a word in the status bar."""

import contextlib

import FreeCADGui
from PySide import QtCore, QtGui

#: Nodes and elements of a mesh that FreeCAD takes over before anybody notices.
QUICK = 20_000


def begin(text):
    """Shows the wait cursor and says what is being done, at once, although no event is handled until end()."""
    QtGui.QApplication.setOverrideCursor(QtCore.Qt.WaitCursor)
    bar = FreeCADGui.getMainWindow().statusBar()
    bar.showMessage(text)
    bar.repaint()


def end(text):
    """Takes away what begin(text) has shown, if it is still there."""
    QtGui.QApplication.restoreOverrideCursor()
    bar = FreeCADGui.getMainWindow().statusBar()
    if bar.currentMessage() == text:
        bar.clearMessage()


@contextlib.contextmanager
def busy(text):
    """From begin() to end()."""
    begin(text)
    try:
        yield
    finally:
        end(text)
