# SPDX-License-Identifier: LGPL-2.1-or-later
"""The document object Crack."""

import os
import json
import sys

import FreeCAD
import numpy as np

import femmesh_bridge
import femscalpel as fs
import ObjectsFemScalpel

from .documents import DocumentTest, content, groups_of
from .meshes import box_with_groups, grid_box, quadratic, tetra_volumes


class CrackObject(DocumentTest):
    def setUp(self):
        super().setUp()
        self.mesh = box_with_groups()
        self.source = self.add_source(self.mesh)
        self.crack = ObjectsFemScalpel.makeCrack(self.doc, self.source, origin=(3.3, 2.5, 2), normal=(0.9, 0.3, 0.2))

    def recompute(self):
        self.doc.recompute()
        self.assertNotIn("Invalid", self.crack.State)
        return femmesh_bridge.from_femmesh(self.crack.FemMesh)

    def assertFails(self, message):
        self.doc.recompute()
        self.assertIn("Invalid", self.crack.State)
        self.assertEqual(self.crack.FemMesh.NodeCount, 0, "an outdated mesh is shown")
        self.assertEqual(self.crack.GroupReport, [])
        self.assertIsNone(self.crack.Proxy.report)
        self.assertFalse(hasattr(sys, "tracebacklimit"), "tracebacks stay off after a failure")
        with self.assertRaisesRegex(RuntimeError, message):
            self.crack.Proxy.execute(self.crack)

    def test_same_as_the_engine(self):
        mesh = self.recompute()
        expected = fs.crack(self.mesh, fs.Plane((3.3, 2.5, 2), (0.9, 0.3, 0.2)))
        nodes, elements, groups = content(mesh)
        expected_nodes, expected_elements, expected_groups = content(expected.mesh)
        self.assertEqual(nodes.keys(), expected_nodes.keys())
        for number, point in nodes.items():
            np.testing.assert_allclose(point, expected_nodes[number], atol=1e-12)
        lips = {("CRACK_P", "element"), ("CRACK_N", "element")}
        self.assertEqual(elements, {i: e for i, e in expected_elements.items() if e[0] == "tetra"})
        # FreeCAD's document objects keep no empty groups.
        self.assertEqual(
            {k: v for k, v in groups.items() if not k[0].startswith("CRACK_")},
            {k: v for k, v in expected_groups.items() if v and not k[0].startswith("CRACK_")},
        )
        self.assertTrue(lips <= expected_groups.keys())

    def test_results_are_shown(self):
        self.recompute()
        report = self.crack.Proxy.report
        self.assertEqual(self.crack.NodesAdded, report.nodes_added)
        self.assertEqual(self.crack.NodesAdded, self.crack.FemMesh.NodeCount - self.source.FemMesh.NodeCount)
        self.assertGreater(self.crack.NodesDoubled, 0)
        self.assertEqual(self.crack.NodesMoved, report.nodes_moved)
        self.assertTrue(0 < self.crack.MinimumQuality < 1)
        self.assertEqual(self.crack.MaxDisplacement.Value, report.max_displacement)
        self.assertEqual(self.crack.NodeSetCounts["ICN"], str(len(report.node_sets["ICN"])))
        self.assertEqual(self.crack.ConstraintCounts["plane"], str(report.constraints["plane"]))
        self.assertEqual(self.crack.Warnings, report.warnings)
        self.assertIn("LEFT", "\n".join(self.crack.GroupReport))
        area = 20 * 0.94**0.5 / 0.9
        self.assertAlmostEqual(self.crack.CrackArea.Value, area)
        self.assertEqual(self.crack.FrontLength.Value, 0)
        self.assertIn(f"crack of area {area:.6g}", "\n".join(self.crack.GroupReport))
        data = json.loads(self.crack.ReportData)
        self.assertEqual(data["nodes_added"], report.nodes_added)
        self.assertEqual(data["node_sets"]["ICN"], len(report.node_sets["ICN"]))

    def test_source_is_untouched(self):
        before = content(femmesh_bridge.from_femmesh(self.source.FemMesh))
        self.recompute()
        self.assertEqual(content(femmesh_bridge.from_femmesh(self.source.FemMesh)), before)

    def test_follows_its_properties(self):
        first = self.crack.PlanePlacement
        reference = content(self.recompute())
        self.crack.PlanePlacement = FreeCAD.Placement(FreeCAD.Vector(1.7, 0, 0), first.Rotation)
        self.assertTrue(content(self.recompute())[0] != reference[0])
        self.crack.PlanePlacement = first
        self.assertTrue(content(self.recompute()) == reference)
        self.crack.GroupName = "CUT"
        self.assertIn("CUT_P", self.recompute().groups)
        self.crack.Transition = 3
        self.recompute()
        self.assertEqual(self.crack.Proxy.report.transition, 3)

    def test_preserved_groups(self):
        self.assertEqual(self.crack.PreservedGroups, ["*"])
        self.recompute()
        kept = {g.name: g.boundary_kept for g in self.crack.Proxy.report.groups if g.status != "new"}
        self.assertTrue(kept and all(kept.values()))
        self.crack.PreservedGroups = ["LEFT"]
        self.recompute()
        kept = {g.name: g.boundary_kept for g in self.crack.Proxy.report.groups if g.status != "new"}
        self.assertEqual({name for name, value in kept.items() if value}, {"LEFT"})
        self.crack.PreservedGroups = ["NOSUCHGROUP"]
        self.assertFails("NOSUCHGROUP")
        self.crack.PreservedGroups = []
        self.recompute()
        self.assertFalse(any(g.boundary_kept for g in self.crack.Proxy.report.groups if g.status != "new"))
        made = ObjectsFemScalpel.makeCrack(self.doc, self.source, "Other", preserve=["FIX"])
        self.assertEqual(made.PreservedGroups, ["FIX"])

    def test_follows_its_source(self):
        self.recompute()
        count = self.crack.FemMesh.NodeCount
        self.source.FemMesh = femmesh_bridge.to_femmesh(grid_box((9, 8, 7)))
        self.assertGreater(self.recompute().node_count, count)
        self.assertNotIn("LEFT", self.recompute().groups)

    def test_plane_is_where_the_user_sees_it(self):
        turned = FreeCAD.Placement(FreeCAD.Vector(100, 0, 0), FreeCAD.Rotation(FreeCAD.Vector(0, 0, 1), 90))
        self.source.Placement = turned
        self.crack.PlanePlacement = FreeCAD.Placement(
            turned.multVec(FreeCAD.Vector(3.3, 2.5, 2)), turned.Rotation * self.crack.PlanePlacement.Rotation
        )
        mesh = self.recompute()
        self.assertTrue(self.crack.Placement.isIdentity())
        np.testing.assert_allclose(mesh.points.min(axis=0), [95, 0, 0], atol=1e-9)
        np.testing.assert_allclose(mesh.points.max(axis=0), [100, 6, 4], atol=1e-9)
        origin, normal = self.crack.PlanePlacement.Base, self.crack.PlanePlacement.Rotation.multVec(
            FreeCAD.Vector(0, 0, 1)
        )
        lip = mesh.points[np.isin(mesh.node_ids, mesh.groups["CRACK_P"].ids)]
        self.assertGreater(len(lip), 10)
        self.assertLess(np.abs(fs.Plane(origin, normal).distance(lip)).max(), 1e-8)

    def test_failures_leave_no_mesh(self):
        good = content(self.recompute())
        placement = self.crack.PlanePlacement
        self.crack.PlanePlacement = FreeCAD.Placement(FreeCAD.Vector(999, 0, 0), FreeCAD.Rotation())
        self.crack.PlanePlacement = FreeCAD.Placement(FreeCAD.Vector(0, 0, 999), FreeCAD.Rotation())
        self.assertFails("plane")
        self.crack.PlanePlacement = placement
        self.crack.GroupName = "NAME_THAT_IS_TOO_LONG_FOR_IT"
        self.assertFails("24")
        self.crack.GroupName = "CRACK"
        self.crack.Source = None
        self.assertFails("Source is not set")
        self.crack.Source = self.doc.addObject("Fem::FemMeshObject", "Empty")
        self.assertFails("has no mesh")
        self.crack.Source = self.doc.addObject("App::FeaturePython", "Other")
        self.assertFails("is not a FEM mesh")
        self.crack.Source = self.source
        self.assertTrue(content(self.recompute()) == good)

    def test_crack_of_a_crack(self):
        second = ObjectsFemScalpel.makeCrack(
            self.doc, self.crack, "Second", origin=(3, 2.5, 2), normal=(0, 0.2, 1), group_name="SECOND"
        )
        self.doc.recompute()
        names = {name for name, _, _ in groups_of(second.FemMesh)}
        self.assertTrue({"CRACK_P", "CRACK_N", "SECOND_P", "SECOND_N", "LEFT", "FIX"} <= names)
        good, placement = second.FemMesh.NodeCount, self.crack.PlanePlacement
        # FreeCAD does not recompute what depends on a failed object; it must not go on showing its old mesh.
        self.crack.PlanePlacement = FreeCAD.Placement(FreeCAD.Vector(0, 0, 999), FreeCAD.Rotation())
        self.doc.recompute()
        self.assertIn("Invalid", self.crack.State)
        self.assertEqual(second.FemMesh.NodeCount, 0)
        self.crack.PlanePlacement = placement
        self.doc.recompute()
        self.assertEqual(second.FemMesh.NodeCount, good)

    def test_lips_of_a_solid_mesh_without_faces_are_node_groups(self):
        self.recompute()
        self.assertEqual(self.crack.FemMesh.FaceCount, 0)
        types = {name: kind for name, kind, _ in groups_of(self.crack.FemMesh)}
        self.assertEqual((types["CRACK_P"], types["CRACK_N"]), ("Node", "Node"))

    def test_lips_of_a_solid_mesh_with_faces_are_face_groups(self):
        mesh = grid_box()
        cells = mesh.cells["tetra"]
        faces = np.sort(np.concatenate([cells[:, f] for f in ([0, 1, 2], [0, 1, 3], [1, 2, 3], [0, 2, 3])]), axis=1)
        skin, count = np.unique(faces, axis=0, return_counts=True)
        self.source.FemMesh = femmesh_bridge.to_femmesh(
            fs.Mesh(mesh.points, {"tetra": cells, "triangle": skin[count == 1]})
        )
        self.recompute()
        types = {name: kind for name, kind, _ in groups_of(self.crack.FemMesh)}
        self.assertEqual((types["CRACK_P"], types["CRACK_N"]), ("Face", "Face"))

    def test_lips_of_a_shell_mesh_are_edge_groups(self):
        points = [[x, y, 0] for x in range(7) for y in range(6)]
        quads = [(6 * x + y, 6 * x + y + 6, 6 * x + y + 7, 6 * x + y + 1) for x in range(6) for y in range(5)]
        triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
        self.source.FemMesh = femmesh_bridge.to_femmesh(fs.Mesh(points, {"triangle": triangles}))
        self.recompute()
        types = {name: kind for name, kind, _ in groups_of(self.crack.FemMesh)}
        self.assertEqual((types["CRACK_P"], types["CRACK_N"]), ("Edge", "Edge"))

    def test_quadratic(self):
        self.source.FemMesh = femmesh_bridge.to_femmesh(quadratic(grid_box()))
        mesh = self.recompute()
        self.assertEqual(set(mesh.cells), {"tetra10"})
        self.assertAlmostEqual(tetra_volumes(mesh.points, mesh.cells["tetra10"]).sum(), 120, places=7)
        self.assertGreater(tetra_volumes(mesh.points, mesh.cells["tetra10"]).min(), 0)

    def test_saved_and_loaded(self):
        before = self.recompute()
        shown = {
            name: getattr(self.crack, name) for name in ("NodesAdded", "GroupReport", "ConstraintCounts", "GroupName")
        }
        path = os.path.join(self.folder.name, "saved.FCStd")
        self.doc.saveAs(path)
        FreeCAD.closeDocument(self.doc.Name)
        self.doc = FreeCAD.openDocument(path)
        self.crack, self.source = self.doc.Crack, self.doc.Source
        self.assertEqual(self.crack.Proxy.Type, "FemScalpel::Crack")
        self.assertEqual(self.crack.Source, self.source)
        self.assertEqual({name: getattr(self.crack, name) for name in shown}, shown)
        self.assertEqual(self.crack.FemMesh.NodeCount, before.node_count)
        restored = femmesh_bridge.from_femmesh(self.crack.FemMesh)
        self.assertEqual(len(restored.groups["ALL"]), len(before.groups["ALL"]))
        self.assertAlmostEqual(tetra_volumes(restored.points, restored.cells["tetra"]).sum(), 120, places=7)
        # Made anew, it has the numbers of a crack in the source as FreeCAD has renumbered it.
        self.crack.touch()
        after = self.recompute()
        source = femmesh_bridge.from_femmesh(self.source.FemMesh)
        expected = fs.crack(source, fs.Plane((3.3, 2.5, 2), (0.9, 0.3, 0.2)))
        np.testing.assert_array_equal(after.cell_ids["tetra"], np.sort(expected.mesh.cell_ids["tetra"]))
        np.testing.assert_allclose(np.sort(after.points, axis=0), np.sort(before.points, axis=0), atol=1e-9)
        self.assertEqual(self.crack.Proxy.report.nodes_added, shown["NodesAdded"])

    def test_geometry_is_kept_through_a_file(self):
        box = self.doc.addObject("Part::Box", "Box")
        box.Length, box.Width, box.Height = 6, 5, 4
        self.source.addProperty("App::PropertyLink", "Part")
        self.source.Part = box
        self.doc.recompute()
        self.assertEqual(self.crack.Part, box)
        before = self.recompute()
        path = os.path.join(self.folder.name, "saved.FCStd")
        self.doc.saveAs(path)
        FreeCAD.closeDocument(self.doc.Name)
        self.doc = FreeCAD.openDocument(path)
        self.crack, self.source = self.doc.Crack, self.doc.Source
        self.assertNotIn("Touched", self.crack.State)
        self.assertEqual(self.crack.Part, self.doc.Box)
        self.crack.touch()
        self.assertEqual(self.recompute().node_count, before.node_count)

    def test_a_lost_source_is_told(self):
        self.recompute()
        self.doc.removeObject("Source")
        self.assertIsNone(self.crack.Source)
        self.assertFails("Source is not set; choose the FEM mesh to work on")
        self.assertIn("Source is not set", self.crack.getStatusString())

    def test_an_error_in_a_chain_reaches_its_end(self):
        second = ObjectsFemScalpel.makeCrack(
            self.doc, self.crack, "Second", origin=(3, 2.5, 2), normal=(0, 0.2, 1), group_name="SECOND"
        )
        self.doc.recompute()
        self.doc.removeObject("Source")
        self.doc.recompute()
        self.assertEqual((self.crack.FemMesh.NodeCount, second.FemMesh.NodeCount), (0, 0))

    def test_copied(self):
        original = content(self.recompute())
        copy = self.doc.copyObject(self.crack, False)
        self.assertEqual(copy.Source, self.source)
        self.assertEqual(copy.Proxy.Type, "FemScalpel::Crack")
        self.assertIsNot(copy.Proxy, self.crack.Proxy)
        copy.PlanePlacement = FreeCAD.Placement(FreeCAD.Vector(1.7, 0, 0), self.crack.PlanePlacement.Rotation)
        self.doc.recompute()
        self.assertNotIn("Invalid", copy.State)
        self.assertTrue(content(femmesh_bridge.from_femmesh(copy.FemMesh)) != original)
        self.assertTrue(content(self.recompute()) == original)

    def test_copied_with_its_source_to_another_document(self):
        original = self.recompute()
        other = FreeCAD.newDocument("FemScalpelOther")
        try:
            # With everything it depends on, in order.
            copy = other.copyObject([self.source, self.crack], True)[-1]
            other.recompute()
            self.assertEqual(copy.Source.Document, other)
            copy.touch()
            other.recompute()
            self.assertNotIn("Invalid", copy.State)
            self.assertEqual(copy.FemMesh.NodeCount, original.node_count)
        finally:
            FreeCAD.closeDocument(other.Name)

    def test_undo_of_a_change(self):
        self.doc.UndoMode = 1
        before = content(self.recompute())
        self.doc.openTransaction("Move the plane")
        self.crack.PlanePlacement = FreeCAD.Placement(FreeCAD.Vector(1.7, 0, 0), self.crack.PlanePlacement.Rotation)
        self.doc.recompute()
        self.doc.commitTransaction()
        self.doc.undo()
        self.assertTrue(content(femmesh_bridge.from_femmesh(self.crack.FemMesh)) == before)

    def test_bad_arguments(self):
        with self.assertRaisesRegex(TypeError, "source"):
            ObjectsFemScalpel.makeCrack(self.doc, None)
        with self.assertRaisesRegex(ValueError, "zero vector"):
            ObjectsFemScalpel.makeCrack(self.doc, self.source, normal=(0, 0, 0))
        with self.assertRaisesRegex(ValueError, "not both"):
            ObjectsFemScalpel.makeCrack(self.doc, self.source, placement=FreeCAD.Placement(), normal=(0, 0, 1))
        with self.assertRaises(ValueError):
            ObjectsFemScalpel.makeCrack(self.doc, self.source, method="saw")
        other = FreeCAD.newDocument("FemScalpelOther")
        try:
            with self.assertRaisesRegex(ValueError, "another document"):
                ObjectsFemScalpel.makeCrack(other, self.source)
        finally:
            FreeCAD.closeDocument(other.Name)
        self.assertEqual(len(self.doc.Objects), 2, "a refused call left an object behind")

    def test_default_plane_is_the_middle(self):
        crack = ObjectsFemScalpel.makeCrack(self.doc, self.source)
        self.assertEqual(tuple(crack.PlanePlacement.Base), (3.0, 2.5, 2.0))


class Macro(DocumentTest):
    def test_recorded_lines_work(self):
        source = self.add_source(box_with_groups())
        lines = [
            "import FreeCAD, ObjectsFemScalpel",
            f"doc = FreeCAD.getDocument('{self.doc.Name}')",
            f"crack = ObjectsFemScalpel.makeCrack(doc, doc.getObject('{source.Name}'), origin=(2.9, 0, 0), normal=(1, "
            f"0, 0))",
            "doc.recompute()",
            "FreeCAD.Console.PrintMessage('\\n'.join(crack.GroupReport))",
        ]
        exec("\n".join(lines), {})
        self.assertGreater(self.doc.Crack.FemMesh.VolumeCount, source.FemMesh.VolumeCount)
