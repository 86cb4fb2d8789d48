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
script=$release
case $release in
bookworm | trixie) ;;
forky) script=sid ;; # which debootstrap of Debian 12 does not know by name
*) usage ;;
esac
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
[ "$(id -u)" = 0 ] || { echo "run.sh: debootstrap and chroot need root" >&2 && exit 1; }

logs=$folder/var/log/femscalpel
say() { printf '%s: %s\n' "$release" "$*"; }

# Runs a command in the folder. /proc and /dev are mounted for it alone, and gone when it ends, however it ends.
inside() {
    # shellcheck disable=SC2016
    unshare --mount --pid --fork --kill-child sh -euc '
        mount -t proc proc "$0/proc"
        mount --rbind /dev "$0/dev"
        exec chroot "$0" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 TERM=dumb \
            DEBIAN_FRONTEND=noninteractive QTWEBENGINE_DISABLE_SANDBOX=1 LIBGL_ALWAYS_SOFTWARE=1 \
            PYTHONDONTWRITEBYTECODE=1 sh -euc "cd /root; $1"' "$folder" "$1"
}

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

mirror() {
    [ -n "${MIRROR:-}" ] && echo "$MIRROR" && return
    cat /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null |
        sed -n -E 's/^(URIs:|deb( \[[^]]*\])?) +([^ ]+).*/\3/p' | grep -E '/debian/?$' | head -1 | grep . ||
        echo http://deb.debian.org/debian
}

if [ ! -e "$folder/etc/debian_version" ]; then
    mkdir -p "$folder"
    debootstrap --variant=minbase "$release" "$folder" "$(mirror)" "$script" >"$folder/debootstrap.log" 2>&1 || {
        say "debootstrap FAILED, see $folder/debootstrap.log:"
        tail -5 "$folder/debootstrap.log"
        exit 1
    }
fi
mkdir -p "$logs"
echo "deb $(mirror) $release main" >"$folder/etc/apt/sources.list"
# A mirror frozen at a day has lists that are out of date, which matters in what is not released.
echo 'Acquire::Check-Valid-Until "false";' >"$folder/etc/apt/apt.conf.d/99femscalpel"
echo force-unsafe-io >"$folder/etc/dpkg/dpkg.cfg.d/femscalpel" # nobody keeps what a crash would break
apt-config dump | grep -E '^Acquire::[a-z]+::Proxy ' >>"$folder/etc/apt/apt.conf.d/99femscalpel" || true
[ ! -e /etc/resolv.conf ] || cp -L /etc/resolv.conf "$folder/etc/resolv.conf"

# The sources as they are here, committed or not, over those of the last time, so that only what changed is built.
mkdir -p "$folder/root/femscalpel"
rm -rf "$folder/root/new"
mkdir "$folder/root/new"
(git ls-files -z --cached --others --exclude-standard | xargs -0 ls -d 2>/dev/null | tar -cf - -T -) |
    tar -xf - -C "$folder/root/new"
(cd "$folder/root/femscalpel" && find . -mindepth 1 -maxdepth 1 ! -name build -exec rm -rf {} +)
cp -a "$folder/root/new/." "$folder/root/femscalpel"
rm -rf "$folder/root/new"

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
