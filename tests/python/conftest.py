# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tests that come to run a solver that is not installed are skipped, with that as the reason."""

import pytest

SOLVERS = {"ccx": "CalculiX (ccx) is not installed"}


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_call(item):
    outcome = yield
    error = outcome.excinfo[1] if outcome.excinfo else None
    if isinstance(error, FileNotFoundError) and error.filename in SOLVERS:
        outcome.force_exception(pytest.skip.Exception(SOLVERS[error.filename]))
