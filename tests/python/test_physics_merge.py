# SPDX-License-Identifier: LGPL-2.1-or-later
"""What CalculiX makes of joined meshes: across the seam a linear field is exact, and a stiffened plate bends as one
that was meshed at once."""

import re
import subprocess

import numpy as np
import pytest

import femscalpel as fs
from merge_parts import block, edges_of, joined, plate, rod, tube
from meshes import grid_box, quadratic
from mixed_meshes import EDGES, outer_faces, second_order_of_all
from test_merge_other_elements import bricks
from test_merge import second_order_triangles
from test_physics import MATERIAL, SOLID, Model, deviation, needs_ccx, table

BOSSES = {
    "block on": block((3, 2.6, 4), (2.2, 1.7, 1.5), (3, 3, 2), "BOSS"),
    "rod into": rod((3, 2.6, 3.2), 1.1, 2.3, (2, 3), "BOSS"),
    "tube on": tube((3, 2.5, 4), 0.7, 1.4, 1.5, (14, 2, 2), "BOSS"),
}


class Joined(Model):
    """The deck of a box with something joined to it."""

    def __init__(self, folder, mesh):
        self.folder, self.flat, self.pairs, self.mesh = folder, False, [], mesh
        mesh.add_group("ALL", "element", np.concatenate(list(mesh.cell_ids.values())))
        fs.write(mesh, folder / "model.inp")
        with (folder / "model.inp").open("a") as deck:
            deck.write(SOLID.format(thickness=""))
        self.point = dict(zip(mesh.node_ids.tolist(), mesh.points))

    def skin(self):
        """But for nodes at the base of pyramids, which the deck keeps in the middle of their edge."""
        edges = {edge for ring in outer_faces(self.mesh).values() for edge in edges_of(ring)}
        on_skin = {n for edge in edges for n in edge}
        for kind, cells in self.mesh.cells.items():
            ends = EDGES.get(kind.rstrip("0123456789"), [])
            corners = 1 + max((max(e) for e in ends), default=0)
            if cells.shape[1] <= corners:
                continue
            for k, (a, b) in enumerate(ends):
                on_skin |= {c[corners + k] for c in cells.tolist() if tuple(sorted((c[a], c[b]))) in edges}
        text = (self.folder / "model.inp").read_text()
        dependent = {int(n) for n in re.findall(r"(?m)^3\n *(\d+), 1, 1\.,", text)}
        return [n for n in sorted(self.mesh.node_ids[list(on_skin)].tolist()) if n not in dependent]


@needs_ccx
@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("name", BOSSES)
def test_a_linear_field_is_exact_across_the_seam(tmp_path, name, order):
    box = grid_box((6, 5, 4), (6.0, 5.0, 4.0))
    mesh = fs.merge(quadratic(box) if order == 2 else box, BOSSES[name], name="B").mesh
    model = Joined(tmp_path, mesh)
    inner = set(mesh.groups["B_SEAM"].ids) - set(model.skin())
    assert len(inner) >= 1 or order == 1
    assert deviation(model) <= 1e-8


@needs_ccx
@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("keep", ["mesh", "addition"])
@pytest.mark.parametrize("kinds", [("hexahedron", "hexahedron"), ("wedge", "hexahedron"), ("hexahedron", "tetra")])
def test_a_linear_field_is_exact_where_bricks_meet(tmp_path, kinds, keep, order):
    box = bricks((0, 0, 0), (6, 5, 4), (14, 12, 10), kinds[0], "BOX")
    if order == 2:
        box = fs.Mesh(*second_order_of_all(box.points, box.cells))
    part = bricks((1.9, 1.6, 3.4), (2.2, 1.7, 2.1), (3, 3, 3), kinds[1], "BOSS") if kinds[1] != "tetra" else None
    mesh = fs.merge(box, part or BOSSES["rod into"], name="B", keep=keep).mesh
    assert len(set(k.rstrip("0123456789") for k in mesh.cells) & {"pyramid", "tetra", kinds[0]}) == 3
    model = Joined(tmp_path, mesh)
    assert set(mesh.groups["B_SEAM"].ids) - set(model.skin())
    assert deviation(model) <= 1e-8


def stiffened(folder, mesh):
    """Displacement of the free corners, and the force on each half of the clamped border, under pressure."""
    fs.write(mesh, folder / "run.inp")
    held = mesh.node_ids[np.abs(mesh.points[:, 0]) < 1e-9]
    low = mesh.node_ids[(np.abs(mesh.points[:, 0]) < 1e-9) & (mesh.points[:, 1] < 5 - 1e-9)]
    ends = [mesh.node_ids[np.linalg.norm(mesh.points - x, axis=1).argmin()] for x in ((10, 0, 0), (10, 10, 0))]

    def node_set(name, numbers):
        return f"*NSET, NSET={name}\n" + "".join(f"{n},\n" for n in numbers)

    with (folder / "run.inp").open("a") as deck:
        deck.write(node_set("HELD", held) + node_set("LOW", low) + node_set("ENDS", ends))
        deck.write(MATERIAL.format(poisson=0.3))
        for part in ("FLOOR", "RIB"):
            deck.write(f"*SHELL SECTION, ELSET={part}, MATERIAL=STEEL\n0.1\n")
        deck.write("*STEP\n*STATIC\n*BOUNDARY\nHELD,1,6\n*DLOAD\nFLOOR,P,0.01\n*NODE PRINT, NSET=ENDS\nU\n")
        deck.write("*NODE PRINT, NSET=HELD\nRF\n*NODE PRINT, NSET=LOW\nRF\n*END STEP\n")
    done = subprocess.run(["ccx", "run"], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert done.returncode == 0 and "*ERROR" not in done.stdout, done.stdout[-2000:]
    dat = (folder / "run.dat").read_text()
    forces = table(dat, "set HELD")
    return (
        np.array([table(dat, "displacements")[n] for n in ends]),
        sum(f[2] for f in forces.values()),
        sum(f[2] for n, f in forces.items() if n in set(low)),
    )


@needs_ccx
def test_a_stiffened_plate_bends_as_one_meshed_at_once(tmp_path):
    rib = [(0, 4, 0), (10, 0, 0), (0, 0, 1.5)]
    at_once = joined(
        plate((0, 0, 0), (10, 0, 0), (0, 10, 0), (20, 20), "FLOOR"), plate(*rib, (20, 3), "RIB"), name="ALL"
    )
    centres = at_once.points[at_once.cells["triangle"]].mean(axis=1)
    for name, of in (("FLOOR", centres[:, 2] == 0), ("RIB", centres[:, 2] > 0)):
        at_once.add_group(name, "element", at_once.cell_ids["triangle"][of])
    groups = {name: (at_once.groups[name].kind, at_once.groups[name].ids) for name in ("FLOOR", "RIB")}
    second = second_order_triangles(at_once)
    for name, (kind, ids) in groups.items():
        second.add_group(name, kind, ids)

    floor = plate((0, 0, 0), (10, 0, 0), (0, 10, 0), (19, 21), "FLOOR", jitter=0.2, seed=3)
    base = second_order_triangles(floor)
    base.add_group("FLOOR", "element", base.cell_ids["triangle6"])
    merged = fs.merge(base, plate(*rib, (17, 3), "RIB"), name="ADD").mesh

    folders = tmp_path / "once", tmp_path / "merged"
    for folder in folders:
        folder.mkdir()
    expected, got = stiffened(folders[0], second), stiffened(folders[1], merged)
    print(f"\ndeflections {got[0][:, 2]} for {expected[0][:, 2]}, forces {got[1:]} for {expected[1:]}")
    size = np.abs(expected[0]).max()
    assert got[0][:, 2] == pytest.approx(expected[0][:, 2], abs=0.01 * size)
    assert got[1] == pytest.approx(expected[1], rel=0.01) and got[2] == pytest.approx(expected[2], rel=0.03)
