# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes of files, with what a FemMesh does not hold: from a deck to a deck with a crack and a hole in it."""

import os
import re
import subprocess

import FreeCAD
import numpy as np
import ObjectsFemScalpel

import femmesh_bridge
import femscalpel as fs
from femscalpelobjects import imported
from femscalpelobjects.whole import whole_of

from .documents import DocumentTest, need

CUBE = ((0, 1, 3, 7), (0, 1, 7, 5), (0, 5, 7, 4), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7))
NX, N = 6, 4
CARDS = """*SURFACE, NAME=PRESSED, TYPE=ELEMENT
PRESSED_1, S2
*MATERIAL, NAME=STEEL
*ELASTIC
210000., 0.3
*SOLID SECTION, ELSET=BODY, MATERIAL=STEEL
*STEP
*STATIC
*BOUNDARY
FIX, 1, 3
*CLOAD
PULL, 1, 2.
*NODE PRINT, NSET=FIX, TOTALS=ONLY
RF
*END STEP
"""


def deck():
    """A bar of 6 by 2 by 2, fixed at one end, pulled at the other by 2 per node. Numbers have gaps."""
    at, lines = {}, ["** a comment of the user's", "*HEADING", "bar", "*NODE"]
    for k in range(N + 1):
        for j in range(N + 1):
            for i in range(NX * 2 + 1):
                at[i, j, k] = 10 + 3 * len(at)
                lines.append(f"{at[i, j, k]}, {i / 2}, {j / 2}, {k / 2}")
    lines.append("*ELEMENT, TYPE=C3D4, ELSET=BODY")
    number = 100
    for i in range(NX * 2):
        for j in range(N):
            for k in range(N):
                for corners in CUBE:
                    number += 7
                    nodes = (at[i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)] for c in corners)
                    lines.append(", ".join(map(str, (number, *nodes))))
    for name, x in (("FIX", 0), ("PULL", NX * 2)):
        lines.append(f"*NSET, NSET={name}")
        lines += [f"{node}," for (i, j, k), node in at.items() if i == x]
    lines += ["*ELSET, ELSET=PRESSED_1", "107, 114"]
    return "\n".join(lines) + "\n" + CARDS


class Import(DocumentTest):
    def setUp(self):
        super().setUp()
        self.path = os.path.join(self.folder.name, "bar.inp")
        with open(self.path, "w") as file:
            file.write(deck())
        self.mesh = ObjectsFemScalpel.importMesh(self.doc, self.path)

    def cut(self):
        crack = ObjectsFemScalpel.makeCrack(
            self.doc, self.mesh, origin=(2.2, 1, 1), normal=(1, 0.1, 0.2), patch="Disk", patch_radius=0.7
        )
        drill = ObjectsFemScalpel.makeDrill(
            self.doc, crack, origin=(4.5, 1, 1), axis=(0, 0, 1), radius=0.5, group_name="BORE", refine=False
        )
        self.doc.recompute()
        self.assertNotIn("Invalid", drill.State)
        return drill

    def exported(self, obj, name):
        path = os.path.join(self.folder.name, name)
        ObjectsFemScalpel.exportMesh(obj, path)
        return path

    def reaction(self, path):
        need("ccx", "CalculiX")
        name = os.path.basename(path)[:-4]
        subprocess.run(["ccx", "-i", name], cwd=self.folder.name, check=True, capture_output=True)
        with open(os.path.join(self.folder.name, name + ".dat")) as file:
            return float(re.search(r"total force.*\n\n\s+(\S+)", file.read())[1])

    def test_a_deck_comes_out_as_it_went_in(self):
        self.assertEqual((self.mesh.Label, self.mesh.FemMesh.VolumeCount), ("bar", NX * 2 * N * N * 6))
        groups = {self.mesh.FemMesh.getGroupName(g) for g in self.mesh.FemMesh.Groups}
        self.assertEqual(groups, {"FIX", "PULL", "BODY", "PRESSED_1"})
        with open(self.exported(self.mesh, "again.inp")) as file:
            self.assertEqual(file.read(), deck())

    def test_cards_follow_a_crack_and_a_hole(self):
        path = self.exported(self.cut(), "cut.inp")
        mesh = fs.read(path)
        for group in ("FIX", "PULL", "BODY", "PRESSED", "CRACK_P", "CRACK_N", "BORE_WALL"):
            self.assertIn(group, mesh.groups)
        self.assertIn("** a comment of the user's", open(path).read())
        whole = fs.read(self.path)
        same = np.intersect1d(mesh.node_ids, whole.node_ids)
        self.assertGreater(len(same), 0.9 * whole.node_count)  # numbers are the file's
        self.assertAlmostEqual(self.reaction(path), -2 * (N + 1) ** 2, places=3)

    def test_of_a_document_that_was_opened_again(self):
        drill = self.cut()
        ObjectsFemScalpel.renameGroup(self.mesh, "PRESSED_1", "TOP")
        self.doc.recompute()
        count = drill.FemMesh.NodeCount
        with open(self.exported(drill, "saved.inp")) as file:
            saved = file.read()
        path = os.path.join(self.folder.name, "bar.FCStd")
        self.doc.saveAs(path)
        FreeCAD.closeDocument(self.doc.Name)
        os.remove(self.path)  # the document has all of it
        self.doc = FreeCAD.openDocument(path)
        with open(self.exported(self.doc.Drill, "opened.inp")) as file:
            self.assertEqual(file.read(), saved, "to the last digit")
        mesh = fs.read(os.path.join(self.folder.name, "opened.inp"))
        self.assertEqual(mesh.node_count, count)
        self.assertTrue(mesh.has_deck)
        self.assertIn("PRESSED", mesh.groups)
        self.assertAlmostEqual(self.reaction(os.path.join(self.folder.name, "opened.inp")), -2 * (N + 1) ** 2, places=3)

    def test_coordinates_of_a_document_that_was_opened_again(self):
        """FreeCAD makes a rotation of its axis and angle, which differs in the last digit."""
        drill = self.cut()
        shown = {obj.Name: femmesh_bridge.from_femmesh(obj.FemMesh).points for obj in (drill, drill.Source)}
        path = os.path.join(self.folder.name, "bar.FCStd")
        self.doc.saveAs(path)
        FreeCAD.closeDocument(self.doc.Name)
        self.doc = FreeCAD.openDocument(path)
        for name, points in shown.items():
            np.testing.assert_array_equal(whole_of(self.doc.getObject(name)).points, points)

    def test_messages_name_the_lines_of_the_users_files(self):
        """The document has the deck in one piece, with other lines."""
        steel = "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3\n"
        text = deck().replace(steel, "*INCLUDE, INPUT=steel.inc\n")
        text = text.replace("*CLOAD", "*TEMPERATURE, FILE=heat.frd\n*CLOAD")
        for name, content in (("split.inp", text), ("steel.inc", "** a steel\n" * 7 + steel)):
            with open(os.path.join(self.folder.name, name), "w") as file:
                file.write(content)
        mesh = ObjectsFemScalpel.importMesh(self.doc, os.path.join(self.folder.name, "split.inp"), name="Other")
        place = f"split.inp:{1 + text.splitlines().index('*TEMPERATURE, FILE=heat.frd')}: "
        crack = ObjectsFemScalpel.makeCrack(self.doc, mesh, origin=(3.3, 1, 1), normal=(1, 0.1, 0.2))
        self.doc.recompute()
        self.assertTrue(any(w.startswith(place) for w in crack.Warnings), crack.Warnings)
        hole = ObjectsFemScalpel.makeDrill(self.doc, crack, origin=(4.5, 1, 1), axis=(0, 0, 1), radius=0.5)
        self.doc.recompute()
        self.assertTrue(any(w.startswith(place) for w in hole.Warnings), hole.Warnings)
        path = os.path.join(self.folder.name, "split.FCStd")
        self.doc.saveAs(path)
        FreeCAD.closeDocument(self.doc.Name)
        self.doc = FreeCAD.openDocument(path)
        crack = self.doc.Crack
        crack.touch()
        self.doc.recompute()
        self.assertTrue(any(w.startswith(place) for w in crack.Warnings), crack.Warnings)

    def test_a_mesh_that_was_moved_is_another_one(self):
        self.mesh.Placement.Base.z = 3
        mesh = fs.read(self.exported(self.mesh, "moved.inp"))
        self.assertFalse("STEEL" in open(os.path.join(self.folder.name, "moved.inp")).read())
        self.assertEqual(mesh.points[:, 2].min(), 3)
        crack = ObjectsFemScalpel.makeCrack(self.doc, self.mesh, origin=(3.3, 1, 4), normal=(1, 0.1, 0.2))
        self.doc.recompute()
        for obj in (self.mesh, crack):
            told = imported.export(obj, os.path.join(self.folder.name, "told.inp"))
            self.assertTrue(any("not the one that was imported" in sentence for sentence in told), obj.Label)

    def test_what_is_made_of_a_moved_deck_says_what_is_left_behind(self):
        other = ObjectsFemScalpel.importMesh(self.doc, self.path, name="Block")
        other.Placement.Base.z = 2
        for obj in (
            ObjectsFemScalpel.makeMerge(self.doc, self.mesh, other),
            ObjectsFemScalpel.makeCrack(self.doc, other, origin=(3.3, 1, 3), normal=(1, 0.1, 0.2)),
        ):
            self.doc.recompute()
            self.assertNotIn("Invalid", obj.State)
            self.assertTrue(
                any(w.startswith("Block is not the mesh that was imported any more") for w in obj.Warnings),
                obj.Warnings,
            )
        drill = ObjectsFemScalpel.makeDrill(self.doc, self.mesh, origin=(4.5, 1, 1), axis=(0, 0, 1), radius=0.5)
        self.doc.recompute()
        self.assertFalse(any("not the mesh that was imported" in w for w in drill.Warnings))

    def test_a_mesh_whose_groups_were_changed_is_another_one(self):
        def added(mesh):
            mesh.addGroupElements(mesh.addGroup("NEW", "Node"), [10, 13])

        def grown(mesh):
            mesh.addGroupElements(group(mesh, "FIX"), [13, 16])

        def removed(mesh):
            mesh.removeGroup(group(mesh, "FIX"))

        def replaced(mesh):
            index = group(mesh, "FIX")
            count = len(mesh.getGroupElements(index))
            mesh.removeGroup(index)
            mesh.addGroupElements(mesh.addGroup("FIX", "Node"), sorted(mesh.Nodes)[-count:])

        def group(mesh, name):
            return next(g for g in mesh.Groups if mesh.getGroupName(g) == name)

        for change in (added, grown, removed, replaced):
            with self.subTest(change=change.__name__):
                obj = ObjectsFemScalpel.importMesh(self.doc, self.path)
                femmesh = obj.FemMesh.copy()
                change(femmesh)
                obj.FemMesh = femmesh
                path = os.path.join(self.folder.name, "changed.inp")
                told = imported.export(obj, path)
                self.assertTrue(any("not the one that was imported" in sentence for sentence in told))
                groups = {g.name: len(g) for g in fs.read(path).groups.all("node")}
                for g in femmesh.Groups:
                    if femmesh.getGroupElementType(g) == "Node":
                        self.assertEqual(groups[femmesh.getGroupName(g)], len(femmesh.getGroupElements(g)))
                self.assertEqual("FIX" in groups, change is not removed)

    def test_files_of_other_kinds_come_out_whole(self):
        box = fs.read(self.path)
        faces = fs.Mesh(box.points, box.cells, groups=[("SKIN", "facet", [(1, 2), (2, 2)])])
        points = fs.Mesh(box.points[:3], {"vertex": [[0], [1], [2]]}, groups=[("P", "element", [1, 2])])
        for name, mesh in (("faces.vtu", faces), ("points.vtu", points)):
            path = os.path.join(self.folder.name, name)
            fs.write(mesh, path)
            obj = ObjectsFemScalpel.importMesh(self.doc, path)
            again = os.path.join(self.folder.name, "again_" + name)
            self.assertEqual(imported.export(obj, again), [])
            back = fs.read(again)
            self.assertEqual(list(back.cells), list(mesh.cells))
            self.assertEqual(
                [(g.name, g.kind, g.ids.tolist()) for g in back.groups.all()],
                [(g.name, g.kind, g.ids.tolist()) for g in mesh.groups.all()],
            )

    def test_numbers_that_freecad_has_no_room_for(self):
        class Full:
            def addNode(self, *_):
                raise RuntimeError("std::bad_alloc")

        mesh = fs.Mesh(np.eye(3), {"triangle": [[0, 1, 2]]}, node_ids=[1, 2, 2147483600])
        with self.assertRaisesRegex(fs.WriteError, "the largest, 2147483600. Renumber"):
            femmesh_bridge.to_femmesh(mesh, into=Full())

    def test_undo(self):
        self.doc.UndoMode = 1
        other = ObjectsFemScalpel.importMesh(self.doc, self.path, name="Second")
        self.assertEqual(other.Label, "Second")
        self.doc.undo()
        self.assertIsNone(self.doc.getObject("Second"))
        self.doc.redo()
        self.assertEqual(self.doc.Second.FemMesh.NodeCount, self.mesh.FemMesh.NodeCount)
        with open(self.exported(self.doc.Second, "redone.inp")) as file:
            self.assertEqual(file.read(), deck())

    def test_fields_and_face_groups_of_a_med(self):
        path = os.path.join(self.folder.name, "bar.med")
        whole = fs.read(self.path)
        mesh = fs.Mesh(
            whole.points,
            whole.cells,
            groups=[("LEFT", "node", [1, 2, 3]), ("SKIN", "facet", [(1, 2), (2, 2)])],
        )
        step = fs.FieldStep(0, 0, 0.0, (fs.FieldPart("node", "", mesh.node_ids, 3 * mesh.points[:, :1] + 1),))
        mesh.fields = [fs.Field("TEMP", ("T",), ("K",), (step,))]
        fs.write(mesh, path)
        read = ObjectsFemScalpel.importMesh(self.doc, path, name="Med")
        crack = ObjectsFemScalpel.makeCrack(self.doc, read, origin=(3.3, 1, 1), normal=(1, 0.1, 0.2))
        self.doc.recompute()
        out = fs.read(self.exported(crack, "cracked.med"))
        self.assertIn("SKIN", out.groups)
        part = out.fields[0].steps[0].parts[0]
        rows = np.searchsorted(out.node_ids, part.ids)
        np.testing.assert_allclose(part.values[:, 0], 3 * out.points[rows, 0] + 1, atol=1e-9)

    def test_files_that_cannot_be_read(self):
        count = len(self.doc.Objects)
        bad = os.path.join(self.folder.name, "bad.inp")
        with open(bad, "w") as file:
            file.write("*NODE\n1, 0, 0\n*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n")
        with self.assertRaisesRegex(fs.ReadError, "bad.inp:4"):
            ObjectsFemScalpel.importMesh(self.doc, bad)
        with self.assertRaises(fs.ReadError):
            ObjectsFemScalpel.importMesh(self.doc, os.path.join(self.folder.name, "none.med"))
        self.assertEqual(len(self.doc.Objects), count)
