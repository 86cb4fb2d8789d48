# SPDX-License-Identifier: LGPL-2.1-or-later
"""One worker thread with one slot: work that was overtaken by newer work is never started."""

import threading

from PySide import QtCore


class LatestWins(QtCore.QObject):
    """Runs functions off the GUI thread, one at a time; of those that wait, only the newest.

    `finished(ticket, value)` and `failed(ticket, error)` arrive on the GUI thread. `ticket` is what request() returned.
    """

    finished = QtCore.Signal(object, object)
    failed = QtCore.Signal(object, object)

    def __init__(self, parent=None):
        super().__init__(parent)
        self._wake = threading.Condition()
        self._waiting = None
        self._running = None
        self._closed = False
        self._last = 0
        self._thread = threading.Thread(target=self._work, name="FemScalpel preview", daemon=True)
        self._thread.start()

    def request(self, function):
        """Has `function` called without arguments as soon as the thread is free. Returns its ticket, a growing number."""
        with self._wake:
            self._last += 1
            self._waiting = (self._last, function)
            self._wake.notify()
            return self._last

    def is_idle(self):
        """True when nothing runs and nothing waits. The last signals may still be on their way."""
        with self._wake:
            return self._waiting is None and self._running is None

    def close(self):
        """Drops what waits; what runs ends unheard. Does not block."""
        with self._wake:
            self._closed = True
            self._waiting = None
            self._wake.notify()

    def _work(self):
        while True:
            with self._wake:
                while self._waiting is None and not self._closed:
                    self._wake.wait()
                if self._closed:
                    return
                ticket, function = self._running = self._waiting
                self._waiting = None
            try:
                signal, value = self.finished, function()
            except Exception as error:  # reported by the receiver, in the panel
                signal, value = self.failed, error
            with self._wake:
                self._running = None
                if self._closed:
                    return
            try:
                signal.emit(ticket, value)
            except RuntimeError:  # Qt's side is gone: FreeCAD is closing
                return
            del function, value
