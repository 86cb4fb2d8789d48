# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of VTK (ParaView's) and meshio, and what these make of ours."""

import binascii
import itertools

import numpy as np
import pytest

import femscalpel as fs
from meshes import box_with_groups

VTK_TYPES = {"line3": 21, "triangle6": 22, "quad8": 23, "tetra10": 24, "wedge15": 26, "hexahedron20": 25, "pyramid": 14}


@pytest.fixture
def vtk():
    return pytest.importorskip("vtkmodules.all")


def grid_of(vtk, points, cells):
    """A grid of VTK of cells, each (number of its type, points)."""
    grid = vtk.vtkUnstructuredGrid()
    where = vtk.vtkPoints()
    where.SetDataTypeToDouble()
    for point in points:
        where.InsertNextPoint(point)
    grid.SetPoints(where)
    for kind, nodes in cells:
        grid.InsertNextCell(kind, len(nodes), [int(n) for n in nodes])
    return grid


@pytest.mark.parametrize("mode", ["ascii", "binary", "appended", "appended base64"])
@pytest.mark.parametrize("compressed, wide, swapped", itertools.product((False, True), repeat=3))
def test_files_of_vtk(tmp_path, vtk, mode, compressed, wide, swapped):
    rng = np.random.default_rng(5)
    points = rng.random((40, 3))
    cells = [
        (number, rng.permutation(40)[: fs.mesh.CELL_TYPES[name][1]]) for name, number in VTK_TYPES.items() for _ in "ab"
    ]
    grid = grid_of(vtk, points, cells)
    values = vtk.vtkDoubleArray()
    values.SetName("stress")
    values.SetNumberOfValues(len(points))
    values.Fill(1.5)
    grid.GetPointData().AddArray(values)
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(tmp_path / "grid.vtu"))
    writer.SetInputData(grid)
    writer.SetHeaderTypeToUInt64() if wide else writer.SetHeaderTypeToUInt32()
    writer.SetByteOrderToBigEndian() if swapped else writer.SetByteOrderToLittleEndian()
    writer.SetCompressorTypeToZLib() if compressed else writer.SetCompressorTypeToNone()
    {"a": writer.SetDataModeToAscii, "b": writer.SetDataModeToBinary}.get(mode[0] * (mode[1] != "p"), lambda: 0)()
    if mode.startswith("appended"):
        writer.SetDataModeToAppended()
        writer.SetEncodeAppendedData(mode.endswith("64"))
    assert writer.Write() == 1
    with pytest.warns(UserWarning, match="the data arrays 'stress' are not read"):
        mesh = fs.read(tmp_path / "grid.vtu")
    np.testing.assert_allclose(mesh.points, points, atol=1e-10 if mode == "ascii" else 0)
    for name, number in VTK_TYPES.items():
        np.testing.assert_array_equal(mesh.cells[name], [nodes for kind, nodes in cells if kind == number])


def test_wedges_of_vtk(tmp_path, vtk):
    """VTK sees the base of a linear wedge from outside, we from inside."""
    points = [[0, 0, 0], [0, 1, 0], [1, 0, 0], [0, 0, 1], [0, 1, 1], [1, 0, 1]]
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(tmp_path / "wedge.vtu"))
    writer.SetInputData(grid_of(vtk, points, [(13, range(6))]))
    writer.Write()
    assert fs.measure(fs.read(tmp_path / "wedge.vtu"))["wedge"] == pytest.approx([0.5])


def test_vtk_reads_ours_and_its_copy_is_read(tmp_path, vtk):
    mesh = box_with_groups()
    fs.write(mesh, tmp_path / "box.vtu")
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(tmp_path / "box.vtu"))
    reader.Update()
    assert reader.GetOutput().GetNumberOfCells() == mesh.cell_count
    assert reader.GetOutput().GetCellData().GetArray("LEFT").GetRange() == (0, 1)
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(tmp_path / "again.vtu"))
    writer.SetInputData(reader.GetOutput())
    writer.Write()
    with pytest.warns(UserWarning, match="the data arrays .*'LEFT'.* are not read"):  # VTK drops what says: a group
        back = fs.read(tmp_path / "again.vtu")
    np.testing.assert_array_equal(back.points, mesh.points)
    np.testing.assert_array_equal(back.node_ids, mesh.node_ids)
    np.testing.assert_array_equal(back.cells["tetra"], mesh.cells["tetra"])
    np.testing.assert_array_equal(back.cell_ids["tetra"], mesh.cell_ids["tetra"])


@pytest.mark.parametrize("binary, compression", [(False, None), (True, None), (True, "zlib")])
def test_files_of_meshio(tmp_path, binary, compression):
    meshio = pytest.importorskip("meshio")
    rng = np.random.default_rng(3)
    kinds = {"vertex": 1, "line": 2, "triangle6": 6, "quad9": 9, "tetra10": 10, "wedge": 6, "hexahedron27": 27}
    cells = [(kind, [rng.permutation(30)[:n] for _ in range(3)]) for kind, n in kinds.items()]
    points = rng.random((30, 3))
    meshio.vtu.write(tmp_path / "m.vtu", meshio.Mesh(points, cells), binary=binary, compression=compression)
    mesh = fs.read(tmp_path / "m.vtu")
    np.testing.assert_allclose(mesh.points, points, atol=0 if binary else 1e-10)
    for kind, rows in cells:
        np.testing.assert_array_equal(mesh.cells[kind], rows)


def test_meshio_reads_ours(tmp_path):
    meshio = pytest.importorskip("meshio")
    mesh = box_with_groups()
    fs.write(mesh, tmp_path / "box.vtu")
    try:
        read = meshio.read(tmp_path / "box.vtu")
    except binascii.Error:
        pytest.skip("this release of meshio cannot read appended raw data with this Python")
    np.testing.assert_array_equal(read.cells_dict["tetra"], mesh.cells["tetra"])
