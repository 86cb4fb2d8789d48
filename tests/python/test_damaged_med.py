# SPDX-License-Identifier: LGPL-2.1-or-later
"""Damaged MED files: an error that says so, no crash of HDF5, no text of a library's."""

import pathlib
import subprocess
import sys

import pytest

import femscalpel as fs

OLD = pathlib.Path(__file__).parent / "files" / "med_2_3.med"  # HDF5's format before 1.8, without checksums

READ_ALL = """
import pathlib, sys
import femscalpel as fs
data, path = pathlib.Path(sys.argv[1]).read_bytes(), pathlib.Path(sys.argv[2])
for byte, length, places in ((b"\\xff", 50, [2088, *range(0, len(data), 400)]), (b"\\0", 3, [9929])):
    for at in places:
        path.write_bytes(data[:at] + length * byte + data[at + length :])
        try:
            print(at, fs.read(path).node_count)
        except fs.ReadError as error:
            print(at, error)
"""


def test_old_files(tmp_path):
    """In another process: HDF5 1.10 crashes on some of them."""
    run = subprocess.run(
        [sys.executable, "-c", READ_ALL, OLD, tmp_path / "a.med"], text=True, capture_output=True, check=False
    )
    assert run.returncode == 0 and run.stderr == ""
    lines = dict(line.split(" ", 1) for line in run.stdout.splitlines())
    assert len(lines) == OLD.stat().st_size // 400 + 3
    for at in ("2088", "9929"):
        assert lines[at].endswith("a.med: truncated or damaged: its structure cannot be read"), "HDF5 1.10 crashes"
    assert "4" in lines.values(), "some of it nothing needs"


def test_libraries_are_quiet(tmp_path, capfd):
    path = tmp_path / "a.med"
    data = OLD.read_bytes()
    assert data.count(b"MAJ\0") == 1
    path.write_bytes(data.replace(b"MAJ\0", b"OFF\0"))
    with pytest.raises(fs.ReadError, match="cannot read its MED version"):
        fs.read(path)
    assert not any(capfd.readouterr())
