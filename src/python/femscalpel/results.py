# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a solver has computed on a mesh, as files have it."""

import os
from pathlib import Path
from typing import NamedTuple, Optional, Union

import numpy as np

from . import _arguments, _engine


class Displacements(NamedTuple):
    """Displacements of nodes at one step of a result."""

    #: Numbers of the nodes: (n,).
    nodes: np.ndarray
    #: In the mesh's own unit and axes: (n, 3).
    values: np.ndarray
    #: Number of the step in the file, from 1.
    step: int
    #: Time, or what goes for it.
    time: float


def read_displacements(path: Union[str, os.PathLike], step: Optional[int] = None) -> Displacements:
    """Displacements from a result of CalculiX, a text file ``.frd`` (``*NODE FILE`` with ``U``).

    Parameters
    ----------
    path : path-like
    step : int, optional
        Which of the file's results with displacements, from 1; the last when not given.

    Raises
    ------
    ReadError
        The file is missing, is no such file, is damaged or has no displacements, or not so many steps.
    """
    path = Path(os.fspath(path))
    if step is not None:
        step = _arguments.whole(step, "step", 1)
    try:
        lines = path.read_bytes().split(b"\n")
    except OSError as error:
        raise _engine.ReadError(f"{path}: {error.strerror or error}") from None
    blocks = list(_blocks(lines))
    if not any(line.startswith(b"    1") for line in lines[:50]) or not any(line[:6] == b"    2C" for line in lines):
        raise _engine.ReadError(f"{path}: no result of CalculiX in text form (.frd)")
    found = [(time, first, last) for name, time, first, last in blocks if name == "DISP"]
    if not found:
        others = sorted({name for name, *_ in blocks})
        has = f"has {', '.join(others)}" if others else "has no results"
        raise _engine.ReadError(f"{path}: no displacements: the file {has}; ask for U by *NODE FILE")
    number = len(found) if step is None else step
    if not 1 <= number <= len(found):
        raise _engine.ReadError(f"{path}: no step {number}: there are {len(found)}")
    time, first, last = found[number - 1]
    nodes, values = _values(path, lines, first, last)
    return Displacements(nodes, values, number, time)


def _blocks(lines):
    """(name, time, first line of values, the line behind the last) of every result."""
    time = 0.0
    name = None
    first = 0
    for number, line in enumerate(lines):
        start = line[:6]
        if start == b"  100C":
            try:
                time = float(line[12:24])
            except ValueError:
                time = 0.0
        elif line.startswith(b" -4"):
            name, first = line[5:13].decode("ascii", "replace").strip(), number + 1
        elif line.startswith(b" -5"):
            first = number + 1
        elif line.startswith(b" -3") and name is not None:
            yield name, time, first, number
            name = None


def _values(path, lines, first, last):
    """Node numbers and their three components, from lines of a fixed width."""
    nodes, values = [], []
    for number in range(first, last):
        line = lines[number]
        try:
            if line[:3] != b" -1":
                raise ValueError
            nodes.append(int(line[3:13]))
            values.append([float(line[13 + 12 * k : 25 + 12 * k]) for k in range(3)])
        except ValueError:
            raise _engine.ReadError(f"{path}, line {number + 1}: no displacement of a node") from None
    return np.array(nodes, np.int64), np.array(values, float).reshape(-1, 3)
