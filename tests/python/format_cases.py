# SPDX-License-Identifier: LGPL-2.1-or-later
"""A closed loop through every pair of formats on models of other people: read, written in one format, read, written in
the other, read. Coordinates, numbers, elements and every group are the same after each step, or what differs is named
by the warning of the call that wrote it, or means the same in the other format (resources/docs/formats.md): faces of a
facet group are elements of the group of that name in MED, elements that are faces or edges of others are surfaces and
node sets in a deck.

    format_cases.py [--models N] [FILE or FOLDER...]

Without files: those of CalculiX's tests (calculix-ccx-test), FreeCAD's FEM tests and this build's meshes, as far as
installed; N of them, evenly chosen (default: all).
"""

import argparse
import collections
import itertools
import sys
import tempfile
import warnings
from pathlib import Path

import numpy as np

import femscalpel as fs
from mixed_meshes import FACES

CORNERS = {"vertex": 1, "line": 2, "triangle": 3, "quad": 4, "tetra": 4, "pyramid": 5, "wedge": 6, "hexahedron": 8}
FOLDERS = (
    "/usr/share/doc/calculix-ccx-test/examples/test",
    "/usr/share/freecad/Mod/Fem/femtest/data",
    "/usr/share/freecad/Mod/Mesh/App/TestData",
    Path(__file__).parents[2] / "build/release/tests/meshes",
    Path(__file__).parent / "files",
)
#: Larger files take long, and hold no other cards.
LARGEST = 2_000_000


def first_extensions():
    return [f.extensions[0] for f in fs.formats() if f.reads and f.writes]


def models_in(paths):
    """Files that are meshes by their ending, smaller than LARGEST; of folders without .dat, which is anything."""
    endings = {e for f in fs.formats() if f.reads for e in f.extensions}
    files = []
    for path in map(Path, paths):
        files += sorted(f for f in path.rglob("*") if f.suffix != ".dat") if path.is_dir() else [path]
    return [f for f in files if f.suffix.lower() in endings and f.stat().st_size <= LARGEST]


def same(a, b):
    return np.array_equal(np.asarray(a), np.asarray(b))


def side_of(kind, nodes, face):
    """The corners of a face as Facet counts it: of a shell first its two sides, then its edges."""
    base = kind.rstrip("0123456789")
    if base in FACES:
        return nodes[list(FACES[base][face - 1])]
    corners = nodes[: {"triangle": 3, "quad": 4}[base]]
    return corners if face < 3 else corners[[face - 3, (face - 2) % len(corners)]]


class Seen:
    """What a mesh holds, by numbers."""

    def __init__(self, mesh):
        self.mesh = mesh
        order = np.argsort(mesh.node_ids, kind="stable")
        self.numbers, self.points = mesh.node_ids[order], mesh.points[order]
        self.elements = {
            number: (kind, mesh.node_ids[nodes])
            for kind, cells in mesh.cells.items()
            for number, nodes in zip(mesh.cell_ids[kind].tolist(), cells)
        }
        self.groups = {
            (g.kind, g.name): {tuple(np.atleast_1d(member).tolist()) for member in g.ids} for g in mesh.groups.all()
        }

    def places(self, name):
        """Corners of what the groups of a name hold, each as a set of nodes."""
        out = {frozenset(n) for n in self.groups.get(("node", name), ())}
        for (number,) in self.groups.get(("element", name), ()):
            kind, nodes = self.elements[number]
            out.add(frozenset(nodes[: CORNERS[kind.rstrip("0123456789")]].tolist()))
        for number, face in self.groups.get(("facet", name), ()):
            out.add(frozenset(side_of(*self.elements[number], face).tolist()))
        return out


def means_the_same(before, after, name):
    """Whether all that the groups of a name held is in them still, if as another kind; edges and points as nodes."""
    held, nodes = after.places(name), {n for (n,) in after.groups.get(("node", name), ())}
    return all(place in held or len(place) < 3 and place <= nodes for place in before.places(name))


def differences(before, after):
    """(what, the words that a warning has to have) of all that is not the same."""
    before, after, out = Seen(before), Seen(after), []
    if not same(before.numbers, after.numbers):
        out.append(("numbers of nodes", "number"))
    elif not same(before.points, after.points):
        out.append(("coordinates", "coordinates"))
    changed = set()
    for key in {*before.groups, *after.groups}:
        if before.groups.get(key) != after.groups.get(key):
            changed.add(key[1])
            if not means_the_same(before, after, key[1]):
                out.append((f"{key[0]} group {key[1]!r}", f"'{key[1]}'"))
    in_changed = {
        n
        for seen in (before, after)
        for (kind, name), ids in seen.groups.items()
        if kind == "element" and name in changed
        for (n,) in ids
    }
    for number in {*before.elements, *after.elements}:
        (kind, nodes), (new_kind, new_nodes) = (s.elements.get(number, ("", [])) for s in (before, after))
        if (kind != new_kind or not same(nodes, new_nodes)) and number not in in_changed:
            out.append((f"element {number}, {kind or new_kind}", f"type {kind}"))
    if before.mesh.unit != after.mesh.unit:
        out.append(("unit", "unit"))
    for name in {f.name for f in before.mesh.fields} ^ {f.name for f in after.mesh.fields}:
        out.append((f"field {name!r}", "field"))
    return out


def passed_through(mesh, path, faults, label):
    """What is read of what is written of a mesh; what differs without a word goes to `faults`."""
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        fs.write(mesh, path)
    words = "\n".join(str(w.message) for w in told)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        back = fs.read(path)
    faults += [f"{label}: {what} lost without a word" for what, word in differences(mesh, back) if word not in words]
    return back


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--models", type=int, help="how many, evenly chosen")
    parser.add_argument("paths", nargs="*")
    arguments = parser.parse_args()
    files = models_in(arguments.paths or FOLDERS)
    if arguments.models:
        files = [files[int(k)] for k in np.linspace(0, len(files) - 1, min(arguments.models, len(files)))]
    extensions, unread, refused, faults, pairs = first_extensions(), [], collections.Counter(), [], 0
    with tempfile.TemporaryDirectory() as folder:
        for file in files:
            try:
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    mesh = fs.read(file)
            except fs.Error as error:
                unread.append(str(error))
                continue
            once = {}
            for first in extensions:
                try:
                    once[first] = passed_through(mesh, f"{folder}/one{first}", faults, f"{file}: to {first}")
                except fs.Error as error:
                    refused[f"{first}: {str(error).partition(': ')[2]}"] += 1
            for first, second in itertools.product(once, extensions):
                label = f"{file}: from {first} to {second}"
                try:
                    passed_through(once[first], f"{folder}/two{second}", faults, label)
                    pairs += 1
                except fs.Error as error:
                    refused[f"{second}: {str(error).partition(': ')[2]}"] += 1
    for text in unread:
        print("not read:", text)
    for text, count in refused.most_common():
        print(f"refused {count} times: {text}")
    for text in faults:
        print("FAULT", text)
    print(
        f"{len(files)} models, {len(unread)} not read; {pairs} pairs of formats closed, "
        f"{sum(refused.values())} refused; "
        f"{len(faults)} differences that no warning names"
    )
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
