# SPDX-License-Identifier: LGPL-2.1-or-later
"""Texts in the user's language, and the folders of forms, icons and translations."""

import os

import FreeCAD

FOLDER = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
ICONS = os.path.join(FOLDER, "resources", "icons")
TRANSLATIONS = os.path.join(FOLDER, "resources", "translations")
EXAMPLE = os.path.exists(os.path.join(FOLDER, "resources", "examples", "caisson.npz"))  # whether it is there
PREFERENCES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "preferences.ui")

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP


def form(name):
    """Path of a Qt Designer file of the task panels."""
    return os.path.join(os.path.dirname(os.path.abspath(__file__)), "panels", name)


def icon(name):
    """Path of an icon."""
    return os.path.join(ICONS, name + ".svg")
