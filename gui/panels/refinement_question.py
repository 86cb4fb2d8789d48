# SPDX-License-Identifier: LGPL-2.1-or-later
"""Asks whether a refinement that is above the limit is to be made all the same."""

import math

import FreeCAD
from PySide import QtCore, QtGui

from ..refinement_guard import as_text
from ..translate import translate
from .narrow import Captions, wrap


def length_text(length):
    """A length in the user's unit."""
    return FreeCAD.Units.Quantity(f"{length!r} mm").UserString


def refining_text(cost):
    """What is said while a refinement of this Cost is made."""
    return (
        translate("FemScalpel", "Refining first, to edges of %1: %2…")
        .replace("%1", length_text(cost.size))
        .replace("%2", as_text(cost, translate))
    )


class RefinementQuestion:
    """A text with two buttons, at the top of a form where it is seen: take(size) is called for a coarser refinement,
    agree(elements) for as many elements as it takes."""

    def __init__(self, form, take, agree):
        self._box = QtGui.QWidget()
        self._box.setObjectName("refinementQuestion")
        self._text = QtGui.QLabel()
        self._text.setObjectName("refinementCost")
        self._text.setWordWrap(True)
        self._fitting, self._anyway = QtGui.QPushButton(), QtGui.QPushButton()
        self._fitting.setObjectName("refineFitting")
        self._anyway.setObjectName("refineAnyway")
        self._anyway.setText(translate("FemScalpel", "Compute it all the same"))
        layout = QtGui.QVBoxLayout(self._box)
        layout.setContentsMargins(0, 0, 0, 0)
        for widget in (self._text, self._fitting, self._anyway):
            layout.addWidget(widget)
        form.layout().insertWidget(0, self._box)
        self._captions = Captions([self._box])
        for button in (self._fitting, self._anyway):
            self._captions.add(button)
        self._cost, self._size = None, math.inf
        self._fitting.clicked.connect(lambda: take(self._size))
        self._anyway.clicked.connect(lambda: agree(self._accepted()))
        self.hide()

    def ask(self, error):
        """Asks about a TooMuch. Returns the widget that does."""
        # Not the error itself, which holds what its computation had: the mesh.
        self._cost, self._size = error.cost, error.fitting
        self._text.setText(
            translate(
                "FemScalpel",
                "Refining first to edges of %1 would make %2. That is above the limit set in the preferences.",
            )
            .replace("%1", length_text(error.cost.size))
            .replace("%2", as_text(error.cost, translate))
        )
        self._fitting.setVisible(math.isfinite(error.fitting))
        if math.isfinite(error.fitting):
            self._fitting.setText(
                translate("FemScalpel", "Refine to edges of %1 instead").replace("%1", length_text(error.fitting))
            )
        self._box.setEnabled(True)
        self._box.show()
        for button in (self._fitting, self._anyway):
            wrap(button)
        return self._box

    def wait(self):
        """Takes no answer until it is asked again or hidden: something else was entered since."""
        self._box.setEnabled(False)

    def hide(self):
        """Asks nothing."""
        self._box.hide()

    def _accepted(self):
        # A little more, as moving the tool a little changes the count.
        return math.inf if self._cost.is_more else int(1.25 * self._cost.elements)
