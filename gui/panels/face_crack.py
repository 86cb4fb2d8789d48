# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panel: crack along faces that the mesh has."""

import femscalpel

from ..translate import QT_TRANSLATE_NOOP
from ..view.inner_faces import Lips, groups_inside
from .face_group_input import FaceGroupInput
from .group_panel import GroupPanel


class FaceCrackPanel(GroupPanel):
    """Asks for the group whose faces come apart."""

    TITLE = QT_TRANSLATE_NOOP("FemScalpel", "Crack along faces")
    ICON = "FemScalpel_FaceCrack"
    GROUP_NAME, OBJECT_NAME, MAKE = "CRACK", "FaceCrack", "makeFaceCrack"
    OFFERED = ("group_name",)  # nothing moves

    def make_geometry(self):
        return FaceGroupInput(self.source_object)

    def read_mesh(self, femmesh):
        source = super().read_mesh(femmesh)
        self._names = groups_inside(source.mesh)
        return source

    def offered_from(self):
        return self._names

    def own_errors(self):
        return {"group": self.geometry.form.geometryError}

    def tool(self):
        return femscalpel.Faces(self.geometry.group())

    def surface(self, tool):
        return lambda result: Lips(result.mesh, result.report.name)

    def operation(self, tool, options):
        return lambda scalpel, band_only: scalpel.crack(tool, name=options["name"], band_only=band_only)

    def arguments(self):
        return {"group": repr(self.geometry.group()), **super().arguments()}

    def settings(self):
        return {"Group": repr(self.geometry.group()), **super().settings()}
