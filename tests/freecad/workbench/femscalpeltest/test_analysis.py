# SPDX-License-Identifier: LGPL-2.1-or-later
"""A cracked mesh in a FEM analysis: loads, supports and materials, undo, results."""

import os
import re

import FreeCAD
import numpy as np
import ObjectsFem
import Part

import femmesh_bridge
import femscalpel as fs
import ObjectsFemScalpel
from femscalpelobjects.analysis import _is_doubled

from .ccx_deck import Deck
from .documents import DocumentTest, geometry_link, need, set_value, solver_of


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
        set_value(force, "Force", self.LOAD, "N")
        force.Direction = (self.box, ["Edge1"])
        self.analysis.addObject(force)
        self.doc.recompute()
        self.crack = ObjectsFemScalpel.makeCrack(self.doc, self.source, origin=(4100, 500, 500), normal=(1, 0.1, 0.05))
        self.doc.recompute()

    def tools(self):
        from femtools import ccxtools

        tools = ccxtools.FemToolsCcx(self.analysis, solver_of(self.doc))
        tools.update_objects()
        tools.setup_working_dir(self.folder.name)
        return tools

    def write(self):
        """The deck FreeCAD writes for CalculiX."""
        tools = self.tools()
        tools.write_inp_file()
        with open(tools.inp_file_name) as deck:
            return deck.read()

    def solve(self):
        """Runs CalculiX as FreeCAD does; returns the deck and the printed results as text."""
        need("ccx", "CalculiX")
        tools = self.tools()
        tools.setup_ccx()
        self.assertEqual(tools.check_prerequisites(), "")
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
        self.assertEqual(getattr(self.crack, geometry_link(self.source)), self.box)
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

    def test_groups_of_materials_and_loads_are_used(self):
        femmesh = self.source.FemMesh.copy()
        right = sorted(n for n, p in femmesh.Nodes.items() if p.x == 8000)
        femmesh.addGroupElements(femmesh.addGroup("Pressure_Nodes", "Node"), right)
        femmesh.addGroupElements(femmesh.addGroup("FemMaterial_Volumes", "Volume"), list(femmesh.Volumes))
        pressure = ObjectsFem.makeConstraintPressure(self.doc, "Pressure")
        pressure.References = [(self.box, "Face6")]  # the group says otherwise, and comes first
        set_value(pressure, "Pressure", 1000, "MPa")
        self.analysis.addObject(pressure)
        self.source.FemMesh = femmesh
        self.crack.PlanePlacement = FreeCAD.Placement(FreeCAD.Vector(4000, 500, 400), FreeCAD.Rotation(3, 4, 0))
        before = Deck(self.write())
        self.doc.recompute()
        ObjectsFemScalpel.putIntoAnalysis(self.crack)
        after = Deck(self.write())
        nodes = after.nodes("ConstraintFixed")
        there = [n for n, p in self.crack.FemMesh.Nodes.items() if p.x == 8000]
        self.assertGreater(len(there), len(right), "the crack does not cross the loaded face")
        total = [sum(deck.forces().values()) for deck in (before, after)]
        np.testing.assert_allclose(total[0], (-1e3 * 1e6, 0, 0) + self.loads(self.write()), rtol=1e-9, atol=1e-3)
        np.testing.assert_allclose(total[1], total[0], rtol=1e-9, atol=1e-3)
        self.assertEqual({e for e, (kind, _) in after.elements.items()}, set(self.crack.FemMesh.Volumes))
        self.assertTrue(nodes)

    def test_one_step_to_undo(self):
        self.doc.UndoMode = 1
        before = self.analysis.Group
        for act in (ObjectsFemScalpel.putIntoAnalysis, ObjectsFemScalpel.takeOutOfAnalysis):
            steps = self.doc.UndoCount
            act(self.crack)
            after = self.analysis.Group
            self.assertEqual(self.doc.UndoCount, steps + 1)
            self.assertIn(self.crack.Label, self.doc.UndoNames[0])
            self.doc.undo()
            self.assertEqual(self.analysis.Group, before)
            self.doc.redo()
            self.assertEqual(self.analysis.Group, after)
            before = after
        self.assertIn(self.source, self.analysis.Group)
        self.assertNotIn(self.crack, self.analysis.Group)

    def test_part_of_an_open_transaction(self):
        self.doc.UndoMode = 1
        self.doc.openTransaction("all of it")
        crack = ObjectsFemScalpel.makeCrack(self.doc, self.source, origin=(3000, 500, 500), normal=(1, 0, 0))
        ObjectsFemScalpel.putIntoAnalysis(crack)
        self.doc.commitTransaction()
        self.assertEqual(self.doc.UndoNames, ["all of it"])
        self.assertIn(crack, self.analysis.Group)
        self.doc.undo()
        self.assertIn(self.source, self.analysis.Group)
        self.assertIsNone(self.doc.getObject("Crack001"))

    def test_refused_without_a_trace(self):
        self.doc.UndoMode = 1
        self.crack.PlanePlacement = FreeCAD.Placement(FreeCAD.Vector(0, 0, 5000), FreeCAD.Rotation())
        self.doc.recompute()
        group, steps = self.analysis.Group, self.doc.UndoCount
        with self.assertRaisesRegex(ValueError, "has no mesh"):
            ObjectsFemScalpel.putIntoAnalysis(self.crack)
        self.assertEqual((self.analysis.Group, self.doc.UndoCount), (group, steps))

    def test_chain(self):
        second = ObjectsFemScalpel.makeCrack(
            self.doc, self.crack, "Second", origin=(2000, 500, 500), normal=(1, 0, 0.1), group_name="SECOND"
        )
        third = ObjectsFemScalpel.makeCrack(
            self.doc, second, "Third", origin=(6000, 500, 500), normal=(1, 0.1, 0), group_name="THIRD"
        )
        ObjectsFemScalpel.putIntoAnalysis(third)  # not recomputed yet
        self.assertGreater(third.FemMesh.NodeCount, second.FemMesh.NodeCount)
        self.assertEqual([m for m in self.analysis.Group if m.isDerivedFrom("Fem::FemMeshObject")], [third])
        ObjectsFemScalpel.takeOutOfAnalysis(third)
        self.assertEqual([m for m in self.analysis.Group if m.isDerivedFrom("Fem::FemMeshObject")], [self.source])
        ObjectsFemScalpel.putIntoAnalysis(self.crack)
        ObjectsFemScalpel.putIntoAnalysis(third)
        ObjectsFemScalpel.takeOutOfAnalysis(third)
        self.assertEqual([m for m in self.analysis.Group if m.isDerivedFrom("Fem::FemMeshObject")], [self.crack])

    def results(self):
        return [m for m in self.analysis.Group if m.isDerivedFrom("Fem::FemResultObject")]

    def test_results_of_the_old_mesh_go(self):
        self.solve()
        self.assertEqual(len(self.results()), 1)
        self.doc.UndoMode = 1
        ObjectsFemScalpel.putIntoAnalysis(self.crack)
        self.assertEqual(self.results(), [])
        self.assertFalse([o for o in self.doc.Objects if "ResultMesh" in o.Name])
        self.doc.undo()
        self.assertEqual(len(self.results()), 1)
        self.assertEqual(self.results()[0].Mesh.FemMesh.NodeCount, self.source.FemMesh.NodeCount)
        self.assertIn(self.source, self.analysis.Group)

    def test_results_that_the_user_wants_to_keep_say_of_what(self):
        settings = FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/Fem/General")
        self.solve()
        settings.SetBool("KeepResultsOnReRun", True)
        try:
            ObjectsFemScalpel.putIntoAnalysis(self.crack)
        finally:
            settings.RemBool("KeepResultsOnReRun")
        self.assertEqual([r.Label.endswith(f"(of {self.source.Label})") for r in self.results()], [True])

    def test_a_load_on_a_doubled_vertex_is_refused(self):
        # FreeCAD writes no force at all for a vertex with two nodes.
        force = ObjectsFem.makeConstraintForce(self.doc, "AtCorner")
        force.References = [(self.box, ("Vertex5", "Vertex8"))]
        set_value(force, "Force", 1000, "N")
        force.Direction = (self.box, ["Edge1"])
        self.analysis.addObject(force)
        points = [self.box.Shape.getElement(name).Point for name in ("Vertex5", "Vertex8")]
        self.crack.PlanePlacement = FreeCAD.Placement(
            points[0],
            FreeCAD.Rotation(
                FreeCAD.Vector(0, 0, 1),
                FreeCAD.Vector(0.3, 0, 0) + (points[1] - points[0]).cross(FreeCAD.Vector(1, 0, 0)).normalize(),
            ),
        )
        self.doc.recompute()
        with self.assertRaisesRegex(ValueError, "doubles Box.Vertex"):
            ObjectsFemScalpel.putIntoAnalysis(self.crack)
        self.assertIn(self.source, self.analysis.Group)
        ObjectsFemScalpel.putIntoAnalysis(self.crack, strict=False)
        self.assertIn(self.crack, self.analysis.Group)
        lines = [line for line in self.write().splitlines() if line.startswith("** node load on shape")]
        self.assertEqual(lines, [], "FreeCAD has learnt to load such vertices; the check is not needed any more")

    def test_a_load_on_a_doubled_edge_is_found(self):
        points = [[x, y, 0] for x in range(7) for y in range(6)]
        quads = [(6 * x + y, 6 * x + y + 6, 6 * x + y + 7, 6 * x + y + 1) for x in range(6) for y in range(5)]
        shell = fs.Mesh(points, {"triangle": [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]})
        cracked = femmesh_bridge.to_femmesh(fs.crack(shell, fs.Plane((3, 0, 0), (1, 0, 0))).mesh)
        along = Part.makeLine(FreeCAD.Vector(3, 0, 0), FreeCAD.Vector(3, 5, 0))
        across = Part.makeLine(FreeCAD.Vector(0, 2, 0), FreeCAD.Vector(6, 2, 0))
        self.assertTrue(_is_doubled(cracked, along))
        self.assertFalse(_is_doubled(cracked, across))
        self.assertFalse(_is_doubled(femmesh_bridge.to_femmesh(shell), along))

    def test_a_name_freecad_would_take_for_a_constraints(self):
        self.crack.GroupName = "ConstraintFixed"
        self.doc.recompute()
        self.assertIn("Invalid", self.crack.State)
        with self.assertRaisesRegex(RuntimeError, "would be taken for the nodes of 'ConstraintFixed'"):
            self.crack.Proxy.execute(self.crack)

    def test_vertices_the_analysis_refers_to_keep_their_nodes(self):
        # On a straight edge and on a flat face, where nodes are free to move. Corner nodes, as meshers make at
        # vertices.
        femmesh = self.source.FemMesh
        corners = {n for v in femmesh.Volumes for n in femmesh.getElementNodes(v)[:4]}
        points = {
            n: femmesh.Nodes[n] for n in corners if femmesh.Nodes[n].z == 1000 and 3000 < femmesh.Nodes[n].x < 5200
        }
        self.assertGreater(len(points), 1)
        vertices = self.doc.addObject("Part::Feature", "Points")
        vertices.Shape = Part.makeCompound([Part.Vertex(p) for p in points.values()])
        fixed = ObjectsFem.makeConstraintFixed(self.doc, "AtPoints")
        fixed.References = [(vertices, tuple(f"Vertex{i + 1}" for i in range(len(points))))]
        self.analysis.addObject(fixed)
        self.crack.touch()
        self.doc.recompute()
        kept = self.crack.FemMesh.Nodes
        self.assertEqual({n: tuple(kept[n]) for n in points}, {n: tuple(p) for n, p in points.items()})
        ObjectsFemScalpel.putIntoAnalysis(self.crack)
        # A constraint made afterwards is not known to the crack, but checked.
        ObjectsFemScalpel.takeOutOfAnalysis(self.crack)
        self.crack.PlanePlacement = FreeCAD.Placement(FreeCAD.Vector(4000, 0, 0), FreeCAD.Rotation(0, 90, 0))
        self.analysis.removeObject(fixed)
        self.doc.recompute()
        moved = [n for n, p in points.items() if tuple(self.crack.FemMesh.Nodes[n]) != tuple(p)]
        self.analysis.addObject(fixed)
        if moved:
            with self.assertRaisesRegex(ValueError, "has no node at Points.Vertex"):
                ObjectsFemScalpel.putIntoAnalysis(self.crack)
