# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the task panels share that only look at a mesh."""

import FreeCADGui
from PySide import QtGui

from .. import qt
from ..translate import form, icon, translate
from ..view.group_scene import GroupScene
from . import fields
from .view_panel import ViewPanel


class InspectionPanel(ViewPanel):
    """One form with the labels `status` and `error`, a GroupScene, and a Close button."""

    #: Set by subclasses.
    TITLE = ICON = UI = ""

    def __init__(self, source_object):
        super().__init__(source_object)
        self.panel = FreeCADGui.PySideUic.loadUi(form(self.UI))
        self.form = [self.panel]
        self.panel.setWindowTitle(translate("FemScalpel", self.TITLE))
        self.panel.setWindowIcon(QtGui.QIcon(icon(self.ICON)))
        self.set_up()
        self.scene = GroupScene(self.view)
        self.panel.status.setText(translate("FemScalpel", "Reading the mesh…"))
        self.start()

    def set_up(self):
        """Fills and connects the widgets."""
        raise NotImplementedError

    def getStandardButtons(self):
        return qt.number(QtGui.QDialogButtonBox.Close | QtGui.QDialogButtonBox.Help)

    def reading_again(self):
        fields.show_error(self.panel.error, "")
        self.panel.status.setText(translate("FemScalpel", "Reading the mesh…"))

    def not_loaded(self, error):
        fields.show_error(self.panel.error, str(error))

    def clear_view(self):
        self.scene.close()

    def forget_widgets(self):
        self.panel = None
