#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Makes the Debian package of the workbench for the release of Debian this runs on, in build/release/packages, and
# prints its path.
set -eu
cd "$(dirname "$0")/../.."
{
    sh resources/setup.sh build package
    cmake --preset release
    cmake --build --preset release --target workbench
    rm -rf build/release/packages
    cd build/release
    cpack -G DEB
    cd ../..
} >&2
ls "$PWD"/build/release/packages/*.deb
