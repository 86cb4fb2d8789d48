# SPDX-License-Identifier: LGPL-2.1-or-later
"""The thread that makes previews."""

import time
import unittest
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
