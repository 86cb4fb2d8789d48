# SPDX-License-Identifier: LGPL-2.1-or-later
"""Errors say by `parameter` which parameter they are about, of the function or class that was called."""

import pathlib
import pickle

import numpy as np
import pytest

import femscalpel as fs
from meshes import box_with_groups

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
    (crack(transition=21), "transition"),
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
    (cut(width=1, method="deform"), "method"),
    (fillet(along="NOWHERE"), "along"),
    (fillet(along=[1]), "along"),
    (fillet(radius=0), "radius"),
    (fillet(radius=50), "radius"),
    (fillet(method="deform"), "method"),
    (refine(near=np.empty((0, 3))), "near"),
    (refine(near=[(0, 0, float("nan"))]), "near"),
    (refine(size=0), "size"),
    (refine(size=1e-3, max_elements=1), "size"),
    (refine(gradation=-1), "gradation"),
    (refine(reach=-1), "reach"),
    (refine(feature_angle=0), "feature_angle"),
    (refine(skin=SHAPES / "plane.brep"), "skin"),
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
