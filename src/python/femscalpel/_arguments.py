# SPDX-License-Identifier: LGPL-2.1-or-later
"""Argument checks whose messages name the parameter."""

import math
import numbers
import os
import re
from collections.abc import Mapping, Set

import numpy as np


def about(name, error):
    """`error`, a TypeError or ValueError, with the name of the parameter at fault as attribute ``parameter``, as
    :class:`femscalpel.Error` has it. `name` may be a place within one, such as ``tools[1]``."""
    error.parameter = re.match(r"\w*", name)[0]
    return error


def describe(value):
    """`value` and its type, short enough for an error message."""
    try:
        text = repr(value)
    except Exception:  # of somebody else's class
        text = object.__repr__(value)
    return f"{text if len(text) <= 60 else text[:57] + '...'} ({type(value).__name__})"


def _listed(value, name, count):
    """The members of `value`, `count` of them, as a list; not of what has no order, or is text."""
    called = {2: "two", 3: "three"}[count]
    if isinstance(value, (str, bytes, bytearray, Set, Mapping)):
        raise about(name, TypeError(f"{name} must be {called} numbers, not {describe(value)}"))
    try:
        out = list(value)
    except TypeError:
        raise about(name, TypeError(f"{name} must be {called} numbers, not {describe(value)}")) from None
    if len(out) != count:
        raise about(name, ValueError(f"{name} must be {called} numbers, not {len(out)}"))
    return out


def _as_float(value):
    """`value` as float; TypeError when it is no number, whatever text or truth may count as."""
    if isinstance(value, (bool, np.bool_)) or not (hasattr(value, "__float__") or hasattr(value, "__index__")):
        raise TypeError
    try:
        return float(value)
    except OverflowError:
        return math.inf


def vector(value, name):
    """Three finite numbers as a tuple of float."""
    listed = _listed(value, name, 3)
    try:
        out = tuple(_as_float(x) for x in listed)
    except (TypeError, ValueError):
        raise about(name, TypeError(f"{name} must be three numbers, not {describe(value)}")) from None
    if not all(math.isfinite(x) for x in out):
        raise about(name, ValueError(f"{name} must be three finite numbers, not {out}"))
    return out


def coordinates(value, name):
    """Points as an array of float64 of shape (n, 3); a single one may stand for itself."""
    message = f"{name} must be an array of numbers of shape (n, 3)"
    try:
        array = np.asarray(value)
        # Numbers that are no machine's come as objects.
        if array.dtype.kind not in "iufO" or (array.dtype.kind == "O" and not all(map(_is_real, array.flat))):
            raise TypeError
        array = np.ascontiguousarray(array, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise about(name, TypeError(message)) from None
    return array


def _is_real(value):
    return isinstance(value, numbers.Real) and not isinstance(value, bool)


def text(value, name):
    """A string that files can hold."""
    if not isinstance(value, str):
        raise about(name, TypeError(f"{name} must be a string, not {describe(value)}"))
    try:
        value.encode()
    except UnicodeEncodeError:
        raise about(name, ValueError(f"{name} {value!r} is not text: it has half a character (a surrogate)")) from None
    if "\0" in value:
        raise about(name, ValueError(f"{name} {value!r} has a NUL character, where it would end in files"))
    return value


def path(value, name):
    """The path of a file as a string, for os and the engine: bytes in it that are no text are as os.fsdecode() has
    them."""
    if not isinstance(value, (str, os.PathLike)):
        raise about(name, TypeError(f"{name} must be a string or a path object, not {describe(value)}"))
    out = os.fsdecode(value)
    try:
        os.fsencode(out)
    except UnicodeEncodeError:
        raise about(name, ValueError(f"{name} {out!r} is no path: it has half a character (a surrogate)")) from None
    if "\0" in out:
        raise about(name, ValueError(f"{name} {out!r} has a NUL character, where it would end"))
    return out


def from_system(value):
    """A path, or an argument of the command line, as text to be shown: as UTF-8 or, where it is none, Latin-1."""
    raw = os.fsencode(value)
    try:
        return raw.decode()
    except UnicodeDecodeError:
        return raw.decode("latin-1")


def flag(value, name):
    """True or False."""
    if not isinstance(value, bool):
        raise about(name, TypeError(f"{name} must be True or False, not {describe(value)}"))
    return value


def real(value, name):
    """A finite number as float."""
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise about(name, TypeError(f"{name} must be a number, not {describe(value)}"))
    out = _as_float(value)
    if not math.isfinite(out):
        raise about(name, ValueError(f"{name} must be a finite number, not {out}"))
    return out


def pair(value, name):
    """Two finite numbers as a tuple of float."""
    first, second = _listed(value, name, 2)
    return real(first, name), real(second, name)


def whole(value, name, minimum, maximum=2**63 - 1):
    """An integer between `minimum` and `maximum`."""
    if isinstance(value, bool) or not isinstance(value, numbers.Integral):
        raise about(name, TypeError(f"{name} must be an integer, not {describe(value)}"))
    if value < minimum:
        raise about(name, ValueError(f"{name} must be at least {minimum}, not {value}"))
    if value > maximum:
        raise about(name, ValueError(f"{name} must be at most {maximum}, not {describe(value)}"))
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
