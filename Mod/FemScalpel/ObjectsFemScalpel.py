# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes FemScalpel's document objects, for scripts and macros.

    import ObjectsFemScalpel

    crack = ObjectsFemScalpel.makeCrack(doc, doc.FEMMeshGmsh, origin=(50, 0, 0), normal=(1, 0, 0))
    doc.recompute()
    print("\\n".join(crack.GroupReport))
    ObjectsFemScalpel.putIntoAnalysis(crack)
"""

import FreeCAD

import femscalpel_documents
from femscalpel.signatures import takes
from femscalpelobjects import checked, following, imported, operator_options, tool_properties
from femscalpelobjects.analysis import put_into_analysis, take_out_of_analysis
from femscalpelobjects.crack import Crack
from femscalpelobjects.curved_crack import CurvedCrack
from femscalpelobjects.cut import Cut
from femscalpelobjects.cylindrical_crack import CylindricalCrack
from femscalpelobjects.drill import Drill
from femscalpelobjects.example import open_example
from femscalpelobjects.face_crack import FaceCrack
from femscalpelobjects.group_names import rename_group
from femscalpelobjects.make_material import makeFillet, makeMerge, makeReshape  # noqa: F401
from femscalpelobjects.making import check_source, make, make_along_tool, placement_of
from femscalpelobjects.refine import Refine

femscalpel_documents.watch()  # FreeCAD's Init.py has done so, but not where this is on Python's path only


@takes(
    options=operator_options.arguments(group_name="CRACK"),
    after=dict.fromkeys(("patch", "patch_radius", "patch_second_radius", "patch_corners"), "preserve"),
)
def makeCrack(
    doc,
    source,
    name="Crack",
    placement=None,
    origin=None,
    normal=None,
    patch="Whole",
    patch_radius=1.0,
    patch_second_radius=0.5,
    patch_corners=(),
    *,
    options,
):
    """Adds a parametric mesh object to `doc`: the mesh of `source`, cracked along a plane or a part of it.

    The mesh is made by doc.recompute(), and again whenever the source or a property changes. `source` stays as it is.
    The lips are the mesh groups ``group_name_P`` and ``group_name_N``. Face elements; if the source is a solid mesh
    without face elements, groups of nodes (FreeCAD's solver writers would lose face loads on a mesh with some face
    elements only).

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
    {options}
    patch : {"Whole", "Disk", "Ellipse", "Polygon", "HalfPlane"}
        The part of the plane that cracks; its border is the crack front, group ``group_name_FRONT``. Disk and ellipse
        have their centre at the placement's origin, the half plane is on the side of the placement's x axis.
    patch_radius, patch_second_radius : float
        Of a disk; of an ellipse along the placement's x and y axis. In mm.
    patch_corners : sequence of App.Vector or (x, y) or (x, y, z)
        Of a polygon, in order around it, in the placement's own axes; z does not count.

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
    check_source(doc, source)
    return make(
        doc,
        Crack,
        source,
        name,
        options,
        PlanePlacement=placement_of(source, placement, origin, normal, "normal"),
        Patch=patch,
        PatchRadius=patch_radius,
        PatchSecondRadius=patch_second_radius,
        PatchCorners=[
            _corner(corner) for corner in checked.several(patch_corners, "patch_corners must be a sequence of points")
        ],
    )


def _corner(corner):
    """A corner in the plane, of a vector or of two or three numbers."""
    if isinstance(corner, FreeCAD.Vector):
        return FreeCAD.Vector(corner.x, corner.y, 0)
    numbers = checked.several(corner, "each of patch_corners must be an App.Vector or two or three numbers")
    return checked.vector([*numbers[:2], 0] if len(numbers) == 3 else [*numbers, 0], "each of patch_corners")


@takes(
    options=operator_options.arguments(group_name="CRACK"),
    after=dict.fromkeys(("along", "angles"), "preserve"),
)
def makeCylindricalCrack(
    doc,
    source,
    name="CylindricalCrack",
    placement=None,
    origin=None,
    axis=None,
    radius=1.0,
    along=None,
    angles=(0, 360),
    *,
    options,
):
    """Adds a parametric mesh object to `doc`: the mesh of `source`, cracked along a cylinder or a part of it.

    The lip ``group_name_P`` is outside.

    Parameters
    ----------
    doc, source, name
        As for makeCrack().
    placement : App.Placement, optional
        The cylinder's axis is z of this placement.
    origin, axis : App.Vector or three numbers, optional
        The axis in another form; not together with `placement`. Both default to the middle of the mesh and z.
    radius : float
        Of the cylinder, in mm.
    {options}
    along : two numbers, optional
        From where to where on the axis it cracks, measured from the placement's origin; all along when not given.
    angles : two numbers
        With `along`: from where to where about the axis, in degrees from the placement's x axis.

    Returns and raises as makeCrack().
    """
    check_source(doc, source)
    placement = placement_of(source, placement, origin, axis, "axis")
    low, high = (0, 1) if along is None else checked.pair(along, "along")
    start, end = checked.pair(angles, "angles")
    return make(
        doc,
        CylindricalCrack,
        source,
        name,
        options,
        AxisPlacement=placement,
        Radius=radius,
        Bounded=along is not None,
        Low=low,
        High=high,
        StartAngle=start,
        EndAngle=end,
    )


@takes(
    inputs=tool_properties.arguments(),
    options=operator_options.arguments(group_name="CRACK"),
    after=tool_properties.places(face="preserve", last="refine"),
)
def makeCurvedCrack(
    doc, source, name="CurvedCrack", tool="Sphere", placement=None, origin=None, axis=None, *, inputs, options
):
    """Adds a parametric mesh object to `doc`: the mesh of `source`, cracked along a curved tool.

    The lip ``group_name_P`` is outside, or on the side a face's normals point to.

    Parameters
    ----------
    doc, source, name
        As for makeCrack().
    tool : str
        "Cylinder", "Sphere", "Torus", "Cone", "Face", ...: the name of a tool's class in femscalpel.
    placement : App.Placement, optional
        The tool's centre, or a point of its axis, is the origin of this placement, its axis z.
    origin, axis : App.Vector or three numbers, optional
        The same in another form; not together with `placement`. Both default to the middle of the mesh and z.
    {inputs}
    {options}

    Returns and raises as makeCrack().
    """
    return make_along_tool(doc, CurvedCrack, source, name, tool, (placement, origin, axis), inputs, options)


@takes(options=operator_options.arguments("group_name", group_name="CRACK"))
def makeFaceCrack(doc, source, group, name="FaceCrack", *, options):
    """Adds a parametric mesh object to `doc`: the mesh of `source`, cracked along faces that it has.

    Elements may be of any type; none moves.

    Parameters
    ----------
    doc, source, name
        As for makeCrack().
    group : str
        A mesh group of faces inside the solids (in a shell: of edges), or of nodes, which stands for the faces all of
        whose corners are members; see femscalpel.Faces.
    {options}

    Returns and raises as makeCrack().
    """
    check_source(doc, source)
    return make(doc, FaceCrack, source, name, options, Group=group)


@takes(options=operator_options.arguments(group_name="HOLE"))
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
    *,
    options,
):
    """Adds a parametric mesh object to `doc`: the mesh of `source` with one or several parallel holes.

    The new mesh groups are ``group_name_WALL``, and ``group_name_BOTTOM`` of blind holes; see femscalpel.drill.

    Parameters
    ----------
    doc, source, name
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
    {options}

    Returns and raises as makeCrack().
    """
    check_source(doc, source)
    return make(
        doc,
        Drill,
        source,
        name,
        options,
        AxisPlacement=placement_of(source, placement, origin, axis, "axis"),
        Radius=radius,
        Positions=checked.vectors(positions, "positions"),
        Through=depth is None,
        Depth=0 if depth is None else depth,
    )


@takes(options=operator_options.arguments(without=("method",), group_name="CUT"))
def makeCut(
    doc,
    source,
    name="Cut",
    placement=None,
    origin=None,
    normal=None,
    width=1.0,
    bottom=None,
    *,
    options,
):
    """Adds a parametric mesh object to `doc`: the mesh of `source` with a slot, an incision between two parallel
    planes.

    The new mesh groups are ``group_name_P`` and ``group_name_N``, the walls, and ``group_name_BOTTOM``; see
    femscalpel.cut.

    Parameters
    ----------
    doc, source, name
        As for makeCrack().
    placement, origin, normal
        The plane in the middle of the slot, as for makeCrack().
    width : float
        Of the slot, in mm.
    bottom : App.Placement, optional
        The slot ends at the XY plane of this placement, whose z axis points into the material that stays; it goes
        through the whole part when not given.
    {options}

    Returns and raises as makeCrack().
    """
    check_source(doc, source)
    return make(
        doc,
        Cut,
        source,
        name,
        options,
        PlanePlacement=placement_of(source, placement, origin, normal, "normal"),
        Width=width,
        Through=bottom is None,
        BottomPlacement=FreeCAD.Placement() if bottom is None else checked.placement(bottom, "bottom"),
    )


@takes(
    inputs=tool_properties.arguments(),
    options=operator_options.arguments("feature_angle"),
    after={
        **dict.fromkeys(("size", "reach", "gradation"), "half_angle"),
        **tool_properties.places(face="feature_angle", last="face"),
    },
)
def makeRefine(
    doc,
    source,
    name="Refine",
    tool="Cylinder",
    placement=None,
    origin=None,
    axis=None,
    size=1.0,
    reach=0.0,
    gradation=0.5,
    *,
    inputs,
    options,
):
    """Adds a parametric mesh object to `doc`: the mesh of `source`, with edges no longer than `size` mm around a tool.

    Parameters
    ----------
    doc, source, name
        As for makeCrack().
    tool, placement, origin, axis
        As for makeCurvedCrack(), or "Plane", with `axis` as its normal.
    {inputs}
    size : float
        Longest edge wanted at the tool, in mm.
    reach : float
        `size` holds up to this distance from the tool.
    gradation : float
        How much longer edges may be per unit of distance beyond; see femscalpel.refine.
    {options}

    Returns and raises as makeCrack().
    """
    return make_along_tool(
        doc,
        Refine,
        source,
        name,
        tool,
        (placement, origin, axis),
        inputs,
        options,
        Size=size,
        Reach=reach,
        Gradation=gradation,
    )


def putIntoAnalysis(obj, strict=True):
    """Puts `obj` into the FEM analysis its source mesh is in, in the source's place, and returns the analysis.

    A FreeCAD analysis solves the one mesh it contains. Loads, supports and materials need no change: FreeCAD finds
    their nodes by mesh group, or by geometry, on which FemScalpel keeps the nodes. For a crack of a crack, the last
    mesh of the chain that is in an analysis is replaced; meshes that were added to it leave the analysis, too. Results
    of the old mesh are removed, or, if FreeCAD's preference is to keep results, renamed. All this is one step to undo.

    Raises ValueError, and changes nothing, when there is no such analysis, when `obj` has an error, and, with `strict`,
    when FreeCAD would not find all nodes a load, support or material is meant for; the message says where. With
    strict=False that is a warning in the report view.
    """
    return put_into_analysis(checked.made_object(obj), strict)


def takeOutOfAnalysis(obj):
    """Undoes putIntoAnalysis(): the mesh that was replaced takes its place back. Returns the analysis. One step to
    undo.

    Raises ValueError when `obj` is in no analysis.
    """
    return take_out_of_analysis(checked.made_object(obj))


def renameGroup(obj, old, new, kind=None):
    """Renames a group of the mesh of `obj`, as one step to undo.

    `kind` is "node" or "element"; needed only when both have the name. An element group of several dimensions is
    renamed as a whole. Raises ValueError, and changes nothing, when there is no such group, when the new name is empty
    or taken, or when `obj` is made by FemScalpel: its groups come from its source and from its property GroupName.
    """
    checked.mesh_object(obj)
    if kind is not None:
        checked.one_of(kind, "kind", ["node", "element"])
    rename_group(obj, checked.text(old, "old"), checked.text(new, "new"), kind)


def followGeometry(obj, geometry, offset=None):
    """Has the plane or axis of an object of FemScalpel follow geometry of its document, when that changes.

    The geometry gives axes, and the placement keeps its place in them. If the radius of the object (of a crack: the
    disk, ellipse or polygon) is that of the geometry, it follows, too. Whatever else sets these properties ends that.

    A change of a part that may have renumbered its faces and edges is an error of the object, unless the one that is
    followed is where it was; so is geometry that is not there any more.

    Parameters
    ----------
    obj : App.DocumentObject
        A crack, incision, hole, refinement or moved wall.
    geometry : sequence of (App.DocumentObject, str)
        A face, edge, datum or sketch (the name is "" for a whole object), or two or three vertices; None or empty:
        the numbers stay as they are from now on.
    offset : App.Placement, optional
        The placement in the axes of the geometry; when not given, what it is now.

    Raises
    ------
    ValueError
        `obj` has no placement that could follow, or the geometry no axes. Nothing is changed then.
    """
    checked.mesh_object(obj)
    if geometry:
        targets = checked.several(geometry, "geometry must be a sequence of (object, name of its element)")
        targets = [checked.pair(one, "each of geometry", "(object, name of its element)") for one in targets]
        offset = None if offset is None else checked.placement(offset, "offset")
        following.link(obj, [(checked.any_object(part, "geometry"), name) for part, name in targets], offset)
    else:
        following.unlink(obj)


def importMesh(doc, path, name=None, mesh=None):
    """Adds the mesh of a file with its groups to `doc`, as a mesh object.

    femscalpel.formats() lists the files that can be read. What a FemMesh cannot hold - a deck's cards, fields, groups
    of element faces, point elements, the file's numbers - is kept in the document: what FemScalpel makes of the mesh is
    made of the whole, and exportMesh() writes it.

    Parameters
    ----------
    doc : App.Document
    path : str
    name : str, optional
        Of the new object; the file's when not given.
    mesh : str, optional
        Which mesh of a MED file that holds several; the first when not given.

    Returns
    -------
    App.DocumentObject
        A Fem::FemMeshObject. One step to undo.

    Raises
    ------
    femscalpel.ReadError
        The file cannot be read; with file and line.
    femscalpel.WriteError
        A FemMesh cannot hold its elements.
    TypeError, ValueError
        `doc` is no document that is open, or another argument is not what it has to be. Nothing is added then.
    femscalpel.Cancelled
        In FreeCAD's window, where it is read on another thread, when the user ends that.
    """
    checked.document(doc)
    checked.text(name, "name", optional=True)
    path = checked.path(path)
    if FreeCAD.GuiUp:
        from femscalpelgui import importing

        read = importing.read(path, mesh)
    else:
        read = imported.read(path, mesh)
    return imported.add(doc, path, *read, name)


def exportMesh(obj, path):
    """Writes the mesh of `obj` with its groups and numbers to a file whose ending says the format; of a mesh that was
    imported by importMesh(), or is made of one, also what else its file held: the cards of a deck go into an .inp.

    femscalpel.formats() lists the formats. What the file does not hold is told in the report view. Raises
    femscalpel.WriteError when the file cannot be written or no format has its ending. In FreeCAD's window it is written
    on another thread; femscalpel.Cancelled when the user ends that.
    """
    checked.mesh_object(obj)
    path = checked.path(path)
    if FreeCAD.GuiUp:
        from femscalpelgui import exporting

        sentences = exporting.write(obj, path)
    else:
        sentences = imported.export(obj, path)
    imported.tell(obj, sentences)


def openExample():
    """Opens the example, a caisson of tetrahedra with groups in an analysis, as a new document, and returns that.

    Raises FileNotFoundError when the workbench was built without it.
    """
    return open_example()
