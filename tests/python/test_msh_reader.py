# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of Gmsh and meshio: what is read of them against what these programs themselves say."""

import itertools

import numpy as np
import pytest

import femscalpel as fs
from meshes import box_with_groups
from test_msh import TYPES, in_our_order

FORMATS = [(2.2, 0), (2.2, 1), (4.0, 0), (4.1, 0), (4.1, 1)]  # version, binary; Gmsh writes no binary 4.0


@pytest.fixture
def gmsh():
    module = pytest.importorskip("gmsh")
    module.initialize()
    module.option.setNumber("General.Terminal", 0)
    yield module
    module.finalize()


def save(gmsh, path, version=4.1, binary=0):
    gmsh.option.setNumber("Mesh.MshFileVersion", version)
    gmsh.option.setNumber("Mesh.Binary", binary)
    gmsh.write(str(path))
    return path


def nodes_of(mesh, group):
    """The members of a group as sets of their nodes' numbers, sorted: what stays where elements are numbered anew."""
    if group.kind == "node":
        return sorted((n,) for n in group.ids.tolist())
    ids = set(group.ids.tolist())
    out = []
    for kind, cells in mesh.cells.items():
        chosen = [number in ids for number in mesh.cell_ids[kind].tolist()]
        out += [tuple(sorted(row)) for row in mesh.node_ids[cells[chosen]].tolist()]
    return sorted(out)


def places_of(mesh, group):
    """The same by the nodes' places, where these are numbered anew, too."""
    place = dict(zip(mesh.node_ids.tolist(), map(tuple, mesh.points.round(9).tolist())))
    return sorted(tuple(sorted(place[n] for n in row)) for row in nodes_of(mesh, group))


def groups_in_gmsh(gmsh):
    """Per physical group's name (Gmsh's own for those without) the same, as Gmsh has it in its memory."""
    unnamed = ("PhysicalPoint", "PhysicalLine", "PhysicalSurface", "PhysicalVolume")
    out = {}
    for dimension, tag in gmsh.model.getPhysicalGroups():
        name = gmsh.model.getPhysicalName(dimension, tag) or f"{unnamed[dimension]}{tag}"
        rows = out.setdefault(name, [])
        for entity in gmsh.model.getEntitiesForPhysicalGroup(dimension, tag):
            for _, ids, nodes in zip(*gmsh.model.mesh.getElements(dimension, abs(entity))):
                rows += [tuple(sorted(row)) for row in nodes.reshape(len(ids), -1).tolist()]
    return {name: sorted(rows) for name, rows in out.items()}


def box(gmsh, order=1, recombined=False):
    """A box of Gmsh with overlapping physical groups, some without a name, one of two dimensions."""
    gmsh.clear()
    gmsh.model.occ.addBox(0, 0, 0, 1, 2, 3)
    gmsh.model.occ.synchronize()
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.8)
    if recombined:
        for curve in gmsh.model.getEntities(1):
            gmsh.model.mesh.setTransfiniteCurve(curve[1], 4)
        for surface in gmsh.model.getEntities(2):
            gmsh.model.mesh.setTransfiniteSurface(surface[1])
            gmsh.model.mesh.setRecombine(2, surface[1])
        gmsh.model.mesh.setTransfiniteVolume(1)
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.setOrder(order)
    named = {
        (3, 1): ([1], "Körper 1"),
        (3, 7): ([1], ""),
        (2, 8): ([1, 2], "wall"),
        (2, 9): ([2, 3], "wall 2"),
        (2, 4): ([4], ""),
        (1, 2): ([1, 2, 5], "wall"),
        (0, 5): ([1, 2], ""),
        (0, 6): ([2, 3], "tips"),
    }
    for (dimension, tag), (entities, name) in named.items():
        gmsh.model.addPhysicalGroup(dimension, entities, tag)
        if name:
            gmsh.model.setPhysicalName(dimension, tag, name)


@pytest.mark.parametrize("version, binary", FORMATS)
@pytest.mark.parametrize("order, recombined", itertools.product((1, 2), (False, True)))
def test_files_of_gmsh(tmp_path, gmsh, version, binary, order, recombined):
    box(gmsh, order, recombined)
    path = save(gmsh, tmp_path / "box.msh", version, binary)
    if version < 4:
        with pytest.warns(UserWarning, match="elements repeat the one before them in another physical group"):
            mesh = fs.read(path)
    else:
        mesh = fs.read(path)
        assert not mesh.input_warnings
    mesh.validate()
    expected = groups_in_gmsh(gmsh)
    assert {g.name: nodes_of(mesh, g) for g in mesh.groups.all()} == expected
    assert [g.kind for g in mesh.groups.all()].count("node") == 2
    numbers, points, _ = gmsh.model.mesh.getNodes()
    by_number = dict(zip(numbers.tolist(), points.reshape(-1, 3).tolist()))
    for number, point in zip(mesh.node_ids.tolist(), mesh.points.tolist()):
        assert point == pytest.approx(by_number[number], rel=0 if binary else 1e-15, abs=0)  # text has 16 digits
    volume = sum(v.sum() for kind, v in fs.measure(mesh).items() if fs.mesh.CELL_TYPES[kind][0] == 3)
    assert volume == pytest.approx(6)
    assert all((v > 0).all() for v in fs.measure(mesh).values())
    assert "vertex" not in mesh.cells
    if version >= 4:
        solid = {(1, False): 4, (2, False): 11, (1, True): 5, (2, True): 12}[order, recombined]
        kinds, ids, _ = gmsh.model.mesh.getElements(3)
        assert kinds.tolist() == [solid]
        (name,) = (t for t, number in TYPES.items() if number == solid)
        assert mesh.cell_ids[name].tolist() == ids[0].tolist()


@pytest.mark.parametrize("name", sorted(TYPES))
@pytest.mark.parametrize("version, binary", FORMATS)
def test_node_order(tmp_path, gmsh, name, version, binary):
    """An element that Gmsh writes has its nodes where Gmsh has them."""
    number = TYPES[name]
    _, dimension, _, count, local, _ = gmsh.model.mesh.getElementProperties(number)
    where = np.zeros((count, 3))
    if dimension:
        where[:, :dimension] = np.asarray(local).reshape(count, -1)[:, :dimension]
    entity = gmsh.model.addDiscreteEntity(dimension)
    nodes = np.arange(count) + 5
    gmsh.model.mesh.addNodes(dimension, entity, nodes, where.ravel())
    gmsh.model.mesh.addElementsByType(entity, number, [77], nodes)
    gmsh.option.setNumber("Mesh.SaveAll", 1)
    mesh = fs.read(save(gmsh, tmp_path / "one.msh", version, binary))
    (cells,) = mesh.cells.values()
    assert list(mesh.cells) == [name]
    np.testing.assert_allclose(mesh.points[cells[0]], in_our_order(where, name), atol=1e-12)


@pytest.mark.parametrize("version, binary", FORMATS)
def test_partitioned_files(tmp_path, gmsh, version, binary):
    box(gmsh)
    whole = fs.read(save(gmsh, tmp_path / "whole.msh"))
    gmsh.option.setNumber("Mesh.PartitionCreateTopology", 1)
    gmsh.option.setNumber("Mesh.PartitionCreateGhostCells", 1)
    gmsh.model.mesh.partition(3)
    path = save(gmsh, tmp_path / "box.msh", version, binary)
    with pytest.warns(UserWarning, match="partitions"):
        mesh = fs.read(path)
    mesh.validate()
    assert {g.name for g in mesh.groups.all()} == {g.name for g in whole.groups.all()}
    for group in whole.groups.all():
        assert places_of(mesh, mesh.groups[group.name, group.kind]) == places_of(whole, group), group
    if version >= 4:
        assert "GhostElements is not read: which elements are ghosts" in " ".join(mesh.input_warnings)


@pytest.mark.parametrize("version, binary", FORMATS)
def test_parametric_nodes(tmp_path, gmsh, version, binary):
    box(gmsh)
    plain = save(gmsh, tmp_path / "plain.msh")
    gmsh.option.setNumber("Mesh.SaveParametric", 1)
    path = save(gmsh, tmp_path / "box.msh", version, binary)
    with pytest.warns(UserWarning, match="parametric coordinates are not read"):
        mesh = fs.read(path)
    expected = fs.read(plain)
    np.testing.assert_allclose(mesh.points, expected.points, atol=1e-14)
    assert [nodes_of(mesh, g) for g in mesh.groups.all()] == [nodes_of(expected, g) for g in expected.groups.all()]


@pytest.mark.parametrize("version, binary", FORMATS)
def test_negative_groups(tmp_path, gmsh, version, binary):
    """Gmsh turns the elements of a negative group round in files of version 2; version 4 leaves that to the reader."""
    gmsh.model.occ.addRectangle(0, 0, 0, 1, 1)
    gmsh.model.occ.synchronize()
    gmsh.model.mesh.generate(2)
    gmsh.model.mesh.setOrder(2)
    gmsh.model.addPhysicalGroup(2, [-1], 3)
    gmsh.model.setPhysicalName(2, 3, "below")
    mesh = fs.read(save(gmsh, tmp_path / "square.msh", version, binary))
    corners = mesh.points[mesh.cells["triangle6"][:, :3]]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (normals[:, 2] < 0).all()
    for k, ends in enumerate([(0, 1), (1, 2), (2, 0)]):
        middles = mesh.points[mesh.cells["triangle6"][:, 3 + k]]
        np.testing.assert_allclose(middles, corners[:, ends].mean(axis=1), atol=1e-12)
    assert len(mesh.groups["below"]) == len(corners)


def test_what_gmsh_saves_again(tmp_path, gmsh):
    """Our own file, opened and saved by Gmsh in every version."""
    mesh = box_with_groups()
    mesh.add_group("Träger A 1", "element", mesh.cell_ids["tetra"][::2])
    mesh.add_group("NODES 3", "node", mesh.node_ids[::3])
    fs.write(mesh, tmp_path / "box.msh")
    for version, binary in FORMATS:
        gmsh.open(str(tmp_path / "box.msh"))
        path = save(gmsh, tmp_path / "again.msh", version, binary)
        back = fs.Mesh._wrap(fs._engine.read(str(path)))
        for group in mesh.groups.all():
            if len(group):  # Gmsh drops empty ones
                assert places_of(back, back.groups[group.name, group.kind]) == places_of(mesh, group), group


@pytest.mark.parametrize("file_format", ["gmsh", "gmsh22"])
@pytest.mark.parametrize("binary", [False, True])
def test_files_of_meshio(tmp_path, file_format, binary):
    meshio = pytest.importorskip("meshio")
    rng = np.random.default_rng(3)
    kinds = {"triangle6": 6, "line3": 3, "quad8": 8, "tetra10": 10, "hexahedron20": 20, "pyramid": 5, "wedge": 6}
    if file_format == "gmsh":  # 4.1: meshio writes one type only
        kinds = {"triangle6": 6}
    points = rng.random((30, 3))
    cells = [(kind, [rng.permutation(30)[:n] for _ in range(3)]) for kind, n in kinds.items()]
    numbers = [np.full(3, k + 1) for k in range(len(cells))]
    source = meshio.Mesh(
        points,
        cells,
        cell_data={"gmsh:physical": numbers, "gmsh:geometrical": numbers},
        field_data={"wall": np.array([1, 2]), "quads": np.array([3, 2])},
    )
    meshio.write(tmp_path / "m.msh", source, file_format=file_format, binary=binary)
    mesh = fs.Mesh._wrap(fs._engine.read(str(tmp_path / "m.msh")))
    np.testing.assert_array_equal(mesh.points, points)
    for kind, rows in cells:
        np.testing.assert_array_equal(mesh.cells[kind], rows)
    if file_format == "gmsh22":  # in 4.1 meshio writes physical groups only with entities of its own
        assert set(mesh.groups["wall"].ids) == set(mesh.cell_ids["triangle6"])
        assert set(mesh.groups["quads"].ids) == set(mesh.cell_ids["quad8"])
        assert set(mesh.groups["PhysicalVolume7"].ids) == set(mesh.cell_ids["wedge"])


def test_cracked(tmp_path, gmsh):
    """A mesh of Gmsh goes through an operator, and Gmsh reads the result."""
    box(gmsh)
    mesh = fs.read(save(gmsh, tmp_path / "box.msh"))
    result = fs.crack(mesh, fs.Plane(origin=(0.5, 1, 1.4), normal=(0.1, 0.2, 1)), name="CRACK")
    fs.write(result.mesh, tmp_path / "cracked.msh")
    back = fs.read(tmp_path / "cracked.msh")
    gmsh.open(str(tmp_path / "cracked.msh"))
    for group in result.mesh.groups.all():
        assert sorted(back.groups[group.name, group.kind].ids) == sorted(group.ids)
    assert groups_in_gmsh(gmsh)["CRACK_P"] == nodes_of(back, back.groups["CRACK_P"])
