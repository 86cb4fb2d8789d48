# SPDX-License-Identifier: LGPL-2.1-or-later
"""One worker thread with one slot: work that was overtaken by newer work is never started."""

import threading
from collections import deque

from PySide import QtCore


class LatestWins(QtCore.QObject):
    """Runs functions off the GUI thread, one at a time; of those that wait, only the newest.

    Calls finished(ticket, value) or failed(ticket, error) on the GUI thread. `ticket` is what request() returned.
    """

    _ready = QtCore.Signal()

    def __init__(self, finished, failed):
        super().__init__()
        self._finished, self._failed = finished, failed
        self._done = deque()
        self._ready.connect(self._deliver, QtCore.Qt.QueuedConnection)
        self._wake = threading.Condition()
        self._waiting = None
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

    def close(self):
        """Drops what waits; what runs ends unheard. Does not block."""
        with self._wake:
            self._closed = True
            self._waiting = None
            self._wake.notify()

    def _deliver(self):
        while self._done and not self._closed:
            receiver, ticket, value = self._done.popleft()
            receiver(ticket, value)

    def _work(self):
        while True:
            with self._wake:
                while self._waiting is None and not self._closed:
                    self._wake.wait()
                if self._closed:
                    return
                ticket, function = self._waiting
                self._waiting = None
            try:
                outcome = self._finished, ticket, function()
            except Exception as error:  # reported by the receiver, in the panel
                outcome = self._failed, ticket, error
            self._done.append(outcome)
            del function, outcome
            try:
                self._ready.emit()
            except RuntimeError:  # Qt's side is gone: FreeCAD is closing
                return
