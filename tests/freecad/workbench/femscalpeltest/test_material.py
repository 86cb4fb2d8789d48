# SPDX-License-Identifier: LGPL-2.1-or-later
"""The document objects that add material, round edges and move walls."""

import os

import FreeCAD
import numpy as np
import ObjectsFem
import Part

import femmesh_bridge
import femscalpel as fs
import ObjectsFemScalpel
from femscalpelobjects.on_shape import without_bookkeeping

from .documents import DocumentTest, content, geometry_link, need
from .meshes import box_with_groups, grid_box, tetra_volumes


def volume(mesh):
    return sum(
        tetra_volumes(mesh.points, cells[:, :4]).sum() for name, cells in mesh.cells.items() if name.startswith("tetra")
    )


def boss(shift=(0, 0, 0), **groups):
    plain = grid_box((2, 2, 2), (2.0, 2.0, 2.0))
    ids = plain.cell_ids["tetra"]
    groups = {"PAD": ("element", ids), "RIGHT": ("element", ids[:7]), "FIX": ("node", plain.node_ids[:3]), **groups}
    return fs.Mesh(plain.points + shift, plain.cells, groups=groups)


def place(x, y, z, turn=0):
    return FreeCAD.Placement(FreeCAD.Vector(x, y, z), FreeCAD.Rotation(FreeCAD.Vector(0, 0, 1), turn))


def points_of(mesh, group):
    """Where the nodes of a node group are."""
    return mesh.points[np.isin(mesh.node_ids, mesh.groups[group].ids)]


def block_shape(doc):
    """The shape of the box that the meshes are of."""
    part = doc.addObject("Part::Box", "Block")
    part.Length, part.Width, part.Height = 6, 5, 4
    doc.recompute()
    return part


class MaterialTest(DocumentTest):
    def setUp(self):
        super().setUp()
        self.mesh = box_with_groups()
        self.source = self.add_source(self.mesh)

    def add_mesh(self, mesh, name="Addition"):
        obj = self.doc.addObject("Fem::FemMeshObject", name)
        obj.FemMesh = femmesh_bridge.to_femmesh(mesh)
        return obj

    def made(self, obj):
        self.doc.recompute()
        self.assertNotIn("Invalid", obj.State, obj.getStatusString())
        return femmesh_bridge.from_femmesh(obj.FemMesh)

    def check(self, obj, expected, as_nodes=()):
        """The object's mesh is what the engine makes; document objects keep no empty groups."""
        mesh = self.made(obj)
        nodes, elements, groups = content(mesh)
        expected_nodes, expected_elements, expected_groups = content(expected.mesh)
        self.assertEqual(nodes.keys(), expected_nodes.keys())
        for number, point in nodes.items():
            np.testing.assert_allclose(point, expected_nodes[number], atol=1e-12)
        self.assertEqual(elements, {i: e for i, e in expected_elements.items() if e[0] == "tetra"})
        for name in as_nodes:
            self.assertTrue(groups.pop((name, "node")))
            self.assertTrue(expected_groups.pop((name, "element")))
        self.assertEqual(groups, {k: v for k, v in expected_groups.items() if v})
        self.assertEqual(obj.NodesAdded, expected.report.nodes_added)
        self.assertEqual(obj.Proxy.Type, "FemScalpel::" + type(obj.Proxy).__name__)
        return mesh

    def refused(self, obj, message):
        self.doc.recompute()
        self.assertIn("Invalid", obj.State)
        self.assertEqual((obj.FemMesh.NodeCount, obj.GroupReport), (0, []))
        self.assertRegex(obj.getStatusString(), message)


class Merge(MaterialTest):
    def setUp(self):
        super().setUp()
        self.addition = self.add_mesh(boss())
        self.addition.Placement = place(2, 1.5, 4)

    def test_made_where_the_placement_says(self):
        merge = ObjectsFemScalpel.makeMerge(self.doc, self.source, self.addition)
        mesh = self.check(merge, fs.merge(self.mesh, boss((2, 1.5, 4))))
        self.assertAlmostEqual(volume(mesh), 128, places=9)
        self.assertEqual(mesh.points.max(axis=0).tolist(), [6, 5, 6])
        self.assertLessEqual({"PAD", "ADD_ADDED", "ADD_SEAM", "LEFT"}, set(mesh.groups))
        self.assertLess(len(self.mesh.groups["RIGHT"].ids), len(mesh.groups["RIGHT"].ids))
        self.assertTrue(merge.Placement.isIdentity())

    def test_options(self):
        self.addition.Placement = place(2, 1.5, 3)
        merge = ObjectsFemScalpel.makeMerge(
            self.doc,
            self.source,
            self.addition,
            keep="addition",
            tolerance=0.01,
            prefix="B_",
            join_groups=False,
            group_name="BOSS",
            feature_angle=25,
        )
        expected = fs.merge(
            self.mesh,
            boss((2, 1.5, 3)),
            name="BOSS",
            keep="addition",
            tolerance=0.01,
            prefix="B_",
            join_groups=False,
            feature_angle=25,
        )
        mesh = self.check(merge, expected)
        self.assertAlmostEqual(volume(mesh), 124, places=9)
        self.assertLessEqual({"B_RIGHT", "B_FIX", "PAD", "BOSS_SEAM"}, set(mesh.groups))
        merge.Keep, merge.JoinGroups, merge.GroupPrefix, merge.Tolerance = "mesh", True, "", 0
        self.check(merge, fs.merge(self.mesh, boss((2, 1.5, 3)), name="BOSS", feature_angle=25))

    def test_made_anew_when_either_changes(self):
        merge = ObjectsFemScalpel.makeMerge(self.doc, self.source, self.addition)
        self.made(merge)
        self.addition.Placement = place(1.2, 1.4, 4)
        self.check(merge, fs.merge(self.mesh, boss((1.2, 1.4, 4))))
        self.addition.Placement = place(3, 2.5, 4, 45)
        mesh = self.made(merge)
        self.assertAlmostEqual(volume(mesh), 128, places=9)
        top = mesh.points[mesh.points[:, 2] == 6]
        self.assertAlmostEqual(top[:, 0].max(), 3 + 2**0.5, places=9)
        self.addition.FemMesh = femmesh_bridge.to_femmesh(grid_box((3, 2, 1), (2.0, 2.0, 0.5)))
        self.addition.Placement = place(1.2, 1.4, 4)  # FreeCAD takes it from the new mesh
        self.assertAlmostEqual(volume(self.made(merge)), 122, places=9)
        other = grid_box((6, 5, 5), (6.0, 5.0, 4.0))
        self.source.FemMesh = femmesh_bridge.to_femmesh(other)
        mesh = self.made(merge)
        self.assertAlmostEqual(volume(mesh), 122, places=9)
        self.assertGreaterEqual(mesh.node_count, other.node_count + 10)
        self.assertNotIn("LEFT", mesh.groups)

    def test_addition_of_another_object_of_ours(self):
        holed = ObjectsFemScalpel.makeDrill(self.doc, self.addition, origin=(3, 2.5, 6), axis=(0, 0, -1), radius=0.4)
        merge = ObjectsFemScalpel.makeMerge(self.doc, self.source, holed)
        drill = ObjectsFemScalpel.makeDrill(
            self.doc, merge, origin=(1, 1, 4), axis=(0, 0, -1), radius=0.5, group_name="BORE"
        )
        through = 120 - volume(self.made(drill))
        self.assertIn("HOLE_WALL", self.made(merge).groups)
        holed.Radius = 0.6
        self.assertLess(volume(self.made(drill)), 120 - through)
        # What went into it fails: no outdated mesh stays anywhere.
        holed.Radius = 0
        self.doc.recompute()
        self.assertEqual([o.FemMesh.NodeCount for o in (holed, merge, drill)], [0, 0, 0])
        holed.Radius = 0.4
        self.assertAlmostEqual(volume(self.made(drill)), 120 - through, places=9)

    def test_skin_elements_of_the_addition(self):
        plain = boss((2, 1.5, 4))
        faces = np.sort(plain.cells["tetra"][:, ((0, 1, 2), (0, 1, 3), (1, 2, 3), (0, 2, 3))].reshape(-1, 3), axis=1)
        faces, count = np.unique(faces, axis=0, return_counts=True)
        skin = faces[count == 1]
        ids = 1000 + np.arange(len(skin))
        top = (plain.points[skin][:, :, 2] == 6).all(axis=1)
        groups = {"TOP": ("element", ids[top]), "WHOLE": ("element", [*ids, *plain.cell_ids["tetra"]])}
        cells, numbers = {"tetra": plain.cells["tetra"], "triangle": skin}, {**plain.cell_ids, "triangle": ids}
        coated = fs.Mesh(plain.points, cells, cell_ids=numbers, groups=groups)
        self.addition.Placement = FreeCAD.Placement()
        self.addition.FemMesh = femmesh_bridge.to_femmesh(coated)
        merge = ObjectsFemScalpel.makeMerge(self.doc, self.source, self.addition)
        mesh = self.made(merge)
        self.assertEqual(set(mesh.cells), {"tetra"})
        added = mesh.points[np.isin(mesh.node_ids, mesh.groups["TOP", "node"].ids)]
        self.assertTrue(((added[:, 2] == 4) | (added[:, 2] == 6)).all())  # the source has a group TOP, too: at z = 4
        self.assertEqual((added[:, 2] == 6).sum(), 9)
        np.testing.assert_array_equal(mesh.groups["WHOLE"].ids, mesh.groups["ADD_ADDED"].ids)
        # A source with face elements takes those of the addition.
        coated_source = fs.Mesh(
            self.mesh.points, {"tetra": self.mesh.cells["tetra"], "triangle": self.mesh.cells["tetra"][:1, :3]}
        )
        self.source.FemMesh = femmesh_bridge.to_femmesh(coated_source)
        self.assertIn("triangle", self.made(merge).cells)

    def test_stiffener_on_a_shell(self):
        plate, rib = self.shell((4.0, 3.0), (8, 6)), self.shell((3.0, 1.0), (7, 2))
        base, addition = self.add_mesh(plate, "Plate"), self.add_mesh(rib, "Rib")
        addition.Placement = FreeCAD.Placement(
            FreeCAD.Vector(0.4, 1.3, 0), FreeCAD.Rotation(FreeCAD.Vector(1, 0, 0), 90)
        )
        merge = ObjectsFemScalpel.makeMerge(self.doc, base, addition, group_name="RIB")
        mesh = self.made(merge)
        self.assertEqual(set(mesh.cells), {"triangle"})
        a, b, c = (mesh.points[mesh.cells["triangle"][:, i]] for i in range(3))
        self.assertAlmostEqual(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2, 15, places=9)
        seam = points_of(mesh, "RIB_SEAM")
        np.testing.assert_allclose(seam[:, 1:], np.tile((1.3, 0), (len(seam), 1)), atol=1e-9)
        self.assertGreaterEqual(len(seam), 7)

    @staticmethod
    def shell(size, counts):
        x, y = (np.linspace(0, s, n + 1) for s, n in zip(size, counts))
        points = np.array([(a, b, 0) for a in x for b in y])
        n = counts[1] + 1
        corners = [(i * n + j, (i + 1) * n + j, (i + 1) * n + j + 1, i * n + j + 1)
                   for i in range(counts[0]) for j in range(counts[1])]  # fmt: skip
        return fs.Mesh(points, {"triangle": [t for a, b, c, d in corners for t in ((a, b, c), (a, c, d))]})

    def test_part_meshed_in_freecad(self):
        part = self.doc.addObject("Part::Box", "Boss")
        part.Length, part.Width, part.Height = 2, 1.5, 1
        part.Placement = place(1.53, 1.54, 4)
        self.doc.recompute()
        need("gmsh", "Gmsh")
        meshed = ObjectsFem.makeMeshGmsh(self.doc, "BossMesh")
        setattr(meshed, geometry_link(meshed), part)
        meshed.CharacteristicLengthMax = 0.8
        from femmesh.gmshtools import GmshTools

        GmshTools(meshed).create_mesh()
        self.assertGreater(meshed.FemMesh.VolumeCount, 0)
        merge = ObjectsFemScalpel.makeMerge(self.doc, self.source, meshed, group_name="BOSS")
        mesh = self.made(merge)
        self.assertAlmostEqual(volume(mesh), 123, places=7)
        self.assertEqual(set(mesh.cells), {"tetra"})  # the source's order, and its lack of face elements
        top = next(face for face in part.Shape.Faces if face.CenterOfMass.z == 5)
        there = mesh.node_ids[np.abs(mesh.points[:, 2] - 5) < 1e-9].tolist()
        self.assertGreater(len(there), 4)
        self.assertEqual(set(merge.FemMesh.getNodesByFace(top)), set(there))

    def test_geometry_is_still_found(self):
        part = block_shape(self.doc)
        self.source.addProperty("App::PropertyLink", "Part")
        self.source.Part = part
        self.addition.Placement = place(1.2, 1.4, 4)
        merge = ObjectsFemScalpel.makeMerge(self.doc, self.source, self.addition)
        mesh = self.made(merge)
        self.assertEqual((merge.Part, merge.OffShape), (part, []))
        self.assertFalse(any("FemScalpel:" in name for name in mesh.groups))
        for face in part.Shape.Faces:
            normal, middle = face.normalAt(0, 0), face.CenterOfMass
            there = np.abs((mesh.points - np.array(middle)) @ np.array(normal)) < 1e-9
            there &= (mesh.points > -1e-9).all(axis=1) & (mesh.points < (6 + 1e-9, 5 + 1e-9, 4 + 1e-9)).all(axis=1)
            self.assertEqual(set(merge.FemMesh.getNodesByFace(face)), set(mesh.node_ids[there].tolist()))

    def test_impossible_additions_are_told(self):
        merge = ObjectsFemScalpel.makeMerge(self.doc, self.source, self.addition)
        self.made(merge)
        self.addition.Placement = place(20, 0, 0)
        self.refused(merge, "does not meet")
        self.addition.Placement = place(2, 1.5, 4)
        self.assertAlmostEqual(volume(self.made(merge)), 128, places=9)
        for link, other, message in (
            ("Addition", None, "Addition is not set; choose the FEM mesh to add"),
            ("Addition", self.source, "the same mesh"),
            ("Addition", self.doc.addObject("Fem::FemMeshObject", "Empty"), "Addition 'Empty' has no mesh"),
            ("Addition", self.doc.addObject("Part::Box", "Block"), "Addition 'Block' is not a FEM mesh"),
            ("Source", None, "Source is not set; choose the FEM mesh to work on"),
        ):
            with self.subTest(message=message):
                before = getattr(merge, link)
                setattr(merge, link, other)
                self.refused(merge, message)
                setattr(merge, link, before)
                self.made(merge)
        self.mesh.add_group("ADD_SEAM", "node", self.mesh.node_ids[:2])
        self.source.FemMesh = femmesh_bridge.to_femmesh(self.mesh)
        self.refused(merge, "ADD_SEAM")

    def test_refused_calls_leave_nothing(self):
        objects = self.doc.Objects
        other = FreeCAD.newDocument("Other")
        try:
            stranger = other.addObject("Fem::FemMeshObject", "Stranger")
            for source, addition, options, kind, message in (
                (None, self.addition, {}, TypeError, "source must be a FEM mesh"),
                (self.source, None, {}, TypeError, "addition must be a FEM mesh"),
                (self.source, stranger, {}, ValueError, "addition 'Stranger' is in another document"),
                (self.source, self.addition, {"keep": "both"}, ValueError, ""),
                (self.source, self.addition, {"sides": 2}, TypeError, "makeMerge"),
            ):
                with self.subTest(message=message), self.assertRaisesRegex(kind, message):
                    ObjectsFemScalpel.makeMerge(self.doc, source, addition, **options)
        finally:
            FreeCAD.closeDocument(other.Name)
        self.assertEqual(self.doc.Objects, objects)

    def test_undo(self):
        self.doc.UndoMode = 1
        merge = ObjectsFemScalpel.makeMerge(self.doc, self.source, self.addition)
        first = content(self.made(merge))
        for change in (
            lambda: setattr(self.addition, "Placement", place(1.2, 1.4, 4)),
            lambda: setattr(merge, "GroupName", "OTHER"),
        ):
            self.doc.openTransaction("Change")
            change()
            self.doc.recompute()
            self.doc.commitTransaction()
            second = content(self.made(merge))
            self.assertNotEqual(second, first)
            for step, expected in ((self.doc.undo, first), (self.doc.redo, second), (self.doc.undo, first)):
                step()
                self.assertEqual(content(femmesh_bridge.from_femmesh(merge.FemMesh)), expected)

    def test_in_place_of_both_in_the_analysis(self):
        analysis = ObjectsFem.makeAnalysis(self.doc)
        analysis.addObject(self.source)
        analysis.addObject(self.addition)
        merge = ObjectsFemScalpel.makeMerge(self.doc, self.source, self.addition)
        drill = ObjectsFemScalpel.makeDrill(self.doc, merge, origin=(1, 1, 4), axis=(0, 0, -1), radius=0.5)
        self.made(drill)
        ObjectsFemScalpel.putIntoAnalysis(drill)
        self.assertEqual(analysis.Group, [drill])
        self.assertEqual((drill.Replaced, drill.ReplacedAdditions), (self.source, [self.addition]))
        ObjectsFemScalpel.takeOutOfAnalysis(drill)
        self.assertEqual(set(analysis.Group), {self.source, self.addition})
        self.assertEqual((drill.Replaced, drill.ReplacedAdditions), (None, []))

    def test_through_a_file(self):
        merge = ObjectsFemScalpel.makeMerge(self.doc, self.source, self.addition, keep="addition")
        count = self.made(merge).node_count
        path = os.path.join(self.folder.name, "saved.FCStd")
        self.doc.saveAs(path)
        FreeCAD.closeDocument(self.doc.Name)
        self.doc = FreeCAD.openDocument(path)
        merge = self.doc.Merge
        self.assertEqual((merge.FemMesh.NodeCount, merge.Keep, merge.Addition.Name), (count, "addition", "Addition"))
        self.doc.Addition.Placement = place(2, 1.5, 3)
        self.assertAlmostEqual(volume(self.made(merge)), 124, places=9)


class Fillet(MaterialTest):
    def setUp(self):
        super().setUp()
        self.edge = (6, 2.5, 4)
        points = self.mesh.points
        on_edge = (points[:, 0] == 6) & (points[:, 2] == 4)
        self.mesh.add_group("EDGE", "node", self.mesh.node_ids[on_edge])
        self.source.FemMesh = femmesh_bridge.to_femmesh(self.mesh)

    def test_its_report_names_none_but_the_user_s_groups(self):
        """Those that keep nodes on the geometry are no groups of the mesh: the edge's, which ends, for one."""
        self.source.addProperty("App::PropertyLink", "Part")
        self.source.Part = block_shape(self.doc)
        fillet = ObjectsFemScalpel.makeFillet(self.doc, self.source, "EDGE", 0.8, refine=0.5)
        self.made(fillet)
        text = fillet.Proxy.report.to_text()
        self.assertIn("EDGE", text)
        self.assertNotIn("FemScalpel:", text + "".join(fillet.GroupReport))

    def test_warnings_without_bookkeeping(self):
        ends = " are inside now, between the mesh and the addition"
        own, ours, again = "'TOP' (3 of 4)", "'FemScalpel:Face6' (47 of 254)", "'FemScalpel:Face6'' (1 of 2)"
        empty = "node group 'FemScalpel:Edge24' loses all its 89 members; it stays, empty"
        for warning, expected in (
            (empty, []),
            (empty.replace("FemScalpel:Edge24", "EDGE"), [empty.replace("FemScalpel:Edge24", "EDGE")]),
            (f"faces of {ours}, {ours}{ends}", []),
            (f"faces of {ours}, {own}, {again}{ends}", [f"faces of {own}{ends}"]),
            (f"faces of {own}, {ours}{ends}", [f"faces of {own}{ends}"]),
        ):
            self.assertEqual(without_bookkeeping([warning]), expected)

    def test_along_points_and_a_group(self):
        for along in ("EDGE", [self.edge]):
            with self.subTest(along=along):
                fillet = ObjectsFemScalpel.makeFillet(self.doc, self.source, along, 0.8, refine=0.5)
                mesh = self.check(fillet, fs.fillet(self.mesh, along, 0.8, refine=0.5), ["FILLET_FACE"])
                self.assertAlmostEqual(volume(mesh), 120 - 5 * (1 - np.pi / 4) * 0.8**2, delta=0.03)
        self.assertEqual((fillet.Along, fillet.AlongPoints), ("", [FreeCAD.Vector(6, 2.5, 4)]))
        fillet.AlongPoints = [(6, 2.5, 4), (6, 2.5, 0)]
        expected = fs.fillet(self.mesh, [(6, 2.5, 4), (6, 2.5, 0)], 0.8, refine=0.5)
        self.check(fillet, expected, ["FILLET_FACE"])

    def test_made_anew_when_the_source_changes(self):
        fillet = ObjectsFemScalpel.makeFillet(self.doc, self.source, [self.edge], radius=0.8, group_name="ROUND")
        self.made(fillet)
        self.source.Placement = place(0, 0, 0.2)
        mesh = self.made(fillet)
        wall = points_of(mesh, "ROUND_FACE")
        np.testing.assert_allclose(np.hypot(wall[:, 0] - 5.2, wall[:, 2] - 3.4), 0.8, atol=1e-9)
        fillet.Radius = 0.5
        mesh = self.made(fillet)
        wall = points_of(mesh, "ROUND_FACE")
        np.testing.assert_allclose(np.hypot(wall[:, 0] - 5.5, wall[:, 2] - 3.7), 0.5, atol=1e-9)

    def test_geometry_is_still_found(self):
        part = block_shape(self.doc)
        self.source.addProperty("App::PropertyLink", "Part")
        self.source.Part = part
        fillet = ObjectsFemScalpel.makeFillet(self.doc, self.source, [self.edge], 0.8)
        mesh = self.made(fillet)
        self.assertEqual(fillet.Part, part)
        self.assertEqual(fillet.OffShape, [])
        self.assertFalse(any("FemScalpel:" in name for name in mesh.groups))
        for face in part.Shape.Faces:
            normal, middle = face.normalAt(0, 0), face.CenterOfMass
            there = np.abs((mesh.points - np.array(middle)) @ np.array(normal)) < 1e-9
            self.assertEqual(set(fillet.FemMesh.getNodesByFace(face)), set(mesh.node_ids[there].tolist()))

    def test_impossible_ones_are_told(self):
        for along, radius, message in (
            ("NOTHING", 0.8, "NOTHING"),
            ("LEFT", 0.8, "LEFT"),
            ([self.edge], 8, "radius"),
            ([self.edge], 0, "radius"),
        ):
            with self.subTest(along=along, radius=radius):
                self.refused(ObjectsFemScalpel.makeFillet(self.doc, self.source, along, radius), message)
        fillet = ObjectsFemScalpel.makeFillet(self.doc, self.source, "EDGE", 0.8)
        fillet.AlongPoints = [self.edge]
        self.refused(fillet, "both say")
        fillet.Along, fillet.AlongPoints = "", []
        self.refused(fillet, "neither")
        fillet.Along = "EDGE"
        self.made(fillet)
        objects = self.doc.Objects
        with self.assertRaisesRegex(ValueError, "along is empty"):
            ObjectsFemScalpel.makeFillet(self.doc, self.source, "")
        with self.assertRaisesRegex(TypeError, "source"):
            ObjectsFemScalpel.makeFillet(self.doc, None, "EDGE")
        self.assertEqual(self.doc.Objects, objects)


class Reshape(MaterialTest):
    def test_onto_by_and_scale(self):
        self.mesh.add_group("END", "node", self.mesh.node_ids[self.mesh.points[:, 0] == 6])
        self.source.FemMesh = femmesh_bridge.to_femmesh(self.mesh)
        moved = ObjectsFemScalpel.makeReshape(
            self.doc, self.source, "END", onto="Plane", origin=(6.5, 2.5, 2), axis=(1, 0, 0)
        )
        mesh = self.check(moved, fs.reshape(self.mesh, "END", onto=fs.Plane((6.5, 2.5, 2), (1, 0, 0))))
        self.assertAlmostEqual(volume(mesh), 130, places=9)
        self.assertIn("SHAPE_WALL", mesh.groups)
        by = ObjectsFemScalpel.makeReshape(
            self.doc, self.source, "END", by=(-0.4, 0, 0), group_name="WALL", feature_angle=25, preserve=["LEFT"]
        )
        self.check(by, fs.reshape(self.mesh, "END", by=(-0.4, 0, 0), name="WALL", feature_angle=25, preserve=["LEFT"]))
        scale = ObjectsFemScalpel.makeReshape(self.doc, self.source, "END", scale=(1.1, (0, 0, 0)))
        self.check(scale, fs.reshape(self.mesh, "END", scale=(1.1, (0, 0, 0))))
        scale.Motion, scale.MoveBy = "By", (0.3, 0, 0)
        self.check(scale, fs.reshape(self.mesh, "END", by=(0.3, 0, 0)))
        self.source.Placement = place(1, 0, 0)
        mesh = self.made(scale)
        self.assertEqual(mesh.points[:, 0].max(), 7.3)
        self.assertAlmostEqual(volume(mesh), 126, places=9)

    def test_hole_of_another_radius(self):
        drill = ObjectsFemScalpel.makeDrill(
            self.doc, self.source, origin=(3.1, 2.4, 2), axis=(0, 0, 1), radius=1, refine=0.4
        )
        wider = ObjectsFemScalpel.makeReshape(
            self.doc, drill, "HOLE_WALL", onto="Cylinder", origin=(3.1, 2.4, 2), axis=(0, 0, 1), radius=1.3
        )
        mesh = self.made(wider)
        wall = points_of(mesh, "SHAPE_WALL")
        np.testing.assert_allclose(np.hypot(wall[:, 0] - 3.1, wall[:, 1] - 2.4), 1.3, atol=1e-9)
        self.assertAlmostEqual(volume(mesh), 120 - 4 * np.pi * 1.3**2, delta=0.5)
        drill.AxisPlacement = place(3.2, 2.5, 2)
        wider.AxisPlacement = place(3.2, 2.5, 2)
        mesh = self.made(wider)
        wall = points_of(mesh, "SHAPE_WALL")
        np.testing.assert_allclose(np.hypot(wall[:, 0] - 3.2, wall[:, 1] - 2.5), 1.3, atol=1e-9)

    def with_geometry(self):
        part = block_shape(self.doc)
        self.mesh.add_group("END", "node", self.mesh.node_ids[self.mesh.points[:, 0] == 6])
        self.source.FemMesh = femmesh_bridge.to_femmesh(self.mesh)
        self.source.addProperty("App::PropertyLink", "Part")
        self.source.Part = part
        end = next(f"Face{k}" for k, face in enumerate(part.Shape.Faces, 1) if face.CenterOfMass.x == 6)
        return part, end

    def test_wall_leaves_the_geometry(self):
        _, end = self.with_geometry()
        moved = ObjectsFemScalpel.makeReshape(self.doc, self.source, "END", by=(-0.4, 0, 0))
        mesh = self.made(moved)
        self.assertAlmostEqual(volume(mesh), 112, places=9)
        self.assertFalse(any("FemScalpel:" in name for name in mesh.groups))
        self.assertTrue(any(line.startswith(end + ":") for line in moved.OffShape), moved.OffShape)
        self.assertTrue(any("FreeCAD will not find" in text for text in moved.Warnings))

    def test_analysis_that_does_not_refer_to_the_wall(self):
        part, end = self.with_geometry()
        other = next(f"Face{k}" for k, face in enumerate(part.Shape.Faces, 1) if face.CenterOfMass.x == 0)
        analysis = ObjectsFem.makeAnalysis(self.doc)
        support = ObjectsFem.makeConstraintFixed(self.doc)
        support.References = [(part, other)]
        for member in (self.source, support):
            analysis.addObject(member)
        moved = ObjectsFemScalpel.makeReshape(self.doc, self.source, "END", by=(-0.4, 0, 0))
        self.made(moved)
        ObjectsFemScalpel.putIntoAnalysis(moved)
        self.assertIn(moved, analysis.Group)
        ObjectsFemScalpel.takeOutOfAnalysis(moved)
        support.References = [(part, end)]
        self.doc.recompute()
        with self.assertRaisesRegex(ValueError, end):
            ObjectsFemScalpel.putIntoAnalysis(moved)
        self.assertIn(self.source, analysis.Group)

    def test_impossible_ones_are_told(self):
        moved = ObjectsFemScalpel.makeReshape(self.doc, self.source, "TOP", by=(0, 0, 0.3))
        self.assertAlmostEqual(volume(self.made(moved)), 129, places=9)
        for name, bad, message in (
            ("Group", "NOTHING", "NOTHING"),
            ("Group", "", "Group is not set"),
            ("MoveBy", (0, 0, -9), "cannot be moved so far"),
        ):
            with self.subTest(message=message):
                good = getattr(moved, name)
                setattr(moved, name, bad)
                self.refused(moved, message)
                setattr(moved, name, good)
                self.made(moved)
        objects = self.doc.Objects
        for options in ({}, {"by": (1, 0, 0), "scale": (2, (0, 0, 0))}, {"onto": "Saw"}):
            with self.subTest(options=options), self.assertRaises(ValueError):
                ObjectsFemScalpel.makeReshape(self.doc, self.source, "TOP", **options)
        self.assertEqual(self.doc.Objects, objects)
