# SPDX-License-Identifier: LGPL-2.1-or-later
import os
import signal
import threading
import time

import numpy as np
import pytest

import femscalpel as fs
from meshes import grid_box

PLANE = fs.Plane((20.3, 20, 20), (0.9, 0.3, 0.2))


@pytest.fixture(scope="module")
def large():
    """505 000 tetrahedra in two halves."""
    plain = grid_box((44, 44, 44), (40.0, 40.0, 40.0))
    half = plain.cell_ids["tetra"][plain.points[plain.cells["tetra"]].mean(axis=1)[:, 1] < 20]
    return fs.Mesh(plain.points, plain.cells, groups={"LEFT": ("element", half), "ALL": ("node", plain.node_ids)})


@pytest.fixture(scope="module")
def packed(large, tmp_path_factory):
    path = tmp_path_factory.mktemp("cancel") / "large.inp.gz"
    fs.write(large, path)
    return path


def interrupt(operation):
    """Presses Ctrl-C twice while `operation` runs, and says whether that ended it.

    Python runs a handler between its own instructions, too, as soon as the engine has returned. So the first one does
    nothing: an engine that does not look at signals would come to its end before the second.
    """
    handled, stop, ended = threading.Event(), threading.Event(), False

    def handler(number, frame):
        if handled.is_set():
            raise KeyboardInterrupt
        handled.set()

    def press():
        time.sleep(0.02)
        os.kill(os.getpid(), signal.SIGINT)
        handled.wait()
        time.sleep(0.01)
        if not stop.is_set():
            os.kill(os.getpid(), signal.SIGINT)

    before = signal.signal(signal.SIGINT, handler)
    thread = threading.Thread(target=press)
    thread.start()
    try:
        try:
            operation()
            ended = True
            stop.set()
            handled.wait()
            time.sleep(0.05)
        except KeyboardInterrupt:
            pass
        thread.join()
    finally:
        signal.signal(signal.SIGINT, before)
    return not ended


@pytest.mark.parametrize(
    "operation",
    [
        lambda mesh: fs.crack(mesh, PLANE, transition=8),
        lambda mesh: fs.crack(mesh, PLANE, method="deform"),
        lambda mesh: fs.drill(mesh, fs.Cylinder((20, 20, 0), (0.1, 0.2, 1), 12), transition=8),
        lambda mesh: fs.cut(mesh, PLANE, 3.3, transition=8),
        lambda mesh: fs.refine(mesh, PLANE, 0.4),
        lambda mesh: fs.virtual_boundary(mesh, "ALL"),
    ],
    ids=["crack", "deform", "drill", "cut", "refine", "virtual_boundary"],
)
def test_ctrl_c(large, operation):
    assert interrupt(lambda: operation(large))


def test_ctrl_c_in_files(large, packed, tmp_path):
    assert interrupt(lambda: fs.read(packed))
    path = tmp_path / "mesh.inp.gz"
    path.write_text("old")
    assert interrupt(lambda: fs.write(large, path))
    assert path.read_text() == "old" and list(tmp_path.iterdir()) == [path]


def test_handlers_that_raise_other_errors_are_heard(large):
    class Hurry(Exception):
        pass

    def handler(number, frame):
        raise Hurry

    before = signal.signal(signal.SIGALRM, handler)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.02)
        with pytest.raises(Hurry):
            fs.refine(large, PLANE, 0.4)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_a_token_ends_what_runs_in_it(large):
    token = fs.CancelToken()
    timer = threading.Timer(0.05, token.cancel)
    timer.start()
    with pytest.raises(fs.Cancelled):
        with token:
            while True:
                fs.mean_ratio(large)
    timer.join()
    assert token.cancelled
    assert fs.mean_ratio(large)["tetra"].min() > 0  # outside of it nothing ends
    with pytest.raises(fs.Cancelled), token:
        fs.crack(large, PLANE)


def test_a_token_works_for_its_own_thread_only():
    mesh, token, failed = grid_box(), fs.CancelToken(), []

    def elsewhere():
        try:
            fs.measure(mesh)
        except fs.Error as error:
            failed.append(error)

    with token:
        token.cancel()
        thread = threading.Thread(target=elsewhere)
        thread.start()
        thread.join()
        with pytest.raises(fs.Cancelled):
            fs.crack(mesh, fs.Plane((3.1, 0, 0), (1, 0.1, 0)))
    assert not failed


def test_a_session_stays_as_it_was():
    mesh = grid_box((20, 20, 20), (20.0, 20.0, 20.0))
    scalpel, plane, token = fs.Scalpel(mesh), fs.Plane((10.3, 10, 10), (0.9, 0.3, 0.2)), fs.CancelToken()
    expected = scalpel.crack(plane).mesh
    threading.Timer(0.01, token.cancel).start()
    with pytest.raises(fs.Cancelled), token:
        while True:
            scalpel.crack(plane)
    again = scalpel.crack(plane).mesh
    np.testing.assert_array_equal(again.points, expected.points)
    np.testing.assert_array_equal(again.cells["tetra"], expected.cells["tetra"])


def test_tokens_are_left_in_order():
    first, second = fs.CancelToken(), fs.CancelToken()
    first.__enter__()
    second.__enter__()
    with pytest.raises(fs.Error, match="order"):
        first.__exit__(None, None, None)
    second.__exit__(None, None, None)
    first.__exit__(None, None, None)
