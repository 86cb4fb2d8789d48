# SPDX-License-Identifier: LGPL-2.1-or-later
"""The guided tour of resources/docs/tour.md, step by step; its pictures are these screenshots."""

import femmesh_bridge
import femscalpel as fs
import FreeCAD
import FreeCADGui
import ObjectsFem
from femmesh.gmshtools import GmshTools

from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest
from .test_crack_panel import enter_plane, long_box
from femscalpeltest.documents import geometry_link


class Tour(GuiTest):
    def test_tour(self):
        self.add_mesh(long_box(2), "Bracket")
        FreeCADGui.Selection.addSelection(self.doc.Name, "Bracket")
        screenshot("tour_1_mesh")
        FreeCADGui.Selection.clearSelection()
        self.run_command("FemScalpel_Crack")
        choose("patch", "Whole")
        self.wait_for_preview()
        plane = (6.2, 2.5, 2.0), (1.0, 0.25, 0.15)
        enter_plane(*plane)
        moved = fs.crack(femmesh_bridge.from_femmesh(self.doc.Bracket.FemMesh), fs.Plane(*plane)).report.nodes_moved
        wait_until(
            lambda: widget("status").text().startswith(f"{moved} ") and moved_drawn() == moved,
            "the preview of the tilted plane",
        )
        screenshot("tour_2_crack")
        choose("colouring", "groups")
        click_row("groups", "CORE")
        screenshot("tour_3_groups")
        press_ok()
        self.assertGreater(self.doc.Crack.NodesDoubled, 0)
        screenshot("tour_4_cracked")
        FreeCADGui.Selection.addSelection(self.doc.Name, "Crack")
        self.run_command("FemScalpel_Drill")
        spin(0.3)
        for name, text in (
            ("originX", "10.5"),
            ("originZ", "4"),
            ("normalX", "0"),
            ("normalZ", "-1"),
            ("radius", "1.2"),
        ):
            type_into(name, text)
        wait_until(lambda: faces_drawn("FemScalpelRemoved") > 0, "the preview of the hole")
        spin(0.5)
        screenshot("tour_5_drill")
        press_ok()
        self.assertEqual(self.doc.Drill.Source, self.doc.Crack)
        screenshot("tour_6_drilled")
        self.add_rib()
        FreeCADGui.Selection.clearSelection()
        for name in ("Drill", "RibMesh"):
            FreeCADGui.Selection.addSelection(self.doc.Name, name)
        self.run_command("FemScalpel_Merge")
        type_into("groupName", "RIB")
        wait_until(lambda: lines_drawn("FemScalpelOutline") > 0, "the preview of the stiffener")
        spin(0.5)
        screenshot("tour_7_merge")
        press_ok()
        self.assertEqual((self.doc.Merge.Source, self.doc.Merge.Addition), (self.doc.Drill, self.doc.RibMesh))
        screenshot("tour_8_merged")
        for _ in range(3):
            self.doc.undo()
        self.assertEqual([o.Name for o in self.doc.Objects], ["Bracket", "Rib", "RibMesh"])

    def add_rib(self):
        """A stiffener on the bracket, drawn in FreeCAD and meshed there."""
        rib = self.doc.addObject("Part::Box", "Rib")
        rib.Length, rib.Width, rib.Height = 4.1, 0.6, 1.5
        rib.Placement.Base = FreeCAD.Vector(0.63, 2.17, 4)
        self.doc.recompute()
        mesh = ObjectsFem.makeMeshGmsh(self.doc, "RibMesh")
        setattr(mesh, geometry_link(mesh), rib)
        mesh.CharacteristicLengthMax, mesh.ElementOrder = 0.6, "1st"
        GmshTools(mesh).create_mesh()
        rib.ViewObject.Visibility = False
        self.doc.recompute()
