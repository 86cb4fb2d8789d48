# SPDX-License-Identifier: LGPL-2.1-or-later
"""CalculiX run on the text of a deck."""

import subprocess

import numpy as np


def solve(folder, text):
    """What a deck prints: {node: displacement} and {element: stresses at its integration points}."""
    (folder / "run.inp").write_text(text)
    done = subprocess.run(["ccx", "run"], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert done.returncode == 0 and "*ERROR" not in done.stdout, done.stdout[-2000:]
    displacements, stresses, rows = {}, {}, None
    for line in (folder / "run.dat").read_text().splitlines():
        words = line.split()
        if words and words[0] in ("displacements", "stresses", "forces"):
            rows = words[0]
        elif rows == "displacements" and len(words) == 4:
            displacements[int(words[0])] = np.array(words[1:], float)
        elif rows == "stresses" and len(words) == 8:
            stresses.setdefault(int(words[0]), []).append(np.array(words[2:], float))
    return displacements, stresses
