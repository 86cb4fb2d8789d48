# SPDX-License-Identifier: LGPL-2.1-or-later
"""What refining first may cost before the user is asked."""

import os
from dataclasses import dataclass

from . import preferences

#: Bytes that an element takes in the end: the engine's meshes, the preview, FreeCAD's mesh in the object and the one
#: that is kept for undo. Measured with half a million tetrahedra; those of second order have six times the nodes.
BYTES_PER_ELEMENT = {1: 1300, 2: 2800}
_MILLION = 1_000_000


@dataclass(frozen=True)
class Cost:
    """What a refinement will come to."""

    size: float  #: longest edge wanted
    elements: int  #: of the whole mesh afterwards
    is_more: bool  #: whether it would be more than `elements`
    memory: int  #: bytes that are needed beside what is in use


class TooMuch(Exception):
    """A refinement that was not made as nobody has agreed to its Cost; `fitting`: to which length it could be made
    without asking, infinity for none."""

    def __init__(self, cost, fitting):
        super().__init__(f"refining to {cost.size} makes {cost.elements} elements")
        self.cost, self.fitting = cost, fitting


class Guard:
    """To be called with a femscalpel.RefinementEstimate, from any thread: tells `told` its Cost, and raises TooMuch
    where it is above a limit and above what was agreed to."""

    def __init__(self, order, told, agreed=0):
        self._bytes, self._told, self._agreed = BYTES_PER_ELEMENT[order], told, agreed

    def __call__(self, estimate):
        cost = self._cost(estimate)
        self._told(cost)
        limit = self._limit(estimate.elements_before)
        if cost.elements > max(limit, self._agreed) or (cost.is_more and not self._agreed > cost.elements):
            raise TooMuch(cost, estimate.size_for(limit))

    def _cost(self, estimate):
        more = estimate.elements_after - estimate.elements_before
        return Cost(estimate.size, estimate.elements_after, estimate.is_more, more * self._bytes)

    def _limit(self, before):
        """The most elements that need no asking."""
        return min(preferences.most_elements(), before + most_memory() // self._bytes)


def most_memory():
    """Bytes that may be taken without asking: as preferred, or else half of what is free."""
    chosen = preferences.most_memory() * _MILLION
    free = free_memory()
    return chosen or (free // 2 if free is not None else 2000 * _MILLION)


def free_memory():
    """Bytes that programs can have, None where that cannot be told."""
    try:
        with open("/proc/meminfo", encoding="ascii") as lines:
            for line in lines:
                if line.startswith("MemAvailable:"):
                    return 1024 * int(line.split()[1])
    except (OSError, ValueError):
        pass
    try:
        return os.sysconf("SC_AVPHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError, OSError):
        return None


def as_text(cost, translate):
    """The cost for the user: "1.3 million elements, 1.7 GB"."""
    number = f"{cost.elements:,}".replace(",", "\u2009")
    if cost.elements >= _MILLION:
        number = translate("FemScalpel", "%1 million").replace("%1", f"{cost.elements / _MILLION:.1f}")
    elif cost.elements >= 10000:
        number = f"{round(cost.elements, -3):,}".replace(",", "\u2009")
    text = translate("FemScalpel", "some %1 elements")
    if cost.is_more:
        text = translate("FemScalpel", "more than %1 elements")
    memory = f"{cost.memory / 1e9:.1f} GB" if cost.memory >= 1e9 else f"{max(1, round(cost.memory / _MILLION))} MB"
    return f"{text.replace('%1', number)} ({memory})"
