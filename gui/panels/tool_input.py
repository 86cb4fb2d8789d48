# SPDX-License-Identifier: LGPL-2.1-or-later
"""Input of any tool of femscalpel's table: what it is, where, and how large."""

import FreeCADGui
from FreeCAD import Vector

from femscalpel.tools import DIRECTION, FACE, POINT, TOOLS
from femscalpelobjects.tool_properties import direction_of, face_of, property_of

from ..translate import QT_TRANSLATE_NOOP, form, translate
from ..view import picking
from . import fields
from .axis_input import AxisInput
from .geometry_input import GeometryInput
from .placements import as_text

#: What tools are called.
NAMES = {
    "Cylinder": QT_TRANSLATE_NOOP("FemScalpel", "Cylinder"),
    "Sphere": QT_TRANSLATE_NOOP("FemScalpel", "Sphere"),
    "Torus": QT_TRANSLATE_NOOP("FemScalpel", "Torus"),
    "Cone": QT_TRANSLATE_NOOP("FemScalpel", "Cone"),
    "Plane": QT_TRANSLATE_NOOP("FemScalpel", "Plane"),
    "Face": QT_TRANSLATE_NOOP("FemScalpel", "CAD face"),
}
#: What their radius is.
RADII = {
    "Cylinder": QT_TRANSLATE_NOOP("FemScalpel", "Radius of the cylinder"),
    "Sphere": QT_TRANSLATE_NOOP("FemScalpel", "Radius of the sphere"),
    "Torus": QT_TRANSLATE_NOOP("FemScalpel", "Radius of the circle in the middle of the tube"),
    "Cone": QT_TRANSLATE_NOOP("FemScalpel", "Radius of the cone at the point; it opens along the axis"),
}
#: Tools that a place, a direction and a radius say; those with a radius first.
ROUND = sorted(
    (
        name
        for name, kind in TOOLS.items()
        if {p.asked_as for p in kind.parameters if p.kind not in (POINT, DIRECTION)} <= {"radius"}
    ),
    key=lambda name: not any(p.asked_as == "radius" for p in TOOLS[name].parameters),
)
# Widgets of tool_values.ui by what the table asks a tool's further numbers as: the field, its label.
_FIELDS = {"tube_radius": ("tubeRadius", "tubeLabel"), "half_angle": ("halfAngle", "angleLabel")}


def name_of(shape):
    """What a tool is called, by the name of its class."""
    return translate("FemScalpel", NAMES.get(shape, shape))


class ToolInput(AxisInput):
    """One of the tools `shapes`, `first` at first: a surface of revolution by numbers, picking and handles, or picked
    faces of a part."""

    def __init__(self, source_object, shapes, first):
        self.kind = FreeCADGui.PySideUic.loadUi(form("tool_input.ui"))
        self.further = FreeCADGui.PySideUic.loadUi(form("tool_values.ui"))
        for shape in shapes:
            self.kind.toolShape.addItem(name_of(shape), shape)
        self.kind.toolShape.setCurrentIndex(self.kind.toolShape.findData(first))
        self._faces = None  # (object, names of faces)
        self._numbers = {}
        super().__init__(source_object)
        step = fields.round_step(self.size / 50)
        for asked, default in (("tube_radius", fields.round_step(self.size / 40)), ("half_angle", 30.0)):
            box = getattr(self.further, _FIELDS[asked][0])
            self._numbers[asked] = fields.Number(box, self._tell, default, 5 if asked == "half_angle" else step)
        rows = self.form.layout()
        rows.insertWidget(0, self.kind)
        rows.insertWidget(rows.count() - 1, self.further)
        self.buttons["face"] = self.further.pickFace
        self.further.pickFace.clicked.connect(self._starter("face"))
        self.further.clearFaces.clicked.connect(lambda: self.set_faces(None))
        self._two_nodes = self.form.pickNodes.text()
        self.kind.toolShape.currentIndexChanged.connect(lambda *_: self._choose())
        self._choose()

    # What is entered.

    def shape(self):
        """The name of the tool's class."""
        return self.kind.toolShape.currentData()

    def _parameters(self):
        return TOOLS[self.shape()].parameters

    def _asks(self, kind):
        return any(p.kind is kind for p in self._parameters())

    def tool(self):
        """The femscalpel.Tool. Raises femscalpel.Error or ValueError."""
        return TOOLS[self.shape()].build(self._value)

    def _value(self, parameter):
        if parameter.kind is FACE:
            return face_of(self._faces)
        if parameter.kind is POINT:
            return self.origin()
        if parameter.kind is DIRECTION:
            return direction_of(self.placement())  # to the last bit what the document object cuts with
        return self._number(parameter.asked_as)

    def _number(self, asked):
        return self.radius() if asked == "radius" else self._numbers[asked].value

    def targets(self):
        return super().targets() if self._asks(POINT) else []

    def direction(self):
        direction = super().direction()
        return direction if direction.Length > 0 or self._asks(DIRECTION) else Vector(0, 0, 1)

    def read(self, obj):
        """Enters what a document object holds."""
        blocked = self.kind.toolShape.blockSignals(True)
        self.kind.toolShape.setCurrentIndex(self.kind.toolShape.findData(obj.ToolShape))
        self.kind.toolShape.blockSignals(blocked)
        for asked, number in self._numbers.items():
            number.set(getattr(obj, property_of(asked)).Value)
        self.set_faces(obj.ToolFace and (obj.ToolFace[0], list(obj.ToolFace[1])))
        placement = obj.AxisPlacement
        self.set_pose(placement.Base, placement.Rotation.multVec(Vector(0, 0, 1)), obj.Radius.Value)
        self._choose()

    def arguments(self, text_of):
        """Arguments of functions of ObjectsFemScalpel, as Python text by name; `text_of(obj)` is that of an object."""
        own = {POINT: "origin", DIRECTION: "axis"}
        texts = {own.get(p.kind, p.asked_as): self._text(p, text_of) for p in self._parameters()}
        return {"tool": repr(self.shape()), **texts}

    def settings(self, text_of):
        """Properties of the document object likewise."""
        out = {"ToolShape": repr(self.shape())}
        if self._asks(POINT):
            out["AxisPlacement"] = as_text(self.placement())
        numbers = [p for p in self._parameters() if p.kind not in (POINT, DIRECTION)]
        return {**out, **{property_of(p.asked_as): self._text(p, text_of) for p in numbers}}

    def _text(self, parameter, text_of):
        if parameter.kind is FACE:
            return f"({text_of(self._faces[0])}, {self._faces[1]!r})"
        value = self.direction() if parameter.kind is DIRECTION else self._value(parameter)
        return repr(tuple(value) if parameter.kind in (POINT, DIRECTION) else value)

    def error(self):
        if self._asks(FACE) and self._faces is None:
            return translate("FemScalpel", "Press Pick and click a face of a part.")
        problem = GeometryInput.error(self) if self._asks(DIRECTION) else ""
        has_radius = any(p.asked_as == "radius" for p in self._parameters())
        return problem or (self.radius_error() if has_radius else "")

    # What is shown.

    def _choose(self):
        """Shows the fields that the tool has."""
        self.stop_picking()
        f, asked = self.form, {p.asked_as for p in self._parameters()}
        point, direction = self._asks(POINT), self._asks(DIRECTION)
        self.NODES = 2 if direction else 1
        f.pickNodes.setText(self._two_nodes if direction else translate("FemScalpel", "1 node"))
        places = (f.label7, f.label9, f.label10, f.label11, f.originX, f.originY, f.originZ, f.centre)
        for widgets, shown in (
            ((*places, f.pickNodes, f.pickGeometry), point),
            ((f.label8, f.normalX, f.normalY, f.normalZ, f.pickView), direction),
            ((f.label12, f.radius), "radius" in asked),
            ((self.further.pickFace, self.further.clearFaces, self.further.faces), self._asks(FACE)),
            *(([getattr(self.further, name) for name in names], key in asked) for key, names in _FIELDS.items()),
        ):
            for widget in widgets:
                widget.setVisible(shown)
        f.radius.setToolTip(translate("FemScalpel", RADII.get(self.shape(), "")))
        self._tell()

    def _tell(self, from_handle=False):
        if self.handles is not None:
            values = {asked: number.value for asked, number in self._numbers.items()}
            self.handles.show(self._asks(POINT))
            self.handles.show_shape(self.shape(), values, self._asks(DIRECTION))
        super()._tell(from_handle)

    def add_handles(self, view):
        super().add_handles(view)
        self._tell()

    # Faces of parts.

    def set_faces(self, faces):
        """Enters faces, (object, names), or None."""
        self._faces = faces
        names = faces[1] if faces else []
        text = translate("FemScalpel", "none picked yet")
        if faces:
            text = translate("FemScalpel", "%1 faces of %2").replace("%1", str(len(names)))
            text = text.replace("%2", faces[0].Label) if len(names) > 1 else f"{faces[0].Label} {names[0]}"
        self.further.faces.setText(text)
        self.further.faces.setToolTip(", ".join(names))
        self.further.clearFaces.setEnabled(bool(faces))
        self._tell()

    def start_with(self, faces):
        """Enters faces, and that the tool is such."""
        self.kind.toolShape.setCurrentIndex(self.kind.toolShape.findData("Face"))
        self.set_faces(faces)

    def face(self):
        """The shape of the picked faces, or None."""
        return face_of(self._faces) if self._asks(FACE) and self._faces else None

    def part(self):
        """The object whose faces are the tool, or None."""
        return self._faces[0] if self._asks(FACE) and self._faces else None

    # Picking.

    def _ask(self, kind, found=0):
        if kind == "face":
            return translate("FemScalpel", "Click a face of a part, or a part in the tree. Escape stops.")
        if kind == "nodes" and self.NODES == 1:
            return translate("FemScalpel", "Click a node of the mesh. Escape stops.")
        return super()._ask(kind, found)

    def _ask_geometry(self):
        return translate(
            "FemScalpel",
            "Click a round face, a straight or circular edge, a datum line, or a point on a face. Escape stops.",
        )

    def _picked(self, kind, click):
        return picking.face(click) if kind == "face" else super()._picked(kind, click)

    def _from_nodes(self, points):
        return super()._from_nodes(points) if len(points) > 1 else picking.Picked(points[0], self.direction())

    def _from_click(self, click):
        return picking.tool(click, self.source)

    def take(self, picked):
        if isinstance(picked, picking.Picked):
            for asked in set(picked.values) & set(self._numbers):
                self._numbers[asked].set(picked.values[asked])
            super().take(picked)
            return
        obj, name = picked
        known = self._faces[1] if self._faces and self._faces[0] == obj and name and "" not in self._faces[1] else []
        self.set_faces((obj, list(dict.fromkeys([*known, name]))))

    def close(self):
        super().close()
        self.kind = self.further = self._faces = None
        self._numbers = {}
