# SPDX-License-Identifier: LGPL-2.1-or-later
"""Wrong arguments of ObjectsFemScalpel's functions: an error that names the argument and says what is expected."""

import inspect
import os
import re

import FreeCAD
import Fem
import ObjectsFemScalpel

from .documents import DocumentTest

BAD = ("ab", 5, (1, 2), ("a", "b", "c"), object(), b"x", [None], {1: 2}, True)
MAKERS = [name for name in vars(ObjectsFemScalpel) if re.match("make[A-Z]", name)]


class Arguments(DocumentTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.mesh_object(self.doc)
        self.other = FreeCAD.newDocument("Other")
        self.elsewhere = self.mesh_object(self.other)
        self.plain = self.doc.addObject("App::FeaturePython", "Plain")
        self.gone = self.mesh_object(self.doc)
        self.doc.removeObject(self.gone.Name)
        self.closed = FreeCAD.newDocument("Closed")
        self.of_closed = self.mesh_object(self.closed)
        FreeCAD.closeDocument(self.closed.Name)

    def tearDown(self):
        FreeCAD.closeDocument(self.other.Name)
        super().tearDown()

    @staticmethod
    def mesh_object(doc):
        femmesh = Fem.FemMesh()
        for number, place in enumerate([(0, 0, 0), (10, 0, 0), (0, 10, 0), (0, 0, 10)], 1):
            femmesh.addNode(*place, number)
        femmesh.addVolume([1, 2, 3, 4])
        obj = doc.addObject("Fem::FemMeshObject", "Mesh")
        obj.FemMesh = femmesh
        return obj

    def needed(self, name):
        """Arguments, beside document and source, that a function needs."""
        more = {
            "makeFaceCrack": {"group": "G"},
            "makeMerge": {"addition": self.mesh},
            "makeFillet": {"along": "G"},
            "makeReshape": {"group": "G", "by": (0, 0, 1)},
        }
        return more.get(name, {})

    def assert_refused(self, error, words, function, *args, **kwargs):
        before = [obj.Name for obj in self.doc.Objects]
        with self.assertRaisesRegex(error, words) as caught:
            function(*args, **kwargs)
        self.assertIn(type(caught.exception), (TypeError, ValueError))
        self.assertEqual([obj.Name for obj in self.doc.Objects], before, "nothing is left behind")

    def test_documents_and_objects(self):
        self.assertEqual(len(MAKERS), 10)
        mesh = "must be a FEM mesh object"
        for name in MAKERS:
            function, more = getattr(ObjectsFemScalpel, name), self.needed(name)
            with self.subTest(name):
                for doc in (None, "Doc", self.mesh):
                    words = "^doc must be a document of FreeCAD"
                    self.assert_refused(TypeError, words, function, doc, self.mesh, **more)
                self.assert_refused(ValueError, "^doc .* closed", function, self.closed, self.mesh, **more)
                for source in (None, "Mesh", self.mesh.FemMesh, self.plain, self.doc):
                    self.assert_refused(TypeError, f"^source {mesh}", function, self.doc, source, **more)
                for source in (self.gone, self.of_closed):
                    self.assert_refused(ValueError, "^source .* deleted", function, self.doc, source, **more)
                self.assert_refused(ValueError, "another document", function, self.doc, self.elsewhere, **more)
                for bad in (None, 5):
                    self.assert_refused(
                        TypeError, "^name must be a string", function, self.doc, self.mesh, name=bad, **more
                    )

    def test_values(self):
        """Whatever is given for any argument is taken, or refused by an error that names it."""
        refused = 0
        for name in MAKERS:
            function = getattr(ObjectsFemScalpel, name)
            for argument in list(inspect.signature(function).parameters)[3:]:
                for bad in (*BAD, None):
                    kwargs = {**self.needed(name), argument: bad}
                    if argument in ("onto", "scale"):
                        kwargs.pop("by")
                    before = [obj.Name for obj in self.doc.Objects]
                    with self.subTest(function=name, argument=argument, value=bad):
                        try:
                            self.doc.removeObject(function(self.doc, self.mesh, **kwargs).Name)
                        except (TypeError, ValueError) as error:
                            refused += 1
                            self.assertIn(type(error), (TypeError, ValueError))
                            self.assertRegex(str(error), rf"^(each of )?{argument}\b.* must be |^give one of onto")
                        self.assertEqual([obj.Name for obj in self.doc.Objects], before)
        self.assertGreater(refused, 500)

    def test_what_looks_like_a_value(self):
        """FreeCAD's properties would take these for something else."""
        make, doc, mesh = ObjectsFemScalpel.makeCrack, self.doc, self.mesh
        self.assert_refused(TypeError, "^method must be a string", make, doc, mesh, method=("snap", "deform"))
        self.assert_refused(ValueError, "^method must be one of 'snap', 'deform', not 'x'", make, doc, mesh, method="x")
        self.assert_refused(TypeError, "^preserve must be a sequence of strings", make, doc, mesh, preserve="FIX")
        self.assert_refused(TypeError, "^origin must be an App.Vector or three numbers", make, doc, mesh, origin=(1, 2))
        self.assertEqual(make(doc, mesh, patch_radius="1 cm").PatchRadius.Value, 10)
        self.assertEqual(make(doc, mesh, preserve=("FIX",)).PreservedGroups, ["FIX"])

    def test_files(self):
        import_mesh, export_mesh = ObjectsFemScalpel.importMesh, ObjectsFemScalpel.exportMesh
        path = os.path.join(self.folder.name, "a.unv")
        export_mesh(self.mesh, path)
        for doc in (None, "Doc", self.mesh):
            self.assert_refused(TypeError, "^doc must be a document of FreeCAD", import_mesh, doc, path)
        self.assert_refused(ValueError, "^doc .* closed", import_mesh, self.closed, path)
        for bad in (None, 5, self.doc):
            self.assert_refused(TypeError, "^path must be a string or a path", import_mesh, self.doc, bad)
            self.assert_refused(TypeError, "^path must be a string or a path", export_mesh, self.mesh, bad)
        self.assert_refused(TypeError, "^name must be a string or None", import_mesh, self.doc, path, 5)
        self.assert_refused(TypeError, "^mesh must be a string", import_mesh, self.doc, path, None, 5)
        for obj in (None, "Mesh", self.mesh.FemMesh, self.plain):
            self.assert_refused(TypeError, "^obj must be a FEM mesh object", export_mesh, obj, path)
        for obj in (self.gone, self.of_closed):
            self.assert_refused(ValueError, "^obj .* deleted", export_mesh, obj, path)
        self.assertEqual(import_mesh(self.doc, path).FemMesh.NodeCount, 4)

    def test_objects_that_are_none(self):
        put, take = ObjectsFemScalpel.putIntoAnalysis, ObjectsFemScalpel.takeOutOfAnalysis
        rename, follow = ObjectsFemScalpel.renameGroup, ObjectsFemScalpel.followGeometry
        for function, more in ((put, ()), (take, ()), (rename, ("a", "b")), (follow, (None,)), (follow, ([1],))):
            for obj in (None, "Mesh", self.plain):
                self.assert_refused(TypeError, "^obj must be a FEM mesh object", function, obj, *more)
            for obj in (self.gone, self.of_closed):
                self.assert_refused(ValueError, "^obj .* deleted", function, obj, *more)
        for function in (put, take):
            self.assert_refused(TypeError, "^obj must be an object that FemScalpel has made", function, self.mesh)
        for geometry in (5, [5], [(self.mesh,)], [("Mesh", "")]):
            crack = ObjectsFemScalpel.makeCrack(self.doc, self.mesh)
            self.assert_refused(TypeError, "geometry must be", follow, crack, geometry)
        self.assert_refused(TypeError, "^old must be a string", rename, self.mesh, 5, "b")
        self.assert_refused(TypeError, "^new must be a string", rename, self.mesh, "a", None)
        self.assert_refused(ValueError, "^kind must be one of", rename, self.mesh, "a", "b", "x")
