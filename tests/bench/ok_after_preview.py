# SPDX-License-Identifier: LGPL-2.1-or-later
"""Times OK of the crack panel after its preview, in FreeCAD's window: from the click until the panel is gone and the
result is drawn.

    /usr/bin/python3 tests/gui/run_gui_tests.py --freecad freecad --workbench build/release/Mod/FemScalpel \\
        --screenshots build/ok_after_preview --script tests/bench/ok_after_preview.py 10000 300000

Names are numbers of tetrahedra. Once OK is clicked as soon as the preview is there, once three seconds later, as after
a look at it. Of the whole it says what went into FreeCAD's own calls: filling a FemMesh, giving it to the object (which
makes FreeCAD's picture of it), and drawing that; and the longest time that the window did not answer before OK.
"""

import os
import time
import traceback

from PySide import QtCore

_LOOK = 3.0  # seconds


class Times:
    """Seconds spent in functions, by what they do."""

    def __init__(self):
        self.spent = {}

    def watch(self, owner, name, what):
        function = getattr(owner, name)

        def timed(*args, **keywords):
            begin = time.perf_counter()
            try:
                return function(*args, **keywords)
            finally:
                self.spent[what] = self.spent.get(what, 0.0) + time.perf_counter() - begin

        setattr(owner, name, timed)


def box(elements):
    """About so many tetrahedra in a box."""
    from femscalpeltest.meshes import grid_box

    n = round((elements / 6 / 2) ** (1 / 3))
    return grid_box((2 * n, n, n), (14.0, 7.0, 7.0))


def measure(elements, times, out):
    import FreeCAD
    import FreeCADGui
    import femmesh_bridge
    from femscalpelguitest.gui_testing import is_settled, press_ok, spin, view, wait_until

    mesh = box(elements)
    for look in (0.0, _LOOK):
        document = FreeCAD.newDocument("Ok")
        document.UndoMode = 1
        source = document.addObject("Fem::FemMeshObject", "Mesh")
        source.FemMesh = femmesh_bridge.to_femmesh(mesh)
        document.recompute()
        view().viewIsometric()
        view().fitAll()
        spin(0.5)
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(document.Name, source.Name)
        FreeCADGui.runCommand("FemScalpel_Crack")
        wait_until(is_settled, "the preview")
        longest = wait(look)
        times.spent.clear()
        begin = time.perf_counter()
        press_ok()
        wait_until(lambda: not FreeCADGui.Control.activeDialog(), "the end of the panel")
        ended = time.perf_counter()
        FreeCADGui.updateGui()
        end = time.perf_counter()
        parts = {**times.spent, "drawing it": end - ended}
        print(
            f"{mesh.cell_count} elements, OK {look:.0f} s after the preview: {end - begin:.2f} s ("
            + ", ".join(f"{what} {seconds:.2f}" for what, seconds in parts.items())
            + f"); before it the window was busy at most {longest:.2f} s at a time",
            file=out,
        )
        if document.Crack.NodesDoubled == 0:
            raise RuntimeError("the crack object has no crack")
        FreeCAD.closeDocument(document.Name)
        spin(0.5)


def wait(seconds):
    """Lets the window work as it does when nobody does anything; the longest time between two beats of a timer."""
    beats, loop, timer = [time.perf_counter()], QtCore.QEventLoop(), QtCore.QTimer()
    timer.timeout.connect(lambda: beats.append(time.perf_counter()))
    timer.start(10)
    QtCore.QTimer.singleShot(round(1000 * seconds), loop.quit)
    getattr(loop, "exec_", getattr(loop, "exec", None))()
    timer.stop()
    return max([b - a for a, b in zip(beats, beats[1:])], default=0.0)


def run():
    code = 1
    with open(os.environ["FEMSCALPEL_TEST_RESULT"], "w", buffering=1) as out:
        try:
            import FreeCADGui

            FreeCADGui.activateWorkbench("FemScalpelWorkbench")
            import femmesh_bridge
            from femscalpelobjects.base import MeshOperation

            times = Times()
            times.watch(MeshOperation, "result", "engine")
            times.watch(femmesh_bridge, "to_femmesh", "filling a FemMesh")
            times.watch(MeshOperation, "_set_mesh", "giving it to the object")
            names = os.environ["FEMSCALPEL_TESTS"].split()
            for name in names:
                measure(int(name), times, out)
            # What run_gui_tests.py looks for.
            print(f"Ran {len(names)} tests in FreeCAD\nOK", file=out)
            code = 0
        except BaseException:
            traceback.print_exc(file=out)
    os._exit(code)


QtCore.QTimer.singleShot(500, run)
