#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Sets up, builds, runs the demo and all tests on another release of Debian, in a folder of its own:
#   tests/releases/run.sh bookworm|trixie|forky [folder, default /var/tmp/femscalpel-RELEASE] [setup|make|demo|test]...
# Prints a line of each step, and of what the release has; what the steps print goes to FOLDER/var/log/femscalpel.
# Without steps, all; 'setup' alone brings packages and sources. Needs root and debootstrap, some 6 GB and half an
# hour. MIRROR in the environment takes the place of the mirror in /etc/apt. Nothing stays mounted afterwards.
set -eu
usage() {
    sed -n '3,7s/^# \{0,1\}//p' "$0" >&2
    exit 2
}
release=${1:-}
case $release in bookworm | trixie | forky) ;; *) usage ;; esac
shift
case ${1:-} in
'' | setup | make | demo | test) folder=/var/tmp/femscalpel-$release ;;
*)
    folder=$(realpath -m "$1")
    shift
    ;;
esac
for step; do
    case $step in setup | make | demo | test) ;; *) usage ;; esac
done
steps=${*:-make demo test}
cd "$(dirname "$0")/../.."
. tests/releases/folder.sh

# Runs a step; where it fails, says so with the end of its log, and ends.
step() {
    start=$(date +%s)
    if ! inside "$2" >"$logs/$1.log" 2>&1; then
        say "$1 FAILED after $(($(date +%s) - start)) s, see $logs/$1.log:"
        tail -n "${3:-15}" "$logs/$1.log"
        [ "$1" = test ] || exit 1
        failed=yes
    fi
    took="$(($(date +%s) - start)) s"
}

make_folder

# The sources as they are here, committed or not, over those of the last time: what is the same keeps its time, so that
# only what changed is built.
new=$folder/root/new
old=$folder/root/femscalpel
rm -rf "$new"
mkdir -p "$new" "$old"
(git ls-files -z --cached --others --exclude-standard | xargs -0 ls -d 2>/dev/null | tar -cf - -T -) |
    tar -xmf - -C "$new"
(cd "$new" && find . -type f) | while read -r file; do
    if cmp -s "$new/$file" "$old/$file"; then cp --preserve=timestamps "$old/$file" "$new/$file"; fi
done
[ ! -e "$old/build" ] || mv "$old/build" "$new/build"
rm -rf "$old"
mv "$new" "$old"

took=
failed=
step setup "cd femscalpel; sh resources/setup.sh build demo test"
say "packages $took; $(grep -h '^setup.sh:' "$logs/setup.log" || echo 'all there')"
inside '/usr/bin/python3 femscalpel/tests/releases/versions.py' 2>/dev/null | sed "s/^/$release: /"
for step in $steps; do
    case $step in
    make)
        step build "cd femscalpel; cmake --preset release; cmake --build --preset release"
        say "built in $took, $(grep -c 'warning:' "$logs/build.log" || true) warnings"
        ;;
    demo)
        step demo "cd femscalpel; resources/demo/run.sh /root/demo"
        say "demo $took, $(find "$folder/root/demo" -type f | wc -l) files" \
            "$(grep -h -m1 -o 'CalculiX (ccx) is not installed.*' "$logs/demo.log")"
        ;;
    test)
        step test "cd femscalpel; tests/run.sh" 40
        say "tests $took; $(/usr/bin/python3 tests/releases/counts.py "$folder/root/femscalpel/build/release")"
        ;;
    esac
done
[ -z "$failed" ]
