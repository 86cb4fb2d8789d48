# SPDX-License-Identifier: LGPL-2.1-or-later
"""FreeCAD's own FEM examples, cracked by script and solved by CalculiX.

Every example whose mesh is of tetrahedra or triangles. The crack takes the mesh's place in the analysis; then FreeCAD
writes the deck, as before the crack, and CalculiX solves it. What the deck applies is computed by ccx_deck.py and
compared with the uncracked mesh: total load, support reactions, supported areas, materials, surfaces. A table is
printed.

The planes leave every part with a support of its own. Where there is none (an infinite plane always parts the body),
the lips are tied in the deck.
"""

import importlib.util
import os
import re
import tempfile
import unittest

import FreeCAD
import numpy as np

import ObjectsFemScalpel

from .ccx_deck import Deck
from .documents import need, solver_of

# Loads, reactions and supported areas do not change by more than this, of their sum of magnitudes.
EXACT = 1e-6
# Areas and volumes with curved borders, and what FreeCAD makes loads of by them, differ as the mesh is another
# polyhedron.
CURVED = 5e-3
# CalculiX stops iterating a coupled or nonlinear step at about this much out of balance, with and without a crack.
ITERATED = 1e-5
# Names that FreeCAD's examples have from 1.0 on.
RENAMED = {"thermomech_bimetall": "thermomech_bimetal"}


class Example:
    def __init__(
        self,
        module,
        origin,
        normal,
        tie=False,
        measure=1e-9,
        load=EXACT,
        reaction=EXACT,
        frequency=False,
        solve=True,
        into=None,
        radius=None,
    ):
        """A plane; with `into`, the half of it in that direction from `origin`; with `radius`, a disk."""
        self.module, self.finite = module, into is not None or radius is not None
        rotation = FreeCAD.Rotation(FreeCAD.Vector(0, 0, 1), FreeCAD.Vector(*normal))
        if into is not None:
            rotation = FreeCAD.Rotation(FreeCAD.Vector(*into), FreeCAD.Vector(0, 0, 0), FreeCAD.Vector(*normal), "ZXY")
        self.crack = {"placement": FreeCAD.Placement(FreeCAD.Vector(*origin), rotation)}
        if self.finite:
            self.crack.update(patch="Disk", patch_radius=radius) if radius else self.crack.update(patch="HalfPlane")
        self.tie, self.frequency, self.solve = tie, frequency, solve
        self.measure, self.load, self.reaction = measure, load, reaction  # largest relative changes


SOLIDS = (
    Example("boxanalysis_frequency", (5, 5, 5.2), (0.1, 0.15, 1), frequency=True),
    Example("boxanalysis_static", (5, 5, 5.2), (0, 0.15, 1)),
    Example("ccx_cantilever_ele_tetra4", (4000, 500, 520), (0, 0.1, 1)),
    Example("ccx_cantilever_faceload", (4000, 500, 520), (0, 0.1, 1)),
    Example("ccx_cantilever_nodeload", (4000, 500, 520), (0, 0.1, 1)),
    Example("ccx_cantilever_prescribeddisplacement", (4000, 500, 520), (0, 0.1, 1)),
    # In FreeCAD 1.0 the outer parts that the crack cuts off are not held.
    Example("constraint_centrif", (30, 0, 0), (1, 0.3, 0), tie=True, measure=CURVED, load=CURVED),
    Example("constraint_contact_solid_solid", (236, 0, 0), (1, 0.05, 0), measure=CURVED),
    Example("constraint_section_print", (0, 0, 1), (0, 0, 1), measure=CURVED),
    Example("constraint_selfweight_cantilever", (0, 500, 520), (0, 0.1, 1)),
    Example("constraint_tie", (0, 0, 500), (1, 0.3, 0.1), tie=True, measure=CURVED),
    Example("constraint_transform_beam_hinged", (0, 6.3, 0), (0.02, 1, 0), measure=4 * CURVED),
    Example("constraint_transform_torque", (0, 0, 0), (1, 0.3, 0), measure=CURVED, load=CURVED),
    Example("elmer_nonguitutorial01_eigenvalue_of_elastic_beam", (500, 100, 50), (1, 0.1, 0.2), frequency=True),
    Example("frequency_beamsimple", (1500, 48, 25), (0, 1, 0.1), frequency=True),
    Example("material_multiple_bendingbeam_fiveboxes", (47, 5, 5), (1, 0.1, 0.2)),
    Example("material_multiple_tensionrod_twoboxes", (5.2, 5, 5), (1, 0.1, 0)),
    # With the crack open, the plastic plate does not bear its load any more.
    Example("material_nl_platewithhole", (0, 70, 0), (0, 1, 0.1), tie=True, measure=CURVED, reaction=ITERATED),
    Example("thermomech_bimetall", (0, 2.4, 0), (0, 1, 0.05)),
    Example("thermomech_spine", (0, 12, 0), (0, 1, 0.1), reaction=ITERATED),
)
SHELLS = (
    Example("buckling_lateraltorsionalbuckling", (5000, 75, 140), (1, 0.1, 0.2), tie=True),
    Example("buckling_platebuckling", (4000, 3000, 0), (1, 0.3, 0), tie=True),
    Example("ccx_cantilever_ele_tria3", (4000, 500, 520), (0.01, 0, 1)),
    Example("ccx_cantilever_ele_tria6", (4000, 500, 520), (0.01, 0, 1)),
    # CalculiX needs many minutes for this contact, with and without a crack: the deck alone.
    Example("constraint_contact_shell_shell", (0, 1, 0), (0.1, 1, 0), measure=CURVED, solve=False),
    Example("material_multiple_bendingbeam_fivefaces", (47, 5, 0), (1, 0.1, 0)),
    Example("rc_wall_2d", (2050, 0, 0), (1, 0.05, 0)),
    Example("square_pipe_end_twisted_edgeforces", (0, 3, 0), (0.1, 1, 0)),
    Example("square_pipe_end_twisted_nodeforces", (0, 3, 0), (0.1, 1, 0)),
)

# Cracks that end inside the part, which stays in one piece: nothing is tied.
FINITE = (
    Example("boxanalysis_static", (5, 5, 5.2), (0, 0.15, 1), into=(1, 0, 0)),
    Example("ccx_cantilever_ele_tetra4", (2000, 500, 480), (1, 0.1, 0), into=(0, 0, 1)),
    Example("constraint_tie", (0, 1210, 500), (1, 0, 0.1), into=(0, 0, 1), measure=CURVED),
    Example("constraint_transform_torque", (4.2, 0, 20), (0, 0.3, 1), radius=1.5, measure=CURVED, load=CURVED),
    Example("material_multiple_bendingbeam_fiveboxes", (58, 5, 5), (1, 0.1, 0.2), into=(0, 0, 1)),
    Example("material_multiple_tensionrod_twoboxes", (5, 5, 9), (0, 1, 2), into=(1, 0, 0)),
    Example("thermomech_bimetall", (48, 2.5, 1), (1, 0.1, 0), into=(0, 1, 0)),
    Example("buckling_platebuckling", (4000, 3000, 0), (1, 0.3, 0), into=(0, 1, 0)),
    Example("rc_wall_2d", (2050, 600, 0), (1, 0.05, 0), into=(0, 1, 0)),
    Example("square_pipe_end_twisted_edgeforces", (0, 3, 400), (0.1, 1, 0), into=(0, 0, -1)),
)


class Solved:
    """The deck FreeCAD writes for an analysis, and what CalculiX made of it."""

    def __init__(self, doc, pairs=(), solve=True):
        need("ccx", "CalculiX")
        from femtools import ccxtools

        with tempfile.TemporaryDirectory() as folder:
            tools = ccxtools.FemToolsCcx(doc.Analysis, solver_of(doc))
            tools.update_objects()
            tools.setup_working_dir(folder)
            tools.setup_ccx()
            message = tools.check_prerequisites()
            if message:
                raise RuntimeError(message)
            tools.purge_results()
            tools.write_inp_file()
            with open(tools.inp_file_name) as file:
                text = file.read()
            self.deck = Deck(text)
            self.status, printed = 0, ""
            if solve:
                with open(tools.inp_file_name, "w") as file:
                    file.write(self._with_print(self._tied(text, pairs)))
                self.status = tools.ccx_run()
                tools.load_results()
                with open(os.path.splitext(tools.inp_file_name)[0] + ".dat") as file:
                    printed = file.read()
        self.results = [m for m in doc.Analysis.Group if m.isDerivedFrom("Fem::FemResultObject")]
        self.forces = self.deck.forces()
        self.load = sum(self.forces.values(), np.zeros(3))
        self.magnitude = self.deck.magnitude()
        self.reaction, self.held_magnitude = self._reaction(printed)

    def _with_print(self, text):
        supports = self.deck.supports()
        if not supports:
            return text
        nset = "*NSET,NSET=SUPPORTS\n" + "".join(f"{n},\n" for n in sorted(supports))
        request = "*NODE PRINT,NSET=SUPPORTS,TOTALS=YES,GLOBAL=YES\nRF\n"
        return text.replace("*STEP", nset + "*STEP", 1).replace("*END STEP", request + "*END STEP", 1)

    def _tied(self, text, pairs):
        """The deck with equations that give both nodes of each pair the same displacement (and rotation)."""
        shell = any(kind.startswith("S") for kind, _ in self.deck.elements.values())
        held = self.deck.held()
        lines = []
        for a, b in pairs:
            for dof in range(1, 7 if shell else 4):
                if a not in held.get(dof, ()):
                    lines.append(f"*EQUATION\n2\n{a},{dof},1.,{b},{dof},-1.\n")
        return text.replace("*STEP", "".join(lines) + "*STEP", 1)

    def _reaction(self, printed):
        """(sum of the supports' reactions, sum of the magnitudes at the nodes); None if CalculiX printed none."""
        found = re.search(r"forces \(fx,fy,fz\) for set SUPPORTS.*?\n\s*\n((?:\s*\d+(?:\s+\S+){3}\n)+)", printed)
        total = re.search(r"total force \(fx,fy,fz\) for set SUPPORTS.*?\n\s*\n\s*(\S+)\s+(\S+)\s+(\S+)", printed)
        if not total:
            return None, 0
        nodes = np.array([line.split()[1:4] for line in found[1].splitlines() if line.strip()], float)
        # CalculiX prints the force in the elements: what is loaded straight onto a support is in it.
        onto_support = sum((f for n, f in self.forces.items() if n in self.deck.supports()), np.zeros(3))
        return np.array(total.groups(), float) - onto_support, np.linalg.norm(nodes, axis=1).sum()


class ExamplesTest(unittest.TestCase):
    maxDiff = None
    table = []

    def setUp(self):
        self.doc = FreeCAD.newDocument("FemScalpelExample")

    def tearDown(self):
        FreeCAD.closeDocument(self.doc.Name)

    @classmethod
    def tearDownClass(cls):
        if cls.table:
            head = (
                "example",
                "elements",
                "doubled",
                "quality",
                "load",
                "change",
                "reaction",
                "change",
                "supports",
                "sets",
            )
            rows = [head, *cls.table]
            widths = [max(len(row[i]) for row in rows) for i in range(len(head))]
            print("\n" + "\n".join("  ".join(cell.ljust(w) for cell, w in zip(row, widths)).rstrip() for row in rows))
            cls.table.clear()

    def check(self, example, prepare=None):
        names = [example.module, RENAMED.get(example.module, example.module)]
        name = next((n for n in names if importlib.util.find_spec("femexamples." + n)), None)
        if name is None:
            self.skipTest(f"this FreeCAD has no example {example.module}")
        module = importlib.import_module("femexamples." + name)
        module.setup(self.doc, solvertype="ccxtools")
        self.doc.recompute()
        source = self.doc.Mesh
        if source.FemMesh.NodeCount == 0:
            need("gmsh", "Gmsh")
            from femmesh.gmshtools import GmshTools

            self.assertFalse(GmshTools(source).create_mesh())
        if prepare:
            prepare(source)
        before = Solved(self.doc, solve=example.solve)

        crack = ObjectsFemScalpel.makeCrack(self.doc, source, **example.crack)
        self.doc.recompute()
        self.assertNotIn("Invalid", crack.State)
        self.assertEqual(crack.OffShape, [])
        ObjectsFemScalpel.putIntoAnalysis(crack)
        after = Solved(self.doc, self.lips(crack) if example.tie else (), example.solve)
        self.compare(example, crack, before, after)
        return crack, before, after

    def compare(self, example, crack, before, after):
        self.assertEqual((before.status, after.status), (0, 0))
        if not (example.frequency and not before.deck.supports()):
            self.assertEqual(len(after.results), len(before.results))
        one = before.magnitude or before.held_magnitude or 1
        load = max(np.linalg.norm(after.load - before.load), abs(after.magnitude - before.magnitude)) / one
        self.assertLessEqual(
            load, example.load, f"load {before.load} -> {after.load}, {before.magnitude} -> {after.magnitude}"
        )
        reaction = 0
        if before.reaction is not None and not example.frequency:
            reaction = np.linalg.norm(after.reaction - before.reaction) / one
            self.assertLessEqual(
                reaction, max(example.load, example.reaction), f"reaction {before.reaction} -> {after.reaction}"
            )
        held = self.changes(before.deck.nsets, self.held_by, before, after)
        sets = self.changes(before.deck.elsets, lambda solved, name: solved.deck.measure(name), before, after)
        sets.update(
            self.changes(before.deck.surfaces, lambda solved, name: solved.deck.surface_area(name), before, after)
        )
        for name, change in {**held, **sets}.items():
            self.assertLessEqual(change, example.measure, name)
        self.table.append(
            (
                example.module + (" (tied)" if example.tie else "") + (" (finite)" if example.finite else ""),
                f"{crack.Source.FemMesh.VolumeCount or crack.Source.FemMesh.FaceCount} -> "
                f"{crack.FemMesh.VolumeCount or crack.FemMesh.FaceCount}",
                str(crack.NodesDoubled),
                f"{crack.MinimumQuality:.2f}",
                f"{np.linalg.norm(after.load):.6g}",
                f"{load:.0e}",
                f"{np.linalg.norm(after.reaction):.6g}"
                if after.reaction is not None and not example.frequency
                else "-",
                f"{reaction:.0e}",
                f"{max(held.values(), default=0):.0e}",
                f"{max(sets.values(), default=0):.0e}",
            )
        )

    def held_by(self, solved, name):
        """How much of the mesh a constraint's nodes are: area, length, or number of places."""
        nodes = set(solved.deck.nsets[name])
        constraint = self.doc.getObject(name)
        if constraint and constraint.References[0][1][0].startswith("Vertex"):
            return solved.deck.places(nodes)
        return solved.deck.skin_in(nodes)

    @staticmethod
    def changes(names, measure, before, after):
        """Relative change of the measure of each set that has one."""
        result = {}
        for name in names:
            if name != "Nall":
                first = measure(before, name)
                result[name] = abs(measure(after, name) - first) / first if first else float(measure(after, name) != 0)
        return result

    @staticmethod
    def lips(crack):
        """Pairs of nodes that the crack has put in the place of one."""
        known, places = crack.Source.FemMesh.Nodes, {}
        for number, point in crack.FemMesh.Nodes.items():
            places.setdefault(tuple(point), []).append(number)
        return [
            (numbers[0], other)
            for numbers in places.values()
            if len(numbers) > 1
            for other in numbers[1:]
            if other not in known
        ]


class Examples(ExamplesTest):
    """One test per example, made below."""

    table = []


class ExamplesWithFiniteCracks(ExamplesTest):
    """One test per example, made below."""

    table = []


class ExamplesByGroupName(ExamplesTest):
    """The same with mesh groups that FreeCAD finds by the names of constraints and materials, without the geometry."""

    table = []

    def add_groups(self, source):
        from femmesh.meshtools import get_femnodes_by_references

        femmesh, rest, remaining = source.FemMesh.copy(), None, set(source.FemMesh.Volumes)
        for member in self.doc.Analysis.Group:
            if member.isDerivedFrom("App::MaterialObjectPython"):
                if not getattr(member, "References", None):
                    rest = member
                    continue
                nodes = set(get_femnodes_by_references(femmesh, member.References))
                volumes = [v for v in femmesh.Volumes if nodes.issuperset(femmesh.getElementNodes(v))]
                femmesh.addGroupElements(femmesh.addGroup(member.Name + "_Volumes", "Volume"), volumes)
                remaining -= set(volumes)
            elif getattr(member, "References", None):
                nodes = get_femnodes_by_references(femmesh, member.References)
                femmesh.addGroupElements(femmesh.addGroup(member.Name + "_Nodes", "Node"), nodes)
        if rest:
            femmesh.addGroupElements(femmesh.addGroup(rest.Name + "_Volumes", "Volume"), sorted(remaining))
        source.FemMesh = femmesh
        self.doc.recompute()

    def check_groups(self, example):
        crack, _, after = self.check(example, self.add_groups)
        femmesh = crack.FemMesh
        groups = {femmesh.getGroupName(g): set(femmesh.getGroupElements(g)) for g in femmesh.Groups}
        used = 0
        for name, nodes in after.deck.nsets.items():
            if name + "_Nodes" in groups:
                self.assertEqual(set(nodes), groups[name + "_Nodes"], name)
                used += 1
        for name, elements in after.deck.elsets.items():
            if name.endswith("Solid") and name[:-5] + "_Volumes" in groups:
                self.assertEqual(set(elements), groups[name[:-5] + "_Volumes"], name)
                used += 1
        self.assertGreaterEqual(used, 2)


def _test_of(example, method):
    def test(self):
        getattr(self, method)(example)

    return test


for _example in SOLIDS + SHELLS:
    setattr(Examples, "test_" + _example.module, _test_of(_example, "check"))
    if _example.module in (
        "boxanalysis_static",
        "ccx_cantilever_prescribeddisplacement",
        "constraint_transform_beam_hinged",
        "material_multiple_tensionrod_twoboxes",
        "material_multiple_bendingbeam_fiveboxes",
        "thermomech_bimetall",
    ):
        setattr(ExamplesByGroupName, "test_" + _example.module, _test_of(_example, "check_groups"))

for _example in FINITE:
    setattr(ExamplesWithFiniteCracks, "test_" + _example.module, _test_of(_example, "check"))
