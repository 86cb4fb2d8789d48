# SPDX-License-Identifier: LGPL-2.1-or-later
import csv
import dataclasses
import io
import inspect
import json
import threading

import numpy as np
import pytest

import femscalpel as fs
from meshes import box_with_groups, grid_box, quadratic, tetra_volumes

PLANE = fs.Plane(origin=(3.3, 2.5, 2), normal=(0.9, 0.3, 0.2))


def snapshot(mesh):
    return (
        mesh.points.tobytes(),
        mesh.node_ids.tobytes(),
        {t: c.tobytes() for t, c in mesh.cells.items()},
        {g.name: g.ids.tobytes() for g in mesh.groups.all()},
    )


@pytest.fixture(scope="module")
def cracked():
    mesh = box_with_groups()
    before = snapshot(mesh)
    result = fs.crack(mesh, PLANE)
    assert snapshot(mesh) == before, "the input mesh was changed"
    return mesh, result


def test_mesh_is_valid_and_keeps_its_volume(cracked):
    mesh, result = cracked
    result.mesh.validate()
    volumes = tetra_volumes(result.mesh.points, result.mesh.cells["tetra"])
    assert volumes.min() > 0
    assert volumes.sum() == pytest.approx(6 * 5 * 4, rel=1e-9)


def test_numbers_and_far_nodes_are_kept(cracked):
    mesh, result = cracked
    index = {n: i for i, n in enumerate(result.mesh.node_ids)}
    assert set(mesh.node_ids) <= set(index)
    moved = [n for i, n in enumerate(mesh.node_ids) if (mesh.points[i] != result.mesh.points[index[n]]).any()]
    assert len(moved) == result.report.nodes_moved
    far = np.abs(PLANE.distance(mesh.points)) > 2.9
    assert far.any() and not set(mesh.node_ids[far]) & set(moved)
    added = set(index) - set(mesh.node_ids)
    assert len(added) == result.report.nodes_added and min(added) > mesh.node_ids.max()


def test_groups_survive_and_lips_are_made(cracked):
    mesh, result = cracked
    assert set(mesh.groups) <= set(result.mesh.groups)
    volumes = dict(zip(result.mesh.cell_ids["tetra"], tetra_volumes(result.mesh.points, result.mesh.cells["tetra"])))
    assert sum(volumes[i] for i in result.mesh.groups["ALL"].ids) == pytest.approx(120, rel=1e-9)
    assert sum(volumes[i] for i in result.mesh.groups["LEFT"].ids) == pytest.approx(60, rel=1e-9)
    assert len(result.mesh.groups["EMPTY"]) == 0
    lips = [set(result.mesh.groups[name].ids) for name in ("CRACK_P", "CRACK_N")]
    assert len(lips[0]) == len(lips[1]) > 0 and not lips[0] & lips[1]
    triangles, ids = result.mesh.cells["triangle"], result.mesh.cell_ids["triangle"]
    areas = []
    for lip in lips:
        corners = result.mesh.points[triangles[np.isin(ids, list(lip))]]
        assert np.abs(PLANE.distance(corners.reshape(-1, 3))).max() < 1e-8
        areas.append(
            np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2
        )
    assert areas[0] == pytest.approx(areas[1], rel=1e-12)


def test_report(cracked):
    mesh, result = cracked
    report = result.report
    assert (report.operation, report.name, report.method) == ("crack", "CRACK", "snap")
    assert report.transition >= 1 and report.max_displacement > 0
    assert report.nodes_added == report.nodes_split + report.nodes_doubled and report.nodes_doubled > 0
    assert {"ICN", "ECN", "ITN", "ETN"} <= set(report.node_sets)
    assert all(ids.dtype == np.int64 for ids in report.node_sets.values())
    assert set(report.node_sets["ICN"]) <= set(result.mesh.node_ids)
    assert report.constraints and all(isinstance(n, int) for n in report.constraints.values())
    after = report.quality.after
    assert 0 < after.minimum <= after.mean <= 1 and after.histogram.sum() == after.count
    assert after.worst[0].mean_ratio == pytest.approx(after.minimum) and len(after.worst) <= 10
    assert after.worst[0].id in result.mesh.cell_ids["tetra"]
    records = {g.name: g for g in report.groups}
    assert records["ALL"].measure_after == pytest.approx(120, rel=1e-9) and records["ALL"].dimension == 3
    assert records["CRACK_P"].status == "new"
    assert records["ALL"].count_after == len(result.mesh.groups["ALL"])
    assert isinstance(report.warnings, list) and sum(report.seconds.values()) >= 0


def test_report_as_text_and_csv(cracked, tmp_path):
    _, result = cracked
    text = result.report.to_text()
    assert str(result.report) == text
    table = text[text.index("\ngroup ") + 1 :].splitlines()
    assert [line.split()[0] for line in table[2:]] == [g.name for g in result.report.groups]
    assert "ICN" in text and "mean ratio" in text
    buffer = io.StringIO()
    result.report.to_csv(buffer)
    rows = list(csv.DictReader(io.StringIO(buffer.getvalue())))
    assert [row["name"] for row in rows] == [g.name for g in result.report.groups]
    assert float(rows[0]["measure_after"]) == result.report.groups[0].measure_after
    path = tmp_path / "groups.csv"
    result.report.to_csv(path)
    assert path.read_text() == buffer.getvalue()


def test_report_as_json(cracked, tmp_path):
    _, result = cracked
    report = result.report
    data = json.loads(report.to_json())
    assert set(data) == {field.name for field in dataclasses.fields(report)} | {"extents"}
    assert data["node_sets"]["ICN"] == report.node_sets["ICN"].tolist() and data["node_sets"]["ICN"]
    assert [g["measure_after"] for g in data["groups"]] == [g.measure_after for g in report.groups]
    assert data["quality"]["after"]["worst"][0]["id"] == report.quality.after.worst[0].id
    assert data["extents"] == [
        {"what": "crack", "group": "CRACK_P", "dimension": 2, "measure": pytest.approx(20 * 0.94**0.5 / 0.9)}
    ]
    assert f"made         crack of area {data['extents'][0]['measure']:.6g}\n" in report.to_text()
    report.to_json(tmp_path / "report.json", node_ids=False)
    short = json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))
    assert short["node_sets"]["ICN"] == len(report.node_sets["ICN"])
    poor = dataclasses.replace(report, max_displacement=float("nan"))
    assert json.loads(poor.to_json())["max_displacement"] is None


def test_extents_of_a_front():
    result = fs.crack(grid_box(), PLANE, within=fs.Disk((3.3, 2.5, 2), 1.6))
    front = [e for e in result.report.extents if e.what == "front"][0]
    mesh = result.mesh
    rows = np.isin(mesh.cell_ids["line"], mesh.groups["CRACK_FRONT", "element"].ids)
    ends = mesh.points[mesh.cells["line"][rows]]
    assert (
        front.measure == pytest.approx(np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).sum()) and front.dimension == 1
    )


def test_extents_of_a_slot_are_walls():
    report = fs.cut(grid_box(), PLANE, width=0.4).report
    assert [e.what for e in report.extents] == ["wall"] and report.operation == "cut"


def test_quadratic():
    mesh = quadratic(grid_box())
    result = fs.crack(mesh, PLANE)
    assert set(result.mesh.cells) == {"tetra10", "triangle6"}
    assert tetra_volumes(result.mesh.points, result.mesh.cells["tetra10"]).min() > 0


def test_session_gives_the_same_and_is_not_reached_by_later_changes():
    mesh = box_with_groups()
    session = fs.Scalpel(mesh)
    mesh.add_group("LATER", "node", mesh.node_ids[:1])
    for origin in (3.3, 2.1):
        plane = fs.Plane((origin, 2.5, 2), (0.9, 0.3, 0.2))
        result, reference = session.crack(plane), fs.crack(box_with_groups(), plane)
        assert snapshot(result.mesh) == snapshot(reference.mesh)
    assert "LATER" not in session.mesh.groups and "LATER" not in result.mesh.groups


def test_band_only_gives_the_elements_near_the_tool():
    mesh = grid_box((12, 12, 12), (6, 5, 4))
    plane = fs.Plane((3.3, 2.5, 2), (0.9, 0.3, 0.2))
    whole, band = fs.crack(mesh, plane), fs.Scalpel(mesh).crack(plane, band_only=True)
    assert len(band.mesh.cells["tetra"]) < 0.8 * len(whole.mesh.cells["tetra"])
    of_whole = dict(zip(whole.mesh.cell_ids["tetra"].tolist(), whole.mesh.node_ids[whole.mesh.cells["tetra"]].tolist()))
    for number, nodes in zip(
        band.mesh.cell_ids["tetra"].tolist(), band.mesh.node_ids[band.mesh.cells["tetra"]].tolist()
    ):
        assert of_whole[number] == nodes
    assert band.mesh.groups["CRACK_P"].ids.tolist() == whole.mesh.groups["CRACK_P"].ids.tolist()
    assert band.report.nodes_added == whole.report.nodes_added
    assert band.report.quality.after.minimum == whole.report.quality.after.minimum


def test_result_outlives_everything():
    points = fs.crack(box_with_groups(), PLANE).mesh.points
    assert np.isfinite(points).all() and points.max() <= 6


def test_other_threads_run_meanwhile():
    mesh = grid_box((30, 30, 30), (6, 5, 4))
    ticks, stop = [0], threading.Event()

    def count():
        while not stop.wait(0.001):
            ticks[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    try:
        before = ticks[0]
        for _ in range(3):
            fs.crack(mesh, PLANE)
        assert ticks[0] > before
    finally:
        stop.set()
        thread.join()


@pytest.mark.parametrize(
    "kwargs, error, message",
    [
        ({"mesh": None}, TypeError, "mesh must be a femscalpel.Mesh"),
        ({"tool": (0, 0, 1)}, TypeError, "tool must be a tool"),
        ({"name": 5}, TypeError, "name must be a string"),
        ({"method": "saw"}, ValueError, "method must be 'snap' or 'deform'"),
        ({"transition": 2.5}, TypeError, "transition must be an integer"),
        ({"transition": 0}, ValueError, "transition must be at least 1"),
        ({"feature_angle": "30"}, TypeError, "feature_angle must be a number"),
        ({"feature_angle": 180}, ValueError, "feature_angle must be between"),
        ({"band_only": 1}, TypeError, "band_only must be True or False"),
        ({"tool": fs.Plane((99, 0, 0), (1, 0, 0))}, fs.ToolError, ""),
        ({"name": "A_NAME_FAR_TOO_LONG_FOR_CODE_ASTER"}, fs.ToolError, "24"),
        ({"name": ""}, fs.ToolError, ""),
    ],
)
def test_bad_arguments(kwargs, error, message):
    arguments = {"mesh": box_with_groups(), "tool": PLANE, **kwargs}
    with pytest.raises(error, match=message):
        fs.crack(**arguments)


def test_taken_name():
    mesh = box_with_groups()
    mesh.add_group("CRACK_P", "element")
    with pytest.raises(fs.ToolError, match="CRACK_P"):
        fs.crack(mesh, PLANE)


def test_a_brick_becomes_tetrahedra():
    points = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]
    result = fs.crack(fs.Mesh(points, {"hexahedron": [range(8)]}), fs.Plane((0.5, 0, 0), (1, 0, 0)))
    assert result.report.converted == {"hexahedron": 1}
    assert "hexahedron 1" in result.report.to_text()
    assert "hexahedron" not in result.mesh.cells and fs.measure(result.mesh)["tetra"].sum() == pytest.approx(1)
    assert any("stiffer" in w for w in result.report.warnings)


def test_all_that_the_package_has_is_named_public():
    own = {n for n, v in vars(fs).items() if str(getattr(v, "__module__", "")).startswith("femscalpel")}
    assert sorted(n for n in own if not n.startswith("_")) == sorted(fs.__all__)


def test_everything_public_is_documented():
    for name in fs.__all__:
        item = getattr(fs, name)
        assert inspect.getdoc(item), name
        if inspect.isfunction(item):
            assert all(
                p.annotation is not inspect.Parameter.empty for p in inspect.signature(item).parameters.values()
            ) or name.endswith("meshio"), name


def test_moved_mid_side_nodes_are_in_the_node_sets():
    mesh = quadratic(grid_box())
    result = fs.crack(mesh, PLANE)
    sets = {name: set(ids) for name, ids in result.report.node_sets.items()}
    assert sum(len(ids) for ids in sets.values()) == len(set().union(*sets.values()))
    place = dict(zip(mesh.node_ids, mesh.points))
    after = dict(zip(result.mesh.node_ids, result.mesh.points))
    moved = {n for n, x in place.items() if (after[n] != x).any()}
    assert moved <= set().union(*sets.values())
    middles = moved - set(mesh.node_ids[np.unique(mesh.cells["tetra10"][:, :4])])
    on_skin = {n for n in middles if any(after[n][k] in (0, (6, 5, 4)[k]) for k in range(3))}
    assert len(middles) > 50 and on_skin == middles & (sets["ECN"] | sets["ETN"])
    on_plane = {n for n in middles if abs(PLANE.distance(after[n])) < 1e-9}
    assert on_plane and on_plane == middles & (sets["ICN"] | sets["ECN"])
    assert result.report.constraints["plane"] == len(sets["ICN"] | sets["ECN"])
    assert result.report.constraints["tangent plane"] == len(sets["ECN"] | sets["ETN"])
    assert result.report.constraints["free"] == len(sets["ITN"])
