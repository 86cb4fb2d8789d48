# SPDX-License-Identifier: LGPL-2.1-or-later
"""Input of a group that covers faces inside a mesh."""

from ..translate import translate
from .panel_input import PanelInput


class FaceGroupInput(PanelInput):
    """The name of a group, from a list that fill() gives."""

    UI = "face_group_input.ui"

    def __init__(self, source_object):
        super().__init__(source_object)
        self.form.faceGroup.currentIndexChanged.connect(lambda *_: self.changed.emit())

    def group(self):
        """The name that is chosen, or None."""
        return self.form.faceGroup.currentData()

    def forget_group(self):
        """Nothing is chosen any more, until fill() lists names."""
        blocked = self.form.faceGroup.blockSignals(True)
        self.form.faceGroup.clear()
        self.form.faceGroup.blockSignals(blocked)

    def fill(self, names, chosen=None):
        """Lists names, and enters `chosen`, also if it is none of them, or the first; without telling anyone."""
        box = self.form.faceGroup
        blocked = box.blockSignals(True)
        box.clear()
        for name in names if chosen in (None, "", *names) else (*names, chosen):
            box.addItem(name, name)
        box.setCurrentIndex(max(box.findData(chosen), 0))
        box.setEnabled(box.count() > 0)
        box.blockSignals(blocked)

    def error(self):
        if self.group():
            return ""
        return translate(
            "FemScalpel",
            "No group of the mesh covers faces inside it (of a shell: edges). Make one of them, or of their nodes, "
            "first.",
        )
