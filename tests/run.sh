#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# All tests: installs what is missing (Debian 12), builds the release preset, runs CTest. Arguments go to CTest.
set -eu
cd "$(dirname "$0")/.."
sh resources/setup.sh
cmake --preset release
cmake --build --preset release
ctest --preset release -j "$(nproc)" "$@"
