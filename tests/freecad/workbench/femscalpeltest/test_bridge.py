# SPDX-License-Identifier: LGPL-2.1-or-later
"""FemMesh to femscalpel.Mesh and back."""

import os
import re
import tempfile
import unittest

import Fem
import numpy as np

import femmesh_bridge
import femscalpel as fs

from .documents import content, groups_of
from .meshes import tetra_volumes

EDGES = {
    "tetra": ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)),
    "pyramid": ((0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)),
    "wedge": ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)),
    "hexahedron": ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)),
    "line": ((0, 1),),
    "triangle": ((0, 1), (1, 2), (2, 0)),
    "quad": ((0, 1), (1, 2), (2, 3), (3, 0)),
}
CORNERS = {
    "tetra": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    "pyramid": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.4, 0.4, 1]],
    "wedge": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]],
    "hexahedron": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]],
    "line": [[0, 0, 0], [1, 0, 0]],
    "triangle": [[0, 0, 0], [1, 0, 0], [0, 1, 0]],
    "quad": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]],
}
QUADRATIC = {
    "tetra": "tetra10",
    "pyramid": "pyramid13",
    "wedge": "wedge15",
    "hexahedron": "hexahedron20",
    "line": "line3",
    "triangle": "triangle6",
    "quad": "quad8",
}


def one_element(shape, order):
    """A mesh of one element with mid-side nodes, if of order 2, in the middle of its edges."""
    corners = np.array(CORNERS[shape], float)
    if order == 1:
        return fs.Mesh(corners, {shape: [range(len(corners))]})
    points = np.concatenate([corners, [corners[[i, j]].mean(axis=0) for i, j in EDGES[shape]]])
    return fs.Mesh(points, {QUADRATIC[shape]: [range(len(points))]})


def all_types():
    """One mesh with an element of every type a FemMesh can hold, apart from each other, with sparse numbers."""
    points, cells, ids, first = [], {}, {}, 0
    for number, (shape, order) in enumerate((s, o) for s in CORNERS for o in (1, 2)):
        mesh = one_element(shape, order)
        ((name, nodes),) = mesh.cells.items()
        points.append(mesh.points + [3.0 * number, 0.1, 1 / 3])
        cells[name], ids[name] = nodes + first, [1000 - 7 * number]
        first += mesh.node_count
    points = np.concatenate(points)
    return fs.Mesh(points, cells, 5 * np.arange(len(points), 0, -1), ids)


class Bridge(unittest.TestCase):
    def test_all_types_there_and_back(self):
        mesh = all_types()
        femmesh = femmesh_bridge.to_femmesh(mesh)
        self.assertEqual((femmesh.EdgeCount, femmesh.FaceCount, femmesh.VolumeCount), (2, 4, 8))
        self.assertEqual(
            (femmesh.TetraCount, femmesh.PyramidCount, femmesh.PrismCount, femmesh.HexaCount), (2, 0, 2, 4)
        )
        self.assertEqual(content(femmesh_bridge.from_femmesh(femmesh)), content(mesh))

    def test_node_order_is_what_freecad_writes_for_calculix(self):
        for shape in ("tetra", "wedge", "hexahedron", "triangle", "quad", "line"):
            for order in (1, 2):
                with self.subTest(shape=shape, order=order), tempfile.TemporaryDirectory() as folder:
                    mesh = one_element(shape, order)
                    path = os.path.join(folder, "one.inp")
                    femmesh_bridge.to_femmesh(mesh).writeABAQUS(path, 1, False)
                    with open(path) as file:
                        rows = re.search(r"\*Element,.*?\n(.*?)\n\s*\*", file.read() + "\n*", re.S | re.I)[1]
                    nodes = [int(n) for n in rows.replace("\n", " ").split(",") if n.strip()][1:]
                    points = mesh.points[np.array(nodes) - 1]
                    # CalculiX: corners turn the positive way round; mid-side nodes in the order of our edges.
                    # Lines of three nodes are the exception, they run along the line.
                    if shape == "line":
                        self.assertEqual(nodes, [1, 2] if order == 1 else [1, 3, 2])
                        continue
                    corners = len(CORNERS[shape])
                    base = 2 if shape in ("tetra", "wedge", "triangle") else 3
                    if shape not in ("triangle", "quad"):
                        up = points[base + 1] - points[0]
                        self.assertGreater(np.linalg.det([points[1] - points[0], points[base] - points[0], up]), 0)
                    else:
                        self.assertGreater(np.cross(points[1] - points[0], points[base] - points[0])[2], 0)
                    if order == 2:
                        for k, (i, j) in enumerate(EDGES[shape]):
                            np.testing.assert_allclose(points[corners + k], (points[i] + points[j]) / 2)

    def test_pyramids_of_freecad(self):
        # SMESH: base turned the other way round, then the top; mid-side nodes along base edges, then from the base up.
        for order in (1, 2):
            mesh = one_element("pyramid", order)
            femmesh = Fem.FemMesh()
            for number, point in enumerate(mesh.points, 1):
                femmesh.addNode(*point, number)
            nodes = [1, 4, 3, 2, 5] + [9, 8, 7, 6, 10, 13, 12, 11] * (order - 1)
            femmesh.addVolume(nodes, 1)
            self.assertEqual(femmesh.PyramidCount, 1)
            self.assertEqual(content(femmesh_bridge.from_femmesh(femmesh)), content(mesh))

    def test_pyramids_are_in_freecads_deck(self):
        # As hexahedra: pyramids would be missing, without a word.
        for order in (1, 2):
            with tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, "one.inp")
                mesh = one_element("pyramid", order)
                femmesh_bridge.to_femmesh(mesh).writeABAQUS(path, 1, False)
                read = fs.read(path)
                ((name, nodes),) = mesh.cells.items()
                self.assertEqual(read.cells[name].tolist(), nodes.tolist())
                np.testing.assert_allclose(read.points, mesh.points)

    def test_hexahedra_with_any_face_in_one_point_are_pyramids(self):
        corners = np.array(CORNERS["hexahedron"])
        edges = EDGES["hexahedron"]
        for axis, end in ((a, e) for a in range(3) for e in (0, 1)):
            face = np.nonzero(corners[:, axis] == end)[0]
            nodes = np.arange(8)
            nodes[face] = face[0]
            middles = [nodes[i] if nodes[i] == nodes[j] else 8 + k for k, (i, j) in enumerate(edges)]
            points = np.concatenate([corners, [(corners[nodes[i]] + corners[nodes[j]]) / 2 for i, j in edges]])
            for name, all_nodes in (("hexahedron", nodes), ("hexahedron20", np.concatenate([nodes, middles]))):
                order = femmesh_bridge._ORDER[name]
                femmesh = Fem.FemMesh()
                for n in sorted(set(all_nodes.tolist())):
                    femmesh.addNode(*points[n], n + 1)
                femmesh.addVolume((all_nodes[list(order)] + 1).tolist(), 1)
                mesh = femmesh_bridge.from_femmesh(femmesh)
                ((kind, (row,)),) = mesh.cells.items()
                tip = row[4]
                self.assertEqual(kind, "pyramid" if name == "hexahedron" else "pyramid13")
                np.testing.assert_array_equal(mesh.points[tip], corners[face[0]])
                self.assertAlmostEqual(fs.measure(mesh)[kind][0], 1 / 3)
                for k, (i, j) in enumerate(EDGES["pyramid"] if name == "hexahedron20" else ()):
                    np.testing.assert_allclose(mesh.points[row[5 + k]], mesh.points[row[[i, j]]].mean(axis=0))

    def test_meshes_of_freecads_examples_have_positive_volumes(self):
        from femexamples.meshes import mesh_canticcx_tetra10

        femmesh = Fem.FemMesh()
        mesh_canticcx_tetra10.create_nodes(femmesh)
        mesh_canticcx_tetra10.create_elements(femmesh)
        mesh = femmesh_bridge.from_femmesh(femmesh)
        volumes = tetra_volumes(mesh.points, mesh.cells["tetra10"])
        self.assertGreater(volumes.min(), 0)
        self.assertAlmostEqual(volumes.sum(), 8e9, delta=1)
        for k, (i, j) in enumerate(EDGES["tetra"]):
            nodes = mesh.cells["tetra10"]
            middle = (mesh.points[nodes[:, i]] + mesh.points[nodes[:, j]]) / 2
            np.testing.assert_allclose(mesh.points[nodes[:, 4 + k]], middle, atol=1.0)

    def test_groups_there_and_back(self):
        mesh = all_types()
        tetra, line = mesh.cell_ids["tetra"], mesh.cell_ids["line"]
        mesh.add_group("nodes é", "node", mesh.node_ids[:3])
        mesh.add_group("solid", "element", tetra)
        mesh.add_group("solid", "node", mesh.node_ids[5:9])
        mesh.add_group("mixed", "element", np.concatenate([tetra, line, mesh.cell_ids["quad8"]]))
        mesh.add_group("none", "element")
        mesh.add_group("nobody", "node")
        femmesh = femmesh_bridge.to_femmesh(mesh)
        self.assertEqual(sorted(t for n, t, _ in groups_of(femmesh) if n == "mixed"), ["Edge", "Face", "Volume"])
        self.assertIn(("none", "All", ()), groups_of(femmesh))
        self.assertIn(("nobody", "Node", ()), groups_of(femmesh))
        self.assertEqual(content(femmesh_bridge.from_femmesh(femmesh)), content(mesh))

    def test_repeated_names_are_kept_apart(self):
        femmesh = femmesh_bridge.to_femmesh(one_element("tetra", 1))
        for nodes in ([1], [2, 3], [4]):
            femmesh.addGroupElements(femmesh.addGroup("twice", "Node"), nodes)
        mesh = femmesh_bridge.from_femmesh(femmesh)
        self.assertEqual(
            [(g.name, g.ids.tolist()) for g in mesh.groups.all()],
            [("twice", [1]), ("twice_2", [2, 3]), ("twice_3", [4])],
        )

    def test_elements_turned_into_a_node_group(self):
        mesh = fs.Mesh(
            CORNERS["tetra"],
            {"tetra": [[0, 1, 2, 3]], "triangle": [[0, 2, 1]]},
            groups={"LIP": ("element", [2]), "BODY": ("element", [1])},
        )
        femmesh = femmesh_bridge.to_femmesh(mesh, as_node_groups=("LIP",))
        self.assertEqual((femmesh.VolumeCount, femmesh.FaceCount), (1, 0))
        self.assertEqual(groups_of(femmesh), [("LIP", "Node", (1, 2, 3)), ("BODY", "Volume", (1,))])

    def test_what_a_femmesh_cannot_hold(self):
        points = np.arange(81.0).reshape(27, 3)
        with self.assertRaisesRegex(fs.WriteError, "hexahedron27"):
            femmesh_bridge.to_femmesh(fs.Mesh(points, {"hexahedron27": [range(27)]}))
        with self.assertRaisesRegex(fs.WriteError, "element number"):
            femmesh_bridge.to_femmesh(fs.Mesh(points, {"line": [[0, 1]]}, cell_ids={"line": [2**31]}))
        with self.assertRaisesRegex(fs.WriteError, "node number"):
            femmesh_bridge.to_femmesh(fs.Mesh(points[:1], {}, [2**31]))
        mesh = fs.Mesh(
            points[:4],
            {"tetra": [range(4)], "vertex": [[0]]},
            groups={"SIDE": ("facet", [[1, 1]]), "MASS": ("element", [2])},
        )
        femmesh = femmesh_bridge.to_femmesh(mesh)
        self.assertEqual(femmesh.VolumeCount, 1)
        self.assertEqual(groups_of(femmesh), [("MASS", "All", ())])

    def test_empty(self):
        self.assertEqual(femmesh_bridge.to_femmesh(fs.Mesh([], {})).NodeCount, 0)
        self.assertEqual(femmesh_bridge.from_femmesh(Fem.FemMesh()).node_count, 0)
