# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tests inside FreeCAD without a window:
freecadcmd -t TestFemScalpelApp -M build/release/Mod/FemScalpel -P tests/freecad -P tests/python
"""

import os
import re
import tempfile
import unittest

import FreeCAD
import Fem
import numpy as np
import ObjectsFem

import femmesh_bridge
import femscalpel as fs
import ObjectsFemScalpel
from meshes import box_with_groups, grid_box, quadratic, tetra_volumes

EDGES = {
    "tetra": ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)),
    "pyramid": ((0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)),
    "wedge": ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)),
    "hexahedron": ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)),
    "line": ((0, 1),),
    "triangle": ((0, 1), (1, 2), (2, 0)),
    "quad": ((0, 1), (1, 2), (2, 3), (3, 0)),
}
CORNERS = {
    "tetra": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    "pyramid": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.4, 0.4, 1]],
    "wedge": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]],
    "hexahedron": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]],
    "line": [[0, 0, 0], [1, 0, 0]],
    "triangle": [[0, 0, 0], [1, 0, 0], [0, 1, 0]],
    "quad": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]],
}
QUADRATIC = {"tetra": "tetra10", "pyramid": "pyramid13", "wedge": "wedge15", "hexahedron": "hexahedron20",
             "line": "line3", "triangle": "triangle6", "quad": "quad8"}


def one_element(shape, order):
    """A mesh of one element with mid-side nodes, if of order 2, in the middle of its edges."""
    corners = np.array(CORNERS[shape], float)
    if order == 1:
        return fs.Mesh(corners, {shape: [range(len(corners))]})
    points = np.concatenate([corners, [corners[[i, j]].mean(axis=0) for i, j in EDGES[shape]]])
    return fs.Mesh(points, {QUADRATIC[shape]: [range(len(points))]})


def all_types():
    """One mesh with an element of every type a FemMesh can hold, apart from each other, with sparse numbers."""
    points, cells, ids, first = [], {}, {}, 0
    for number, (shape, order) in enumerate((s, o) for s in CORNERS for o in (1, 2)):
        mesh = one_element(shape, order)
        (name, nodes), = mesh.cells.items()
        points.append(mesh.points + [3.0 * number, 0.1, 1 / 3])
        cells[name], ids[name] = nodes + first, [1000 - 7 * number]
        first += mesh.node_count
    points = np.concatenate(points)
    return fs.Mesh(points, cells, 5 * np.arange(len(points), 0, -1), ids)


def groups_of(femmesh):
    return [(femmesh.getGroupName(g), femmesh.getGroupElementType(g), tuple(femmesh.getGroupElements(g)))
            for g in femmesh.Groups]


def content(mesh):
    """Everything of a mesh, by number."""
    nodes = dict(zip(mesh.node_ids.tolist(), map(tuple, mesh.points.tolist())))
    elements = {i: (name, tuple(row)) for name, ids in mesh.cell_ids.items()
                for i, row in zip(ids.tolist(), mesh.node_ids[mesh.cells[name]].tolist())}
    groups = {(g.name, g.kind): frozenset(map(tuple, g.ids.tolist()) if g.kind == "facet" else g.ids.tolist())
              for g in mesh.groups.all()}
    return nodes, elements, groups


class Bridge(unittest.TestCase):
    def test_all_types_there_and_back(self):
        mesh = all_types()
        femmesh = femmesh_bridge.to_femmesh(mesh)
        self.assertEqual((femmesh.EdgeCount, femmesh.FaceCount, femmesh.VolumeCount), (2, 4, 8))
        self.assertEqual((femmesh.TetraCount, femmesh.PyramidCount, femmesh.PrismCount, femmesh.HexaCount), (2, 2, 2, 2))
        self.assertEqual(content(femmesh_bridge.from_femmesh(femmesh)), content(mesh))

    def test_node_order_is_what_freecad_writes_for_calculix(self):
        for shape in ("tetra", "wedge", "hexahedron", "triangle", "quad", "line"):
            for order in (1, 2):
                with self.subTest(shape=shape, order=order), tempfile.TemporaryDirectory() as folder:
                    mesh = one_element(shape, order)
                    path = os.path.join(folder, "one.inp")
                    femmesh_bridge.to_femmesh(mesh).writeABAQUS(path, 1, False)
                    with open(path) as file:
                        rows = re.search(r"\*Element,.*?\n(.*?)\n\s*\*", file.read() + "\n*", re.S | re.I)[1]
                    nodes = [int(n) for n in rows.replace("\n", " ").split(",") if n.strip()][1:]
                    points = mesh.points[np.array(nodes) - 1]
                    # CalculiX: corners turn the positive way round; mid-side nodes in the order of our edges.
                    # Lines of three nodes are the exception, they run along the line.
                    if shape == "line":
                        self.assertEqual(nodes, [1, 2] if order == 1 else [1, 3, 2])
                        continue
                    corners = len(CORNERS[shape])
                    base = 2 if shape in ("tetra", "wedge", "triangle") else 3
                    if shape not in ("triangle", "quad"):
                        up = points[base + 1] - points[0]
                        self.assertGreater(np.linalg.det([points[1] - points[0], points[base] - points[0], up]), 0)
                    else:
                        self.assertGreater(np.cross(points[1] - points[0], points[base] - points[0])[2], 0)
                    if order == 2:
                        for k, (i, j) in enumerate(EDGES[shape]):
                            np.testing.assert_allclose(points[corners + k], (points[i] + points[j]) / 2)

    def test_pyramid_in_smesh_order(self):
        # SMESH: base turned the other way round, then the top; mid-side nodes along base edges, then from the base up.
        femmesh = femmesh_bridge.to_femmesh(one_element("pyramid", 2))
        nodes = femmesh.getElementNodes(1)
        points = np.array([tuple(femmesh.Nodes[n]) for n in nodes])
        self.assertLess(np.linalg.det([points[1] - points[0], points[3] - points[0], points[4] - points[0]]), 0)
        for k, (i, j) in enumerate(EDGES["pyramid"]):
            np.testing.assert_allclose(points[5 + k], (points[i] + points[j]) / 2)

    def test_meshes_of_freecads_examples_have_positive_volumes(self):
        from femexamples.meshes import mesh_canticcx_tetra10
        femmesh = Fem.FemMesh()
        mesh_canticcx_tetra10.create_nodes(femmesh)
        mesh_canticcx_tetra10.create_elements(femmesh)
        mesh = femmesh_bridge.from_femmesh(femmesh)
        volumes = tetra_volumes(mesh.points, mesh.cells["tetra10"])
        self.assertGreater(volumes.min(), 0)
        self.assertAlmostEqual(volumes.sum(), 8e9, delta=1)
        for k, (i, j) in enumerate(EDGES["tetra"]):
            nodes = mesh.cells["tetra10"]
            middle = (mesh.points[nodes[:, i]] + mesh.points[nodes[:, j]]) / 2
            np.testing.assert_allclose(mesh.points[nodes[:, 4 + k]], middle, atol=1.0)

    def test_groups_there_and_back(self):
        mesh = all_types()
        tetra, line = mesh.cell_ids["tetra"], mesh.cell_ids["line"]
        mesh.add_group("nodes é", "node", mesh.node_ids[:3])
        mesh.add_group("solid", "element", tetra)
        mesh.add_group("solid", "node", mesh.node_ids[5:9])
        mesh.add_group("mixed", "element", np.concatenate([tetra, line, mesh.cell_ids["quad8"]]))
        mesh.add_group("none", "element")
        mesh.add_group("nobody", "node")
        femmesh = femmesh_bridge.to_femmesh(mesh)
        self.assertEqual(sorted(t for n, t, _ in groups_of(femmesh) if n == "mixed"), ["Edge", "Face", "Volume"])
        self.assertIn(("none", "All", ()), groups_of(femmesh))
        self.assertIn(("nobody", "Node", ()), groups_of(femmesh))
        self.assertEqual(content(femmesh_bridge.from_femmesh(femmesh)), content(mesh))

    def test_repeated_names_are_kept_apart(self):
        femmesh = femmesh_bridge.to_femmesh(one_element("tetra", 1))
        for nodes in ([1], [2, 3], [4]):
            femmesh.addGroupElements(femmesh.addGroup("twice", "Node"), nodes)
        mesh = femmesh_bridge.from_femmesh(femmesh)
        self.assertEqual([(g.name, g.ids.tolist()) for g in mesh.groups.all()],
                         [("twice", [1]), ("twice_2", [2, 3]), ("twice_3", [4])])

    def test_elements_turned_into_a_node_group(self):
        mesh = fs.Mesh(CORNERS["tetra"], {"tetra": [[0, 1, 2, 3]], "triangle": [[0, 2, 1]]},
                       groups={"LIP": ("element", [2]), "BODY": ("element", [1])})
        femmesh = femmesh_bridge.to_femmesh(mesh, as_node_groups=("LIP",))
        self.assertEqual((femmesh.VolumeCount, femmesh.FaceCount), (1, 0))
        self.assertEqual(groups_of(femmesh), [("LIP", "Node", (1, 2, 3)), ("BODY", "Volume", (1,))])

    def test_what_a_femmesh_cannot_hold(self):
        points = np.arange(81.0).reshape(27, 3)
        with self.assertRaisesRegex(fs.WriteError, "hexahedron27"):
            femmesh_bridge.to_femmesh(fs.Mesh(points, {"hexahedron27": [range(27)]}))
        with self.assertRaisesRegex(fs.WriteError, "element number"):
            femmesh_bridge.to_femmesh(fs.Mesh(points, {"line": [[0, 1]]}, cell_ids={"line": [2**31]}))
        with self.assertRaisesRegex(fs.WriteError, "node number"):
            femmesh_bridge.to_femmesh(fs.Mesh(points[:1], {}, [2**31]))
        mesh = fs.Mesh(points[:4], {"tetra": [range(4)], "vertex": [[0]]},
                       groups={"SIDE": ("facet", [[1, 1]]), "MASS": ("element", [2])})
        femmesh = femmesh_bridge.to_femmesh(mesh)
        self.assertEqual(femmesh.VolumeCount, 1)
        self.assertEqual(groups_of(femmesh), [("MASS", "All", ())])

    def test_empty(self):
        self.assertEqual(femmesh_bridge.to_femmesh(fs.Mesh([], {})).NodeCount, 0)
        self.assertEqual(femmesh_bridge.from_femmesh(Fem.FemMesh()).node_count, 0)


class DocumentTest(unittest.TestCase):
    def setUp(self):
        self.doc = FreeCAD.newDocument("FemScalpelTest")
        self.folder = tempfile.TemporaryDirectory()

    def tearDown(self):
        FreeCAD.closeDocument(self.doc.Name)
        self.folder.cleanup()

    def add_source(self, mesh):
        source = self.doc.addObject("Fem::FemMeshObject", "Source")
        source.FemMesh = femmesh_bridge.to_femmesh(mesh)
        return source


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
        self.assertEqual({k: v for k, v in groups.items() if not k[0].startswith("CRACK_")},
                         {k: v for k, v in expected_groups.items() if v and not k[0].startswith("CRACK_")})
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

    def test_follows_its_source(self):
        self.recompute()
        count = self.crack.FemMesh.NodeCount
        self.source.FemMesh = femmesh_bridge.to_femmesh(grid_box((9, 8, 7)))
        self.assertGreater(self.recompute().node_count, count)
        self.assertNotIn("LEFT", self.recompute().groups)

    def test_plane_is_where_the_user_sees_it(self):
        turned = FreeCAD.Placement(FreeCAD.Vector(100, 0, 0), FreeCAD.Rotation(FreeCAD.Vector(0, 0, 1), 90))
        self.source.Placement = turned
        self.crack.PlanePlacement = FreeCAD.Placement(turned.multVec(FreeCAD.Vector(3.3, 2.5, 2)),
                                                      turned.Rotation * self.crack.PlanePlacement.Rotation)
        mesh = self.recompute()
        self.assertTrue(self.crack.Placement.isIdentity())
        np.testing.assert_allclose(mesh.points.min(axis=0), [95, 0, 0], atol=1e-9)
        np.testing.assert_allclose(mesh.points.max(axis=0), [100, 6, 4], atol=1e-9)
        origin, normal = self.crack.PlanePlacement.Base, self.crack.PlanePlacement.Rotation.multVec(FreeCAD.Vector(0, 0, 1))
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
        second = ObjectsFemScalpel.makeCrack(self.doc, self.crack, "Second", origin=(3, 2.5, 2), normal=(0, 0.2, 1),
                                             group_name="SECOND")
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
        self.source.FemMesh = femmesh_bridge.to_femmesh(fs.Mesh(mesh.points, {"tetra": cells, "triangle": skin[count == 1]}))
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
        shown = {name: getattr(self.crack, name) for name in ("NodesAdded", "GroupReport", "ConstraintCounts", "GroupName")}
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


class Analysis(DocumentTest):
    """FreeCAD's cantilever example: a box 8000 x 1000 x 1000 of quadratic tetrahedra, here held at both ends and
    loaded on its top. A crack through the middle leaves two cantilevers."""

    LOAD = 9.0e6

    def setUp(self):
        super().setUp()
        from femexamples import ccx_cantilever_base_solid
        ccx_cantilever_base_solid.setup_cantilever_base_solid(self.doc, "ccxtools")
        self.analysis, self.source, self.box = self.doc.Analysis, self.doc.Mesh, self.doc.Box
        self.doc.ConstraintFixed.References = [(self.box, ("Face1", "Face2"))]
        force = ObjectsFem.makeConstraintForce(self.doc, "Load")
        force.References = [(self.box, "Face6")]
        force.Force = self.LOAD
        force.Direction = (self.box, ["Edge1"])
        self.analysis.addObject(force)
        self.doc.recompute()
        self.crack = ObjectsFemScalpel.makeCrack(self.doc, self.source, origin=(4100, 500, 500), normal=(1, 0.1, 0.05))
        self.doc.recompute()

    def tools(self):
        from femtools import ccxtools
        tools = ccxtools.FemToolsCcx(self.analysis, self.doc.CalculiXccxTools)
        tools.update_objects()
        tools.setup_working_dir(self.folder.name)
        tools.setup_ccx()
        self.assertEqual(tools.check_prerequisites(), "")
        return tools

    def write(self):
        """The deck FreeCAD writes for CalculiX."""
        tools = self.tools()
        tools.write_inp_file()
        with open(tools.inp_file_name) as deck:
            return deck.read()

    def solve(self):
        """Runs CalculiX as FreeCAD does; returns the deck and the printed results as text."""
        tools = self.tools()
        tools.purge_results()
        tools.write_inp_file()
        self.assertEqual(tools.ccx_run(), 0)
        tools.load_results()
        with open(tools.inp_file_name) as deck, open(os.path.splitext(tools.inp_file_name)[0] + ".dat") as printed:
            return deck.read(), printed.read()

    def largest_displacement(self):
        results = [o for o in self.analysis.Group if o.isDerivedFrom("Fem::FemResultObject")]
        self.assertEqual(len(results), 1)
        return max(results[0].DisplacementLengths)

    def fixed(self, deck):
        """Numbers of the nodes of the support."""
        block = re.search(r"\*NSET,NSET=ConstraintFixed\n((?:\s*\d+,\n)+)", deck)[1]
        return sorted(int(n) for n in re.findall(r"\d+", block))

    def loads(self, deck, without=()):
        """Sum of the nodal loads by direction, `without` some nodes."""
        total = np.zeros(3)
        for line in re.search(r"^\*CLOAD\n(.*?)^\*(?!\*)", deck, re.M | re.S)[1].splitlines():
            if re.match(r"\d", line):
                node, direction, value = line.split(",")
                if int(node) not in without:
                    total[int(direction) - 1] += float(value)
        return total

    def reactions(self, printed):
        """Sum over the printed totals of the supports' reaction forces."""
        rows = re.findall(r"total force \(fx,fy,fz\).*?\n\s*\n\s*(\S+)\s+(\S+)\s+(\S+)", printed)
        self.assertTrue(rows, printed)
        return np.sum([[float(v) for v in row] for row in rows], axis=0)

    def test_takes_the_place_of_its_source(self):
        from femtools.membertools import get_mesh_to_solve
        self.assertEqual(get_mesh_to_solve(self.analysis)[0], self.source)
        self.assertEqual(ObjectsFemScalpel.putIntoAnalysis(self.crack), self.analysis)
        self.assertEqual(get_mesh_to_solve(self.analysis)[0], self.crack)
        self.assertNotIn(self.source, self.analysis.Group)
        self.assertEqual(self.crack.Part, self.box)
        with self.assertRaises(ValueError):
            ObjectsFemScalpel.putIntoAnalysis(self.crack)
        self.assertEqual(ObjectsFemScalpel.takeOutOfAnalysis(self.crack), self.analysis)
        self.assertEqual(get_mesh_to_solve(self.analysis)[0], self.source)
        with self.assertRaises(ValueError):
            ObjectsFemScalpel.takeOutOfAnalysis(self.crack)

    def test_solved_before_and_after(self):
        deck, printed = self.solve()
        fixed, whole = self.fixed(deck), self.largest_displacement()
        load = self.loads(deck)
        # CalculiX does not print what is loaded straight onto a support.
        carried = self.loads(deck, without=fixed)
        self.assertAlmostEqual(np.linalg.norm(load), self.LOAD, delta=1e-6 * self.LOAD)
        np.testing.assert_allclose(self.reactions(printed), -carried, atol=1e-4 * self.LOAD)

        ObjectsFemScalpel.putIntoAnalysis(self.crack)
        deck, printed = self.solve()
        self.assertEqual(self.fixed(deck), fixed)
        np.testing.assert_allclose(self.loads(deck), load, atol=1e-6 * self.LOAD)
        np.testing.assert_allclose(self.reactions(printed), -carried, atol=1e-4 * self.LOAD)
        # Held at both ends: 1/384; a cantilever of half the length: 1/128. Shear and the coarse mesh take their part.
        self.assertGreater(self.largest_displacement(), 1.5 * whole)

    def test_freecads_groups_of_constraints_are_used(self):
        femmesh = self.source.FemMesh.copy()
        fixed = sorted(n for n, p in femmesh.Nodes.items() if p.x == 0)  # less than what the constraint refers to
        femmesh.addGroupElements(femmesh.addGroup("ConstraintFixed_Nodes", "Node"), fixed)
        self.source.FemMesh = femmesh
        self.doc.recompute()
        ObjectsFemScalpel.putIntoAnalysis(self.crack)
        deck = self.write()
        self.assertEqual(self.fixed(deck), fixed)


class Macro(DocumentTest):
    def test_recorded_lines_work(self):
        source = self.add_source(box_with_groups())
        lines = [
            "import FreeCAD, ObjectsFemScalpel",
            f"doc = FreeCAD.getDocument('{self.doc.Name}')",
            f"crack = ObjectsFemScalpel.makeCrack(doc, doc.getObject('{source.Name}'), origin=(2.9, 0, 0), normal=(1, 0, 0))",
            "doc.recompute()",
            "FreeCAD.Console.PrintMessage('\\n'.join(crack.GroupReport))",
        ]
        exec("\n".join(lines), {})
        self.assertGreater(self.doc.Crack.FemMesh.VolumeCount, source.FemMesh.VolumeCount)
