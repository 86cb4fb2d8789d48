# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes FemScalpel's document objects, for scripts and macros.

    import ObjectsFemScalpel

    crack = ObjectsFemScalpel.makeCrack(doc, doc.FEMMeshGmsh, origin=(50, 0, 0), normal=(1, 0, 0))
    doc.recompute()
    print("\\n".join(crack.GroupReport))
    ObjectsFemScalpel.putIntoAnalysis(crack)
"""

import FreeCAD

import femmesh_bridge
import femscalpel
from femscalpelobjects.analysis import put_into_analysis, take_out_of_analysis
from femscalpelobjects.crack import Crack
from femscalpelobjects.cylindrical_crack import CylindricalCrack
from femscalpelobjects.drill import Drill
from femscalpelobjects.group_names import rename_group

if FreeCAD.GuiUp:
    from femscalpelgui.viewproviders.mesh_operation import ViewProviderMeshOperation


def makeCrack(doc, source, name="Crack", placement=None, origin=None, normal=None, method="snap", transition=0,
              group_name="CRACK", feature_angle=30.0):
    """Adds a parametric mesh object to `doc`: the mesh of `source`, cracked along a plane.

    The mesh is made by doc.recompute(), and again whenever the source or a property changes. `source` stays as it is.

    Parameters
    ----------
    doc : App.Document
    source : Fem::FemMeshObject
        The mesh to crack; any FEM mesh object of the document, also another crack.
    name : str
        Name of the new object.
    placement : App.Placement, optional
        The plane is the XY plane of this placement, its z axis points to the positive side.
    origin, normal : App.Vector or three numbers, optional
        The plane in another form; not together with `placement`. Both default to the middle of the mesh and z.
    method : {"snap", "deform"}
        See femscalpel.crack.
    transition : int
        Rings of elements around the plane that may move; 0: automatic.
    group_name : str
        Prefix of the new mesh groups: ``group_name_P`` and ``group_name_N`` are the lips. Face elements; if the
        source is a solid mesh without face elements, groups of nodes (FreeCAD's solver writers would lose face loads
        on a mesh with some face elements only).
    feature_angle : float
        Degrees; skin edges sharper than this keep their shape.

    Returns
    -------
    App.DocumentObject
        A Fem::FemMeshObjectPython. Its properties Warnings, GroupReport, MinimumQuality etc. say what was done;
        after a recompute its Proxy.report is the femscalpel.Report.

    Raises
    ------
    TypeError, ValueError
        `source` is not a FEM mesh object of `doc`, the plane is given twice or has a zero normal, or an option is
        not one the property takes. Nothing is added then.
    """
    return _make(doc, source, name, Crack, lambda: {"PlanePlacement": _placement(source, placement, origin, normal)},
                 Method=method, Transition=transition, GroupName=group_name, FeatureAngle=feature_angle)


def makeCylindricalCrack(doc, source, name="CylindricalCrack", placement=None, origin=None, axis=None, radius=1.0, method="snap",
                         transition=0, group_name="CRACK", feature_angle=30.0):
    """Adds a parametric mesh object to `doc`: the mesh of `source`, cracked along a cylinder.

    The axis is the z axis of `placement`, or goes through `origin` along `axis`; `radius` in mm. ``group_name_N`` is the
    inner lip. The rest is as for makeCrack().
    """
    return _make(doc, source, name, CylindricalCrack, lambda: {"AxisPlacement": _placement(source, placement, origin, axis)},
                 Radius=radius, Method=method, Transition=transition, GroupName=group_name, FeatureAngle=feature_angle)


def makeDrill(doc, source, name="Drill", placement=None, origin=None, axis=None, radius=1.0, depth=None, method="snap",
              transition=0, group_name="HOLE", feature_angle=30.0):
    """Adds a parametric mesh object to `doc`: the mesh of `source` with a hole in it.

    The axis is the z axis of `placement`, or goes through `origin` along `axis`; `radius` in mm. A blind hole ends `depth`
    beyond the origin along the axis; None: through the whole part. The new group is ``group_name_WALL``, and
    ``group_name_BOTTOM`` of a blind hole. The rest is as for makeCrack().
    """
    return _make(doc, source, name, Drill, lambda: {"AxisPlacement": _placement(source, placement, origin, axis)}, Radius=radius,
                 Through=depth is None, Depth=depth or 0, Method=method, Transition=transition, GroupName=group_name,
                 FeatureAngle=feature_angle)


def putIntoAnalysis(obj, strict=True):
    """Puts `obj` into the FEM analysis its source mesh is in, in the source's place, and returns the analysis.

    A FreeCAD analysis solves the one mesh it contains. Loads, supports and materials need no change: FreeCAD finds their
    nodes by mesh group, or by geometry, on which FemScalpel keeps the nodes. For a crack of a crack, the last mesh of the
    chain that is in an analysis is replaced. Results of the old mesh are removed, or, if FreeCAD's preference is to keep
    results, renamed. All this is one step to undo.

    Raises ValueError, and changes nothing, when there is no such analysis, when `obj` has an error, and, with `strict`,
    when FreeCAD would not find all nodes a load, support or material is meant for; the message says where. With
    strict=False that is a warning in the report view.
    """
    return put_into_analysis(obj, strict)


def takeOutOfAnalysis(obj):
    """Undoes putIntoAnalysis(): the mesh that was replaced takes its place back. Returns the analysis. One step to undo.

    Raises ValueError when `obj` is in no analysis.
    """
    return take_out_of_analysis(obj)


def renameGroup(obj, old, new, kind=None):
    """Renames a group of the mesh of `obj`, as one step to undo.

    `kind` is "node" or "element"; needed only when both have the name. An element group of several dimensions is renamed
    as a whole. Raises ValueError, and changes nothing, when there is no such group, when the new name is empty or taken,
    or when `obj` is made by FemScalpel: its groups come from its source and from its property GroupName.
    """
    rename_group(obj, old, new, kind)


def exportMesh(obj, path):
    """Writes the mesh of `obj` with its groups and numbers to a .med, .inp or .vtu file.

    Raises femscalpel.WriteError when the file cannot be written or the ending is another.
    """
    femscalpel.write(femmesh_bridge.from_femmesh(obj.FemMesh), path)


def _make(doc, source, name, proxy, geometry, **properties):
    """Adds an object with a proxy of class `proxy`; `geometry()` gives the properties of the tool."""
    if not hasattr(source, "isDerivedFrom") or not source.isDerivedFrom("Fem::FemMeshObject"):
        raise TypeError("source must be a FEM mesh object (Fem::FemMeshObject)")
    if source.Document != doc:
        raise ValueError(f"source '{source.Label}' is in another document")
    properties = {**geometry(), **properties, "Source": source}
    obj = doc.addObject("Fem::FemMeshObjectPython", name)
    try:
        proxy(obj)
        for property_name, value in properties.items():
            setattr(obj, property_name, value)
    except Exception:
        doc.removeObject(obj.Name)
        raise
    if FreeCAD.GuiUp:
        ViewProviderMeshOperation(obj.ViewObject)
    return obj


def _placement(source, placement, origin, direction):
    """A placement whose z axis is the direction; in the middle of the mesh and along z where nothing is said."""
    if placement is not None:
        if origin is not None or direction is not None:
            raise ValueError("give the tool as placement, or as origin and direction, not both")
        return FreeCAD.Placement(placement)
    base = source.FemMesh.BoundBox.Center if origin is None else FreeCAD.Vector(*origin)
    direction = FreeCAD.Vector(0, 0, 1) if direction is None else FreeCAD.Vector(*direction)
    if not direction.Length > 0:
        raise ValueError("the direction (normal or axis) is the zero vector")
    return FreeCAD.Placement(base, FreeCAD.Rotation(FreeCAD.Vector(0, 0, 1), direction))
