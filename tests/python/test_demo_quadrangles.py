# SPDX-License-Identifier: LGPL-2.1-or-later
"""The demo's caisson as a shell of quadrangles: cracked, written as a deck, and solved beside that of triangles."""

import shutil
import sys
from pathlib import Path

import numpy as np
import pytest

import femscalpel as fs

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "resources" / "demo"))
pytest.importorskip("gmsh", reason="python3-gmsh is not installed")
import calculix  # noqa: E402
import caisson  # noqa: E402

pytestmark = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")

SIZE = 50.0
#: The demo's plane, through one hanger.
PLANE = fs.Plane((200, -50, 430), (-0.33, -0.30, 1))


def vertical(solution):
    """Reactions of the six supports."""
    return np.array([solution.reactions[name][2] for name in calculix.SUPPORT_NAMES])


def cracked(folder, order, quadrangles):
    """The crack's result, and reactions and largest displacements before and after."""
    folder.mkdir()
    model = caisson.make_model(False, SIZE, order, quadrangles)
    before, after = folder / "before.inp", folder / "after.inp"
    calculix.write_deck(model, before)
    result = fs.crack(fs.read(before), PLANE, name="CRACK", strict=True)
    fs.write(result.mesh, after)
    solutions = calculix.run([before, after])
    largest = [max(np.linalg.norm(u) for u in s.displacement.values()) for s in solutions]
    return result, [vertical(s) for s in solutions], largest


@pytest.fixture(scope="module")
def triangles(tmp_path_factory):
    return cracked(tmp_path_factory.mktemp("triangles") / "deck", 2, False)


@pytest.mark.parametrize("order, label, within", [(2, "S8R", 0.005), (1, "S4", 0.1)])
def test_a_caisson_of_quadrangles(tmp_path, triangles, order, label, within):
    result, (before, after), largest = cracked(tmp_path / "deck", order, True)
    kind = "quad8" if order == 2 else "quad"
    left = {k: len(c) for k, c in result.mesh.cells.items()}
    assert left[kind] > 1000 and 20 < result.report.converted[kind] < 0.2 * left[kind]
    assert result.report.quality.after.minimum > 0.4
    text = (tmp_path / "deck" / "after.inp").read_text()
    assert f"TYPE={label}" in text and ("TYPE=S6" if order == 2 else "TYPE=S3") in text
    # What hangs on the supports is the same, but for the digits that are printed; the cut hanger carries nothing.
    assert after.sum() == pytest.approx(before.sum(), rel=1e-5)
    assert abs(after[0]) < 0.01 * before[0]
    _, (whole, open_), displacements = triangles
    print(
        f"\n{label}: before {before.round()}, after {after.round()}; triangles {whole.round()}, {open_.round()}; "
        f"displacements {largest}, {displacements}"
    )
    assert before.sum() == pytest.approx(whole.sum(), rel=1e-4)
    assert np.abs(before - whole).max() < within * whole.max()
    assert np.abs(after - open_).max() < within * open_.max()
    assert np.allclose(largest, displacements, rtol=2 * within)
