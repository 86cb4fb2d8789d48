# SPDX-License-Identifier: LGPL-2.1-or-later
"""What refining first costs is said before it is done, and asked above a limit."""

import math
import threading
import time
from unittest import mock

import FreeCAD

import femscalpel as fs
from femscalpelgui import latest_wins, preferences, refinement_guard
from femscalpelgui.panels.tool_panel import ToolPanel
from .gui_testing import *  # noqa: F403
from .test_crack_panel import CrackTest


def ok_button():
    return next(b.button(QtGui.QDialogButtonBox.Ok) for b in button_boxes() if b.button(QtGui.QDialogButtonBox.Ok))


def wait_for_question(size):
    """Until it is asked about that edge length, not about what was entered before."""
    wait_until(
        lambda: widget("refinementQuestion").isEnabled() and f" {size} " in widget("refinementCost").text(),
        "the question",
    )


class RefinementCost(CrackTest):
    def setUp(self):
        super().setUp()
        self.group = FreeCAD.ParamGet(preferences.GROUP)
        self.addCleanup(self.group.RemInt, "MostElements")
        self.addCleanup(self.group.RemInt, "MostMemory")

    def open_half_plane(self):
        self.run_command("FemScalpel_Crack")
        self.wait_for_preview()

    def test_a_small_disk_takes_few_elements(self):
        """The elements behind a disk stay as they are, however small it is."""
        self.open_half_plane()
        choose("patch", "Disk")
        begin = time.monotonic()
        with mock.patch.object(ToolPanel, "finished", autospec=True, side_effect=ToolPanel.finished) as finished:
            type_into("patchRadius", "0.02 mm")
            wait_until(lambda: any(abs(self.radius_of(c) - 0.01) < 1e-9 for c in finished.call_args_list), "the disk")
        self.assertLess(time.monotonic() - begin, 10)
        refinement = finished.call_args_list[-1].args[2].result.report.refinement
        self.assertLess(refinement.elements_after, refinement.elements_before + 12000)

    @staticmethod
    def radius_of(call):
        refinement = call.args[2].result.report.refinement
        return refinement.size if refinement else math.inf

    def test_said_before_it_is_done(self):
        self.open_half_plane()
        with mock.patch.object(ToolPanel, "_say_refining", autospec=True, side_effect=ToolPanel._say_refining) as said:
            choose("refine", "Size")
            type_into("refineSize", "0.2 mm")
            wait_until(lambda: said.call_args_list and said.call_args_list[-1].args[1].size == 0.2, "what it costs")
            text = widget("status").text()
            cost = said.call_args_list[-1].args[1]
            self.wait_for_preview()
            wait_until(lambda: not text or widget("status").text()[:1].isdigit(), "the preview")
        panel = said.call_args_list[-1].args[0]
        wait_until(lambda: panel.shown and panel.shown.result.report.refinement.size == 0.2, "the result")
        made = panel.shown.result.report.refinement.elements_after
        self.assertLess(abs(cost.elements - made), 0.3 * made)
        press_cancel()

    def test_asked_above_the_limit(self):
        self.group.SetInt("MostElements", 6000)
        self.open_half_plane()
        with mock.patch.object(fs.Mesh, "_wrap", side_effect=fs.Mesh._wrap) as made:
            choose("refine", "Size")
            type_into("refineSize", "0.03 mm")
            wait_for_question("30.00")
            text = widget("refinementCost").text()
            count = made.call_count
        self.assertRegex(text, r"30.00.*elements \(\d+ [MG]B\)")
        self.assertFalse(ok_button().isEnabled())
        box = widget("refinementQuestion")
        # It is not scrolled out of sight.
        wait_until(lambda: box.visibleRegion().boundingRect().height() == box.height(), "the whole question")
        self.assertIn("question", widget("status").text())
        self.assertFalse(is_shown("resultError"))
        screenshot("refinement_question")
        spin(0.3)
        self.assertEqual(made.call_count, count)  # nothing is computed before it is agreed to
        self.assertRegex(widget("refineFitting").text(), r"0\.\d+ mm")
        click("refineFitting")
        self.wait_for_preview()
        self.assertFalse(is_shown("refinementQuestion"))
        self.assertGreater(value("refineSize"), 0.03)
        press_ok()
        crack = self.doc.Crack
        count = crack.FemMesh.VolumeCount
        self.assertGreater(count, 2000)
        self.assertLess(count, 8000)

    def agree_to_many(self):
        """A panel with a refinement above the limit, which was asked about and agreed to."""
        self.group.SetInt("MostElements", 3000)
        self.open_half_plane()
        choose("refine", "Size")
        type_into("refineSize", "0.15 mm")
        wait_for_question("0.15 mm")
        click("refineAnyway")
        self.wait_for_preview()

    def test_computed_all_the_same(self):
        self.agree_to_many()
        self.assertFalse(is_shown("refinementQuestion"))
        press_ok()
        self.assertGreater(self.doc.Crack.FemMesh.VolumeCount, 3000)

    def test_agreed_for_what_was_entered_alone(self):
        self.agree_to_many()
        type_into("originX", "6.9")
        wait_for_question("0.15 mm")
        self.assertFalse(ok_button().isEnabled())

    def agree_to_much(self):
        """Agrees to a refinement, which has begun then, and goes on when the returned event is set."""
        go_on = threading.Event()
        self.addCleanup(go_on.set)

        def guarded(guard, estimate, original=refinement_guard.Guard.__call__):
            original(guard, estimate)
            if guard._agreed:
                go_on.wait(PATIENCE)

        patch = mock.patch.object(refinement_guard.Guard, "__call__", guarded)
        patch.start()
        self.addCleanup(patch.stop)
        self.group.SetInt("MostElements", 3000)
        self.open_half_plane()
        choose("refine", "Size")
        type_into("refineSize", "0.04 mm")
        wait_for_question("40.00")
        click("refineAnyway")
        wait_until(lambda: widget("status").text().startswith("Refining first"), "the refinement's beginning")
        return go_on

    def check_change(self, change, settled):
        with mock.patch.object(latest_wins, "PATIENCE", 1000), mock.patch.object(
            ToolPanel, "finished", autospec=True, side_effect=ToolPanel.finished
        ) as finished:
            go_on = self.agree_to_much()
            panel = opened_panel()
            change()
            go_on.set()
            wait_until(settled, "what is entered now")
            wait_until(lambda: panel.worker._running is None, "rest")
            spin(0.1)
        sizes = [self.radius_of(call) for call in finished.call_args_list]
        self.assertNotIn(0.04, [round(size, 6) for size in sizes])

    def test_a_change_ends_what_was_agreed_to(self):
        """At once, however short it has run."""
        self.check_change(lambda: choose("refine", "Never"), is_settled)

    def test_a_wrong_change_ends_it_too(self):
        self.check_change(lambda: type_into("normalX", "0"), lambda: is_shown("geometryError"))

    def test_the_dialog_says_what_it_waits_for(self):
        texts = []

        def read(dialog):
            texts.append(dialog.labelText())
            dialog.reject()
            go_on.set()

        go_on = self.agree_to_much()
        with_dialog(QtGui.QProgressDialog, read, press_ok)
        self.assertRegex(texts[0], "^Refining first, to edges of 40.00.*elements")
        self.assertEqual([o.Name for o in self.doc.Objects], ["Mesh"])
        self.assertTrue(widget("status").text().startswith("Cancelled"))

    def test_asked_for_memory(self):
        self.group.SetInt("MostMemory", 1)
        self.open_half_plane()
        choose("refine", "Size")
        type_into("refineSize", "0.15 mm")
        wait_for_question("0.15 mm")
        self.assertGreater(refinement_guard.free_memory(), 10_000_000)
        choose("refine", "Never")
        self.wait_for_preview()
        self.assertFalse(is_shown("refinementQuestion"))

    def test_the_panel_refine_asks_too(self):
        self.group.SetInt("MostElements", 6000)
        self.run_command("FemScalpel_Refine")
        type_into("edgeSize", "0.02 mm")
        wait_for_question("20.00")
        self.assertFalse(ok_button().isEnabled())
        click("refineFitting")
        self.wait_for_preview()
        self.assertGreater(value("edgeSize"), 0.02)
        self.assertTrue(ok_button().isEnabled())
