# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs a unittest module inside FreeCADCmd and fails unless FreeCAD ran tests and all of them passed.

FreeCADCmd's exit status alone does not say that: it can crash on its way out after good tests, and it can leave with 0
when it found nothing to run.
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile


def verdict(output):
    """None if `output` shows that tests ran and passed, else the reason why not."""
    ran = re.search(r"^Ran (\d+) tests? in", output, re.MULTILINE)
    if not ran:
        return "FreeCAD ran no tests"
    if int(ran[1]) == 0:
        return "the test module is empty"
    last = re.search(r"^(OK|FAILED)\b.*$", output[ran.end() :], re.MULTILINE)
    if not last or last[1] != "OK":
        return last[0] if last else "the tests did not finish"
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--freecadcmd", required=True)
    parser.add_argument("--workbench", help="folder Mod/FemScalpel to test; without, the one that is installed")
    parser.add_argument("--path", action="append", default=[], help="further folder with Python modules")
    parser.add_argument("module")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as home:
        # A user folder of its own, so that neither add-ons nor settings of this user play a part.
        environment = {**os.environ, "FREECAD_USER_HOME": home, "PYTHONDONTWRITEBYTECODE": "1"}
        command = [arguments.freecadcmd, "-t", arguments.module]
        if arguments.workbench:
            command += ["-M", arguments.workbench]
        for path in arguments.path:
            command += ["-P", path]
        done = subprocess.run(
            command,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
        )
    sys.stdout.write(done.stdout)
    reason = verdict(done.stdout)
    if reason:
        sys.exit(f"run_tests.py: {reason} (exit status {done.returncode})")


if __name__ == "__main__":
    main()
