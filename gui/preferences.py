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


def _packed(rgb):
    return int("".join(f"{round(255 * c):02X}" for c in rgb) + "FF", 16)


def _unpacked(value):
    return tuple(((value >> shift) & 255) / 255 for shift in (24, 16, 8))


def colour(name, default):
    """A colour of the preview as three numbers in [0, 1]."""
    return _unpacked(_group().GetUnsigned("Colour" + name, _packed(default)))


def _group_colours():
    return FreeCAD.ParamGet(GROUP + "/GroupColours")


def group_colour(name):
    """The colour the user has chosen for groups of that name, None if none."""
    value = _group_colours().GetUnsigned(name, 0)
    return _unpacked(value) if value else None


def set_group_colour(name, rgb):
    """Keeps a colour for groups of that name, in all meshes."""
    _group_colours().SetUnsigned(name, _packed(rgb))


def most_elements():
    """Elements of a mesh up to which refining first needs no asking."""
    return max(1, _group().GetInt("MostElements", 500_000))


def most_memory():
    """Megabytes up to which refining first needs no asking; 0: half of what is free."""
    return max(0, _group().GetInt("MostMemory", 0))


def is_unfolded(section, default):
    """Whether a section of the panels is open."""
    return _group().GetBool("Unfolded" + section, default)


def set_unfolded(section, is_open):
    """Keeps whether a section of the panels is open."""
    _group().SetBool("Unfolded" + section, is_open)


def put_into_analysis():
    """Whether new objects take their source's place in its analysis."""
    return _group().GetBool("PutIntoAnalysis", True)
