# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elements of all types in the window: previews, their colours and histograms, and the panels that only look."""

import collections
import contextlib
import unittest

import FreeCAD
import FreeCADGui
import numpy as np
from pivy import coin
from PySide import QtGui

import femmesh_bridge
import femscalpel as fs
from femscalpelgui.view.preview_data import MadeNodes, PreviewSource, preview_of
from femscalpeltest.all_elements import SOLIDS, mesh_of, plate_with_beams
from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest

FLAT = ("triangle", "quad", "quad8")
PLANE, CYLINDER = fs.Plane((2.3, 2.1, 1.4), (1, 0.2, 0.1)), fs.Cylinder((3.1, 2.1, 0), (0, 0, 1), 0.8)
#: How the panel's summary calls what is converted.
CALLED = {"quad": "quadrangles", "pyramid": "pyramids", "wedge": "prisms", "hexahedron": "hexahedra"}


def made(name, kind):
    return lambda result: MadeNodes(result.mesh, name, kind)


class _Slot:
    def distance(self, points):
        return np.abs(PLANE.distance(points)) - 0.15


#: What a panel asks for: operation, surface, removed region, whether it is always the whole mesh.
OPERATIONS = {
    "crack": (lambda s, band: s.crack(PLANE, band_only=band), PLANE, None, False),
    "around": (lambda s, band: s.crack(CYLINDER, band_only=band), CYLINDER, None, False),
    "drill": (lambda s, band: s.drill(CYLINDER, band_only=band), CYLINDER, CYLINDER, False),
    "unrefined": (lambda s, band: s.drill(CYLINDER, band_only=band, refine=False), CYLINDER, CYLINDER, False),
    "cut": (lambda s, band: s.cut(PLANE, width=0.3, band_only=band), PLANE, _Slot(), False),
    "reshape": (lambda s: s.reshape("END", by=(-0.3, 0, 0)), made("SHAPE_WALL", "node"), None, True),
}


def places(surfaces):
    """Faces by the coordinates of their corners, each as often as it is there."""
    out = collections.Counter()
    for surface in surfaces:
        corners = surface.points.astype(np.float32).round(4) + 0.0
        for face in surface.faces:
            out[frozenset(tuple(corners[node].tolist()) for node in face if node >= 0)] += 1
    return out


class PreviewIsTheResult(unittest.TestCase):
    """Without a window."""

    def test_every_outer_face_is_drawn_and_no_other(self):
        for kind in (*SOLIDS, *FLAT):
            source = PreviewSource(mesh_of(kind))
            for name, (operate, surface, region, whole) in OPERATIONS.items():
                with self.subTest(kind=kind, operation=name):
                    data = preview_of(source, operate, surface, region, whole)
                    result = operate(source.scalpel) if whole else operate(source.scalpel, False)
                    drawn = places((*data.rest, *data.band))
                    expected = places([PreviewSource(result.mesh).whole()])
                    self.assertEqual(drawn - expected, collections.Counter())
                    self.assertEqual(expected - drawn, collections.Counter())
                    self.assertEqual(data.result.report.converted, result.report.converted)

    def test_quality_is_that_of_the_element_behind(self):
        for kind in (*SOLIDS, *FLAT):
            with self.subTest(kind=kind):
                source = PreviewSource(mesh_of(kind))
                data = preview_of(source, *OPERATIONS["crack"])
                ratios = np.concatenate(list(fs.mean_ratio(data.result.mesh).values()))
                shown = np.concatenate([part.quality for part in data.band])
                self.assertGreater(len(shown), 10)
                self.assertTrue((np.abs(shown[:, None] - ratios).min(axis=1) < 1e-12).all())

    def test_part_beside_a_conversion_stays(self):
        mesh = mesh_of("hexahedron")
        source = PreviewSource(fs.Mesh(mesh.points * (4, 1, 1), mesh.cells))
        data = preview_of(
            source, lambda s, band: s.crack(fs.Plane((3, 2, 1), (1, 0.1, 0)), band_only=band), PLANE, None, 0
        )
        self.assertLess(data.result.report.converted["hexahedron"], 72)
        self.assertTrue(any((part.faces[:, 3] >= 0).any() for part in data.rest))


class Panels(GuiTest):
    @contextlib.contextmanager
    def mesh(self, kind):
        """A mesh of one type, which is gone afterwards with all made of it."""
        try:
            yield self.add_mesh(mesh_of(kind))
        finally:
            while FreeCADGui.Control.activeDialog():
                press_button(QtGui.QDialogButtonBox.Cancel, QtGui.QDialogButtonBox.Close)
            for obj in reversed(self.doc.Objects):
                self.doc.removeObject(obj.Name)

    def open_panel(self, name):
        self.run_command(name)
        if is_shown("patch"):
            choose("patch", "Whole")
        wait_until(is_ready, "the panel")

    def colours_of(self, name):
        """Number of colours given to faces one by one under a node."""
        return sum(s.orderedRGBA.getNum() for s in shapes_in(name, coin.SoPackedColor))

    def test_cracked(self):
        z = FreeCAD.Vector(0, 0, 1)
        normal = FreeCAD.Rotation(z, FreeCAD.Vector(1, 0, 0)).multVec(z)  # to the last bit that of the document object
        for kind in ("quad", "quad8", "pyramid", "pyramid13", "wedge", "wedge15", "hexahedron", "hexahedron20"):
            with self.subTest(kind=kind), self.mesh(kind) as mesh:
                source = femmesh_bridge.from_femmesh(mesh.FemMesh)
                report = fs.crack(source, fs.Plane((2.3, 2, 1.5), normal)).report
                self.open_panel("FemScalpel_Crack")
                type_into("originX", "2.3")
                shape = kind.rstrip("0123456789")
                text = f"First became triangles or tetrahedra: {report.converted[kind]} {CALLED[shape]}."
                after = report.quality.after.histogram
                wait_until(lambda: np.array_equal(widget("histogram").after, after), "the crack as it was typed")
                self.assertIn(text, widget("status").text())
                np.testing.assert_array_equal(widget("histogram").before, report.quality.before.histogram)
                self.assertGreater(widget("histogram").before.sum(), 0)
                self.assertEqual(self.colours_of("FemScalpelBand"), faces_drawn("FemScalpelBand"))
                self.assertGreater(lines_drawn("FemScalpelWorst"), 2)
                screenshot("crack_" + kind)
                shown = widget("status").text()
                press_ok()
                crack = self.doc.Crack
                start = f"{crack.NodesMoved} nodes moved, {crack.NodesAdded} added; {report.elements_added} elements"
                self.assertTrue(shown.startswith(start), shown)
                self.assertEqual(crack.NodesDoubled, report.nodes_doubled)

    def test_looked_at(self):
        for kind in (*SOLIDS, *FLAT):
            with self.subTest(kind=kind), self.mesh(kind) as mesh:
                source = PreviewSource(femmesh_bridge.from_femmesh(mesh.FemMesh))
                self.open_panel("FemScalpel_MeshQuality")
                count = sum(len(ids) for ids in source.mesh.cell_ids.values())
                self.assertIn(f"{count} elements", widget("status").text())
                self.assertEqual(widget("histogram").after.sum(), count)
                self.assertEqual(faces_drawn("FemScalpelShape"), len(source.skin))
                self.assertEqual(widget("worst").item(0, 1).text(), kind)
                for measure in ("smallest angle", "scaled Jacobian"):
                    choose("measure", measure)
                    self.assertEqual(widget("histogram").after.sum(), count)
                click_row("worst", widget("worst").item(0, 0).text())
                screenshot("quality_" + kind)
                press_button(QtGui.QDialogButtonBox.Close)

                self.open_panel("FemScalpel_GroupInspector")
                table = widget("groups")
                rows = {table.item(row, 0).text(): row for row in range(table.rowCount())}
                size = "12 mm²" if kind in FLAT else "36 mm³"
                self.assertEqual(table.item(rows["LOW"], 4).text(), size)
                self.assertEqual(table.item(rows["LOW"], 2).text(), "faces" if kind in FLAT else "volumes")
                click_row("groups", "LOW")
                click("only")
                self.assertGreater(faces_drawn("FemScalpelShape"), 20 if kind not in FLAT else 10)
                choose("part", "bounding")
                self.assertGreater(faces_drawn("FemScalpelShape") + lines_drawn("FemScalpelShape"), 3)
                screenshot("groups_" + kind)
                press_button(QtGui.QDialogButtonBox.Close)

    def test_beams_on_a_plate(self):
        mesh = self.add_mesh(plate_with_beams())
        self.open_panel("FemScalpel_Crack")
        type_into("originX", "2.3")
        wait_until(lambda: "24 quadrangles" in widget("status").text(), "the preview")
        self.assertEqual(lines_drawn("FemScalpelBeams"), 3)
        screenshot("beams_crack")
        press_cancel()
        self.open_panel("FemScalpel_CylindricalCrack")
        for name, text in (("originX", "50"), ("normalX", "0"), ("normalZ", "1")):
            type_into(name, text)
        self.wait_for_message("geometryError")
        self.assertEqual(lines_drawn("FemScalpelBeams"), 3)
        press_cancel()
        self.open_panel("FemScalpel_GroupInspector")
        self.assertEqual(lines_drawn("FemScalpelBeams"), 3)
        click_row("groups", "POST")
        click("only")
        self.assertEqual(lines_drawn("FemScalpelShape"), 3)
        table = widget("groups")
        (row,) = (r for r in range(table.rowCount()) if table.item(r, 0).text() == "POST")
        self.assertEqual([table.item(row, k).text() for k in (2, 3, 4)], ["edges", "3", "3 mm"])
        screenshot("beams_groups")
        press_button(QtGui.QDialogButtonBox.Close)
        self.open_panel("FemScalpel_MeshQuality")
        self.assertIn("24 elements", widget("status").text())
        self.assertEqual(lines_drawn("FemScalpelBeams"), 3)
        press_button(QtGui.QDialogButtonBox.Close)
        self.assertTrue(mesh.ViewObject.Visibility)

    def test_beams_alone(self):
        points = [(x, 0.1 * x, 0) for x in range(7)]
        beams = fs.Mesh(points, {"line": [[k, k + 1] for k in range(6)]})
        beams.add_group("ALL", "element", beams.cell_ids["line"])
        self.add_mesh(beams)
        for name in ("FemScalpel_MeshQuality", "FemScalpel_GroupInspector"):
            self.open_panel(name)
            self.assertEqual(lines_drawn("FemScalpelBeams"), 6)
            press_button(QtGui.QDialogButtonBox.Close)
        self.open_panel("FemScalpel_Crack")
        type_into("originX", "2.5")
        self.wait_for_preview()
        screenshot("beams_alone")
        press_ok()
        crack = self.doc.Crack
        self.assertEqual((crack.FemMesh.EdgeCount, crack.FemMesh.NodeCount), (7, 9))

    def test_beam_at_a_crack(self):
        self.add_mesh(plate_with_beams())
        self.open_panel("FemScalpel_FaceCrack")
        choose("faceGroup", "SECTION")
        self.wait_for_preview()
        self.assertEqual(lines_drawn("FemScalpelBeams"), 3)
        press_ok()
        crack = self.doc.FaceCrack
        self.assertEqual(crack.FemMesh.EdgeCount, 3 + 6 + 2 * 4)  # those of the lips, too
        self.assertIn("stays whole", crack.Warnings[0])
