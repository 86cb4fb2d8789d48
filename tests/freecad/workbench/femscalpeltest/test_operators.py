# SPDX-License-Identifier: LGPL-2.1-or-later
"""The document objects of the operators other than the planar crack."""

import inspect
import os
import re

import FreeCAD
import numpy as np
import Part

import femmesh_bridge
import femscalpel as fs
import ObjectsFemScalpel

from .all_elements import SOLIDS, mesh_of
from .documents import DocumentTest, content
from .meshes import box_with_groups, tetra_volumes

ORIGIN, AXIS = (3.1, 2.4, 2.1), (0, 0, 1)  # an axis that a placement keeps to the last digit


class Operators(DocumentTest):
    def setUp(self):
        super().setUp()
        self.mesh = box_with_groups()
        self.source = self.add_source(self.mesh)

    def check(self, obj, expected):
        """The object's mesh is what the engine makes (document objects keep no empty groups; lips are node groups)."""
        self.doc.recompute()
        self.assertNotIn("Invalid", obj.State)
        mesh = femmesh_bridge.from_femmesh(obj.FemMesh)
        nodes, elements, groups = content(mesh)
        expected_nodes, expected_elements, expected_groups = content(expected.mesh)
        self.assertEqual(nodes.keys(), expected_nodes.keys())
        for number, point in nodes.items():
            np.testing.assert_allclose(point, expected_nodes[number], atol=1e-12)
        self.assertEqual(elements, {i: e for i, e in expected_elements.items() if e[0] == "tetra"})
        made = {g.name for g in expected.report.groups if g.status == "new"}
        self.assertEqual(
            {k: v for k, v in groups.items() if k[0] not in made},
            {k: v for k, v in expected_groups.items() if v and k[0] not in made},
        )
        self.assertLessEqual(
            {name for name in made if expected_groups.get((name, "element"))}, {name for name, _ in groups}
        )
        self.assertEqual(obj.NodesAdded, expected.report.nodes_added)
        self.assertAlmostEqual(obj.MinimumQuality, expected.report.quality.after.minimum, places=9)
        self.assertEqual(obj.Warnings, expected.report.warnings)
        self.assertIn("LEFT", "\n".join(obj.GroupReport))
        self.assertEqual(obj.Proxy.Type, "FemScalpel::" + type(obj.Proxy).__name__)
        return mesh

    def test_cylindrical_crack(self):
        crack = ObjectsFemScalpel.makeCylindricalCrack(
            self.doc, self.source, origin=ORIGIN, axis=AXIS, radius=1.4, group_name="CYL"
        )
        mesh = self.check(crack, fs.crack(self.mesh, fs.Cylinder(ORIGIN, AXIS, 1.4), name="CYL"))
        self.assertIn("CYL_N", mesh.groups)

    def test_oblique_axis(self):
        axis = (0.1, 0.2, 1)
        crack = ObjectsFemScalpel.makeCylindricalCrack(self.doc, self.source, origin=ORIGIN, axis=axis, radius=1.4)
        self.doc.recompute()
        mesh = femmesh_bridge.from_femmesh(crack.FemMesh)
        lip = mesh.points[np.isin(mesh.node_ids, mesh.groups["CRACK_P"].ids)]
        self.assertGreater(len(lip), 10)
        self.assertLess(np.abs(fs.Cylinder(ORIGIN, axis, 1.4).distance(lip)).max(), 1e-9)

    def test_curved_cracks(self):
        for tool, expected, options in (
            ("Cylinder", fs.Cylinder(ORIGIN, AXIS, 1.3), {"radius": 1.3}),
            ("Sphere", fs.Sphere(ORIGIN, 1.5), {"radius": 1.5}),
            ("Torus", fs.Torus(ORIGIN, AXIS, 1.4, 0.9), {"radius": 1.4, "tube_radius": 0.9}),
            ("Cone", fs.Cone(ORIGIN, AXIS, 3, 20), {"radius": 3, "half_angle": 20}),
        ):
            with self.subTest(tool=tool):
                crack = ObjectsFemScalpel.makeCurvedCrack(
                    self.doc, self.source, tool=tool, origin=ORIGIN, axis=AXIS, **options
                )
                self.check(crack, fs.crack(self.mesh, expected))
                self.doc.removeObject(crack.Name)

    def test_crack_along_a_face(self):
        part = self.doc.addObject("Part::Feature", "Blade")
        part.Shape = Part.makeCylinder(9, 12, FreeCAD.Vector(3.2, -7, -3), FreeCAD.Vector(0, 0, 1))
        expected = fs.crack(self.mesh, fs.Face(part.Shape.Faces[0]))
        crack = ObjectsFemScalpel.makeCurvedCrack(self.doc, self.source, tool="Face", face=(part, "Face1"))
        mesh = self.check(crack, expected)
        lip = mesh.points[np.isin(mesh.node_ids, mesh.groups["CRACK_P"].ids)]
        self.assertLess(np.abs(np.hypot(lip[:, 0] - 3.2, lip[:, 1] + 7) - 9).max(), 1e-6)
        part.Placement = FreeCAD.Placement(FreeCAD.Vector(0, 0.4, 0), FreeCAD.Rotation())
        self.doc.recompute()
        mesh = femmesh_bridge.from_femmesh(crack.FemMesh)
        lip = mesh.points[np.isin(mesh.node_ids, mesh.groups["CRACK_P"].ids)]
        self.assertLess(np.abs(np.hypot(lip[:, 0] - 3.2, lip[:, 1] + 6.6) - 9).max(), 1e-6)
        crack.ToolFace = None
        self.doc.recompute()
        self.assertIn("ToolFace is not set", crack.getStatusString())

    def test_crack_along_faces_of_a_group(self):
        cells = self.mesh.cells["tetra"]
        sides = [cells[np.isin(self.mesh.cell_ids["tetra"], self.mesh.groups[g].ids)] for g in ("LEFT", "RIGHT")]
        self.mesh.add_group("SECTION", "node", self.mesh.node_ids[np.intersect1d(*sides)])
        source = self.add_source(self.mesh)
        with self.assertRaisesRegex(TypeError, "group"):
            ObjectsFemScalpel.makeFaceCrack(self.doc, source)
        crack = ObjectsFemScalpel.makeFaceCrack(self.doc, source, "SECTION", group_name="F")
        expected = fs.crack(self.mesh, fs.Faces("SECTION"), name="F")
        self.assertGreater(expected.report.nodes_doubled, 20)
        self.check(crack, expected)
        for group, text in (("LEFT", "has tetra elements"), ("", "Group is not set"), ("NONE", "no group 'NONE'")):
            crack.Group = group
            self.doc.recompute()
            self.assertIn(text, crack.getStatusString())

    def test_crack_along_faces_between_elements_of_all_types(self):
        for kind in (*SOLIDS, "triangle", "quad", "quad8"):
            with self.subTest(kind=kind):
                mesh = mesh_of(kind)
                crack = ObjectsFemScalpel.makeFaceCrack(self.doc, self.add_source(mesh), "SECTION")
                self.doc.recompute()
                expected = fs.crack(mesh, fs.Faces("SECTION"))
                made = femmesh_bridge.from_femmesh(crack.FemMesh)
                self.assertEqual(made.node_count, expected.mesh.node_count)
                np.testing.assert_array_equal(made.cells[kind], expected.mesh.cells[kind])
                self.assertEqual(crack.NodesDoubled, expected.report.nodes_doubled)

    def test_refinement_first(self):
        for refine in (None, False, 0.4):
            with self.subTest(refine=refine):
                crack = ObjectsFemScalpel.makeCurvedCrack(
                    self.doc, self.source, origin=ORIGIN, radius=1.3, refine=refine
                )
                expected = fs.crack(self.mesh, fs.Sphere(ORIGIN, 1.3), refine=refine)
                self.check(crack, expected)
                self.assertEqual(crack.RefinedTo.Value, expected.report.refinement.size if refine is not False else 0)
                self.assertEqual(any("refined" in line for line in crack.GroupReport), refine is not False)
        crack.Refine = "Never"
        self.check(crack, fs.crack(self.mesh, fs.Sphere(ORIGIN, 1.3), refine=False))
        with self.assertRaisesRegex(ValueError, "refine must be None, False or a positive length"):
            ObjectsFemScalpel.makeDrill(self.doc, self.source, refine=-1)

    def test_refine(self):
        for tool, expected in (
            ("Plane", fs.Plane(ORIGIN, AXIS)),
            ("Cylinder", fs.Cylinder(ORIGIN, AXIS, 0.5)),
            ("Sphere", fs.Sphere(ORIGIN, 0.5)),
        ):
            with self.subTest(tool=tool):
                refined = ObjectsFemScalpel.makeRefine(
                    self.doc,
                    self.source,
                    tool=tool,
                    origin=ORIGIN,
                    axis=AXIS,
                    radius=0.5,
                    size=0.6,
                    reach=0.1,
                    gradation=0.7,
                )
                mesh = self.check(refined, fs.refine(self.mesh, expected, 0.6, gradation=0.7, reach=0.1))
                self.assertAlmostEqual(tetra_volumes(mesh.points, mesh.cells["tetra"]).sum(), 120, places=7)
                self.assertGreater(mesh.cell_count, self.mesh.cell_count)
                self.doc.removeObject(refined.Name)

    def test_drill(self):
        hole = fs.Cylinder(ORIGIN, AXIS, 0.9)
        drill = ObjectsFemScalpel.makeDrill(self.doc, self.source, origin=ORIGIN, axis=AXIS, radius=0.9)
        mesh = self.check(drill, fs.drill(self.mesh, hole))
        self.assertLess(tetra_volumes(mesh.points, mesh.cells["tetra"]).sum(), 120)
        self.assertAlmostEqual(drill.HoleRadius.Value, 0.9, places=9)
        self.assertAlmostEqual(drill.WallArea.Value, 2 * np.pi * 0.9 * 4, delta=1)
        (line,) = (line for line in drill.GroupReport if line.startswith("  hole"))
        self.assertIn("radius 0.9; nodes of the wall at most", line)
        drill.Through, drill.Depth = False, 0.5
        mesh = self.check(drill, fs.drill(self.mesh, hole, depth=0.5))
        self.assertIn("HOLE_BOTTOM", mesh.groups)
        drill.Through = True
        self.check(drill, fs.drill(self.mesh, hole))

    def test_several_holes(self):
        placement = FreeCAD.Placement(FreeCAD.Vector(3, 2.5, 2), FreeCAD.Rotation(30, 0, 0))
        positions = [(1.6, 0, 0), (-1.6, 0, 0)]
        tools = [fs.Cylinder(placement.multVec(FreeCAD.Vector(*p)), (0, 0, 1), 0.9) for p in positions]
        fine = fs.refine(self.mesh, tools, 0.7).mesh
        drill = ObjectsFemScalpel.makeDrill(
            self.doc, self.add_source(fine), placement=placement, radius=0.9, positions=positions, group_name="BOLT"
        )
        mesh = self.check(drill, fs.drill(fine, tools, name="BOLT"))
        self.assertLessEqual({"BOLT_WALL", "BOLT_WALL1", "BOLT_WALL2"}, set(mesh.groups))

    def test_cut(self):
        plane = fs.Plane((3.1, 2.5, 2), (1, 0, 0))
        cut = ObjectsFemScalpel.makeCut(self.doc, self.source, origin=(3.1, 2.5, 2), normal=(1, 0, 0), width=1.5)
        mesh = self.check(cut, fs.cut(self.mesh, plane, width=1.5))
        self.assertAlmostEqual(tetra_volumes(mesh.points, mesh.cells["tetra"]).sum(), 120 - 1.5 * 5 * 4, places=7)
        cut.Through = False
        cut.BottomPlacement = FreeCAD.Placement(FreeCAD.Vector(0, 0, 2), FreeCAD.Rotation(FreeCAD.Vector(1, 0, 0), 180))
        mesh = self.check(cut, fs.cut(self.mesh, plane, width=1.5, bottom=fs.Plane((0, 0, 2), (0, 0, -1))))
        self.assertAlmostEqual(tetra_volumes(mesh.points, mesh.cells["tetra"]).sum(), 120 - 1.5 * 5 * 2, places=7)
        self.assertIn("CUT_BOTTOM", mesh.groups)

    def test_chain_in_order_through_a_file(self):
        refined = ObjectsFemScalpel.makeRefine(self.doc, self.source, origin=ORIGIN, axis=AXIS, radius=0.8, size=0.7)
        drill = ObjectsFemScalpel.makeDrill(self.doc, refined, origin=ORIGIN, axis=AXIS, radius=0.8)
        crack = ObjectsFemScalpel.makeCrack(self.doc, drill, origin=(3, 2.5, 2), normal=(1, 0.1, 0))
        self.doc.recompute()
        names = {crack.FemMesh.getGroupName(g) for g in crack.FemMesh.Groups}
        self.assertLessEqual({"HOLE_WALL", "CRACK_P", "CRACK_N", "LEFT"}, names)
        count = crack.FemMesh.NodeCount
        path = os.path.join(self.folder.name, "saved.FCStd")
        self.doc.saveAs(path)
        FreeCAD.closeDocument(self.doc.Name)
        self.doc = FreeCAD.openDocument(path)
        self.doc.Refine.touch()
        self.doc.recompute()
        self.assertEqual(
            [o.Proxy.Type for o in (self.doc.Refine, self.doc.Drill, self.doc.Crack)],
            ["FemScalpel::Refine", "FemScalpel::Drill", "FemScalpel::Crack"],
        )
        self.assertEqual(self.doc.Crack.FemMesh.NodeCount, count)
        self.doc.Drill.Radius = 0.6
        self.doc.recompute()
        self.assertGreater(self.doc.Crack.FemMesh.NodeCount, count - 100)
        self.assertNotEqual(self.doc.Crack.FemMesh.NodeCount, count)
        self.doc.Refine.Size = 0
        self.doc.recompute()
        self.assertEqual([o.FemMesh.NodeCount for o in (self.doc.Refine, self.doc.Drill, self.doc.Crack)], [0, 0, 0])

    def test_signatures(self):
        """Positions of arguments stay what they were; what is new comes last."""
        common = "method=snap transition=0 group_name={} feature_angle=30.0 preserve=None"
        curved = "placement=None origin=None axis=None radius=1.0 tube_radius=0.25 half_angle=30.0"
        for make, group, text in (
            (
                "makeCrack",
                "CRACK",
                f"name=Crack placement=None origin=None normal=None {common} patch=Whole patch_radius=1.0 "
                "patch_second_radius=0.5 patch_corners=() refine=None",
            ),
            (
                "makeCylindricalCrack",
                "CRACK",
                f"name=CylindricalCrack placement=None origin=None axis=None radius=1.0 {common} along=None "
                "angles=(0,360) refine=None",
            ),
            ("makeCurvedCrack", "CRACK", f"name=CurvedCrack tool=Sphere {curved} {common} face=None refine=None"),
            ("makeFaceCrack", "CRACK", "group name=FaceCrack group_name={}"),
            (
                "makeDrill",
                "HOLE",
                f"name=Drill placement=None origin=None axis=None radius=1.0 depth=None positions=() {common} "
                "refine=None",
            ),
            (
                "makeCut",
                "CUT",
                "name=Cut placement=None origin=None normal=None width=1.0 bottom=None "
                f"{common[len('method=snap '):]} refine=None",
            ),
            (
                "makeRefine",
                "",
                f"name=Refine tool=Cylinder {curved} size=1.0 reach=0.0 gradation=0.5 feature_angle=30.0 face=None",
            ),
            (
                "makeMerge",
                "ADD",
                "addition name=Merge keep=mesh tolerance=0.0 prefix= join_groups=True group_name={} feature_angle=30.0",
            ),
            ("makeFillet", "FILLET", f"along radius=1.0 name=Fillet {common} refine=None"),
            (
                "makeReshape",
                "SHAPE",
                "group onto=None by=None scale=None name=Reshape placement=None origin=None axis=None radius=1.0 "
                "tube_radius=0.25 half_angle=30.0 group_name={} feature_angle=30.0 preserve=None face=None",
            ),
        ):
            with self.subTest(make=make):
                function = getattr(ObjectsFemScalpel, make)
                parameters = inspect.signature(function).parameters.values()
                found = [str(p).replace("'", "").replace(" ", "") for p in parameters]
                expected = ["doc", "source", *text.format(group).split()]
                self.assertEqual(found[: len(expected)], expected)
                self.assertTrue(all(p.kind == p.POSITIONAL_OR_KEYWORD for p in parameters))
                section = function.__doc__.split("\n----------\n")[1].split("\n\n")[0]
                named = re.findall(r"^(\w+(?:, \w+)*)(?: :|$)", section, re.M)
                self.assertEqual(set(", ".join(named).split(", ")), {p.name for p in parameters})
        with self.assertRaisesRegex(TypeError, r"makeDrill\(\) got an unexpected keyword argument 'size'"):
            ObjectsFemScalpel.makeDrill(self.doc, self.source, size=1)

    def test_options_are_properties(self):
        options = dict(transition=3, group_name="X", feature_angle=25, preserve=["LEFT"], refine=0.4)
        for make in ("makeCrack", "makeCylindricalCrack", "makeCurvedCrack", "makeDrill", "makeCut"):
            for given in ({}, options):
                with self.subTest(make=make, given=given):
                    obj = getattr(ObjectsFemScalpel, make)(self.doc, self.source, **given)
                    found = (obj.Method, obj.Transition, obj.FeatureAngle.Value, obj.PreservedGroups, obj.Refine)
                    expected = ("snap", 3, 25, ["LEFT"], "Size") if given else ("snap", 0, 30, ["*"], "Automatic")
                    self.assertEqual(found, expected)
                    self.assertEqual(obj.RefineSize.Value, 0.4 if given else 1)
                    self.assertEqual(obj.GroupName == "X", bool(given))
        self.assertEqual(obj.getEnumerationsOfProperty("Method"), ["snap"])  # of a cut

    def test_properties_of_tools(self):
        """Names that documents have, whatever the table says."""
        crack = ObjectsFemScalpel.makeCurvedCrack(self.doc, self.source)
        refined = ObjectsFemScalpel.makeRefine(self.doc, self.source)
        for obj, shapes, shape in (
            (crack, [name for name in fs.tools.TOOLS if name != "Plane"], "Sphere"),
            (refined, list(fs.tools.TOOLS), "Cylinder"),
        ):
            self.assertEqual((obj.getEnumerationsOfProperty("ToolShape"), obj.ToolShape), (shapes, shape))
            self.assertEqual((obj.Radius.Value, obj.TubeRadius.Value, obj.HalfAngle.Value), (1, 0.25, 30))
            types = [obj.getTypeIdOfProperty(n) for n in ("Radius", "TubeRadius", "HalfAngle", "ToolFace")]
            self.assertEqual(
                types, ["App::PropertyLength", "App::PropertyLength", "App::PropertyAngle", "App::PropertyLinkSub"]
            )

    def test_bad_arguments(self):
        objects = self.doc.Objects
        for make in ("makeCylindricalCrack", "makeCurvedCrack", "makeDrill", "makeRefine"):
            function = getattr(ObjectsFemScalpel, make)
            with self.subTest(make=make):
                with self.assertRaisesRegex(TypeError, "source"):
                    function(self.doc, None)
                with self.assertRaisesRegex(ValueError, "axis is the zero vector"):
                    function(self.doc, self.source, axis=(0, 0, 0))
                with self.assertRaisesRegex(ValueError, "origin and axis, not both"):
                    function(self.doc, self.source, placement=FreeCAD.Placement(), axis=(0, 0, 1))
        with self.assertRaisesRegex(ValueError, "normal is the zero vector"):
            ObjectsFemScalpel.makeCut(self.doc, self.source, normal=(0, 0, 0))
        with self.assertRaises(ValueError):
            ObjectsFemScalpel.makeCurvedCrack(self.doc, self.source, tool="Saw")
        self.assertEqual(self.doc.Objects, objects, "a refused call left an object behind")

    def test_impossible_tools_are_told(self):
        for obj, message in (
            (ObjectsFemScalpel.makeDrill(self.doc, self.source, radius=0), "radius"),
            (ObjectsFemScalpel.makeDrill(self.doc, self.source, radius=50), "all|everything|whole"),
            (ObjectsFemScalpel.makeCurvedCrack(self.doc, self.source, tool="Torus", radius=1, tube_radius=2), "radius"),
            (ObjectsFemScalpel.makeCurvedCrack(self.doc, self.source, tool="Sphere", origin=(99, 0, 0)), "misses"),
            (ObjectsFemScalpel.makeRefine(self.doc, self.source, size=0), "size"),
        ):
            with self.subTest(message=message):
                self.doc.recompute()
                self.assertIn("Invalid", obj.State)
                self.assertEqual(obj.FemMesh.NodeCount, 0)
                self.assertRegex(obj.getStatusString(), message)
