# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes a mesh to a file on another thread, while the window lives and says so."""

from femscalpelobjects import imported

from .on_thread import done_on_thread
from .translate import translate


def write(obj, path):
    """As imported.export(); femscalpel.Cancelled when the user ends it: what was at `path` is there still, then."""
    return done_on_thread(
        translate("FemScalpel", "Export mesh"),
        translate("FemScalpel", "Writing the file…"),
        lambda tell: imported.export(obj, path),
    )
