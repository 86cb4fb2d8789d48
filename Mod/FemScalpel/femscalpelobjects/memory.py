# SPDX-License-Identifier: LGPL-2.1-or-later
"""What objects have computed, by what they have computed it from: kept while FreeCAD runs, up to a limit."""

from collections import OrderedDict
from dataclasses import dataclass
from typing import Any, Dict, Optional

#: Nodes and elements of all meshes that are kept; some 300 bytes each.
LIMIT = 4_000_000


@dataclass(frozen=True)
class Shown:
    """Which mesh an object holds."""

    inputs: Optional[bytes]  #: what it was made from, by contents.inputs_of(); None: of an object that was cleared
    token: bytes  #: says which it is
    loaded: bool = False  #: whether it came from a file, and so is not kept


@dataclass(frozen=True)
class Made:
    """The outcome of computing an object."""

    inputs: bytes
    surroundings: Optional[bytes]  #: by contents.surroundings_of(); None: good for undo alone
    token: bytes
    femmesh: Any = None  #: None where there is none
    results: Optional[Dict[str, Any]] = None  #: values of the properties of the group Result
    report: Any = None
    error: str = ""  #: of a failure
    picture: Any = None  #: in the window, femscalpelgui.view.crack_lines.CrackShape
    whole: Any = None  #: femscalpel.Mesh with what its FemMesh does not hold, where the source has that: see whole.py
    parting: Any = None  #: pieces.Parting, where the mesh is in more pieces than the source

    @property
    def weight(self):
        """Nodes and elements."""
        mesh, rest = self.femmesh, self.whole
        count = 0 if mesh is None else mesh.NodeCount + mesh.EdgeCount + mesh.FaceCount + mesh.VolumeCount
        return 1 + count + (0 if rest is None else rest.node_count + rest.cell_count)


#: Of an object that cannot be computed as what it is made from has no mesh: it has none, and no error of its own.
CLEARED = Made(b"", None, b"none")


class Memory:
    """The newest outcomes, by document and inputs."""

    def __init__(self, limit=LIMIT):
        self._limit, self._weight = limit, 0
        self._made = OrderedDict()

    def __len__(self):
        return len(self._made)

    def keep(self, document, made):
        """Keeps an outcome of an object of a document, in place of one of the same inputs; the eldest go when there
        are too many."""
        self._drop((document.Name, made.inputs))
        self._made[document.Name, made.inputs] = made
        self._weight += made.weight
        while self._weight > self._limit and len(self._made) > 1:
            self._drop(next(iter(self._made)))

    def of(self, document, inputs):
        """The Made of these inputs, or None."""
        made = self._made.get((document.Name, inputs))
        if made is not None:
            self._made.move_to_end((document.Name, inputs))
        return made

    def forget(self, document):
        """Drops all of a document."""
        for key in [key for key in self._made if key[0] == document.Name]:
            self._drop(key)

    def _drop(self, key):
        made = self._made.pop(key, None)
        if made is not None:
            self._weight -= made.weight


#: That of all objects.
memory = Memory()
