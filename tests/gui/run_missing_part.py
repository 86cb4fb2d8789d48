# SPDX-License-Identifier: LGPL-2.1-or-later
"""Takes parts away from copies of the workbench, one a copy, and looks at what FreeCAD's window says of it.

    run_missing_part.py --freecad freecad --workbench build/release/Mod/FemScalpel --screenshots FOLDER [CASE]

Cases: the compiled module is absent, is for another Python, needs a library that is not there; the engine is of
another version than the workbench, or not there at all; a clone of the repository that was not built.
"""

import argparse
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DEB = "sudo apt-get install ./freecad-femscalpel_"


def compiled(workbench):
    return next((workbench / "femscalpel").glob("_engine.*.so"))


def absent(workbench):
    compiled(workbench).unlink()
    return r"compiled_part_\(a_file_", DEB


def other_python(workbench):
    path = compiled(workbench)
    path.rename(path.with_name("_engine.cpython-399-x86_64-linux-gnu.so"))
    return r"is_for_Python_3\.99,_but_this_is_Python_3", DEB


def library(workbench):
    path = compiled(workbench)
    content = path.read_bytes()
    assert b"libTKernel.so" in content, f"{path} does not name libTKernel.so"
    path.write_bytes(content.replace(b"libTKernel.so", b"libTKernal.so"))
    return r"needs_the_library_libTKernal\.so", DEB


def other_version(workbench):
    path = workbench / "package.xml"
    path.write_text(re.sub(r"<version>.*</version>", "<version>99.0.0</version>", path.read_text()))
    return r"is_of_version_.*,_this_workbench_of_99\.0\.0", DEB


def no_engine(workbench):
    shutil.rmtree(workbench / "femscalpel")
    return "its_engine,_the_Python_package_femscalpel,_is_not_installed", DEB


def clone(workbench):
    shutil.rmtree(workbench)
    for part in ("Mod/FemScalpel", "gui", "resources/icons", "src/python"):
        shutil.copytree(ROOT / part, workbench / part, ignore=shutil.ignore_patterns("__pycache__"))
    for file in ("package.xml", "LICENSE", "CMakeLists.txt", "resources/build.sh"):
        shutil.copy(ROOT / file, workbench / file)
    return "its_engine,_the_Python_package_femscalpel,_is_not_installed", f"sh {workbench}/resources/build.sh"


CASES = (absent, other_python, library, other_version, no_engine, clone)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--freecad", required=True)
    parser.add_argument("--workbench", required=True, help="folder Mod/FemScalpel to take copies of")
    parser.add_argument("--screenshots", required=True, help="folder for the pictures")
    parser.add_argument("cases", nargs="*", metavar="CASE", help="all without")
    arguments = parser.parse_args()
    failed, screenshots = [], Path(arguments.screenshots)
    for case in CASES:
        if arguments.cases and case.__name__ not in arguments.cases:
            continue
        with tempfile.TemporaryDirectory() as folder:
            workbench = Path(folder).resolve() / "FemScalpel"
            shutil.copytree(arguments.workbench, workbench, symlinks=True)
            expected, command = case(workbench)
            done = subprocess.run(
                [
                    sys.executable,
                    str(Path(__file__).with_name("run_gui_tests.py")),
                    *("--freecad", arguments.freecad, "--workbench", str(workbench)),
                    *("--screenshots", str(screenshots / case.__name__)),
                    *("--script", str(Path(__file__).with_name("missing_part.py"))),
                    *(case.__name__, expected, command),
                ],
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
                check=False,
            )
        print(f"{case.__name__}: {'passed' if done.returncode == 0 else done.stdout}", flush=True)
        if done.returncode:
            failed.append(case.__name__)
    if failed:
        sys.exit(f"run_missing_part.py: failed: {', '.join(failed)}")


if __name__ == "__main__":
    main()
