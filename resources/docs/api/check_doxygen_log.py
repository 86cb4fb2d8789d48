#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fails when Doxygen had anything to say, but that members of a class have no comment: names can say enough there.

    check_doxygen_log.py build/release/docs/doxygen.log

Classes, free functions, types and constants without a comment, wrong parameters and references, broken links count.
"""

import pathlib
import re
import sys

NEED_NOT = re.compile(r"warning: Member .* of (class|struct) \S+ is not documented\.$")


def faults(text):
    """The lines of Doxygen's log that count."""
    return [line for line in text.splitlines() if line.strip() and not NEED_NOT.search(line)]


if __name__ == "__main__":
    found = faults(pathlib.Path(sys.argv[1]).read_text())
    sys.exit("\n".join(found) if found else 0)
