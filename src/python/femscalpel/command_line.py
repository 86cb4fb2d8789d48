# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command line: python3 -m femscalpel, and the program femscalpel of the wheel."""

import argparse
import json
import sys
import warnings

from . import __version__
from ._engine import Error
from .inspection import check, info
from .meshfile import convert, formats, read


def main(arguments=None) -> int:
    """Does what the arguments say. Returns the exit status: 0; 1 for an error, which is printed; 2 for arguments that
    are none."""
    parsed = _parser().parse_args(arguments)
    with warnings.catch_warnings():
        warnings.simplefilter("always")
        warnings.showwarning = lambda message, *_: print(f"warning: {message}", file=sys.stderr)
        try:
            return parsed.run(parsed)
        except (Error, OSError) as error:
            print(f"femscalpel: {error}", file=sys.stderr)
            return 1
        except KeyboardInterrupt:
            print("femscalpel: interrupted", file=sys.stderr)
            return 1


def _parser():
    readable = ", ".join(e for f in formats() if f.reads for e in f.extensions)
    written = ", ".join(e for f in formats() if f.writes for e in f.extensions)
    parser = argparse.ArgumentParser(
        prog="femscalpel",
        description="Looks at finite-element meshes and converts them, with their groups. Python's femscalpel cracks, "
        "drills, cuts, merges, rounds and reshapes them.",
        epilog=f"Files that are read: {readable}. Written: {written}.",
    )
    parser.add_argument("--version", action="version", version=f"femscalpel {__version__}")
    commands = parser.add_subparsers(dest="command", required=True, metavar="command")

    def add(name, run, text):
        command = commands.add_parser(name, help=text[0].lower() + text[1:], description=text + ".")
        command.set_defaults(run=run)
        command.add_argument("file", help="the mesh file")
        command.add_argument("--mesh", metavar="NAME", help="which mesh of a MED file that holds several")
        return command

    add("info", _info, "Says what a mesh holds: elements, sizes, quality, groups, fields").add_argument(
        "--json", action="store_true", help="as JSON"
    )
    add(
        "check", _check, "Says what is odd in a mesh; exit status 1 where solvers would refuse it, or compute nonsense"
    ).add_argument("--json", action="store_true", help="as JSON, with all numbers")
    add(
        "convert", _convert, "Writes a mesh in another format, with its numbers and groups; says what that cannot hold"
    ).add_argument("output", help="the file to write; its ending says the format")
    return parser


def _info(arguments):
    found = info(read(arguments.file, arguments.mesh))
    print(found.to_json() if arguments.json else found.to_text())
    return 0


def _check(arguments):
    found = check(read(arguments.file, arguments.mesh))
    if arguments.json:
        print(json.dumps([f._asdict() for f in found], indent=1))
    else:
        print("\n".join(f"{f.level}: {f.text}" for f in found) or "nothing odd was found")
    return int(any(f.level == "error" for f in found))


def _convert(arguments):
    convert(arguments.file, arguments.output, arguments.mesh)
    return 0
