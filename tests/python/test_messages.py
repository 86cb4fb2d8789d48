# SPDX-License-Identifier: LGPL-2.1-or-later
"""What operators say when a tool cuts nothing is so."""

import numpy as np
import pytest

import femscalpel as fs
from meshes import grid_box, quadratic

TETRA = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)


def message(call):
    with pytest.raises(fs.ToolError) as caught:
        call()
    return str(caught.value)


def two_plates(distance=0.0):
    """Two plates of two triangles, one at y >= 0, one at y <= -distance, with nodes of their own."""
    points = [
        [0, 0, 0],
        [1, 0, 0],
        [0, 1, 0],
        [1, 1, 0],
        [0, -distance, 0],
        [1, -distance, 0],
        [0, -1 - distance, 0],
        [1, -1 - distance, 0],
    ]
    return fs.Mesh(points, {"triangle": [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5]]})


def test_tool_beside_the_mesh():
    text = message(lambda: fs.crack(grid_box(), fs.Plane((8, 0, 0), (1, 0, 0))))
    assert "the whole mesh lies on its negative side, the nearest node at distance 2." in text


def test_tool_between_two_bodies():
    mesh = fs.Mesh(np.vstack([TETRA, TETRA + (3, 0, 0)]), {"tetra": [[0, 1, 2, 3], [4, 5, 6, 7]]})
    for normal, sides in (((1, 0, 0), (0.5, 1.5)), ((-1, 0, 0), (1.5, 0.5))):
        text = message(lambda: fs.crack(mesh, fs.Plane((1.5, 0, 0), normal)))
        assert "passes between parts of the mesh, through no element" in text and "whole mesh" not in text
        assert f"at distance {sides[0]} on its negative side and {sides[1]} on its positive side" in text
    text = message(lambda: fs.drill(mesh, fs.Sphere((0.25, 0.25, 0.25), 2)))
    assert "passes between parts of the mesh" in text


def test_nodes_without_elements_are_no_mesh():
    mesh = fs.Mesh(np.vstack([TETRA, [[9, 0, 0]]]), {"tetra": [[0, 1, 2, 3]]})
    assert "the whole mesh lies on its negative side, the nearest node at distance 4." in message(
        lambda: fs.crack(mesh, fs.Plane((5, 0, 0), (1, 0, 0)))
    )


def test_plane_through_springs_only(tmp_path):
    nodes = "".join(f"{k + 1}, {x}, {y}, {z}\n" for k, (x, y, z) in enumerate([*TETRA, (5, 0, 0)]))
    deck = tmp_path / "spring.inp"
    deck.write_text(
        f"*NODE\n{nodes}*ELEMENT, TYPE=C3D4\n7, 1, 2, 3, 4\n*ELEMENT, TYPE=SPRINGA, ELSET=S\n12, 2, 5\n"
        "*SPRING, ELSET=S\n\n10.\n"
    )
    assert "passes only through segments (element 12), which cannot be divided" in message(
        lambda: fs.crack(fs.read(str(deck)), fs.Plane((3, 0, 0), (1, 0, 0)))
    )


@pytest.mark.parametrize("normal", [(0, 1, 0), (0, -1, 0)])
def test_plane_in_an_open_contact(normal):
    text = message(lambda: fs.crack(two_plates(), fs.Plane((0, 0, 0), normal)))
    assert "lies on faces that are open already" in text and "graze" not in text


def test_disk_in_an_open_contact():
    lower, upper = grid_box((4, 4, 2), (4, 4, 2)), grid_box((4, 4, 2), (4, 4, 2))
    mesh = fs.Mesh(
        np.vstack([lower.points, upper.points + (0, 0, 2)]),
        {"tetra": np.vstack([lower.cells["tetra"], upper.cells["tetra"] + lower.node_count])},
    )
    assert "open already" in message(lambda: fs.crack(mesh, fs.Plane((2, 2, 2), (0, 0, 1))))
    assert "open already" in message(
        lambda: fs.crack(mesh, fs.Plane((2, 2, 2), (0, 0, 1)), within=fs.Disk((2, 2, 2), 1.2))
    )


def test_plane_on_the_outside():
    text = message(lambda: fs.crack(grid_box(), fs.Plane((6, 0, 0), (1, 0, 0))))
    assert "touches the mesh, on its outside: all elements there are on its negative side" in text
    # Faces on both sides of the plane, but nowhere at one place.
    points = two_plates().points.copy()
    points[4:, 0] += 5
    text = message(lambda: fs.crack(fs.Mesh(points, two_plates().cells), fs.Plane((0, 0, 0), (0, 1, 0))))
    assert "touches the mesh, on its outside: wherever it does, the elements are on one side of it only" in text


def test_tools_smaller_than_the_elements_inside_do_not_touch_from_outside():
    mesh = grid_box()
    for call in (
        lambda: fs.drill(mesh, fs.Cylinder((3, 2, 2), (0, 0, 1), 1e-12), refine=False),
        lambda: fs.crack(mesh, fs.Sphere((3, 2, 2), 1e-9), refine=False),
    ):
        with pytest.raises(fs.ToolError) as error:
            call()
        assert "smaller than the elements there" in str(error.value) and "outside" not in str(error.value)
    for x in (3, 2.5):
        with pytest.raises(fs.ToolError, match="slot of width 1e-09 removes nothing: it is narrower than") as error:
            fs.cut(mesh, fs.Plane((x, 0, 0), (1, 0, 0)), width=1e-9)
        assert error.value.parameter == "width"
    with pytest.raises(fs.ToolError, match="touches the mesh from outside"):
        fs.cut(mesh, fs.Plane((0, 0, 0), (1, 0, 0)), width=1e-9)


def test_a_hole_within_another_is_told():
    def hole(x, y, radius):
        return fs.Cylinder((x, y, 2), (0, 0, 1), radius)

    mesh = grid_box()
    small = fs.drill(mesh, [hole(3, 2, 0.6), hole(3, 2, 1.2)])
    assert len(small.mesh.groups["HOLE_WALL1"]) == 0
    assert [w for w in small.report.warnings if "nothing is left of the wall HOLE_WALL1 (cylinder)" in w]
    two = fs.drill(mesh, [hole(1.5, 2, 0.6), hole(4, 2, 0.6)])
    assert not [w for w in two.report.warnings if "nothing is left" in w]


def test_plane_through_a_corner_touches():
    text = message(lambda: fs.crack(fs.Mesh(TETRA, {"tetra": [[0, 1, 2, 3]]}), fs.Plane((1, 0, 0), (1, 0, 0))))
    assert "only touches the mesh, along edges or in single nodes" in text and "thinner" not in text
    text = message(lambda: fs.drill(grid_box(), fs.Cylinder((-1, 2, 0), (0, 0, 1), 1)))
    assert "removes nothing: it touches the mesh from outside" in text


def test_hole_inside_one_element():
    quad = fs.Mesh([[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]], {"quad": [[0, 1, 2, 3]]}, cell_ids={"quad": [31]})
    text = message(lambda: fs.drill(quad, fs.Cylinder((2, 1, 0), (0, 0, 1), 0.5), refine=False))
    assert (
        "lies inside element 31 (quad)" in text
        and "smaller than the elements there. Refine" in text
        and "misses" not in text
    )
    brick = fs.Mesh(
        [[x, y, z] for z in (0, 4) for x, y in ((0, 0), (4, 0), (4, 4), (0, 4))], {"hexahedron": [list(range(8))]}
    )
    text = message(lambda: fs.drill(brick, fs.Cylinder((2.3, 1, 0), (0, 0, 1), 0.2), refine=False))
    assert "lies inside element 1 (hexahedron)" in text
    triangles = fs.Mesh([[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]], {"triangle": [[0, 1, 2], [0, 2, 3]]})
    text = message(lambda: fs.drill(triangles, fs.Cylinder((1, 3, 0), (0, 0, 1), 0.2), refine=False))
    assert "lies inside element 2, between" in text and "smaller than the elements there. Refine" in text
    beside = message(lambda: fs.drill(triangles, fs.Cylinder((1, 4.3, 0), (0, 0, 1), 0.2), refine=False))
    assert "whole mesh lies on its positive side" in beside


def test_blind_hole_that_ends_before_the_elements_misses_them():
    quad = fs.Mesh([[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]], {"quad": [[0, 1, 2, 3]]})
    assert "inside" not in message(lambda: fs.drill(quad, fs.Cylinder((2, 2, 5), (0, 0, -1), 0.5), depth=2))


def test_plane_through_curved_sides_only():
    mesh = quadratic(fs.Mesh(TETRA, {"tetra": [[0, 1, 2, 3]]}))
    points = mesh.points.copy()
    middle = np.linalg.norm(points - (0.5, 0.5, 0), axis=1).argmin()
    points[middle] += (0.1, 0.1, 0)
    text = message(lambda: fs.crack(fs.Mesh(points, mesh.cells), fs.Plane((0.58, 0.58, 0), (1, 1, 0))))
    assert "through the curved sides of element 1, but between none of their corners" in text


def plate_with_groups(**groups):
    """6 by 6 squares of two triangles; groups of triangles by a condition on their middles."""
    points = np.array([(i, j, 0.0) for j in range(7) for i in range(7)])
    triangles = np.array(
        [
            (j * 7 + i + a, j * 7 + i + b, j * 7 + i + c)
            for j in range(6)
            for i in range(6)
            for a, b, c in ((0, 1, 8), (0, 8, 7))
        ]
    )
    middles = points[triangles].mean(axis=1)
    return fs.Mesh(
        points,
        {"triangle": triangles},
        groups={name: ("element", 1 + np.nonzero(inside(middles))[0]) for name, inside in groups.items()},
    )


def test_plane_exactly_on_a_border_is_no_wedge():
    mesh = plate_with_groups(LEFT=lambda m: m[:, 0] < 3)
    report = fs.crack(mesh, fs.Plane((3, 0, 0), (1, 0, 0))).report
    assert report.nodes_moved == 0 and report.quality.after.minimum == report.quality.before.minimum
    assert report.warnings == []
    box = grid_box()
    middles = box.points[box.cells["tetra"]].mean(axis=1)
    solid = fs.Mesh(box.points, box.cells, groups={"LEFT": ("element", 1 + np.nonzero(middles[:, 0] < 3)[0])})
    assert fs.crack(solid, fs.Plane((3, 0, 0), (1, 0, 0))).report.warnings == []


def test_a_wedge_is_still_warned_of_with_an_angle_one_can_read():
    mesh = plate_with_groups(LEFT=lambda m: m[:, 0] < 3)
    for off, tilt, said in ((0.05, 0.03, "at 1.7 degrees"), (0.04, 1e-4, "at less than 0.1 degrees")):
        report = fs.crack(mesh, fs.Plane((3 + off, 3, 0), (1, tilt, 0))).report
        assert report.quality.after.minimum < 0.4
        assert any("border line " + said in w for w in report.warnings), report.warnings


@pytest.mark.parametrize("name", ["plate, second order", "box, second order"])
def test_deform_names_elements_of_the_mesh_where_nodes_are_fixed(name):
    """Elements that were split before are named by what they are parts of."""
    import rounding_cases

    mesh = rounding_cases.SUBJECTS[name][0]()
    ids = np.concatenate(list(mesh.cell_ids.values()))
    middle, spread = mesh.points.mean(axis=0), np.ptp(mesh.points, axis=0)
    random = np.random.default_rng(3)
    refused = 0
    for _ in range(40):
        normal = random.normal(size=3) * (spread > 0)
        plane = fs.Plane(middle + 0.3 * random.uniform(-1, 1, 3) * spread, normal)
        try:
            fs.crack(mesh, plane, method="deform")
        except fs.QualityError as error:
            if "cannot be moved there (elements " not in str(error):
                continue
            named = str(error).split("(elements ")[1].split(")")[0].replace(", ...", "")
            assert named and all(int(n) in ids for n in named.split(", "))
            refused += 1
    assert refused > 0
