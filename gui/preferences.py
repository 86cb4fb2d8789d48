# SPDX-License-Identifier: LGPL-2.1-or-later
"""The user's preferences, kept with FreeCAD's own; the page to change them is preferences.ui."""

import FreeCAD

GROUP = "User parameter:BaseApp/Preferences/Mod/FemScalpel"
METHODS = ("snap", "deform")


def _group():
    return FreeCAD.ParamGet(GROUP)


def method():
    """Method that new operations start with."""
    return METHODS[min(max(_group().GetInt("Method", 0), 0), len(METHODS) - 1)]


def transition():
    """Rings of elements that may move; 0: automatic."""
    return _group().GetInt("Transition", 0)


def quality_threshold():
    """Mean ratio below which the panels warn."""
    return _group().GetFloat("QualityThreshold", 0.2)


def colour(name, default):
    """A colour of the preview as three numbers in [0, 1]."""
    packed = "".join(f"{round(255 * c):02X}" for c in default) + "FF"
    value = _group().GetUnsigned("Colour" + name, int(packed, 16))
    return tuple(((value >> shift) & 255) / 255 for shift in (24, 16, 8))


def put_into_analysis():
    """Whether new objects take their source's place in its analysis."""
    return _group().GetBool("PutIntoAnalysis", True)
