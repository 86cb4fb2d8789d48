#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Installs a wheel in a fresh virtual environment of a bare release of Debian, with nothing beside it but NumPy, and
# tries it there; then, where 'freecad' is given, with FreeCAD, a clone of the repository as the add-on and its tests:
#   tests/releases/wheel.sh bookworm|trixie|forky WHEEL [freecad] [folder, default /var/tmp/femscalpel-wheel-RELEASE]
# A line each. Needs root, debootstrap, what wheel.sh left of making the wheel, and a build (the demo's mesh).
# Nothing stays mounted afterwards.
set -eu
usage() {
    sed -n '3,8s/^# \{0,1\}//p' "$0" >&2
    exit 2
}
release=${1:-}
case $release in bookworm | trixie | forky) ;; *) usage ;; esac
[ -f "${2:-}" ] || usage
wheel=$(realpath "$2")
shift 2
with_freecad=
if [ "${1:-}" = freecad ]; then
    with_freecad=yes
    shift
fi
folder=$(realpath -m "${1:-/var/tmp/femscalpel-wheel-$release}")
cd "$(dirname "$0")/../.."
. tests/releases/folder.sh

make_folder
step python 'apt-get -qq update; apt-get -qq install -y --no-install-recommends python3-venv; rm -rf venv *.whl'
cp "$wheel" tests/releases/wheel_check.py tests/python/shapes/plane.step \
    build/release/Mod/FemScalpel/resources/examples/caisson.npz "$folder/root"
# NumPy is fetched here: this machine's ways to PyPI need not be the folder's.
tag=$(basename "$wheel" | cut -d- -f3)
"build/wheel-tools-$tag/bin/pip" --disable-pip-version-check --quiet download --only-binary :all: \
    -d "$folder/root" "$wheel" >"$logs/download.log" 2>&1
step venv 'python3 -m venv venv; venv/bin/pip --disable-pip-version-check install --no-index -f . femscalpel
    venv/bin/pip list'
installed=$took
step check 'venv/bin/python wheel_check.py caisson.npz plane.step'
say "installed in $installed s; $(grep '^wheel: ' "$logs/check.log")"
[ -n "$with_freecad" ] || exit 0

step freecad 'apt-get -qq install -y --no-install-recommends freecad python3-pip'
rm -rf "$folder/root/clone"
mkdir -p "$folder/root/clone"
git ls-files -z | xargs -0 ls -d 2>/dev/null | tar -cf - -T - | tar -xf - -C "$folder/root/clone"
cp tests/releases/first_crack.py "$folder/root"
# As the README says: the clone among FreeCAD's add-ons, the wheel in the user's packages.
step user 'python3 -m pip install --user --break-system-packages --no-deps ./femscalpel-*.whl
    mod=$(freecadcmd -c "print(\"mod:\", FreeCAD.getUserAppDataDir())" </dev/null | sed -n "s/^mod: //p")Mod
    rm -rf "$mod/FemScalpel"; mkdir -p "$mod"; mv clone "$mod/FemScalpel"
    mkdir -p "$mod/FemScalpel/Mod/FemScalpel/resources/examples"
    cp caisson.npz "$mod/FemScalpel/Mod/FemScalpel/resources/examples"'
step crack 'freecadcmd first_crack.py </dev/null'
grep -q '^first crack: ' "$logs/crack.log" || {
    tail -n 15 "$logs/crack.log"
    fail "the demo's mesh was not cracked"
}
version=$(inside 'dpkg-query -W -f "\${Version}" freecad')
engine=$(inside 'ls .local/lib/*/site-packages | grep -m1 femscalpel-')
say "FreeCAD $version: $(sed -n 's/^first crack: //p' "$logs/crack.log"), with the engine of $engine"
# FreeCAD's list of tests, which is in a build's workbench and not in a clone's; but for what looks at a built one.
step tests 'mod=$(freecadcmd -c "print(\"mod:\", FreeCAD.getUserAppDataDir())" </dev/null | sed -n "s/^mod: //p")Mod
    rm -rf tests; cp -r "$mod/FemScalpel/tests/freecad/workbench" tests
    cp "$mod/FemScalpel/tests/python/meshes.py" tests/femscalpeltest
    rm tests/femscalpeltest/test_addon.py
    PYTHONPATH=/root/tests freecadcmd -t TestFemScalpelApp </dev/null || true'
grep -q '^OK' "$logs/tests.log" || {
    grep -E '^(ERROR|FAIL|Ran)' "$logs/tests.log"
    fail "FreeCADCmd, see $logs/tests.log"
}
say "FreeCADCmd: $(grep -E '^(Ran|OK|FAILED)' "$logs/tests.log" | paste -sd' ')"
