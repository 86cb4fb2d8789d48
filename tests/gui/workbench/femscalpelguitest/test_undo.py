# SPDX-License-Identifier: LGPL-2.1-or-later
"""Undo and redo by key presses: a chain of operations, and whatever order of steps."""

import contextlib
import os
import random
import re
from unittest import mock

import FreeCAD
import FreeCADGui
import ObjectsFem
from PySide import QtCore, QtGui

import femscalpel
import ObjectsFemScalpel
from femscalpelobjects.base import MeshOperation
from femscalpelobjects.memory import memory
from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest, QTest, spin, wait_until
from .mesh_content import content_of
from femscalpeltest.meshes import box_with_groups

CONTROL = QtCore.Qt.ControlModifier
#: Of steps at random.
SEED = int(os.environ.get("FEMSCALPEL_SEED", 14))
X = FreeCAD.Rotation(FreeCAD.Vector(0, 0, 1), FreeCAD.Vector(1, 0.1, 0.2))


def press_undo(wait=True):
    """Ctrl+Z; `wait`: once FreeCAD has seen that there is something to undo."""
    _press("Std_Undo", CONTROL, wait)


def press_redo(wait=True):
    """Ctrl+Shift+Z; `wait` as for press_undo()."""
    _press("Std_Redo", CONTROL | QtCore.Qt.ShiftModifier, wait)


def _press(command, modifiers, wait):
    window = FreeCADGui.getMainWindow()
    if wait:
        action = window.findChild(QtGui.QAction, command)
        wait_until(action.isEnabled, command)
    if QtGui.QApplication.activeWindow() is None:  # nobody activates it where there is no window manager
        window.activateWindow()
        wait_until(lambda: QtGui.QApplication.activeWindow() is not None, "the main window")
    QTest.keyClick(window, QtCore.Qt.Key_Z, modifiers)


@contextlib.contextmanager
def step(doc, name):
    """What is done is one step to undo, with the document computed at its end."""
    doc.openTransaction(name)
    yield
    doc.recompute()
    doc.commitTransaction()


@contextlib.contextmanager
def nothing_made():
    """Fails when a mesh is made meanwhile."""
    with mock.patch.object(MeshOperation, "result", side_effect=AssertionError("a mesh was made")):
        yield


class UndoTest(GuiTest):
    """A box in an analysis."""

    def setUp(self):
        super().setUp()
        self.mesh = self.add_mesh(box_with_groups())
        self.analysis = ObjectsFem.makeAnalysis(self.doc, "Analysis")
        self.analysis.addObject(self.mesh)
        self.doc.recompute()
        self.doc.clearUndos()
        FreeCADGui.getMainWindow().activateWindow()
        spin(0.1)

    def add_crack(self, source, at, into=True):
        """A crack of `source`, in its place in the analysis; one step."""
        with step(self.doc, f"Crack at {at}"):
            crack = ObjectsFemScalpel.makeCrack(
                self.doc, source, placement=FreeCAD.Placement(FreeCAD.Vector(at, 0, 0), X), group_name=f"AT{at * 10:g}"
            )
            self.doc.recompute()
            if into and crack.FemMesh.NodeCount:
                ObjectsFemScalpel.putIntoAnalysis(crack)
            source.ViewObject.Visibility = False
        return crack

    def move(self, crack, at):
        """Puts a crack elsewhere; one step."""
        with step(self.doc, f"Move to {at}"):
            crack.PlanePlacement = FreeCAD.Placement(FreeCAD.Vector(at, 0, 0), X)

    def state(self):
        """All that undo and redo have to bring back."""
        return {
            "in the analysis": [member.Name for member in self.analysis.Group],
            **{o.Name: self.state_of(o) for o in self.doc.Objects if o.isDerivedFrom("Fem::FemMeshObject")},
        }

    @staticmethod
    def state_of(obj):
        inputs = [name for name in ("PlanePlacement", "Transition", "GroupName", "Source") if hasattr(obj, name)]
        results = [name for name in obj.PropertiesList if obj.getGroupOfProperty(name) == "Result"]
        return {
            **{name: _without_times(str(getattr(obj, name))) for name in inputs + results},
            "error": "Invalid" in obj.State,
            "visibility": obj.ViewObject.Visibility,
            "mesh": content_of(obj),
        }

    def assertState(self, expected, what=""):
        state = self.state()
        self.assertEqual(state.keys(), expected.keys(), what)
        self.assertEqual(state.pop("in the analysis"), expected["in the analysis"], what)
        for name in state:
            for part, now in state[name].items():
                then = expected[name][part]
                self.assertTrue(now == then, f"{what}: {name}: its {part} {_difference(str(now), str(then))}")

    def assertUpToDate(self):
        made = [o for o in self.doc.Objects if o.isDerivedFrom("Fem::FemMeshObjectPython")]
        waiting = [o.Name for o in made if "Touched" in o.State]
        self.assertEqual(waiting, [])


def _difference(now, then):
    """Where two texts begin to differ."""
    at = len(os.path.commonprefix([now, then]))
    start = max(0, at - 60)
    return f"is now …{now[start : at + 200]}…, was …{then[start : at + 200]}…"


def _without_times(text):
    """A property as text, without how long it took: in the report's lines, and in its JSON."""
    return re.sub(r"seconds .*?'|\"seconds\": \{.*?\}", "", text, flags=re.DOTALL)


class Chain(UndoTest):
    def setUp(self):
        super().setUp()
        self.states = [self.state()]
        last = self.mesh
        for at in (1.3, 3.2, 4.7):
            last = self.add_crack(last, at)
            self.states.append(self.state())

    def test_undone_and_redone(self):
        with nothing_made():
            for expected in self.states[2::-1]:
                press_undo()
                self.assertState(expected, "undone")
                spin(2.1)  # longer than the times in FreeCAD's archives are coarse
                self.assertUpToDate()
            for expected in self.states[1:]:
                press_redo()
                self.assertState(expected, "redone")
                spin(0.1)
                self.assertUpToDate()
            self.doc.recompute()
        self.assertEqual(self.analysis.Group, [self.doc.Crack002])

    def test_all_at_once(self):
        for _ in range(3):
            press_undo()
        self.assertState(self.states[0])
        for _ in range(3):
            press_redo()
        self.assertState(self.states[3])

    def test_edit_of_the_first(self):
        self.move(self.doc.Crack, 1.7)
        edited = self.state()
        self.assertNotEqual(edited["Crack002"], self.states[3]["Crack002"])
        report = self.doc.Crack.Proxy.report
        with nothing_made():
            for _ in range(2):
                press_undo()
                self.assertState(self.states[3], "undone")
                self.assertUpToDate()
                press_redo()
                self.assertState(edited, "redone")
                self.assertUpToDate()
            self.assertIs(self.doc.Crack.Proxy.report, report)
            for expected in self.states[3::-1]:
                press_undo()
                self.assertState(expected, "undone")
            for expected in (*self.states[1:], edited):
                press_redo()
                self.assertState(expected, "redone")

    def test_next_operation_makes_one_mesh(self):
        self.move(self.doc.Crack, 1.7)
        press_undo()
        spin(0.1)
        with mock.patch.object(MeshOperation, "result", autospec=True, side_effect=MeshOperation.result) as made:
            self.add_crack(self.doc.Crack002, 5.3)
        self.assertEqual([call.args[1].Name for call in made.call_args_list], ["Crack003"])

    def test_edit_that_fails(self):
        self.move(self.doc.Crack001, 50)
        failed = self.state()
        self.assertIn("Invalid", self.doc.Crack001.State)
        self.assertEqual(failed["Crack002"]["mesh"][0], {}, "an outdated mesh is shown")
        with nothing_made():
            press_undo()
            self.assertState(self.states[3], "undone")
            self.assertUpToDate()
            press_redo()
            self.assertState(failed, "redone")
            press_undo()
            self.assertState(self.states[3], "undone")

    def test_errors_do_not_depend_on_the_order(self):
        """Of what fails, and what is made of that."""
        ends = []
        for order in (("Crack001", "Crack"), ("Crack", "Crack001")):
            for name in order:
                self.move(self.doc.getObject(name), 50)
            ends.append(self.state())
            with nothing_made():
                press_undo()
                press_redo()
                self.assertState(ends[-1], "undone and redone")
                for _ in range(2):
                    press_undo()
                self.assertState(self.states[3], "undone")
        self.assertEqual(*ends)

    def test_deleted(self):
        with step(self.doc, "Delete"):
            self.doc.removeObject("Crack002")
        self.assertEqual(self.analysis.Group, [])
        with nothing_made():
            press_undo()
            self.assertState(self.states[3])
            self.assertUpToDate()
            press_redo()
            self.assertIsNone(self.doc.getObject("Crack002"))
            press_undo()
        self.assertState(self.states[3])

    def test_source_deleted(self):
        with step(self.doc, "Delete"):
            self.doc.removeObject("Mesh")
        self.assertIn("Invalid", self.doc.Crack.State)
        with nothing_made():
            press_undo()
            self.assertState(self.states[3])

    def test_aborted(self):
        self.doc.openTransaction("Preview")
        self.doc.Crack.Transition = 3
        self.doc.recompute()
        with nothing_made():
            self.doc.abortTransaction()
            self.assertState(self.states[3])
            spin(0.1)
            self.assertUpToDate()

    def test_forgotten_is_made_again(self):
        self.move(self.doc.Crack, 1.7)
        memory.forget(self.doc)
        press_undo()
        press_redo()
        press_undo()
        wait_until(lambda: "Touched" not in self.doc.Crack002.State, "the meshes")
        self.assertState(self.states[3])
        self.assertEqual(self.doc.UndoNames[0], "Crack at 4.7")
        self.assertEqual(self.doc.RedoNames, ["Move to 1.7"])

    def test_not_made_again_in_a_transaction(self):
        self.move(self.doc.Crack, 1.7)
        memory.forget(self.doc)
        press_undo()
        self.doc.openTransaction("Another")
        self.mesh.Label = "Other"
        with nothing_made():
            spin(0.5)
        self.doc.commitTransaction()
        wait_until(lambda: "Touched" not in self.doc.Crack002.State, "the meshes")
        self.assertState(self.states[3])
        press_undo()
        self.assertEqual(self.mesh.Label, "Mesh")
        self.assertState(self.states[3])

    def test_two_documents(self):
        self.move(self.doc.Crack, 1.7)
        other = FreeCAD.newDocument("Other")
        other.UndoMode = 1
        mesh = other.addObject("Fem::FemMeshObject", "Mesh")
        mesh.FemMesh = self.mesh.FemMesh
        other.openTransaction("Crack")
        ObjectsFemScalpel.makeCrack(other, mesh, origin=(2, 0, 0), normal=(1, 0, 0))
        other.recompute()
        other.commitTransaction()
        before = content_of(other.Crack)
        FreeCAD.setActiveDocument(self.doc.Name)
        self.doc.undo()
        self.assertState(self.states[3])
        self.assertEqual(content_of(other.Crack), before)
        FreeCAD.closeDocument("Other")
        self.assertEqual(self.doc.UndoNames[0], "Crack at 4.7")
        with nothing_made():
            self.doc.redo()
            self.doc.undo()
        self.assertState(self.states[3])

    def test_key_while_computing(self):
        """FreeCAD handles shortcuts while it computes: they wait for the end."""
        pressed = []

        def crack(*args, **options):
            if not pressed:
                pressed.append(True)
                press_undo()
                spin(0)
                self.assertIsNotNone(self.doc.getObject("Crack003"), "undone while it is computed")
            return femscalpel_crack(*args, **options)

        femscalpel_crack = femscalpel.crack
        with mock.patch.object(femscalpel, "crack", crack):
            made = self.add_crack(self.doc.Crack002, 5.3)
            self.assertEqual(self.analysis.Group, [made])
        self.assertTrue(pressed)
        wait_until(lambda: self.doc.getObject("Crack003") is None, "what the key says")
        self.assertState(self.states[3])
        press_redo()
        self.assertEqual([o.Name for o in self.analysis.Group], ["Crack003"])


class AnyOrder(UndoTest):
    """Steps at random, as fast as they come; a document must be what it was when it was first there."""

    STEPS = 200

    def setUp(self):
        super().setUp()
        self.random = random.Random(SEED)
        self.states, self.now = [self.state()], 0  # what is there to undo and to redo, and where in it we are

    def cracks(self):
        return [o for o in self.doc.Objects if o.isDerivedFrom("Fem::FemMeshObjectPython")]

    def make(self):
        meshes = [self.mesh, *self.cracks()]
        ends = [m for m in meshes if not any(getattr(o, "Source", None) == m for o in meshes)]
        usable = [m for m in ends if m.FemMesh.NodeCount and "Invalid" not in m.State]
        if len(meshes) < 5 and usable:
            self.add_crack(
                usable[0], self.anywhere(), into=len(self.analysis.Group) == 1 and usable[0] in self.analysis.Group
            )
            return True

    def anywhere(self):
        return self.random.randint(5, 55) / 10

    def edit(self):
        if self.cracks():
            self.move(self.random.choice(self.cracks()), self.anywhere())
            return True

    def edit_beside(self):
        if self.cracks():
            self.move(self.random.choice(self.cracks()), 60)
            return True

    def delete(self):
        if self.cracks():
            with step(self.doc, "Delete"):
                self.doc.removeObject(self.random.choice(self.cracks()).Name)
            return True

    def rename(self):
        old = next(
            name for name in ("LEFT", "PORT") if name in map(self.mesh.FemMesh.getGroupName, self.mesh.FemMesh.Groups)
        )
        with step(self.doc, "Rename"):
            ObjectsFemScalpel.renameGroup(self.mesh, old, "PORT" if old == "LEFT" else "LEFT")
        return True

    def abort(self):
        if self.cracks():
            self.doc.openTransaction("Preview")
            self.random.choice(self.cracks()).Transition = self.random.randint(1, 5)
            self.doc.recompute()
            self.doc.abortTransaction()
            FreeCAD.closeActiveTransaction(True)
        return False

    def undo(self):
        before = set(self.doc.Objects)
        self.done.append("undo")
        self.press(press_undo, "UndoCount", -1)
        self.revived |= set(self.doc.Objects) - before

    def redo(self):
        self.done.append("redo")
        if self.press(press_redo, "RedoCount", 1):
            self.revived.clear()

    def press(self, key, count, step):
        """Presses it, mostly before FreeCAD has updated its buttons; returns whether that had an effect."""
        before = getattr(self.doc, count)
        if before:  # else FreeCAD 0.20.2 crashes
            key(wait=self.random.random() < 0.5)
            self.now += step * (before - getattr(self.doc, count))
        return getattr(self.doc, count) < before

    def do(self):
        # FreeCAD 0.20.2 keeps pointers to what undo has brought back until the next redo, and crashes then if it is
        # gone for good, as what is undone is with the next step.
        if not self.revived <= set(self.doc.Objects):
            return
        action = self.random.choice(self.actions)
        self.done.append(action.__name__)
        if action():
            del self.states[self.now + 1 :]
            self.states.append(self.state())
            self.now += 1

    def test_any_order(self):
        self.revived = set()
        self.actions = [self.make] * 5 + [self.edit] * 3 + [self.edit_beside, self.delete, self.rename, self.abort]
        self.done = []  # what was done, for messages
        steps = 0
        while steps < self.STEPS:
            for _ in range(self.random.randint(1, 4)):  # before the window has time
                self.random.choices((self.undo, self.redo, self.do), (35, 25, 40))[0]()
                steps += 1
            if self.random.random() < 0.5:
                spin(0)
            what = f"seed {SEED}, after {steps} steps, the last {', '.join(self.done[-12:])}"
            self.assertState(self.states[self.now], f"{what}; to undo {self.doc.UndoNames}, redo {self.doc.RedoNames}")
        spin(0.2)
        self.assertState(self.states[self.now], "at the end")
