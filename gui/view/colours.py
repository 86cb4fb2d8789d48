# SPDX-License-Identifier: LGPL-2.1-or-later
"""Colours of the 3-D view: mean ratio, groups, and the parts of a preview."""

import zlib

import numpy as np

# Mean ratio to colour, told apart also without red and green: dark red, orange, pale yellow, light blue, blue.
_STOPS = np.array([0.0, 0.15, 0.3, 0.5, 0.75, 1.0])
_SCALE = np.array(
    [
        [0.55, 0.0, 0.15],
        [0.84, 0.15, 0.15],
        [0.98, 0.56, 0.25],
        [1.0, 0.92, 0.62],
        [0.55, 0.78, 0.88],
        [0.22, 0.45, 0.72],
    ]
)

# Kelly's colours of maximum contrast without the very light, the very dark and the reds used for cracks.
_PALETTE = np.array(
    [
        [0.99, 0.70, 0.20],
        [0.50, 0.62, 0.85],
        [0.56, 0.80, 0.45],
        [0.76, 0.58, 0.82],
        [0.94, 0.85, 0.45],
        [0.40, 0.76, 0.76],
        [0.95, 0.62, 0.70],
        [0.72, 0.63, 0.48],
        [0.62, 0.72, 0.62],
        [0.45, 0.55, 0.65],
        [0.85, 0.55, 0.35],
        [0.70, 0.85, 0.95],
    ]
)

NEUTRAL = (0.80, 0.82, 0.85)
BEAM = (0.16, 0.60, 0.64)
INTERFACE = (0.86, 0.12, 0.16)
FRONT = (0.75, 0.0, 0.75)
MOVED = (0.10, 0.35, 0.75)
REMOVED = (0.90, 0.30, 0.20)
BORDER = (0.05, 0.15, 0.45)
HIGHLIGHT = (1.0, 0.80, 0.0)
TOOL = (0.25, 0.55, 0.85)
GRIP = (0.10, 0.62, 0.25)


def quality_rgb(ratio):
    """(n, 3) colours in [0, 1] of mean ratios; below 0 as 0."""
    return np.stack([np.interp(ratio, _STOPS, _SCALE[:, k]) for k in range(3)], axis=-1)


def families_rgb(families):
    """(n, 3) colours of the elements that are in exactly these groups, for each of several such tuples of names. All
    differ as long as there are colours, and the same names have the same one mostly."""
    found = {(): np.array(NEUTRAL)}
    free = set()
    for names in sorted(set(families) - {()}):
        number = zlib.crc32("\n".join(names).encode()) % len(_PALETTE)
        free = free or set(range(len(_PALETTE)))
        number = min(free, key=lambda k, first=number: (k - first) % len(_PALETTE))
        free.remove(number)
        found[names] = _PALETTE[number]
    return np.array([found[names] for names in families]).reshape(-1, 3)


def distinct_rgb(number):
    """A colour for the n-th of several things, far from those of its neighbours."""
    base = _PALETTE[number % len(_PALETTE)]
    return base * (1.0 - 0.18 * (number // len(_PALETTE) % 4))


def packed(rgb, alpha=1.0):
    """Colours (n, 3) in [0, 1] as 0xRRGGBBAA for SoPackedColor."""
    levels = np.clip(np.rint(np.asarray(rgb) * 255), 0, 255).astype(np.uint32)
    return (levels[..., 0] << 24) | (levels[..., 1] << 16) | (levels[..., 2] << 8) | np.uint32(round(alpha * 255))
