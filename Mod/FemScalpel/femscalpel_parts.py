# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the parts of the workbench are, and which is missing. FreeCAD's Init.py and InitGui.py ask this first.

The workbench is these Python files, the window's (`femscalpelgui`), and the engine's (`femscalpel`) around a compiled
module. They lie side by side where the workbench was assembled by a build or installed from a package. In a clone of
the repository, as the Addon Manager makes it, they are in other folders, and the engine is that of the clone's build
or an installed wheel.
"""

import functools
import importlib.machinery
import importlib.util
import shlex
import sys
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).resolve().parent
#: The clone these files are in, or None where they are assembled or installed.
CLONE = next((p for p in HERE.parents[1:2] if (p / "resources" / "build.sh").exists() and (p / "gui").is_dir()), None)
#: Where the clone's build assembles the workbench.
BUILT = CLONE / "build" / "release" / "Mod" / "FemScalpel" if CLONE else None


class Missing(NamedTuple):
    """A part without which FemScalpel does not run: which, in a sentence or two, and the command that brings it."""

    what: str
    command: str

    def text(self):
        """Both, as they are shown."""
        return (
            f"FemScalpel cannot run: {self.what}\nThis command brings it; start FreeCAD anew then:\n    {self.command}"
        )


class _FolderFinder:
    """Finds a package in a folder of another name."""

    def __init__(self, package, folder):
        self._package, self._folder = package, folder

    def find_spec(self, name, path=None, target=None):
        """The module's spec if it is that package, else None."""
        if name != self._package:
            return None
        start = str(self._folder / "__init__.py")
        return importlib.util.spec_from_file_location(name, start, submodule_search_locations=[str(self._folder)])


@functools.lru_cache(maxsize=None)
def find_parts():
    """Makes what is in other folders of a clone importable; does nothing where all is assembled."""
    if CLONE is None:
        return
    if (BUILT / "femscalpel" / "__init__.py").exists():
        sys.path.insert(0, str(BUILT))
    else:
        sys.meta_path.append(_FolderFinder("femscalpelgui", CLONE / "gui"))


def version():
    """The workbench's version, from its package.xml."""
    from xml.etree import ElementTree

    for folder in (HERE, CLONE):
        if folder and (folder / "package.xml").exists():
            return ElementTree.parse(folder / "package.xml").findtext("{*}version")
    return None


def command_for(number):
    """The command that brings the compiled part of version `number`, by where the workbench came from."""
    if CLONE is not None:
        return f"sh {shlex.quote(str(CLONE / 'resources' / 'build.sh'))}"
    again = "--reinstall " if str(HERE).startswith("/usr/") else ""
    return f"sudo apt-get install {again}./freecad-femscalpel_{number}-1*.deb"


@functools.lru_cache(maxsize=None)
def missing():
    """What keeps FemScalpel from running, as Missing; None if nothing does."""
    find_parts()
    number = version()
    command = command_for(number)
    try:
        import femscalpel
    except ImportError as error:
        if getattr(error, "name", None) == "femscalpel":
            return Missing("its engine, the Python package femscalpel, is not installed.", command)
        return Missing(str(error).removeprefix("FemScalpel: "), command)
    if number and femscalpel.__version__ != number:
        place = Path(femscalpel.__file__).parent
        return Missing(
            f"the engine in {place} is of version {femscalpel.__version__}, this workbench of {number}; both must be "
            "the same.",
            command,
        )
    return None
