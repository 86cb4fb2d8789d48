# SPDX-License-Identifier: LGPL-2.1-or-later
"""The context menu of the objects that operators make."""

import FreeCADGui
from PySide import QtCore, QtGui

import femscalpel
from femscalpelobjects.analysis import analysis_of

from ..macro import record_import
from ..panels.report_dialog import show_report_of
from ..panels.summary import sentence
from ..translate import icon, translate


def is_free(title):
    """Whether no task panel is open; tells the user when one is."""
    if not FreeCADGui.Control.activeDialog():
        return True
    QtGui.QMessageBox.information(
        FreeCADGui.getMainWindow(), title, translate("FemScalpel", "Another task panel is open. Close it first.")
    )
    return False


def fill(menu, provider, vobj):
    """Puts in what can be done with an object. `provider`: its view provider's proxy."""
    from ..commands.export import Export
    from ..commands.group_inspector import GroupInspector
    from ..commands.mesh_quality import MeshQuality

    obj = vobj.Object
    has_mesh = obj.FemMesh.NodeCount > 0
    _add(menu, provider.getIcon(), translate("FemScalpel", "Edit"), lambda: provider.doubleClicked(vobj))
    if analysis_of(obj) is not None:
        text, function = translate("FemScalpel", "Take out of the analysis"), "takeOutOfAnalysis"
    else:
        text, function = translate("FemScalpel", "Put into the analysis"), "putIntoAnalysis"
    can_move = analysis_of(obj) is not None or has_mesh and bool(obj.Document.findObjects("Fem::FemAnalysis"))
    _add(menu, None, text, lambda: _move(obj, text, function), can_move)
    menu.addSeparator()
    for command in (GroupInspector(), MeshQuality(), Export()):
        _add(
            menu,
            icon(command.NAME),
            command.title(),
            lambda command=command: _run(command, obj),
            has_mesh,
        )
    _add(menu, None, translate("FemScalpel", "Report…"), lambda: show_report_of(obj), bool(obj.GroupReport))
    if provider.crack is not None and provider.crack.is_one:
        action = _add(menu, None, translate("FemScalpel", "Show crack"), lambda: provider.crack.light(), has_mesh)
        action.setCheckable(True)
        action.setChecked(provider.crack.is_lit)


def _add(menu, picture, text, run, enabled=True):
    action = menu.addAction(QtGui.QIcon(picture), text) if picture else menu.addAction(text)
    action.setEnabled(enabled)
    action.triggered.connect(lambda *_: run())
    return action


def _run(command, obj):
    if is_free(command.title()):
        command.guarded(lambda: command.run(obj))


def _move(obj, title, function):
    """Puts an object into the analysis, or takes it out of it, by recorded lines and as one step to undo."""
    record_import()
    try:
        FreeCADGui.doCommand(
            f"ObjectsFemScalpel.{function}(FreeCAD.getDocument({obj.Document.Name!r}).getObject({obj.Name!r}))"
        )
    except (femscalpel.Error, ValueError, RuntimeError) as error:
        QtGui.QMessageBox.warning(FreeCADGui.getMainWindow(), title, sentence(str(error)))
