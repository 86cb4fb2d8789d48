#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Makes wheels of the Python package on Debian 12, each with all libraries it needs but NumPy's, in build/wheels, and
# prints their paths: one for each Python given, as a path (default /usr/bin/python3), of any version from 3.9 on.
#   resources/packaging/wheel.sh [PYTHON...]
# The first run makes the libraries (wheel_libraries.sh), which takes three quarters of an hour on two cores.
set -eu
cd "$(dirname "$0")/../.."
most=60 # MB
[ $# != 0 ] || set -- /usr/bin/python3
{
    sh resources/setup.sh build wheel
    # What runs on the oldest Debian we support runs on the others, not the other way round.
    grep -q '^12' /etc/debian_version || {
        echo "wheel.sh: wheels are made on Debian 12, for its C library to be the oldest" >&2
        exit 1
    }
    libraries=${FEMSCALPEL_WHEEL_LIBRARIES:-$PWD/build/wheel-libraries}
    sh resources/packaging/wheel_libraries.sh "$libraries"
    for python; do
        tag=$("$python" -c 'import sys; print("cp%d%d" % sys.version_info[:2])')
        tools=build/wheel-tools-$tag
        [ -x "$tools/bin/auditwheel" ] || "$python" -m venv "$tools"
        "$tools/bin/pip" --quiet --disable-pip-version-check install -r resources/pypi-packages.txt
        rm -rf "build/wheels/$tag" build/wheels/*"-$tag-"*.whl
        CMAKE_PREFIX_PATH=$libraries CMAKE_GENERATOR=Ninja LD_LIBRARY_PATH=$libraries/lib \
            "$tools/bin/pip" --disable-pip-version-check wheel --no-build-isolation --no-deps -w "build/wheels/$tag" .
        PATH=$PWD/$tools/bin:$PATH LD_LIBRARY_PATH=$libraries/lib "$tools/bin/auditwheel" repair --strip \
            -w build/wheels "build/wheels/$tag"/*.whl
        rm -rf "build/wheels/$tag"
        size=$(du --apparent-size -m "build/wheels/"*"-$tag-"*.whl | cut -f1)
        [ "$size" -lt $most ] || {
            echo "wheel.sh: the wheel is too large: $size MB" >&2
            exit 1
        }
        made="${made:-} $tag"
    done
} >&2
for tag in $made; do ls "$PWD"/build/wheels/*"-$tag-"*.whl; done
