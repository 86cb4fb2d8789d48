#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Installs a Debian package of the workbench on a bare release of Debian with FreeCAD, where neither a compiler nor a
# header is (those that FreeCAD's own dependencies bring are put out of sight), and tries it there:
#   tests/releases/install.sh bookworm|trixie|forky PACKAGE.deb [folder, default /var/tmp/femscalpel-install-RELEASE]
# How long it takes from the package's file to the demo's mesh cracked, FreeCAD's list of tests, what lintian finds, and
# whether anything is left after removal; a line each. Needs root and debootstrap. Nothing stays mounted afterwards.
set -eu
usage() {
    sed -n '3,8s/^# \{0,1\}//p' "$0" >&2
    exit 2
}
release=${1:-}
case $release in bookworm | trixie | forky) ;; *) usage ;; esac
[ -f "${2:-}" ] || usage
package=$(realpath "$2")
folder=$(realpath -m "${3:-/var/tmp/femscalpel-install-$release}")
cd "$(dirname "$0")/../.."
. tests/releases/folder.sh

make_folder
step freecad 'apt-get -qq purge -y --autoremove freecad-femscalpel 2>/dev/null || true; apt-get -qq update
    apt-get -qq install -y --no-install-recommends freecad lintian'
inside 'dpkg-query -W -f "\${Package}\n" | sort' >"$logs/packages"
all_files='find / -xdev \( -path /tmp -o -path /var -o -path /root -o -path /proc -o -path /dev \) -prune -o -print |
    sort'
step before "$all_files >/root/before"
cp "$package" "$folder/root/package.deb"
cp tests/releases/first_crack.py tests/freecad/run_tests.py "$folder/root"

step install 'apt-get -qq install -y --no-install-recommends ./package.deb'
installed=$took
came=$(inside 'dpkg-query -W -f "\${Package}\n" | sort' | comm -13 "$logs/packages" - | paste -sd' ')
! echo "$came" | tr ' ' '\n' | grep -E '^(g\+\+|gcc|clang|cmake|.*-dev)(-[0-9]+)?$' ||
    fail "the package brings what builds: $came"
# FreeCAD's own dependencies bring a compiler in some releases (Matplotlib, by way of SciPy and Pythran).
hidden='mkdir -p /hidden; for f in /usr/include /usr/bin/*gcc* /usr/bin/*g++* /usr/bin/cc /usr/bin/c++; do
    [ ! -e $f ] || mv $f /hidden; done'
inside "$hidden"
say "installed in $installed s, with $came"
step crack 'freecadcmd first_crack.py </dev/null'
grep -q '^first crack: ' "$logs/crack.log" || {
    tail -n 15 "$logs/crack.log"
    fail "the demo's mesh was not cracked"
}
say "from the package's file to the first crack $((installed + took)) s, FreeCAD's part $took s:" \
    "$(sed -n 's/^first crack: //p' "$logs/crack.log")"

step tests 'python3 run_tests.py --freecadcmd freecadcmd TestFemScalpelApp'
say "FreeCADCmd: $(grep -E '^(Ran|OK|FAILED)' "$logs/tests.log" | paste -sd' ')"

inside 'lintian --fail-on error --no-tag-display-limit package.deb' >"$logs/lintian.log" 2>&1 ||
    fail "lintian: $(grep '^E:' "$logs/lintian.log" || tail -3 "$logs/lintian.log")"
say "lintian: no errors, $(grep -c '^W:' "$logs/lintian.log" || true) warnings"

# FreeCAD run by root leaves compiled Python files; they must go, too.
inside 'touch /usr/lib/freecad-femscalpel/FemScalpel/__pycache__/other.pyc'
inside 'for f in /hidden/*; do
    case $f in */include) mv $f /usr ;; /hidden/\*) ;; *) mv $f /usr/bin ;; esac
done; rmdir /hidden'
step remove 'apt-get -qq purge -y freecad-femscalpel; apt-get -qq autoremove -y --purge'
inside "$all_files >/root/after; comm -13 before after" | grep -i femscalpel && fail "this is left after removal"
say "removed: nothing of it is left"
