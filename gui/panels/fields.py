# SPDX-License-Identifier: LGPL-2.1-or-later
"""FreeCAD's unit-aware number fields, and messages beside fields."""

from PySide import QtGui

#: Styles of errors and warnings. They have a ground of their own, as themes have any: dark, light, or grey.
ERROR = "color: #8c1d18; background-color: #fde7e4;"
WARNING = "color: #654000; background-color: #fff1cf;"


#: Property of a field of a panel that makes a new object: the expression that says its number.
EXPRESSION = "femscalpelExpression"


class Number:
    """A Gui::QuantitySpinBox whose number is exact.

    The box rounds what a program gives it to the decimals it shows; here the given number stays until the user types
    another. In FreeCAD's base units: mm, degrees.
    """

    def __init__(self, box, changed, number=0.0, step=None):
        self._box, self._changed = box, changed
        if step is not None:
            box.setProperty("singleStep", step)
        self._value = float(number)
        self.set(number)
        box.valueChanged.connect(self._typed)

    @property
    def value(self):
        """The number."""
        return self._value

    @property
    def has_expression(self):
        """Whether an expression says the number."""
        return bool(self._box.property("expression") or self._box.property(EXPRESSION))

    def set(self, number):
        """Enters a number without telling anyone; not where an expression says it."""
        if self.has_expression:
            return
        self._value = float(number)
        blocked = self._box.blockSignals(True)
        self._box.setProperty("rawValue", self._value)
        self._box.blockSignals(blocked)

    def _typed(self, *_):
        self._value = float(self._box.property("rawValue"))
        self._changed()


def show_first_digits(forms):
    """Where a number does not fit into its field, the unit is out of sight, not the first digits."""
    for form in forms:
        for box in form.findChildren(QtGui.QAbstractSpinBox):
            line = box.findChild(QtGui.QLineEdit)
            if line is not None and not line.hasFocus():
                line.home(False)


def show_error(label, text):
    """Shows `text` in a message label, or hides it when there is none."""
    label.setStyleSheet(f"QLabel {{ {ERROR} padding: 3px; }}")
    label.setText(text or "")
    label.setVisible(bool(text))


def round_step(length):
    """1, 2 or 5 times a power of ten, at most `length`."""
    power = 10.0 ** len(str(int(length))) / 10 if length >= 1 else 1.0
    while power > length > 0:
        power /= 10
    return next((k * power for k in (5, 2, 1) if k * power <= length), power)
