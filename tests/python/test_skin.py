# SPDX-License-Identifier: LGPL-2.1-or-later
"""Operators that know the shape a mesh was made from: a coarse cylinder whose skin they make better."""

import numpy as np
import pytest

import femscalpel as fs

gmsh = pytest.importorskip("gmsh", reason="python3-gmsh is not installed")

RADIUS, HEIGHT = 5.0, 12.0
FACES = np.array([(0, 1, 2, 4, 5, 6), (0, 1, 3, 4, 8, 7), (1, 2, 3, 5, 9, 8), (0, 2, 3, 6, 9, 7)])


@pytest.fixture(scope="module", params=[1, 2], ids=["linear", "quadratic"])
def model(request, tmp_path_factory):
    """(mesh of a cylinder, path of its shape)."""
    folder = tmp_path_factory.mktemp("cylinder")
    gmsh.initialize(["gmsh", "-v", "2"])
    try:
        gmsh.model.occ.addCylinder(0, 0, 0, 0, 0, HEIGHT, RADIUS)
        gmsh.model.occ.synchronize()
        gmsh.write(str(folder / "cylinder.brep"))
        gmsh.model.setPhysicalName(3, gmsh.model.addPhysicalGroup(3, [1]), "BODY")
        gmsh.option.setNumber("Mesh.MeshSizeMin", 2)
        gmsh.option.setNumber("Mesh.MeshSizeMax", 2)
        gmsh.option.setNumber("Mesh.ElementOrder", request.param)
        gmsh.model.mesh.generate(3)
        gmsh.write(str(folder / "cylinder.inp"))
    finally:
        gmsh.finalize()
    return fs.read(folder / "cylinder.inp"), folder / "cylinder.brep"


def changed_skin(before, after, away_from=None):
    """Distance from the cylinder's surface of all nodes of the skin that are new or have moved; not of faces on
    `away_from`."""
    ((kind, cells),) = ((k, c) for k, c in after.cells.items() if k.startswith("tetra"))
    faces = cells[:, FACES if kind == "tetra10" else FACES[:, :3]].reshape(-1, 6 if kind == "tetra10" else 3)
    _, first, owners = np.unique(np.sort(faces[:, :3], axis=1), axis=0, return_index=True, return_counts=True)
    faces = faces[first[owners == 1]]
    if away_from is not None:
        on = np.abs(away_from.distance(after.points)) < 1e-8
        faces = faces[~on[faces[:, :3]].all(axis=1)]
    old = dict(zip(before.node_ids.tolist(), map(tuple, before.points)))
    nodes = [k for k in np.unique(faces) if old.get(int(after.node_ids[k])) != tuple(after.points[k])]
    x, y, z = after.points[nodes].T
    # From the round side, or from an end: whichever is nearer.
    return np.minimum(np.abs(np.hypot(x, y) - RADIUS), np.minimum(np.abs(z), np.abs(z - HEIGHT)))


HOLE = fs.Cylinder((0, 0.3, 6), (1, 0.1, 0.1), 1.2)
OPERATIONS = {
    "crack": (
        lambda mesh, **o: fs.crack(mesh, fs.Plane((0, 0, 6.3), (0.3, 0.1, 1)), **o),
        fs.Plane((0, 0, 6.3), (0.3, 0.1, 1)),
    ),
    "drill": (lambda mesh, **o: fs.drill(mesh, HOLE, refine=0.8, **o), HOLE),
    "refine": (lambda mesh, **o: fs.refine(mesh, HOLE, 0.8, **o), None),
}


@pytest.mark.parametrize("name", OPERATIONS)
def test_new_and_moved_nodes_are_on_the_shape(model, name):
    mesh, path = model
    operate, tool = OPERATIONS[name]
    result = operate(mesh, skin=path)
    result.mesh.validate()
    off = changed_skin(mesh, result.mesh, tool)
    assert len(off) > 30 and off.max() < 1e-7
    assert result.report.quality.after.minimum > 0.15
    # Without the shape: on the triangles, or on the curved faces of second order, which are better, not exact.
    off = changed_skin(mesh, operate(mesh).mesh, tool)
    assert off.max() > (0.03 if "tetra" in mesh.cells else 1e-4)


def test_the_volume_comes_nearer_to_the_shapes(model):
    mesh, path = model
    if "tetra10" in mesh.cells:
        pytest.skip("a mesh of second order has nearly the volume already")
    exact = np.pi * RADIUS**2 * HEIGHT
    volumes = [
        next(
            g for g in fs.refine(mesh, HOLE, 0.5, gradation=0.2, skin=skin).report.groups if g.kind == "element"
        ).measure_after
        for skin in (None, path)
    ]
    assert volumes[0] < volumes[1] < exact and exact - volumes[1] < 0.7 * (exact - volumes[0])


def test_what_a_shape_is_given_as(model):
    mesh, path = model
    shape = fs.Shape(path)
    assert repr(shape) == "Shape(3 faces, 3 edges)"

    class Part:  # as FreeCAD's
        def exportBrepToString(self):
            return path.read_text()

    operate, _ = OPERATIONS["crack"]
    first = operate(mesh, skin=shape).mesh.points
    for skin in (path, str(path), path.read_text(), Part()):
        assert operate(mesh, skin=skin).mesh.points.tobytes() == first.tobytes()
    assert (
        fs.Scalpel(mesh).crack(fs.Plane((0, 0, 6.3), (0.3, 0.1, 1)), skin=shape).mesh.points.tobytes()
        == first.tobytes()
    )


@pytest.mark.parametrize(
    "skin, error, message",
    [
        (5, TypeError, "skin must be a path, a FreeCAD shape or a femscalpel.Shape"),
        ("nowhere.brep", fs.ReadError, "nowhere.brep"),
        ("not\na shape", fs.ToolError, "skin"),
    ],
)
def test_bad_shapes(model, skin, error, message):
    with pytest.raises(error, match=message):
        fs.crack(model[0], fs.Plane((0, 0, 6.3), (0, 0, 1)), skin=skin)


def test_a_shape_elsewhere_is_refused(model, tmp_path):
    mesh, path = model
    moved = fs.Mesh(mesh.points + (3, 0, 0.5), {k: v for k, v in mesh.cells.items() if k.startswith("tetra")})
    with pytest.raises(fs.ToolError, match="skin: none of .* lies on the shape.*place or unit"):
        fs.crack(moved, fs.Plane((0, 0, 6.3), (0.2, 0, 1)), skin=path)
