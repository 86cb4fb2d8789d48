# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs a test of FreeCAD's list (freecad -t), or a script, in FreeCAD's window on a virtual screen.

Fails unless tests ran, all of them passed, and FreeCAD wrote no traceback.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.append(str(Path(__file__).parents[1] / "freecad"))
from run_tests import verdict  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--freecad", required=True)
    parser.add_argument("--workbench", required=True, help="folder Mod/FemScalpel to test")
    parser.add_argument("--screenshots", required=True, help="folder for the pictures; made anew")
    parser.add_argument(
        "--script", help="what FreeCAD opens instead of running a test; it writes to FEMSCALPEL_TEST_RESULT"
    )
    parser.add_argument("--screen", default="1280x900", help="size of the virtual screen in pixels")
    parser.add_argument("--language", help="of the window, such as de")
    parser.add_argument("--theme", help="FreeCAD's style sheet for the window, such as Dark-blue.qss")
    parser.add_argument(
        "names", nargs="+", help="a module, class or test; or what the script wants, in FEMSCALPEL_TESTS"
    )
    arguments = parser.parse_args()
    if not arguments.script and len(arguments.names) > 1:
        parser.error("FreeCAD runs one test, class or module at a time")
    shutil.rmtree(arguments.screenshots, ignore_errors=True)
    workbench = os.path.abspath(arguments.workbench)
    with tempfile.TemporaryDirectory() as home:
        outcome = os.path.join(home, "outcome.txt")
        environment = {
            **os.environ,
            "FREECAD_USER_HOME": home,
            "PYTHONDONTWRITEBYTECODE": "1",
            "LIBGL_ALWAYS_SOFTWARE": "1",
            "QTWEBENGINE_DISABLE_SANDBOX": "1",
            "LC_ALL": "C.UTF-8",
            "FEMSCALPEL_TESTS": " ".join(arguments.names),
            "FEMSCALPEL_TEST_RESULT": outcome,
            "FEMSCALPEL_SCREENSHOTS": os.path.abspath(arguments.screenshots),
            "FEMSCALPEL_LANGUAGE": arguments.language or "",
            "FEMSCALPEL_THEME": arguments.theme or "",
        }
        what = [arguments.script] if arguments.script else ["-t", arguments.names[0]]
        command = [
            "xvfb-run",
            # A free screen, looked for from a number of our own: two that look from the same one at once take the same.
            *("-a", "-n", str(100 + os.getpid() % 30000)),
            "-s",
            f"-screen 0 {arguments.screen}x24 -dpi 96",
            arguments.freecad,
            *what,
            "--module-path",
            workbench,
        ]
        done = subprocess.run(
            command,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
        )
        text = Path(outcome).read_text() if os.path.exists(outcome) else done.stdout
    sys.stdout.write(text)
    reason = verdict(text) or ("FreeCAD wrote a traceback" if "Traceback" in done.stdout else None)
    if reason:
        if text is not done.stdout:
            sys.stdout.write(done.stdout)
        sys.exit(f"run_gui_tests.py: {reason} (exit status {done.returncode})")


if __name__ == "__main__":
    main()
