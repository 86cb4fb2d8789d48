# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nodes stay where FreeCAD finds them: on the geometry the mesh was made from."""

import os

import FreeCAD
import numpy as np
import ObjectsFem
import Part

import femmesh_bridge
import femscalpel as fs
import ObjectsFemScalpel

from .documents import DocumentTest, geometry_link, need


def rounded_box():
    box = Part.makeBox(30, 20, 15)
    return box.makeFillet(4, [edge for edge in box.Edges if abs(edge.tangentAt(0).z) > 0.5])


SHAPES = {
    "cylinder": lambda: Part.makeCylinder(10, 30),
    "tube": lambda: Part.makeCylinder(12, 25).cut(Part.makeCylinder(7, 25)),
    "cone": lambda: Part.makeCone(12, 3, 25),
    "sphere and box": lambda: Part.makeSphere(11).fuse(Part.makeBox(14, 14, 14)),
    "torus": lambda: Part.makeTorus(20, 6),
    "rounded box": rounded_box,
    "two solids": lambda: Part.makeCylinder(10, 12).generalFuse([Part.makeCylinder(10, 12, FreeCAD.Vector(0, 0, 12))])[
        0
    ],
    "shell": lambda: Part.makeCylinder(10, 30).Faces[0],
}


class OnShape(DocumentTest):
    def mesh_of(self, name, order, size):
        part = self.doc.addObject("Part::Feature", "Geometry")
        part.Shape = SHAPES[name]()
        mesh = ObjectsFem.makeMeshGmsh(self.doc, "Mesh")
        setattr(mesh, geometry_link(mesh), part)
        mesh.ElementOrder = order
        mesh.CharacteristicLengthMax = size
        need("gmsh", "Gmsh")
        from femmesh.gmshtools import GmshTools

        GmshTools(mesh).create_mesh()  # may return mere warnings
        self.assertGreater(mesh.FemMesh.NodeCount, 0)
        if part.Shape.Solids:  # as FreeCAD's examples: tetrahedra alone
            femmesh = femmesh_bridge.from_femmesh(mesh.FemMesh)
            kinds = [k for k in femmesh.cells if k.startswith("tetra")]
            mesh.FemMesh = femmesh_bridge.to_femmesh(fs.Mesh(femmesh.points, {k: femmesh.cells[k] for k in kinds}))
        self.doc.recompute()
        return part.Shape, mesh

    def not_found(self, femmesh, shape, lips=()):
        """Number of triangles of the skin (all, of a shell), lips apart, whose nodes FreeCAD finds on no single
        face."""
        mesh = femmesh_bridge.from_femmesh(femmesh)
        ((name, cells),) = ((k, v) for k, v in mesh.cells.items() if not k.startswith("line"))
        if name.startswith("tetra"):
            places = np.array([(0, 1, 2, 4, 5, 6), (0, 1, 3, 4, 8, 7), (1, 2, 3, 5, 9, 8), (0, 2, 3, 6, 9, 7)])
            faces = cells[:, places if name == "tetra10" else places[:, :3]].reshape(-1, 6 if name == "tetra10" else 3)
            _, first, owners = np.unique(np.sort(faces[:, :3], axis=1), axis=0, return_index=True, return_counts=True)
            cells = faces[first[owners == 1]]
        on = [np.isin(mesh.node_ids, femmesh.getNodesByFace(face)) for face in shape.Faces]
        on += [np.isin(mesh.node_ids, list(lip)) for lip in lips]
        return int((~np.any([mask[cells].all(axis=1) for mask in on], axis=0)).sum())

    def test_every_face_is_found_after_random_cracks(self):
        need("gmsh", "Gmsh")
        random = np.random.default_rng(7)
        cracks = off = refused = 0
        for name in SHAPES:
            for order in ("1st", "2nd"):
                with self.subTest(shape=name, order=order):
                    shape, source = self.mesh_of(name, order, 4.5)
                    self.assertEqual(self.not_found(source.FemMesh, shape), 0)
                    for _ in range(3):
                        normal = random.normal(size=3)
                        center = np.array(shape.BoundBox.Center) + random.uniform(-3, 3, 3)
                        crack = ObjectsFemScalpel.makeCrack(self.doc, source, origin=center, normal=normal)
                        self.doc.recompute()
                        cracks += 1
                        if "Invalid" in crack.State:
                            # A coarse curved second-order mesh may leave no room; then there is no mesh, and a reason.
                            self.assertEqual(order, "2nd")
                            self.assertRegex(crack.getStatusString(), "too coarse|folded at a corner")
                            self.assertEqual(crack.FemMesh.NodeCount, 0)
                            refused += 1
                        elif crack.OffShape:
                            off += 1
                        else:
                            self.check(shape, crack)
                        self.doc.removeObject(crack.Name)
                    self.doc.removeObject(source.Name)
                    self.doc.removeObject("Geometry")
        print(
            f"\n{cracks} cracks in curved geometry: {cracks - off - refused} keep all nodes on it, {off} say which "
            f"they cannot, "
            f"{refused} are refused on a mesh too coarse"
        )
        self.assertLess(off + refused, 0.2 * cracks)

    def test_kept_to_shape_from_the_start(self):
        for order in ("1st", "2nd"):
            with self.subTest(order=order):
                shape, source = self.mesh_of("cylinder", order, 8)
                crack = ObjectsFemScalpel.makeCrack(self.doc, source, origin=(0, 0, 14), normal=(0.4, 0.1, 1))
                refined = ObjectsFemScalpel.makeRefine(
                    self.doc, source, axis=(1, 0, 0), origin=(0, 0, 9), radius=2, size=3
                )
                drill = ObjectsFemScalpel.makeDrill(self.doc, refined, axis=(1, 0, 0), origin=(0, 0, 9), radius=2)
                for obj in (crack, refined, drill):
                    self.assertFalse(obj.KeepToShape)
                    obj.KeepToShape = True
                self.doc.recompute()
                before = source.FemMesh.Nodes
                for obj in (crack, refined, drill):
                    self.assertNotIn("Invalid", obj.State)
                    self.assertEqual(list(obj.OffShape), [])
                    self.assertEqual(
                        [
                            w
                            for w in obj.Warnings
                            if not w.startswith(("the tool is finer than the mesh, which", "the mesh already has"))
                        ],
                        [],
                    )
                # What is new on the round side is on the cylinder, by the engine; so is the skin's volume between mesh
                # and shape.
                mesh = femmesh_bridge.from_femmesh(refined.FemMesh)
                self.assertGreater(mesh.node_count, len(before))
                cells = next(c for k, c in mesh.cells.items() if k.startswith("tetra"))
                volume = (
                    np.einsum(
                        "ij,ij->i",
                        np.cross(*(mesh.points[cells[:, k]] - mesh.points[cells[:, 0]] for k in (1, 2))),
                        mesh.points[cells[:, 3]] - mesh.points[cells[:, 0]],
                    ).sum()
                    / 6
                )
                self.assertLess(volume, shape.Volume)
                plain = ObjectsFemScalpel.makeRefine(
                    self.doc, source, axis=(1, 0, 0), origin=(0, 0, 9), radius=2, size=3
                )
                self.doc.recompute()
                self.assertEqual(plain.GroupReport[0].split()[0], refined.GroupReport[0].split()[0])
                for obj in (drill, refined, crack, plain, source):
                    self.doc.removeObject(obj.Name)
                self.doc.removeObject("Geometry")

    def test_kept_to_shape_needs_a_shape(self):
        mesh = self.doc.addObject("Fem::FemMeshObject", "Alone")
        box = fs.Mesh([(0, 0, 0), (9, 0, 0), (0, 9, 0), (0, 0, 9)], {"tetra": [(0, 1, 2, 3)]})
        mesh.FemMesh = femmesh_bridge.to_femmesh(box)
        crack = ObjectsFemScalpel.makeCrack(self.doc, mesh, origin=(2, 0, 0), normal=(1, 0, 0))
        crack.KeepToShape = True
        self.doc.recompute()
        self.assertIn("Invalid", crack.State)
        self.assertIn("KeepToShape", crack.getStatusString())

    def check(self, shape, crack):
        femmesh = crack.FemMesh
        lips = [
            set(femmesh.getGroupElements(g))
            for g in femmesh.Groups
            if femmesh.getGroupName(g) in ("CRACK_P", "CRACK_N") and femmesh.getGroupElementType(g) == "Node"
        ]
        self.assertEqual(self.not_found(femmesh, shape, lips), 0)
        # Lips stay together, on the plane.
        nodes = femmesh.Nodes
        plane = crack.PlanePlacement
        normal = plane.Rotation.multVec(FreeCAD.Vector(0, 0, 1))
        for lip in lips:
            self.assertLess(max(abs((nodes[n] - plane.Base).dot(normal)) for n in lip), 1e-7)
        if lips:
            self.assertEqual(*({tuple(nodes[n]) for n in lip} for lip in lips))

    def test_found_after_a_file_too(self):
        shape, source = self.mesh_of("cylinder", "2nd", 4.5)
        ObjectsFemScalpel.makeCrack(self.doc, source, origin=(0, 0, 14), normal=(0.4, 0.1, 1))
        self.doc.recompute()
        path = os.path.join(self.folder.name, "saved.FCStd")
        self.doc.saveAs(path)
        FreeCAD.closeDocument(self.doc.Name)
        self.doc = FreeCAD.openDocument(path)
        crack = self.doc.Crack
        self.assertGreater(crack.NodesMoved, 0)
        self.check(self.doc.Geometry.Shape, crack)

    def test_a_hole_through_a_curved_face(self):
        shape, source = self.mesh_of("cylinder", "2nd", 3)
        drill = ObjectsFemScalpel.makeDrill(self.doc, source, origin=(0, 0, 14), axis=(1, 0.1, 0.2), radius=4)
        self.doc.recompute()
        self.assertNotIn("Invalid", drill.State, drill.getStatusString())
        self.assertEqual(drill.OffShape, [])
        walls = [
            set(drill.FemMesh.getGroupElements(g))
            for g in drill.FemMesh.Groups
            if drill.FemMesh.getGroupName(g) == "HOLE_WALL"
        ]
        self.assertEqual(self.not_found(drill.FemMesh, shape, walls), 0)
        hole = fs.Cylinder((0, 0, 14), (1, 0.1, 0.2), 4)
        wall = np.array([drill.FemMesh.Nodes[n] for n in walls[0]])
        self.assertLess(np.abs(hole.distance(wall)).max(), 1e-7)

    def test_solids_keep_their_volume(self):
        shape, source = self.mesh_of("two solids", "1st", 3)
        crack = ObjectsFemScalpel.makeCrack(self.doc, source, origin=(0, 0, 11.5), normal=(0.3, 0, 1))
        drifting = ObjectsFemScalpel.makeCrack(self.doc, source, origin=(0, 0, 11.5), normal=(0.3, 0, 1), preserve=())
        self.doc.recompute()
        for mesh in (source, crack, drifting):
            for solid in shape.Solids:
                nodes = set(mesh.FemMesh.getNodesBySolid(solid))
                inside = [v for v in mesh.FemMesh.Volumes if nodes.issuperset(mesh.FemMesh.getElementNodes(v))]
                points = np.array([[mesh.FemMesh.Nodes[n] for n in mesh.FemMesh.getElementNodes(v)] for v in inside])
                volume = np.abs(np.linalg.det(points[:, 1:] - points[:, :1])).sum() / 6
                self.assertAlmostEqual(volume / solid.Volume, 1, delta=0.05)

    def test_without_geometry_those_the_analysis_refers_to(self):
        shape, source = self.mesh_of("cylinder", "1st", 4)
        setattr(source, geometry_link(source), None)
        analysis = ObjectsFem.makeAnalysis(self.doc, "Analysis")
        fixed = ObjectsFem.makeConstraintFixed(self.doc, "Fixed")
        fixed.References = [(self.doc.Geometry, "Face1")]
        analysis.addObject(source)
        analysis.addObject(fixed)
        crack = ObjectsFemScalpel.makeCrack(self.doc, source, origin=(0, 0, 14), normal=(0.1, 0, 1))
        self.doc.recompute()
        self.assertEqual(crack.OffShape, [])
        radii = [np.hypot(p.x, p.y) for p in crack.FemMesh.Nodes.values()]
        on = [r for r in radii if r > 10 - 1e-7]
        self.assertEqual(len(on), len(crack.FemMesh.getNodesByFace(shape.Faces[0])))
        self.assertGreater(len(on), len(source.FemMesh.getNodesByFace(shape.Faces[0])))

    def test_what_cannot_be_put_back_is_told_and_refused(self):
        # A thin disc of one layer between two cylinders of nearly the same radius: its elements are too flat to follow.
        shape = Part.makeCylinder(10, 2).cut(Part.makeCylinder(9.93, 2))
        part = self.doc.addObject("Part::Feature", "Geometry")
        part.Shape = shape
        n = 16
        angles = np.arange(n) * 2 * np.pi / n
        ring = [
            np.column_stack([r * np.cos(angles), r * np.sin(angles), np.full(n, z)]) for r in (9.93, 10) for z in (0, 2)
        ]
        prisms = []
        for i in range(n):
            j = (i + 1) % n
            a, b, c, d = i, j, n + i, n + j  # inner: bottom i, j, top i, j
            e, f, g, h = (k + 2 * n for k in (a, b, c, d))
            prisms += [(a, e, f, h), (a, f, b, h), (a, b, d, h), (a, d, c, h), (a, c, g, h), (a, g, e, h)]
        points = np.concatenate(ring)
        cells = np.array(prisms)
        flipped = np.linalg.det(points[cells[:, 1:]] - points[cells[:, :1]]) < 0
        cells[flipped] = cells[flipped][:, [0, 2, 1, 3]]
        source = self.add_source(fs.Mesh(points, {"tetra": cells}))
        source.addProperty("App::PropertyLink", "Part")
        source.Part = part
        analysis = ObjectsFem.makeAnalysis(self.doc, "Analysis")
        analysis.addObject(source)
        crack = ObjectsFemScalpel.makeCrack(self.doc, source, origin=(0, 0.7, 0), normal=(0.2, 1, 0))
        self.doc.recompute()
        self.assertNotIn("Invalid", crack.State)
        self.assertTrue(crack.OffShape)
        self.assertRegex(crack.OffShape[0], r"(Face|Edge)\d+: \d+ nodes are off it by up to 0\.\d+")
        self.assertTrue(any("FreeCAD will not find" in warning for warning in crack.Warnings))
        with self.assertRaisesRegex(ValueError, "would not apply everything"):
            ObjectsFemScalpel.putIntoAnalysis(crack)
        self.assertIn(source, analysis.Group)
        ObjectsFemScalpel.putIntoAnalysis(crack, strict=False)
        self.assertIn(crack, analysis.Group)
