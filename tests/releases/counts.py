# SPDX-License-Identifier: LGPL-2.1-or-later
"""Prints, in a line, how many tests of each kind the last run of CTest in a build folder passed, failed and skipped.

    counts.py BUILD_FOLDER

CTest counts a file of Python's tests, FreeCAD's list and the window's as one; here each test of them counts.
"""

import re
import sys
from collections import Counter
from pathlib import Path

NAMES = {"python": "Python", "freecad": "FreeCADCmd", "gui": "window"}
PYTEST = re.compile(r"^(?=\d).*\bin [\d.]+s\b.*$", re.MULTILINE)
UNITTEST = re.compile(r"^Ran (\d+) tests? in [^\n]*\n+(OK|FAILED)(?: \(([^)]*)\))?", re.MULTILINE)


def count(name, status, output):
    """(kind, Counter of passed, failed, skipped) of one of CTest's tests."""
    kind = NAMES.get(name.partition(".")[0]) if name.partition(".")[0] in NAMES else "C++"
    counts = Counter()
    lines = PYTEST.findall(output)
    if kind == "Python" and lines:
        for number, word in re.findall(r"(\d+) (passed|failed|skipped|errors?)", lines[-1]):
            counts["failed" if word.startswith("error") else word] += int(number)
    elif kind in ("FreeCADCmd", "window") and (ran := UNITTEST.search(output)):
        bad = {word: int(n) for word, n in re.findall(r"(\w+)=(\d+)", ran[3] or "")}
        counts["skipped"] = bad.pop("skipped", 0)
        counts["failed"] = sum(bad.values())
        counts["passed"] = int(ran[1]) - sum(counts.values())
    else:
        counts[status.lower()] += 1
    if status == "Failed":
        counts["failed"] = counts["failed"] or 1
    return kind, counts


def read_log(text):
    """Yields name, status and output of each test in CTest's LastTest.log."""
    for block in re.split(r"^\d+/\d+ Testing: ", text, flags=re.MULTILINE)[1:]:
        name = block.partition("\n")[0]
        skipped = re.search(r"^Test Pass Reason:\n.*[Ss]kip", block, re.MULTILINE)
        status = re.search(r"^Test (Passed|Failed)\.$", block, re.MULTILINE)
        yield name, "Skipped" if skipped else status[1] if status else "Failed", block


def main():
    log = Path(sys.argv[1]) / "Testing" / "Temporary" / "LastTest.log"
    if not log.exists():
        sys.exit(f"counts.py: no tests ran: there is no {log}")
    total, failing = {}, []
    for name, status, output in read_log(log.read_text(errors="replace")):
        kind, counts = count(name, status, output)
        total.setdefault(kind, Counter()).update(counts)
        if counts["failed"]:
            failing.append(name)
    parts = [
        f"{kind} " + ", ".join(f"{counts[word]} {word}" for word in ("passed", "failed", "skipped") if counts[word])
        for kind, counts in total.items()
    ]
    print("; ".join(parts) + (f" (failed: {', '.join(failing)})" if failing else ""))


if __name__ == "__main__":
    main()
