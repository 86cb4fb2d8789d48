# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the Python bindings of Qt 5 and Qt 6 differ, which FreeCAD's `PySide` stands for: by what is there."""


def run(modal, *arguments):
    """Runs a dialog or an event loop until it ends, and returns what it returns."""
    return (getattr(modal, "exec_", None) or modal.exec)(*arguments)


def number(flags):
    """An int for flags of Qt, which FreeCAD wants of a panel: Qt 6's are Python enumerations."""
    return int(getattr(flags, "value", flags))
