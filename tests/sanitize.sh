#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Builds engine and C++ tests under the address and undefined-behaviour sanitizers and runs them: half an hour on two
# cores, so it is not part of .ci/run. Arguments go to CTest; "-E 'quadratic_elbow|StraightSecondOrder'" leaves the
# slowest ones out.
set -eu
cd "$(dirname "$0")/.."
cmake --preset asan
cmake --build --preset asan
ctest --preset asan -j "$(nproc)" "$@"
