# SPDX-License-Identifier: LGPL-2.1-or-later
"""How large what an operator has made is: properties of its object, and lines of its report."""

import numpy as np

import femscalpel

#: Properties (type, name, text) of the group Result; 0 where there is no such thing.
PROPERTIES = (
    ("App::PropertyArea", "CrackArea", "Area of one lip of the crack"),
    ("App::PropertyLength", "CrackLength", "Length of the crack in a shell"),
    ("App::PropertyLength", "FrontLength", "Length of the crack's front"),
    ("App::PropertyArea", "WallArea", "Area of the hole's wall; of one wall of a slot"),
    ("App::PropertyLength", "HoleRadius", "Radius of the hole: mean distance of its wall's nodes from the axis"),
)
_NAMES = {
    ("crack", 2): "CrackArea",
    ("crack", 1): "CrackLength",
    ("front", 1): "FrontLength",
    ("wall", 2): "WallArea",
}


def values_of(report, radius=None):
    """Values of the PROPERTIES: of a femscalpel.Report, and the radius of hole_of()."""
    values = {name: 0 for _, name, _ in PROPERTIES}
    for extent in report.extents:
        if (extent.what, extent.dimension) in _NAMES:
            values[_NAMES[extent.what, extent.dimension]] = extent.measure
    values["HoleRadius"] = radius or 0
    return values


def hole_of(mesh, report, tools):
    """(mean distance from the axis, largest difference from the radius asked for) of the nodes of a round hole's wall;
    None where there is none. `tools`: what the operator cut with."""
    cylinders = [tool for tool in tools if isinstance(tool, femscalpel.Cylinder)]
    name = report.name + "_WALL"
    if report.operation != "drill" or not cylinders or (name, "element") not in _groups(mesh):
        return None
    ids = mesh.groups[name, "element"].ids
    rows = [mesh.cells[kind][np.isin(numbers, ids)].ravel() for kind, numbers in mesh.cell_ids.items()]
    points = mesh.points[np.unique(np.concatenate(rows))]
    if not len(points):
        return None
    off = np.array([cylinder.distance(points) for cylinder in cylinders])
    nearest = np.abs(off).argmin(axis=0)
    off = off[nearest, np.arange(len(points))]
    radii = np.array([cylinder.radius for cylinder in cylinders])[nearest]
    return float((radii + off).mean()), float(np.abs(off).max())


def _groups(mesh):
    return {(group.name, group.kind) for group in mesh.groups.all()}


def hole_line(hole):
    """A line of the report for what hole_of() gives."""
    radius, off = hole
    return f"  {'hole':<12} radius {radius:.6g}; nodes of the wall at most {off:.2g} off"
