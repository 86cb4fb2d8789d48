# SPDX-License-Identifier: LGPL-2.1-or-later
import numpy as np
import pytest

import femscalpel as fs


def test_plane():
    plane = fs.Plane(origin=(1, 2, 3), normal=np.array([0, 0, 5]))
    assert plane.origin == (1.0, 2.0, 3.0) and plane.normal == (0.0, 0.0, 1.0)
    np.testing.assert_allclose(plane.distance([[0, 0, 5], [9, 9, 3], [0, 0, 0]]), [2, 0, -3])
    np.testing.assert_allclose(plane.distance((0, 0, 5)), [2])
    assert isinstance(plane, fs.Tool) and plane.kind == "plane"
    assert "origin=(1.0, 2.0, 3.0)" in repr(plane)


@pytest.mark.parametrize("origin, normal, error, message", [
    ((0, 0, 0), (0, 0, 0), fs.ToolError, "normal"),
    ((0, 0), (0, 0, 1), ValueError, "origin must be three numbers"),
    ("abc", (0, 0, 1), TypeError, "origin must be three numbers"),
    ((0, 0, 0), 1, TypeError, "normal must be three numbers"),
    ((0, 0, float("inf")), (0, 0, 1), ValueError, "origin must be three finite numbers"),
])
def test_bad_plane(origin, normal, error, message):
    with pytest.raises(error, match=message):
        fs.Plane(origin, normal)


def test_errors_have_one_base():
    for error in (fs.ReadError, fs.WriteError, fs.ToolError, fs.QualityError, fs.UnsupportedElementError):
        assert issubclass(error, fs.Error) and error.__module__ == "femscalpel" and error.__doc__
    assert issubclass(fs.Error, RuntimeError)
