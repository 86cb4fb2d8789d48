# SPDX-License-Identifier: LGPL-2.1-or-later
"""A window with an operation's report, to be read, copied and saved."""

import json

import FreeCADGui
from PySide import QtCore, QtGui

from .. import saving
from ..translate import translate


def show_report(name, text, data):
    """Shows a report and returns the window.

    Parameters
    ----------
    name : str
        What it is about.
    text : str
    data : str
        The same as JSON; "" where there is none.
    """
    dialog = QtGui.QDialog(FreeCADGui.getMainWindow())
    dialog.setObjectName("femscalpelReport")
    title = translate("FemScalpel", "Report: %1").replace("%1", name)
    dialog.setWindowTitle(title)
    shown = QtGui.QPlainTextEdit()
    shown.setObjectName("reportText")
    shown.setReadOnly(True)
    shown.setLineWrapMode(QtGui.QPlainTextEdit.NoWrap)
    font = shown.font()
    font.setFamily("monospace")
    font.setStyleHint(QtGui.QFont.Monospace)
    shown.setFont(font)
    shown.setPlainText(text)
    buttons = QtGui.QDialogButtonBox(QtGui.QDialogButtonBox.Close)
    buttons.rejected.connect(dialog.reject)
    copy = buttons.addButton(translate("FemScalpel", "Copy"), QtGui.QDialogButtonBox.ActionRole)
    copy.setObjectName("copyReport")
    copy.clicked.connect(lambda *_: saving.copy(text))
    formats = {translate("FemScalpel", "Text"): (".txt", lambda: text)}
    if data:
        formats["JSON"] = (".json", lambda: data)
    save = buttons.addButton(translate("FemScalpel", "Save…"), QtGui.QDialogButtonBox.ActionRole)
    save.setObjectName("saveReport")
    save.clicked.connect(lambda *_: saving.save(title, name, formats))
    layout = QtGui.QVBoxLayout(dialog)
    layout.addWidget(shown)
    layout.addWidget(buttons)
    dialog.resize(760, 520)
    dialog.setAttribute(QtCore.Qt.WA_DeleteOnClose)
    dialog.show()
    return dialog


def show_report_of(obj):
    """Shows what was done to make the mesh of a document object, and what became of every group."""
    data = ""
    if getattr(obj, "ReportData", ""):
        data = json.dumps({**json.loads(obj.ReportData), "pieces": list(obj.Pieces)}, indent=1, ensure_ascii=False)
    return show_report(obj.Label, "\n".join(obj.GroupReport) + "\n", data)
