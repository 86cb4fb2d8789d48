# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reading and writing mesh files."""

import os
import warnings
from typing import List, NamedTuple, Optional, Tuple, Union

from . import _arguments, _engine
from .mesh import Mesh, check_mesh

Path = Union[str, "os.PathLike[str]"]


class Format(NamedTuple):
    """A file format, see :func:`formats`."""

    #: For file dialogs, in every language.
    title: str
    #: In lower case, with the dot, the usual one first: (".inp", ".inp.gz").
    extensions: Tuple[str, ...]
    #: Whether :func:`read` knows it.
    reads: bool
    #: Whether :func:`write` knows it.
    writes: bool


def formats() -> List[Format]:
    """The file formats there are."""
    return [Format(*row) for row in _engine.formats()]


#: How the engine ends what it says of cards that name nodes or elements by numbers that nobody has.
_OF_NOBODY = "that the deck does not define; kept as it is, correct the line"


def read(path: Path, mesh: Optional[str] = None) -> Mesh:
    """Reads a mesh; the format follows the extension, case ignored; :func:`formats` lists them.

    A mesh read from an .inp (CalculiX, Abaqus) keeps every card of the input file, and writing it back to .inp keeps
    them in place. A deck of parts and instances (Abaqus/CAE) becomes a flat one, with a UserWarning that says how its
    instances are numbered (:attr:`Mesh.instances`) and what else there was to tell; of other decks a UserWarning tells
    of cards with numbers that nobody has, and :attr:`Mesh.input_warnings` of the rest. What a file of another format
    holds beside a mesh with groups and, in a .med, fields is told in a UserWarning, too. So is text that is not UTF-8:
    it is read as Windows-1252, and names are UTF-8 from then on, also in what is written. Of a .med with several meshes
    `mesh` names the one; without it the first is read, with a UserWarning that lists them, as what is written later
    holds that one alone (:func:`meshes_in`).

    Raises :class:`femscalpel.ReadError`, which names the file and, for text, the line.
    """
    file = _arguments.path(path, "path")
    out = Mesh._wrap(_engine.read(file, "" if mesh is None else _arguments.text(mesh, "mesh")))
    told = out.input_warnings
    if out.has_deck and not out.instances:
        remarks = out._engine_mesh.remarks
        told = [*remarks, *(text for text in told if text.endswith(_OF_NOBODY) and text not in remarks)]
    if told:
        warnings.warn("\n".join(told), stacklevel=2)
    names = _engine.meshes_in(file) if mesh is None else []
    if len(names) > 1:
        listed = ", ".join(repr(name) for name in names)
        warnings.warn(
            f"{_arguments.from_system(file)} holds {len(names)} meshes: {listed}. The first was read; mesh= names "
            "another",
            stacklevel=2,
        )
    return out


def meshes_in(path: Path) -> List[str]:
    """The names of the meshes in a file; none where files of its format hold one mesh, without a name.

    Raises :class:`femscalpel.ReadError` as :func:`read` does.
    """
    return _engine.meshes_in(_arguments.path(path, "path"))


def write(mesh: Mesh, path: Path) -> None:
    """Writes a mesh; the format follows the extension, case ignored; :func:`formats` lists them.

    The file is complete or, after an error, what it was before. What a format cannot hold - facet groups, the cards of
    a deck (but in .inp), the unit and fields (but in .med) - is told in a UserWarning, and so are sets whose groups are
    not in the mesh any more, but which cards of the deck still name.

    Raises :class:`femscalpel.WriteError` when the file cannot be written or its format cannot hold the mesh.
    """
    file = _arguments.path(path, "path")
    _engine.write(check_mesh(mesh), file)
    name = _arguments.from_system(file)
    lost = _engine.losses(mesh._engine_mesh, file)
    if lost:
        warnings.warn(f"{name} does not hold {'; '.join(lost)}: files of this kind cannot", stacklevel=2)
    for loose in _engine.loose_ends(mesh._engine_mesh, file):
        warnings.warn(f"{name}: {loose}", stacklevel=2)


def convert(source: Path, target: Path, mesh: Optional[str] = None) -> None:
    """Reads a mesh and writes it in another format, with its numbers and groups: :func:`read`, then :func:`write`, with
    their warnings of what is odd in the one file and what the other does not hold. `mesh` names one of several in a
    .med.

    Raises :class:`femscalpel.ReadError` and :class:`femscalpel.WriteError`; a file that was at `target` is there still,
    then.
    """
    write(read(source, mesh), target)
