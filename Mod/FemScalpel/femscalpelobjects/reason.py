# SPDX-License-Identifier: LGPL-2.1-or-later
"""The error of an object that cannot be computed, reported by FreeCAD in one line."""

import sys


class _ReportedAs(type):
    """FreeCAD's line about a failed recompute begins with str() of the exception's class."""

    def __str__(cls):
        return "FemScalpel"


class Reason(RuntimeError, metaclass=_ReportedAs):
    """Why an object cannot be computed, for the user, who can mend it: a broken link, a tool beside the part.

    FreeCAD marks an object only when its execute() raises, and then prints a traceback to the report view. It is
    printed by Python, which leaves it out while sys.tracebacklimit is 0: that is so as long as an instance lives, and
    FreeCAD drops it when it has reported it. Errors of other classes keep their traceback.
    """

    _alive = 0
    _limit = None

    def __init__(self, text):
        super().__init__(text)
        if Reason._alive == 0:
            Reason._limit = getattr(sys, "tracebacklimit", None)
        Reason._alive += 1
        sys.tracebacklimit = 0

    def __del__(self):
        Reason._alive -= 1
        if Reason._alive:
            return
        if Reason._limit is None:
            vars(sys).pop("tracebacklimit", None)
        else:
            sys.tracebacklimit = Reason._limit
