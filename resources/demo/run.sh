#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# The demo: installs what is missing (Debian), builds the package, cracks the caisson, solves it, draws it.
#   resources/demo/run.sh [output folder, default ./femscalpel-demo] [--quadrangles]
# With --quadrangles, the shell model is of quadrangles instead of triangles.
set -eu
output=femscalpel-demo
quadrangles=
for argument; do
    case $argument in
    --quadrangles) quadrangles=$argument ;;
    *) output=$argument ;;
    esac
done
output=$(realpath -m "$output")
cd "$(dirname "$0")/../.."
sh resources/setup.sh build demo
echo "building FemScalpel in build/release"
cmake --preset release >/dev/null
cmake --build --preset release --target workbench
export PYTHONPATH="$PWD/build/release/Mod/FemScalpel"
exec xvfb-run -a /usr/bin/python3 resources/demo/demo.py $quadrangles "$output"
