# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the panels say of a report, above its histogram and its table of groups."""

import html
from collections import Counter

import FreeCAD
from femscalpelobjects import pieces

from .. import preferences
from ..messages import in_language
from ..translate import QT_TRANSLATE_NOOP, translate
from . import fields


def sentence(text):
    """What the engine says, in the user's language where that is known, with a capital letter first and a full stop
    behind it."""
    text = in_language(text)
    return text[:1].upper() + text[1:] + ("" if text.endswith((".", "!", "?")) else ".")


# What Report.converted counts.
_KINDS = {
    "triangle": QT_TRANSLATE_NOOP("FemScalpel", "triangles of seven nodes"),
    "quad": QT_TRANSLATE_NOOP("FemScalpel", "quadrangles"),
    "pyramid": QT_TRANSLATE_NOOP("FemScalpel", "pyramids"),
    "wedge": QT_TRANSLATE_NOOP("FemScalpel", "prisms"),
    "hexahedron": QT_TRANSLATE_NOOP("FemScalpel", "hexahedra"),
}


def made_text(report):
    """How large what was made is, as a sentence; "" where there is nothing to say."""
    named = {
        ("crack", 2): translate("FemScalpel", "crack of %1"),
        ("crack", 1): translate("FemScalpel", "crack of %1"),
        ("front", 1): translate("FemScalpel", "front of %1"),
        ("wall", 2): translate("FemScalpel", "wall of %1"),
    }
    texts = [
        named[extent.what, extent.dimension].replace("%1", measure_text(extent.measure, extent.dimension))
        for extent in report.extents
        if (extent.what, extent.dimension) in named
    ]
    return sentence(", ".join(texts)) if texts else ""


def measure_text(measure, dimension):
    """A length, area or volume in the user's unit."""
    quantity = FreeCAD.Units.Quantity(f"{float(measure)!r} {('', 'mm', 'mm^2', 'mm^3')[dimension]}")
    return quantity.UserString.replace("^2", "²").replace("^3", "³")


def summary(report):
    """What was done, how good it is, and the warnings; as rich text."""
    after = report.quality.after
    text = translate(
        "FemScalpel", "%1 nodes moved, %2 added; %3 elements added, %4 removed. Mean ratio at least %5 (before: %6)."
    )
    numbers = (
        report.nodes_moved,
        report.nodes_added,
        report.elements_added,
        report.elements_removed,
        f"{after.minimum:.2f}",
        f"{report.quality.before.minimum:.2f}",
    )
    for k, number in enumerate(numbers, 1):
        text = text.replace(f"%{k}", str(number))
    made = made_text(report)
    text += f" {made}" if made else ""
    if report.converted:
        counts = Counter()
        for kind, count in report.converted.items():
            counts[kind.rstrip("0123456789")] += count
        kinds = ", ".join(f"{count} {translate('FemScalpel', _KINDS[kind])}" for kind, count in counts.items())
        text += " " + translate("FemScalpel", "First became triangles or tetrahedra: %1.").replace("%1", kinds)
    if after.minimum < preferences.quality_threshold():
        text += (
            f" <b style='{fields.ERROR}'>"
            + translate("FemScalpel", "Worse than your threshold of %1.").replace(
                "%1", f"{preferences.quality_threshold():g}"
            )
            + "</b>"
        )
    for warning in report.warnings:
        text += f"<br><span style='{fields.WARNING}'>{html.escape(sentence(warning), quote=False)}</span>"
    return text


class PiecesText:
    """What a preview falls into, and what holds the pieces, as rich text. `source_object`: the mesh object it is of,
    whose geometry is searched only once it matters."""

    def __init__(self, source_object):
        self._source, self._supports = source_object, None

    def __call__(self, parting):
        if parting is None:
            return ""
        if self._supports is None:
            self._supports = (pieces.find_supports(self._source),)
        held = pieces.holders(parting, self._supports[0])
        text = html.escape(pieces.sentence_of(parting, held, translate))
        style = f" style='{fields.WARNING}'" if pieces.is_unsafe(held) else ""
        return f"<br><span{style}>{text}</span>"
