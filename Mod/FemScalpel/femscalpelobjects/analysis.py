# SPDX-License-Identifier: LGPL-2.1-or-later
"""A modified mesh in the place of its source in a FEM analysis, and back."""

from contextlib import contextmanager

import FreeCAD
import numpy as np

import femmesh_bridge
from femscalpel.mesh import CELL_TYPES

from .geometry import element_of, geometry_of
from .ours import made_of
from .said import said


def put_into_analysis(obj, strict=True):
    """See ObjectsFemScalpel.putIntoAnalysis()."""
    analysis, replaced = _place_of_source(obj)
    if "Touched" in obj.State:
        obj.recompute(True)
    if "Invalid" in obj.State or obj.FemMesh.NodeCount == 0:
        raise ValueError(f"'{obj.Label}' has no mesh; mend what its error says first")
    problems = lost_references(obj, replaced, analysis)
    if problems and strict:
        raise ValueError(
            f"FreeCAD would not apply everything in '{analysis.Label}' to '{obj.Label}': "
            + "; ".join(problems)
            + ". Move the tool a little, or refine the mesh there"
        )
    for problem in problems:
        FreeCAD.Console.PrintWarning(f"{obj.Label}: {problem}\n")
    with transaction(obj.Document, f"Put {obj.Label} into {analysis.Label}"):
        additions = [mesh for mesh in _all_made_of(obj) if mesh != replaced and mesh in analysis.Group]
        _exchange(analysis, [replaced, *additions], [obj])
        obj.Replaced, obj.ReplacedAdditions = replaced, additions
    return analysis


def take_out_of_analysis(obj):
    """See ObjectsFemScalpel.takeOutOfAnalysis()."""
    for analysis in _analyses(obj.Document):
        if obj in analysis.Group:
            with transaction(obj.Document, f"Take {obj.Label} out of {analysis.Label}"):
                _exchange(analysis, [obj], [obj.Replaced or obj.Source, *obj.ReplacedAdditions])
                obj.Replaced, obj.ReplacedAdditions = None, []
            return analysis
    raise ValueError(f"'{obj.Label}' is in no analysis")


def analysis_of(obj):
    """The analysis that a mesh object is in, or None."""
    return next((analysis for analysis in _analyses(obj.Document) if obj in analysis.Group), None)


def lost_references(obj, source, analysis):
    """What FreeCAD's search by geometry would not, or wrongly, find on the mesh of `obj`; sentences, none if all is
    well. Faces that an operator has moved on purpose matter where a member of the analysis refers to them.

    Only what an operator of FemScalpel can cause: nodes that could not be put back on the geometry, a vertex that has
    lost its node, and a force on a vertex or an edge that a crack has doubled (FreeCAD drops the one and counts the
    other twice).
    """
    problems = []
    mesh = obj
    while mesh is not None and mesh != source:
        lines = getattr(mesh, "OffShape", ())
        if getattr(getattr(mesh, "Proxy", None), "MOVES_WALLS", False):
            lines = [line for line in lines if _is_referred_to(line.split(":")[0], analysis, geometry_of(mesh))]
        problems += [f"{line} (from '{mesh.Label}')" for line in lines]
        mesh = getattr(mesh, "Source", None)
    for member in analysis.Group:
        for part, names in getattr(member, "References", ()):
            for name in names:
                shape = element_of(part, name)
                if shape.ShapeType == "Vertex" and len(source.FemMesh.getNodesByVertex(shape)) > len(
                    obj.FemMesh.getNodesByVertex(shape)
                ):
                    problems.append(
                        f"'{obj.Label}' has no node at {part.Label}.{name}, which '{member.Label}' refers to"
                    )
                elif member.isDerivedFrom("Fem::ConstraintForce") and _is_doubled(obj.FemMesh, shape):
                    problems.append(f"the tool doubles {part.Label}.{name}, which '{member.Label}' loads")
    return problems


def _is_referred_to(name, analysis, geometry):
    """Whether a member of an analysis refers to a face or edge, called as in OffShape, or to a whole solid."""
    for member in analysis.Group:
        for part, elements in getattr(member, "References", ()):
            for element in elements:
                called = element if part == geometry else f"{part.Name}.{element}"
                if called == name or element.startswith("Solid"):
                    return True
    return False


def _is_doubled(femmesh, shape):
    """Whether a vertex has several nodes, or an edge a mesh edge that is there twice."""
    if shape.ShapeType == "Vertex":
        return len(femmesh.getNodesByVertex(shape)) > 1
    if shape.ShapeType != "Edge":
        return False
    nodes = femmesh.getNodesByEdge(shape)
    coordinates = femmesh.Nodes
    if len({tuple(coordinates[n]) for n in nodes}) > len(nodes) - 2:
        return False  # at most one place is doubled: the crack crosses the edge
    mesh = femmesh_bridge.from_femmesh(femmesh)
    on_edge = np.isin(mesh.node_ids, nodes)
    pairs = set()
    for name, cells in mesh.cells.items():
        corners = cells[:, : CELL_TYPES[name][2]]
        for row in corners[on_edge[corners].sum(axis=1) > 1]:
            found = sorted(row[on_edge[row]].tolist())
            pairs.update((a, b) for i, a in enumerate(found) for b in found[i + 1 :])
    places = {tuple(sorted((tuple(mesh.points[a]), tuple(mesh.points[b])))) for a, b in pairs}
    return len(places) < len(pairs)


@contextmanager
def transaction(doc, name):
    """One step for the user to undo; part of the caller's if one is open."""
    if FreeCAD.getActiveTransaction() or doc.HasPendingTransaction:
        yield
        return
    doc.openTransaction(name)
    try:
        yield
    except BaseException:
        doc.abortTransaction()
        raise
    doc.commitTransaction()


def _place_of_source(obj):
    """(analysis, mesh in it that `obj` is made from): of a chain, the last mesh that is in one."""
    mesh = obj.Source
    while mesh is not None:
        for analysis in _analyses(obj.Document):
            if mesh in analysis.Group:
                return analysis, mesh
        mesh = getattr(mesh, "Source", None)
    raise ValueError(f"the mesh that '{obj.Label}' is made from is in no analysis")


def _all_made_of(obj):
    """All meshes that go into that of `obj`, its sources' sources and additions among them."""
    return [mesh for link in made_of(obj) for mesh in (link, *_all_made_of(link))]


def _exchange(analysis, old, new):
    for mesh in old:
        analysis.removeObject(mesh)
    for mesh in new:
        if mesh is not None and mesh not in analysis.Group:
            analysis.addObject(mesh)
    _retire_results(analysis, old[0])


def _retire_results(analysis, mesh):
    """Results in an analysis are of the mesh that was in it: away with them, as when FreeCAD solves anew, or
    renamed."""
    results = [m for m in analysis.Group if m.isDerivedFrom("Fem::FemResultObject")]
    if not results:
        return
    if FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/Fem/General").GetBool("KeepResultsOnReRun", False):
        for result in results:
            if "(of " not in result.Label:
                result.Label = f"{result.Label} (of {mesh.Label})"
        return
    from femresult.resulttools import purge_results

    purge_results(analysis)
    text = said(f"the results of '{mesh.Label}' are removed; solve again")
    FreeCAD.Console.PrintMessage(f"{analysis.Label}: {text}\n")


def _analyses(doc):
    return doc.findObjects("Fem::FemAnalysis")
