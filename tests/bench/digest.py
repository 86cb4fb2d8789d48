#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whether results are the same to the last bit: hundreds of operations of every kind, each with a digest of its result.

    PYTHONPATH=build/release/Mod/FemScalpel /usr/bin/python3 tests/bench/digest.py

prints one line for each operation: its name and a digest of coordinates, numbers, connectivity, groups, the deck that
is written, the report (without the seconds) and warnings, or of the error; and one digest of all at the end. For
changes that must leave results as they are:

    ... digest.py --details > before.txt
    ... digest.py --compare before.txt      which operations differ, and in which part
    ... digest.py --record                  writes digest.txt, with which tests/python/test_digest.py compares

Results do not depend on time, paths, the order of operations or the number of processes. They may depend on the
compiler and on the processor: nobody promises the last bit of floating-point numbers. The head of digest.txt says what
it was made with; elsewhere nothing can be compared. Input files that Gmsh or a package made have digests of their own
there: where one is another, or missing, its operations are left out.
"""

import argparse
import collections
import concurrent.futures
import concurrent.futures.process
import dataclasses
import functools
import gzip
import hashlib
import json
import math
import multiprocessing
import os
import pathlib
import platform
import re
import subprocess
import sys
import tempfile
import time
import warnings
import zlib
from dataclasses import dataclass
from typing import Any, Callable, Tuple

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
RECORDED = HERE / "digest.txt"
SHAPES = HERE.parent / "python" / "shapes"
sys.path.insert(0, str(HERE.parent / "python"))

import femscalpel as fs  # noqa: E402
import merge_parts as parts  # noqa: E402
import rounding_cases  # noqa: E402
import test_calculix_decks as ccx  # noqa: E402
import test_decks_after_removal as removal  # noqa: E402
import test_folded_input as folded  # noqa: E402
import test_messages as messages  # noqa: E402
import test_related_nodes as related  # noqa: E402
import test_second_order_shells as curved  # noqa: E402
import test_shells as shells  # noqa: E402
import test_surface_sets as surfaces  # noqa: E402
from meshes import box_with_groups, grid_box, quadratic  # noqa: E402

MESHES = rounding_cases.MESHES
#: How the names of temporary folders begin.
FOLDER = "femscalpel-digest-"
X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)

# -------------------------------------------------------------------------------------------------------------- digests


def short(data) -> str:
    return hashlib.blake2b(data, digest_size=5).hexdigest()


def encoded(value) -> bytes:
    """Bytes that are equal when values are equal to the last bit, whatever the order of a dict."""
    if isinstance(value, np.ndarray):
        return f"{value.dtype}{value.shape}".encode() + np.ascontiguousarray(value).tobytes()
    if isinstance(value, np.generic):
        return encoded(value.item())
    if isinstance(value, dict):
        return b"{" + b",".join(encoded(k) + b":" + encoded(value[k]) for k in sorted(value)) + b"}"
    if isinstance(value, (list, tuple)):
        return b"[" + b",".join(map(encoded, value)) + b"]"
    if dataclasses.is_dataclass(value):
        return encoded({f.name: getattr(value, f.name) for f in dataclasses.fields(value)})
    if value is None or isinstance(value, (bool, int, float, str)):
        return repr(value).encode()
    raise TypeError(f"no digest of {type(value)}")


class Outcome:
    """Parts of what an operation gave, each a hash."""

    def __init__(self, folder):
        self.folder, self.hashes = folder, {}

    def add(self, part, data):
        data = data if isinstance(data, bytes) else encoded(data)
        self.hashes.setdefault(part, hashlib.blake2b(digest_size=5)).update(data)

    def text(self, text) -> str:
        """With file names as they are, but not the folders they are in."""
        for folder in (MESHES, ccx.DECKS, SHAPES):
            text = text.replace(f"{folder}/", "").replace(str(folder), "")
        return re.sub(rf"{re.escape(tempfile.gettempdir())}/{FOLDER}\w+/?", "", text)

    def add_mesh(self, mesh, deck=True):
        self.add("mesh", [mesh.points, mesh.node_ids, mesh.cells, mesh.cell_ids, mesh.name, mesh.unit])
        self.add("groups", [(g.name, g.kind, g.ids) for g in mesh.groups.all()])
        if deck:
            try:
                fs.write(mesh, self.folder / "out.inp")
            except fs.Error as error:
                self.add("deck", self.text(str(error)))
            else:
                self.add("deck", (self.folder / "out.inp").read_bytes())

    def add_report(self, report):
        # Instances are the input's; but for decks of parts there are none.
        left_out = ("seconds",) if report.instances else ("seconds", "instances")
        fields = {f.name: getattr(report, f.name) for f in dataclasses.fields(report) if f.name not in left_out}
        if not fields["straightened"].count:
            del fields["straightened"]
        if not fields["welded_pairs"]:
            del fields["welded_pairs"]
        if not fields["converted"]:
            del fields["converted"]  # says nothing of meshes of simplices
        if not fields["beams_cut"]:
            del fields["beams_cut"]
        self.add("warnings", self.text(repr(fields.pop("warnings"))))
        self.add("report", fields)
        lines = [line for line in report.to_text().splitlines() if not line.startswith("  seconds ")]
        self.add("text", self.text("\n".join(lines)))

    def take(self, value):
        """Adds a Result, a Mesh, an error, or data; or a list of these."""
        if isinstance(value, fs.Result):
            self.add_mesh(value.mesh)
            self.add_report(value.report)
        elif isinstance(value, fs.Mesh):
            self.add_mesh(value)
        elif isinstance(value, Exception):
            self.add("error", self.text(f"{type(value).__name__}: {value}"))
        elif isinstance(value, list):
            for v in value:
                self.take(v)
        elif isinstance(value, str):
            self.add("data", self.text(value))
        else:
            self.add("data", value)


FAULTS = (fs.Error, TypeError, ValueError, KeyError)


def tried(call):
    """What it returns, or its error."""
    try:
        return call()
    except FAULTS as error:
        return error


# --------------------------------------------------------------------------------------------------------------- meshes


@dataclass(frozen=True)
class Subject:
    """A mesh to operate on."""

    make: Callable[[], fs.Mesh]
    edge: Any = 1.0  #: about the length of its edges; None: so many to its size
    file: Any = None  #: that it is read from, if others made it


def _file(name, edge):
    path = MESHES / f"{name}.inp"
    return Subject(lambda: fs.read(path), edge, path)


def _ccx(name):
    path = next(
        (p for p in (ccx.DECKS / f"{name}.inp", ccx.DECKS / f"{name}.inp.gz") if p.exists()), ccx.DECKS / f"{name}.inp"
    )
    return Subject(lambda: fs.read(path), None, path)


def _deck(write, *arguments):
    """What one of the tests writes and reads."""

    def make():
        with tempfile.TemporaryDirectory(prefix=FOLDER) as folder:
            return write(pathlib.Path(folder) / "deck.inp", *arguments)

    return Subject(make, None)


def _made(name, edge):
    return Subject(rounding_cases.SUBJECTS[name][0], edge)


def _numbered_beams():
    """Tetrahedra with segments on some of their edges, a vertex, facet groups, and sparse numbers."""
    box = grid_box((4, 3, 3), (4.0, 3.0, 3.0))
    lines = [[k, k + 1] for k in range(4, 7)] + [[0, 16], [16, 32]]
    groups = {
        "BEAMS": ("element", [9001, 9002, 9003, 9004, 9005]),
        "SIDE": ("facet", [[1007, 1], [1014, 2], [1021, 3]]),
        "MIX": ("element", [1007, 1014, 9002, 9900]),
    }
    return fs.Mesh(
        box.points,
        {"tetra": box.cells["tetra"], "line": lines, "vertex": [[40]]},
        3 * np.arange(box.node_count) + 5,
        {"tetra": 1000 + 7 * np.arange(1, len(box.cells["tetra"]) + 1), "line": range(9001, 9006), "vertex": [9900]},
        groups,
        name="beams",
    )


def _with_brick():
    """Tetrahedra with a hexahedron beside them."""
    box = grid_box()
    n, corner = box.node_count, {tuple(p): i for i, p in enumerate(box.points.tolist())}
    old = [corner[6.0, y, z] for z in (0.0, 4.0) for y in (0.0, 5.0)]
    new = [(7.5, y, z) for z in (0.0, 4.0) for y in (0.0, 5.0)]
    brick = [old[0], n, n + 1, old[1], old[2], n + 2, n + 3, old[3]]
    return fs.Mesh(np.concatenate([box.points, new]), {"tetra": box.cells["tetra"], "hexahedron": [brick]})


SUBJECTS = {
    "two_boxes": _file("two_boxes", 1.0),
    "l_shape": _file("l_shape", 0.9),
    "flanged": _file("flanged_cylinder", 1.0),
    "flanged_coarse": _file("flanged_cylinder_coarse", 3.0),
    "elbow": _file("quadratic_elbow", 1.0),
    "caisson": _file("caisson_shell", 30.0),
    "two_boxes_39k": _file("two_boxes_39k", 0.5),
    "two_boxes_505k": _file("two_boxes_505k", 0.22),
    "plate": _made("plate", 0.08),
    "uneven_plate": _made("uneven plate", 0.08),
    "plate2": _made("plate, second order", 0.08),
    "box": _made("box", 0.12),
    "uneven_box": _made("uneven box", 0.12),
    "box2": _made("box, second order", 0.12),
    "group_box": Subject(box_with_groups, 1.2),
    "fine_box": Subject(lambda: grid_box((15, 13, 11), (6, 5, 4)), 0.4),
    "fine_box2": Subject(lambda: quadratic(grid_box((9, 8, 7), (6, 5, 4))), 0.65),
    "tube2": Subject(curved.tube, 0.5),
    "flat2": Subject(curved.flat, 0.25),
    "folded_box2": Subject(lambda: folded.box()[0], 1.0),
    "folded_sheet2": Subject(lambda: folded.sheet()[0], 0.8),
    "spoilt_box2": Subject(lambda: folded.box(0.6)[0], 1.0),
    "junction": Subject(lambda: shells.junction(shells.FLOOR, shells.WEB)),
    "junction3": Subject(lambda: shells.junction(shells.FLOOR, shells.WEB, shells.KEEL)),
    "beams": Subject(_numbered_beams),
    "brick": Subject(_with_brick),
    "plates": Subject(messages.two_plates),
    "bordered": Subject(lambda: messages.plate_with_groups(LEFT=lambda m: m[:, 0] < 3)),
    "blocks": _deck(removal.blocks),
    "periodic": _deck(related.periodic_cell, 1),
    "periodic2": _deck(related.periodic_cell, 2),
    "loaded": _deck(surfaces.deck, False),
    "helper_sets": _deck(surfaces.deck, True),
    **{f"ccx_{name}": _ccx(name) for name in (*ccx.NORMALS, "beam20p")},
}


@functools.lru_cache(maxsize=None)
def subject(name):
    return SUBJECTS[name].make()


# ---------------------------------------------------------------------------------------------------------------- tools
#
# By uniform random numbers and the four operations only, rounded: the same tools everywhere.


def scaled(v, factor):
    return tuple(factor * x for x in v)


def plus(a, b):
    return tuple(x + y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(v):
    return scaled(v, 1 / math.sqrt(sum(x * x for x in v)))


class Maker:
    """Random tools for a mesh; which, is told by a text."""

    def __init__(self, mesh, edge, seed):
        self.random = np.random.default_rng(zlib.crc32(seed.encode()))
        used = mesh.points[np.unique(np.concatenate([c.ravel() for c in mesh.cells.values()]))]
        cut = ccx.cut_part(mesh)  # of a deck with elements of other kinds
        points = cut if len(cut) else used
        self.low, self.high = points.min(axis=0), points.max(axis=0)
        self.edge = edge or round(float(sum(self.high - self.low)) / 24, 3)
        self.flat = self.low[2] == self.high[2]

    def number(self, low, high):
        return round(float(self.random.uniform(low, high)), 6)

    def length(self, low, high):
        return round(self.edge * self.number(low, high), 6)

    def place(self):
        return tuple(round(float(a + self.number(0.3, 0.7) * (b - a)), 6) for a, b in zip(self.low, self.high))

    def direction(self):
        while True:
            v = tuple(self.number(-1, 1) for _ in range(2 if self.flat else 3)) + ((0.0,) if self.flat else ())
            if 0.1 < sum(x * x for x in v) < 1:
                return v

    def axis(self):
        return Z if self.flat else self.direction()

    def plane(self):
        return fs.Plane(self.place(), self.direction())

    def grid_plane(self):
        """Along an axis, where nodes may be."""
        k = int(self.random.integers(2 if self.flat else 3))
        return fs.Plane(scaled(plus(self.low, self.high), 0.5), (X, Y, Z)[k])

    def cylinder(self):
        return fs.Cylinder(self.place(), self.axis(), self.length(1.5, 2.8))

    def thin_cylinder(self):
        return fs.Cylinder(self.place(), self.axis(), self.length(0.4, 0.7))

    def wide_cylinder(self):
        away = self.edge * 20
        return fs.Cylinder(plus(self.place(), (0.0, -away, 0.0)), Z, away)

    def sphere(self):
        return fs.Sphere(self.place(), self.length(1.6, 3))

    def torus(self):
        return fs.Torus(self.place(), self.axis(), self.length(3, 4), self.length(1.2, 1.8))

    def cone(self):
        return fs.Cone(self.place(), self.axis(), self.length(1.5, 2.5), self.number(3, 12))

    def face(self):
        return fs.Face(SHAPES / "plane.step")

    def face_brep(self):
        return fs.Face(SHAPES / "plane.brep")

    def part(self, kind):
        """(plane or cylinder, part of it)."""
        if kind.startswith("cylinder"):
            start = self.number(-180, 0)
            angles = ((start, start + self.number(60, 200)), (0.3, 0.5, 0.8)) if kind == "cylinder_angles" else ()
            tool = fs.Cylinder(self.place(), self.axis(), self.length(2.5, 3.5))
            return tool, fs.CylinderPart((self.length(-3, -1), self.length(1, 3)), *angles)
        plane, normal = (center := self.place()), self.direction()
        u = unit(cross(normal, Z if self.flat else (0.3, 0.5, 0.8)))
        v = unit(cross(normal, u))
        size = self.length(2, 3.5)
        corners = {
            "square": ((-1, -1), (1, -1), (1, 1), (-1, 1)),
            "corner": ((-1, -1), (1, -1), (1, 0.1), (0.1, 0.1), (0.1, 1), (-1, 1)),
            "star": ((-1, -0.8), (0, -0.3), (1.1, -1), (0.4, 0.2), (0.1, 1.3), (-0.4, 0.3)),
        }
        if kind in corners:
            within = fs.Polygon(
                [plus(center, plus(scaled(u, a * size), scaled(v, b * size))) for a, b in corners[kind]]
            )
        else:
            within = {
                "disk": lambda: fs.Disk(center, size),
                "small_disk": lambda: fs.Disk(center, round(size / 6, 6)),
                "half": lambda: fs.HalfPlane(center, u),
                "ellipse": lambda: fs.Ellipse(center, (size, round(0.6 * size, 6)), plus(u, v)),
                "rim": lambda: fs.Disk(plus(center, scaled(u, 4 * size)), round(4.6 * size, 6)),
            }[kind]()
        return fs.Plane(plane, normal), within


# ----------------------------------------------------------------------------------------------------------- operations


@dataclass(frozen=True)
class Operation:
    name: str
    subject: str
    run: Callable[[fs.Mesh, Maker, pathlib.Path], Any]
    others: Tuple[str, ...] = ()  #: subjects that it may take instead

    @property
    def files(self):
        """Paths of its input files that others made."""
        return {SUBJECTS[s].file for s in (self.subject, *self.others)} - {None}

    @property
    def missing(self):
        return [path for path in self.files if not path.exists()]


def first_group(mesh):
    return next(g.name for g in mesh.groups.all() if g.kind == "element")


#: Options that all operators have, by name; values that depend on the mesh are functions of it and its edges' length.
OPTIONS = {
    "": {},
    "one_ring": {"transition": 1},
    "four_rings": {"transition": 4},
    "sharp": {"feature_angle": 75.0},
    "blunt": {"feature_angle": 8.0},
    "none_kept": {"preserve": ()},
    "one_kept": {"preserve": lambda mesh, edge: [first_group(mesh)]},
    "strict": {"strict": True},
    "preview": {"band_only": True},
    "never_refined": {"refine": False},
    "refined": {"refine": lambda mesh, edge: 0.6 * edge},
    "deform": {"method": "deform"},
    "deform4": {"method": "deform", "transition": 4, "preserve": ()},
    "named": {"name": "LIP.7-x"},
}


def options_for(name, mesh, edge):
    return {k: v(mesh, edge) if callable(v) else v for k, v in OPTIONS[name].items()}


def _crack(tool, option=""):
    return lambda mesh, make, folder: fs.crack(mesh, getattr(make, tool)(), **options_for(option, mesh, make.edge))


def _within(kind, option=""):
    def run(mesh, make, folder):
        tool, within = make.part(kind)
        return fs.crack(mesh, tool, within=within, **options_for(option, mesh, make.edge))

    return run


def _drill(tools, option="", depth=None):
    def run(mesh, make, folder):
        made = [getattr(make, t)() for t in tools.split("+")]
        return fs.drill(
            mesh,
            made[0] if len(made) == 1 else made,
            depth=None if depth is None else round(depth * make.edge, 6),
            **options_for(option, mesh, make.edge),
        )

    return run


def _cut(kind, option=""):
    def run(mesh, make, folder):
        place, normal, width = make.place(), make.direction(), make.length(0.3, 1.6)
        kwargs = options_for(option, mesh, make.edge)
        if kind == "notch":
            low = plus(place, scaled(normal, -0.5 * make.edge))
            tilted = [plus(scaled(normal, s), scaled(cross(normal, Z if make.flat else X), 0.3)) for s in (1, -1)]
            return fs.cut(mesh, fs.Plane(place, tilted[0]), other=fs.Plane(low, tilted[1]), **kwargs)
        bottom = {
            "slot": lambda: None,
            "saw": lambda: fs.Plane(place, cross(normal, (0.3, 0.5, 0.8))),
            "disk_saw": lambda: fs.Cylinder(place, normal, 3 * make.edge),
        }[kind]()
        return fs.cut(mesh, fs.Plane(place, normal), width=width, bottom=bottom, **kwargs)

    return run


#: What refine() is called with: what near, and options.
REFINEMENTS = {
    "plane": ("plane", {}),
    "cylinder": ("cylinder", {"gradation": 1.0}),
    "tools": ("sphere+plane", {"gradation": 0.8, "relax": False}),
    "point": ("point", {"reach": 1.0}),
    "points": ("points", {"feature_angle": 10.0, "gradation": 0.7}),
    "all": ("point", {"gradation": 0.0, "size": 0.8}),
    "too_many": ("plane", {"max_elements": 300}),
    "nothing": ("torus", {"size": 9.0}),
}


def _refine(kind):
    def run(mesh, make, folder):
        what, options = REFINEMENTS[kind]
        options = dict(options)
        size = round(options.pop("size", 0.6) * make.edge, 6)
        if "reach" in options:
            options["reach"] *= make.edge
        if what.startswith("point"):
            near = np.array([make.place() for _ in range(3 if what == "points" else 1)])
        else:
            near = [getattr(make, t)() for t in what.split("+")]
        return fs.refine(mesh, near, size, **options)

    return run


#: What reshape() is called with: the group, how it is moved, in edges.
WALLS = {
    "face": lambda mesh, make: fs.reshape(mesh, "END_RIGHT", by=(1.5 * make.edge, 0, 0)),
    "pressed": lambda mesh, make: fs.reshape(mesh, "END_LEFT", by=(2.5 * make.edge, 0, 0)),
    "border": lambda mesh, make: fs.reshape(mesh, "GLUE", onto=fs.Plane((10.5, 0, 0), (1, 0.05, 0))),
    "head": lambda mesh, make: fs.reshape(mesh, "HEAD", by=(0, 0, 2)),
    "stem": lambda mesh, make: fs.reshape(mesh, "Surface1", scale=(1.2, (0, 0, 0))),
    "inlet": lambda mesh, make: fs.reshape(mesh, "INLET", by=(0, -1.5, 0)),
    "bore": lambda mesh, make: fs.reshape(mesh, "BORE", scale=(1.1, (0, 0, 0))),
    "too_far": lambda mesh, make: fs.reshape(mesh, "END_RIGHT", by=(-25, 0, 0)),
}


def _reshape(kind):
    return lambda mesh, make, folder: WALLS[kind](mesh, make)


def _rounding(number):
    """A case of rounding_cases: tools at small distances from nodes, rounded coordinates."""

    def run(mesh, make, folder):
        case = rounding_cases.case(number)
        session = rounding_cases.subject(case.subject, case.rounding).session
        return getattr(session, case.operation)(case.tool, **case.options)

    return run


def _skin(operation, shape):
    """With the CAD shape the mesh was made from."""
    path = SHAPES / f"{shape}.brep"

    def run(mesh, make, folder):
        calls = {
            "crack": lambda: fs.crack(mesh, make.plane(), skin=path),
            "drill": lambda: fs.drill(mesh, make.cylinder(), skin=fs.Shape(path)),
            "cut": lambda: fs.cut(mesh, make.plane(), width=0.5 * make.edge, skin=path.read_text()),
            "refine": lambda: fs.refine(mesh, make.plane(), 0.7 * make.edge, skin=path),
            "within": lambda: (lambda part: fs.crack(mesh, part[0], within=part[1], skin=path))(make.part("rim")),
        }
        return calls[operation]()

    return run


def _session(mesh, make, folder):
    """One session for all operators; its mesh stays what it was."""
    session = fs.Scalpel(mesh)
    plane = make.plane()
    part = make.part("disk") if not make.flat else make.part("half")
    calls = [
        lambda: session.crack(plane, band_only=True),
        lambda: session.crack(plane),
        lambda: session.crack(part[0], within=part[1], name="IN"),
        lambda: session.drill(make.cylinder(), band_only=True),
        lambda: session.drill(make.wide_cylinder()),
        lambda: session.cut(make.plane(), width=0.5 * make.edge, band_only=True),
        lambda: session.crack(make.sphere(), band_only=True),
        lambda: session.crack(plane, method="deform"),
        lambda: session.crack(plane),
    ]
    return [tried(call) for call in calls] + [session.mesh]


def _chain(mesh, make, folder):
    """Operation after operation, through files of both formats."""
    out, planes = [], [make.plane() for _ in range(3)]
    part = make.part("half" if make.flat else "ellipse")
    calls = [
        lambda m: fs.crack(m, planes[0], name="A"),
        lambda m: fs.crack(m, part[0], within=part[1], name="B"),
        lambda m: fs.drill(m, make.cylinder()),
        lambda m: fs.cut(m, planes[1], width=0.4 * make.edge),
        lambda m: fs.refine(m, planes[2], 0.7 * make.edge),
        lambda m: fs.crack(m, planes[2], name="C", preserve=()),
    ]
    for k, call in enumerate(calls):
        result = tried(lambda: call(mesh))
        out.append(result)
        if isinstance(result, fs.Result):
            mesh = result.mesh
        if k in (0, 2):
            path = folder / ("between.med" if k == 2 else "between.inp")
            written = tried(lambda: fs.write(mesh, path))
            if written is None:
                mesh = fs.read(path)
            else:
                out.append(written)
    return out


def _cross(within):
    """A crack through a crack."""

    def run(mesh, make, folder):
        tool, part = make.part(within)
        first = fs.crack(mesh, tool, within=part, name="A")
        second = fs.crack(first.mesh, fs.Plane(tool.origin, make.direction()), name="B")
        hole = fs.Cylinder(tool.origin, make.axis(), 2 * make.edge)
        return [first, second, tried(lambda: fs.drill(second.mesh, hole))]

    return run


def _files(mesh, make, folder):
    """All formats of the mesh as it is and as cracked: as bytes, and what is read back; MED only as read back."""
    out = []
    for k, m in enumerate((mesh, tried(lambda: fs.crack(mesh, make.plane()).mesh))):
        if not isinstance(m, fs.Mesh):
            out.append(m)
            continue
        for suffix in (".inp", ".inp.gz", ".vtu", ".med", ".msh", ".unv"):
            path = folder / f"file{k}{suffix}"
            error = tried(lambda: fs.write(m, path))
            if error is not None:
                out.append(error)
                continue
            if suffix in (".inp", ".vtu", ".msh", ".unv"):
                out.append(short(path.read_bytes()))
            if suffix == ".inp.gz":
                out.append(short(gzip.decompress(path.read_bytes())))
            out.append(fs.read(path))
    return out


def _knowledge(mesh, make, folder):
    """What is known of a mesh without an operator."""
    boundaries = [dataclasses.asdict(b) for b in fs.virtual_boundaries(mesh)]
    python = [{t: np.round(v, 9) + 0.0 for t, v in f(mesh).items()} for f in (fs.scaled_jacobian, fs.smallest_angle)]
    return [
        {
            "boundaries": boundaries,
            "elementary": [tuple(g) for g in mesh.elementary_groups()],
            "ratio": fs.mean_ratio(mesh),
            "measure": fs.measure(mesh),
            "python": python,
            "repr": repr(mesh),
        }
    ]


def _large(mesh, make, folder):
    return fs.Scalpel(mesh).crack(fs.Plane((7.3, 5, 5), (0.9, 0.3, 0.2)))


def _call(function):
    """An operation that needs the mesh only."""
    return lambda mesh, make, folder: function(mesh)


PLANE, HOLE = fs.Plane((3.1, 2.4, 1.9), (0.2, 0.1, 1)), fs.Cylinder((3.1, 2.4, 0), Z, 0.5)

#: What must fail, on a box of 6 x 5 x 4 with groups.
FAILING = {
    "plane_beside": lambda m: fs.crack(m, fs.Plane((8, 0, 0), X)),
    "plane_outside": lambda m: fs.crack(m, fs.Plane((6, 0, 0), X)),
    "edge_touched": lambda m: fs.drill(m, fs.Cylinder((-1, 2, 0), Z, 1)),
    "name_empty": lambda m: fs.crack(m, PLANE, name=""),
    "name_long": lambda m: fs.crack(m, PLANE, name="A" * 23),
    "name_taken": lambda m: fs.crack(fs.crack(m, PLANE).mesh, PLANE),
    "name_type": lambda m: fs.crack(m, PLANE, name=5),
    "method": lambda m: fs.crack(m, PLANE, method="push"),
    "rings": lambda m: [tried(lambda t=t: fs.crack(m, PLANE, transition=t)) for t in (0, 1.5, 21, True)],
    "angle": lambda m: [tried(lambda t=t: fs.crack(m, PLANE, feature_angle=t)) for t in (0, 180, "x", float("nan"))],
    "preserve": lambda m: [tried(lambda t=t: fs.crack(m, PLANE, preserve=t)) for t in ("LEFT", 5, ["NONE"], [5])],
    "flags": lambda m: [tried(lambda t=t: fs.crack(m, PLANE, **t)) for t in ({"strict": 1}, {"band_only": "no"})],
    "refine": lambda m: [
        tried(lambda t=t: fs.drill(m, HOLE, refine=t)) for t in (0, -1.0, True, "fine", float("inf"), False, 0.01)
    ],
    "skin": lambda m: [
        tried(lambda t=t: fs.crack(m, PLANE, skin=t))
        for t in (5, SHAPES / "nowhere.brep", "not\na shape", SHAPES / "flanged_cylinder.brep")
    ],
    "within": lambda m: [
        tried(lambda t=t: fs.crack(m, PLANE, within=t(), refine=False))
        for t in (
            lambda: 5,
            lambda: fs.Disk(PLANE.origin, 0),
            lambda: fs.Disk((3.1, 2.4, 2.9), 1),
            lambda: fs.Disk(PLANE.origin, 0.05),
            lambda: fs.Disk((53.1, 2.4, -8.1), 1),
            lambda: fs.Polygon([PLANE.origin, (4.1, 2.4, 1.7)]),
            lambda: fs.HalfPlane(PLANE.origin, PLANE.normal),
            lambda: fs.Polygon([PLANE.origin, (4.1, 2.4, 1.7), (3.1, 3.4, 1.8), (4.1, 3.4, 1.6)]),
            lambda: fs.CylinderPart((0, 1)),
            lambda: fs.CylinderPart((1, 0)),
            lambda: fs.CylinderPart((0, 1), (0, 90)),
            lambda: fs.Ellipse(PLANE.origin, (1,), X),
            lambda: fs.Polygon(3),
        )
    ],
    "tools": lambda m: [
        tried(t)
        for t in (
            lambda: fs.Plane((0, 0, 0), (0, 0, 0)),
            lambda: fs.Plane((0, 0), Z),
            lambda: fs.Plane("abc", Z),
            lambda: fs.Plane((0, 0, float("inf")), Z),
            lambda: fs.Cylinder((0, 0, 0), (0, 0, 0), 1),
            lambda: fs.Cylinder((0, 0, 0), Z, 0),
            lambda: fs.Cylinder((0, 0, 0), Z, "1"),
            lambda: fs.Sphere((0, 0, 0), -1),
            lambda: fs.Torus((0, 0, 0), Z, 1, 2),
            lambda: fs.Torus((0, 0, 0), (0, 0, 0), 2, 1),
            lambda: fs.Cone((0, 0, 0), Z, 1, 90),
            lambda: fs.Cone((0, 0, 0), Z, -1, 30),
            lambda: fs.Face(SHAPES / "nowhere.step"),
            lambda: fs.Face(3),
        )
    ],
    "drill_nothing": lambda m: [
        tried(lambda t=t: fs.drill(m, t))
        for t in ([], 5, [PLANE, 5], fs.Cylinder((50, 0, 0), Z, 1), fs.Sphere((3, 2, 2), 50))
    ],
    "drill_deform": lambda m: [
        tried(lambda t=t: fs.drill(m, **t))
        for t in (
            {"tools": [HOLE, HOLE], "method": "deform"},
            {"tools": HOLE, "method": "deform", "depth": 1.0},
            {"tools": HOLE, "depth": "2"},
            {"tools": PLANE, "depth": 1.0},
            {"tools": HOLE, "depth": -9.0},
        )
    ],
    "wall_thin": lambda m: [tried(lambda t=t: fs.drill(m, fs.Cylinder((1 + t, 2.5, 0), Z, 1))) for t in (1e-7, 0.01)],
    "cut": lambda m: [
        tried(lambda t=t: fs.cut(**{"mesh": m, "tool": PLANE, **t}))
        for t in (
            {},
            {"width": 1, "other": PLANE},
            {"width": 0},
            {"width": -1},
            {"width": "1"},
            {"width": 1, "tool": HOLE},
            {"width": 1, "bottom": 3},
            {"width": 1, "tool": fs.Plane((50, 0, 0), X)},
            {"width": 20},
            {"width": 1, "method": "deform"},
            {"other": fs.Plane((3, 2, 90), Z)},
        )
    ],
    "near": lambda m: [
        tried(lambda t=t: fs.refine(m, **t))
        for t in (
            {"near": (0, 0, 0), "size": 0},
            {"near": (0, 0, 0), "size": float("nan")},
            {"near": (0, 0, 0), "size": 1, "gradation": -1},
            {"near": (0, 0, 0), "size": 1, "reach": -1},
            {"near": (0, 0, 0), "size": 1, "max_elements": 0},
            {"near": (0, 0, 0), "size": 1, "relax": 1},
            {"near": (0, 0), "size": 1},
            {"near": "here", "size": 1},
            {"near": np.zeros((0, 3)), "size": 1},
            {"near": [(0, 0, float("inf"))], "size": 1},
            {"near": [PLANE, 3], "size": 1},
        )
    ],
    "not_a_mesh": lambda m: [
        tried(lambda: fs.crack("box.med", PLANE)),
        tried(lambda: fs.crack(m, "plane")),
        tried(lambda: fs.write("a", "b")),
        tried(lambda: fs.read(5)),
    ],
    "groups": lambda m: [
        tried(t)
        for t in (
            lambda: m.copy().add_group("LEFT", "element"),
            lambda: m.copy().add_group("NEW", "cell"),
            lambda: m.copy().add_group("NEW", "node", [1]),
            lambda: m.copy().remove_group("NONE"),
            lambda: m.copy().rename_group("LEFT", "RIGHT"),
            lambda: fs.virtual_boundary(m, "NONE"),
            lambda: m.groups["LEFT", "node"],
            lambda: m.copy().add_group("NEW", "facet", [[103, 9]]),
        )
    ],
    "mesh": lambda m: [
        tried(t)
        for t in (
            lambda: fs.Mesh([(0, 0, 0)], {"tetra": [[0, 1, 2, 3]]}),
            lambda: fs.Mesh([(0, 0)], {}),
            lambda: fs.Mesh([(0, 0, float("nan"))], {}),
            lambda: fs.Mesh([(0, 0, 0)] * 2, {}, [1, 1]),
            lambda: fs.Mesh([], {"ball": []}),
            lambda: fs.Mesh(m.points, {"tetra": [[0, 1, 2]]}),
            lambda: fs.Mesh(m.points, m.cells, cell_ids={}),
            lambda: fs.Mesh(m.points, {"tetra": [[0, 1, 1, 2]]}),
        )
    ],
    "cancelled": lambda m: _cancelled(m),
}


def _cancelled(mesh):
    token = fs.CancelToken()
    token.cancel()
    with token:
        return [tried(lambda: fs.crack(mesh, PLANE)), tried(lambda: fs.refine(mesh, PLANE, 0.5))]


#: Files that cannot be read, or only with a warning, and what is in them.
BROKEN = {
    "missing.inp": None,
    "missing.med": None,
    "what.xyz": b"",
    "empty.inp": b"",
    "text.med": b"*NODE\n",
    "text.inp.gz": b"*NODE\n",
    "node.inp": b"*NODE\n1, 0., x, 0.\n",
    "twice.inp": b"*NODE\n1, 0., 0., 0.\n*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n",
    "type.inp": b"*NODE\n1, 0., 0., 0.\n*ELEMENT, TYPE=C9D9\n1, 1\n",
    "set.inp": b"*NODE\n1, 0., 0., 0.\n*NSET, NSET=A\n7\n",
    "include.inp": b"*INCLUDE, INPUT=nowhere.inc\n",
    "card.inp": b"*NODE\n1, 0., 0., 0.\n*NONSENSE, A=B\n1, 2\n",
    "generate.inp": b"*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n*NSET, NSET=A, GENERATE\n1, 2, 0\n",
}


def _broken(mesh, make, folder):
    out = []
    for name, data in BROKEN.items():
        if data is not None:
            (folder / name).write_bytes(data)
        out.append(tried(lambda: fs.read(folder / name)))
    return out + [tried(lambda: fs.write(mesh, folder / name)) for name in ("out.xyz", "no/folder/out.med", ".inp")]


#: On meshes that are made for one purpose: (subject, name, operation).
SPECIAL = [
    ("group_box", "tangent_skin", _call(lambda m: fs.drill(m, fs.Cylinder((0.6, 2.5, 0), Z, 0.6)))),
    ("group_box", "tangent_border", _call(lambda m: fs.drill(m, fs.Cylinder((2.0, 2.5, 0), Z, 1.0)))),
    ("group_box", "whole_group_gone", _call(lambda m: fs.drill(m, fs.Cylinder((0, 2.5, 0), Z, 4)))),
    ("group_box", "coarse_hole", _call(lambda m: fs.drill(m, fs.Cylinder((3.1, 2.4, 0), Z, 1.2), refine=False))),
    ("group_box", "coarse_sphere", _call(lambda m: fs.crack(m, fs.Sphere((3, 2.5, 2), 1.2), refine=False))),
    ("group_box", "tiny_hole", _call(lambda m: fs.drill(m, HOLE))),
    ("group_box", "end_cut_off", _call(lambda m: fs.cut(m, fs.Plane((6, 0, 0), X), width=1))),
    ("group_box", "bottom_beyond", _call(lambda m: fs.drill(m, fs.Cylinder((2.9, 2.6, 4), (0, 0, -1), 1.4), depth=9))),
    ("group_box", "on_the_border", _call(lambda m: fs.crack(m, fs.Plane((3, 0, 0), X)))),
    ("group_box", "beside_the_border", _call(lambda m: fs.crack(m, fs.Plane((3.002, 0, 0), X)))),
    ("group_box", "oblique_to_the_border", _call(lambda m: fs.crack(m, fs.Plane((3.05, 2, 2), (1, 0.03, 0))))),
    ("group_box", "refined_many", _call(lambda m: fs.drill(m, fs.Cylinder((2.1, 1.4, 0), Z, 0.12)))),
    ("group_box", "rounded_edge", _call(lambda m: fs.fillet(m, (3.0, 0.0, 0.0), 0.8))),
    ("group_box", "rounded_too_much", _call(lambda m: tried(lambda: fs.fillet(m, (3.0, 0.0, 0.0), 6)))),
    (
        "group_box",
        "boss_on",
        _call(lambda m: fs.merge(m, parts.block((3, 2.6, 4), (2.2, 1.7, 1.5), (3, 3, 2), "BOSS"))),
    ),
    (
        "group_box",
        "boss_into",
        _call(lambda m: fs.merge(m, parts.block((3, 2.6, 3.3), (2, 1.7, 2.2), (3, 3, 3), "BOSS"), keep="addition")),
    ),
    ("group_box", "plate_on", _call(lambda m: fs.merge(m, parts.plate((1, 1.3, 4), (3, 1, 0), Z, (5, 2), "FIN")))),
    ("group_box", "apart", _call(lambda m: tried(lambda: fs.merge(m, parts.block((9, 9, 9), 1, (1, 1, 1), "B"))))),
    ("group_box", "nothing_to_refine", _call(lambda m: fs.refine(m, (0, 0, 0), 5))),
    ("group_box", "broken_files", _broken),
    ("brick", "hole_near_brick", _call(lambda m: fs.drill(m, fs.Cylinder((1.6, 2.5, 0), Z, 1.2)))),
    ("brick", "refine_near_brick", _call(lambda m: fs.drill(m, fs.Cylinder((1.6, 2.5, 0), Z, 1.2), refine=0.6))),
    ("brick", "crack_in_brick", _call(lambda m: fs.crack(m, fs.Plane((3, 2.5, 2), (0.1, 1, 0))))),
    ("brick", "files", _files),
    ("beams", "crack_x", _call(lambda m: fs.crack(m, fs.Plane((1.6, 1, 1), (1, 0.1, 0.2))))),
    (
        "beams",
        "crack_z",
        _call(
            lambda m: fs.crack(
                m, fs.Plane((1.6, 1, 1.1), (0.1, 0.1, 1)), within=fs.HalfPlane((1.6, 1, 1.1), (1, 0, -0.1))
            )
        ),
    ),
    (
        "beams",
        "drill",
        _call(lambda m: fs.drill(m, [fs.Cylinder((1.2, 1.3, 0), Z, 0.6), fs.Cylinder((2.2, 1.3, 0), Z, 0.7)])),
    ),
    (
        "beams",
        "cut",
        _call(lambda m: fs.cut(m, fs.Plane((2.2, 0, 0), X), width=0.5, bottom=fs.Plane((0, 0, 1.2), (0, 0, -1)))),
    ),
    ("beams", "refine", _call(lambda m: fs.refine(m, fs.Plane((2.2, 0, 0), X), 0.6))),
    ("beams", "files", _files),
    ("beams", "knowledge", _knowledge),
    ("plates", "open_contact", _call(lambda m: fs.crack(m, fs.Plane((0, 0, 0), Y)))),
    ("bordered", "on_the_border", _call(lambda m: fs.crack(m, fs.Plane((3, 0, 0), X)))),
    ("bordered", "wedge", _call(lambda m: fs.crack(m, fs.Plane((3.05, 3, 0), (1, 0.03, 0))))),
    ("bordered", "thin_wedge", _call(lambda m: fs.crack(m, fs.Plane((3.04, 3, 0), (1, 1e-4, 0))))),
    *(
        (name, f"in_the_plate_{side}", _call(lambda m, z=z: fs.crack(m, fs.Plane((0, 0, 0), (0, 0, z)))))
        for name in ("junction", "junction3")
        for side, z in (("up", 1), ("down", -1))
    ),
    (
        "junction",
        "in_part_of_the_plate",
        _call(lambda m: fs.crack(m, fs.Plane((0, 0, 0), Z), within=fs.Disk((4, 0, 0), 2.5))),
    ),
    ("junction3", "across", _call(lambda m: fs.crack(m, fs.Plane((3.3, 0, 0), (1, 0.2, 0.1))))),
    ("junction3", "hole", _call(lambda m: fs.drill(m, fs.Cylinder((4.2, 0.4, 0), Z, 1.3)))),
    ("junction3", "slot", _call(lambda m: fs.cut(m, fs.Plane((3.3, 0, 0), (1, 0.2, 0.1)), width=0.6))),
    *(
        (subject_, name.replace(" ", "_"), _call(lambda m, f=f: f(m, 2.5)))
        for subject_ in ("folded_box2", "folded_sheet2")
        for name, f in folded.TOOLS.items()
        if subject_ == "folded_box2" or name not in ("plane", "refined hole")
    ),
    ("spoilt_box2", "plane", _call(lambda m: fs.crack(m, fs.Plane((2, 2.5, 2.5), (0.1, 2, 0.5))))),
    *(
        (
            "flat2",
            f"{operation}_{k}",
            _call(lambda m, o=operation, c=(x, y, 0.0), r=r: getattr(fs, o)(m, fs.Cylinder(c, Z, r))),
        )
        for k, (operation, x, y, r) in enumerate(curved.FOLDING[:4])
    ),
]

SOLIDS = ("two_boxes", "l_shape", "flanged", "elbow", "box", "uneven_box", "box2")
FLAT = ("plate", "uneven_plate", "plate2")

#: What rounding_cases.py works on.
ROUNDED = ("two_boxes", "l_shape", "flanged", "caisson", "elbow")

#: Regular operations: name, function that makes one, its arguments; on which meshes. The random tool follows from name
#: and mesh.
TABLE: Tuple[Tuple[str, Callable, tuple, Tuple[str, ...]], ...] = (
    # cracks
    *(
        (f"crack/plane{'/' + o if o else ''}", _crack, ("plane", o), s)
        for o, s in (
            ("", (*SOLIDS, *FLAT, "flanged_coarse", "caisson", "two_boxes_39k", "tube2")),
            ("one_ring", ("two_boxes", "box2", "plate")),
            ("four_rings", ("l_shape", "elbow", "caisson")),
            ("sharp", ("flanged", "elbow")),
            ("blunt", ("flanged_coarse", "caisson")),
            ("none_kept", ("two_boxes", "uneven_box", "elbow", "plate2")),
            ("one_kept", ("two_boxes", "uneven_plate")),
            ("strict", ("l_shape",)),
            ("preview", ("two_boxes", "elbow", "plate2", "two_boxes_39k")),
            ("never_refined", ("box",)),
            ("refined", ("uneven_box", "box2", "plate", "flanged_coarse")),
            ("deform", ("two_boxes", "uneven_box", "elbow", "uneven_plate", "flat2", "flanged")),
            ("deform4", ("l_shape", "fine_box2", "caisson")),
            ("named", ("box",)),
        )
    ),
    ("crack/grid_plane", _crack, ("grid_plane",), ("two_boxes", "box", "box2", "plate", "plate2", "l_shape")),
    ("crack/cylinder", _crack, ("cylinder",), ("two_boxes", "flanged", "box2", "uneven_plate", "caisson")),
    ("crack/cylinder/deform", _crack, ("cylinder", "deform"), ("two_boxes", "uneven_plate")),
    ("crack/thin_cylinder", _crack, ("thin_cylinder",), ("uneven_box", "plate2")),
    ("crack/sphere", _crack, ("sphere",), ("two_boxes", "uneven_box", "plate", "elbow", "tube2")),
    ("crack/torus", _crack, ("torus",), ("two_boxes", "l_shape", "plate2")),
    ("crack/cone", _crack, ("cone",), ("two_boxes", "uneven_box", "box2", "caisson")),
    ("crack/face", _crack, ("face",), ("two_boxes", "group_box", "elbow")),
    ("crack/face_brep", _crack, ("face_brep",), ("l_shape", "fine_box2")),
    # cracks that end inside
    *(
        (f"within/{k}", _within, (k,), s)
        for k, s in (
            ("disk", ("two_boxes", "fine_box", "fine_box2", "elbow", "caisson", "plate")),
            ("small_disk", ("two_boxes", "uneven_box")),
            ("ellipse", ("fine_box", "l_shape", "fine_box2")),
            ("square", ("fine_box", "two_boxes", "uneven_plate")),
            ("corner", ("fine_box", "fine_box2")),
            ("star", ("fine_box", "flanged")),
            ("rim", ("l_shape", "flanged", "elbow")),
            ("half", ("two_boxes", "uneven_box", "box2", "plate", "plate2", "caisson", "elbow")),
            ("cylinder", ("fine_box", "two_boxes")),
            ("cylinder_angles", ("fine_box", "l_shape", "fine_box2")),
        )
    ),
    ("within/disk/never_refined", _within, ("disk", "never_refined"), ("fine_box", "two_boxes")),
    ("within/disk/refined", _within, ("disk", "refined"), ("fine_box", "elbow")),
    ("within/square/preview", _within, ("square", "preview"), ("fine_box", "two_boxes")),
    ("within/ellipse/deform", _within, ("ellipse", "deform"), ("two_boxes",)),
    # holes
    *(
        (f"drill/{t}{'/' + o if o else ''}{'/blind' if d else ''}", _drill, (t, o, d), s)
        for t, o, d, s in (
            ("cylinder", "", None, (*SOLIDS, *FLAT, "caisson", "two_boxes_39k", "tube2")),
            ("cylinder", "", 1.3, ("two_boxes", "uneven_box", "elbow")),
            ("cylinder+cylinder", "", None, ("two_boxes", "plate2", "box2")),
            ("cylinder+sphere+plane", "none_kept", None, ("l_shape",)),
            ("cylinder+cone", "", 2.0, ("two_boxes",)),
            ("torus", "", None, ("two_boxes", "l_shape")),
            ("sphere", "", None, ("two_boxes", "uneven_box", "plate", "fine_box2")),
            ("cone", "", None, ("flanged", "box2")),
            ("plane", "", None, ("two_boxes", "elbow", "plate")),
            ("wide_cylinder", "", None, ("two_boxes", "uneven_plate")),
            ("thin_cylinder", "", None, ("uneven_box", "plate")),
            ("cylinder", "deform", None, ("two_boxes", "uneven_box", "flat2")),
            ("cylinder", "preview", None, ("two_boxes", "box2")),
            ("cylinder", "never_refined", None, ("l_shape", "plate2")),
            ("cylinder", "refined", None, ("uneven_box", "elbow")),
            ("cylinder", "none_kept", None, ("two_boxes", "plate")),
            ("cylinder", "strict", None, ("flanged",)),
            ("face", "", None, ("group_box",)),
        )
    ),
    # slots
    *(
        (f"cut/{k}{'/' + o if o else ''}", _cut, (k, o), s)
        for k, o, s in (
            ("slot", "", (*SOLIDS, *FLAT, "caisson", "tube2")),
            ("saw", "", ("two_boxes", "uneven_box", "box2", "elbow")),
            ("disk_saw", "", ("two_boxes", "l_shape", "fine_box2")),
            ("notch", "", ("two_boxes", "uneven_box", "plate", "elbow")),
            ("slot", "preview", ("two_boxes", "box2")),
            ("slot", "refined", ("uneven_box",)),
            ("slot", "none_kept", ("two_boxes", "plate2")),
            ("slot", "deform", ("two_boxes",)),
            ("saw", "strict", ("l_shape",)),
        )
    ),
    # refinement
    *(
        (f"refine/{k}", _refine, (k,), s)
        for k, s in (
            ("plane", ("two_boxes", "elbow", "plate2", "caisson")),
            ("cylinder", ("l_shape", "box2", "uneven_plate")),
            ("tools", ("uneven_box", "flanged_coarse")),
            ("point", ("two_boxes", "box2", "tube2")),
            ("points", ("flanged", "plate")),
            ("all", ("uneven_box", "plate2")),
            ("too_many", ("two_boxes",)),
            ("nothing", ("l_shape",)),
        )
    ),
    # walls
    *(
        (f"reshape/{k}", _reshape, (k,), s)
        for k, s in (
            ("face", ("two_boxes",)),
            ("pressed", ("two_boxes",)),
            ("border", ("two_boxes",)),
            ("head", ("flanged",)),
            ("stem", ("flanged",)),
            ("inlet", ("elbow",)),
            ("bore", ("elbow",)),
            ("too_far", ("two_boxes",)),
        )
    ),
    # skin
    *(
        (f"skin/{o}", _skin, (o, shape), (s,))
        for o in ("crack", "drill", "cut", "refine", "within")
        for shape, s in (
            ("flanged_cylinder", "flanged"),
            ("flanged_cylinder", "flanged_coarse"),
            ("quadratic_elbow", "elbow"),
        )
        if (o, s) != ("within", "flanged_coarse")
    ),
    # several
    ("session", lambda: _session, (), ("two_boxes", "fine_box2", "uneven_plate", "elbow")),
    ("chain", lambda: _chain, (), ("two_boxes", "uneven_box", "plate2", "l_shape")),
    *(
        (f"cross/{k}", _cross, (k,), s)
        for k, s in (
            ("disk", ("fine_box", "two_boxes")),
            ("half", ("fine_box2", "uneven_plate")),
            ("square", ("fine_box",)),
        )
    ),
    ("files", lambda: _files, (), ("two_boxes", "elbow", "caisson", "plate2", "group_box")),
    ("knowledge", lambda: _knowledge, (), ("two_boxes", "l_shape", "elbow", "caisson", "plate2")),
    ("large", lambda: _large, (), ("two_boxes_505k",)),
)

#: On decks: every operator, with strict and without, through MED and back.
DECK_CALLS = {
    "crack": lambda m, make: fs.crack(m, make.plane()),
    "crack/strict": lambda m, make: fs.crack(m, make.grid_plane(), strict=True),
    "half": lambda m, make: (lambda part: fs.crack(m, part[0], within=part[1]))(make.part("half")),
    "drill": lambda m, make: fs.drill(m, make.cylinder()),
    "drill/strict": lambda m, make: fs.drill(m, make.cylinder(), strict=True),
    "cut": lambda m, make: fs.cut(m, make.plane(), width=0.5 * make.edge),
    "refine": lambda m, make: fs.refine(m, make.plane(), 0.8 * make.edge, gradation=1.0),
}
DECKS = (
    "blocks",
    "periodic",
    "periodic2",
    "loaded",
    "helper_sets",
    *(f"ccx_{name}" for name in ccx.NORMALS if name not in ("cubef2f2", "cubef2f3")),
)


def _on_deck(call):
    return lambda mesh, make, folder: DECK_CALLS[call](mesh, make)


def _middle(name):
    """The crack that test_calculix_decks.py solves."""
    return lambda mesh, make, folder: fs.crack(mesh, ccx.middle_plane(mesh, ccx.NORMALS[name]), strict=True)


def _deck_chain(mesh, make, folder):
    """Drilled, slotted, written and read, cracked."""
    out = [fs.drill(mesh, removal.HOLES)]
    out.append(fs.cut(out[0].mesh, removal.SLOT, width=0.4, bottom=fs.Plane((0, 0, 1.3), (0, 0, -1))))
    fs.write(out[1].mesh, folder / "deck.inp")
    return out + [
        fs.crack(fs.read(folder / "deck.inp"), fs.Plane((4.6, 1, 1), (1, 0.1, 0.1))),
        tried(lambda: fs.drill(mesh, removal.HOLES, strict=True)),
    ]


def operations():
    """All of them; names are unique."""
    out = [
        Operation(f"{name}/{s}", s, build(*arguments)) for name, build, arguments, subjects in TABLE for s in subjects
    ]
    out += [Operation(f"special/{s}/{name}", s, run) for s, name, run in SPECIAL]
    out += [Operation(f"error/{name}", "group_box", _call(call)) for name, call in FAILING.items()]
    out += [Operation(f"rounding/{k:02}", "group_box", _rounding(k), ROUNDED) for k in range(40)]
    out += [Operation(f"deck/{call}/{s}", s, _on_deck(call)) for s in DECKS for call in DECK_CALLS]
    out += [Operation(f"deck/middle/ccx_{name}", f"ccx_{name}", _middle(name)) for name in ccx.NORMALS]
    out += [
        Operation("deck/chain/blocks", "blocks", _deck_chain),
        Operation("deck/crack/ccx_beam20p", "ccx_beam20p", _on_deck("crack")),
    ]
    out += [
        Operation(f"deck/files/{s}", s, _files)
        for s in ("blocks", "periodic2", "helper_sets", "ccx_segmenttet", "ccx_furnace")
    ]
    assert len({o.name for o in out}) == len(out) and all(re.fullmatch(r"\S+/\S+", o.name) for o in out)
    return out


@functools.lru_cache(maxsize=None)
def by_name():
    return {o.name: o for o in operations()}


def content(mesh) -> bytes:
    groups = [(g.name, g.kind, g.ids) for g in mesh.groups.all()]
    return encoded([mesh.points, mesh.node_ids, mesh.cells, mesh.cell_ids, groups])


def perform(name):
    """(name, digests of its parts by name, seconds of processor time)."""
    operation, start = by_name()[name], time.process_time()
    mesh = subject(operation.subject)
    make = Maker(mesh, SUBJECTS[operation.subject].edge, name)
    with tempfile.TemporaryDirectory(prefix=FOLDER) as folder, warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        outcome = Outcome(pathlib.Path(folder))
        before = content(mesh)
        outcome.take(tried(lambda: operation.run(mesh, make, outcome.folder)))
        if content(mesh) != before:
            outcome.add("input", "changed")
        for w in caught:
            outcome.add("warnings", outcome.text(str(w.message)))
    return name, {part: h.hexdigest() for part, h in outcome.hashes.items()}, time.process_time() - start


def total(parts) -> str:
    return short(encoded(parts))


# -------------------------------------------------------------------------------------------- the machine and its files


def _output(command):
    try:
        return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return ""


def _compiler():
    """As compilers leave it in what they make."""
    module = pathlib.Path(fs._engine.__file__).read_bytes()
    found = sorted(set(re.findall(rb"(?:GCC: \([^)]*\) [\w.]+|clang version [\w.+~-]+)", module)))
    return ", ".join(f.decode() for f in found) or "unknown"


def _flags():
    """Options of the compiler that can make a difference, from the build."""
    path = MESHES.parents[1] / "compile_commands.json"
    if not path.exists():
        return "unknown"
    command = next((c["command"] for c in json.loads(path.read_text()) if c["file"].endswith("cutting/snap.cpp")), "")
    return (
        " ".join(w for w in command.split() if re.match(r"-(O|m|std|f(?!visibility|PIC)|DNDEBUG|DEIGEN)", w)) or "none"
    )


def _processor():
    """Its kind, and whether it has what the C library has functions of their own for."""
    try:
        words = set(pathlib.Path("/proc/cpuinfo").read_text().split())
    except OSError:
        words = set()
    return " ".join([platform.machine(), *sorted(words & {"avx2", "fma", "fma4"})])


def _arithmetic():
    """A digest of what mathematical functions give here."""
    random = np.random.default_rng(1)
    values = random.uniform(0.01, 0.99, 2000)
    out = [
        [f(x) for x in values.tolist()]
        for f in (math.sin, math.cos, math.tan, math.asin, math.acos, math.atan, math.exp, math.log, math.sqrt)
    ]
    out += [
        [f(x, y) for x, y in zip(values.tolist(), values[::-1].tolist())]
        for f in (math.atan2, math.pow, math.hypot, math.fmod)
    ]
    rows = random.normal(size=(500, 3))
    out += [
        [float(np.linalg.norm(r)) for r in rows],
        [float(r @ s) for r, s in zip(rows, rows[::-1])],
        random.choice(100, 20, replace=False).tolist(),
    ]
    return short(encoded(out))


def _packages():
    found = {}
    for line in _output(["dpkg-query", "-W"]).splitlines():
        name, _, version = line.partition("\t")
        for wanted in ("libeigen3-dev", "libocct-foundation-7", "libmedc11", "libmed11"):
            if name.startswith(wanted) and not name.startswith("libocct-foundation-dev"):
                found[wanted.split("-")[0]] = version
    return ", ".join(f"{k} {v}" for k, v in sorted(found.items())) or "unknown"


def machine():
    """What results may depend on, beside the program: text by subject."""
    return {
        "compiler": _compiler(),
        "flags": _flags(),
        "processor": _processor(),
        "arithmetic": _arithmetic(),
        "libraries": f"{' '.join(platform.libc_ver())}, NumPy {np.__version__}, zlib {zlib.ZLIB_RUNTIME_VERSION}, "
        f"{_packages()}",
    }


def files_of(names):
    """Digests of the input files of these operations by file name; "missing" where there is none."""
    paths = set().union(*(by_name()[name].files for name in names))
    return {path.name: short(path.read_bytes()) if path.exists() else "missing" for path in sorted(paths)}


# -------------------------------------------------------------------------------------------------------------- running


def run(names=None, jobs=1, on_result=None):
    """{name: (digests by part, seconds)} of the operations of these names, or of all, whose input files are there."""
    names = [n for n, o in by_name().items() if (names is None or n in names) and not o.missing]
    out = {}
    with concurrent.futures.ProcessPoolExecutor(jobs, multiprocessing.get_context("fork")) as pool:
        try:
            for name, parts, seconds in pool.map(perform, names):
                out[name] = parts, seconds
                if on_result:
                    on_result(name, parts)
        except concurrent.futures.process.BrokenProcessPool:
            raise SystemError(f"the process died in {' or '.join(names[len(out):len(out) + jobs])}") from None
    return out


def line(name, parts, details=True):
    text = f"{name:44} {total(parts)}"
    return text + "".join(f" {part}={digest}" for part, digest in parts.items()) if details else text


def parsed(text):
    """(machine, files, {name: (digest, digests by part)}) of a recorded file or of what was printed."""
    head, files, lines = {}, {}, {}
    for row in text.splitlines():
        if match := re.match(r"# file (\S+): (\S+)$", row):
            files[match[1]] = match[2]
        elif match := re.match(r"# (\w+): (.*)$", row):
            head[match[1]] = match[2]
        elif match := re.match(
            r"(\S+/\S+) +([0-9a-f]{10})((?: \w+=[0-9a-f]{10})*)$", row
        ):  # and not what OpenCASCADE prints
            lines[match[1]] = match[2], dict(p.split("=") for p in match[3].split())
    return head, files, lines


def difference(now, before):
    """What is another in an operation, or None: digests by part, and (digest, digests by part) as recorded."""
    digest, parts = before
    if total(now) == digest:
        return None
    if not parts:
        return "differs"
    return ", ".join(p for p in dict.fromkeys([*now, *parts]) if now.get(p) != parts.get(p)) or "differs"


def head_of(names):
    """Lines on what the results of these operations may depend on."""
    return "\n".join(
        [
            "# Results of digest.py, which says what they are.",
            *(f"# {k}: {v}" for k, v in machine().items()),
            *(f"# file {name}: {digest}" for name, digest in files_of(names).items()),
        ]
    )


@dataclass
class Comparison:
    """Results beside those of a text."""

    machine: list  #: what is another about the machine, in words; nothing can be said then
    left_out: dict  #: operations that have other input files, or none: name of a file by name
    changed: dict  #: operations with another result: the parts by name
    unknown: list  #: operations that are not in the text
    gone: list  #: operations in the text that are no more


def compared(results, text, names):
    """A Comparison for the results of the operations of these names."""
    head, files, lines = parsed(text)
    other = {path for path, digest in files_of(names).items() if files.get(path, digest) != digest}
    machines = [f"the {k} is {v} here and {head[k]} there" for k, v in machine().items() if head.get(k, v) != v]
    out = Comparison(machines, {}, {}, [], [])
    for name in names:
        names_of_files = sorted(path.name for path in by_name()[name].files)
        if away := [f for f in names_of_files if f in other] or [path.name for path in by_name()[name].missing]:
            out.left_out[name] = away[0]
        elif name not in lines:
            out.unknown.append(name)
        elif parts := difference(results[name][0], lines[name]):
            out.changed[name] = parts
    out.gone = [name for name in lines if name not in by_name()]
    return out


def told(c):
    """A Comparison in lines."""
    out = [f"# {m}; the last bits may differ for that" for m in c.machine]
    out += [f"{name:44} left out, as {f} is another or missing" for name, f in c.left_out.items()]
    out += [f"{name:44} {parts}" for name, parts in c.changed.items()]
    out += [f"{name:44} new" for name in c.unknown] + [f"{name:44} is no more" for name in c.gone]
    return out


def statistics(results):
    seconds = {name: s for name, (_, s) in results.items()}
    slowest = ", ".join(f"{n} {seconds[n]:.2f}" for n in sorted(seconds, key=seconds.get, reverse=True)[:12])
    kinds = collections.Counter(name.split("/")[0] for name in results)
    parts = collections.Counter(part for digests, _ in results.values() for part in digests)
    return (
        f"# {sum(seconds.values()):.1f} s of processor time; slowest: {slowest}\n"
        f"# kinds: {', '.join(f'{k} {n}' for k, n in kinds.items())}\n"
        f"# parts: {', '.join(f'{p} {n}' for p, n in parts.items())}"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--only", metavar="NAME_PART", help="operations whose name has this in it")
    parser.add_argument("--jobs", type=int, default=1, help="processes")
    parser.add_argument("--details", action="store_true", help="also the digest of every part, and of the input files")
    parser.add_argument(
        "--compare", type=pathlib.Path, metavar="FILE", help="tell what differs from what was printed or recorded there"
    )
    parser.add_argument("--record", action="store_true", help=f"write {RECORDED.name}")
    parser.add_argument("--seconds", action="store_true", help="also which are the slowest, and the counts by kind")
    a = parser.parse_args()
    names = [n for n in by_name() if not a.only or a.only in n]
    missing = {n: by_name()[n].missing[0] for n in names if by_name()[n].missing}
    if a.record and a.only:
        parser.error("--record is for all operations, not for some")
    if a.record and missing:
        parser.error(f"{len(missing)} operations lack input files, among them {sorted(missing.values())[0]}")
    before = a.compare.read_text() if a.compare else None
    if a.details and not a.compare:
        print(head_of(names))
    show = None if a.compare else lambda name, parts: print(line(name, parts, a.details), flush=True)
    results = run(names, a.jobs, show)
    if a.record:
        RECORDED.write_text("\n".join([head_of(names), *(line(n, parts) for n, (parts, _) in results.items())]) + "\n")
    if a.seconds:
        print(statistics(results))
    if a.compare:
        c = compared(results, before, names)
        print("\n".join([*told(c), f"{len(c.changed)} of {len(results)} operations differ"]))
        return 1 if c.changed or c.unknown or c.gone else 0
    for name, path in missing.items():
        print(f"# {name} was not run: {path.name} is missing")
    print(f"{'all ' + str(len(results)):44} {short(encoded({n: p for n, (p, _) in results.items()}))}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
