# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads a mesh from a file on another thread, while the window lives and says so."""

import Fem

from femscalpelobjects import imported

from .on_thread import done_on_thread
from .translate import translate


def read(path, mesh=None):
    """As imported.read(); femscalpel.Cancelled when the user ends it."""
    femmesh = Fem.FemMesh()  # here, as FreeCAD counts them
    return done_on_thread(
        translate("FemScalpel", "Import mesh"),
        translate("FemScalpel", "Reading the file…"),
        lambda tell: imported.read(path, mesh, femmesh, tell),
    )
