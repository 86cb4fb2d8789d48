# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs unittest modules inside FreeCAD's window; FreeCAD is given this file to open.

FEMSCALPEL_TESTS: names of modules or tests; FEMSCALPEL_TEST_RESULT: file for the outcome.
"""

import os
import traceback

from PySide import QtCore


def run():
    code = 1
    with open(os.environ["FEMSCALPEL_TEST_RESULT"], "w", buffering=1) as out:
        try:
            import unittest
            suite = unittest.defaultTestLoader.loadTestsFromNames(os.environ["FEMSCALPEL_TESTS"].split())
            done = unittest.TextTestRunner(out, verbosity=2).run(suite)
            code = 0 if done.wasSuccessful() and done.testsRun else 1
        except BaseException:
            traceback.print_exc(file=out)
    # FreeCAD would ask about unsaved documents.
    os._exit(code)


QtCore.QTimer.singleShot(500, run)
