# SPDX-License-Identifier: LGPL-2.1-or-later
"""Results are what they were when tests/bench/digest.txt was recorded, to the last bit: hundreds of operations.

A change that is meant to change results is recorded anew, and the difference of digest.txt shows how far it reaches:

    PYTHONPATH=build/release/Mod/FemScalpel /usr/bin/python3 tests/bench/digest.py --record

The last bit of floating-point numbers may depend on the compiler, its options, the processor (whether it multiplies and
adds in one step, for which the C library has functions of its own) and the versions of libraries. Where these are not
what digest.txt was made with, nothing can be compared, and the test is skipped, never failed; so it is, once all others
are found the same, when a mesh is another because another Gmsh made it, or a package with input files is missing.
"""

import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "bench"))

import digest  # noqa: E402

RECORD = "if that is meant, record anew: PYTHONPATH=build/release/Mod/FemScalpel python3 tests/bench/digest.py --record"


def test_results_are_what_they_were():
    names, text = list(digest.by_name()), digest.RECORDED.read_text()
    elsewhere = digest.compared({}, text, []).machine
    if elsewhere:
        pytest.skip("digest.txt was recorded with something else, so last bits may differ: " + "; ".join(elsewhere))
    comparison = digest.compared(digest.run(), text, names)
    left_out, comparison.left_out = comparison.left_out, {}
    lines = digest.told(comparison)
    if lines:
        pytest.fail(f"{len(comparison.changed)} operations differ; {RECORD}\n" + "\n".join(lines), pytrace=False)
    if left_out:
        pytest.skip(
            f"all agree but {len(left_out)} operations, which were left out as their input files are others or "
            f"missing: {', '.join(sorted(set(left_out.values())))}"
        )
