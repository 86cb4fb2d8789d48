# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object: a FEM mesh, cracked along a plane."""

import FreeCAD
import Fem

import femmesh_bridge
import femscalpel

# Attribute bits of addProperty.
_OUTPUT = 8  # setting it does not ask for a recompute

_INPUTS = (
    ("App::PropertyLink", "Source", "FEM mesh object to crack; it is not changed"),
    ("App::PropertyPlacement", "PlanePlacement", "The crack's plane: XY plane of this placement, z is the positive side"),
    ("App::PropertyEnumeration", "Method", "snap: move and split, always succeeds; deform: only move nodes"),
    ("App::PropertyIntegerConstraint", "Transition", "Rings of elements around the plane that may move; 0: automatic"),
    ("App::PropertyAngle", "FeatureAngle", "Skin edges sharper than this keep their shape"),
    ("App::PropertyString", "GroupName", "Prefix of the new groups: NAME_P and NAME_N are the lips"),
)
_RESULTS = (
    ("App::PropertyInteger", "NodesAdded", "Nodes made by splitting and by doubling"),
    ("App::PropertyInteger", "NodesDoubled", "Nodes of the crack that each side has its own copy of"),
    ("App::PropertyInteger", "NodesMoved", "Nodes moved onto the plane or to improve elements"),
    ("App::PropertyFloat", "MinimumQuality", "Least mean ratio of the elements near the plane; 1 is equilateral"),
    ("App::PropertyFloat", "MinimumQualityBefore", "The same before the crack was made"),
    ("App::PropertyLength", "MaxDisplacement", "Largest distance a node was moved"),
    ("App::PropertyStringList", "Warnings", "What to look at before trusting the mesh"),
    ("App::PropertyStringList", "GroupReport", "Summary and table of groups, line by line"),
    ("App::PropertyMap", "NodeSetCounts", "Number of nodes in the sets ICN, ECN (interface), ITN, ETN (transition)"),
    ("App::PropertyMap", "ConstraintCounts", "Number of constraints on moving nodes by kind"),
)
# The link to the geometry that FreeCAD's solver writers look for on a mesh object: Part up to 0.21, Shape from 1.0.
_GEOMETRY_LINKS = ("Part", "Shape")


class Crack:
    """Proxy of a Fem::FemMeshObjectPython that holds its Source's mesh, cracked along a plane.

    After a recompute, `report` is the femscalpel.Report of it; it is not saved with the document.

    Coordinates are those the user sees: Source's placement is applied to its nodes, and the result has none of its own.
    When the crack cannot be made the object is left without a mesh, with FreeCAD's error mark and the reason, so that
    no outdated mesh can be mistaken for the result.

    FreeCAD drops empty groups whenever a mesh is given to a document object, and renumbers nodes and elements from 1 when
    a document is saved. So a loaded object and a loaded Source may number the same element differently; a recompute
    (obj.touch(), then doc.recompute()) makes the mesh anew and brings the numbers together again.
    """

    Type = "FemScalpel::Crack"

    def __init__(self, obj):
        self.report = None
        obj.Proxy = self
        self.add_properties(obj)

    def add_properties(self, obj):
        """Adds the properties an object of an older version may lack."""
        present = set(obj.PropertiesList)
        for kind, name, text in _INPUTS:
            if name in present:
                continue
            obj.addProperty(kind, name, "Crack", text)
            if name == "Method":
                obj.Method = list(femscalpel.operators.METHODS)
                obj.Method = "snap"
            elif name == "Transition":
                obj.Transition = (0, 0, 1000, 1)
            elif name == "FeatureAngle":
                obj.FeatureAngle = 30
            elif name == "GroupName":
                obj.GroupName = "CRACK"
        for kind, name, text in _RESULTS:
            if name not in present:
                obj.addProperty(kind, name, "Result", text, _OUTPUT)
            obj.setEditorMode(name, 1)
        obj.setEditorMode("Placement", 2)

    def onDocumentRestored(self, obj):
        self.add_properties(obj)

    def onChanged(self, obj, prop):
        # While a document loads, a link may be set before what it points to is complete.
        if prop == "Source" and "Restore" not in obj.State:
            self._link_geometry(obj)

    def _link_geometry(self, obj):
        source = obj.Source
        for name in _GEOMETRY_LINKS:
            linked = source is not None and name in source.PropertiesList and \
                source.getTypeIdOfProperty(name) == "App::PropertyLink"
            if linked and name not in obj.PropertiesList:
                obj.addProperty("App::PropertyLink", name, "FEM Mesh", "Geometry the source mesh is made from", _OUTPUT)
                obj.setEditorMode(name, 1)
            if name in obj.PropertiesList:
                value = getattr(source, name) if linked else None
                if getattr(obj, name) != value:
                    setattr(obj, name, value)

    def execute(self, obj):
        """Makes the mesh anew from Source. Raises RuntimeError with the reason when it cannot."""
        self._link_geometry(obj)
        try:
            source = self._source_mesh(obj)
            result = femscalpel.crack(
                femmesh_bridge.from_femmesh(source), self._plane(obj), name=obj.GroupName, method=obj.Method,
                transition=obj.Transition or None, feature_angle=obj.FeatureAngle.Value)
            femmesh = femmesh_bridge.to_femmesh(result.mesh, self._node_lips(source, result.report))
        except Exception as error:
            self._clear(obj)
            if isinstance(error, (femscalpel.Error, ValueError, TypeError)):
                raise RuntimeError(f"{obj.Label}: {error}") from error
            raise
        if not obj.Placement.isIdentity():
            obj.Placement = FreeCAD.Placement()
        obj.FemMesh = femmesh
        self._show(obj, result.report)

    @staticmethod
    def _source_mesh(obj):
        source = obj.Source
        if source is None:
            raise ValueError("Source is not set; choose the FEM mesh to crack")
        if not source.isDerivedFrom("Fem::FemMeshObject"):
            raise ValueError(f"Source '{source.Label}' is not a FEM mesh")
        if "Invalid" in source.State:
            raise ValueError(f"Source '{source.Label}' has an error; mend it first")
        if source.FemMesh.NodeCount == 0:
            raise ValueError(f"Source '{source.Label}' has no mesh; make it first")
        return source.FemMesh

    @staticmethod
    def _plane(obj):
        placement = obj.PlanePlacement
        return femscalpel.Plane(placement.Base, placement.Rotation.multVec(FreeCAD.Vector(0, 0, 1)))

    @staticmethod
    def _node_lips(source, report):
        """Names of the lip groups that must be node groups.

        Once a solid mesh has any face elements, FreeCAD's solver writers look for loaded faces among them only, and
        find none on a mesh that has but the crack's lips: the load would be lost without a message.
        """
        if source.VolumeCount == 0 or source.FaceCount > 0:
            return ()
        return tuple(g.name for g in report.groups if g.status == "new" and g.kind == "element")

    def _show(self, obj, report):
        self.report = report
        for warning in report.warnings:
            FreeCAD.Console.PrintWarning(f"{obj.Label}: {warning}\n")
        before, after = report.quality
        obj.NodesAdded = report.nodes_added
        obj.NodesDoubled = report.nodes_doubled
        obj.NodesMoved = report.nodes_moved
        obj.MinimumQuality = after.minimum
        obj.MinimumQualityBefore = before.minimum
        obj.MaxDisplacement = report.max_displacement
        obj.Warnings = report.warnings
        obj.GroupReport = report.to_text().splitlines()
        obj.NodeSetCounts = {name: str(len(ids)) for name, ids in report.node_sets.items()}
        obj.ConstraintCounts = {kind: str(count) for kind, count in report.constraints.items()}

    def _clear(self, obj):
        # FreeCAD does not recompute what depends on a failed object, so it would keep showing its outdated mesh.
        for dependent in obj.InList:
            if isinstance(getattr(dependent, "Proxy", None), Crack) and dependent.Source == obj:
                dependent.Proxy._clear(dependent)
        self.report = None
        obj.FemMesh = Fem.FemMesh()
        for name in ("NodesAdded", "NodesDoubled", "NodesMoved", "MinimumQuality", "MinimumQualityBefore", "MaxDisplacement"):
            setattr(obj, name, 0)
        obj.Warnings = []
        obj.GroupReport = []
        obj.NodeSetCounts = {}
        obj.ConstraintCounts = {}

    def dumps(self):
        """State FreeCAD saves with the document: none, the properties say everything."""
        return None

    def loads(self, state):
        """Called by FreeCAD in place of __init__ when a document is loaded."""
        self.report = None

    # FreeCAD before 0.21.2 asks for these.
    __getstate__ = dumps
    __setstate__ = loads
