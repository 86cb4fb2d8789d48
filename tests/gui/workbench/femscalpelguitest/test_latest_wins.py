# SPDX-License-Identifier: LGPL-2.1-or-later
"""The thread that makes previews."""

import gc
import threading
import time
import unittest
import weakref
from unittest import mock

import numpy as np

import femscalpel as fs
from femscalpelgui import latest_wins
from .gui_testing import spin, wait_until


class LatestWinsTest(unittest.TestCase):
    def setUp(self):
        self.arrived = []
        self.worker = latest_wins.LatestWins(
            lambda ticket, value: self.arrived.append((ticket, value)),
            lambda ticket, error: self.arrived.append((ticket, error)),
        )
        self.addCleanup(self.worker.close)

    @staticmethod
    def endless():
        points = np.vstack([np.zeros(3), np.eye(3)])
        mesh = fs.Mesh(points, {"tetra": np.array([[0, 1, 2, 3]])})
        while True:
            fs.mean_ratio(mesh)

    def test_work_that_takes_long_makes_room(self):
        with mock.patch.object(latest_wins, "PATIENCE", 0.05):
            self.worker.request(self.endless)
            spin(0.2)
            newest = self.worker.request(lambda: "new")
            wait_until(lambda: self.arrived, "newer work")
        self.assertEqual(self.arrived, [(newest, "new")])

    def test_work_that_has_only_just_begun_makes_room_later(self):
        with mock.patch.object(latest_wins, "PATIENCE", 0.4):
            self.worker.request(self.endless)
            wait_until(lambda: self.worker._running, "the beginning")
            newest = self.worker.request(lambda: "new")
            wait_until(lambda: self.arrived, "newer work")
        self.assertEqual(self.arrived, [(newest, "new")])

    def test_quick_work_is_finished(self):
        with mock.patch.object(latest_wins, "PATIENCE", 1000):
            first = self.worker.request(lambda: (time.sleep(0.2), "old")[1])
            spin(0.05)
            newest = self.worker.request(lambda: "new")
            wait_until(lambda: len(self.arrived) == 2, "both")
        self.assertEqual(self.arrived, [(first, "old"), (newest, "new")])

    def test_closing_ends_what_runs(self):
        self.worker.request(self.endless)
        spin(0.1)
        self.worker.close()
        self.worker._thread.join(60)
        self.assertFalse(self.worker._thread.is_alive())
        self.assertEqual(self.arrived, [])

    def test_closing_lets_go_of_what_was_made(self):
        class Large:
            pass

        made, end = [], threading.Event()

        def work():
            large = Large()
            made.append(weakref.ref(large))
            return large

        def late():
            end.wait(60)
            return work()

        # One that nobody has heard of yet, and one that ends after the panel did.
        for function in (work, late):
            worker = latest_wins.LatestWins(lambda *_: None, lambda *_: None)
            worker.request(function)
            if function is work:
                self.assertTrue(holds_within(lambda: worker._done))
            else:
                self.assertTrue(holds_within(lambda: worker._running))
            worker.close()
            if function is late:
                end.set()
            worker._thread.join(60)
            gc.collect()
            self.assertEqual([ref() for ref in made], [None] * len(made))
        self.assertEqual(len(made), 2)


def holds_within(condition, seconds=60):
    """Whether condition() comes to hold, while the window does nothing."""
    end = time.monotonic() + seconds
    while not condition() and time.monotonic() < end:
        time.sleep(0.01)
    return bool(condition())
