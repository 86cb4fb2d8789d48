# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is computed while nobody does anything is not computed again on OK, and is never another mesh than OK's own."""

import threading
from unittest import mock

import FreeCAD
import FreeCADGui
import femmesh_bridge
from femscalpelobjects.base import MeshOperation
from femscalpelobjects.memory import memory
from femscalpelobjects.stand_in import StandIn
from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest
from .mesh_content import content_of
from femscalpeltest.meshes import grid_box
from .test_crack_panel import long_box

_RESULTS = (
    "NodesAdded",
    "NodesDoubled",
    "NodesMoved",
    "MinimumQuality",
    "MaxDisplacement",
    "Warnings",
    "NodeSetCounts",
)


class Foresight(GuiTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.add_mesh(long_box())
        self.ahead, self.later = [], []  # what was computed for stand-ins, and for objects
        compute = MeshOperation._compute

        def recorded(operation, obj, *arguments):
            made = compute(operation, obj, *arguments)
            (self.ahead if isinstance(obj, StandIn) else self.later).append(made)
            return made

        patch = mock.patch.object(MeshOperation, "_compute", recorded)
        patch.start()
        self.addCleanup(patch.stop)

    def open_panel(self, command):
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(self.doc.Name, "Mesh")
        self.run_command(command)
        wait_until(is_settled, "the panel")

    def wait_until_foreseen(self):
        self.wait_for_preview()
        wait_until(lambda: self.ahead, "what is computed ahead")
        spin(0.1)

    def check(self, obj):
        """The object has what was computed ahead, which is what it computes itself."""
        self.assertEqual(self.later, [], "computed again")
        self.assertEqual(len(self.ahead), 1)
        content, results = content_of(obj), [getattr(obj, name) for name in _RESULTS]
        memory.forget(self.doc)
        obj.Proxy.shown = None
        obj.touch()
        self.doc.recompute()
        self.assertEqual(len(self.later), 1)
        self.assertEqual([getattr(obj, name) for name in _RESULTS], results)
        self.assertTrue(content_of(obj) == content, "another mesh")  # assertEqual() would look for the difference
        self.doc.undo()
        self.ahead.clear()
        self.later.clear()

    def test_every_operation(self):
        boss = self.add_mesh(grid_box((3, 3, 2), (3.0, 3.0, 2.0)), "Boss")
        boss.Placement.Base = FreeCAD.Vector(5.2, 1.1, 4)
        self.doc.recompute()
        self.doc.clearUndos()
        for name, command, enter in (
            ("Crack", "Crack", lambda: None),
            ("Crack", "Crack", lambda: choose("patch", "Whole")),
            ("Crack", "Crack", self.ellipse),
            ("Crack", "Crack", self.tilted),
            ("Drill", "Drill", lambda: click("through")),
            ("Incision", "Incision", lambda: choose("slotEnd", "Point")),
            ("CylindricalCrack", "CylindricalCrack", self.part_of_a_cylinder),
            ("CurvedCrack", "CurvedCrack", lambda: choose("toolShape", "Sphere")),
            ("Refine", "Refine", lambda: type_into("edgeSize", "0.4 mm")),
            ("Reshape", "Reshape", self.move),
            ("Merge", "Merge", lambda: None),
        ):
            with self.subTest(command=command, enter=enter):
                self.open_panel("FemScalpel_" + command)
                enter()
                self.wait_until_foreseen()
                press_ok()
                self.check(self.doc.getObject(name))

    def ellipse(self):
        choose("patch", "Ellipse")
        type_into("patchTurn", "25 deg")

    def tilted(self):
        choose("patch", "Whole")
        for name, text in (("normalX", "1"), ("normalY", "0.31"), ("normalZ", "-0.17"), ("originX", "6.123")):
            type_into(name, text)

    def part_of_a_cylinder(self):
        numbers = (
            ("normalX", "0"),
            ("normalZ", "1"),
            ("radius", "1.4 mm"),
            ("partStart", "20 deg"),
            ("partEnd", "150"),
        )
        click("bounded")
        for name, text in numbers:
            type_into(name, text)

    def move(self):
        choose("wall", "TOP")
        wait_until(is_settled, "what is said of the wall")
        choose("motion", "By")
        wait_until(is_settled, "what is said of the motion")
        type_into("vectorZ", "0.2 mm")

    def test_of_an_edited_object(self):
        self.open_panel("FemScalpel_Drill")
        self.wait_until_foreseen()
        press_ok()
        self.ahead.clear()
        drill = self.doc.Drill
        first = content_of(drill)
        drill.ViewObject.doubleClicked()
        self.wait_for_preview()
        spin(1)
        self.assertEqual(self.ahead, [])  # it is remembered
        type_into("radius", "1.1 mm")
        self.wait_until_foreseen()
        press_ok()
        self.assertFalse(content_of(drill) == first)
        self.check(drill)

    def test_ended_by_a_change(self):
        going, go = threading.Event(), threading.Event()
        to_femmesh = femmesh_bridge.to_femmesh

        def slow(mesh, groups, points, into, progress, tell):
            if not go.is_set():
                going.set()
                while not go.wait(0.01):
                    progress(0.5)  # raises
            return to_femmesh(mesh, groups, points, into, progress, tell)

        self.addCleanup(go.set)
        with mock.patch.object(femmesh_bridge, "to_femmesh", slow):
            self.open_panel("FemScalpel_Drill")
            wait_until(going.is_set, "what is computed ahead")
            type_into("radius", "1.1 mm")
            self.wait_for_preview()  # not held up
            self.assertEqual(self.ahead, [])
            go.set()
            self.wait_until_foreseen()
            press_ok()
        self.assertEqual(self.doc.Drill.Radius.Value, 1.1)
        self.check(self.doc.Drill)

    def test_ok_waits_for_what_is_on_its_way(self):
        going, to_femmesh = threading.Event(), femmesh_bridge.to_femmesh

        def slow(mesh, groups, points, into, progress, tell):
            going.set()
            for _ in range(100):
                time.sleep(0.01)
                progress(0.5)
            return to_femmesh(mesh, groups, points, into, progress, tell)

        with mock.patch.object(femmesh_bridge, "to_femmesh", slow):
            self.open_panel("FemScalpel_Drill")
            wait_until(going.is_set, "what is computed ahead")
            press_ok()
        wait_until(lambda: self.doc.getObject("Drill") is not None, "the object")
        self.check(self.doc.Drill)

    def test_not_taken_when_the_mesh_is_another_one(self):
        self.open_panel("FemScalpel_Drill")
        self.wait_until_foreseen()
        femmesh = self.mesh.FemMesh.copy()
        femmesh.addGroup("LATE", "Node")
        femmesh.addGroupElements(max(femmesh.Groups), list(femmesh.Nodes)[:5])
        self.mesh.FemMesh = femmesh
        press_ok()
        self.assertEqual(len(self.later), 1)
        mesh = self.doc.Drill.FemMesh
        self.assertIn("LATE", [mesh.getGroupName(group) for group in mesh.Groups])
