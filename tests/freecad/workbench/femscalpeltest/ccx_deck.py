# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a CalculiX deck written by FreeCAD applies to the mesh, computed without FemScalpel and without CalculiX.

Knows the cards FreeCAD 0.20 writes for solids and shells of triangles and tetrahedra, and stops at those it does not
know.
"""

import re

import numpy as np

# Corners and mid-side nodes of the faces of a tetrahedron as CalculiX numbers them.
TETRA_FACES = ((0, 1, 2, 4, 5, 6), (0, 3, 1, 7, 8, 4), (1, 3, 2, 8, 9, 5), (2, 3, 0, 9, 7, 6))

_TETRA_POINTS = 0.1381966011250105 + 0.4472135954999579 * np.eye(4)  # four Gauss points, barycentric
_TRIANGLE_POINTS = 1 / 6 + 0.5 * np.eye(3)  # three Gauss points, barycentric


class Deck:
    """Nodes, elements, sets, loads and supports of a deck, by number."""

    def __init__(self, text):
        self.points, self.elements = {}, {}
        self.nsets, self.elsets, self.surfaces = {}, {}, {}
        self.concentrated, self.distributed, self.fixed = [], [], []
        self.density, self.sections, self.cylinders = {}, {}, []
        self.ties = []
        for name, options, rows in _cards(text):
            handler = getattr(self, "_" + name.lower().replace(" ", "_"), None)
            if handler:
                handler(options, rows)
            elif name not in _WITHOUT_MEANING_HERE:
                raise NotImplementedError(f"card *{name}")

    # --- what one asks for

    def supports(self):
        """Numbers of all nodes with a mechanical support."""
        return set().union(*(self.nodes(target) for target, first, _ in self.fixed if first <= 6))

    def nodes(self, target):
        return {int(target)} if target.isdigit() else set(self.nsets[target])

    def held(self):
        """{degree of freedom: numbers of the nodes held in it}."""
        result = {}
        for target, first, last in self.fixed:
            for dof in range(first, last + 1):
                result.setdefault(dof, set()).update(self.nodes(target))
        return result

    def forces(self):
        """{node: force} of all loads, distributed ones in the way of finite elements, in global directions."""
        total = {}

        def add(node, force):
            total[node] = total.get(node, 0) + np.asarray(force, float)

        for node, dof, value in self.concentrated:
            if dof <= 3:
                add(node, value * self._axes(node)[dof - 1])
        for target, kind, values in self.distributed:
            elements = [int(target)] if target.isdigit() else self.elsets[target]
            for element in elements:
                for node, force in self._distributed(element, kind, values):
                    add(node, force)
        return total

    def magnitude(self):
        """Sum of the magnitudes of all loads: of every line of *CLOAD, and of every element's share of a *DLOAD."""
        total = sum(abs(value) for _, _, value in self.concentrated)
        for target, kind, values in self.distributed:
            for element in [int(target)] if target.isdigit() else self.elsets[target]:
                total += np.linalg.norm(sum(force for _, force in self._distributed(element, kind, values)))
        return total

    def places(self, nodes):
        """Number of different places that nodes are at."""
        return len({tuple(np.round(self.points[n], 7)) for n in nodes})

    def skin_in(self, nodes):
        """Area of the solids' skin, or of shells, all of whose nodes are in `nodes`; length of shells' edges if there
        is none. What coincides counts once."""
        triangles = [n for kind, n in self.elements.values() if kind.startswith("S") and nodes.issuperset(n)]
        if triangles:
            corners = np.array([[self.points[n] for n in triangle[:3]] for triangle in triangles])
            return (
                np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2
            )
        owners, shapes = {}, {}
        for kind, element in self.elements.values():
            for face in TETRA_FACES if kind.startswith("C3D") else ((0, 1), (1, 2), (2, 0)):
                face = [element[i] for i in face if i < len(element)]
                if all(node in nodes for node in face):
                    key = tuple(sorted(face))
                    owners[key] = owners.get(key, 0) + 1
                    shapes[key] = np.array([self.points[n] for n in face[:3]])
        measures = {}
        for key, points in shapes.items():
            if owners[key] == 1 or len(points) == 2:
                edges = points[1:] - points[0]
                place = tuple(sorted(map(tuple, np.round(points, 7))))
                measures[place] = np.linalg.norm(np.cross(*edges)) / 2 if len(edges) == 2 else np.linalg.norm(edges)
        return sum(measures.values())

    def measure(self, elset):
        """Volume (shells: area) of an element set, by the elements' corners."""
        total = 0.0
        for kind, nodes in map(self.elements.get, self.elsets[elset]):
            points = np.array([self.points[n] for n in nodes[: 4 if kind.startswith("C3D") else 3]])
            edges = points[1:] - points[0]
            total += abs(np.linalg.det(edges)) / 6 if len(edges) == 3 else np.linalg.norm(np.cross(*edges)) / 2
        return total

    def surface_area(self, name):
        total = 0.0
        for element, face in self.surfaces[name]:
            nodes = self.elements[element][1]
            if self.elements[element][0].startswith("C3D"):
                nodes = [nodes[i] for i in TETRA_FACES[face - 1][:3]]
            a, b, c = (np.array(self.points[n]) for n in nodes[:3])
            total += np.linalg.norm(np.cross(b - a, c - a)) / 2
        return total

    # --- loads

    def _axes(self, node):
        """Local axes of a node as rows: those of a *TRANSFORM of cylindrical type, else the global ones."""
        for nset, a, b in reversed(self.cylinders):
            if node in self.nsets[nset]:
                axial = (b - a) / np.linalg.norm(b - a)
                radial = self.points[node] - a
                radial = radial - radial @ axial * axial
                radial /= np.linalg.norm(radial)
                return np.array([radial, np.cross(axial, radial), axial])
        return np.eye(3)

    def _distributed(self, element, kind, values):
        shape, nodes = self.elements[element]
        points = np.array([self.points[n] for n in nodes])
        if re.fullmatch(r"P\d", kind) and shape.startswith("C3D"):
            face = [i for i in TETRA_FACES[int(kind[1]) - 1] if i < len(nodes)]
            weights, derivatives = _triangle(len(face))
            for row, (by_u, by_v) in zip(weights, derivatives):
                normal = np.cross(by_u @ points[face], by_v @ points[face])  # outward
                for i, weight in zip(face, row):
                    yield nodes[i], values[0] * weight * normal / 6
            return
        density = [
            self.density[material]
            for elset, material in self.sections.items()
            if element in self._members(elset) and material in self.density
        ]
        if len(density) != 1:
            raise ValueError(f"element {element} has {len(density)} materials")
        weights, derivatives = _tetra(len(nodes))
        for row, derivative in zip(weights, derivatives):
            volume = abs(np.linalg.det(derivative @ points)) / 6 / len(weights)
            if kind == "GRAV":
                force = density[0] * volume * values[0] * np.array(values[1:4])
            elif kind == "CENTRIF":
                axis = np.array(values[4:7]) / np.linalg.norm(values[4:7])
                arm = row @ points - values[1:4]
                force = density[0] * volume * values[0] * (arm - arm @ axis * axis)
            else:
                raise NotImplementedError(f"load {kind} on {shape}")
            for node, weight in zip(nodes, row):
                yield node, weight * force

    def _members(self, elset):
        if not isinstance(self.elsets[elset], set):
            self.elsets[elset] = set(self.elsets[elset])
        return self.elsets[elset]

    # --- cards

    def _node(self, options, rows):
        for row in rows:
            self.points[int(row[0])] = np.array(row[1:4], float)
            self.nsets.setdefault(options["NSET"], []).append(int(row[0]))

    def _element(self, options, rows):
        width = {"C3D4": 4, "C3D10": 10, "S3": 3, "S6": 6}[options["TYPE"]]
        flat = [int(v) for row in rows for v in row]
        for i in range(0, len(flat), width + 1):
            self.elements[flat[i]] = options["TYPE"], flat[i + 1 : i + width + 1]
            self.elsets.setdefault(options["ELSET"], []).append(flat[i])

    def _nset(self, options, rows):
        self.nsets.setdefault(options["NSET"], []).extend(_numbers(rows, self.nsets))

    def _elset(self, options, rows):
        self.elsets.setdefault(options["ELSET"], []).extend(_numbers(rows, self.elsets))

    def _surface(self, options, rows):
        self.surfaces[options["NAME"]] = [(int(e), int(f.strip("S"))) for e, f in rows]

    def _cload(self, options, rows):
        self.concentrated += [
            (node, int(dof), float(value)) for target, dof, value in rows for node in self.nodes(target)
        ]

    def _dload(self, options, rows):
        self.distributed += [(row[0], row[1], [float(v) for v in row[2:]]) for row in rows]

    def _boundary(self, options, rows):
        for target, first, *rest in rows:
            self.fixed.append((target, int(first), int(rest[0]) if rest and rest[0] else int(first)))

    def _material(self, options, rows):
        self._last_material = options["NAME"]

    def _density(self, options, rows):
        self.density[self._last_material] = float(rows[0][0])

    def _solid_section(self, options, rows):
        self.sections[options["ELSET"]] = options["MATERIAL"]

    _shell_section = _solid_section

    def _transform(self, options, rows):
        if options["TYPE"] != "C":
            raise NotImplementedError("*TRANSFORM, TYPE=R")
        values = np.array(rows[0], float)
        self.cylinders.append((options["NSET"], values[:3], values[3:]))

    def _tie(self, options, rows):
        self.ties += [tuple(row) for row in rows]

    _contact_pair = _tie


_WITHOUT_MEANING_HERE = {
    "HEADING",
    "ELASTIC",
    "PLASTIC",
    "CONDUCTIVITY",
    "EXPANSION",
    "SPECIFIC HEAT",
    "INITIAL CONDITIONS",
    "STEP",
    "STATIC",
    "BUCKLE",
    "FREQUENCY",
    "COUPLED TEMPERATURE-DISPLACEMENT",
    "CONTROLS",
    "DFLUX",
    "FILM",
    "SECTION PRINT",
    "SURFACE INTERACTION",
    "SURFACE BEHAVIOR",
    "NODE FILE",
    "EL FILE",
    "NODE PRINT",
    "END STEP",
    "FRICTION",
    "PHYSICAL CONSTANTS",
    "OUTPUT",
}


def _cards(text):
    """(name, options, rows of fields) of every card."""
    card = None
    for line in text.splitlines():
        line = line.strip()
        if not line or line.startswith("**"):
            continue
        if line.startswith("*"):
            if card:
                yield card
            name, *options = [part.strip() for part in line[1:].split(",")]
            options = dict((o.split("=", 1) + [""])[:2] for o in options)
            card = name.upper(), {key.strip().upper(): value.strip() for key, value in options.items()}, []
        else:
            fields = [field.strip() for field in line.split(",")]
            card[2].append(fields[:-1] if fields[-1] == "" else fields)
    if card:
        yield card


def _numbers(rows, sets):
    for row in rows:
        for field in row:
            if field.lstrip("-").isdigit():
                yield int(field)
            else:
                yield from sets[field]


def _triangle(nodes):
    """Shape functions and their two derivatives at the Gauss points of a triangle."""
    points = np.full((1, 3), 1 / 3) if nodes == 3 else _TRIANGLE_POINTS
    shapes = [_quadratic(b, ((0, 1), (1, 2), (2, 0))) if nodes == 6 else (b, np.eye(3)) for b in points]
    weights = np.array([values for values, _ in shapes]) * 3 / len(points)
    return weights, [(g[:, 1] - g[:, 0], g[:, 2] - g[:, 0]) for _, g in shapes]


def _tetra(nodes):
    """Shape functions and their derivatives (3, nodes) at the Gauss points of a tetrahedron."""
    points = np.full((1, 4), 1 / 4) if nodes == 4 else _TETRA_POINTS
    edges = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
    shapes = [_quadratic(b, edges) if nodes == 10 else (b, np.eye(4)) for b in points]
    return [values for values, _ in shapes], [np.array([g[:, k] - g[:, 0] for k in (1, 2, 3)]) for _, g in shapes]


def _quadratic(b, edges):
    """Values of the quadratic shape functions at barycentric point b, and derivatives by b."""
    values = np.concatenate([b * (2 * b - 1), [4 * b[i] * b[j] for i, j in edges]])
    gradient = np.zeros((len(values), len(b)))
    gradient[: len(b)] = np.diag(4 * b - 1)
    for k, (i, j) in enumerate(edges):
        gradient[len(b) + k, i], gradient[len(b) + k, j] = 4 * b[j], 4 * b[i]
    return values, gradient
