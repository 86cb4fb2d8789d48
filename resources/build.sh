#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Brings the compiled part of a clone: installs what building it needs (Debian), and builds the workbench. In FreeCAD's
# folder Mod, a clone is then the add-on; FreeCAD must be started anew.
set -eu
cd "$(dirname "$0")/.."
sh resources/setup.sh build
echo "building FemScalpel in $PWD/build/release (five to ten minutes)"
# What was found at another time, say another Python, is looked for anew.
cmake --preset release --fresh >/dev/null
cmake --build --preset release --target workbench
echo "FemScalpel is built; start FreeCAD anew"
