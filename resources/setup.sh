#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Installs the Debian packages of resources/debian-packages.txt that are missing. Needs root only if any is.
#   resources/setup.sh [build] [demo] [test] [package] [wheel] [develop]
# installs those of these sections, or of all without a section named. What this release of Debian lacks is left out,
# and said.
set -eu
list=$(dirname "$0")/debian-packages.txt
for section; do
    grep -qx "\[$section\]" "$list" || {
        echo "setup.sh: there is no section [$section] in $list; give" \
            "$(sed -n 's/^\[\(.*\)\]$/\1/p' "$list" | paste -sd' ' | sed 's/ /, /g')" >&2
        exit 1
    }
done
wanted=$(awk -v sections=" $* " '/^\[/ { on = sections ~ /^ *$/ || index(sections, " " substr($0, 2, length - 2) " ") }
    on && /^[a-z]/ { gsub(/ *\| */, "|"); print }' "$list")

installed() { dpkg-query -W -f='${Status}' "$1" 2>/dev/null | grep -q 'install ok installed'; }
candidate() { apt-cache policy "$1" 2>/dev/null | sed -n 's/^  Candidate: //p' | grep -qv '^(none)$'; }

missing=
for choice in $wanted; do
    there=
    for package in $(echo "$choice" | tr '|' ' '); do
        if installed "$package"; then there=yes; fi
    done
    [ -n "$there" ] || missing="$missing $choice"
done
[ -n "$missing" ] || exit 0
if [ "$(id -u)" = 0 ]; then sudo=; else sudo=sudo; fi
# Without lists of packages all would seem to be missing in this release. Those there are may do, if they are of a day.
lists=$(find /var/lib/apt/lists -maxdepth 1 -name '*_Packages*' -mtime -1 2>/dev/null | head -1)
[ -n "$lists" ] || $sudo apt-get -qq update
available=
lacking=
for choice in $missing; do
    found=
    for package in $(echo "$choice" | tr '|' ' '); do
        if [ -z "$found" ] && candidate "$package"; then found=$package; fi
    done
    if [ -n "$found" ]; then
        available="$available $found"
    else
        lacking="$lacking $choice"
    fi
done
if [ -n "$lacking" ]; then
    echo "setup.sh: this release of Debian has no package$lacking; what needs it is left out" >&2
fi
[ -n "$available" ] || exit 0
echo "installing Debian packages:$available"
# shellcheck disable=SC2086
DEBIAN_FRONTEND=noninteractive $sudo apt-get -qq install -y --no-install-recommends $available >/dev/null
