# SPDX-License-Identifier: LGPL-2.1-or-later
"""Prints, in a line, which versions of what FemScalpel meets are installed here."""

import platform
import subprocess

PACKAGES = {
    "FreeCAD": ("freecad-common",),
    "Qt": ("libqt6core6t64", "libqt5core5t64", "libqt5core5a"),
    "OpenCASCADE": ("libocct-foundation-dev",),
    "HDF5": ("libhdf5-dev",),
    "Gmsh": ("gmsh",),
    "CalculiX": ("calculix-ccx",),
    "GCC": ("g++",),
}


def version(package):
    """Version of an installed Debian package, without what Debian adds; None if it is not installed."""
    done = subprocess.run(
        ["dpkg-query", "-W", "-f=${Status}|${Version}", package], capture_output=True, text=True, check=False
    )
    status, _, found = done.stdout.partition("|")
    if not status.endswith(" installed"):
        return None
    return found.partition(":")[2].split("-")[0] if ":" in found else found.split("-")[0]


def main():
    parts = [f"Python {platform.python_version()}"]
    for name, packages in PACKAGES.items():
        found = next((v for v in map(version, packages) if v), None)
        parts.append(f"{name} {found.split('+')[0]}" if found else f"no {name}")
    print(", ".join(parts))


if __name__ == "__main__":
    main()
