# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cracks, drills and cuts finite-element meshes directly, and keeps every mesh group right.

    import femscalpel as fs

    mesh = fs.read("model.med")
    result = fs.crack(mesh, fs.Plane(origin=(7.3, 5, 5), normal=(0.9, 0.3, 0.2)), name="CRACK")
    print(result.report.to_text())
    fs.write(result.mesh, "cracked.med")

Lengths are in the mesh's own unit. The input mesh is never changed: an operator returns a new, valid mesh
or raises an error of class :class:`Error`; `parameter` of these, and of TypeError and ValueError about an argument, is
the name of the parameter at fault. Ctrl-C (KeyboardInterrupt) and :class:`CancelToken` end what takes long.
"""

from . import _loading

_loading.load()

from . import tools  # noqa: E402
from ._engine import Cancelled, Error, QualityError, ReadError, ToolError, UnsupportedElementError, WriteError
from .cancel import CancelToken
from .connected import Piece, pieces
from .fields import Field, FieldPart, FieldStep, Localization
from .fracture import StressIntensity, stress_intensity
from .groups import BoundaryPart, VirtualBoundary, virtual_boundaries, virtual_boundary
from .inspection import Finding, Info, check, info
from .interop import from_meshio, to_meshio
from .mesh import ElementaryGroup, Group, Groups, Instance, Mesh
from .meshfile import Format, convert, formats, meshes_in, read, write
from ._engine import RefinementEstimate
from .operators import Result, Scalpel, crack, cut, drill, fillet, merge, refine, reshape
from .quality import mean_ratio, measure, scaled_jacobian, smallest_angle
from .report import (
    ElementQuality,
    Extent,
    FieldRecord,
    GroupRecord,
    HeldNodes,
    PoorPlace,
    Quality,
    QualitySummary,
    Refinement,
    Report,
    StraightenedEdges,
)
from .results import Displacements, read_displacements
from .skin import Shape
from .tools import *  # Tool, and a class for each tool
from .tools import Faces
from .within import CylinderPart, Disk, Ellipse, HalfPlane, Polygon, Within

__version__ = "0.1.0"

__all__ = [
    "BoundaryPart",
    "CancelToken",
    "Cancelled",
    "CylinderPart",
    "Disk",
    "Displacements",
    "Ellipse",
    "ElementaryGroup",
    "ElementQuality",
    "Error",
    "Extent",
    "Faces",
    "Field",
    "FieldPart",
    "FieldRecord",
    "FieldStep",
    "Finding",
    "Format",
    "Group",
    "GroupRecord",
    "Groups",
    "HalfPlane",
    "HeldNodes",
    "Info",
    "Instance",
    "Localization",
    "Mesh",
    "Piece",
    "Polygon",
    "PoorPlace",
    "Quality",
    "QualityError",
    "QualitySummary",
    "Refinement",
    "ReadError",
    "Report",
    "RefinementEstimate",
    "Result",
    "Scalpel",
    "Shape",
    "StraightenedEdges",
    "StressIntensity",
    "ToolError",
    "UnsupportedElementError",
    "VirtualBoundary",
    "Within",
    "WriteError",
    "check",
    "convert",
    "crack",
    "cut",
    "drill",
    "fillet",
    "formats",
    "from_meshio",
    "info",
    "mean_ratio",
    "measure",
    "merge",
    "meshes_in",
    "pieces",
    "read",
    "read_displacements",
    "refine",
    "reshape",
    "scaled_jacobian",
    "smallest_angle",
    "stress_intensity",
    "to_meshio",
    "virtual_boundaries",
    "virtual_boundary",
    "write",
]
__all__ += tools.__all__
