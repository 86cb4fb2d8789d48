# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes the caisson as a solid of linear tetrahedra, for the workbench's menu: arrays that
femscalpelobjects/example.py reads.

    make_example.py OUTPUT.npz

Run by the build; needs Gmsh and NumPy alone.
"""

import sys

import caisson
import numpy as np

SIZE = 36  # mm

if __name__ == "__main__":
    model = caisson.make_model(solid=True, size=SIZE, order=1)
    arrays = {"points": model.points}
    for kind, rows in model.cells.items():
        arrays[f"cells {kind}"], arrays[f"ids {kind}"] = rows, model.cell_ids[kind]
    for name, (kind, numbers) in model.groups.items():
        arrays[f"group {kind} {name}"] = numbers
    np.savez_compressed(sys.argv[1], **arrays)
