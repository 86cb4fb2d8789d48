# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the engine says is in the user's language, by templates that must be what it says today."""

import functools
import re

import FreeCADGui
import numpy as np

import femscalpel as fs
import ObjectsFemScalpel
from femscalpelgui import help as pages
from femscalpelgui.messages import TEMPLATES, in_language
from femscalpeltest.meshes import grid_box
from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest
from .test_crack_panel import long_box

X, Z = (1, 0, 0), (0, 0, 1)


def two_boxes():
    """Two boxes apart."""
    near = grid_box((2, 2, 2), (2.0, 2.0, 2.0))
    points = np.vstack([near.points, near.points + (5, 0, 0)])
    return fs.Mesh(points, {"tetra": np.vstack([near.cells["tetra"], near.cells["tetra"] + near.node_count])})


def rib():
    """Thin and long, on a face of long_box()."""
    rib = grid_box((120, 1, 8), (10.0, 0.08, 0.8))
    return fs.Mesh(rib.points + (1.1, 2.33, 4), rib.cells)


#: Operations that the engine refuses, or warns of.
CASES = {
    "misses": lambda m: fs.crack(m, fs.Plane((90, 0, 0), X)),
    "misses on the other side": lambda m: fs.drill(m, fs.Cylinder((90, 0, 0), Z, 1)),
    "between": lambda m: fs.crack(two_boxes(), fs.Plane((3.5, 0, 0), X)),
    "touches": lambda m: fs.crack(m, fs.Plane((0, 0, 0), (1, 1, 1))),
    "outside": lambda m: fs.crack(m, fs.Plane((7.3, 0, 0), X), within=fs.Disk((7.3, 50, 0), 1)),
    "touches on its outside": lambda m: fs.crack(m, fs.Plane((0, 0, 0), X)),
    "a hole beyond": lambda m: fs.drill(m, fs.Cylinder((7, 2.5, 20), Z, 1), depth=2),
    "coarse crack": lambda m: fs.crack(m, fs.Plane((7.3, 0, 0), X), within=fs.Disk((7.3, 2.5, 2), 0.05), refine=False),
    "whole": lambda m: fs.drill(m, fs.Cylinder((7, 2.5, 2), Z, 100)),
    "slot": lambda m: fs.cut(m, fs.Plane((7.3, 2.5, 2), X), width=1e-9, refine=False),
    "removes nothing": lambda m: fs.drill(m, fs.Cylinder((-1, 2.5, 2), Z, 1)),
    "coarse hole": lambda m: fs.drill(m, fs.Cylinder((7.2, 2.6, 2), Z, 0.25), refine=False),
    "radius": lambda m: fs.drill(m, fs.Cylinder((7, 2.5, 2), Z, -1)),
    "direction": lambda m: fs.crack(m, fs.Plane((7, 2.5, 2), (0, 0, 0))),
    "no name": lambda m: fs.crack(m, fs.Plane((7.3, 2.5, 2), X), name=""),
    "a name that is taken": lambda m: fs.crack(fs.crack(m, fs.Plane((7.3, 2.5, 2), X)).mesh, fs.Plane((3.3, 0, 0), X)),
    "a long name": lambda m: fs.crack(m, fs.Plane((7.3, 2.5, 2), X), name=24 * "A"),
    "characters": lambda m: fs.crack(m, fs.Plane((7.3, 2.5, 2), X), name="A B"),
    "far from an edge": lambda m: fs.fillet(m, [(7, 2.5, 2)], 0.5),
    "too large": lambda m: fs.fillet(m, [(7, 0, 0)], 50),
    "no edge": lambda m: fs.fillet(m, "FIX", 0.5),
    "no group": lambda m: fs.reshape(m, "NOWHERE", by=(1, 0, 0)),
    "addition": lambda m: fs.merge(m, fs.Mesh(m.points + 90, m.cells), name="ADD"),
    "much refined": lambda m: fs.drill(m, fs.Cylinder((7.2, 2.6, 2), Z, 0.06)),
    "an addition that is finer": lambda m: fs.merge(m, rib()),
}
#: What Python's functions call parameters, as no field of a panel is called.
PYTHON = re.compile(r"\b(refine|join_groups|method)=|feature_angle|max_elements|^along:")


@functools.lru_cache(maxsize=None)
def said(case):
    """The error, or the warnings, of an operation."""
    try:
        result = case(long_box())
    except fs.Error as error:
        return [str(error)]
    return result.report.warnings


class EngineTexts(GuiTest):
    def setUp(self):
        super().setUp()
        self.addCleanup(FreeCADGui.setLocale, "en")

    def test_templates_are_what_the_engine_says(self):
        used = set()
        for language in ("de", "fr"):
            FreeCADGui.setLocale(language)
            spin(0.1)
            for name, case in CASES.items():
                with self.subTest(case=name, language=language):
                    texts = said(case)
                    self.assertTrue(texts, "nothing is wrong with it")
                    for text in texts:
                        translated = in_language(text)
                        self.assertNotEqual(translated, text)
                        numbers = re.findall(r"\d+(?:\.\d+)?", text)
                        self.assertTrue(set(re.findall(r"\d+(?:\.\d+)?", translated)) <= set(numbers), translated)
                        self.assertNotRegex(translated, r"%\d")
                    used.update(texts)
        self.assertGreaterEqual(len(used), 20)

    def test_translations_say_what_varies(self):
        for language in ("de", "fr"):
            FreeCADGui.setLocale(language)
            spin(0.1)
            for template in TEMPLATES:
                with self.subTest(template=template, language=language):
                    translated = in_language(re.sub(r"%\d", lambda found: f"<{found.group()[1]}>", template))
                    for number in set(re.findall(r"%(\d)", template)):
                        if "max_elements" not in template:
                            self.assertIn(f"<{number}>", translated)

    def test_english_calls_parameters_as_the_panels(self):
        named = 0
        for name, case in CASES.items():
            for text in said(case):
                with self.subTest(case=name):
                    if PYTHON.search(text):
                        named += 1
                        self.assertNotRegex(in_language(text), PYTHON)
                    else:
                        self.assertEqual(in_language(text), text)
        self.assertGreaterEqual(named, 4)
        self.assertEqual(in_language("whatever"), "whatever")
        self.assertEqual(
            in_language("group 'A' is a group of the addition, too. join_groups=False keeps them apart"),
            "group 'A' is a group of the addition, too. “Join groups of one name” off keeps them apart",
        )
        self.assertEqual(in_language("refine the mesh, in transition"), "refine the mesh, in transition")

    def test_in_a_panel_in_english(self):
        self.add_mesh(long_box())
        self.run_command("FemScalpel_Drill")
        self.wait_for_preview()
        type_into("radius", "0.2")
        wait_until(lambda: is_settled() and "Refine first" in widget("status").text(), "how much it was refined")
        self.assertRegex(widget("status").text(), "“Refine first” to an edge length of .* makes fewer, “never”")
        self.assertNotRegex(widget("status").text(), PYTHON)
        screenshot("engine_text_en")

    def test_objects_at_recompute(self):
        """What an object says in the report view is in the window's language, as in a panel."""
        FreeCADGui.setLocale("de")
        spin(0.1)
        mesh = self.add_mesh(long_box())
        crack = ObjectsFemScalpel.makeCrack(self.doc, mesh, origin=(90, 0, 0), normal=X)
        self.doc.recompute()
        self.assertIn("Crack: Das Werkzeug (Ebene) verfehlt das Netz: Das ganze Netz liegt", self.news())
        crack.PlanePlacement.Base.x = 7.3
        self.doc.recompute()
        self.assertIn("Crack: Das Bauteil zerfällt in 2 Stücke", self.news())
        crack.Source = None
        self.doc.recompute()
        self.assertIn("Crack: Source ist nicht gesetzt; wählen Sie das FEM-Netz", self.news())
        FreeCADGui.setLocale("en")
        spin(0.1)
        crack.touch()
        self.doc.recompute()
        self.assertIn("Crack: Source is not set; choose the FEM mesh to work on", self.news())

    def news(self):
        """What the report view says since this was asked last, or the test began."""
        spin(0.2)
        text = report_view()
        new, self.told = text[getattr(self, "told", self.reported) :], len(text)
        return new

    def test_panel(self):
        FreeCADGui.setLocale("de")
        spin(0.1)
        self.add_mesh(long_box())
        self.run_command("FemScalpel_Crack")
        self.wait_for_preview()
        type_into("originX", "90")
        text = self.wait_for_message("geometryError")
        self.assertTrue(text.startswith("Das Werkzeug (Ebene) verfehlt das Netz: Das ganze Netz liegt"), text)
        screenshot("engine_text_de")

    def test_help_says_its_language(self):
        pages.show("crack")
        spin(0.1)
        self.assertFalse(is_shown("helpLanguage"))
        widget("femscalpelHelp").close()
        FreeCADGui.setLocale("de")
        spin(0.1)
        pages.show("crack")
        spin(0.1)
        self.assertEqual(widget("helpLanguage").text(), "Diese Seiten sind auf Englisch.")
        self.assertEqual(widget("helpBack").text(), "Zurück")
        screenshot("help_de")
        widget("femscalpelHelp").close()
