# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stepped bars in tension whose shoulders fillet() rounds, solved with CalculiX: stress concentration by Peterson."""

import subprocess

import numpy as np
import pytest

import femscalpel as fs
from test_fillet import face_points
from test_physics import SOLID, needs_ccx, plate, quadratic_of, table
from test_physics_hole import nodal_stresses

LENGTH, STEP = 12.0, 6.0  # of the bar, and where the shoulder is
THIN, THICK = 2.0, 3.0  # half widths, or radii


def flat_bar():
    """The upper half of a plane bar."""
    whole = plate((48, 12), (LENGTH, THICK))
    centres = whole.points[whole.cells["triangle"]].mean(axis=1)
    kept = whole.cells["triangle"][(centres[:, 0] < STEP) | (centres[:, 1] < THIN)]
    used, nodes = np.unique(kept, return_inverse=True)
    return quadratic_of(fs.Mesh(whole.points[used], {"triangle": nodes.reshape(-1, 3)}))


def round_bar():
    """A quarter of a round bar about the x axis."""
    gmsh = pytest.importorskip("gmsh", reason="python3-gmsh is not installed")
    gmsh.initialize(["gmsh", "-v", "2"])
    try:
        occ = gmsh.model.occ
        thick = occ.addCylinder(0, 0, 0, STEP, 0, 0, THICK, angle=np.pi / 2)
        thin = occ.addCylinder(STEP, 0, 0, LENGTH - STEP, 0, 0, THIN, angle=np.pi / 2)
        occ.fuse([(3, thick)], [(3, thin)])
        occ.synchronize()
        gmsh.option.setNumber("Mesh.MeshSizeMin", 0.7)
        gmsh.option.setNumber("Mesh.MeshSizeMax", 0.7)
        gmsh.model.mesh.generate(3)
        gmsh.model.mesh.setOrder(2)
        tags, points, _ = gmsh.model.mesh.getNodes()
        place = {tag: k for k, tag in enumerate(tags)}
        _, nodes = gmsh.model.mesh.getElementsByType(11)
    finally:
        gmsh.finalize()
    cells = np.array([place[n] for n in nodes]).reshape(-1, 10)[:, [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]]
    used, cells = np.unique(cells, return_inverse=True)
    return fs.Mesh(np.reshape(points, (-1, 3))[used], {"tetra10": cells.reshape(-1, 10)})


#: Peterson's, as fitted in Pilkey, Peterson's Stress Concentration Factors: charts 3.1 (flat) and 3.4 (round); each row
#: is 1, sqrt(t/r), t/r for the powers of 2 t / D.
FIT = {
    ("flat", False): [
        (1.006, 1.008, -0.044),
        (-0.115, -0.584, 0.315),
        (0.245, -1.006, -0.257),
        (-0.135, 0.582, -0.017),
    ],
    ("flat", True): [
        (1.020, 1.009, -0.048),
        (-0.065, -0.165, -0.007),
        (-3.459, 1.266, -0.016),
        (3.505, -2.109, 0.069),
    ],
    ("round", False): [
        (0.926, 1.157, -0.099),
        (0.012, -3.036, 0.961),
        (-0.302, 3.977, -1.744),
        (0.365, -2.098, 0.878),
    ],
    ("round", True): [
        (1.200, 0.860, -0.022),
        (-1.805, -0.346, -0.038),
        (2.198, -0.486, 0.165),
        (-0.593, -0.028, -0.106),
    ],
}


def peterson(kind, radius):
    ratio = (THICK - THIN) / radius
    rows = FIT[kind, ratio > 2]
    values = [a + b * np.sqrt(ratio) + c * ratio for a, b, c in rows]
    return sum(v * ((THICK - THIN) / THICK) ** k for k, v in enumerate(values))


@needs_ccx
@pytest.mark.parametrize("radius", [0.4, 0.8])
@pytest.mark.parametrize("kind", ["flat", "round"])
def test_peterson(tmp_path, kind, radius):
    flat = kind == "flat"
    mesh = flat_bar() if flat else round_bar()
    body = "triangle6" if flat else "tetra10"
    mesh.add_group("ALL", "element", mesh.cell_ids[body])
    along = (STEP, THIN, 0.0) if flat else (STEP, -THIN * np.sqrt(0.5), THIN * np.sqrt(0.5))
    result = fs.fillet(mesh, along, radius)
    made = result.mesh
    if not flat:
        at = face_points(made)
        off = np.hypot(np.hypot(at[:, 1], at[:, 2]) - THIN - radius, at[:, 0] - STEP - radius) - radius
        assert np.abs(off).max() < 1e-6
    deck = fs.Mesh(
        made.points,
        {body: made.cells[body]},
        made.node_ids,
        {body: made.cell_ids[body]},
        {"ALL": ("element", made.cell_ids[body])},
    )
    fs.write(deck, tmp_path / "run.inp")
    text = (tmp_path / "run.inp").read_text().replace("TYPE=S6", "TYPE=CPS6")
    text += SOLID.format(thickness="1.\n" if flat else "")
    points, ids = made.points, made.node_ids
    used = np.isin(np.arange(len(ids)), made.cells[body])
    near = 1e-9
    left, right = (ids[used & (np.abs(points[:, 0] - x) < near)] for x in (0, LENGTH))
    text += "*NSET, NSET=RIGHT\n" + "".join(f"{n},\n" for n in right)
    held = "".join(f"{n},1,1\n" for n in left) + "".join(f"{n},1,1,0.01\n" for n in right)
    held += "".join(f"{n},2,2\n" for n in ids[used & (np.abs(points[:, 1]) < near)])
    if not flat:
        held += "".join(f"{n},3,3\n" for n in ids[used & (np.abs(points[:, 2]) < near)])
    text += f"*STEP\n*STATIC\n*BOUNDARY\n{held}*NODE PRINT, NSET=RIGHT\nRF\n*EL FILE, OUTPUT=2D\nS\n*END STEP\n"
    (tmp_path / "run.inp").write_text(text)
    done = subprocess.run(["ccx", "run"], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert done.returncode == 0 and "*ERROR" not in done.stdout, done.stdout[-2000:]
    force = sum(v[0] for v in table((tmp_path / "run.dat").read_text(), "forces").values())
    nominal = force / (THIN if flat else np.pi * THIN**2 / 4)
    tensors = {c: nodal_stresses(tmp_path, c) for c in ("XX", "YY", "ZZ", "XY", "YZ", "ZX")}
    place = dict(zip(ids.tolist(), points))

    def largest(node):
        xx, yy, zz, xy, yz, zx = (tensors[c][node] for c in ("XX", "YY", "ZZ", "XY", "YZ", "ZX"))
        return np.linalg.eigvalsh([[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]])[-1]

    top, node = max((largest(n), n) for n in tensors["XX"] if n in place)
    factor, expected = top / nominal, peterson(kind, radius)
    print(
        f"\n{kind}, radius {radius}: {len(made.cells[body])} elements, stress concentration {factor:.4f}, Peterson "
        f"{expected:.4f} ({100 * (factor / expected - 1):+.2f} %)"
    )
    assert factor == pytest.approx(expected, rel=0.04)
    assert STEP - near <= place[node][0] <= STEP + radius + near  # in the fillet
