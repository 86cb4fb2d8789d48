# SPDX-License-Identifier: LGPL-2.1-or-later
"""What meets has quadrangles, hexahedra, prisms, pyramids: they become triangles and tetrahedra there, and nowhere
else."""

import numpy as np
import pytest

import femscalpel as fs
from merge_cases import KINDS, in_one_line, of_quadrangles, with_middles
from merge_parts import block, check_conforming, check_untouched, pipe, plate, rod
from mixed_meshes import grid, prisms_of, second_order, worst_of


def bricks(origin, size, counts, kind, name):
    """A block of hexahedra or prisms, with its elements in a group."""
    points, cells = grid(counts)
    if kind == "wedge":
        cells = prisms_of(cells)
    points = points / counts * size + origin
    return fs.Mesh(points, {kind: cells}, groups={name: ("element", np.arange(1, len(cells) + 1))})


def measures_kept(result, names):
    records = {g.name: g for g in result.report.groups}
    return all(records[n].measure_after == pytest.approx(records[n].measure_before, rel=1e-9) for n in names)


def measure_of(mesh, group):
    members = mesh.groups[group, "element"].ids
    return sum(v[np.isin(mesh.cell_ids[k], members)].sum() for k, v in fs.measure(mesh).items())


@pytest.mark.parametrize("second_order", [False, True])
@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("kind", ["quadrangles", "on_bricks", "shell_on_bricks"])
def test_random_placements(kind, seed, second_order):
    mesh, part = KINDS[kind](np.random.default_rng(seed + 1000))
    if second_order:
        mesh = with_middles(mesh)
    result = fs.merge(mesh, part)
    result.mesh.validate()
    check_conforming(result.mesh)
    assert worst_of(result.mesh) > min(0.12, 0.9 * worst_of(part))
    assert result.report.converted
    if kind == "quadrangles":
        assert in_one_line(result.mesh)
    if kind != "quadrangles" or "FLOOR" in mesh.groups:
        assert measures_kept(result, set(mesh.groups) & {"CORE", "FLOOR"})


@pytest.mark.parametrize("keep", ["mesh", "addition"])
@pytest.mark.parametrize("kinds", [("hexahedron", "wedge"), ("wedge", "hexahedron"), ("hexahedron", "hexahedron")])
def test_bricks_into_bricks(kinds, keep):
    box = bricks((0, 0, 0), (6, 5, 4), (14, 12, 10), kinds[0], "BOX")
    box.add_group("FIX", "node", box.node_ids[box.points[:, 2] == 0])
    part = bricks((1.9, 1.6, 3.4), (2.2, 1.7, 2.1), (4, 3, 4), kinds[1], "BOSS")
    result = fs.merge(box, part, name="B", keep=keep)
    check_conforming(result.mesh)
    total = sum(v.sum() for v in fs.measure(result.mesh).values())
    assert total == pytest.approx(120 + 2.2 * 1.7 * 1.5, rel=1e-9)
    kept = ("BOX", 120) if keep == "mesh" else ("BOSS", 2.2 * 1.7 * 2.1)
    assert measure_of(result.mesh, kept[0]) == pytest.approx(kept[1], rel=1e-9)
    check_untouched(box, result.mesh, lambda x: x[:, 2] < 1.3)
    assert set(result.mesh.groups["FIX"].ids) == set(box.groups["FIX"].ids)
    left = len(result.mesh.cells[kinds[0]])
    assert left > len(box.cells[kinds[0]]) / 4
    assert result.report.converted[kinds[0]] + left >= len(box.cells[kinds[0]])


def test_a_plate_on_hexahedra_and_one_of_quadrangles_round_a_pipe():
    box = bricks((0, 0, 0), (6, 5, 4), (12, 10, 8), "hexahedron", "BOX")
    fin = of_quadrangles(plate((1.2, 1.3, 4), (3.3, 2, 0), (0, 0.3, 2), (6, 2), "FIN"), np.random.default_rng(2))
    mesh = fs.merge(box, fin).mesh
    check_conforming(mesh)
    shells = np.unique(np.concatenate([c.ravel() for k, c in mesh.cells.items() if k.startswith(("tri", "quad"))]))
    solids = np.unique(np.concatenate([c.ravel() for k, c in mesh.cells.items() if k not in ("triangle", "quad")]))
    assert set(mesh.node_ids[np.intersect1d(shells, solids)]) == set(mesh.groups["ADD_SEAM"].ids)

    ring = of_quadrangles(pipe((3.1, 2.4, -1), 1.1, 3, (16, 8), "RING"), np.random.default_rng(2))
    floor = of_quadrangles(plate((0, 0, 0), (6, 0, 0), (0, 5, 0), (12, 10), "FLOOR"), np.random.default_rng(2))
    result = fs.merge(floor, ring)
    check_conforming(result.mesh)
    assert in_one_line(result.mesh)
    assert measures_kept(result, ["FLOOR"])


def test_what_is_far_finer_refines_what_was_divided():
    box = bricks((0, 0, 0), (8, 8, 8), (4, 4, 4), "hexahedron", "BOX")
    result = fs.merge(box, rod((4, 4, 8), 0.6, 1, (4, 6), "PIN"))
    check_conforming(result.mesh)
    assert result.report.refinement is not None
    assert measures_kept(result, ["BOX"])
    assert worst_of(result.mesh) > 0.12


def test_a_deck_of_hexahedra_is_carried(tmp_path):
    box = bricks((0, 0, 0), (6, 5, 4), (12, 10, 8), "hexahedron", "BOX")
    path = tmp_path / "box.inp"
    fs.write(box, path)
    with path.open("a") as deck:
        deck.write("*MATERIAL, NAME=S\n*ELASTIC\n210000., .3\n*SOLID SECTION, ELSET=BOX, MATERIAL=S\n")
        deck.write("*STEP\n*STATIC\n*DLOAD\nBOX, GRAV, 9.81, 0., 0., -1.\n*END STEP\n")
    text = path.read_text().replace("TYPE=C3D8\n", "TYPE=C3D8I\n").replace("TYPE=C3D8,", "TYPE=C3D8I,")
    path.write_text(text)
    result = fs.merge(fs.read(path), block((3, 2.6, 4), (2.2, 1.7, 1.5), (3, 3, 2), "BOSS"))
    fs.write(result.mesh, tmp_path / "out.inp")
    out = (tmp_path / "out.inp").read_text()
    assert "TYPE=C3D8I" in out and "TYPE=C3D4" in out and "BOX, GRAV" in out
    assert sum("stiffer in bending" in w for w in result.report.warnings) == 1
    assert set(result.report.converted) == {"hexahedron"}
    again = fs.read(tmp_path / "out.inp")
    assert sum(len(c) for c in again.cells.values()) == sum(len(c) for c in result.mesh.cells.values())


def test_quadrangles_of_first_order_in_a_deck_are_warned_of(tmp_path):
    floor = of_quadrangles(plate((0, 0, 0), (6, 0, 0), (0, 5, 0), (12, 10), "FLOOR"), np.random.default_rng(2))
    path = tmp_path / "floor.inp"
    fs.write(floor, path)
    with path.open("a") as deck:
        deck.write("*MATERIAL, NAME=S\n*ELASTIC\n210000., .3\n*SHELL SECTION, ELSET=FLOOR, MATERIAL=S\n.1\n")
    text = "first-order quadrangles near the tool became first-order triangles (S4 to S3"
    rib = plate((1.2, 1.3, 0), (3.3, 2, 0), (0, 0.3, 2), (6, 2), "FIN")
    assert any(text in w for w in fs.merge(fs.read(path), rib).report.warnings)
    assert any(text in w for w in fs.crack(fs.read(path), fs.Plane((3.1, 2, 0), (1, 0.2, 0))).report.warnings)
    assert not any(text in w for w in fs.merge(floor, rib).report.warnings)


def of_nine_nodes(counts, size, name, place, bend=0.0):
    """A shell of quadrangles with a node in their middle, all its nodes in a group; with its height along z if placed
    above the ground, else flat or bent about y."""
    points, cells = second_order(*grid(counts, 0.15), "quad")
    points = points / [*counts, 1] * [*size, 1]
    cells = np.column_stack([cells, len(points) + np.arange(len(cells))])
    points = np.vstack([points, points[cells[:, :4]].mean(axis=1)])
    points[:, 2] = bend * points[:, 0] * (size[0] - points[:, 0])
    if place is not None:
        points = points[:, [0, 2, 1]] + place
    groups = {name: ("element", np.arange(1, len(cells) + 1)), name + "_N": ("node", np.arange(1, len(points) + 1))}
    return fs.Mesh(points, {"quad9": cells}, groups=groups)


@pytest.mark.parametrize("bend", [0, 0.02])
@pytest.mark.parametrize("part", ["quad9", "triangle"])
def test_quadrangles_of_nine_nodes(bend, part, tmp_path):
    """They become triangles of six nodes there; their middle nodes go where none is needed, and are in no element's
    way."""
    floor = of_nine_nodes((10, 10), (10, 10), "FLOOR", None, bend)
    place = np.array([2.3, 5.1, 0.25 if bend else 0])
    if part == "quad9":
        rib = of_nine_nodes((6, 3), (5, 2), "RIB", place)
    else:
        rib = plate(place, (5, 0.2, 0), (0, 0, 2), (6, 3), "RIB")
    result = fs.merge(floor, rib)
    mesh = result.mesh
    mesh.validate()
    check_conforming(mesh)
    assert in_one_line(mesh) and worst_of(mesh) > 0.25
    assert set(mesh.cells) == {"quad9", "triangle6"} and result.report.converted["quad9"] > 18 * (part == "quad9")
    assert measure_of(mesh, "FLOOR") == pytest.approx(measure_of(floor, "FLOOR"), rel=1e-5 if bend else 1e-12)
    in_use = np.unique(np.concatenate([c.reshape(-1) for c in mesh.cells.values()]))
    assert len(in_use) == mesh.node_count
    in_floor = np.isin(mesh.cell_ids["triangle6"], mesh.groups["FLOOR"].ids)
    nodes = set(mesh.node_ids[mesh.cells["triangle6"][in_floor]].flat) | set(mesh.node_ids[mesh.cells["quad9"]].flat)
    assert nodes == set(mesh.groups["FLOOR_N"].ids)
    fs.write(mesh, tmp_path / "joined.med")
    assert {k: len(c) for k, c in fs.read(tmp_path / "joined.med").cells.items()} == {
        k: len(c) for k, c in mesh.cells.items()
    }
    with pytest.raises(fs.WriteError, match="elements of type quad9: CalculiX has no such element"):
        fs.write(mesh, tmp_path / "joined.inp")


def test_quadrangles_are_called_as_the_deck_calls_them(tmp_path):
    nodes = [(i, j) for i in range(9) for j in range(9)]
    number = {n: k + 1 for k, n in enumerate(nodes)}
    rows = {"CAX4": [], "CPS4R": []}
    for k, (i, j) in enumerate((i, j) for i in range(8) for j in range(8)):
        corners = [number[n] for n in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))]
        rows["CAX4" if j < 5 else "CPS4R"].append(", ".join(map(str, [k + 1, *corners])))
    text = "*NODE\n" + "".join(f"{number[n]}, {n[0] + 5}, {n[1]}, 0\n" for n in nodes)
    for label, lines in rows.items():
        text += f"*ELEMENT, TYPE={label}, ELSET={label}\n" + "\n".join(lines) + "\n"
    (tmp_path / "a.inp").write_text(text)
    mesh = fs.read(tmp_path / "a.inp")
    for plane, said in (
        (fs.Plane((9.1, 2, 0), (1, 0.1, 0)), "(CAX4 to CAX3, CPS4R to CPS3), which"),
        (fs.Plane((9, 0.4, 0), (0, 1, 0)), "(CAX4 to CAX3), which"),
    ):
        (warning,) = [w for w in fs.crack(mesh, plane, transition=1).report.warnings if "stiffer" in w]
        assert said in warning
