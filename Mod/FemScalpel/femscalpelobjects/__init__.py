# SPDX-License-Identifier: LGPL-2.1-or-later
"""The parametric document objects of FemScalpel; ObjectsFemScalpel makes them."""

from . import undo

undo.start()
