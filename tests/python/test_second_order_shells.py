# SPDX-License-Identifier: LGPL-2.1-or-later
"""Second-order triangles, flat and curved: no tool may leave one folded."""

import subprocess

import numpy as np
import pytest

import femscalpel as fs
from test_physics import needs_ccx

CORNERS = ((0, 0), (1, 0), (0, 1))
GAUSS = ((1 / 6, 1 / 6), (2 / 3, 1 / 6), (1 / 6, 2 / 3))

# Tools that left triangles of the plate with a negative Jacobian: centre and radius.
FOLDING = [
    ("crack", 1.8909, 0.3528, 0.1048),
    ("crack", 1.4066, 0.1702, 0.1685),
    ("drill", 1.8214, 0.6733, 0.3236),
    ("drill", 0.5451, 0.7181, 0.2772),
    ("drill", 1.7097, 0.7879, 0.2101),
    ("drill", 1.3281, 0.7739, 0.2232),
    ("drill", 1.667, 0.3801, 0.3297),
]


def grid(nx, ny, place):
    """Triangles of six nodes on a grid of nx by ny squares, nodes at place(i, j) with half squares in between."""
    index = {}
    points = []
    for j in range(2 * ny + 1):
        for i in range(2 * nx + 1):
            x = tuple(place(i / 2, j / 2))
            if (i, j) not in index and (key := tuple(np.round(x, 9))) in index:  # a seam
                index[i, j] = index[key]
                continue
            index[i, j] = index[key] = len(points)
            points.append(x)
    triangles = []
    for j in range(0, 2 * ny, 2):
        for i in range(0, 2 * nx, 2):
            for nodes in (
                ((0, 0), (2, 0), (2, 2), (1, 0), (2, 1), (1, 1)),
                ((0, 0), (2, 2), (0, 2), (1, 1), (1, 2), (0, 1)),
            ):
                triangles.append([index[i + a, j + b] for a, b in nodes])
    return fs.Mesh(points, {"triangle6": triangles})


def flat():
    return grid(8, 4, lambda i, j: (0.25 * i, 0.25 * j, 0.0))


def tube(around=10, along=5):
    """The surface of a cylinder of radius 1 and height 2, all nodes on it."""
    return grid(
        around, along, lambda i, j: (np.cos(2 * np.pi * i / around), np.sin(2 * np.pi * i / around), 2 * j / along)
    )


def jacobians(mesh, at):
    """Of every triangle at some of its points, along the normal of its corners, over that of the straight triangle."""
    x = mesh.points[mesh.cells["triangle6"]]
    normal = np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0])
    out = []
    for r, s in at:
        weights, slopes = np.array([1 - r - s, r, s]), np.array([[-1, -1], [1, 0], [0, 1]])
        gradient = [(4 * weights[i] - 1) * slopes[i] for i in range(3)]
        gradient += [4 * (weights[i] * slopes[j] + weights[j] * slopes[i]) for i, j in ((0, 1), (1, 2), (2, 0))]
        u, v = np.einsum("nij,ik->knj", x, np.array(gradient))
        out.append(np.einsum("ij,ij->i", np.cross(u, v), normal) / np.einsum("ij,ij->i", normal, normal))
    return np.array(out)


def check(result, note):
    assert jacobians(result.mesh, CORNERS).min() > 0, note
    assert jacobians(result.mesh, GAUSS).min() > 0, note
    assert fs.scaled_jacobian(result.mesh)["triangle6"].min() > 0, note


def test_flat_holes_and_cracks():
    mesh = flat()
    rng = np.random.default_rng(5)
    random = [(("drill", "crack")[k % 2], *rng.uniform((0.1, 0.1, 0.05), (1.9, 0.9, 0.35))) for k in range(60)]
    refused = 0
    for operation, x, y, radius in FOLDING + random:
        try:
            result = getattr(fs, operation)(mesh, fs.Cylinder((x, y, 0), (0, 0, 1), radius))
        except fs.QualityError:
            refused += 1
            continue
        check(result, (operation, x, y, radius))
        assert (
            np.cross(*np.diff(result.mesh.points[result.mesh.cells["triangle6"][:, :3]], axis=1).swapaxes(0, 1))[
                :, 2
            ].min()
            > 0
        )
    assert refused <= 1


@pytest.mark.parametrize("kind", ["plane", "hole", "slot", "cylinder", "deform"])
def test_curved_shell(kind):
    mesh = tube()
    rng = np.random.default_rng(7)
    refused = count = 0
    for k in range(30):
        angle, z, size = rng.uniform((0, 0.2, 0.15), (2 * np.pi, 1.8, 0.6))
        direction = rng.normal(size=3)
        direction /= np.linalg.norm(direction)
        outwards = np.array([np.cos(angle), np.sin(angle), 0])
        centre = outwards + [0, 0, z]
        cylinder = fs.Cylinder(centre, outwards + 0.4 * direction, size)
        try:
            result = {
                "plane": lambda: fs.crack(mesh, fs.Plane(centre, direction)),
                "hole": lambda: fs.drill(mesh, cylinder),
                "slot": lambda: fs.cut(mesh, fs.Plane(centre, direction), width=size),
                "cylinder": lambda: fs.crack(mesh, cylinder),
                "deform": lambda: fs.crack(mesh, fs.Plane(centre, direction / 4 + [0, 0, 1]), method="deform"),
            }[kind]()
        except fs.QualityError:
            refused += 1
            continue
        except fs.ToolError:
            continue
        count += 1
        check(result, (kind, k))
        # Still the same surface: all nodes, mid-side nodes too, are as near to it as the input's own triangles are.
        points = result.mesh.points[np.unique(result.mesh.cells["triangle6"])]
        assert np.abs(np.hypot(points[:, 0], points[:, 1]) - 1).max() < 5e-4, (kind, k)
        corners = result.mesh.points[result.mesh.cells["triangle6"][:, :3]]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        assert np.einsum("ij,ij->i", normals[:, :2], corners.mean(axis=1)[:, :2]).min() > 0, (kind, k)
    assert refused <= (22 if kind == "deform" else 1) and count > 0


@needs_ccx
def test_a_drilled_plate_can_be_solved(tmp_path):
    """Every tool that folded triangles: CalculiX stopped at their Jacobians."""
    mesh = flat()
    mesh.add_group("ALL", "element", mesh.cell_ids["triangle6"])
    for name, x in (("LEFT", 0), ("RIGHT", 2)):
        mesh.add_group(name, "node", mesh.node_ids[mesh.points[:, 0] == x])
    fs.write(mesh, tmp_path / "plate.inp")
    text = (tmp_path / "plate.inp").read_text().replace("TYPE=S6", "TYPE=CPS6")
    text += (
        "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3\n*SOLID SECTION, ELSET=ALL, MATERIAL=STEEL\n1.\n"
        "*STEP\n*STATIC\n*BOUNDARY\nLEFT, 1, 2\nRIGHT, 1, 1, 0.001\n*NODE FILE\nU\n*END STEP\n"
    )
    (tmp_path / "plate.inp").write_text(text)
    for operation, x, y, radius in FOLDING:
        result = getattr(fs, operation)(fs.read(tmp_path / "plate.inp"), fs.Cylinder((x, y, 0), (0, 0, 1), radius))
        fs.write(result.mesh, tmp_path / "run.inp")
        done = subprocess.run(["ccx", "run"], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        assert done.returncode == 0 and "*ERROR" not in done.stdout and "Job finished" in done.stdout, (
            operation,
            x,
            y,
            done.stdout[-2000:],
        )
