# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the document objects of FemScalpel have in common: a FEM mesh made from another one by an operator."""

import dataclasses

import FreeCAD
import Fem
import numpy as np

import femmesh_bridge
import femscalpel

from . import contents, extents, following, pieces, whole
from .geometry import shapes_of
from .memory import Made, Shown, memory
from .mesh_parts import nodes_around
from .on_shape import OnShape, without_bookkeeping
from .operator_options import KEEP_TO_SHAPE
from .ours import made_of
from .reason import Reason
from .said import said

if FreeCAD.GuiUp:
    from femscalpelgui.translate import translate
    from femscalpelgui.view.crack_lines import crack_shape

# Attribute bits of addProperty.
OUTPUT = 8  # setting it does not ask for a recompute

_RESULTS = (
    (
        "App::PropertyLength",
        "RefinedTo",
        "Longest edge at the tool after the refinement that came first; 0: there was none",
    ),
    ("App::PropertyInteger", "NodesAdded", "Nodes made by splitting and by doubling"),
    ("App::PropertyInteger", "NodesDoubled", "Nodes of the crack that each side has its own copy of"),
    ("App::PropertyInteger", "NodesMoved", "Nodes moved onto the tool or to improve elements"),
    ("App::PropertyFloat", "MinimumQuality", "Least mean ratio of the elements near the tool; 1 is equilateral"),
    ("App::PropertyFloat", "MinimumQualityBefore", "The same before"),
    ("App::PropertyLength", "MaxDisplacement", "Largest distance a node was moved"),
    ("App::PropertyStringList", "Warnings", "What to look at before trusting the mesh"),
    (
        "App::PropertyStringList",
        "OffShape",
        "Faces and edges of the geometry that mesh nodes could not be put back on; "
        "FreeCAD finds loads and supports by geometry and would miss these nodes",
    ),
    (
        "App::PropertyStringList",
        "Pieces",
        "Where the mesh is in more pieces than its source: how large each is, where, and what holds it",
    ),
    *extents.PROPERTIES,
    ("App::PropertyString", "ReportData", "The report as JSON"),
    ("App::PropertyStringList", "GroupReport", "Summary and table of groups, line by line"),
    ("App::PropertyMap", "NodeSetCounts", "Number of nodes in the sets ICN, ECN (interface), ITN, ETN (transition)"),
    ("App::PropertyMap", "ConstraintCounts", "Number of constraints on moving nodes by kind"),
)
# Values of the properties above of an object without a mesh.
_EMPTY = {"App::PropertyStringList": [], "App::PropertyMap": {}, "App::PropertyString": ""}
_NO_RESULTS = {name: _EMPTY.get(kind, 0) for kind, name, _ in _RESULTS}
# The link to the geometry that FreeCAD's solver writers look for on a mesh object: Part up to 0.21, Shape from 1.0.
_GEOMETRY_LINKS = ("Part", "Shape")
# Other meshes have a Shape that is geometry itself. The latter in 1.x, where a document of 0.20 is opened.
_LINK_TYPES = ("App::PropertyLink", "App::PropertyLinkGlobal")


class MeshOperation:
    """Proxy of a Fem::FemMeshObjectPython that holds its Source's mesh after an operator.

    After a recompute, `report` is the femscalpel.Report of it; it is not saved with the document.

    Coordinates are those the user sees: Source's placement is applied to its nodes, and the result has none of its own.
    Nodes that come to lie elsewhere on the geometry Source was made from are put onto it exactly, because FreeCAD finds
    the nodes of loads, supports and materials by their distance from it; see OnShape.

    When the mesh cannot be made the object is left without one, with FreeCAD's error mark and the reason, so that no
    outdated mesh can be mistaken for the result.

    FreeCAD drops empty groups whenever a mesh is given to a document object, and renumbers nodes and elements from 1
    when a document is saved. So a loaded object and a loaded Source may number the same element differently; a
    recompute (obj.touch(), then doc.recompute()) makes the mesh anew and brings the numbers together again.

    What was made while FreeCAD runs is remembered, and taken when it is asked for again: see memory.py and undo.py.

    A subclass says what its operator is by `Type`, INPUTS, and the methods tools(), where_nodes_may_move() and
    operate().
    """

    #: Properties (type, name, text, values) of the operator, in addition to Source; shown under the class's name. When
    #: they are added they are set to the values, one after the other: of an enumeration, first its list.
    INPUTS = ()
    #: Whether the operator takes the geometry as `skin`: the property KeepToShape.
    TAKES_SKIN = True
    #: Whether the operator moves walls off the geometry on purpose.
    MOVES_WALLS = False
    #: Whether a mesh in more pieces than its source is worth a word.
    TELLS_PIECES = True

    def __init__(self, obj):
        self._forget_state()
        obj.Proxy = self
        self.add_properties(obj)

    def _forget_state(self):
        self.report = None
        self.crack_shape = None  # of the mesh shown, in the window; None where it is to be looked for
        self.shown = None  # memory.Shown: which mesh the object holds; None while nobody has asked
        self.is_giving = False  # whether this gives the object a mesh just now
        self._wanted = None  # the Made that execute() is to show
        self._is_following = False  # whether it takes its numbers from geometry just now
        self._prepared = None  # the Made that begin() has led to, for execute() to take if it is still right
        self._parting = None  # the pieces.Parting of the mesh shown, once they were described

    # --- what a subclass says

    def tools(self, obj):
        """The femscalpel tools of the operator, in a list."""
        raise NotImplementedError

    def where_nodes_may_move(self, obj, mesh, tools):
        """Boolean array: the nodes of `mesh` the operator may move, or take as a parent of a new node, and some
        more."""
        return nodes_around(mesh, tools, rings=max(obj.Transition, 3) + 3)

    def operate(self, obj, mesh, tools):
        """The femscalpel.Result of the operator on `mesh`."""
        raise NotImplementedError

    def meant_to_leave(self, report):
        """Numbers of the nodes that the operator has moved off the geometry on purpose."""
        return ()

    # --- properties

    def add_properties(self, obj):
        """Adds the properties an object of an older version may lack."""
        present = set(obj.PropertiesList)
        section = type(self).__name__
        for kind, name, text, *values in (
            ("App::PropertyLink", "Source", "FEM mesh object to work on; it is not changed"),
            *self.INPUTS,
            *((KEEP_TO_SHAPE,) if self.TAKES_SKIN else ()),
        ):
            if name in present:
                continue
            obj.addProperty(kind, name, section, text)
            for value in values:
                setattr(obj, name, value)
        for kind, name, text in _RESULTS:
            if name not in present:
                obj.addProperty(kind, name, "Result", text, OUTPUT)
            obj.setEditorMode(name, 2 if name == "ReportData" else 1)
        for kind, name, text in (
            ("App::PropertyLinkHidden", "Replaced", "Mesh whose place in an analysis this one has taken"),
            ("App::PropertyLinkListHidden", "ReplacedAdditions", "Meshes added to it that were in that analysis, too"),
        ):
            if name not in present:
                obj.addProperty(kind, name, section, text, OUTPUT)
            obj.setEditorMode(name, 2)
        obj.setEditorMode("Placement", 2)
        following.set_up(obj)

    def onDocumentRestored(self, obj):
        self.add_properties(obj)
        self._link_geometry(obj)  # FreeCAD renames the source's link in documents of another release

    def onChanged(self, obj, prop):
        # While a document loads, a link may be set before what it points to is complete.
        if "Restore" in obj.State or obj.Document.Restoring:
            return
        if prop == "Source":
            self._link_geometry(obj)
        elif prop in following.NUMBERS_THAT_FOLLOW and not self._is_following and not obj.Document.Transacting:
            self._is_following = True
            try:
                following.changed_by_hand(obj, prop)
            finally:
                self._is_following = False

    def _link_geometry(self, obj):
        source = obj.Source
        for name in _GEOMETRY_LINKS:
            linked = (
                source is not None and name in source.PropertiesList and source.getTypeIdOfProperty(name) in _LINK_TYPES
            )
            if linked and name not in obj.PropertiesList:
                obj.addProperty("App::PropertyLink", name, "FEM Mesh", "Geometry the source mesh is made from", OUTPUT)
                obj.setEditorMode(name, 1)
            if name in obj.PropertiesList:
                value = getattr(source, name) if linked else None
                if getattr(obj, name) != value:
                    setattr(obj, name, value)

    # --- making the mesh

    def execute(self, obj):
        """Makes the mesh from Source, or takes the one that was made from the same before. Raises Reason, a
        RuntimeError, when it cannot."""
        self._link_geometry(obj)
        made, self._wanted = self._wanted, None
        if made is not None:
            self._give(obj, made)
            return
        inputs = self._inputs(obj)
        try:
            made, is_new = self._made(obj, inputs)
        except (femscalpel.Error, ValueError, TypeError) as error:
            made = Made(inputs, None, b"none", error=whole.shortened(str(error), obj.Document))
            memory.keep(obj.Document, made)
            self._give(obj, made, error)
        except Exception:
            self._clear(obj)
            raise
        if is_new:
            memory.keep(obj.Document, made)
            for warning in made.report.warnings:
                FreeCAD.Console.PrintWarning(f"{obj.Label}: {said(warning)}\n")
        self._give(obj, made, aloud=True)

    def begin(self, obj, foreseen=None):
        """What execute() would compute, as a function that another thread can call: with `progress` or None, called as
        progress(step, fraction of it or None), which may raise femscalpel.Cancelled. What the function returns is for
        adopt(). None where nothing is to be computed, also as it was `foreseen`: a Made that was computed for a StandIn
        like the object. Raises what execute() does, not as Reason.

        The object and what it is made from must not change meanwhile, unless it is a StandIn.
        """
        self._link_geometry(obj)
        self.mesh_of(obj, "Source")
        inputs, surroundings = self._inputs(obj), contents.surroundings_of(obj)
        self._check_following(obj)
        if self._remembered(obj, inputs, surroundings) is not None:
            return None
        if foreseen is not None and None not in (surroundings, foreseen.surroundings):
            if (foreseen.inputs, foreseen.surroundings) == (inputs, surroundings):
                self.adopt(foreseen)
                return None
        femmesh = Fem.FemMesh()  # here, as FreeCAD counts them
        return lambda progress=None: self._compute(obj, inputs, surroundings, femmesh, progress)

    def adopt(self, made):
        """Has the next execute() show this, if it is still what it would make."""
        self._prepared = made

    def _made(self, obj, inputs):
        """(Made, whether it was made just now)."""
        self.mesh_of(obj, "Source")
        self._check_following(obj)
        surroundings = contents.surroundings_of(obj)
        prepared, self._prepared = self._prepared, None
        if prepared is not None and prepared.inputs == inputs and prepared.surroundings == surroundings:
            self._check_names(obj, prepared.report)
            return prepared, True
        made = self._remembered(obj, inputs, surroundings)
        if made is not None:
            self._check_names(obj, made.report)
            return made, False
        return self._compute(obj, inputs, surroundings, Fem.FemMesh()), True

    def _inputs(self, obj):
        """contents.inputs_of(), once the numbers are those of the geometry that they follow."""
        was, self._is_following = self._is_following, True
        try:
            following.follow(obj)
        except ValueError:  # see _check_following()
            pass
        finally:
            self._is_following = was
        return contents.inputs_of(obj)

    @staticmethod
    def _check_following(obj):
        problem = following.problem_of(obj)
        if problem:
            raise ValueError(problem)

    @staticmethod
    def _remembered(obj, inputs, surroundings):
        """The Made of the same inputs and surroundings, or None."""
        made = memory.of(obj.Document, inputs)
        if made is not None and None not in (surroundings, made.surroundings) and surroundings == made.surroundings:
            return made
        return None

    def _compute(self, obj, inputs, surroundings, femmesh, progress=None):
        """The Made; `femmesh`, an empty one, becomes its mesh."""
        tell = progress or (lambda step, fraction=None: None)
        tell("read")
        mesh, is_whole = contents.read_mesh(obj.Source)
        tell("operate")
        tools = self.tools(obj)
        result, on_shape = self.result(obj, mesh, tools, self.where_nodes_may_move(obj, mesh, tools))
        tell("shape")
        points = on_shape.put_back(result.mesh, tools, self.meant_to_leave(result.report))
        report = self._completed(result.report, on_shape, obj.Document)
        if not is_whole:
            report = dataclasses.replace(report, warnings=[*report.warnings, *whole.left_behind(obj.Source)])
        self._check_names(obj, report)
        groups = self._node_groups(obj.Source.FemMesh, report)
        femmesh_bridge.to_femmesh(
            result.mesh,
            groups,
            points,
            femmesh,
            lambda part: tell("femmesh", part),
            (lambda lost: None) if is_whole else None,
        )
        token = inputs + (surroundings or contents.unique())
        parting = None
        if self.TELLS_PIECES:
            known = {(group.name, group.kind) for group in mesh.groups.all()}
            parting = pieces.parting_of(result.mesh, len(femscalpel.pieces(mesh)), known=known)
        return Made(
            inputs,
            surroundings,
            token,
            femmesh,
            _results(report, on_shape.lost, extents.hole_of(result.mesh, report, tools)),
            report,
            picture=crack_shape(result.mesh, report.name, points) if FreeCAD.GuiUp else None,
            parting=parting,
            whole=result.mesh if is_whole and np.array_equal(points, result.mesh.points) else None,
        )

    def result(self, obj, mesh, tools, near):
        """(femscalpel.Result, OnShape) of the operator on `mesh`, which has the nodes `near` marked that may move."""
        marked = mesh.copy()
        on_shape = OnShape(marked, shapes_of(obj), near)
        result = self.operate(obj, marked, tools)
        if not on_shape.covers(result.mesh):
            return self.result(obj, mesh, tools, np.ones(mesh.node_count, bool))
        return result, on_shape

    @staticmethod
    def mesh_of(obj, link):
        """The FemMesh that the property `link`, Source or Addition, leads to; ValueError where there is none."""
        other = getattr(obj, link)
        if other is None:
            raise ValueError(f"{link} is not set; choose the FEM mesh to {'add' if link == 'Addition' else 'work on'}")
        if not other.isDerivedFrom("Fem::FemMeshObject"):
            raise ValueError(f"{link} '{other.Label}' is not a FEM mesh")
        if "Invalid" in other.State:
            raise ValueError(f"{link} '{other.Label}' has an error; mend it first")
        if other.FemMesh.NodeCount == 0:
            raise ValueError(f"{link} '{other.Label}' has no mesh; make it first")
        return other.FemMesh

    @staticmethod
    def _completed(report, on_shape, document):
        """The operator's report without the bookkeeping groups of `on_shape`, with its warnings."""
        lost = [
            f"{line}: FreeCAD will not find these nodes by geometry, so that a load, support or material on it is "
            f"incomplete"
            for line in on_shape.lost
        ]
        return dataclasses.replace(
            report,
            groups=[g for g in report.groups if g.name not in on_shape.group_names],
            warnings=[whole.shortened(text, document) for text in without_bookkeeping(report.warnings)] + lost,
        )

    @staticmethod
    def _check_names(obj, report):
        """FreeCAD's solver writers take any group whose name begins with a constraint's name and "_" for that
        constraint's."""
        for group in report.groups:
            if group.status != "new":
                continue
            for other in obj.Document.Objects:
                if group.name.startswith(other.Name + "_") and hasattr(other, "References"):
                    raise ValueError(
                        f"the new group '{group.name}' would be taken for the nodes of '{other.Label}'; "
                        "choose another GroupName"
                    )

    def _node_groups(self, source, report):
        """Names of the new groups that must be node groups.

        Once a solid mesh has any face elements, FreeCAD's solver writers look for loaded faces among them only, and
        find none on a mesh that has but the crack's lips: the load would be lost without a message.
        """
        if source.VolumeCount == 0 or source.FaceCount > 0:
            return ()
        return tuple(g.name for g in report.groups if g.status == "new" and g.kind == "element")

    # --- giving it to the object

    def give_back(self, obj, made):
        """Shows what `obj` has computed before, and nothing is left to compute."""
        if "Invalid" in obj.State or made.error:
            self._wanted = made
            obj.recompute()  # of this object alone: nothing else takes the mark of an error away, or puts it there
        else:
            self._give(obj, made)
        if not made.error:
            obj.purgeTouched()

    def _give(self, obj, made, cause=None, aloud=False):
        """Shows a Made, and says `aloud` what its part falls into. Raises Reason when it is a failure."""
        if made.femmesh is None:
            self._clear(obj)
            self.shown = Shown(made.inputs, made.token)
            if made.error:
                raise Reason(f"{obj.Label}: {said(made.error)}") from cause
            return
        if not obj.Placement.isIdentity():
            obj.Placement = FreeCAD.Placement()
        self.crack_shape = made.picture
        if self.shown is None or self.shown.token != made.token:
            self._set_mesh(obj, made.femmesh)
        self.shown = Shown(made.inputs, made.token)
        self._set_results(obj, made.results)
        self._parting = made.parting
        if made.parting is not None:  # what holds the pieces may have changed since
            self._describe_pieces(obj, aloud)
        self.report = made.report

    def describe_again(self, obj):
        """Says anew what holds the pieces, where the mesh is in more than its source: analysis and constraints may have
        changed without a need to compute the mesh again."""
        if not obj.Pieces or not obj.FemMesh.NodeCount:
            return
        if self._parting is None:  # of a document that was opened
            source = contents.read_mesh(obj.Source)[0]
            known = {(group.name, group.kind) for group in source.groups.all()}
            mesh = contents.read_mesh(obj)[0]
            self._parting = pieces.parting_of(mesh, len(femscalpel.pieces(source)), known=known)
        if self._parting is not None:
            self._describe_pieces(obj)

    def _describe_pieces(self, obj, aloud=False):
        """Says what the part falls into and what holds the pieces, `aloud` in the report view."""
        parting = self._parting
        held = pieces.holders(parting, pieces.find_supports(obj))
        items = pieces.items_of(parting, held)
        if items == obj.Pieces:
            return
        sentence = pieces.sentence_of(parting, held)
        obj.Pieces = items
        label = f"  {'pieces':<12} "
        lines = [line for line in obj.GroupReport if not line.startswith(label)]
        lines.insert(lines.index("") if "" in lines else len(lines), label + sentence)
        obj.GroupReport = lines
        if aloud:
            tell = FreeCAD.Console.PrintWarning if pieces.is_unsafe(held) else FreeCAD.Console.PrintMessage
            text = pieces.sentence_of(parting, held, translate) if FreeCAD.GuiUp else sentence
            tell(f"{obj.Label}: {text}\n")

    def _set_mesh(self, obj, femmesh):
        if self.shown is not None and self.shown.loaded:
            results = {name: getattr(obj, name) for name in _NO_RESULTS}
            made = Made(self.shown.inputs, None, self.shown.token, obj.FemMesh.copy(), results, self.report)
            memory.keep(obj.Document, made)
        self.is_giving = True
        try:
            obj.FemMesh = femmesh
        finally:
            self.is_giving = False

    @staticmethod
    def _set_results(obj, results):
        for name, value in results.items():
            setattr(obj, name, value)

    def _clear(self, obj):
        # FreeCAD does not recompute what depends on a failed object, so it would keep showing its outdated mesh.
        for dependent in obj.InList:
            if isinstance(getattr(dependent, "Proxy", None), MeshOperation) and obj in made_of(dependent):
                dependent.Proxy._clear(dependent)
        self.report = self.crack_shape = self._parting = None
        self._set_mesh(obj, Fem.FemMesh())
        self.shown = Shown(None, b"none")
        self._set_results(obj, _NO_RESULTS)

    def dumps(self):
        """State FreeCAD saves with the document: none, the properties say everything."""
        return None

    def loads(self, state):
        """Called by FreeCAD in place of __init__ when a document is loaded."""
        self._forget_state()

    # FreeCAD before 0.21.2 asks for these.
    __getstate__ = dumps
    __setstate__ = loads


def _results(report, lost, hole):
    """Values of the properties of the group Result. `hole` as by extents.hole_of()."""
    before, after = report.quality
    lines = report.to_text().splitlines()
    if hole is not None:
        lines.insert(1, extents.hole_line(hole))
    return {
        "RefinedTo": report.refinement.size if report.refinement else 0,
        "NodesAdded": report.nodes_added,
        "NodesDoubled": report.nodes_doubled,
        "NodesMoved": report.nodes_moved,
        "MinimumQuality": after.minimum,
        "MinimumQualityBefore": before.minimum,
        "MaxDisplacement": report.max_displacement,
        "Warnings": report.warnings,
        "Pieces": [],
        "OffShape": lost,
        **extents.values_of(report, hole and hole[0]),
        "ReportData": report.to_json(node_ids=False),  # FreeCAD renumbers nodes when it saves a document
        "GroupReport": lines,
        "NodeSetCounts": {name: str(len(ids)) for name, ids in report.node_sets.items()},
        "ConstraintCounts": {kind: str(count) for kind, count in report.constraints.items()},
    }
