# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs tests in FreeCAD's window on a virtual screen and fails unless tests ran and all of them passed."""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).parent


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--freecad", required=True)
    parser.add_argument("--workbench", required=True, help="folder Mod/FemScalpel to test")
    parser.add_argument("--screenshots", required=True, help="folder for the pictures; made anew")
    parser.add_argument("--script", default=str(HERE / "run_in_freecad.py"), help="what FreeCAD opens")
    parser.add_argument("tests", nargs="*", help="module or test names")
    arguments = parser.parse_args()
    shutil.rmtree(arguments.screenshots, ignore_errors=True)
    with tempfile.TemporaryDirectory() as home:
        outcome = os.path.join(home, "outcome.txt")
        environment = {
            **os.environ, "FREECAD_USER_HOME": home, "PYTHONDONTWRITEBYTECODE": "1", "LIBGL_ALWAYS_SOFTWARE": "1",
            "QTWEBENGINE_DISABLE_SANDBOX": "1", "LC_ALL": "C.UTF-8",
            "FEMSCALPEL_TESTS": " ".join(arguments.tests), "FEMSCALPEL_TEST_RESULT": outcome,
            "FEMSCALPEL_SCREENSHOTS": arguments.screenshots}
        command = ["xvfb-run", "-a", "-s", "-screen 0 1280x900x24 -dpi 96", arguments.freecad, arguments.script,
                   "--module-path", arguments.workbench]
        done = subprocess.run(command, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, errors="replace")
        text = Path(outcome).read_text() if os.path.exists(outcome) else ""
    sys.stdout.write(text)
    if not re.search(r"^Ran [1-9]\d* tests? in", text, re.M) or not re.search(r"^OK", text, re.M) or done.returncode:
        sys.stdout.write(done.stdout)
        sys.exit(f"run_gui_tests.py: failed (exit status {done.returncode})")


if __name__ == "__main__":
    main()
