# SPDX-License-Identifier: LGPL-2.1-or-later
"""What previews and panels say of a part that falls into pieces; the crack panel starts with a crack that ends
inside."""

import os
import re
import unittest
from contextlib import contextmanager

import FreeCAD
import FreeCADGui
import numpy as np
import ObjectsFem
from PySide import QtCore, QtGui

import femmesh_bridge
import femscalpel as fs
import ObjectsFemScalpel
from femscalpelgui.panels import fields
from femscalpelgui.translate import TRANSLATIONS
from femscalpelgui.view.preview_data import PreviewSource, preview_of
from femscalpelobjects.pieces import parting_of
from femscalpeltest.all_elements import SOLIDS, mesh_of, plate_with_beams
from femscalpeltest.meshes import grid_box
from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest
from .test_all_elements import FLAT, OPERATIONS
from .test_crack_panel import long_box


@contextmanager
def in_language(code):
    """FemScalpel's own texts in another language."""
    translator = QtCore.QTranslator()
    if not translator.load(os.path.join(TRANSLATIONS, f"FemScalpel_{code}.qm")):
        raise AssertionError(f"no translation {code}")
    QtGui.QApplication.installTranslator(translator)
    try:
        yield
    finally:
        QtGui.QApplication.removeTranslator(translator)


class PreviewKnowsThePieces(unittest.TestCase):
    """Without a window."""

    def assertSame(self, found, expected):
        self.assertEqual(found is None, expected is None)
        for a, b in zip(found.parts, expected.parts) if found else ():
            self.assertAlmostEqual(a.share, b.share, places=9)
            self.assertEqual((a.elements, a.axis, a.side, a.groups), (b.elements, b.axis, b.side, b.groups))
            np.testing.assert_array_equal(a.nodes, b.nodes)

    def test_those_of_the_result(self):
        shown = 0
        for kind in (*SOLIDS, *FLAT):
            mesh = mesh_of(kind)
            source, known = PreviewSource(mesh), {(g.name, g.kind) for g in mesh.groups.all()}
            for name, (operate, surface, region, whole) in OPERATIONS.items():
                with self.subTest(kind=kind, operation=name):
                    found = preview_of(source, operate, surface, region, whole).parting
                    result = operate(source.scalpel) if whole else operate(source.scalpel, False)
                    self.assertSame(found, parting_of(result.mesh, 1, known=known))
                    shown += found is not None
        self.assertGreater(shown, 20)

    def test_with_elements_that_are_merged_away(self):
        removed = 0
        for counts in ((24, 5, 4), (20, 4, 4)):
            mesh = grid_box(counts, [float(n) for n in counts])
            points, random = np.array(mesh.points), np.random.default_rng(7)
            inner = ((points > 0) & (points < counts)).all(axis=1)
            points[inner] += random.uniform(-0.3, 0.3, (inner.sum(), 3))
            half = np.flatnonzero(points[mesh.cells["tetra"]].mean(axis=1)[:, 1] > 2.5) + 1  # with a rough border
            source = PreviewSource(fs.Mesh(points, mesh.cells, groups={"HALF": ("element", half)}))
            for k in range(12):
                plane = fs.Plane((9.03 + 0.11 * k, 2, 2), (1, 0.07 * k, 0.3 - 0.06 * k))
                for within in (None, fs.HalfPlane((9.03 + 0.11 * k, 2, 2), (0, 0, 1))):
                    data = preview_of(
                        source,
                        lambda s, band: s.crack(plane, within=within, band_only=band, refine=False),
                        plane,
                        None,
                        False,
                    )
                    removed += data.result.report.elements_removed
                    with self.subTest(k=k, within=within):
                        self.assertEqual(len(data.parting.parts) if data.parting else 1, 1 if within else 2)
        self.assertGreater(removed, 50)


class Panels(GuiTest):
    def held_box(self):
        """A box of tetrahedra, held at x = 0 in an analysis."""
        mesh = self.add_mesh(long_box())
        part = self.doc.addObject("Part::Box", "Block")
        part.Length, part.Width, part.Height = 14, 5, 4
        part.ViewObject.Visibility = False
        self.doc.recompute()
        analysis = ObjectsFem.makeAnalysis(self.doc, "Analysis")
        wall = ObjectsFem.makeConstraintFixed(self.doc, "Fixed")
        wall.References = [(part, "Face1")]
        wall.Label = "Wall <left>"
        wall.ViewObject.Visibility = False
        for obj in (mesh, wall):
            analysis.addObject(obj)
        self.doc.recompute()
        return mesh, analysis, part

    def wait_for_text(self, text):
        try:
            wait_until(lambda: text in widget("status").text(), f"'{text}'")
        except AssertionError:
            self.assertIn(text, widget("status").text())
            raise

    def picture(self, name):
        """A screenshot in which the text can be read."""
        for bar in FreeCADGui.getMainWindow().findChildren(QtGui.QScrollBar):
            if bar.isVisible() and bar.orientation() == QtCore.Qt.Vertical and bar.maximum() > 100:
                bar.setValue(bar.maximum())
        spin(0.1)
        screenshot(name)

    def test_piece_without_a_support(self):
        _, analysis, part = self.held_box()
        self.run_command("FemScalpel_Crack")
        self.wait_for_preview()
        self.assertNotIn("falls into", widget("status").text())
        choose("patch", "Whole")
        type_into("originX", "9.1")
        self.wait_for_text(
            "The part falls into 2 pieces: 65 % of the volume (left, -x; held by Wall &lt;left&gt;) and 35 % of the "
            "volume (right, +x; nothing holds it)."
        )
        self.assertRegex(widget("status").text(), re.escape(fields.WARNING) + "'>The part falls")
        self.picture("pieces_en")
        before = len(report_view())
        press_ok()
        self.assertIn("Crack: The part falls into 2 pieces", report_view()[before:])
        crack = self.doc.Crack
        self.assertEqual(
            crack.Pieces,
            [
                "65 % of the volume (left, -x; held by Wall <left>)",
                "35 % of the volume (right, +x; nothing holds it)",
            ],
        )
        # Held at the other end, too; the crack has the mesh's place in the analysis now.
        self.assertIn(crack, analysis.Group)
        other = ObjectsFem.makeConstraintDisplacement(self.doc, "Other")
        other.References, other.xFree = [(part, "Face2")], False
        other.ViewObject.Visibility = False
        analysis.addObject(other)
        crack.ViewObject.doubleClicked()
        self.wait_for_text("right, +x; held by Other")
        self.assertNotRegex(widget("status").text(), re.escape(fields.WARNING) + "'>The part falls")
        self.assertNotIn("has no solution", widget("status").text())
        press_cancel()

    def test_in_german(self):
        self.held_box()
        with in_language("de"):
            self.run_command("FemScalpel_Crack")
            choose("patch", "Whole")
            type_into("originX", "9.1")
            self.wait_for_text("Das Bauteil zerfällt in 2 Stücke: 65 % des Volumens (links, -x; gehalten von")
            self.picture("pieces_de")
            press_cancel()

    def test_starts_with_a_crack_that_ends_inside(self):
        for kind, mesh in (
            ("long", long_box(2)),
            ("upright", grid_box((4, 5, 12), (4.0, 5.0, 12.0))),
            ("plate", mesh_of("quad")),
            ("turned", fs.Mesh(mesh_of("triangle").points[:, [2, 0, 1]], mesh_of("triangle").cells)),
            ("bricks", mesh_of("hexahedron")),
        ):
            with self.subTest(kind=kind):
                source = self.add_mesh(mesh, kind)
                FreeCADGui.Selection.addSelection(self.doc.Name, source.Name)
                self.run_command("FemScalpel_Crack")
                self.assertEqual(widget("patch").currentData(), "HalfPlane")
                self.wait_for_preview()
                self.assertFalse(is_shown("geometryError"))
                self.assertNotIn("falls into", widget("status").text())
                screenshot("starts_" + kind)
                press_ok()
                crack = FreeCADGui.Selection.getSelection()[0]
                self.assertEqual((crack.Patch, crack.Pieces), ("HalfPlane", []))
                self.assertGreater(crack.NodesDoubled, 0)
                lengths = np.ptp(mesh.points, axis=0)
                normal = np.abs(crack.PlanePlacement.Rotation.multVec(FreeCAD.Vector(0, 0, 1)))
                self.assertGreater(normal[np.argmax(lengths)], 1 - 1e-9)
                self.assertEqual(len(fs.pieces(femmesh_bridge.from_femmesh(crack.FemMesh))), 1)
                for obj in (crack, source):
                    self.doc.removeObject(obj.Name)

    def test_edited_objects_stay_as_they_are(self):
        mesh = self.add_mesh(long_box())
        crack = ObjectsFemScalpel.makeCrack(self.doc, mesh, origin=(7.3, 2.5, 2), normal=(1, 0.1, 0))
        self.doc.recompute()
        self.assertEqual(crack.Patch, "Whole")
        crack.ViewObject.doubleClicked()
        self.wait_for_preview()
        self.assertEqual(widget("patch").currentData(), "Whole")
        self.wait_for_text("with groups")
        press_cancel()

    def test_beams_are_cut_as_a_whole(self):
        points = [(x, 0.1 * x, 0) for x in range(7)]
        self.add_mesh(fs.Mesh(points, {"line": [(k, k + 1) for k in range(6)]}))
        self.run_command("FemScalpel_Crack")
        self.assertEqual(widget("patch").currentData(), "Whole")
        self.wait_for_text("% of the length")
        press_cancel()

    def test_beams_at_a_plate(self):
        mesh = self.add_mesh(plate_with_beams())
        self.run_command("FemScalpel_Crack")
        choose("patch", "Whole")
        type_into("originX", "2.3")
        self.wait_for_text("The part falls into 2 pieces")
        press_ok()
        before = len(fs.pieces(femmesh_bridge.from_femmesh(mesh.FemMesh)))
        made = fs.pieces(femmesh_bridge.from_femmesh(self.doc.Crack.FemMesh))
        self.assertEqual((before, len(made), len(self.doc.Crack.Pieces)), (1, 2, 2))
