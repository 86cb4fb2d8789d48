# SPDX-License-Identifier: LGPL-2.1-or-later
import numpy as np
import pytest

import femscalpel as fs
from meshes import box_with_groups, grid_box, quadratic, tetra_volumes

HOLE = fs.Cylinder(origin=(2.9, 2.6, 0), axis=(0, 0, 1), radius=1.4)


def wall_points(result, group):
    triangles, ids = result.mesh.cells["triangle"], result.mesh.cell_ids["triangle"]
    return result.mesh.points[triangles[np.isin(ids, result.mesh.groups[group].ids)]]


@pytest.fixture(scope="module")
def drilled():
    mesh = box_with_groups()
    return mesh, fs.drill(mesh, HOLE)


def test_hole(drilled):
    mesh, result = drilled
    result.mesh.validate()
    volumes = tetra_volumes(result.mesh.points, result.mesh.cells["tetra"])
    assert volumes.min() > 0
    corners = wall_points(result, "HOLE_WALL")
    assert np.abs(HOLE.distance(corners.reshape(-1, 3))).max() < 1e-9
    # Normals point out of the material, into the hole.
    outward = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (np.einsum("ij,ij->i", outward[:, :2], corners.mean(axis=1)[:, :2] - HOLE.origin[:2]) < 0).all()
    # What is gone is what the wall encloses: the prism over the wall's polygon.
    removed = 6 * 5 * 4 - volumes.sum()
    enclosed = -np.einsum("ij,ij->i", outward[:, :2], corners.mean(axis=1)[:, :2] - HOLE.origin[:2]).sum() / 4
    assert removed == pytest.approx(enclosed, rel=1e-9)
    assert 0.8 < removed / (np.pi * HOLE.radius**2 * 4) < 1


def test_groups_and_report(drilled):
    mesh, result = drilled
    report = result.report
    assert set(mesh.groups) <= set(result.mesh.groups)
    assert report.operation == "drill" and report.elements_removed > 0 and report.nodes_removed > 0
    assert set(report.node_sets) == {"IHN", "EHN", "ITN", "ETN"}
    assert report.constraints["cylinder"] == len(report.node_sets["IHN"]) + len(report.node_sets["EHN"])
    volumes = dict(zip(result.mesh.cell_ids["tetra"], tetra_volumes(result.mesh.points, result.mesh.cells["tetra"])))
    assert sum(volumes[i] for i in result.mesh.groups["ALL"].ids) == pytest.approx(sum(volumes.values()), rel=1e-12)
    assert len(mesh.node_ids) + report.nodes_added - report.nodes_removed == len(result.mesh.node_ids)


def test_groups_that_lose_members_are_reported():
    mesh = box_with_groups()
    inside = np.linalg.norm(mesh.points[:, :2] - HOLE.origin[:2], axis=1) < 0.9
    numbers = {
        "GONE": mesh.node_ids[inside],
        "FEWER": mesh.node_ids[mesh.points[:, 2] == 4],
        "FAR": mesh.node_ids[mesh.points[:, 0] == 6],
    }
    for name, ids in numbers.items():
        mesh.add_group(name, "node", ids)
    result = fs.drill(mesh, HOLE)
    status = {(g.name, g.kind): g.status for g in result.report.groups}
    assert (
        status["GONE", "node"] == "became empty"
        and status["FEWER", "node"] == "reduced"
        and status["FAR", "node"] == "untouched"
    )
    # Nodes born at the hole may make up in number for those that are gone; still it lost some.
    after = set(result.mesh.groups["FEWER"].ids.tolist())
    assert not set(numbers["FEWER"].tolist()) <= after and after
    assert status["LEFT", "element"] == "reduced" and status["EMPTY", "node"] in ("kept", "untouched")
    assert [w for w in result.report.warnings if "'GONE'" in w and "stays, empty" in w]
    assert not [w for w in result.report.warnings if "'FEWER'" in w or "'EMPTY'" in w]
    assert "became empty" in result.report.to_text() and "reduced" in result.report.to_text()
    # A crack takes nothing away.
    assert not {g.status for g in fs.crack(mesh, fs.Plane((2.9, 0, 0), (1, 0.2, 0))).report.groups} & {
        "reduced",
        "became empty",
    }


def test_blind_hole_has_a_flat_bottom():
    mesh = grid_box((12, 10, 8), (6, 5, 4))
    drill = fs.Cylinder(origin=(2.9, 2.6, 4), axis=(0, 0, -1), radius=1.4)
    result = fs.drill(mesh, drill, name="BLIND", depth=2.2)
    bottom = wall_points(result, "BLIND_BOTTOM")
    assert np.abs(bottom[..., 2] - 1.8).max() < 1e-9 and np.abs(drill.distance(bottom.reshape(-1, 3))).min() < 1e-9
    assert drill.distance(bottom.reshape(-1, 3)).max() < 1e-9
    wall = wall_points(result, "BLIND_WALL")
    assert np.abs(drill.distance(wall.reshape(-1, 3))).max() < 1e-9 and wall[..., 2].min() == pytest.approx(
        1.8, abs=1e-9
    )
    area = np.linalg.norm(np.cross(bottom[:, 1] - bottom[:, 0], bottom[:, 2] - bottom[:, 0]), axis=1).sum() / 2
    removed = 120 - tetra_volumes(result.mesh.points, result.mesh.cells["tetra"]).sum()
    assert 0.9 < area / (np.pi * 1.4**2) < 1 and 0.9 < removed / (2.2 * np.pi * 1.4**2) < 1


def test_several_holes():
    mesh = grid_box((12, 10, 8), (6, 5, 4))
    result = fs.drill(mesh, [fs.Cylinder((1.6, 2.6, 0), (0, 0, 1), 1), fs.Cylinder((4.4, 2.6, 0), (0, 0, 1), 1)])
    one, two, both = (len(result.mesh.groups[name]) for name in ("HOLE_WALL1", "HOLE_WALL2", "HOLE_WALL"))
    assert one > 0 and two > 0 and one + two == both


def test_quadratic_hole_is_round():
    result = fs.drill(quadratic(grid_box((12, 10, 8), (6, 5, 4))), HOLE)
    triangles, ids = result.mesh.cells["triangle6"], result.mesh.cell_ids["triangle6"]
    nodes = result.mesh.points[triangles[np.isin(ids, result.mesh.groups["HOLE_WALL"].ids)]].reshape(-1, 3)
    assert np.abs(HOLE.distance(nodes)).max() < 1e-9


def test_session_gives_the_same():
    mesh = box_with_groups()
    a, b = fs.Scalpel(mesh).drill(HOLE).mesh, fs.drill(mesh, HOLE).mesh
    assert a.points.tobytes() == b.points.tobytes() and a.cells["tetra"].tobytes() == b.cells["tetra"].tobytes()


@pytest.mark.parametrize(
    "kwargs, error, message",
    [
        ({"tools": 5}, TypeError, "tools must be a tool"),
        ({"tools": [HOLE, 5]}, TypeError, r"tools\[1\] must be a tool"),
        ({"tools": []}, ValueError, "tools is empty"),
        ({"depth": "2"}, TypeError, "depth must be a number"),
        ({"depth": -2}, fs.ToolError, "depth is -2; it must be positive"),
        ({"depth": 2, "tools": fs.Plane((3, 0, 0), (1, 0, 0))}, fs.ToolError, "depth is for cylinders"),
        (
            {"tools": fs.Cylinder((0, 0, 0), (0, 0, 1), 99)},
            fs.ToolError,
            "would remove the whole mesh: all of it lies inside",
        ),
        (
            {"tools": [fs.Cylinder((1.5, 2.5, 0), (0, 0, 1), 3.5), fs.Cylinder((4.5, 2.5, 0), (0, 0, 1), 3.5)]},
            fs.ToolError,
            "would remove the whole mesh",
        ),
        ({"tools": fs.Cylinder((3, 2.5, 0), (0, 0, 1), 9), "depth": 9}, fs.ToolError, "would remove the whole mesh"),
        (
            {"tools": fs.Cylinder((3, 2.5, -5), (0, 0, 1), 1), "depth": 2},
            fs.ToolError,
            "Move that part into the material",
        ),
        ({"tools": fs.Cylinder((-1, 2.5, 0), (0, 0, 1), 1)}, fs.ToolError, "removes nothing"),
        ({"tools": fs.Cylinder((50, 0, 0), (0, 0, 1), 1)}, fs.ToolError, "misses"),
        ({"name": "A_NAME_FAR_TOO_LONG_FOR_CODE_ASTER"}, fs.ToolError, "24"),
    ],
)
def test_bad_arguments(kwargs, error, message):
    with pytest.raises(error, match=message):
        fs.drill(**{"mesh": box_with_groups(), "tools": HOLE, **kwargs})


def test_a_hole_deeper_than_the_part_goes_through():
    mesh, hole = box_with_groups(), fs.Cylinder((3.1, 2.4, 0), (0, 0, 1), 1.2)
    through, deep = fs.drill(mesh, hole), fs.drill(mesh, hole, depth=9)
    assert deep.mesh.points.tobytes() == through.mesh.points.tobytes() and "HOLE_BOTTOM" not in deep.mesh.groups
    assert any("BOTTOM (plane) lies beyond the part" in w for w in deep.report.warnings)


def test_a_tool_that_takes_a_whole_group_says_which():
    result = fs.drill(box_with_groups(), fs.Cylinder((0, 2.5, 0), (0, 0, 1), 4))
    left, right = (next(g for g in result.report.groups if g.name == name) for name in ("LEFT", "RIGHT"))
    assert (
        left.status == "became empty" and left.count_after == 0 and left.measure_after == 0 < right.measure_after < 60
    )
    assert any("group 'LEFT' loses all its 360 members" in w for w in result.report.warnings)
    assert len(result.mesh.groups["LEFT"].ids) == 0


@pytest.mark.parametrize("radius", [0.6, 1.0])
@pytest.mark.parametrize("place", ["skin", "border from the left", "border from the right"])
def test_tangent_tools(radius, place):
    """Tangent to the skin or to the border of a group: nothing of the neighbour goes, the border stays, and there is a
    warning."""
    x = {"skin": radius, "border from the left": 3 - radius, "border from the right": 3 + radius}[place]
    result = fs.drill(box_with_groups(), fs.Cylinder((x, 2.5, 0), (0, 0, 1), radius))
    result.mesh.validate()
    assert result.report.quality.after.minimum > 0.3
    assert tetra_volumes(result.mesh.points, result.mesh.cells["tetra"]).min() > 0
    assert any("at less than 0.1 degrees" in w for w in result.report.warnings)
    measure = {g.name: g.measure_after for g in result.report.groups}
    assert measure["LEFT" if x > 3 else "RIGHT"] == pytest.approx(60, rel=1e-12)
    assert measure["RIGHT" if x > 3 else "LEFT"] == pytest.approx(
        60 - 4 * np.pi * radius**2, abs=0.12 * np.pi * radius**2
    )  # chords: 3 %


@pytest.mark.parametrize("gap", [1e-7, 0.01])
def test_a_wall_left_too_thin(gap):
    """A layer thinner than elements can be is a good mesh or an error that says so."""
    try:
        result = fs.drill(box_with_groups(), fs.Cylinder((1 + gap, 2.5, 0), (0, 0, 1), 1))
    except (fs.ToolError, fs.QualityError) as error:
        assert "only a thin layer of material" in str(error)
    else:
        assert tetra_volumes(result.mesh.points, result.mesh.cells["tetra"]).min() > 0 and result.report.warnings
