# SPDX-License-Identifier: LGPL-2.1-or-later
import inspect
from pathlib import Path

import numpy as np
import pytest

import femscalpel as fs
from meshes import box_with_groups


def test_plane():
    plane = fs.Plane(origin=(1, 2, 3), normal=np.array([0, 0, 5]))
    assert plane.origin == (1.0, 2.0, 3.0) and plane.normal == (0.0, 0.0, 1.0)
    np.testing.assert_allclose(plane.distance([[0, 0, 5], [9, 9, 3], [0, 0, 0]]), [2, 0, -3])
    np.testing.assert_allclose(plane.distance((0, 0, 5)), [2])
    assert isinstance(plane, fs.Tool) and plane.kind == "plane"
    assert "origin=(1.0, 2.0, 3.0)" in repr(plane)


@pytest.mark.parametrize(
    "origin, normal, error, message",
    [
        ((0, 0, 0), (0, 0, 0), fs.ToolError, "normal"),
        ((0, 0), (0, 0, 1), ValueError, "origin must be three numbers"),
        ("abc", (0, 0, 1), TypeError, "origin must be three numbers"),
        ((0, 0, 0), 1, TypeError, "normal must be three numbers"),
        ((0, 0, float("inf")), (0, 0, 1), ValueError, "origin must be three finite numbers"),
    ],
)
def test_bad_plane(origin, normal, error, message):
    with pytest.raises(error, match=message):
        fs.Plane(origin, normal)


def test_cylinder():
    cylinder = fs.Cylinder(origin=(1, 2, 3), axis=(0, 0, 5), radius=2)
    assert cylinder.origin == (1.0, 2.0, 3.0) and cylinder.axis == (0.0, 0.0, 1.0) and cylinder.radius == 2.0
    np.testing.assert_allclose(cylinder.distance([[1, 2, 9], [4, 2, -7], [1, 1, 0]]), [-2, 1, -1])
    assert isinstance(cylinder, fs.Tool) and cylinder.kind == "cylinder" and cylinder.feature_size == 2.0
    assert "radius=2.0" in repr(cylinder)


@pytest.mark.parametrize(
    "arguments, error, message",
    [
        (((0, 0, 0), (0, 0, 0), 1), fs.ToolError, "cylinder: axis is the zero vector"),
        (((0, 0, 0), (0, 0, 1), 0), fs.ToolError, "cylinder: radius is 0; it must be positive"),
        (((0, 0, 0), (0, 0, 1), -2), fs.ToolError, "cylinder: radius is -2"),
        (((0, 0, 0), (0, 0, 1), float("nan")), ValueError, "radius must be a finite number"),
        (((0, 0, 0), (0, 0, 1), "1"), TypeError, "radius must be a number"),
        (((0, 0), (0, 0, 1), 1), ValueError, "origin must be three numbers"),
    ],
)
def test_bad_cylinder(arguments, error, message):
    with pytest.raises(error, match=message):
        fs.Cylinder(*arguments)


def test_sphere_torus_cone():
    sphere = fs.Sphere((1, 2, 3), 2)
    assert (
        sphere.center == (1.0, 2.0, 3.0)
        and sphere.kind == "sphere"
        and sphere.feature_size == 2
        and "radius=2.0" in repr(sphere)
    )
    np.testing.assert_allclose(sphere.distance([[1, 2, 3], [1, 2, 8]]), [-2, 3])
    torus = fs.Torus(center=(0, 0, 0), axis=(0, 0, 2), major_radius=5, minor_radius=2)
    assert (
        torus.axis == (0.0, 0.0, 1.0)
        and torus.kind == "torus"
        and torus.feature_size == 2
        and "minor_radius=2.0" in repr(torus)
    )
    np.testing.assert_allclose(torus.distance([[5, 0, 0], [0, 5, 3]]), [-2, 1])
    cone = fs.Cone(origin=(0, 0, 0), axis=(0, 0, 1), radius=1, half_angle=45)
    np.testing.assert_allclose(cone.apex, (0, 0, -1), atol=1e-12)
    assert cone.kind == "cone" and "half_angle=45.0" in repr(cone)
    np.testing.assert_allclose(cone.distance([[0, 0, 0], [3, 0, 2], [0, 0, -3]]), [-np.sqrt(0.5), 0, 2], atol=1e-12)


@pytest.mark.parametrize(
    "make, error, message",
    [
        (lambda: fs.Sphere((0, 0, 0), 0), fs.ToolError, "sphere: radius is 0"),
        (lambda: fs.Sphere((0, 0), 1), ValueError, "center must be three numbers"),
        (lambda: fs.Torus((0, 0, 0), (0, 0, 0), 2, 1), fs.ToolError, "torus: axis is the zero vector"),
        (
            lambda: fs.Torus((0, 0, 0), (0, 0, 1), 1, 2),
            fs.ToolError,
            "minor_radius is 2; it must be smaller than major_radius, 1",
        ),
        (lambda: fs.Torus((0, 0, 0), (0, 0, 1), 1, float("nan")), ValueError, "minor_radius must be a finite number"),
        (lambda: fs.Cone((0, 0, 0), (0, 0, 1), 1, 90), fs.ToolError, "cone: half_angle is 90"),
        (lambda: fs.Cone((0, 0, 0), (0, 0, 1), -1, 30), fs.ToolError, "cone: radius is -1"),
        (lambda: fs.Cone((0, 0, 0), (0, 0, 1), 1, "30"), TypeError, "half_angle must be a number"),
    ],
)
def test_bad_sphere_torus_cone(make, error, message):
    with pytest.raises(error, match=message):
        make()


SHAPES = Path(__file__).parent / "shapes"


class Shape:
    """What Face needs of a FreeCAD shape."""

    def exportBrepToString(self):
        return (SHAPES / "plane.brep").read_text()


@pytest.mark.parametrize("source", [SHAPES / "plane.brep", str(SHAPES / "plane.step"), Shape()])
def test_face(source):
    """A square of side 20 in the plane x = 3.3."""
    face = fs.Face(source)
    assert (
        face.kind == "face" and face.face_count == 1 and np.isinf(face.feature_size) and repr(face).startswith("Face(")
    )
    np.testing.assert_allclose(np.abs(face.distance([[3.3, 1, 1], [5, 2, 2], [0, 0, 0]])), [0, 1.7, 3.3], atol=1e-12)
    box = box_with_groups()
    by_face, by_plane = fs.crack(box, face), fs.crack(box, fs.Plane((3.3, 0, 0), (1, 0, 0)))
    assert by_face.report.nodes_doubled == by_plane.report.nodes_doubled > 0
    assert fs.measure(by_face.mesh)["tetra"].sum() == pytest.approx(120, rel=1e-12)


def test_bad_face(tmp_path):
    with pytest.raises(fs.ReadError, match="nowhere.step"):
        fs.Face(tmp_path / "nowhere.step")
    with pytest.raises(TypeError, match="source must be a path or a FreeCAD shape"):
        fs.Face(3)


TOOLS = {
    "Plane": ((1, 2, 3), (0, 0, 1)),
    "Cylinder": ((1, 2, 3), (0, 0, 1), 2.0),
    "Sphere": ((1, 2, 3), 2.0),
    "Torus": ((1, 2, 3), (0, 0, 1), 3.0, 2.0),
    "Cone": ((1, 2, 3), (0, 0, 1), 3.0, 20.0),
    "Face": (SHAPES / "plane.brep",),
}


@pytest.mark.parametrize("name, kind", fs.tools.TOOLS.items())
def test_table_of_tools(name, kind):
    """The constructor, the attributes, repr() and the documentation say the same parameters."""
    tool, values = getattr(fs, name), TOOLS[name]
    names = [p.name for p in kind.parameters]
    assert kind.tool is tool and sorted(fs.tools.__all__) == sorted(["Tool", *fs.tools.TOOLS])
    assert issubclass(tool, fs.Tool) and callable(tool.distance)
    assert list(inspect.signature(tool).parameters) == names
    given = dict(zip(names, values))
    for made in (tool(*values), tool(**given), kind.build(lambda p: given[p.name])):
        if name != "Face":
            assert repr(made) == f"{name}({', '.join(f'{n}={floats(v)}' for n, v in given.items())})"
            assert [getattr(made, n) for n in names] == [floats(v) for v in values]
    for p in kind.parameters:
        assert f"\n{p.name} : {p.kind.text}\n    {p.text[:20]}" in tool.__doc__
        assert name == "Face" or getattr(tool, p.name).__doc__ == (p.value or p.text)
    assert "\nRaises\n------\n" in tool.__doc__ and "ToolError\n    " in tool.__doc__
    with pytest.raises(TypeError, match=f"missing .* argument: '{names[-1]}'"):
        tool(*values[:-1])
    with pytest.raises(TypeError, match="got an unexpected keyword argument 'size'"):
        tool(*values, size=1)


def floats(value):
    return tuple(map(float, value)) if isinstance(value, tuple) else value


def test_errors_have_one_base():
    for error in (fs.ReadError, fs.WriteError, fs.ToolError, fs.QualityError, fs.UnsupportedElementError):
        assert issubclass(error, fs.Error) and error.__module__ == "femscalpel" and error.__doc__
    assert issubclass(fs.Error, RuntimeError)
