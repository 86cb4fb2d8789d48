# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cracks that end in the material, solved with CalculiX: openings and stress intensities against exact solutions."""

import subprocess

import numpy as np
import pytest

import femscalpel as fs
from meshes import grid_box, quadratic
from test_physics import SOLID, lip_pairs, needs_ccx, plate, quadratic_of, table

YOUNG, POISSON, STRESS = 210000.0, 0.3, 100.0
PLANE_STRAIN = YOUNG / (1 - POISSON**2)


def opening(folder, cracked, body, solver_type, loads, held, direction):
    """Solves; returns the place and the opening along axis `direction` of every pair of lip nodes."""
    pairs = lip_pairs(cracked)
    ids = cracked.cell_ids[body]
    deck = fs.Mesh(
        cracked.points, {body: cracked.cells[body]}, cracked.node_ids, {body: ids}, {"ALL": ("element", ids)}
    )
    path = folder / "run.inp"
    fs.write(deck, path)
    text = path.read_text()
    if solver_type:
        text = text.replace("TYPE=S6", f"TYPE={solver_type}")
        assert f"TYPE={solver_type}" in text
    text += SOLID.format(thickness="1.\n" if solver_type else "")
    text += "*NSET, NSET=LIPS\n" + "".join(f"{n},\n" for pair in pairs for n in pair)
    text += "*STEP\n*STATIC\n*BOUNDARY\n" + "".join(f"{n},{k},{k}\n" for n, k in held)
    text += "*CLOAD\n" + "".join(f"{n},{direction + 1},{force:.15g}\n" for n, force in loads.items())
    path.write_text(text + "*NODE PRINT, NSET=LIPS\nU\n*END STEP\n")
    done = subprocess.run(["ccx", "run"], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert done.returncode == 0 and "*ERROR" not in done.stdout, done.stdout[-2000:]
    u = table((folder / "run.dat").read_text(), "displacements")
    index = {int(n): i for i, n in enumerate(cracked.node_ids)}
    places = np.array([cracked.points[index[n]] for _, n in pairs])
    return places, np.array([u[p][direction] - u[n][direction] for p, n in pairs])


def intensity(distance, opening):
    """K_I at a front from openings at these distances from it: each gives one by the leading term of the field, and the
    line through them its value at the front."""
    apparent = PLANE_STRAIN * opening * np.sqrt(2 * np.pi / distance) / 8
    return np.polynomial.polynomial.polyfit(distance, apparent, 1)[0]


@needs_ccx
def test_edge_crack_in_a_strip(tmp_path):
    """Brown and Srawley's polynomial, as in Tada, Paris, Irwin, The Stress Analysis of Cracks Handbook, 2.10; 0.5 %."""
    width, height, depth = 10.0, 30.0, 3.0
    tip = np.array([depth, 15.4, 0])
    mesh = quadratic_of(plate((10, 30), (width, height)))
    mesh = fs.refine(mesh, tip, size=depth / 25, gradation=0.25).mesh
    result = fs.crack(mesh, fs.Plane(tip, (0, 1, 0)), within=fs.HalfPlane(tip, (-1, 0, 0)))
    cracked = result.mesh
    points, cells = cracked.points, cracked.cells["triangle6"]
    loads = {}
    for y, sign in ((0.0, -1), (height, 1)):
        for a, b, m in ((0, 1, 3), (1, 2, 4), (2, 0, 5)):
            for edge in cells[(np.abs(points[cells[:, [a, b]]][:, :, 1] - y) < 1e-9).all(axis=1)][:, [a, b, m]]:
                force = sign * STRESS * np.linalg.norm(points[edge[0]] - points[edge[1]])
                for node, share in zip(cracked.node_ids[edge].tolist(), (1 / 6, 1 / 6, 2 / 3)):
                    loads[node] = loads.get(node, 0.0) + share * force
    assert sum(abs(f) for f in loads.values()) == pytest.approx(2 * STRESS * width)
    corner = {y: int(cracked.node_ids[np.linalg.norm(points - (width, y, 0), axis=1).argmin()]) for y in (0.0, height)}
    places, gap = opening(
        tmp_path, cracked, "triangle6", "CPE6", loads, [(corner[0.0], 1), (corner[0.0], 2), (corner[height], 1)], 1
    )
    distance = depth - places[:, 0]
    assert (distance > 0).all() and (np.abs(places[:, 1] - tip[1]) < 1e-9).all()
    near = (distance > 0.1 * depth) & (distance < 0.4 * depth)
    assert near.sum() >= 8
    found = intensity(distance[near], gap[near])
    ratio = depth / width
    exact = (
        STRESS
        * np.sqrt(np.pi * depth)
        * (1.12 - 0.231 * ratio + 10.55 * ratio**2 - 21.72 * ratio**3 + 30.39 * ratio**4)
    )
    print(
        f"\nedge crack: {len(cells)} CPE6, K_I {found:.1f}, handbook {exact:.1f} ({100 * (found / exact - 1):+.2f} %)"
    )
    assert found == pytest.approx(exact, rel=0.05)


@needs_ccx
def test_penny_crack(tmp_path):
    """Sneddon's solution in the infinite body; a quarter of a block ten radii wide (its finite size gives about 0.8
    %)."""
    radius, size = 1.0, np.array([5.0, 5.0, 10.0])
    centre = np.array([0, 0, 5.0])
    mesh = quadratic(grid_box((5, 5, 9), size))
    angle = np.linspace(0, np.pi / 2, 80)
    front = centre + radius * np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    mesh = fs.refine(mesh, centre, size=0.3, reach=0.8, gradation=0.5).mesh
    mesh = fs.refine(mesh, front, size=0.1, gradation=0.5).mesh
    result = fs.crack(mesh, fs.Plane(centre, (0, 0, 1)), within=fs.Disk(centre, radius))
    cracked = result.mesh
    points, cells, ids = cracked.points, cracked.cells["tetra10"], cracked.node_ids
    loads = {}
    for z, sign in ((0.0, -1), (size[2], 1)):
        for corners, middles in (
            ((0, 1, 2), (4, 5, 6)),
            ((0, 1, 3), (4, 8, 7)),
            ((1, 2, 3), (5, 9, 8)),
            ((0, 2, 3), (6, 9, 7)),
        ):
            on = (np.abs(points[cells[:, corners]][:, :, 2] - z) < 1e-9).all(axis=1)
            a, b, c = (points[cells[on, k]] for k in corners)
            areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
            for nodes, area in zip(
                ids[cells[on][:, middles]].tolist(), areas
            ):  # a flat six-node face loads its mid-side nodes alone
                for n in nodes:
                    loads[n] = loads.get(n, 0.0) + sign * STRESS * area / 3
    assert sum(abs(f) for f in loads.values()) == pytest.approx(2 * STRESS * 25)
    used = np.isin(np.arange(len(ids)), cells)
    held = [(int(n), k + 1) for k in (0, 1) for n in ids[used & (np.abs(points[:, k]) < 1e-9)]]
    held.append((int(ids[np.linalg.norm(points - (size[0], size[1], 0), axis=1).argmin()]), 3))
    places, gap = opening(tmp_path, cracked, "tetra10", None, loads, held, 2)
    r = np.linalg.norm(places - centre, axis=1)
    assert r.max() < radius and (np.abs(places[:, 2] - centre[2]) < 1e-9).all()

    exact = 8 * (1 - POISSON**2) * STRESS * radius / (np.pi * YOUNG)
    profile = gap / np.sqrt(1 - (r / radius) ** 2)
    middle = profile[r < 0.4].mean()
    spread = np.abs(profile[r < 0.85] / middle - 1).max()
    k_exact = 2 * STRESS * np.sqrt(radius / np.pi)
    place = np.degrees(np.arctan2(places[:, 1], places[:, 0]))
    found = []
    for start in range(0, 90, 15):
        near = (place >= start) & (place <= start + 15) & (radius - r > 0.1) & (radius - r < 0.45)
        assert near.sum() >= 8
        found.append(intensity(radius - r[near], gap[near]) / k_exact)
    print(
        f"\npenny crack: {len(cells)} C3D10, minimum mean ratio {result.report.quality.after.minimum:.2f}; opening in "
        f"the middle {middle:.3e}, exact "
        f"{exact:.3e} ({100 * (middle / exact - 1):+.2f} %), profile off the ellipse by {100 * spread:.2f} %; K_I / "
        f"exact along the front " + " ".join(f"{f:.3f}" for f in found)
    )
    assert middle == pytest.approx(exact, rel=0.03)
    assert spread < 0.03
    assert np.abs(np.array(found) - 1).max() < 0.05
