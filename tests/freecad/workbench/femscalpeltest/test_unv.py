# SPDX-License-Identifier: LGPL-2.1-or-later
"""Universal files (.unv): FreeCAD reads ours, we read FreeCAD's."""

import os
import tempfile
import unittest

import Fem
import numpy as np

import femmesh_bridge
import femscalpel as fs

from .documents import content
from .test_bridge import CORNERS, EDGES, one_element

# FreeCAD writes no pyramids of five nodes and puts the nodes of those of thirteen in an order of its own.
SHAPES = [shape for shape in CORNERS if shape != "pyramid"]


def every_shape():
    """All elements that both sides write, apart from each other, with sparse numbers, and groups of them."""
    points, cells, ids, first = [], {}, {}, 0
    for number, (shape, order) in enumerate((s, o) for s in SHAPES for o in (1, 2)):
        mesh = one_element(shape, order)
        ((name, nodes),) = mesh.cells.items()
        points.append(mesh.points + [3.0 * number, 0.1, 1 / 3])
        cells[name], ids[name] = nodes + first, [1000 - 7 * number]
        first += mesh.node_count
    points = np.concatenate(points)
    mesh = fs.Mesh(points, cells, 5 * np.arange(len(points), 0, -1), ids)
    mesh.add_group("Träger A", "element", np.concatenate([mesh.cell_ids["tetra"], mesh.cell_ids["wedge15"]]))
    mesh.add_group("overlaps", "element", mesh.cell_ids["tetra"])
    mesh.add_group("faces", "element", np.concatenate([mesh.cell_ids["quad8"], mesh.cell_ids["triangle"]]))
    mesh.add_group("FIX", "node", mesh.node_ids[3:20:2])
    return mesh


def by_place(mesh):
    """Elements and groups by where their nodes lie, in order: FreeCAD counts anew what it reads."""
    nodes, elements, groups = content(mesh)
    place = {n: tuple(np.round(p, 9)) for n, p in nodes.items()}
    placed = {i: (name, tuple(place[n] for n in row)) for i, (name, row) in elements.items()}
    members = {key: {(place if key[1] == "node" else placed)[i] for i in ids} for key, ids in groups.items()}
    return set(place.values()), set(placed.values()), members


class Unv(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = os.path.join(self.folder.name, "mesh.unv")

    def tearDown(self):
        self.folder.cleanup()

    def test_freecad_reads_ours(self):
        mesh = every_shape()
        fs.write(mesh, self.path)
        points, elements, groups = by_place(femmesh_bridge.from_femmesh(Fem.read(self.path)))
        expected = by_place(mesh)
        self.assertEqual(points, expected[0])
        self.assertEqual(elements, expected[1])
        self.assertEqual(groups, expected[2])

    def test_we_read_what_freecad_writes(self):
        mesh = every_shape()
        femmesh_bridge.to_femmesh(mesh).write(self.path)
        back = fs.read(self.path)
        self.assertEqual(content(back)[:2], content(mesh)[:2])
        groups = {name for name, _ in content(back)[2]}
        if groups:  # FreeCAD 0.20 writes none
            self.assertEqual(content(back)[2], content(mesh)[2])

    def test_elements_are_of_the_shape_they_had(self):
        """Independent of any bridge: corners turn the right way round, middles lie in the middle of edges."""
        femmesh_bridge.to_femmesh(every_shape()).write(self.path)
        mesh = fs.read(self.path)
        names = {"tetra10": "tetra", "wedge15": "wedge", "hexahedron20": "hexahedron", "line3": "line"}
        names.update({"triangle6": "triangle", "quad8": "quad"})
        for name, shape in names.items():
            points = mesh.points[mesh.cells[name][0]]
            for k, (i, j) in enumerate(EDGES[shape]):
                middle = points[len(CORNERS[shape]) + k]
                np.testing.assert_allclose(middle, (points[i] + points[j]) / 2, atol=1e-12, err_msg=name)
        for name, volumes in fs.measure(mesh).items():
            self.assertTrue((volumes > 0).all(), name)
