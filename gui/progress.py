# SPDX-License-Identifier: LGPL-2.1-or-later
"""Signs of life while the panel waits for another thread, and the means to end it."""

import time

import FreeCADGui
from PySide import QtCore, QtGui

import femscalpel

from . import qt
from .translate import translate

#: Seconds after which a dialog comes up that says what is done; for less it would flicker.
_DIALOG_AFTER = 0.4
_TICK = 20  # milliseconds


class Progress:
    """Says what is done in FreeCAD's status bar, by `tell(text)`, and in a dialog if it takes long.

    Nothing else takes clicks or keys meanwhile: at first they wait, then the dialog has them. Escape, or its button,
    cancels.
    """

    def __init__(self, title, tell):
        self._title, self._tell = title, tell
        self._begin = time.monotonic()
        self._dialog = None
        self._said, self._shown = ("", None), None
        #: Whether the user has cancelled; read by other threads, too.
        self.cancelled = False

    def say(self, text, fraction=None):
        """Says what is being done now, and how much of it is done, in [0, 1], where that is known."""
        if fraction is not None:
            fraction = round(fraction, 2)
        if self._shown == (text, fraction, self._dialog is not None):  # drawing it again would cost as much
            return
        self._said, self._shown = (text, fraction), (text, fraction, self._dialog is not None)
        if fraction is not None:
            text = f"{text} {100 * fraction:.0f} %"
        self._tell(text)
        FreeCADGui.getMainWindow().statusBar().showMessage(text)
        if self._dialog is not None:
            self._dialog.setLabelText(text)
            self._dialog.setMaximum(0 if fraction is None else 100)
            if fraction is not None:
                self._dialog.setValue(round(100 * fraction))

    def wait_for(self, is_done, look=None):
        """Lets the window live until is_done(), calling look() now and then; False when the user has cancelled."""
        loop = QtCore.QEventLoop()
        timer = QtCore.QTimer()

        def tick():
            if look is not None:
                look()
            if is_done() or self.cancelled or (self._dialog is None and self._is_long()):
                loop.quit()

        timer.timeout.connect(tick)
        timer.start(_TICK)
        try:
            while not is_done() and not self.cancelled:
                if self._dialog is None and self._is_long():
                    self._open_dialog()
                flags = QtCore.QEventLoop.AllEvents
                if self._dialog is None:
                    flags = QtCore.QEventLoop.ExcludeUserInputEvents
                qt.run(loop, flags)
        finally:
            timer.stop()
        return not self.cancelled

    def paint(self):
        """Has what was said last drawn, before this thread is busy itself."""
        QtGui.QApplication.processEvents(QtCore.QEventLoop.ExcludeUserInputEvents)

    def _is_long(self):
        return time.monotonic() - self._begin > _DIALOG_AFTER

    def _open_dialog(self):
        dialog = QtGui.QProgressDialog(FreeCADGui.getMainWindow())
        dialog.setObjectName("femscalpelProgress")
        dialog.setWindowTitle(self._title)
        dialog.setCancelButtonText(translate("FemScalpel", "Cancel"))
        dialog.setWindowModality(QtCore.Qt.ApplicationModal)
        dialog.setAutoClose(False)
        dialog.setAutoReset(False)
        dialog.setMinimumDuration(0)
        dialog.setMinimumWidth(360)
        # Escape is one or the other: the latter where the window system has not made it the active window.
        dialog.canceled.connect(self._cancel)
        dialog.rejected.connect(self._cancel)
        self._dialog = dialog
        self.say(*self._said)
        dialog.show()

    def _cancel(self):
        self.cancelled = True

    def close(self):
        """Takes everything away again."""
        FreeCADGui.getMainWindow().statusBar().clearMessage()
        dialog, self._dialog = self._dialog, None
        if dialog is not None:
            dialog.canceled.disconnect(self._cancel)
            dialog.rejected.disconnect(self._cancel)
            dialog.close()
            dialog.deleteLater()


class Steps:
    """Hears of the steps of a computation on its own thread: the `progress` of MeshOperation.begin(). Raises
    femscalpel.Cancelled there once the Progress is cancelled."""

    def __init__(self, progress=None):
        #: None while nobody waits for it.
        self.progress = progress
        #: Whether it is to end, whoever waits.
        self.given_up = False
        self._step = ("operate", None)

    def __call__(self, step, fraction=None):
        self._step = (step, fraction)
        if self.given_up or (self.progress is not None and self.progress.cancelled):
            raise femscalpel.Cancelled("cancelled")

    def say(self):
        """Says the step; to be called by the window's thread."""
        step, fraction = self._step
        texts = {
            "read": translate("FemScalpel", "Reading the mesh…"),
            "operate": translate("FemScalpel", "Computing the new mesh…"),
            "shape": translate("FemScalpel", "Putting nodes onto the geometry…"),
            "femmesh": translate("FemScalpel", "Writing the mesh for FreeCAD…"),
        }
        self.progress.say(texts[step], fraction)
