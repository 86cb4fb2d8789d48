#!/bin/bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# clang-tidy (.clang-tidy: names, long functions, what is prone to bugs, performance) over the engine and the bindings;
# some ten seconds a file and core. Needs a release build. Files may be named; with --changed it looks at those that
# differ from where the branch left origin/main, or else from the parent commit. Without a clang-tidy that can read the
# code (15 or later), and with --changed without git's history, it says so and succeeds.
set -euo pipefail
cd "$(dirname "$0")/.."

most_changed=12  # files that --changed looks at, a minute's work

newest_tidy() {
    local name version best=14
    for name in clang-tidy-19 clang-tidy-16 clang-tidy; do
        version=$("$name" --version 2>/dev/null | sed -nE 's/.*version ([0-9]+).*/\1/p') || continue
        if [ "${version:-0}" -gt "$best" ]; then
            best=$version
            echo "$name"
        fi
    done | tail -n 1
}

# The tree may belong to another user, as in a container.
git_here() { git -c safe.directory="$PWD" "$@" 2>/dev/null; }

# Empty without history.
base_commit() {
    local base
    base=$(git_here merge-base HEAD origin/main) || base=
    if [ -z "$base" ] || [ "$base" = "$(git_here rev-parse HEAD)" ]; then
        base=$(git_here rev-parse --verify --quiet 'HEAD^') || base=
    fi
    echo "$base"
}

look() {
    local said status=0
    said=$("$tidy" -p "$database" --quiet "$1" 2>&1) || status=$?
    sed -E '/^([0-9]+ (warnings?|errors?)( and [0-9]+ errors?)? (generated|treated as).*)?$/d' <<<"$said"
    return $status
}

tidy=$(newest_tidy)
if [ -z "$tidy" ]; then
    echo "tidy: no clang-tidy of version 15 or later here; nothing was looked at"
    exit 0
fi

files=()
if [ "${1:-}" = --changed ]; then
    base=$(base_commit)
    if [ -z "$base" ]; then
        echo "tidy: no history to compare with; nothing was looked at, tests/tidy.sh looks at everything"
        exit 0
    fi
    mapfile -t files < <({
        git_here diff --name-only --diff-filter=d "$base"
        git_here ls-files --others --exclude-standard
    } | grep -E '^src/(engine|bindings)/.*\.(cpp|h)$' | sort -u)
    echo "tidy: ${#files[@]} file(s) changed since $(git_here rev-parse --short "$base")"
    [ ${#files[@]} -gt 0 ] || exit 0
    if [ ${#files[@]} -gt $most_changed ]; then
        echo "tidy: that is much; looks at $most_changed of them here, tests/tidy.sh looks at everything"
        files=("${files[@]:0:$most_changed}")
    fi
elif [ $# -gt 0 ]; then
    files=("$@")
else
    mapfile -t files < <(find src/engine src/bindings -name '*.cpp' | sort)
fi

build=build/release
if [ ! -f $build/compile_commands.json ]; then
    echo "tidy: build first: cmake --preset release && cmake --build --preset release" >&2
    exit 1
fi
# The commands of every file for itself. clang cannot read GCC's precompiled headers: the same headers, as text.
database=build/tidy
cmake --preset release -B $database -DFEMSCALPEL_UNITY=OFF -DCMAKE_EXPORT_COMPILE_COMMANDS=ON > /dev/null
cp $database/src/engine/CMakeFiles/femscalpel_engine.dir/cmake_pch.hxx $database/engine.hxx
sed -E -i 's#-Winvalid-pch##g
        s#-include [^ ]*femscalpel_engine.dir/cmake_pch.hxx#-include '"$PWD/$database"'/engine.hxx#g
        s#-include [^ ]*cmake_pch.hxx##g; s#-fno-fat-lto-objects##g' $database/compile_commands.json

export tidy database
export -f look
printf '%s\0' "${files[@]}" | xargs -0 -P "$(nproc)" -n 1 bash -c 'look "$1"' _
echo "tidy: ${#files[@]} file(s) looked at by $tidy, nothing found"
