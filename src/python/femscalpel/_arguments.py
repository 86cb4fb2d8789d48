# SPDX-License-Identifier: LGPL-2.1-or-later
"""Argument checks whose messages name the parameter."""

import math
import numbers
import re

import numpy as np


def about(name, error):
    """`error`, a TypeError or ValueError, with the name of the parameter at fault as attribute ``parameter``, as
    :class:`femscalpel.Error` has it. `name` may be a place within one, such as ``tools[1]``."""
    error.parameter = re.match(r"\w*", name)[0]
    return error


def describe(value):
    """`value` and its type, short enough for an error message."""
    text = repr(value)
    return f"{text if len(text) <= 60 else text[:57] + '...'} ({type(value).__name__})"


def vector(value, name):
    """Three finite numbers as a tuple of float."""
    try:
        out = tuple(float(x) for x in value)
    except (TypeError, ValueError):
        raise about(name, TypeError(f"{name} must be three numbers, not {describe(value)}")) from None
    if len(out) != 3:
        raise about(name, ValueError(f"{name} must be three numbers, not {len(out)}"))
    if not all(math.isfinite(x) for x in out):
        raise about(name, ValueError(f"{name} must be three finite numbers, not {out}"))
    return out


def text(value, name):
    """A string."""
    if not isinstance(value, str):
        raise about(name, TypeError(f"{name} must be a string, not {describe(value)}"))
    return value


def flag(value, name):
    """True or False."""
    if not isinstance(value, bool):
        raise about(name, TypeError(f"{name} must be True or False, not {describe(value)}"))
    return value


def real(value, name):
    """A finite number as float."""
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise about(name, TypeError(f"{name} must be a number, not {describe(value)}"))
    if not math.isfinite(value):
        raise about(name, ValueError(f"{name} must be a finite number, not {value}"))
    return float(value)


def pair(value, name):
    """Two finite numbers as a tuple of float."""
    try:
        first, second = value
    except (TypeError, ValueError):
        raise about(name, TypeError(f"{name} must be two numbers, not {describe(value)}")) from None
    return real(first, name), real(second, name)


def whole(value, name, minimum):
    """An integer that is at least `minimum`."""
    if isinstance(value, bool) or not isinstance(value, numbers.Integral):
        raise about(name, TypeError(f"{name} must be an integer, not {describe(value)}"))
    if value < minimum:
        raise about(name, ValueError(f"{name} must be at least {minimum}, not {value}"))
    return int(value)


def integers(value, name):
    """An array of integers as int64; floats are refused rather than cut off."""
    try:
        array = np.asarray(value)
    except ValueError:
        raise about(name, TypeError(f"{name} must be an array of integers")) from None
    if array.size == 0:
        return array.astype(np.int64)
    if array.dtype.kind not in "iu":
        raise about(name, TypeError(f"{name} must be an array of integers, not of {array.dtype}"))
    if array.dtype.kind == "u" and array.max() > np.iinfo(np.int64).max:
        raise about(name, ValueError(f"{name} has a number that does not fit 64 bits"))
    return np.ascontiguousarray(array, dtype=np.int64)
