#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws which folders of the engine include headers of which, and how often: includes.svg, by Graphviz.

    resources/docs/make_include_picture.py

An arrow goes from the folder that includes to the one that is included. tests/python/test_layers.py tells when the
picture no longer agrees with the code.
"""

import collections
import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
ENGINE = ROOT / "src" / "engine"
PICTURE = ROOT / "resources" / "docs" / "includes.svg"

NODE = 'shape=box style="rounded,filled" fillcolor="#e8eef7" color="#4a6fa5" fontname="sans-serif" fontsize=12'
EDGE = 'color="#4a6fa5" fontname="sans-serif" fontsize=10 arrowsize=0.7'


def includes():
    """Counter of (folder, folder included)."""
    out = collections.Counter()
    for path in [*ENGINE.rglob("*.h"), *ENGINE.rglob("*.cpp")]:
        for name in re.findall(r'^#include "([^"]+)"', path.read_text(), re.M):
            pair = path.relative_to(ENGINE).parts[0], pathlib.PurePath(name).parts[0]
            if pair[0] != pair[1] and all((ENGINE / folder).is_dir() for folder in pair):
                out[pair] += 1
    return out


def graph():
    """The picture in Graphviz' language."""
    folders = sorted(path.name for path in ENGINE.iterdir() if path.is_dir())
    lines = ["digraph includes {", f"  rankdir=TB; ranksep=0.6; node [{NODE}]; edge [{EDGE}];"]
    lines += [f'  {folder} [label="{folder}/"];' for folder in folders]
    lines += [f'  {a} -> {b} [label=" {count}"];' for (a, b), count in sorted(includes().items())]
    return "\n".join([*lines, "}"]) + "\n"


if __name__ == "__main__":
    subprocess.run(["dot", "-Tsvg", "-o", PICTURE], input=graph(), text=True, check=True)
