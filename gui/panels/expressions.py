# SPDX-License-Identifier: LGPL-2.1-or-later
"""Expressions in the fields of panels: "=" in a field, or its f(x) icon.

FreeCAD binds fields to properties of a document object; where there is none yet, a dialog asks for the expression.
"""

import itertools

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from femscalpelobjects.following import placement_property

from ..event_filter import EventFilter
from ..translate import translate
from . import fields
from .view_panel import abort_transaction

# How the names of the steps begin that FreeCAD makes for an expression.
_STEP = "Set expression"

# FreeCAD's icons of fields without and with an expression.
_UNSET, _SET = ":/icons/bound-expression-unset.svg", ":/icons/bound-expression.svg"

#: Fields, and the paths of the properties that they are of.
PATHS = {
    **{f"normal{axis}": f"Direction.{axis.lower()}" for axis in "XYZ"},
    **{f"vector{axis}": f"{{vector}}.{axis.lower()}" for axis in "XYZ"},
    "offset": "Offset",
    "patchTurn": "Turn",
    "slotTurn": "Turn",
    **{f"origin{axis}": f"{{place}}.Base.{axis.lower()}" for axis in "XYZ"},
    "radius": "Radius",
    "filletRadius": "Radius",
    "tubeRadius": "TubeRadius",
    "halfAngle": "HalfAngle",
    "patchRadius": "PatchRadius",
    "patchSecondRadius": "PatchSecondRadius",
    "partLow": "Low",
    "partHigh": "High",
    "partStart": "StartAngle",
    "partEnd": "EndAngle",
    "holeDepth": "Depth",
    "slotWidth": "Width",
    "edgeSize": "Size",
    "reach": "Reach",
    "scaleFactor": "ScaleFactor",
    "mergeTolerance": "Tolerance",
    "featureAngle": "FeatureAngle",
    "refineSize": "RefineSize",
}


class Expressions:
    """Binds the fields in some forms to the properties of `obj`. FreeCAD sets expressions at once, so they are put back
    unless the panel takes them."""

    def __init__(self, obj, forms):
        self._obj, self._before, self._bindings = obj, _expressions_of(obj), []
        was_touched = "Touched" in obj.State
        self._steps = obj.Document.UndoCount
        for box in _boxes(forms):
            path = _path(box, obj)
            if path.split(".")[0] in obj.PropertiesList:
                self._bindings.append(_bound(box, obj, path))
        if "Touched" in obj.State and not was_touched:
            obj.purgeTouched()
        self._was_touched = was_touched

    def now(self):
        """Expressions by path."""
        return _expressions_of(self._obj)

    def changes(self):
        """Expressions by path, None for one that is removed, as they differ from those at first."""
        now = _expressions_of(self._obj)
        return {
            path: now.get(path) for path in sorted({*now, *self._before}) if now.get(path) != self._before.get(path)
        }

    def document_changed(self):
        """Steps may have been undone that there were at first."""
        steps = self._obj.Document.UndoCount
        if steps < self._steps:
            self._steps, self._before = steps, _expressions_of(self._obj)

    def put_back(self):
        """Sets the expressions there were at first, and takes back the steps to undo that FreeCAD has made."""
        try:
            self._undo()
            changes = self.changes()
        except ReferenceError:  # the document was closed
            return
        for path in changes:
            self._obj.setExpression(path, self._before.get(path))
        if changes and not self._was_touched and "Invalid" not in self._obj.State:
            self._obj.purgeTouched()

    def _undo(self):
        document = self._obj.Document
        names = document.UndoNames[: max(0, document.UndoCount - self._steps)]
        own = list(itertools.takewhile(lambda name: name.startswith(_STEP), names))
        for _ in own:
            document.undo()
        if own:
            # They are not to be redone; FreeCAD forgets them with the first change in a new transaction.
            document.openTransaction(_STEP)
            self._obj.Label2 += " "
            abort_transaction(document)
            if not self._was_touched and "Invalid" not in self._obj.State:
                self._obj.purgeTouched()


class NewExpressions(EventFilter):
    """As Expressions, of an object that is yet to be made of `source`: FreeCAD has no dialog for that, so "=" asks."""

    def __init__(self, source, forms):
        super().__init__()
        self._source = source
        self._marks = {box.objectName(): self._mark(box) for box in _boxes(forms)}
        for box in _boxes(forms):
            box.installEventFilter(self)

    def _mark(self, box):
        """The f(x) icon, as FreeCAD has it in the fields of objects that are there already; None where PySide 2 takes
        the field's line for an object that was there before: "=" works without the icon."""
        line = box.findChild(QtGui.QLineEdit)
        if line is None:
            return None
        action = line.addAction(QtGui.QIcon(_UNSET), QtGui.QLineEdit.TrailingPosition)
        action.setObjectName("expression")
        action.setVisible(
            False
        )  # it takes room, so it is there only in the field that has the focus, or once it is set
        action.setToolTip(translate("FemScalpel", "Enter an expression (=)"))
        action.triggered.connect(lambda *_: self._ask(box))
        return action

    def filtered(self, box, event):
        if event.type() in (QtCore.QEvent.FocusIn, QtCore.QEvent.FocusOut):
            self._show_mark(box, event.type() == QtCore.QEvent.FocusIn)
        if event.type() != QtCore.QEvent.KeyPress or event.key() != QtCore.Qt.Key_Equal:
            return False
        QtCore.QTimer.singleShot(0, lambda: self._ask(box))  # not from within the key's event
        return True

    def _show_mark(self, box, has_focus):
        mark = self._marks.get(box.objectName())
        if mark is not None:
            mark.setVisible(has_focus or bool(box.property(fields.EXPRESSION)))

    def _ask(self, box):
        title = translate("FemScalpel", "Expression")
        label = translate("FemScalpel", "Such as Box.Length / 2. With nothing entered the field takes numbers again.")
        text = box.property(fields.EXPRESSION) or ""
        while True:
            text, ok = QtGui.QInputDialog.getText(box, title, label, QtGui.QLineEdit.Normal, text)
            if not ok:
                return
            try:
                number = self._value(text, box) if text.strip() else None
                break
            except Exception as error:  # of many types: whatever evaluating meets
                label = str(error)
        box.setProperty(fields.EXPRESSION, "")
        if number is not None:
            box.setProperty("rawValue", number)  # which tells the panel
            box.setProperty(fields.EXPRESSION, text.strip())
        box.setReadOnly(number is not None)
        mark = self._marks[box.objectName()]
        if mark is not None:
            tip = translate("FemScalpel", "Enter an expression (=)") if number is None else f"= {text.strip()}"
            mark.setIcon(QtGui.QIcon(_UNSET if number is None else _SET))
            mark.setToolTip(tip)
        self._show_mark(box, box.hasFocus())
        if number is not None:
            box.setToolTip(f"= {text.strip()}")
        box.valueChanged.emit(box.property("rawValue"))

    def _value(self, text, box):
        found = self._source.evalExpression(text)
        unit = FreeCAD.Units.Quantity(1, FreeCAD.Units.Unit()) if not box.property("unit") else None
        wanted = unit.Unit if unit is not None else FreeCAD.Units.Quantity(f"1 {box.property('unit')}").Unit
        if isinstance(found, FreeCAD.Units.Quantity):
            if found.Unit not in (wanted, FreeCAD.Units.Unit()):
                raise ValueError(
                    translate("FemScalpel", "That is %1; it must be a number, or in %2.")
                    .replace("%1", found.UserString)
                    .replace("%2", box.property("unit") or "1")
                )
            found = found.Value
        return float(found)

    def take(self, obj, forms):
        """Expressions by path, for `obj`."""
        texts = {_path(box, obj): box.property(fields.EXPRESSION) for box in _boxes(forms)}
        return {path: text for path, text in texts.items() if text and path.split(".")[0] in obj.PropertiesList}

    def document_changed(self):
        """Nothing of it concerns an object that is yet to be made."""

    def put_back(self):
        """Nothing was changed yet."""


def _boxes(forms):
    for form in forms:
        for box in form.findChildren(QtGui.QAbstractSpinBox):
            if box.objectName() in PATHS and box.inherits("Gui::QuantitySpinBox"):
                yield box


def _path(box, obj):
    """The path of the property of `obj` that a field is of."""
    place = placement_property(obj) if {"PlanePlacement", "AxisPlacement"} & set(obj.PropertiesList) else ""
    vector = {"By": "MoveBy", "Scale": "ScaleCentre"}.get(getattr(obj, "Motion", None), "none")
    return PATHS[box.objectName()].format(place=place, vector=vector)


def _bound(box, obj, path):
    binding = FreeCADGui.ExpressionBinding(box)
    binding.bind(obj, path)
    return binding


def _expressions_of(obj):
    return {path.lstrip("."): text for path, text in obj.ExpressionEngine}
