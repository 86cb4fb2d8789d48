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
from femscalpelobjects.curved_crack import CurvedCrack
from femscalpelobjects.cut import Cut
from femscalpelobjects.cylindrical_crack import CylindricalCrack
from femscalpelobjects.drill import Drill
from femscalpelobjects.example import open_example
from femscalpelobjects.group_names import rename_group
from femscalpelobjects.refine import Refine

if FreeCAD.GuiUp:
    from femscalpelgui.viewproviders.mesh_operation import ViewProviderMeshOperation


def makeCrack(
    doc,
    source,
    name="Crack",
    placement=None,
    origin=None,
    normal=None,
    method="snap",
    transition=0,
    group_name="CRACK",
    feature_angle=30.0,
    preserve=None,
    patch="Whole",
    patch_radius=1.0,
    patch_second_radius=0.5,
    patch_corners=(),
    refine=None,
):
    """Adds a parametric mesh object to `doc`: the mesh of `source`, cracked along a plane or a part of it.

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
    preserve : names of mesh groups, optional
        The groups whose border keeps its shape; all when not given. Borders of others may drift.
    patch : {"Whole", "Disk", "Ellipse", "Polygon", "HalfPlane"}
        The part of the plane that cracks; its border is the crack front, group ``group_name_FRONT``. Disk and ellipse
        have their centre at the placement's origin, the half plane is on the side of the placement's x axis.
    patch_radius, patch_second_radius : float
        Of a disk; of an ellipse along the placement's x and y axis. In mm.
    patch_corners : sequence of App.Vector or (x, y) or (x, y, z)
        Of a polygon, in order around it, in the placement's own axes; z does not count.
    refine : None, False or float
        Whether elements near the tool are divided first: None: where the tool is finer than the mesh; False: never; a
        number: where edges are longer than so many mm.

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
    _check_source(doc, source)
    plane = _placement(source, placement, origin, normal, "normal")
    corners = [FreeCAD.Vector(*tuple(corner)[:2], 0) for corner in patch_corners]
    return _make(
        doc,
        Crack,
        source,
        name,
        PlanePlacement=plane,
        Patch=patch,
        PatchRadius=patch_radius,
        PatchSecondRadius=patch_second_radius,
        PatchCorners=corners,
        Method=method,
        Transition=transition,
        GroupName=group_name,
        FeatureAngle=feature_angle,
        PreservedGroups=_preserved(preserve),
        **_refinement(refine),
    )


def makeCylindricalCrack(
    doc,
    source,
    name="CylindricalCrack",
    placement=None,
    origin=None,
    axis=None,
    radius=1.0,
    method="snap",
    transition=0,
    group_name="CRACK",
    feature_angle=30.0,
    preserve=None,
    along=None,
    angles=(0, 360),
    refine=None,
):
    """Adds a parametric mesh object to `doc`: the mesh of `source`, cracked along a cylinder or a part of it.

    The cylinder has the z axis of `placement`, or `axis` through `origin`, and the radius `radius` in mm. With `along`,
    two numbers, it cracks from there to there on the axis, measured from the placement's origin; then `angles`, in
    degrees from the placement's x axis, can bound it too. The lip ``_P`` is outside. Everything else is as for
    makeCrack().
    """
    _check_source(doc, source)
    placement = _placement(source, placement, origin, axis, "axis")
    low, high = (0, 1) if along is None else along
    return _make(
        doc,
        CylindricalCrack,
        source,
        name,
        AxisPlacement=placement,
        Radius=radius,
        Bounded=along is not None,
        Low=low,
        High=high,
        StartAngle=angles[0],
        EndAngle=angles[1],
        Method=method,
        Transition=transition,
        GroupName=group_name,
        FeatureAngle=feature_angle,
        PreservedGroups=_preserved(preserve),
        **_refinement(refine),
    )


def makeCurvedCrack(
    doc,
    source,
    name="CurvedCrack",
    tool="Sphere",
    placement=None,
    origin=None,
    axis=None,
    radius=1.0,
    tube_radius=0.25,
    half_angle=30.0,
    method="snap",
    transition=0,
    group_name="CRACK",
    feature_angle=30.0,
    preserve=None,
    face=None,
    refine=None,
):
    """Adds a parametric mesh object to `doc`: the mesh of `source`, cracked along a curved tool.

    `tool` is "Cylinder", "Sphere", "Torus", "Cone" or "Face"; see the classes of that name in femscalpel. Its centre
    and axis are `origin` and `axis`, or origin and z axis of `placement`. `radius` is that of a cylinder or sphere, of
    a torus' ring, of a cone at its origin; `tube_radius` that of a torus' tube; `half_angle`, in degrees, is a cone's.
    `face` is for "Face": a document object with a shape, or (object, names of its faces). The lip ``_P`` is outside, or
    on the side a face's normals point to. Everything else is as for makeCrack().
    """
    _check_source(doc, source)
    placement = _placement(source, placement, origin, axis, "axis")
    return _make(
        doc,
        CurvedCrack,
        source,
        name,
        ToolShape=tool,
        ToolFace=_link(face),
        AxisPlacement=placement,
        Radius=radius,
        TubeRadius=tube_radius,
        HalfAngle=half_angle,
        Method=method,
        Transition=transition,
        GroupName=group_name,
        FeatureAngle=feature_angle,
        PreservedGroups=_preserved(preserve),
        **_refinement(refine),
    )


def makeDrill(
    doc,
    source,
    name="Drill",
    placement=None,
    origin=None,
    axis=None,
    radius=1.0,
    depth=None,
    positions=(),
    method="snap",
    transition=0,
    group_name="HOLE",
    feature_angle=30.0,
    preserve=None,
    refine=None,
):
    """Adds a parametric mesh object to `doc`: the mesh of `source` with one or several parallel holes.

    Parameters
    ----------
    doc, source, name, method, transition, feature_angle, preserve, refine
        As for makeCrack().
    placement : App.Placement, optional
        A hole's axis is z of this placement.
    origin, axis : App.Vector or three numbers, optional
        The axis in another form; not together with `placement`. Both default to the middle of the mesh and z.
    radius : float
        In mm.
    depth : float, optional
        The holes end flat, this far beyond the placement's origin along its z; through holes when not given.
    positions : sequence of App.Vector or three numbers
        For several holes: where they are, in the placement's own axes.
    group_name : str
        Prefix of the new mesh groups: ``_WALL``, and ``_BOTTOM`` of blind holes; see femscalpel.drill.

    Returns and raises as makeCrack().
    """
    _check_source(doc, source)
    placement = _placement(source, placement, origin, axis, "axis")
    return _make(
        doc,
        Drill,
        source,
        name,
        AxisPlacement=placement,
        Radius=radius,
        Positions=[FreeCAD.Vector(*p) for p in positions],
        Through=depth is None,
        Depth=depth or 0,
        Method=method,
        Transition=transition,
        GroupName=group_name,
        FeatureAngle=feature_angle,
        PreservedGroups=_preserved(preserve),
        **_refinement(refine),
    )


def makeCut(
    doc,
    source,
    name="Cut",
    placement=None,
    origin=None,
    normal=None,
    width=1.0,
    bottom=None,
    transition=0,
    group_name="CUT",
    feature_angle=30.0,
    preserve=None,
    refine=None,
):
    """Adds a parametric mesh object to `doc`: the mesh of `source` with a slot, an incision between two parallel
    planes.

    Parameters
    ----------
    doc, source, name, transition, feature_angle, preserve, refine
        As for makeCrack().
    placement, origin, normal
        The plane in the middle of the slot, as for makeCrack().
    width : float
        Of the slot, in mm.
    bottom : App.Placement, optional
        The slot ends at the XY plane of this placement, whose z axis points into the material that stays; it goes
        through the whole part when not given.
    group_name : str
        Prefix of the new mesh groups: ``_P`` and ``_N``, the walls, and ``_BOTTOM``; see femscalpel.cut.

    Returns and raises as makeCrack().
    """
    _check_source(doc, source)
    plane = _placement(source, placement, origin, normal, "normal")
    return _make(
        doc,
        Cut,
        source,
        name,
        PlanePlacement=plane,
        Width=width,
        Through=bottom is None,
        BottomPlacement=bottom or FreeCAD.Placement(),
        Transition=transition,
        GroupName=group_name,
        FeatureAngle=feature_angle,
        PreservedGroups=_preserved(preserve),
        **_refinement(refine),
    )


def makeRefine(
    doc,
    source,
    name="Refine",
    tool="Cylinder",
    placement=None,
    origin=None,
    axis=None,
    radius=1.0,
    tube_radius=0.25,
    half_angle=30.0,
    size=1.0,
    reach=0.0,
    gradation=0.5,
    feature_angle=30.0,
    face=None,
):
    """Adds a parametric mesh object to `doc`: the mesh of `source`, with edges no longer than `size` mm around a tool.

    The tool is as for makeCurvedCrack(), or "Plane", with `axis` as its normal. `size` holds up to the distance
    `reach`; beyond, edges may be longer by `gradation` per unit of distance. See femscalpel.refine.
    """
    _check_source(doc, source)
    placement = _placement(source, placement, origin, axis, "axis")
    return _make(
        doc,
        Refine,
        source,
        name,
        ToolShape=tool,
        ToolFace=_link(face),
        AxisPlacement=placement,
        Radius=radius,
        TubeRadius=tube_radius,
        HalfAngle=half_angle,
        Size=size,
        Reach=reach,
        Gradation=gradation,
        FeatureAngle=feature_angle,
    )


def putIntoAnalysis(obj, strict=True):
    """Puts `obj` into the FEM analysis its source mesh is in, in the source's place, and returns the analysis.

    A FreeCAD analysis solves the one mesh it contains. Loads, supports and materials need no change: FreeCAD finds
    their nodes by mesh group, or by geometry, on which FemScalpel keeps the nodes. For a crack of a crack, the last
    mesh of the chain that is in an analysis is replaced. Results of the old mesh are removed, or, if FreeCAD's
    preference is to keep results, renamed. All this is one step to undo.

    Raises ValueError, and changes nothing, when there is no such analysis, when `obj` has an error, and, with `strict`,
    when FreeCAD would not find all nodes a load, support or material is meant for; the message says where. With
    strict=False that is a warning in the report view.
    """
    return put_into_analysis(obj, strict)


def takeOutOfAnalysis(obj):
    """Undoes putIntoAnalysis(): the mesh that was replaced takes its place back. Returns the analysis. One step to
    undo.

    Raises ValueError when `obj` is in no analysis.
    """
    return take_out_of_analysis(obj)


def renameGroup(obj, old, new, kind=None):
    """Renames a group of the mesh of `obj`, as one step to undo.

    `kind` is "node" or "element"; needed only when both have the name. An element group of several dimensions is
    renamed as a whole. Raises ValueError, and changes nothing, when there is no such group, when the new name is empty
    or taken, or when `obj` is made by FemScalpel: its groups come from its source and from its property GroupName.
    """
    rename_group(obj, old, new, kind)


def exportMesh(obj, path):
    """Writes the mesh of `obj` with its groups and numbers to a file whose ending says the format.

    femscalpel.formats() lists them. Raises femscalpel.WriteError when the file cannot be written or no format has its
    ending.
    """
    femscalpel.write(femmesh_bridge.from_femmesh(obj.FemMesh), path)


def openExample():
    """Opens the example, a caisson of tetrahedra with groups in an analysis, as a new document, and returns that.

    Raises FileNotFoundError when the workbench was built without it.
    """
    return open_example()


def _check_source(doc, source):
    if not hasattr(source, "isDerivedFrom") or not source.isDerivedFrom("Fem::FemMeshObject"):
        raise TypeError("source must be a FEM mesh object (Fem::FemMeshObject)")
    if source.Document != doc:
        raise ValueError(f"source '{source.Label}' is in another document")


def _make(doc, operation, source, name, **properties):
    """The new object; nothing is left behind when a property does not take its value."""
    obj = doc.addObject("Fem::FemMeshObjectPython", name)
    try:
        operation(obj)
        for key, value in properties.items():
            setattr(obj, key, value)
        obj.Source = source
    except Exception:
        doc.removeObject(obj.Name)
        raise
    if FreeCAD.GuiUp:
        ViewProviderMeshOperation(obj.ViewObject)
    return obj


def _link(face):
    """The value of a property of type LinkSub."""
    if face is None or isinstance(face, (tuple, list)):
        return face
    return face, [""]


def _refinement(refine):
    """The properties Refine and RefineSize of an argument `refine`."""
    if refine is None:
        return {"Refine": "Automatic"}
    if refine is False:
        return {"Refine": "Never"}
    if isinstance(refine, bool) or not refine > 0:
        raise ValueError(f"refine must be None, False or a positive length, not {refine!r}")
    return {"Refine": "Size", "RefineSize": refine}


def _preserved(preserve):
    return ["*"] if preserve is None else list(preserve)


def _placement(source, placement, origin, direction, name):
    """`placement`, or one whose z axis is `direction` through `origin`; `name` is what the caller calls the
    direction."""
    if placement is not None:
        if origin is not None or direction is not None:
            raise ValueError(f"give placement, or origin and {name}, not both")
        return FreeCAD.Placement(placement)
    base = source.FemMesh.BoundBox.Center if origin is None else FreeCAD.Vector(*origin)
    direction = FreeCAD.Vector(0, 0, 1) if direction is None else FreeCAD.Vector(*direction)
    if not direction.Length > 0:
        raise ValueError(f"{name} is the zero vector; give a direction")
    return FreeCAD.Placement(base, FreeCAD.Rotation(FreeCAD.Vector(0, 0, 1), direction))
