# SPDX-License-Identifier: LGPL-2.1-or-later
"""Keeps the nodes of a mesh on the geometry it was made from, while an operator changes it.

FreeCAD finds the nodes of a load or a support by geometry: those less than the shape's tolerance, mostly 1e-7 mm, from
the face, edge or vertex the constraint refers to. A mesh knows its geometry to the width of its elements only. So a
node that moves or is born on a curved face, or on a face inside the material that no mesh group marks (between two
solids), would no longer be found, and the load, support or material would end there without a message.
"""

import re

import Fem
import numpy as np

from .geometry import Edge, Entity, Face, Owners, name_of, nearest
from .mesh_parts import TETRA_FACES, TETRAS, TRIANGLES, border_nodes, nodes_of_elements, nodes_of_facets
from .node_moves import carry_mid_sides, spoilt_by

_GROUP = "FemScalpel:"  # begins the names of bookkeeping groups


def bookkeeping_groups(mesh):
    """Names of the groups of `mesh` that an OnShape has made."""
    return [name for name in mesh.groups if name.startswith(_GROUP)]


# One in a list: "'FemScalpel:Face6' (47 of 254)". No name of a face has an apostrophe, but one may be added at its end.
_LISTED = re.compile(rf"'{_GROUP}[^']*'+ \([^)]*\)")


def without_bookkeeping(warnings):
    """The warnings of an operator but for what they say of bookkeeping groups, which are none of the user's: those
    about one alone go; of those that list groups the others stay."""
    kept = []
    for warning in warnings:
        if _GROUP in warning:
            if re.match(rf"\w+ group '{_GROUP}", warning):
                continue
            listed = re.compile(rf"(?:'[^']*'+ \([^)]*\)(?:, )?)+").search(warning)
            if listed is not None:
                others = [each for each in re.findall(r"'[^']*'+ \([^)]*\)", listed[0]) if not _LISTED.fullmatch(each)]
                if not others:
                    continue
                warning = warning[: listed.start()] + ", ".join(others) + warning[listed.end() :]
        kept.append(warning)
    return kept


class OnShape:
    """Which nodes of a mesh lie on which faces and edges of shapes, before and after an operator.

    Parameters
    ----------
    mesh : femscalpel.Mesh
        Gets bookkeeping groups, which the operator carries along; put_back() takes them out of its result.
    shapes : list of (str, Part.Shape)
        As from shapes_of().
    near : (n,) array of bool
        The nodes the operator may move or take as parents of new nodes. Only they are looked at.
    """

    def __init__(self, mesh, shapes, near):
        #: Names of the bookkeeping groups.
        self.group_names = set()
        #: After put_back(): what FreeCAD will not find, as "Face4: 3 nodes are off it by up to 0.2".
        self.lost = []
        self._mesh, self._near, self._shapes = mesh, near, shapes
        self._faces, self._edges, self._vertices = [], [], []
        if shapes and near.any():
            self._find_entities(mesh, shapes, near)
            on_some_face = np.isin(mesh.node_ids, [number for face in self._faces for number in face.nodes])
            self._mark_facets(mesh, on_some_face)
            self._mark_elements(mesh, on_some_face)
            for entity in self._edges + self._vertices:
                self._add_group(entity, "node", entity.nodes)

    # --- before the operator

    def _find_entities(self, mesh, shapes, near):
        finder = Fem.FemMesh()
        for number, point in zip(mesh.node_ids[near].tolist(), mesh.points[near].tolist()):
            finder.addNode(*point, number)
        for where, shape in shapes:
            if shape.ShapeType == "Vertex":
                # A group of one node: operators do not move it.
                vertex = Entity(where, shape)
                vertex.nodes = finder.getNodesByVertex(shape)
                self._vertices.append(vertex)
                continue
            solids = Owners((solid, solid.Faces) for solid in shape.Solids)
            faces = [
                Face(name_of(where, shape, "Face", i), face, len(solids.of(face))) for i, face in enumerate(shape.Faces)
            ]
            owners = Owners((face, face.shape.Edges) for face in faces)
            for face in faces:
                face.nodes = finder.getNodesByFace(face.shape)
            for i, shape_edge in enumerate(shape.Edges):
                if shape_edge.Degenerated:  # a pole of a sphere, the tip of a cone
                    continue
                edge = Edge(name_of(where, shape, "Edge", i), shape_edge, owners.of(shape_edge))
                # The seam of a closed face is no line the mesh has to keep.
                if not (len(edge.faces) == 1 and shape_edge.isSeam(edge.faces[0].shape)):
                    edge.nodes = finder.getNodesByEdge(shape_edge)
                    if edge.nodes:
                        self._edges.append(edge)
            self._faces += [face for face in faces if face.nodes]

    def _mark_facets(self, mesh, on_some_face):
        """Groups of the faces of tetrahedra that lie on each face: of the skin, or between two solids."""
        rows = [np.empty((0, 5), np.int64)]
        for name in TETRAS:
            if name in mesh.cells:
                cells = mesh.cells[name][:, :4]
                chosen = np.flatnonzero(on_some_face[cells].sum(axis=1) >= 3)
                for face, corners in enumerate(TETRA_FACES[:, :3]):
                    nodes = np.sort(cells[chosen][:, corners], axis=1)
                    rows.append(np.column_stack([nodes, mesh.cell_ids[name][chosen], np.full(len(chosen), face + 1)]))
        rows = np.concatenate(rows)
        _, first, owners = np.unique(rows[:, :3], axis=0, return_index=True, return_counts=True)
        rows = rows[first]
        for face, lying in zip(self._faces, self._lying_on(rows[:, :3], owners)):
            self._add_group(face, "facet", rows[lying, 3:])

    def _mark_elements(self, mesh, on_some_face):
        """Groups of the triangle elements that lie on each face."""
        for name in TRIANGLES:
            if name in mesh.cells:
                chosen = np.flatnonzero(on_some_face[mesh.cells[name][:, :3]].all(axis=1))
                triangles = mesh.cells[name][chosen, :3]
                for face, lying in zip(self._faces, self._lying_on(triangles, None)):
                    self._add_group(face, "element", mesh.cell_ids[name][chosen[lying]])

    def _lying_on(self, triangles, owners):
        """For each face the rows of `triangles` (corner nodes) that lie on it; `owners`: how many tetrahedra each
        belongs to."""
        lying = []
        for face in self._faces:
            on_face = np.isin(self._mesh.node_ids, face.nodes)
            mask = on_face[triangles].all(axis=1)
            if owners is not None and face.solids == 1:
                mask &= owners == 1
            lying.append(mask)
        lying = np.array(lying).reshape(len(self._faces), len(triangles))
        # A triangle whose corners are on the rim of two faces lies on the one that its middle is near.
        for row in np.flatnonzero(lying.sum(axis=0) > 1):
            candidates = np.flatnonzero(lying[:, row])
            middle = self._mesh.points[triangles[row]].mean(axis=0)
            lying[candidates, row] = False
            lying[min(candidates, key=lambda k: self._faces[k].distance(middle)), row] = True
        return lying

    def _add_group(self, entity, kind, ids):
        if not len(ids):
            return
        name = _GROUP + entity.name
        while any(group.name == name for group in self._mesh.groups.all(kind)) and (name, kind) not in entity.groups:
            name += "'"
        if (name, kind) in entity.groups:
            ids = np.concatenate([self._mesh.groups[name, kind].ids, ids])
            self._mesh.remove_group(name, kind)
        else:
            entity.groups.append((name, kind))
        self._mesh.add_group(name, kind, ids)
        self.group_names.add(name)

    # --- after the operator

    def covers(self, mesh):
        """Whether all nodes that the operator's result has moved, and all around its new nodes, were looked at."""
        if not self._shapes:
            return True
        known, moved, near = self._compared(mesh)
        if (moved & ~near).any():
            return False
        for nodes in mesh.cells.values():
            around_new = nodes[~known[nodes].all(axis=1)]
            if (known[around_new] & ~near[around_new]).any():
                return False
        return True

    def _compared(self, mesh):
        """Boolean arrays for the nodes of the operator's result: was there before, has moved, was looked at before."""
        order = np.argsort(self._mesh.node_ids)
        old_ids = self._mesh.node_ids[order]
        at = order[np.minimum(np.searchsorted(old_ids, mesh.node_ids), len(old_ids) - 1)]
        known = self._mesh.node_ids[at] == mesh.node_ids
        moved = known & (self._mesh.points[at] != mesh.points).any(axis=1)
        return known, moved, known & self._near[at]

    def put_back(self, mesh, tools, meant_to_leave=()):
        """Coordinates for the nodes of the operator's result: on the shapes, and on the tools, where they belong.

        Takes the bookkeeping groups out of `mesh`. Nodes that cannot go where they belong without spoiling an element
        stay, and so do those numbered in `meant_to_leave`; all are told in `lost`.
        """
        points = mesh.points.copy()
        if not self.group_names:
            return points
        entities = self._new_members(mesh)
        for group in [g for g in mesh.groups.all() if g.name in self.group_names]:
            mesh.remove_group(group.name, group.kind)

        size = np.ptp(points, axis=0).max()
        changed = np.zeros(mesh.node_count, bool)
        on_tool = np.array([np.abs(tool.distance(points)) < 1e-9 * size for tool in tools], bool)
        on_tool = on_tool.reshape(len(tools), mesh.node_count)
        leaves = np.isin(mesh.node_ids, meant_to_leave)
        for nodes, places in self._off(points, entities):
            if leaves[nodes].any():
                continue
            kept = [tool for tool, on in zip(tools, on_tool) if on[nodes[0]]]
            place = nearest(points[nodes[0]], places, kept, size)
            if place is not None:
                points[nodes] = place
                changed[nodes] = True
        known, moved, _ = self._compared(mesh)
        for node in carry_mid_sides(mesh, points, changed, ~known | moved):
            kept = [tool for tool, on in zip(tools, on_tool) if on[node]]
            place = nearest(points[node], [], kept, size) if kept else None
            points[node] = points[node] if place is None else place
        while True:
            spoilt = spoilt_by(mesh, points, changed)
            if not len(spoilt):
                break
            # Copies of a node at the same place go back together.
            places = set(map(tuple, mesh.points[spoilt]))
            back = np.flatnonzero(changed)
            back = back[[tuple(place) in places for place in mesh.points[back]]]
            points[back] = mesh.points[back]
            changed[back] = False
        for entity, nodes in entities:
            off = [d for d in map(entity.distance, points[nodes]) if not d < entity.tolerance]
            if off:
                self.lost.append(
                    f"{entity.name}: {len(off)} node{'s are' if len(off) > 1 else ' is'} off it by up to {max(off):.3g}"
                )
        return points

    def _new_members(self, mesh):
        """[(face or edge, indices of the nodes on it that are new or have moved and are not at once seen to be
        right)]."""
        known, moved, _ = self._compared(mesh)
        fresh = ~known | moved

        on_face = {}
        for face in self._faces:
            mask = np.zeros(mesh.node_count, bool)
            for name, kind in face.groups:
                ids = mesh.groups[name, kind].ids
                mask[nodes_of_facets(mesh, ids) if kind == "facet" else nodes_of_elements(mesh, ids)] = True
            on_face[face] = mask
        border = border_nodes(mesh)
        found = []
        for edge in self._edges:
            mask = np.zeros(mesh.node_count, bool)
            for name, kind in edge.groups:
                mask |= np.isin(mesh.node_ids, mesh.groups[name, kind].ids)
            # Two nodes of a curved edge may also be joined by a chord through the face or the material.
            owners = [on_face[face] for face in edge.faces if face in on_face]
            if len(owners) > 1:
                mask &= np.sum(owners, axis=0) > 1
            elif owners:
                mask &= owners[0] & border
            found.append((edge, mask & fresh))
        found += [(face, mask & fresh) for face, mask in on_face.items()]
        result = []
        for entity, mask in found:
            nodes = np.flatnonzero(mask)
            nodes = nodes[~entity.holds(mesh.points[nodes])]
            if len(nodes):
                result.append((entity, nodes))
        return result

    @staticmethod
    def _off(points, entities):
        """(node indices at one place, what they have to lie on): edges if there are any, else faces."""
        places = {}
        for entity, nodes in entities:
            for node in nodes.tolist():
                where, on = places.setdefault(tuple(points[node]), ([], []))
                if node not in where:
                    where.append(node)
                if entity not in on:
                    on.append(entity)
        for nodes, on in places.values():
            yield nodes, [e for e in on if isinstance(e, Edge)][:1] or on
