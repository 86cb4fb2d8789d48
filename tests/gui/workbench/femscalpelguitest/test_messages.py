# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the panels say when nothing can be made: the true reason, and what to do."""

from .gui_testing import *  # noqa: F403
from .test_crack_panel import CrackTest


class Reasons(CrackTest):
    def setUp(self):
        super().setUp()
        self.addCleanup(FreeCADGui.setLocale, "en")

    def message_of(self, *entries):
        """Opens the panel, enters the fields and returns the message at the geometry."""
        self.open_panel()
        for name, entry in entries:
            choose(name, entry) if name in ("patch", "refine") else type_into(name, entry)
        wait_until(lambda: is_shown("geometryError") and "No preview" in widget("status").text(), "the last message")
        spin(0.3)
        text = widget("geometryError").text()
        press_cancel()
        return text

    def test_of_a_crack(self):
        disk = ("patch", "Disk")
        for entries, reason, advice in (
            ((("originX", "900"),), r"misses the mesh: .* distance 886", "Move the plane or turn it"),
            ((("originX", "0"),), "only touches the mesh, on its outside", "Move the plane into the material"),
            (
                (disk, ("originY", "50"), ("patchRadius", "1")),
                "only outside the part of it that is to cut",
                "Move that",
            ),
            ((disk, ("originY", "6"), ("patchRadius", "1")), "there is no material within its front", "Move it into"),
            (
                (("refine", "Never"), disk, ("originX", "7.3"), ("originY", "2.313"), ("patchRadius", "0.001")),
                "too coarse for the crack: no element face fits in it",
                "Refine the mesh near the crack front first, or make the crack larger",
            ),
        ):
            with self.subTest(reason=reason):
                text = self.message_of(*entries)
                self.assertRegex(text, reason)
                self.assertIn(advice, text)

    def test_own_sentences_are_in_the_panels_language(self):
        FreeCADGui.setLocale("de")
        spin(0.2)
        self.open_panel_in_german()
        choose("patch", "Polygon")
        self.assertIn("Skizze", self.wait_for_message("geometryError"))
        self.assertRegex(widget("status").text(), "^Keine Vorschau")
        screenshot("message_german")

    def open_panel_in_german(self):
        self.run_command("FemScalpel_Crack")
        wait_until(lambda: is_shown("status") and widget("status").text()[:1].isdigit(), "the preview")
        self.assertIn("Elemente", widget("status").text())
        self.assertRegex(widget("status").text(), "Riss: .* Front: ")
