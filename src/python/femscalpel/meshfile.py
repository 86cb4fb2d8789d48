# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reading and writing mesh files."""

import os
from typing import Union

from . import _arguments, _engine
from .mesh import Mesh, check_mesh

Path = Union[str, "os.PathLike[str]"]


def _path(path) -> str:
    if not isinstance(path, (str, os.PathLike)):
        raise TypeError(f"path must be a string or a path object, not {_arguments.describe(path)}")
    return os.fsdecode(path)


def read(path: Path) -> Mesh:
    """Reads a mesh; the format follows the extension, case ignored.

    .med (Code_Aster, SALOME), .inp and .inp.gz (CalculiX, Abaqus). A mesh read from an .inp keeps every card
    of the input file, and writing it back to .inp keeps them in place.

    Raises :class:`femscalpel.ReadError`, which names the file and, for text, the line.
    """
    return Mesh._wrap(_engine.read(_path(path)))


def write(mesh: Mesh, path: Path) -> None:
    """Writes a mesh; the format follows the extension: .med, .inp, .inp.gz, or .vtu for ParaView.

    The file is complete or, after an error, what it was before.

    Raises :class:`femscalpel.WriteError` when the file cannot be written or its format cannot hold the mesh.
    """
    _engine.write(check_mesh(mesh), _path(path))
