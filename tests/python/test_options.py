# SPDX-License-Identifier: LGPL-2.1-or-later
"""The table of options: every operator has every row, with its check and its text."""

import inspect

import femscalpel as fs
import pytest
from femscalpel import _engine
from femscalpel.options import OPTIONS

from meshes import grid_box

OPERATORS = [fs.crack, fs.drill, fs.cut, fs.fillet]
METHODS = [fs.Scalpel.crack, fs.Scalpel.drill, fs.Scalpel.cut, fs.Scalpel.fillet]
PLANE = fs.Plane((3.1, 2, 2), (1, 0.2, 0.1))


@pytest.mark.parametrize("option", OPTIONS, ids=lambda option: option.name)
def test_every_operator_has_it(option):
    assert isinstance(inspect.getattr_static(_engine.Options, option.name), property)
    for operator in OPERATORS + METHODS:
        parameter = inspect.signature(operator).parameters[option.name]
        assert parameter.annotation == option.annotation
        assert option.name == "name" or parameter.default == option.default
    if option.text:
        assert f"\n{option.name} : {option.kind}\n    {option.text.split()[0]}" in fs.crack.__doc__
    assert not [o for o in OPERATORS if "{options}" in o.__doc__]


def test_the_order_of_parameters_stays():
    common = ["name", "method", "transition", "feature_angle", "strict", "preserve"]
    last = ["refine", "skin", "second_order", "before_refining"]
    expected = {
        fs.crack: ["mesh", "tool", *common, "band_only", "within", *last],
        fs.drill: ["mesh", "tools", *common, "depth", "band_only", *last],
        fs.cut: ["mesh", "tool", "width", "other", "bottom", *common, "band_only", *last],
        fs.fillet: ["mesh", "along", "radius", *common, "band_only", *last],
    }
    for operator, method in zip(OPERATORS, METHODS):
        assert list(inspect.signature(operator).parameters) == expected[operator]
        assert list(inspect.signature(method).parameters) == ["self", *expected[operator][1:]]


def test_by_place_and_by_name():
    mesh = grid_box()
    session = fs.Scalpel(mesh)
    by_place = fs.crack(mesh, PLANE, "A", "snap", 3, 40.0, False, (), False, None, False)
    by_name = session.crack(PLANE, name="A", transition=3, feature_angle=40, preserve=(), refine=False)
    assert (by_place.mesh.points == by_name.mesh.points).all()
    assert by_place.report.transition == by_name.report.transition == 3
    assert "A_P" in by_name.mesh.groups


def test_wrong_calls_name_the_operator():
    with pytest.raises(TypeError, match=r"crack\(\) missing a required argument: 'tool'"):
        fs.crack(grid_box())
    with pytest.raises(TypeError, match=r"drill\(\) got an unexpected keyword argument 'metod'"):
        fs.drill(grid_box(), PLANE, metod="snap")


def test_the_engine_gets_what_is_asked_for():
    options = _engine.Options()
    for name, value in dict(name="B", method="deform", transition=4, strict=True, preserve=["G"], refine=0.5).items():
        setattr(options, name, value)
        assert getattr(options, name) == value
    options.refine = 0
    assert options.refine == 0
    options.refine = None
    assert options.refine is None
    assert options.skin is None
    with pytest.raises(fs.ToolError):
        options.method = "saw"
