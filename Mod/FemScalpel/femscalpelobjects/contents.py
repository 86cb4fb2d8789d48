# SPDX-License-Identifier: LGPL-2.1-or-later
"""Digests of what the meshes of document objects are made from, to tell whether something is as it was before.

Those of meshes and shapes are kept until FreeCAD tells of a change.
"""

import hashlib
import io
import itertools
import zipfile

import FreeCAD

import femmesh_bridge
import femscalpel

from .following import FOLLOW_PROPERTIES, problem_of
from .geometry import shapes_of
from .ours import is_ours
from .whole import PROPERTY, whole_of

#: Properties that are no inputs; the first is FreeCAD's own, from 1.0 on, and changes with the mesh.
ASIDE = {
    "_ElementMapVersion",
    "FemMesh",
    "Label",
    "Label2",
    "Visibility",
    "ExpressionEngine",
    "Placement",
    "Proxy",
    PROPERTY,
    "Replaced",
    "ReplacedAdditions",
    *FOLLOW_PROPERTIES,
}
#: Properties whose change may be one of what digest_of() tells.
OF_CONTENTS = ("FemMesh", "Shape", "Placement")

_known = {}  # digest by document and object
_read = {}  # a mesh that was converted for its digest, until read_mesh() takes it
_numbers = itertools.count()
_changes = {}  # how often forget() was called, by document and object


def inputs_of(obj):
    """Digest of what the mesh of an object of FemScalpel is made from: its properties, and the meshes and shapes they
    lead to."""
    values = {
        name: _plain(obj, name, getattr(obj, name))
        for name in sorted(obj.PropertiesList)
        if name not in ASIDE and obj.getGroupOfProperty(name) != "Result"
    }
    return _digest(obj.Proxy.Type.encode(), repr(values).encode(), problem_of(obj).encode())


def surroundings_of(obj):
    """Digest of what else its mesh depends on: FreeCAD does not compute it anew when that changes. None where that
    cannot be told."""
    from .tool_properties import face_of

    try:
        shapes = shapes_of(obj)
        if getattr(obj, "ToolFace", None) is not None:
            shapes.append(("ToolFace", face_of(obj.ToolFace)))
        return _digest(*(part for name, shape in shapes for part in (name.encode(), _shape(shape))))
    except Exception:  # what is wrong with it is told when the mesh is made
        return None


def read_mesh(obj):
    """(femscalpel.Mesh of a mesh object, whether it is the whole of one that was imported: see whole.py). Raises as
    femmesh_bridge.from_femmesh()."""
    mesh = _read.pop(_key(obj), None)
    entire = whole_of(obj)
    if entire is not None:
        return entire, True
    return femmesh_bridge.from_femmesh(obj.FemMesh) if mesh is None else mesh, False


def digest_of(obj):
    """Digest of the mesh that a document object shows, or of its shape; of others it is empty."""
    if is_ours(obj) and obj.Proxy.shown is not None:
        return obj.Proxy.shown.token
    if obj.isDerivedFrom("Fem::FemMeshObject"):
        return _kept(obj, _mesh)
    if obj.isDerivedFrom("Part::Feature"):
        return _kept(obj, lambda part: _shape(part.Shape))
    shape = getattr(obj, "Shape", None)  # such as that of a link, which may change unheard
    return _shape(shape) if hasattr(shape, "exportBrepToString") else b""


def unique():
    """In place of a digest: like no other."""
    return f"number {next(_numbers)}".encode()


def changes_of(obj):
    """A number that is another one once the contents of an object may have changed."""
    return _changes.get(_key(obj), 0)


def learn(obj, mesh, digest, changes):
    """Takes the mesh of an object as read elsewhere, with its digest_of_mesh(), unless changes_of() is not what it was
    then."""
    if changes != changes_of(obj):
        return
    _known.setdefault(_key(obj), digest)
    _read.clear()
    _read[_key(obj)] = mesh


def unread(obj):
    """Nobody will ask for what learn() was told, for now."""
    _read.pop(_key(obj), None)


def forget(obj):
    """The contents of an object may have changed."""
    _changes[_key(obj)] = changes_of(obj) + 1
    _known.pop(_key(obj), None)
    _read.pop(_key(obj), None)


def forget_document(document):
    """A document is closed."""
    for kept in (_known, _read):
        for key in [key for key in kept if key[0] == document.Name]:
            del kept[key]


def _key(obj):
    return obj.Document.Name, obj.Name


def _kept(obj, digest):
    key = _key(obj)
    if key not in _known:
        _known[key] = digest(obj)
    return _known[key]


def _mesh(obj):
    if not obj.FemMesh.NodeCount:
        return b"empty"
    try:
        mesh = femmesh_bridge.from_femmesh(obj.FemMesh)
    except femscalpel.Error:
        return unique()
    _read.clear()  # one is enough: it is for the object that is computed now
    _read[_key(obj)] = mesh
    return digest_of_mesh(mesh)


def digest_of_mesh(mesh):
    """Of a femscalpel.Mesh: nodes, elements, numbers and groups."""
    parts = [mesh.points, mesh.node_ids]
    for name, nodes in mesh.cells.items():
        parts += [name.encode(), nodes, mesh.cell_ids[name]]
    for group in mesh.groups.all():
        parts += [f"{group.kind} {group.name}".encode(), group.ids]
    return _digest(*parts)


def _shape(shape):
    # A copy has no triangles: FreeCAD makes those when it first draws the shape.
    return b"" if shape.isNull() else _digest(shape.copy().exportBrepToString().encode())


def _digest(*parts):
    """Of bytes and arrays."""
    digest = hashlib.blake2b(digest_size=16)
    for part in parts:
        data = part if isinstance(part, bytes) else part.tobytes()
        digest.update(f"{len(data)} ".encode())
        digest.update(data)
    return digest.digest()


def _plain(obj, name, value):
    """The value of a property as Python's own types, so that its repr() says all of it."""
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    if isinstance(value, (list, tuple)):
        return [_plain(obj, name, v) for v in value]
    if isinstance(value, dict):
        return sorted((str(key), _plain(obj, name, v)) for key, v in value.items())
    if isinstance(value, FreeCAD.Vector):
        return tuple(value)
    if isinstance(value, FreeCAD.Placement):
        return tuple(value.Base), value.Rotation.Q
    if isinstance(value, FreeCAD.Units.Quantity):
        return value.Value
    if isinstance(value, FreeCAD.DocumentObject):
        return value.Document.Name, value.Name, digest_of(value)
    # As FreeCAD would save it, without the time that the archive holds.
    archive = zipfile.ZipFile(io.BytesIO(obj.dumpPropertyContent(name)))
    return [archive.read(member) for member in archive.namelist()]
