# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command line: python3 -m femscalpel, and the program femscalpel of the wheel."""

import argparse
import json
import sys
import warnings

from . import __version__, _arguments
from ._engine import Error
from .inspection import check, info
from .meshfile import formats, read, write

_STATUS = (
    "Exit status: 0; 1 where check finds what solvers would refuse, or a file cannot be written; 2 where the file "
    "cannot be read, or the arguments are none."
)


def main(arguments=None) -> int:
    """Does what the arguments say. Returns the exit status: 0; 1 where `check` finds an error or a file cannot be
    written; 2 for a file that cannot be read and for arguments that are none. What is wrong is printed. Characters
    that the output's encoding has not are written as escapes.
    """
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")
    parsed = _parser().parse_args(arguments)
    with warnings.catch_warnings():
        warnings.simplefilter("always")
        warnings.showwarning = lambda message, *_: print(f"warning: {message}", file=sys.stderr)
        try:
            return parsed.run(parsed)
        except _Unreadable as error:
            print(f"femscalpel: {error.__cause__}", file=sys.stderr)
            return 2
        except (Error, OSError) as error:
            print(f"femscalpel: {error}", file=sys.stderr)
            return 1
        except KeyboardInterrupt:
            print("femscalpel: interrupted", file=sys.stderr)
            return 1


class _Unreadable(Exception):
    """The file cannot be read, for the reason that is the cause."""


def _read(arguments):
    try:
        return read(arguments.file, arguments.mesh)
    except (Error, OSError) as error:
        raise _Unreadable from error


def _parser():
    readable = ", ".join(e for f in formats() if f.reads for e in f.extensions)
    written = ", ".join(e for f in formats() if f.writes for e in f.extensions)
    parser = argparse.ArgumentParser(
        prog="femscalpel",
        description="Looks at finite-element meshes and converts them, with their groups. Python's femscalpel cracks, "
        "drills, cuts, merges, rounds and reshapes them.",
        epilog=f"Files that are read: {readable}. Written: {written}. {_STATUS}",
    )
    parser.add_argument("--version", action="version", version=f"femscalpel {__version__}")
    commands = parser.add_subparsers(dest="command", required=True, metavar="command")

    def add(name, run, text):
        command = commands.add_parser(name, help=text[0].lower() + text[1:], description=text + ".", epilog=_STATUS)
        command.set_defaults(run=run)
        command.add_argument("file", help="the mesh file")
        command.add_argument(
            "--mesh", metavar="NAME", type=_arguments.from_system, help="which mesh of a MED file that holds several"
        )
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
    found = info(_read(arguments))
    print(found.to_json() if arguments.json else found.to_text())
    return 0


def _check(arguments):
    found = check(_read(arguments))
    if arguments.json:
        print(json.dumps([f._asdict() for f in found], indent=1))
    else:
        print("\n".join(f"{f.level}: {f.text}" for f in found) or "nothing odd was found")
    return int(any(f.level == "error" for f in found))


def _convert(arguments):
    write(_read(arguments), arguments.output)
    return 0
