# SPDX-License-Identifier: LGPL-2.1-or-later
"""Errors say by `parameter` which parameter they are about, of the function or class that was called."""

import pathlib
import pickle

import numpy as np
import pytest

import femscalpel as fs
from meshes import box_with_groups, grid_box

SHAPES = pathlib.Path(__file__).parent / "shapes"
O, X, Z = (0, 0, 0), (1, 0, 0), (0, 0, 1)
MIDDLE = (3.1, 2.5, 2)
PLANE, CYLINDER = fs.Plane(MIDDLE, X), fs.Cylinder(MIDDLE, Z, 1)


class Shape:
    """A FreeCAD shape that cannot be used."""

    def __init__(self, brep):
        self.brep = brep

    def exportBrepToString(self):
        return self.brep


class NoRepr:
    """What somebody else's class may do."""

    def __repr__(self):
        raise RuntimeError("no repr")


def crack(**options):
    return lambda: fs.crack(box_with_groups(), **{"tool": PLANE, **options})


def drill(**options):
    return lambda: fs.drill(box_with_groups(), **{"tools": CYLINDER, **options})


def cut(**options):
    return lambda: fs.cut(box_with_groups(), **{"tool": PLANE, **options})


def fillet(**options):
    return lambda: fs.fillet(box_with_groups(), **{"along": (3.0, 0.0, 0.0), "radius": 0.5, **options})


def refine(**options):
    return lambda: fs.refine(box_with_groups(), **{"near": PLANE, "size": 0.5, **options})


def merge(**options):
    return lambda: fs.merge(box_with_groups(), **{"other": grid_box((1, 1, 1), (1.0, 1.0, 1.0)), **options})


def reshape(**options):
    return lambda: fs.reshape(box_with_groups(), **{"group": "TOP", **options})


def mesh(**arguments):
    return lambda: fs.Mesh(**{"points": [O, X, (0, 1, 0)], "cells": {"triangle": [[0, 1, 2]]}, **arguments})


CROSSED = fs.Polygon([(3.1, 1, 1), (3.1, 2, 2), (3.1, 2, 1), (3.1, 1, 2)])

#: (call, parameter): what the engine says is wrong.
IN_THE_ENGINE = [
    (lambda: fs.Plane(O, O), "normal"),
    (lambda: fs.Cylinder(O, O, 1), "axis"),
    (lambda: fs.Cylinder(O, Z, 0), "radius"),
    (lambda: fs.Sphere(O, -1), "radius"),
    (lambda: fs.Torus(O, O, 2, 1), "axis"),
    (lambda: fs.Torus(O, Z, 0, 1), "major_radius"),
    (lambda: fs.Torus(O, Z, 2, 0), "minor_radius"),
    (lambda: fs.Torus(O, Z, 2, 3), "minor_radius"),
    (lambda: fs.Cone(O, O, 1, 30), "axis"),
    (lambda: fs.Cone(O, Z, 0, 30), "radius"),
    (lambda: fs.Cone(O, Z, 1, 90), "half_angle"),
    (lambda: fs.Face(Shape("no shape")), "source"),
    (lambda: fs.Face("nowhere.step"), "source"),
    (lambda: fs.Face("x" * 5000 + ".step"), "source"),
    (lambda: fs.Shape("nowhere.step"), "source"),
    (lambda: fs.Shape("not\na shape"), "source"),
    (crack(skin="nowhere.step"), "skin"),
    (lambda: fs.Disk(O, 0), "radius"),
    (lambda: fs.Ellipse(O, (0, 1), X), "half_axes"),
    (lambda: fs.Ellipse(O, (1, 0), X), "half_axes"),
    (lambda: fs.Ellipse(O, (1, 2), O), "direction"),
    (lambda: fs.HalfPlane(O, O), "direction"),
    (lambda: fs.Polygon([O, X]), "corners"),
    (lambda: fs.Polygon([O, X, X]), "corners"),
    (lambda: fs.CylinderPart((1, 0)), "along"),
    (lambda: fs.CylinderPart((0, 1), (20, 10), X), "angles"),
    (lambda: fs.CylinderPart((0, 1), (10, 20), O), "zero"),
    (crack(name=""), "name"),
    (crack(name="A B"), "name"),
    (crack(name="A" * 23), "name"),
    (crack(preserve=["NOWHERE"]), "preserve"),
    (crack(skin="not\na shape"), "skin"),
    (crack(skin=SHAPES / "plane.brep"), "skin"),
    (crack(skin=SHAPES / "plane.brep", refine=0.5), "skin"),
    (crack(refine=1e-4), "refine"),
    (crack(within=fs.Disk(O, 1)), "within"),
    (crack(within=CROSSED), "within"),
    (crack(within=fs.Ellipse(MIDDLE, (1, 2), X)), "within"),
    (crack(within=fs.CylinderPart((0, 1))), "within"),
    (crack(tool=CYLINDER, within=fs.Disk(MIDDLE, 1)), "within"),
    (crack(tool=CYLINDER, within=fs.CylinderPart((0, 1), (10, 20), Z)), "within"),
    (crack(method="deform", within=fs.Disk(MIDDLE, 1)), "method"),
    (crack(method="deform", tool=fs.Face(SHAPES / "plane.brep")), "method"),
    (drill(depth=0), "depth"),
    (drill(tools=PLANE, depth=1), "depth"),
    (drill(method="deform", depth=1), "method"),
    (cut(width=0), "width"),
    (cut(tool=fs.Plane((3, 0, 0), X), width=1e-9), "width"),
    (cut(width=1, method="deform"), "method"),
    (fillet(along="NOWHERE"), "along"),
    (fillet(along=[1]), "along"),
    (fillet(radius=0), "radius"),
    (fillet(radius=50), "radius"),
    (fillet(method="deform"), "method"),
    (merge(other=fs.Mesh([(9, 9, 9), (10, 9, 9), (9, 10, 9), (9, 9, 10)], {"tetra": [(0, 1, 2, 3)]})), "other"),
    (merge(name=""), "name"),
    (merge(feature_angle=0), "feature_angle"),
    (refine(near=np.empty((0, 3))), "near"),
    (refine(near=[(0, 0, float("nan"))]), "near"),
    (refine(size=0), "size"),
    (refine(size=1e-3, max_elements=1), "size"),
    (refine(gradation=-1), "gradation"),
    (refine(reach=-1), "reach"),
    (refine(feature_angle=0), "feature_angle"),
    (refine(skin=SHAPES / "plane.brep"), "skin"),
    (reshape(), "onto"),
    (reshape(by=X, onto=PLANE), "by"),
    (reshape(scale=(0, O)), "scale"),
    (reshape(group="NOWHERE", by=Z), "group"),
    (reshape(by=(0, 0, -9)), "by"),
]

#: (call, parameter): what the package says is wrong.
IN_THE_PACKAGE = [
    (lambda: fs.Plane("abc", Z), "origin"),
    (lambda: fs.Plane(O, (0, 0)), "normal"),
    (lambda: fs.Plane((0, 0, float("inf")), Z), "origin"),
    (lambda: fs.Torus(O, Z, "2", 1), "major_radius"),
    (lambda: fs.Cone(O, Z, 1, float("nan")), "half_angle"),
    (lambda: fs.Face(3), "source"),
    (lambda: PLANE.distance([[1, 2]]), "points"),
    (lambda: fs.Ellipse(O, 1, X), "half_axes"),
    (lambda: fs.Polygon(3), "corners"),
    (lambda: fs.Polygon([O, X, 3]), "corners"),
    (lambda: fs.CylinderPart(3), "along"),
    (crack(tool=3), "tool"),
    (crack(name=3), "name"),
    (crack(method="saw"), "method"),
    (crack(transition=0), "transition"),
    (crack(transition=21), "transition"),
    (crack(transition=2**31), "transition"),
    (crack(method=np.array(["snap"])), "method"),
    (crack(method=np.array(["snap", "x"])), "method"),
    (crack(preserve=np.array(2.0)), "preserve"),
    (crack(feature_angle=10**400), "feature_angle"),
    (crack(name="\ud800"), "name"),
    (crack(name="A\0B"), "name"),
    (crack(skin="a\0b.brep"), "skin"),
    (crack(tool=NoRepr()), "tool"),
    (cut(width=1, other=PLANE), "other"),
    (refine(max_elements=2**63), "max_elements"),
    (refine(near=[["1", "2", "3"]]), "near"),
    (lambda: fs.Cylinder(O, Z, 10**400), "radius"),
    (lambda: fs.Plane((10**400, 0, 0), Z), "origin"),
    (lambda: fs.Plane("123", Z), "origin"),
    (lambda: fs.Plane(O, b"abc"), "normal"),
    (lambda: fs.Plane({3, 1, 2}, Z), "origin"),
    (lambda: fs.Plane({0: 1, 1: 2, 2: 3}, Z), "origin"),
    (lambda: fs.Plane(O, [True, False, False]), "normal"),
    (lambda: fs.Plane(["1", "2", "3"], Z), "origin"),
    (lambda: fs.Ellipse(O, {1, 2}, X), "half_axes"),
    (lambda: fs.Shape(5), "source"),
    (lambda: fs.Face("a\0b.step"), "source"),
    (lambda: fs.read("a\0.inp"), "path"),
    (lambda: fs.write(box_with_groups(), "\ud800.inp"), "path"),
    (mesh(points=[["0", "0", "0"]] * 3), "points"),
    (mesh(groups={"A\0B": ("node", [1])}), "groups"),
    (mesh(groups={"A": (np.array(["node", "x"]), [1])}), "groups"),
    (crack(feature_angle=0), "feature_angle"),
    (crack(strict=1), "strict"),
    (crack(preserve="LEFT"), "preserve"),
    (crack(preserve=[3]), "preserve"),
    (crack(band_only=1), "band_only"),
    (crack(refine=True), "refine"),
    (crack(refine=-1.0), "refine"),
    (crack(skin=5), "skin"),
    (crack(within=5), "within"),
    (drill(tools=5), "tools"),
    (fillet(along=5), "along"),
    (fillet(radius="wide"), "radius"),
    (drill(tools=[]), "tools"),
    (drill(tools=[CYLINDER, 5]), "tools"),
    (drill(depth="deep"), "depth"),
    (cut(width="wide"), "width"),
    (cut(tool=CYLINDER, width=1), "tool"),
    (cut(other=5), "other"),
    (cut(width=1, bottom=5), "bottom"),
    (refine(near=5), "near"),
    (refine(near=[PLANE, 5]), "near"),
    (refine(relax=1), "relax"),
    (refine(max_elements=0), "max_elements"),
    (lambda: fs.crack(5, PLANE), "mesh"),
    (lambda: fs.read(5), "path"),
    (mesh(points=[[0, 0]]), "points"),
    (mesh(node_ids=[1]), "node_ids"),
    (mesh(cells=5), "cells"),
    (mesh(cells={"triangle": [[0.5, 1, 2]]}), "cells"),
    (mesh(cell_ids={}), "cell_ids"),
    (mesh(groups=[5]), "groups"),
    (mesh(groups={"A": ("edge", [1])}), "groups"),
    (mesh(groups={"A": ("node", [0.5])}), "groups"),
]

#: Calls whose errors are about no parameter, or about several.
OTHERS = [
    crack(tool=fs.Plane((99, 0, 0), X)),
    drill(tools=fs.Sphere((99, 0, 0), 1)),
    cut(),
    lambda: fs.CylinderPart((0, 1), (10, 20)),
    lambda: fs.read("nowhere.med"),
    lambda: fs.Plane(),
]


def error_of(call, kinds):
    with pytest.raises(kinds) as caught:
        call()
    return caught.value


@pytest.mark.parametrize("call, parameter", IN_THE_ENGINE)
def test_errors_of_the_engine(call, parameter):
    error = error_of(call, fs.Error)
    assert error.parameter == parameter, error


@pytest.mark.parametrize("call, parameter", IN_THE_PACKAGE)
def test_errors_of_the_package(call, parameter):
    error = error_of(call, (TypeError, ValueError))
    assert error.parameter == parameter, error


@pytest.mark.parametrize("call", OTHERS)
def test_errors_about_no_single_parameter(call):
    assert getattr(error_of(call, (fs.Error, TypeError, ValueError)), "parameter", None) is None


def test_numbers_of_any_kind_are_taken():
    from fractions import Fraction

    plane = fs.Plane(np.array([1, 2, 3], np.float32), (Fraction(1, 2), np.int64(0), 0))
    assert plane.origin == (1, 2, 3) and plane.normal == (1, 0, 0)
    assert fs.Sphere(O, Fraction(1, 2)).radius == 0.5


def test_what_the_messages_call_things():
    assert "preserve[0] must be the name of a group, not 3 (int)" in str(error_of(crack(preserve=[3]), TypeError))
    assert "low" not in str(error_of(lambda: fs.CylinderPart((1, 0)), fs.ToolError))
    assert "NoRepr object" in str(error_of(crack(tool=NoRepr()), TypeError))
    text = str(error_of(crack(refine=1e-9), fs.ToolError))
    assert "`refine` a larger length" in text and "gradation" not in text and "max_elements" not in text
    text = str(error_of(refine(size=1e-3, max_elements=1), fs.ToolError))
    assert "Choose a larger size or gradation, or a larger max_elements" in text


def test_a_message_may_quote_any_encoding(tmp_path):
    path = tmp_path / "latin.inp"
    path.write_bytes(b"*NODE\n1, 0, 0, 0\n*ELEMENT, TYPE=\xe9\n1, 1\n")
    assert "latin.inp:3" in str(error_of(lambda: fs.read(path), fs.ReadError))


def test_a_name_that_is_taken():
    cracked = fs.crack(box_with_groups(), PLANE).mesh
    assert error_of(lambda: fs.crack(cracked, fs.Plane((5.1, 0, 0), X)), fs.ToolError).parameter == "name"


def test_the_parameter_is_kept_with_a_copy():
    for call in (lambda: fs.Plane(O, O), lambda: fs.Plane(O, 5)):
        error = error_of(call, (fs.ToolError, TypeError))
        copy = pickle.loads(pickle.dumps(error))
        assert (type(copy), str(copy), copy.parameter) == (type(error), str(error), "normal")


def test_errors_that_users_make_are_about_no_parameter():
    assert fs.ToolError("so").parameter is None and str(fs.ToolError("so")) == "so"
