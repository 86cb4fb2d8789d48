# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields of MED files: read, carried through every operator, written back."""

import itertools
import pathlib
import re
import warnings

import numpy as np
import pytest

import femscalpel as fs
from meshes import box_with_groups, grid_box, quadratic, tetra_volumes

A, B = 0.138196601125010, 0.585410196624969
TETRA_POINTS = np.array([[A, A, A], [B, A, A], [A, B, A], [A, A, B]])
#: Corners in the order of Mesh.cells.
TETRA = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
BRICK = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1.0]])
GAUSS = 1 / np.sqrt(3)
BRICK_POINTS = np.array(list(itertools.product([-GAUSS, GAUSS], repeat=3)))
LOCALIZATIONS = {
    "tetra": fs.Localization("FPG4", "tetra", TETRA, TETRA_POINTS, np.full(4, 1 / 24)),
    "hexahedron": fs.Localization("FPG8", "hexahedron", BRICK, BRICK_POINTS, np.ones(8)),
}


def bricks(counts, size=(6.0, 5.0, 4.0)):
    """A box of hexahedra, whose inner nodes are a little off the grid."""
    axes = [np.linspace(0, s, n + 1) for s, n in zip(size, counts)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    inner = np.all((points > 0) & (points < size), axis=1)
    points[inner] += np.random.default_rng(4).uniform(-0.1, 0.1, (inner.sum(), 3))
    index = np.arange(len(points)).reshape([n + 1 for n in counts])
    corners = ((BRICK + 1) // 2).astype(int)
    nodes = [index[tuple(slice(c, c + n) for c, n in zip(corner, counts))].ravel() for corner in corners]
    return fs.Mesh(points, {"hexahedron": np.stack(nodes, axis=1)})


def linear(points):
    """A linear field of two components."""
    return np.stack([3 + points @ [0.7, -1.1, 0.4], points @ [-2.0, 0.3, 1.9]], axis=-1)


def corner_shares(cell_type, at):
    """Shape functions of the corners at points of a reference element."""
    if cell_type.startswith("tetra"):
        return np.column_stack([1 - at.sum(axis=1), at])
    return np.prod(1 + BRICK[None] * at[:, None], axis=2) / 8


def places(mesh, cell_type, ids, localization):
    """Where the integration points of straight elements are: (ids, points, 3)."""
    corners = {"tetra": 4, "tetra10": 4, "hexahedron": 8}[cell_type]
    shares = corner_shares(cell_type, localization.points)
    order = np.argsort(mesh.cell_ids[cell_type])
    rows = order[np.searchsorted(mesh.cell_ids[cell_type], ids, sorter=order)]
    return np.einsum("pk,ckx->cpx", shares, mesh.points[mesh.cells[cell_type][rows][:, :corners]])


def fields_of(mesh, function=linear, seed=None):
    """One field on every support, of the values of `function`; of random ones where there is a seed."""
    random = np.random.default_rng(seed)
    values = (lambda x: random.standard_normal(x.shape[:-1] + (2,))) if seed is not None else function
    node = [fs.FieldPart("node", "", mesh.node_ids, values(mesh.points))]
    element, nodes, points = [], [], []
    for cell_type, cells in mesh.cells.items():
        at, ids = mesh.points[cells], mesh.cell_ids[cell_type]
        element.append(fs.FieldPart("element", cell_type, ids, values(at.mean(axis=1))))
        nodes.append(fs.FieldPart("element nodes", cell_type, ids, values(at)))
        if cell_type in LOCALIZATIONS:
            where = LOCALIZATIONS[cell_type]
            points.append(
                fs.FieldPart("element points", cell_type, ids, values(places(mesh, cell_type, ids, where)), where)
            )
    whole = [fs.FieldPart("node", "", mesh.node_ids, np.arange(len(mesh.node_ids))[:, None])]
    names, units = ("DX", "DY"), ("mm", "")
    out = [
        fs.Field("DEPL", names, units, (fs.FieldStep(1, 0, 0.5, node), fs.FieldStep(2, -1, 1.25, node)), "s"),
        fs.Field("SIEF_ELEM", names, units, (fs.FieldStep(-1, -1, 0, element),)),
        fs.Field("SIEF_ELNO", names, units, (fs.FieldStep(1, 1, 0, nodes),)),
        fs.Field("NUMBERS", ("N",), ("",), (fs.FieldStep(-1, -1, 0, whole),), dtype="int32"),
    ]
    if points:
        out.append(fs.Field("SIEF_ELGA", names, units, (fs.FieldStep(1, 1, 0, points),)))
    return out


def flat(mesh):
    """All of a mesh's fields, to compare: arrays as lists."""
    plain = lambda value: value.tolist() if isinstance(value, np.ndarray) else value  # noqa: E731
    return [  # files have them by name
        (f[:3], f.time_unit, f.dtype)
        + tuple(
            (
                s[:3],
                sorted([tuple(map(plain, p[:4])) + tuple(map(plain, p.localization or ())) + p[5:] for p in s.parts]),
            )
            for s in f.steps
        )
        for f in sorted(mesh.fields, key=lambda f: f.name)
    ]


def part(mesh, name, step=0, cell_type=""):
    field = next(f for f in mesh.fields if f.name == name)
    return next(p for p in field.steps[step].parts if p.cell_type == cell_type)


def rows_of(ids, wanted):
    order = np.argsort(ids)
    return order[np.searchsorted(ids, wanted, sorter=order)]


def check_linear(mesh, complete=True):
    """Every field, but that of elements, is linear() in the nodes, element nodes and integration points of `mesh`."""
    for field in mesh.fields:
        for step in field.steps:
            for p in step.parts:
                if p.support == "element" or field.dtype != "float64":
                    continue
                if p.support == "node":
                    at = mesh.points[rows_of(mesh.node_ids, p.ids)]
                elif p.support == "element nodes":
                    at = mesh.points[mesh.cells[p.cell_type][rows_of(mesh.cell_ids[p.cell_type], p.ids)]]
                else:
                    at = places(mesh, p.cell_type, p.ids, p.localization)
                np.testing.assert_allclose(p.values, linear(at), rtol=0, atol=1e-12 * np.abs(mesh.points).max() * 10)
                if complete:
                    all_ids = mesh.node_ids if p.support == "node" else mesh.cell_ids[p.cell_type]
                    np.testing.assert_array_equal(p.ids, all_ids)


def check_untouched(before, after):
    """Values of nodes and elements that are where they were are the same, bit for bit; at least some are."""
    places_before = dict(zip(before.node_ids.tolist(), map(bytes, before.points)))
    same = [i for i, x in zip(after.node_ids.tolist(), after.points) if places_before.get(i) == bytes(x)]
    kept = 0
    for name in ("DEPL", "NUMBERS"):
        old, new = part(before, name), part(after, name)
        np.testing.assert_array_equal(
            old.values[rows_of(old.ids, np.array(same))], new.values[rows_of(new.ids, np.array(same))]
        )
    for cell_type, cells in after.cells.items():
        if cell_type not in before.cells:
            continue
        old_cells = {
            i: before.points[c].tobytes() for i, c in zip(before.cell_ids[cell_type].tolist(), before.cells[cell_type])
        }
        ids = [
            i
            for i, c in zip(after.cell_ids[cell_type].tolist(), cells)
            if old_cells.get(i) == after.points[c].tobytes()
        ]
        kept += len(ids)
        for name in ("SIEF_ELEM", "SIEF_ELNO", "SIEF_ELGA"):
            if not any(f.name == name for f in before.fields) or name == "SIEF_ELGA" and cell_type not in LOCALIZATIONS:
                continue
            old, new = part(before, name, cell_type=cell_type), part(after, name, cell_type=cell_type)
            np.testing.assert_array_equal(
                old.values[rows_of(old.ids, np.array(ids))], new.values[rows_of(new.ids, np.array(ids))]
            )
    assert kept > 10 and len(same) > 10


PLANE = fs.Plane(origin=(2.9, 2.4, 2.1), normal=(0.9, 0.3, 0.25))
OPERATORS = {
    "crack": lambda mesh: fs.crack(mesh, PLANE, name="C"),
    "crack inside": lambda mesh: fs.crack(mesh, PLANE, within=fs.Disk((2.9, 2.4, 2.1), 1.3), name="C"),
    "drill": lambda mesh: fs.drill(mesh, fs.Cylinder((3, 2.4, 2), (0.1, 0.05, 1), 0.8), name="H"),
    "cut": lambda mesh: fs.cut(mesh, PLANE, width=0.3, name="S"),
    "refine": lambda mesh: fs.refine(mesh, near=PLANE, size=0.4),
    "refine first": lambda mesh: fs.crack(mesh, PLANE, refine=0.5, name="C"),
}
MESHES = {"tetra": box_with_groups, "tetra10": lambda: quadratic(grid_box()), "bricks": lambda: bricks((5, 4, 3))}
LONG = {
    "tetra": lambda: grid_box((16, 4, 3), (20, 5, 4)),
    "tetra10": lambda: quadratic(grid_box((16, 4, 3), (20, 5, 4))),
    "bricks": lambda: bricks((16, 4, 3), (20, 5, 4)),
}


@pytest.mark.parametrize("make", MESHES)
def test_file_keeps_every_field(tmp_path, make):
    mesh = MESHES[make]()
    mesh.fields = fields_of(mesh, seed=1)
    path = tmp_path / "fields.med"
    fs.write(mesh, path)
    back = fs.read(path)
    assert not back.input_warnings
    assert flat(back) == flat(mesh)
    fs.write(back, tmp_path / "again.med")
    assert flat(fs.read(tmp_path / "again.med")) == flat(mesh)


@pytest.mark.parametrize("dtype", ["float32", "int64", "int32"])
def test_file_keeps_types_of_values(tmp_path, dtype):
    mesh = grid_box((2, 2, 2))
    values = np.linspace(-1e6, 1e6, mesh.node_count).astype(dtype)[:, None]
    mesh.fields = [
        fs.Field(
            "V",
            ("X",),
            ("",),
            (fs.FieldStep(-1, -1, 0, (fs.FieldPart("node", "", mesh.node_ids, values),)),),
            dtype=dtype,
        )
    ]
    fs.write(mesh, tmp_path / "a.med")
    back = fs.read(tmp_path / "a.med").fields[0]
    assert back.dtype == dtype
    np.testing.assert_array_equal(back.steps[0].parts[0].values, values)


def test_file_keeps_profiles(tmp_path):
    mesh = box_with_groups()
    chosen, cells = mesh.node_ids[3:90:2], mesh.cell_ids["tetra"][::3]
    mesh.fields = [
        fs.Field(
            "PART",
            ("X",),
            ("",),
            (
                fs.FieldStep(
                    3,
                    1,
                    2.0,
                    (
                        fs.FieldPart("node", "", chosen, np.arange(len(chosen), dtype=float)[:, None], None, "SOME"),
                        fs.FieldPart("element", "tetra", cells, np.arange(len(cells), dtype=float)[:, None]),
                    ),
                ),
            ),
        )
    ]
    fs.write(mesh, tmp_path / "a.med")
    back = fs.read(tmp_path / "a.med").fields[0].steps[0]
    assert (back.number, back.iteration, back.time) == (3, 1, 2.0)
    np.testing.assert_array_equal(back.parts[0].ids, chosen)
    np.testing.assert_array_equal(back.parts[1].ids, cells)
    np.testing.assert_array_equal(back.parts[1].values[:, 0], np.arange(len(cells)))
    assert back.parts[0].profile == "SOME" and back.parts[1].profile == "PROFILE"


@pytest.mark.parametrize("make", MESHES)
@pytest.mark.parametrize("operator", OPERATORS)
def test_linear_fields_stay_linear(make, operator):
    mesh = MESHES[make]()
    mesh.fields = fields_of(mesh)
    result = OPERATORS[operator](mesh)
    check_linear(mesh)
    check_linear(result.mesh)
    assert len(result.mesh.fields) == len(mesh.fields)
    made = [r for r in result.report.fields if r.support == "node"]
    assert all(r.made > 0 and r.absent == 0 and r.outside == 0 and r.kept > 0 for r in made)


@pytest.mark.parametrize("make", MESHES)
@pytest.mark.parametrize("operator", OPERATORS)
def test_what_is_untouched_keeps_its_values(make, operator):
    mesh = LONG[make]()
    mesh.fields = fields_of(mesh, seed=2)
    check_untouched(mesh, OPERATORS[operator](mesh).mesh)


@pytest.mark.parametrize("size", [0.6, 0.3])
def test_integral_of_an_element_field_is_kept_where_elements_are_split(size):
    mesh = box_with_groups()
    mesh.fields = fields_of(mesh, seed=3)
    out = fs.refine(mesh, near=PLANE, size=size).mesh

    def integral(of):
        p = part(of, "SIEF_ELEM", cell_type="tetra")
        np.testing.assert_array_equal(p.ids, of.cell_ids["tetra"])
        return tetra_volumes(of.points, of.cells["tetra"]) @ p.values

    assert out.cell_count > 1.5 * mesh.cell_count
    np.testing.assert_allclose(integral(out), integral(mesh), rtol=1e-9)


def test_doubled_nodes_have_what_their_original_has():
    mesh = box_with_groups()
    mesh.fields = fields_of(mesh, seed=4)
    result = fs.crack(mesh, PLANE, name="C")
    out = result.mesh
    by_place = {}
    for number, point in zip(out.node_ids.tolist(), out.points):
        by_place.setdefault(point.tobytes(), []).append(number)
    pairs = [numbers for numbers in by_place.values() if len(numbers) == 2]
    assert len(pairs) == result.report.nodes_doubled > 10
    p = part(out, "DEPL")
    values = dict(zip(p.ids.tolist(), map(bytes, p.values)))
    assert all(values[a] == values[b] for a, b in pairs)
    record = next(r for r in result.report.fields if r.name == "DEPL")
    assert record.doubled == 2 * len(pairs) and record.steps == 2
    assert record.kept + record.doubled + record.made == 2 * out.node_count
    assert "DEPL (node, 2 steps): kept" in result.report.to_text()


def test_lips_of_an_earlier_crack_keep_to_their_own_side():
    """A field that jumps across the lips, in nodes, elements and integration points, after a crack across them."""
    first = fs.crack(grid_box(), fs.Plane(origin=(3, 2.5, 2.2), normal=(0, 0, 1)), name="A").mesh
    up = lambda x: np.repeat((x[..., 2:] > 2.2).astype(float), 2, axis=-1)  # noqa: E731
    first.fields = fields_of(first, up)
    # Nodes and corners of elements on the plane belong to the side of their elements.
    cells, ids = first.cells["tetra"], first.cell_ids["tetra"]
    above = first.points[cells].mean(axis=1)[:, 2] > 2.2
    upper = np.zeros(first.node_count, bool)
    upper[cells[above].ravel()] = True
    node = np.repeat(upper.astype(float)[:, None], 2, axis=1)
    corners = np.repeat(np.repeat(above.astype(float)[:, None, None], 4, axis=1), 2, axis=2)
    fields = {f.name: f for f in first.fields}
    names = (("X", "Y"), ("", ""))
    first.fields = [
        fs.Field("DEPL", *names, (fs.FieldStep(-1, -1, 0, (fs.FieldPart("node", "", first.node_ids, node),)),)),
        fs.Field("ELNO", *names, (fs.FieldStep(-1, -1, 0, (fs.FieldPart("element nodes", "tetra", ids, corners),)),)),
        fields["SIEF_ELEM"],
        fields["SIEF_ELGA"],
    ]
    out = fs.crack(first, fs.Plane(origin=(2.9, 2.5, 2), normal=(1, 0.2, 0.1)), name="B").mesh
    cells = out.cells["tetra"]
    above = out.points[cells].mean(axis=1)[:, 2] > 2.2
    for name in ("SIEF_ELEM", "SIEF_ELGA", "ELNO"):
        values = part(out, name, cell_type="tetra").values
        expected = np.broadcast_to(above.reshape((-1,) + (1,) * (values.ndim - 1)), values.shape)
        np.testing.assert_allclose(values, expected, rtol=0, atol=1e-12)
    upper = np.zeros(out.node_count, bool)
    upper[cells[above].ravel()] = True
    np.testing.assert_allclose(part(out, "DEPL").values[:, 0], upper, rtol=0, atol=1e-12)


def test_values_that_are_not_there_stay_absent():
    mesh = box_with_groups()
    near = mesh.node_ids[mesh.points[:, 0] < 3]
    values = linear(mesh.points[mesh.points[:, 0] < 3])
    mesh.fields = [
        fs.Field("F", ("A", "B"), ("", ""), (fs.FieldStep(1, 1, 1, (fs.FieldPart("node", "", near, values),)),))
    ]
    out = fs.crack(mesh, PLANE, name="C")
    p = part(out.mesh, "F")
    at = out.mesh.points[rows_of(out.mesh.node_ids, p.ids)]
    assert 50 < len(p.ids) < out.mesh.node_count and out.report.fields[0].absent > 0
    assert at[:, 0].max() < 4
    np.testing.assert_allclose(p.values, linear(at), rtol=0, atol=1e-11)


def test_what_is_merged_has_no_values(tmp_path):
    mesh, rib = grid_box((6, 5, 4)), grid_box((3, 3, 2), (2.0, 2.0, 2.0))
    mesh.fields = fields_of(mesh)
    rib = fs.Mesh(rib.points + (2.03, 1.4, 3.98), rib.cells)
    rib.fields = fields_of(rib)[:1]
    result = fs.merge(mesh, rib, name="RIB")
    check_linear(result.mesh, complete=False)
    added = set(result.mesh.groups["RIB_ADDED", "element"].ids.tolist())
    assert added and not added & set(part(result.mesh, "SIEF_ELEM", cell_type="tetra").ids.tolist())
    text = "\n".join(result.report.warnings)
    assert "the addition's field 'DEPL' is left behind: what is added has no values" in text
    assert re.search(r"field 'DEPL' \(node\): \d+ new nodes or elements have no value", text)
    fs.write(result.mesh, tmp_path / "merged.med")
    assert flat(fs.read(tmp_path / "merged.med"))[0][0] == flat(result.mesh)[0][0]


@pytest.mark.parametrize(
    "operator",
    [
        lambda mesh: fs.reshape(mesh, "WALL", by=(0, 0, 0.05), name="R"),
        lambda mesh: fs.crack(mesh, fs.Faces("MIDDLE"), name="F"),
        lambda mesh: fs.fillet(mesh, [(6, 0, 0), (6, 2.5, 0), (6, 5, 0)], 0.5, name="E"),
    ],
)
def test_other_operators_carry_fields(operator):
    mesh = grid_box()
    top = mesh.node_ids[mesh.points[:, 2] == 4]
    mesh.add_group("WALL", "node", top)
    mesh.add_group("MIDDLE", "node", mesh.node_ids[mesh.points[:, 0] == 3])
    mesh.fields = fields_of(mesh)
    result = operator(mesh)
    assert {r.name for r in result.report.fields} == {f.name for f in mesh.fields}
    assert sum(r.kept for r in result.report.fields) > 0
    check_linear(result.mesh)


def test_other_formats_say_that_fields_are_lost(tmp_path):
    mesh = grid_box((2, 2, 2))
    mesh.fields = fields_of(mesh)[:2]
    for suffix in {e for f in fs.formats() if f.writes for e in f.extensions} - {".med", ".mmed", ".rmed"}:
        with pytest.warns(UserWarning, match="does not hold .*the field 'DEPL'; the field 'SIEF_ELEM'"):
            fs.write(mesh, tmp_path / ("a" + suffix))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        fs.write(mesh, tmp_path / "a.med")


def test_fields_that_do_not_fit_are_refused():
    mesh = grid_box((2, 2, 2))
    good = fields_of(mesh)
    mesh.fields = good
    step = good[0].steps[0]

    def changed(**changes):
        return [good[0]._replace(steps=(step._replace(parts=(step.parts[0]._replace(**changes),)),))]

    for fields, error, message in [
        (changed(ids=mesh.node_ids + 1), fs.Error, "field 'DEPL': the mesh has no node 28"),
        (
            changed(values=np.zeros((27, 3))),
            ValueError,
            r"field 'DEPL' on 'node' must have the shape \(ids, components\)",
        ),
        (changed(support="edge"), fs.Error, "field 'DEPL': unknown support 'edge'"),
        (changed(values=np.full((27, 2), "x")), TypeError, "values of field 'DEPL' must be float64"),
        ([good[0]._replace(dtype="int32")], TypeError, "values of field 'DEPL' must be int32"),
        ([good[0], good[0]], fs.Error, "field 'DEPL': there are two of this name"),
        (["DEPL"], TypeError, "fields must be Field"),
    ]:
        with pytest.raises(error, match=message):
            mesh.fields = fields
        assert len(mesh.fields) == len(good)
    with pytest.raises(ValueError, match="read-only"):
        mesh.fields[0].steps[0].parts[0].values[0] = 1


def test_names_that_med_cannot_hold_are_refused(tmp_path):
    mesh = grid_box((2, 2, 2))
    mesh.fields = [fields_of(mesh)[0]._replace(components=("a component of many letters", "B"))]
    path = tmp_path / "a.med"
    with pytest.raises(
        fs.WriteError,
        match="the component of field 'DEPL' 'a component of many letters': it has 27 bytes, MED allows 16",
    ):
        fs.write(mesh, path)
    assert not path.exists()


def test_files_are_as_h5py_reads_them(tmp_path):
    h5py = pytest.importorskip("h5py", reason="h5py is not installed")
    mesh = box_with_groups()
    mesh.fields = fields_of(mesh, seed=5)
    fs.write(mesh, tmp_path / "a.med")
    with h5py.File(tmp_path / "a.med") as file:
        step = file["CHA/DEPL"][f"{1:020d}{0:020d}"]
        assert step.attrs["PDT"] == 0.5
        values = step["NOE/MED_NO_PROFILE_INTERNAL/CO"][:].reshape(2, -1).T
        np.testing.assert_array_equal(values, part(mesh, "DEPL").values)
        assert file["GAUSS/FPG4"].attrs["NBR"] == 4
