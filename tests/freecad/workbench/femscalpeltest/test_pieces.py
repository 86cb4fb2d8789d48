# SPDX-License-Identifier: LGPL-2.1-or-later
"""What objects say of a part that falls into pieces, and of what holds these."""

import pathlib
from unittest import mock

import FreeCAD
import ObjectsFem

import femscalpel as fs
import ObjectsFemScalpel
from femscalpelobjects import pieces

from .documents import DocumentTest
from .meshes import box_with_groups, grid_box

SENTENCE = "What nothing holds has no solution"


def told(obj):
    """Recomputes an object; (warnings, messages) about pieces in the report view."""
    with mock.patch.object(FreeCAD.Console, "PrintWarning") as warn, mock.patch.object(
        FreeCAD.Console, "PrintMessage"
    ) as say:
        obj.touch()
        obj.Document.recompute()
    return [[call[0][0] for call in calls.call_args_list if "pieces" in call[0][0]] for calls in (warn, say)]


class HeldPieces(DocumentTest):
    """FreeCAD's cantilever, 8000 x 1000 x 1000, held at x = 0."""

    def setUp(self):
        super().setUp()
        from femexamples import ccx_cantilever_base_solid

        ccx_cantilever_base_solid.setup_cantilever_base_solid(self.doc, "ccxtools")
        self.analysis, self.source, self.box = self.doc.Analysis, self.doc.Mesh, self.doc.Box
        self.doc.ConstraintFixed.Label = "WALL"
        self.crack = ObjectsFemScalpel.makeCrack(self.doc, self.source, origin=(6000, 500, 500), normal=(1, 0, 0))

    def test_a_piece_that_nothing_holds_is_a_warning(self):
        warnings, messages = told(self.crack)
        self.assertEqual(
            self.crack.Pieces,
            ["75 % of the volume (left, -x; held by WALL)", "25 % of the volume (right, +x; nothing holds it)"],
        )
        self.assertEqual(messages, [])
        (text,) = warnings
        self.assertIn(f"Crack: The part falls into 2 pieces: {self.crack.Pieces[0]} and {self.crack.Pieces[1]}.", text)
        self.assertIn(SENTENCE, text)
        (line,) = (line for line in self.crack.GroupReport if line.startswith("  pieces"))
        self.assertIn(self.crack.Pieces[1], line)
        self.assertLess(self.crack.GroupReport.index(line), self.crack.GroupReport.index(""))
        self.assertFalse([w for w in self.crack.Warnings if "piece" in w])
        self.assertEqual(self.crack.Warnings, self.crack.Proxy.report.warnings)

    def test_both_held(self):
        self.doc.ConstraintFixed.References = [(self.box, ("Face1", "Face2"))]
        warnings, messages = told(self.crack)
        self.assertEqual(warnings, [])
        self.assertEqual(len(messages), 1)
        self.assertNotIn(SENTENCE, messages[0])
        self.assertEqual([text.split("; ")[1] for text in self.crack.Pieces], ["held by WALL)"] * 2)

    def test_follows_the_supports_although_the_mesh_is_remembered(self):
        told(self.crack)
        motion = ObjectsFem.makeConstraintDisplacement(self.doc, "End")
        motion.References = [(self.box, "Face2")]
        self.analysis.addObject(motion)
        motion.xFree = motion.yFree = motion.zFree = True
        with mock.patch.object(type(self.crack.Proxy), "result", side_effect=AssertionError("made anew")):
            warnings, _ = told(self.crack)
            self.assertIn("nothing holds it", warnings[0], "it leaves every direction free")
            motion.xFree = False
            warnings, messages = told(self.crack)
        self.assertEqual(warnings, [])
        self.assertIn("held by End", messages[0])
        self.assertEqual(len([line for line in self.crack.GroupReport if line.startswith("  pieces")]), 1)

    def test_follows_the_analysis_without_being_computed(self):
        told(self.crack)
        held = list(self.crack.Pieces)
        with mock.patch.object(type(self.crack.Proxy), "execute", side_effect=AssertionError("computed")):
            self.doc.UndoMode = 1
            self.doc.openTransaction("Take the support out")
            self.analysis.removeObject(self.doc.ConstraintFixed)
            self.doc.commitTransaction()
            self.doc.recompute()
            loose = [text.split("; ")[1] for text in self.crack.Pieces]
            self.assertEqual(loose, ["nothing holds it)"] * 2)
            (line,) = (line for line in self.crack.GroupReport if line.startswith("  pieces"))
            self.assertIn(self.crack.Pieces[0], line)
            self.doc.undo()
            self.assertEqual(self.crack.Pieces, held)

    def test_follows_in_a_document_that_was_opened(self):
        told(self.crack)
        held = list(self.crack.Pieces)
        path = str(pathlib.Path(self.folder.name) / "pieces.FCStd")
        self.doc.saveAs(path)
        FreeCAD.closeDocument(self.doc.Name)
        self.doc = FreeCAD.openDocument(path)
        self.doc.Analysis.removeObject(self.doc.ConstraintFixed)
        self.doc.recompute()
        self.assertEqual([text.split("; ")[1] for text in self.doc.Crack.Pieces], ["nothing holds it)"] * 2)
        self.doc.Analysis.addObject(self.doc.ConstraintFixed)
        self.doc.recompute()
        self.assertEqual(self.doc.Crack.Pieces, held)

    def test_loads_hold_nothing(self):
        force = ObjectsFem.makeConstraintForce(self.doc, "Load")
        force.References = [(self.box, "Face2")]
        self.analysis.addObject(force)
        self.assertIn("nothing holds it", told(self.crack)[0][0])

    def test_groups_of_a_constraint_come_first(self):
        femmesh = self.source.FemMesh.copy()
        right = sorted(n for n, p in femmesh.Nodes.items() if p.x == 8000)
        femmesh.addGroupElements(femmesh.addGroup("ConstraintFixed_Nodes", "Node"), right)
        self.source.FemMesh = femmesh
        self.doc.recompute()
        self.assertEqual([text.split("; ")[1] for text in self.crack.Pieces], ["nothing holds it)", "held by WALL)"])

    def test_a_crack_that_ends_inside_says_nothing(self):
        told(self.crack)
        self.crack.Patch = "HalfPlane"
        self.assertEqual(told(self.crack), [[], []])
        self.assertEqual(self.crack.Pieces, [])
        self.assertNotIn("  pieces", "\n".join(self.crack.GroupReport))
        self.crack.Patch = "Whole"
        self.doc.recompute()
        self.assertEqual(len(self.crack.Pieces), 2)

    def test_analysis_of_what_is_made_of_it(self):
        told(self.crack)
        ObjectsFemScalpel.putIntoAnalysis(self.crack, strict=False)
        self.assertEqual(list(pieces.find_supports(self.source)), ["WALL"])
        second = ObjectsFemScalpel.makeCrack(
            self.doc, self.crack, "Second", origin=(3000, 500, 500), normal=(1, 0, 0), group_name="SECOND"
        )
        warnings, _ = told(second)
        self.assertIn("The mesh has 3 pieces now, 2 before", warnings[0])
        self.assertIn("middle; nothing holds it", warnings[0])


class Pieces(DocumentTest):
    def test_groups_without_an_analysis(self):
        source = self.add_source(box_with_groups())
        crack = ObjectsFemScalpel.makeCrack(self.doc, source, origin=(3.3, 2.5, 2), normal=(0.9, 0.3, 0.2))
        warnings, _ = told(crack)
        self.assertEqual(len(warnings), 1)
        text = " ".join(crack.Pieces)
        self.assertRegex(text, r"with groups .*LEFT.*with groups .*RIGHT|with groups .*RIGHT.*with groups .*LEFT")
        self.assertNotIn("CRACK", text)

    def test_drill_and_cut(self):
        source = self.add_source(grid_box((12, 4, 4), (12.0, 4.0, 4.0)))
        cut = ObjectsFemScalpel.makeCut(self.doc, source, origin=(4.3, 2, 2), normal=(1, 0, 0), width=0.6)
        drill = ObjectsFemScalpel.makeDrill(self.doc, source, origin=(6.2, 2.1, 2), axis=(0, 0, 1), radius=0.8)
        self.doc.recompute()
        self.assertEqual([text.split("; ")[1] for text in cut.Pieces], ["in no group)"] * 2)
        self.assertEqual([text[:4] for text in cut.Pieces], ["65 %", "35 %"])
        self.assertEqual(drill.Pieces, [])

    def test_an_addition_is_no_news(self):
        source, other = (self.add_source(grid_box()) for _ in range(2))
        other.Placement.Base.x = 6
        merged = ObjectsFemScalpel.makeMerge(self.doc, source, other)
        self.doc.recompute()
        self.assertEqual(merged.Pieces, [])

    def test_words(self):
        def part(share, dimension=3, side=1, axis=2, groups=()):
            return pieces.Part(share, dimension, 7, axis, side, (), groups)

        parting = pieces.Parting(1, [part(0.997), part(0.003, side=-1), part(0, 2, axis=-1), part(0, 1, side=0)], 3)
        self.assertEqual(
            pieces.items_of(parting, [["A", "B"], [], ["A"], []]),
            [
                "> 99 % of the volume (top, +z; held by A, B)",
                "< 1 % of the volume (bottom, -z; nothing holds it)",
                "7 shell elements (held by A)",
                "7 beam elements (middle; nothing holds it)",
            ],
        )
        many = pieces.Parting(1, [part(0.1, groups=tuple("ABCDEFG"))] * 10, 3)
        items = pieces.items_of(many, None)
        self.assertEqual((len(items), items[-1]), (5, "6 smaller ones"))
        self.assertIn("with groups A, B, C, D, E and 2 more", items[0])
        self.assertEqual(pieces.items_of(many, [["A"]] * 8 + [[]] * 2)[-1], "6 smaller ones (nothing holds 2 of them)")
        self.assertTrue(pieces.is_unsafe(None))
        self.assertFalse(pieces.is_unsafe([["A"]]))

    def test_from_a_file(self):
        source = self.add_source(box_with_groups())
        crack = ObjectsFemScalpel.makeCrack(self.doc, source, origin=(3.3, 2.5, 2), normal=(1, 0, 0))
        self.doc.recompute()
        shown, path = crack.Pieces, f"{self.folder.name}/pieces.FCStd"
        self.assertEqual(len(shown), 2)
        self.doc.saveAs(path)
        FreeCAD.closeDocument(self.doc.Name)
        self.doc = FreeCAD.openDocument(path)
        self.assertEqual(self.doc.Crack.Pieces, shown)
        self.assertIsInstance(self.doc.Crack.Proxy.report, (type(None), fs.Report))
