# SPDX-License-Identifier: LGPL-2.1-or-later
"""Outlines of tools that are surfaces of revolution, by the names of their classes, for what is seen of them."""

import math

import numpy as np


def _cylinder(radius, values, size):
    depth = values.get("depth")
    if depth is not None:  # it ends flat
        return (radius, min(depth, 0) - 0.6 * size), (radius, depth), (0, depth)
    return (radius, -0.6 * size), (radius, 0.6 * size)


def _sphere(radius, values, size):
    angles = np.linspace(-np.pi / 2, np.pi / 2, 25)
    return radius * np.column_stack([np.cos(angles), np.sin(angles)])


def _torus(radius, values, size):
    angles = np.linspace(0, 2 * np.pi, 25)
    return np.array((radius, 0)) + values["tube_radius"] * np.column_stack([np.cos(angles), np.sin(angles)])


def _cone(radius, values, size):
    slope = math.tan(math.radians(values["half_angle"]))
    if not 0 < slope < 1e6:
        return ()
    # From the tip, or 0.6 * size below, to as far above, or as wide.
    low, high = max(-radius / slope, -0.6 * size), min(0.6 * size, max(size - radius, 0) / slope)
    return (radius + low * slope, low), (radius + high * slope, high)


def _plane(radius, values, size):
    return (0, 0), (0.5 * size, 0)


#: Function of the radius, of further values by what femscalpel.tools asks them as, and of the size of the part.
PROFILES = {"Cylinder": _cylinder, "Sphere": _sphere, "Torus": _torus, "Cone": _cone, "Plane": _plane}

#: Those that stay what they are when they move along their axis.
ENDLESS = ("Cylinder",)


def revolved(profile, start=0.0, end=360.0):
    """Points (n, 3) and quadrangles (m, 4) of what a profile of (radius, height) makes when it turns about z between
    two angles in degrees."""
    profile = np.asarray(profile, float).reshape(-1, 2)
    is_whole = abs(end - start) >= 360
    steps = 48 if is_whole else max(2, math.ceil(48 * abs(end - start) / 360) + 1)
    angles = np.radians(np.linspace(start, start + 360 if is_whole else end, steps, endpoint=not is_whole))
    ring = np.column_stack([np.cos(angles), np.sin(angles)])
    points = np.concatenate([np.column_stack([r * ring, np.full(steps, z)]) for r, z in profile] or [np.empty((0, 3))])
    lower = np.arange(max(len(profile) - 1, 0) * steps)
    if not is_whole:
        lower = lower[lower % steps < steps - 1]
    after = lower // steps * steps + (lower + 1) % steps
    return points, np.column_stack([lower, after, after + steps, lower + steps])
