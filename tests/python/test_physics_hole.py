# SPDX-License-Identifier: LGPL-2.1-or-later
"""Kirsch's problem: a hole in a plate under tension, drilled, or made larger or smaller, solved with CalculiX."""

import subprocess

import numpy as np
import pytest

import femscalpel as fs
from meshes import grid_box, quadratic
from test_physics import SOLID, needs_ccx, plate, quadratic_of, table

LENGTH, WIDTH, THICKNESS, RADIUS = 40.0, 20.0, 0.3, 1.0
HOLE = fs.Cylinder(origin=(LENGTH / 2, WIDTH / 2, 0), axis=(0, 0, 1), radius=RADIUS)


def concentration():
    """Largest stress over the gross stress far away, for a hole of this width ratio.

    Howland's solution as fitted in Pilkey, Peterson's Stress Concentration Factors, chart 4.1; 3 for an infinite plate.
    """
    ratio = 2 * RADIUS / WIDTH
    return (3.0 - 3.13 * ratio + 3.66 * ratio**2 - 1.53 * ratio**3) / (1 - ratio)


def nodal_stresses(folder, component):
    """{node: stress} of the last step, averaged at the nodes, from CalculiX's .frd file. Components: XX YY ZZ XY YZ
    ZX."""
    column = ("XX", "YY", "ZZ", "XY", "YZ", "ZX").index(component)
    values, inside = {}, False
    for line in (folder / "run.frd").read_text().splitlines():
        if line.startswith(" -4  STRESS"):
            inside = True
        elif inside and line.startswith(" -3"):
            inside = False
        elif inside and line.startswith(" -1"):
            values[int(line[3:13])] = float(line[13 + 12 * column : 25 + 12 * column])
    return values


def plate_for(flat):
    if flat:
        mesh = quadratic_of(plate((20, 10), (LENGTH, WIDTH)))
    else:
        mesh = quadratic(grid_box((20, 10, 1), (LENGTH, WIDTH, THICKNESS)))
    mesh.add_group("ALL", "element", np.concatenate(list(mesh.cell_ids.values())))
    return mesh


def solve(tmp_path, drilled, flat):
    """The gross stress, the nodes' stresses along the pull, and where the nodes are."""
    # Only the body goes into the deck: in CalculiX the wall's faces would be shells.
    body = "triangle6" if flat else "tetra10"
    deck = fs.Mesh(
        drilled.points,
        {body: drilled.cells[body]},
        drilled.node_ids,
        {body: drilled.cell_ids[body]},
        {"ALL": ("element", drilled.cell_ids[body])},
    )
    fs.write(deck, tmp_path / "run.inp")
    text = (tmp_path / "run.inp").read_text()
    if flat:
        assert "TYPE=S6" in text
        text = text.replace("TYPE=S6", "TYPE=CPS6")
    text += SOLID.format(thickness=f"{THICKNESS}\n" if flat else "")
    points, ids = drilled.points, drilled.node_ids
    used = np.isin(np.arange(len(ids)), drilled.cells[body])
    left, right = (ids[used & (points[:, 0] == x)] for x in (0, LENGTH))
    text += "*NSET, NSET=RIGHT\n" + "".join(f"{n},\n" for n in right)
    held = "".join(f"{n},1,1\n" for n in left) + "".join(f"{n},1,1,0.01\n" for n in right)
    corner = ids[used & (points[:, 0] == 0) & (points[:, 1] == 0)]
    held += "".join(f"{n},2,2\n" for n in corner)
    if not flat:  # plane strain: the stress in the plane is that of the plane problem, whatever Poisson's ratio
        held += "".join(f"{n},3,3\n" for n in ids[used & ((points[:, 2] == 0) | (points[:, 2] == THICKNESS))])
    text += f"*STEP\n*STATIC\n*BOUNDARY\n{held}*NODE PRINT, NSET=RIGHT\nRF\n*EL FILE, OUTPUT=2D\nS\n*END STEP\n"
    (tmp_path / "run.inp").write_text(text)
    done = subprocess.run(["ccx", "run"], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert done.returncode == 0 and "*ERROR" not in done.stdout, done.stdout[-2000:]
    force = sum(v[0] for v in table((tmp_path / "run.dat").read_text(), "forces").values())
    gross = force / (WIDTH * THICKNESS)
    stresses = nodal_stresses(tmp_path, "XX")
    place = dict(zip(ids.tolist(), points))
    return gross, stresses, dict(zip(ids.tolist(), points))


def check_concentration(tmp_path, result, kind):
    drilled = result.mesh
    gross, stresses, place = solve(tmp_path, drilled, kind == "CPS6")
    body = "triangle6" if kind == "CPS6" else "tetra10"
    top = max((s, n) for n, s in stresses.items() if n in place)
    factor, expected = top[0] / gross, concentration()
    print(
        f"\n{kind}: {len(drilled.cells[body])} elements, minimum mean ratio {result.report.quality.after.minimum:.2f}, "
        f"stress concentration "
        f"{factor:.4f}, exact {expected:.4f} ({100 * (factor / expected - 1):+.2f} %)"
    )
    assert factor == pytest.approx(expected, rel=0.03)
    # It is where it belongs: on the wall, across the pull.
    assert abs(HOLE.distance(place[top[1]])[0]) < 1e-9 and abs(place[top[1]][0] - HOLE.origin[0]) < 0.1 * RADIUS


@needs_ccx
@pytest.mark.parametrize("kind", ["CPS6", "C3D10"])
def test_kirsch(tmp_path, kind):
    flat = kind == "CPS6"
    refined = fs.refine(plate_for(flat), HOLE, size=RADIUS / 7, gradation=0.4)
    result = fs.drill(refined.mesh, HOLE, name="HOLE")
    drilled = result.mesh
    # Wall nodes, mid-side nodes too, lie on the cylinder.
    wall = drilled.groups["HOLE_WALL"].ids
    kind_of_wall = "line3" if flat else "triangle6"
    on_wall = np.unique(drilled.cells[kind_of_wall][np.isin(drilled.cell_ids[kind_of_wall], wall)])
    assert np.abs(HOLE.distance(drilled.points[on_wall])).max() < 1e-9
    check_concentration(tmp_path, result, kind)


@needs_ccx
@pytest.mark.parametrize("kind, before", [("CPS6", 0.6), ("CPS6", 1.6), ("C3D10", 0.6)])
def test_kirsch_of_a_hole_made_larger_or_smaller(tmp_path, kind, before):
    flat = kind == "CPS6"
    first = fs.Cylinder(HOLE.origin, HOLE.axis, before * RADIUS)
    refined = fs.refine(plate_for(flat), first, size=(before if flat else 1) * RADIUS / 7, gradation=0.4)
    drilled = fs.drill(refined.mesh, first, name="HOLE").mesh
    result = fs.reshape(drilled, "HOLE_WALL", onto=HOLE)
    wall = np.isin(result.mesh.node_ids, result.mesh.groups["SHAPE_WALL"].ids)
    assert wall.sum() > 40 and np.abs(HOLE.distance(result.mesh.points[wall])).max() < 1e-9
    check_concentration(tmp_path, result, kind)
