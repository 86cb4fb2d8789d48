# SPDX-License-Identifier: LGPL-2.1-or-later
"""How long FreeCAD's window does not answer, and whether it says why: while panels open, OK, undo and redo make meshes,
and a mesh is exported.

    /usr/bin/python3 tests/gui/run_gui_tests.py --freecad freecad --workbench build/release/Mod/FemScalpel \\
        --screenshots build/signs_of_life --script tests/bench/signs_of_life.py 10000 300000 10000q 300000q

Names are numbers of tetrahedra, with a q of second order. Prints for each step how long it took, the longest time
without an answer, and the longest of those without a sign: neither a message that ends in an ellipsis, nor a progress
dialog, nor the wait cursor was there when it began or within a fifth of a second.
"""

import os
import tempfile
import time
import traceback

from PySide import QtCore, QtGui

_SIGN_WITHIN = 0.2  # seconds


class Beats:
    """Beats of a timer in the window's thread, and the times at which a sign was shown."""

    def __init__(self):
        from femscalpelgui import signs

        self._timer = QtCore.QTimer()
        self._timer.timeout.connect(self._beat)
        self._signed = []
        begin = signs.begin

        def noted(text):
            self._signed.append(time.perf_counter())
            begin(text)

        signs.begin = noted

    def _beat(self):
        now = time.perf_counter()
        self._gaps.append((self._last, now, self._had_sign))
        self._last, self._had_sign = now, has_sign()

    def start(self):
        self._gaps, self._last, self._had_sign = [], time.perf_counter(), has_sign()
        self._timer.start(5)

    def stop(self):
        self._beat()
        self._timer.stop()

    def longest(self, silent=False):
        """The longest time between two beats; `silent`: of those without a sign."""
        gaps = [g for g in self._gaps if not (silent and self._is_signed(*g))]
        return max((end - begin for begin, end, _ in gaps), default=0.0)

    def _is_signed(self, begin, end, had_sign):
        return had_sign or any(begin <= at <= begin + _SIGN_WITHIN for at in self._signed)


def has_sign():
    """Whether the window says that something is being done."""
    import FreeCADGui

    app, bar = QtGui.QApplication, FreeCADGui.getMainWindow().statusBar()
    return (
        app.overrideCursor() is not None
        or app.activeModalWidget() is not None
        or bar.currentMessage().endswith(("…", "%"))
        or any(b.isVisible() for b in bar.findChildren(QtGui.QProgressBar))
    )


def mesh_of(name):
    """A box of about so many tetrahedra, linear or ("q") of second order."""
    from femscalpeltest.meshes import grid_box

    n = round((int(name.rstrip("q")) / 6 / 2) ** (1 / 3))
    plain = grid_box((2 * n, n, n), (14.0, 7.0, 7.0))
    return second_order(plain) if name.endswith("q") else plain


def second_order(plain):
    """A mesh of linear tetrahedra with nodes in the middle of its edges."""
    import femscalpel
    import numpy as np

    tetra = np.searchsorted(plain.node_ids, plain.cells["tetra"])
    if (plain.node_ids[tetra] != plain.cells["tetra"]).any():
        tetra = np.asarray(plain.cells["tetra"])
    pairs = np.sort(tetra[:, [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]]], axis=2)
    edges, where = np.unique(pairs.reshape(-1, 2), axis=0, return_inverse=True)
    points = np.concatenate([plain.points, plain.points[edges].mean(axis=1)])
    return femscalpel.Mesh(points, {"tetra10": np.hstack([tetra, len(plain.points) + where.reshape(-1, 6)])})


def measure(name, beats, out):
    import femmesh_bridge
    import FreeCAD
    import FreeCADGui
    from femscalpelguitest.gui_testing import is_settled, press_cancel, press_ok, spin, view
    from femscalpelguitest.test_undo import press_redo, press_undo
    from femscalpelgui.commands.export import Export

    mesh = mesh_of(name)
    document = FreeCAD.newDocument("Signs")
    document.UndoMode = 1
    source = document.addObject("Fem::FemMeshObject", "Mesh")
    source.FemMesh = femmesh_bridge.to_femmesh(mesh)
    document.recompute()
    document.clearUndos()
    view().viewIsometric()
    view().fitAll()
    spin(1)
    print(f"{name}: {mesh.cell_count} elements, {mesh.node_count} nodes", file=out)

    def timed(what, step, until=lambda: True):
        spin(0.3)
        beats.start()
        begin = time.perf_counter()
        step()
        wait(until)
        spin(0.05)
        seconds = time.perf_counter() - begin
        beats.stop()
        print(
            f"  {what:<28} {seconds:6.2f} s; no answer for {beats.longest():5.2f} s, without a sign "
            f"{beats.longest(silent=True):5.2f} s",
            file=out,
        )

    def move(obj):
        document.openTransaction("Move")
        obj.PlanePlacement = FreeCAD.Placement(FreeCAD.Vector(5, 3, 3), obj.PlanePlacement.Rotation)
        document.recompute()
        document.commitTransaction()

    def wait(until):
        loop, timer = QtCore.QEventLoop(), QtCore.QTimer()
        timer.timeout.connect(lambda: until() and loop.quit())
        timer.start(10)
        getattr(loop, "exec_", getattr(loop, "exec", None))()
        timer.stop()

    def is_free():
        return not FreeCADGui.Control.activeDialog()

    FreeCADGui.Selection.addSelection(document.Name, source.Name)
    timed("opening the panel", lambda: FreeCADGui.runCommand("FemScalpel_Crack"), lambda: _safe(is_settled))
    timed("OK", press_ok, is_free)
    timed("undo", press_undo, lambda: document.getObject("Crack") is None)
    timed("redo", press_redo, lambda: document.getObject("Crack") is not None)
    move(document.Crack)
    timed("undo of an edit", press_undo, lambda: document.RedoCount > 0)
    timed("redo of an edit", press_redo, lambda: document.RedoCount == 0)
    timed(
        "opening it to edit",
        lambda: FreeCADGui.getDocument(document.Name).setEdit("Crack"),
        lambda: _safe(is_settled),
    )
    timed("cancel", press_cancel, is_free)
    with tempfile.TemporaryDirectory() as folder:
        for ending in (".inp", ".med"):
            timed(f"export {ending}", lambda: Export.write(document.Crack, os.path.join(folder, "mesh" + ending)))
    for command in ("FemScalpel_GroupInspector", "FemScalpel_MeshQuality"):
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(document.Name, "Crack")
        timed(command.split("_")[1], lambda: FreeCADGui.runCommand(command), lambda: _safe(_inspected))
        FreeCADGui.Control.activeDialog() and _close()
    FreeCAD.closeDocument(document.Name)
    spin(0.5)


def _inspected():
    from femscalpelguitest.gui_testing import widget

    return "…" not in widget("status").text()


def _close():
    from femscalpelguitest.gui_testing import press_button

    press_button(QtGui.QDialogButtonBox.Close)


def _safe(condition):
    try:
        return condition()
    except AssertionError:
        return False


def run():
    code = 1
    with open(os.environ["FEMSCALPEL_TEST_RESULT"], "w", buffering=1) as out:
        try:
            import FreeCADGui

            FreeCADGui.activateWorkbench("FemScalpelWorkbench")
            from femscalpelguitest.gui_testing import without_start_page

            without_start_page()
            beats, names = Beats(), os.environ["FEMSCALPEL_TESTS"].split()
            for name in names:
                measure(name, beats, out)
            # What run_gui_tests.py looks for.
            print(f"Ran {len(names)} tests in FreeCAD\nOK", file=out)
            code = 0
        except BaseException:
            traceback.print_exc(file=out)
    os._exit(code)


QtCore.QTimer.singleShot(500, run)
