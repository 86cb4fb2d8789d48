# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command that cracks along faces of a group, on elements of all types."""

import unittest

import FreeCADGui
import numpy as np

import femmesh_bridge
import femscalpel as fs
import ObjectsFemScalpel
from femscalpelgui.view.inner_faces import Lips, groups_inside
from femscalpelgui.view.preview_data import PreviewSource, make_preview
from femscalpeltest.all_elements import SOLIDS, mesh_of
from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest
from .mesh_content import content_of
from .test_crack_panel import traces


class FaceCrack(GuiTest):
    def open_panel(self):
        self.run_command("FemScalpel_FaceCrack")
        wait_until(is_ready, "the panel")

    def test_made_edited_undone(self):
        mesh = self.add_mesh(mesh_of("hexahedron"))
        before = traces(self.doc)
        self.open_panel()
        box = widget("faceGroup")
        self.assertEqual([box.itemText(k) for k in range(box.count())], ["HALF", "SECTION"])
        self.assertFalse(is_shown("method") or is_shown("featureAngle") or is_shown("refine") or is_shown("preserve"))
        choose("faceGroup", "SECTION")
        source = femmesh_bridge.from_femmesh(mesh.FemMesh)
        whole, half = (fs.crack(source, fs.Faces(name)).report for name in ("SECTION", "HALF"))

        def status(report):
            return f"0 nodes moved, {report.nodes_added} added; {report.elements_added} elements added"

        wait_until(lambda: widget("status").text().startswith(status(whole)), "the preview")
        self.assertNotIn("First became", widget("status").text())
        # Of 6 x 4 x 3 bricks: a lip and the skin of the bricks at it; the rest on this side; the skin of the other.
        self.assertEqual(faces_drawn("FemScalpelBand"), 12 + 14)
        self.assertEqual(faces_drawn("FemScalpelRest"), 12 + 2 * 14)
        self.assertEqual(faces_drawn("FemScalpelGhost"), 54)
        self.assertEqual(lines_drawn("FemScalpelOutline"), 14)
        self.assertEqual(moved_drawn(), 0)
        np.testing.assert_array_equal(widget("histogram").after, whole.quality.after.histogram)
        names = [widget("groups").item(row, 0).text() for row in range(widget("groups").rowCount())]
        self.assertCountEqual(names, [g.name for g in whole.groups])
        screenshot("face_crack")
        click_row("groups", "SECTION")
        self.assertEqual(points_drawn("FemScalpelHighlightPoints"), 2 * 20)
        choose("look", "changed part only")
        self.assertEqual(faces_drawn("FemScalpelBand"), 2 * (12 + 14))
        press_ok()
        crack = self.doc.FaceCrack
        self.assertEqual((crack.Group, crack.NodesDoubled), ("SECTION", whole.nodes_doubled))
        self.assertEqual(crack.FemMesh.HexaCount, 72)
        made = content_of(crack)
        self.doc.undo()
        self.assertEqual([o.Name for o in self.doc.Objects], ["Mesh"])
        self.doc.redo()
        crack = self.doc.FaceCrack
        self.assertEqual(content_of(crack), made)

        crack.ViewObject.doubleClicked()
        self.wait_for_preview()
        self.assertEqual(widget("faceGroup").currentText(), "SECTION")
        choose("faceGroup", "HALF")
        type_into("groupName", "SLIT")
        wait_until(lambda: widget("status").text().startswith(status(half)), "the other preview")
        self.assertEqual(lines_drawn("FemScalpelFront"), 3)
        press_ok()
        self.assertEqual((crack.Group, crack.GroupName, crack.NodesDoubled), ("HALF", "SLIT", half.nodes_doubled))
        self.doc.undo()
        self.assertEqual(content_of(crack), made)
        self.doc.undo()
        self.open_panel()
        press_cancel()
        self.assertEqual(traces(self.doc)[0], before[0])

    def test_messages(self):
        mesh = mesh_of("tetra")
        mesh.add_group("CRACK_N", "node", mesh.node_ids[:1])
        self.add_mesh(mesh)
        self.open_panel()
        self.wait_for_preview()
        self.assertEqual(widget("groupName").text(), "CRACK2")
        type_into("groupName", "CRACK")
        self.assertIn("taken", self.wait_for_message("nameError"))
        press_ok()
        self.assertTrue(FreeCADGui.Control.activeDialog(), "closed although nothing could be made")
        press_cancel()
        self.doc.Mesh.FemMesh = femmesh_bridge.to_femmesh(fs.Mesh(mesh.points, mesh.cells))
        self.open_panel()
        self.assertIn("No group of the mesh", self.wait_for_message("geometryError"))
        self.assertFalse(widget("faceGroup").isEnabled())
        press_ok()
        self.assertTrue(FreeCADGui.Control.activeDialog())

    def test_group_that_is_gone(self):
        mesh = self.add_mesh(mesh_of("wedge"))
        crack = ObjectsFemScalpel.makeFaceCrack(self.doc, mesh, "GONE")
        crack.ViewObject.doubleClicked()
        self.assertIn("GONE", self.wait_for_message("geometryError"))
        choose("faceGroup", "SECTION")
        self.wait_for_preview()
        press_ok()
        self.assertEqual(crack.Group, "SECTION")

    def test_every_element_type(self):
        for kind in (*SOLIDS, "triangle", "quad", "quad8"):
            with self.subTest(kind=kind):
                mesh = self.add_mesh(mesh_of(kind))
                self.open_panel()
                choose("faceGroup", "SECTION")
                self.wait_for_preview()
                self.assertGreater(faces_drawn("FemScalpelBand"), 0)
                self.assertGreater(lines_drawn("FemScalpelOutline"), 3)
                self.assertGreater(widget("histogram").after.sum(), 0)
                screenshot("face_crack_" + kind)
                press_ok()
                self.assertGreater(self.doc.FaceCrack.NodesDoubled, 0)
                self.doc.removeObject("FaceCrack")
                self.doc.removeObject(mesh.Name)


class Sides(unittest.TestCase):
    """What tells the sides of a crack along faces, without a window."""

    def test_of_every_element_type(self):
        for kind in (*SOLIDS, "triangle", "quad"):
            with self.subTest(kind=kind):
                mesh = mesh_of(kind)
                self.assertEqual(groups_inside(mesh), ["HALF", "SECTION"])
                source = PreviewSource(mesh)
                for group in ("SECTION", "HALF"):
                    result = source.scalpel.crack(fs.Faces(group), band_only=True)
                    lips = Lips(result.mesh, "CRACK")
                    offset = source.points[:, 0] - 3
                    off = np.abs(offset) > 0.4
                    np.testing.assert_array_equal(np.sign(lips.distance(source.points[off])), np.sign(offset[off]))
                    self.check(kind, source, result, make_preview(source, result, lips))

    def check(self, kind, source, result, data):
        """All of the skin is drawn once, and so are both lips."""
        drawn = sum(len(part.faces) for part in (*data.rest, *data.band))
        lips = sum(g.count_after for g in result.report.groups if g.status == "new" and g.dimension == 2)
        self.assertEqual(drawn, len(source.skin) + lips)
        if kind not in ("triangle", "quad"):
            self.assertEqual([int(part.lip.sum()) for part in data.band], [lips // 2] * 2)

    def test_groups_of_elements(self):
        for kind, faces in (("hexahedron", "quad"), ("quad", "line")):
            with self.subTest(kind=kind):
                mesh = mesh_of(kind)
                source = PreviewSource(mesh)
                width = 4 if faces == "quad" else 2
                at = [np.flatnonzero(np.abs(mesh.points[:, 0] - x) < 0.3) for x in (0, 3)]
                cells = {name: np.asarray(nodes) for name, nodes in mesh.cells.items()}
                rows = [self.squares(mesh, nodes, width) for nodes in at]
                cells[faces] = np.concatenate(rows)
                both = fs.Mesh(mesh.points, cells)
                ids = both.cell_ids[faces]
                both.add_group("OUTSIDE", "element", ids[: len(rows[0])])
                both.add_group("INSIDE", "element", ids[len(rows[0]) :])
                both.add_group("BULK", "element", both.cell_ids[kind])
                self.assertEqual(groups_inside(both), ["INSIDE"])
                self.assertEqual(source.mesh.cell_count, mesh.cell_count)

    def squares(self, mesh, nodes, width):
        """Faces (edges) of a grid between nodes in one plane across x."""
        places = {tuple(np.round(mesh.points[n][1:]).astype(int)): n for n in nodes}
        steps = ((0, 0), (1, 0), (1, 1), (0, 1))[:width]
        found = [[places.get((y + a, z + b)) for a, b in steps] for y, z in places]
        return np.array([row for row in found if None not in row])
