# SPDX-License-Identifier: LGPL-2.1-or-later
"""One worker thread with one slot: work that was overtaken by newer work is never started."""

import math
import threading
import time
from collections import deque

from PySide import QtCore

import femscalpel

#: Work that has run so many seconds makes room for newer work, whenever that came; what is quicker is finished, so that
#: something is seen while one drags.
PATIENCE = 1.0


class LatestWins(QtCore.QObject):
    """Runs functions off the GUI thread, one at a time; of those that wait, only the newest, for which one that takes
    long is cancelled.

    Work that gives way is cancelled by any that is newer.

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
        self._running = None  # its femscalpel.CancelToken and since when
        self._thread = threading.Thread(target=self._work, name="FemScalpel preview", daemon=True)
        self._thread.start()

    def request(self, function, gives_way=False):
        """Has `function` called without arguments as soon as the thread is free. Returns its ticket, a growing
        number."""
        with self._wake:
            self._last += 1
            self._waiting = (self._last, function, gives_way)
            if self._running:
                token, begin = self._running
                left = begin + PATIENCE - time.monotonic()
                if left < 0:
                    token.cancel()
                else:  # it may only just have begun
                    QtCore.QTimer.singleShot(math.ceil(1000 * left), lambda: self._make_room(token))
            self._wake.notify()
            return self._last

    def _make_room(self, token):
        """Ends what was started with that token if it still runs while newer work waits."""
        with self._wake:
            if self._running and self._running[0] is token and self._waiting is not None:
                token.cancel()

    def cancel(self):
        """Drops what waits and cancels what runs; newer work may follow."""
        with self._wake:
            self._waiting = None
            if self._running:
                self._running[0].cancel()

    def wait_until_idle(self, seconds):
        """Blocks until nothing runs, at most so long. Returns whether nothing does."""
        with self._wake:
            return self._wake.wait_for(lambda: self._running is None, seconds)

    def close(self):
        """Drops what waits and cancels what runs, which ends unheard. Does not block."""
        with self._wake:
            self._closed = True
            self._waiting = None
            self._done.clear()  # nobody takes it any more, and it may be large
            if self._running:
                self._running[0].cancel()
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
                ticket, function, gives_way = self._waiting
                self._waiting = None
                token = femscalpel.CancelToken()
                self._running = (token, -math.inf if gives_way else time.monotonic())
            try:
                with token:
                    outcome = self._finished, ticket, function()
            except femscalpel.Cancelled:  # newer work waits, or nobody listens any more
                continue
            except Exception as error:  # reported by the receiver, in the panel
                outcome = self._failed, ticket, error
            finally:
                with self._wake:
                    self._running = None
                    self._wake.notify_all()
            with self._wake:
                if self._closed:
                    return
                self._done.append(outcome)
            del function, outcome
            try:
                self._ready.emit()
            except RuntimeError:  # Qt's side is gone: FreeCAD is closing
                return
