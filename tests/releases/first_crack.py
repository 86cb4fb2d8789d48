# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a user does first with an installed workbench: opens the example, cracks it, and reads what happened. Run by
freecadcmd; prints a line."""

import os
import traceback

try:
    import ObjectsFemScalpel

    document = ObjectsFemScalpel.openExample()
    mesh = document.Caisson
    crack = ObjectsFemScalpel.makeCrack(document, mesh, origin=(200, -50, 430), normal=(-0.33, -0.30, 1))
    document.recompute()
    if not crack.isValid() or not crack.NodesDoubled:
        raise RuntimeError(f"no crack: {crack.getStatusString()}")
    print(
        f"\nfirst crack: {mesh.FemMesh.NodeCount} nodes before, {crack.FemMesh.NodeCount} after, "
        f"{crack.NodesDoubled} doubled, {crack.FemMesh.GroupCount} groups",
        flush=True,
    )
except BaseException:
    traceback.print_exc()
os._exit(0)
