# SPDX-License-Identifier: LGPL-2.1-or-later
# A folder with another release of Debian, for the scripts beside this one, which give $release and $folder and read
# this.
[ "$(id -u)" = 0 ] || { echo "debootstrap and chroot need root" >&2 && exit 1; }

logs=$folder/var/log/femscalpel
say() { printf '%s: %s\n' "$release" "$*"; }

fail() {
    say "FAILED: $*"
    exit 1
}
# Runs a step; where it fails, prints the end of its log, and ends. Sets $took.
step() {
    start=$(date +%s)
    inside "$2" >"$logs/$1.log" 2>&1 || {
        tail -n 15 "$logs/$1.log"
        fail "$1, see $logs/$1.log"
    }
    took=$(($(date +%s) - start))
}

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

mirror() {
    [ -n "${MIRROR:-}" ] && echo "$MIRROR" && return
    cat /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null |
        sed -n -E 's/^(URIs:|deb( \[[^]]*\])?) +([^ ]+).*/\3/p' | grep -E '/debian/?$' | head -1 | grep . ||
        echo http://deb.debian.org/debian
}

# Makes the folder, if it is not there, and says where its packages come from.
make_folder() {
    script=$release
    [ "$release" != forky ] || script=sid # debootstrap of Debian 12 does not know its name
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
}
