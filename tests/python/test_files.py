# SPDX-License-Identifier: LGPL-2.1-or-later
import pathlib

import numpy as np
import pytest

import femscalpel as fs
from meshes import box_with_groups


@pytest.mark.parametrize("suffix", [".med", ".inp", ".inp.gz"])
@pytest.mark.parametrize("as_path", [str, pathlib.Path])
def test_round_trip(tmp_path, suffix, as_path):
    mesh = box_with_groups()
    path = as_path(tmp_path / ("box" + suffix))
    fs.write(mesh, path)
    back = fs.read(path)
    np.testing.assert_array_equal(back.points, mesh.points)
    np.testing.assert_array_equal(back.node_ids, mesh.node_ids)
    np.testing.assert_array_equal(back.cells["tetra"], mesh.cells["tetra"])
    np.testing.assert_array_equal(back.cell_ids["tetra"], mesh.cell_ids["tetra"])
    for group in mesh.groups.all():
        np.testing.assert_array_equal(back.groups[group.name, group.kind].ids, group.ids)


def test_writes_vtu(tmp_path):
    fs.write(box_with_groups(), tmp_path / "box.vtu")
    assert (tmp_path / "box.vtu").stat().st_size > 1000


def test_errors(tmp_path):
    with pytest.raises(fs.ReadError, match="nowhere.med"):
        fs.read(tmp_path / "nowhere.med")
    with pytest.raises(fs.ReadError, match="box.xyz"):
        fs.read(tmp_path / "box.xyz")
    with pytest.raises(fs.WriteError, match="box.xyz"):
        fs.write(box_with_groups(), tmp_path / "box.xyz")
    with pytest.raises(fs.WriteError):
        fs.write(box_with_groups(), tmp_path / "no" / "folder" / "box.med")
    with pytest.raises(TypeError, match="path must be a string"):
        fs.read(5)
    with pytest.raises(TypeError, match="mesh must be a femscalpel.Mesh"):
        fs.write("box.med", "box.med")
