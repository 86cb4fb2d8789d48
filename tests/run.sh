#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Installs what is missing (Debian), builds the release preset, runs all tests but those labelled long. Arguments go
# to CTest.
set -eu
cd "$(dirname "$0")/.."
sh resources/setup.sh build demo test
cmake --preset release
cmake --build --preset release
rm -f build/release/tests_passed_at
# One more than cores: the window tests wait much.
ctest --preset release -j "$(($(nproc) + 1))" -LE long "$@"
# For resources/packaging/release.py: of which commit all of them passed.
if [ $# = 0 ] && [ -z "$(git status --porcelain 2>/dev/null || echo none)" ]; then
    git rev-parse HEAD >build/release/tests_passed_at
fi
