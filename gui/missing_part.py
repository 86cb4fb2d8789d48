# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the workbench offers while its engine cannot be loaded: to say what is missing, and the command that brings it.

Nothing here imports the engine.
"""

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

import femscalpel_documents
import femscalpel_parts

from . import qt
from .translate import QT_TRANSLATE_NOOP, icon, translate

NAME = "FemScalpel_WhatIsMissing"
_shown = []  # one entry once the message was shown
_observers = []  # kept, as FreeCAD holds no reference


def show():
    """A message with what is missing; its button copies the command."""
    missing = femscalpel_parts.missing()
    box = QtGui.QMessageBox(FreeCADGui.getMainWindow())
    box.setObjectName("FemScalpelMissing")
    box.setIcon(QtGui.QMessageBox.Warning)
    box.setWindowTitle("FemScalpel")
    box.setTextFormat(QtCore.Qt.PlainText)
    box.setTextInteractionFlags(QtCore.Qt.TextSelectableByMouse)
    box.setText(translate("FemScalpel", "FemScalpel cannot run: %1").replace("%1", missing.what))
    box.setInformativeText(
        translate("FemScalpel", "This command brings it; start FreeCAD anew then:\n\n%1").replace("%1", missing.command)
    )
    copy = box.addButton(translate("FemScalpel", "Copy the command"), QtGui.QMessageBox.ActionRole)
    copy.setObjectName("copyCommand")
    box.addButton(QtGui.QMessageBox.Ok)
    qt.run(box)
    if box.clickedButton() is copy:
        QtGui.QApplication.clipboard().setText(missing.command)


def show_once():
    """The message, when the workbench is chosen for the first time, after the window came to rest."""
    if not _shown:
        _shown.append(True)
        QtCore.QTimer.singleShot(0, show)


class WhatIsMissing:
    """The only command: says what is missing."""

    def GetResources(self):
        return {
            "Pixmap": icon("FemScalpel"),
            "MenuText": QT_TRANSLATE_NOOP("FemScalpel_WhatIsMissing", "What is missing..."),
            "ToolTip": QT_TRANSLATE_NOOP(
                "FemScalpel_WhatIsMissing", "Says which part of FemScalpel is missing and which command brings it"
            ),
        }

    def IsActive(self):
        return True

    def Activated(self):
        show()


def register():
    """Adds the command to FreeCAD; returns the names for the toolbar and for the menu."""
    FreeCADGui.addCommand(NAME, WhatIsMissing())
    return [NAME], [NAME]


def _warn(document):
    """Of objects that cannot work, and lose what they are when the document is saved."""
    made = [o.Label for o in document.Objects if "NodeSetCounts" in o.PropertiesList]
    if made:
        FreeCAD.Console.PrintWarning(
            translate(
                "FemScalpel",
                "Document %1 has objects of FemScalpel (%2), which do not recompute while a part of FemScalpel is "
                "missing, nor after the document was saved without it. Close it without saving.",
            )
            .replace("%1", document.Label)
            .replace("%2", ", ".join(made))
            + "\n"
        )


def watch_documents():
    """From now on warns when a document is opened whose objects need the engine."""
    _observers.append(femscalpel_documents.Opened(_warn))
    FreeCAD.addDocumentObserver(_observers[-1])
