# SPDX-License-Identifier: LGPL-2.1-or-later
"""Gmsh's .msh as Gmsh itself reads it."""

import numpy as np
import pytest

import femscalpel as fs
from meshes import box_with_groups

# Gmsh's element types by ours.
TYPES = {
    "vertex": 15,
    "line": 1,
    "line3": 8,
    "triangle": 2,
    "triangle6": 9,
    "quad": 3,
    "quad8": 16,
    "quad9": 10,
    "tetra": 4,
    "tetra10": 11,
    "pyramid": 7,
    "pyramid13": 19,
    "wedge": 6,
    "wedge15": 18,
    "wedge18": 13,
    "hexahedron": 5,
    "hexahedron20": 17,
    "hexahedron27": 12,
}


@pytest.fixture
def gmsh():
    module = pytest.importorskip("gmsh")
    module.initialize()
    module.option.setNumber("General.Terminal", 0)
    yield module
    module.finalize()


def in_gmsh(gmsh, path):
    """Coordinates by node number, and per physical group (dimension, name) its element numbers, as Gmsh read them."""
    gmsh.open(str(path))
    numbers, points, _ = gmsh.model.mesh.getNodes()
    nodes = dict(zip(numbers.tolist(), points.reshape(-1, 3).tolist()))
    groups = {}
    for dimension, tag in gmsh.model.getPhysicalGroups():
        members = set()
        for entity in gmsh.model.getEntitiesForPhysicalGroup(dimension, tag):
            for of_type in gmsh.model.mesh.getElements(dimension, entity)[1]:
                members.update(of_type.tolist())
        groups[dimension, gmsh.model.getPhysicalName(dimension, tag)] = members
    return nodes, groups


def elements(gmsh, number):
    kinds, ids, nodes = gmsh.model.mesh.getElements()
    for kind, of_kind, flat in zip(kinds, ids, nodes):
        if kind == number:
            rows = flat.reshape(len(of_kind), -1)
            return {int(i): row.tolist() for i, row in zip(of_kind, rows)}
    return {}


def node_group(gmsh, name):
    for dimension, tag in gmsh.model.getPhysicalGroups(0):
        if gmsh.model.getPhysicalName(dimension, tag) == name:
            return sorted(gmsh.model.mesh.getNodesForPhysicalGroup(dimension, tag)[0].tolist())
    return []


def test_overlapping_groups_and_numbers(tmp_path, gmsh, recwarn):
    mesh = box_with_groups()
    numbers = mesh.cell_ids["tetra"]
    mesh.add_group("Träger A 1", "element", numbers[::2])
    mesh.add_group("every third", "element", numbers[::3])
    mesh.add_group("NODES 2", "node", mesh.node_ids[::5])
    mesh.add_group("NODES 3", "node", mesh.node_ids[::3])
    fs.write(mesh, tmp_path / "box.msh")
    assert not recwarn
    nodes, groups = in_gmsh(gmsh, tmp_path / "box.msh")
    assert nodes == dict(zip(mesh.node_ids.tolist(), mesh.points.tolist()))
    read = elements(gmsh, TYPES["tetra"])
    for number, cell in zip(numbers, mesh.cells["tetra"]):
        assert read[number] == mesh.node_ids[cell].tolist()
    assert len(read) == len(numbers)
    for group in mesh.groups.all():
        if group.kind == "node":
            assert node_group(gmsh, group.name) == sorted(group.ids), group.name
        else:
            found = set().union(*(m for (d, name), m in groups.items() if name == group.name and d > 0))
            assert found == set(group.ids.tolist()), group.name


@pytest.mark.parametrize("name", sorted(TYPES))
def test_node_order(tmp_path, gmsh, name):
    """An element whose nodes lie where Gmsh has them comes back in Gmsh's own order."""
    number = TYPES[name]
    _, dimension, _, count, local, _ = gmsh.model.mesh.getElementProperties(number)
    where = np.zeros((count, 3))
    where[:, :dimension] = np.asarray(local).reshape(count, -1)[:, :dimension] if dimension else 0
    mesh = fs.Mesh(points=in_our_order(where, name), cells={name: [list(range(count))]})
    fs.write(mesh, tmp_path / "one.msh")
    gmsh.open(str(tmp_path / "one.msh"))
    (row,) = elements(gmsh, number).values()
    np.testing.assert_allclose([gmsh.model.mesh.getNode(n)[0] for n in row], where, atol=1e-12)


# The edges of our types, in the order of their middle nodes (meshio's and VTK's documentation); then faces.
EDGES = {
    "line": [(0, 1)],
    "triangle": [(0, 1), (1, 2), (2, 0)],
    "quad": [(0, 1), (1, 2), (2, 3), (3, 0)],
    "tetra": [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
    "pyramid": [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)],
    "wedge": [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
    "hexahedron": [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)],
}
FACES = {
    "quad9": [(0, 1, 2, 3)],
    "wedge18": [(0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)],
    "hexahedron27": [(0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 2, 6, 7), (0, 1, 2, 3), (4, 5, 6, 7), range(8)],
}


def in_our_order(where, name):
    """The points of Gmsh's reference element in our order: its corners, which are the same, and means of these."""
    linear = name.rstrip("0123456789")
    if name == linear:
        return where
    corners = where[: 1 + max(max(e) for e in EDGES[linear])]
    middles = [corners[list(e)].mean(axis=0) for e in EDGES[linear]]
    return np.array([*corners, *middles, *(corners[list(f)].mean(axis=0) for f in FACES.get(name, []))])


def test_losses_are_told(tmp_path):
    (tmp_path / "one.inp").write_text(
        "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4,ELSET=ALL\n1,1,2,3,4\n"
        "*SURFACE,NAME=PRESSED\nALL,S2\n*MATERIAL,NAME=STEEL\n"
    )
    mesh = fs.read(tmp_path / "one.inp")
    mesh.unit = "mm"
    expected = "one.msh does not hold the facet group 'PRESSED'; the unit 'mm'; the cards of the deck .*"
    with pytest.warns(UserWarning, match=expected):
        fs.write(mesh, tmp_path / "one.msh")


@pytest.mark.parametrize("name", ['say "A"', "two\nlines", "x" * 128])
def test_names_that_gmsh_cannot_hold(tmp_path, name):
    mesh = box_with_groups()
    mesh.add_group(name, "node", mesh.node_ids[:2])
    (tmp_path / "box.msh").write_text("before")
    with pytest.raises(fs.WriteError, match="box.msh: Gmsh's names have 1 to 127 bytes.*rename the group"):
        fs.write(mesh, tmp_path / "box.msh")
    assert (tmp_path / "box.msh").read_text() == "before"


def test_elements_that_gmsh_has_not(tmp_path):
    mesh = fs.Mesh(points=np.random.default_rng(1).random((7, 3)), cells={"triangle7": [list(range(7))]})
    with pytest.raises(fs.WriteError, match="1 elements of type triangle7, which Gmsh does not have"):
        fs.write(mesh, tmp_path / "one.msh")
    assert not list(tmp_path.iterdir())
