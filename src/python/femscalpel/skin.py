# SPDX-License-Identifier: LGPL-2.1-or-later
"""The shape a mesh was made from."""

import os

from . import _arguments, _engine


class Shape(_engine.CadShape):
    """The CAD shape a mesh was made from, by OpenCASCADE, for the operators' option ``skin``.

    Give the same object to several operators: finding one's way on the shape is prepared once.

    Parameters
    ----------
    source : path, FreeCAD shape, or text
        A ``.step``, ``.stp``, ``.brep`` or ``.brp`` file, a ``Part.Shape``, or the text of a ``.brep`` file. It must be
        where the mesh is, and in its unit; lengths of a STEP file are taken in millimetres.

    Raises
    ------
    ReadError
        The file cannot be read.
    ToolError
        There is no face in it.
    """

    def __init__(self, source):
        if hasattr(source, "exportBrepToString"):
            super().__init__(source.exportBrepToString().encode())
        elif isinstance(source, str) and "\n" in source:
            super().__init__(_arguments.text(source, "source").encode())
        elif isinstance(source, (str, os.PathLike)):
            super().__init__(_arguments.path(source, "source"))
        else:
            raise _arguments.about(
                "source", TypeError(f"source must be a path or a FreeCAD shape, not {_arguments.describe(source)}")
            )

    def __repr__(self) -> str:
        return f"Shape({self.face_count} faces, {self.edge_count} edges)"


def check_skin(skin):
    """`skin` as a Shape, or None; errors are about the parameter of that name."""
    if skin is None or isinstance(skin, Shape):
        return skin
    if not (isinstance(skin, (str, os.PathLike)) or hasattr(skin, "exportBrepToString")):
        raise _arguments.about(
            "skin",
            TypeError(f"skin must be a path, a FreeCAD shape or a femscalpel.Shape, not {_arguments.describe(skin)}"),
        )
    try:
        return Shape(skin)
    except (TypeError, ValueError) as error:
        raise _arguments.about("skin", error) from None
    except _engine.Error as error:
        about_skin = type(error)(f"skin: {error}")
        about_skin._parameter = "skin"
        raise about_skin from None
