# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes a mesh to a file on another thread, while the window lives and says so."""

import femmesh_bridge
import femscalpel

from .latest_wins import LatestWins
from .progress import Progress
from .translate import translate

#: Seconds that a file may take to be taken away once its writing is cancelled.
_PATIENCE = 2.0


def write(femmesh, path):
    """Writes a FemMesh with its groups. Raises as femscalpel.write(), and femscalpel.Cancelled when the user ends it:
    what was at `path` is there still, then."""
    outcome = []
    worker = LatestWins(lambda ticket, value: outcome.append(None), lambda ticket, error: outcome.append(error))
    progress = Progress(translate("FemScalpel", "Export mesh"), lambda text: None)
    try:
        progress.say(translate("FemScalpel", "Writing the file…"))
        worker.request(lambda: femscalpel.write(femmesh_bridge.from_femmesh(femmesh), path))
        if not progress.wait_for(lambda: outcome):
            worker.cancel()
            worker.wait_until_idle(_PATIENCE)
            raise femscalpel.Cancelled("cancelled")
    finally:
        worker.close()
        progress.close()
    if outcome[0] is not None:
        raise outcome[0]
