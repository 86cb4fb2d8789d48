#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Installs what is missing (Debian 12), builds the release preset, runs all tests but those labelled long. Arguments go
# to CTest.
set -eu
cd "$(dirname "$0")/.."
sh resources/setup.sh build demo test
cmake --preset release
cmake --build --preset release
# One more than cores: the window tests wait much.
ctest --preset release -j "$(($(nproc) + 1))" -LE long "$@"
