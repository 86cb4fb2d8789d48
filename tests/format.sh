#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Formats the code: clang-format for C++, black for Python (as resources/debian-packages.txt installs them: other
# versions differ in details). With --check says what is not formatted and what has lines of over 120 columns, and
# changes nothing. Files may be named; all otherwise.
set -eu
cd "$(dirname "$0")/.."
check=
if [ "${1:-}" = --check ]; then
    check=yes
    shift
fi
# Without git, or in a tree that git does not trust: all but what is built.
[ $# -gt 0 ] || set -- $(git ls-files 2>/dev/null || find . -type f -not -path './build/*' -not -path './.git/*')
cpp=
python=
long=
for file; do
    [ -f "$file" ] || continue
    case $file in
    *.cpp | *.h) cpp="$cpp $file" ;;
    *.py) python="$python $file" ;;
    *.sh | *CMakeLists.txt | *.cmake) ;;
    *) continue ;;
    esac
    long="$long $file"
done
status=0
if [ -n "$cpp" ]; then
    if [ -n "$check" ]; then clang-format --dry-run -Werror $cpp || status=1; else clang-format -i $cpp; fi
fi
if [ -n "$python" ]; then
    if [ -n "$check" ]; then black --quiet --check --diff $python || status=1; else black --quiet $python; fi
fi
[ -z "$long" ] || awk 'length > 120 { print FILENAME ":" FNR ": " length " columns"; bad = 1 }
    END { exit bad }' $long || status=1
exit $status
