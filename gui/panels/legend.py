# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the colours of the preview mean, of those that are in it."""

import html
from collections import Counter

import numpy as np
from PySide import QtCore, QtGui

from .. import preferences
from ..translate import translate
from ..view import colours

_MOST_FAMILIES = 8


class Legend(QtGui.QLabel):
    """Patches of colour with what they mean."""

    def __init__(self):
        super().__init__()
        self.setObjectName("legend")
        self.setWordWrap(True)
        self.setTextFormat(QtCore.Qt.RichText)
        self.entries = []
        self.hide()

    def show_entries(self, entries):
        """Shows [(colours, text)]: `colours` three numbers in [0, 1], or several such."""
        self.entries = entries
        self.setText(" &nbsp; ".join(f"{_patch(rgb)}&nbsp;{html.escape(text)}" for rgb, text in entries))
        self.setVisible(bool(entries))


def _patch(rgb):
    levels = (np.atleast_2d(np.asarray(rgb, float)) * 255).round().astype(int)
    spaces = "&nbsp;" * (4 if len(levels) == 1 else 2)
    return "".join(f"<span style='background-color:rgb({r},{g},{b})'>{spaces}</span>" for r, g, b in levels)


def entries_of(scene, data, cracks=()):
    """What the colours of a PreviewScene mean that shows a PreviewData, beside `cracks`, (colour, label), that are
    drawn with the objects that have made them."""
    entries = []
    if scene.colouring == "quality":
        rgb = colours.quality_rgb(np.array((0.0, 0.15, 0.3, 0.5, 0.75, 1.0)))
        entries.append((rgb, translate("FemScalpel", "changed elements, poor to good (mean ratio 0 to 1)")))
        entries.append((colours.NEUTRAL, translate("FemScalpel", "unchanged")))
    else:
        entries += _families(data)
    colour = preferences.colour
    for rgb, drawn, text in (
        (colour("Interface", colours.INTERFACE), data.outline, translate("FemScalpel", "border of what is made")),
        (colour("Front", colours.FRONT), data.front, translate("FemScalpel", "front: the crack ends here")),
        (colour("Border", colours.BORDER), data.borders, translate("FemScalpel", "border between groups")),
        (colours.BEAM, data.beams, translate("FemScalpel", "beams")),
        (colour("Removed", colours.REMOVED), data.removed.faces, translate("FemScalpel", "removed")),
        (
            colour("Moved", colours.MOVED),
            data.moved if scene.show_moved else (),
            translate("FemScalpel", "moved nodes"),
        ),
    ):
        if len(drawn):
            entries.append((rgb, text))
    crack = translate("FemScalpel", "existing crack: %1")
    return entries + [(rgb, crack.replace("%1", label)) for rgb, label in cracks]


def _families(data):
    """The groups that are seen, those of most faces first."""
    counts = Counter()
    for surface in (*data.rest, *data.band):
        counts.update(surface.family.tolist())
    names = [data.families[family] for family, _ in counts.most_common()]
    shown = names if len(names) <= _MOST_FAMILIES else names[: _MOST_FAMILIES - 1]
    rgb = dict(zip(data.families, colours.families_rgb(data.families)))
    entries = [
        (rgb[family], " ∩ ".join(family) if family else translate("FemScalpel", "in no group")) for family in shown
    ]
    if len(shown) < len(names):
        more = translate("FemScalpel", "and %1 other combinations of groups")
        entries.append((colours.NEUTRAL, more.replace("%1", str(len(names) - len(shown)))))
    return entries
