# SPDX-License-Identifier: LGPL-2.1-or-later
"""The preview in the 3-D view: shows PreviewData in a view's scene graph."""

import numpy as np
from pivy import coin

from .. import preferences
from ..translate import translate
from . import colours
from .label import LabelNode
from .nodes import FaceNode, LineNode, PointNode
from .overlay import Picture

NAME = "FemScalpelPreview"
#: How much of the part is shown, and what the colours mean.
LOOKS = ("cut away", "whole", "changed part only")
COLOURINGS = ("quality", "groups")


class PreviewScene(Picture):
    """The nodes of the preview, under one separator called "FemScalpelPreview".

    Its parts are called FemScalpelBand, ...Rest, ...Ghost, ...Borders, ...Beams, ...Outline, ...Front, ...Moved,
    ...MovedUnder, ...Removed, ...Worst and ...Highlight.
    """

    def __init__(self, view):
        super().__init__(view, NAME)
        self.look, self.colouring = LOOKS[0], COLOURINGS[0]
        self.show_moved, self.show_worst = True, True
        self._data = None
        self.rest = FaceNode("FemScalpelRest", colours.NEUTRAL, edges=(0.62, 0.64, 0.68))
        self.band = FaceNode("FemScalpelBand", colours.NEUTRAL, edges=(0.15, 0.15, 0.18))
        self.ghost = FaceNode("FemScalpelGhost", colours.NEUTRAL, transparency=0.82)
        self.removed = FaceNode("FemScalpelRemoved", preferences.colour("Removed", colours.REMOVED), transparency=0.75)
        self.borders = LineNode("FemScalpelBorders", preferences.colour("Border", colours.BORDER), 2.5)
        self.beams = LineNode("FemScalpelBeams", colours.BEAM, 4.0)
        self.outline = LineNode("FemScalpelOutline", preferences.colour("Interface", colours.INTERFACE), 4.0)
        self.front = LineNode("FemScalpelFront", preferences.colour("Front", colours.FRONT), 5.0)
        moved = preferences.colour("Moved", colours.MOVED)
        self.moved = PointNode("FemScalpelMoved", moved, 3.0)
        # Drawn before the faces and without depth of their own, so that faces are never behind them.
        self.moved_under = PointNode("FemScalpelMovedUnder", moved, 3.0)
        under = coin.SoSeparator()
        depth = coin.SoDepthBuffer()
        depth.write = False
        under.addChild(depth)
        under.addChild(self.moved_under.root)
        self.root.addChild(under)
        self.worst = LineNode("FemScalpelWorst", (0, 0, 0), 3.0)
        self.worst_label = LabelNode("FemScalpelWorstLabel")
        highlight = preferences.colour("Highlight", colours.HIGHLIGHT)
        self.highlight_faces = FaceNode("FemScalpelHighlight", highlight, edges=(0.45, 0.3, 0.0), in_front=True)
        self.highlight_lines = LineNode("FemScalpelHighlightLines", highlight, 6.0)
        self.highlight_points = PointNode("FemScalpelHighlightPoints", highlight, 9.0)
        # A highlighted group is in front of everything: it may lie inside the part.
        front = coin.SoAnnotation()
        for part in (self.worst, self.highlight_lines, self.highlight_points):
            front.addChild(part.root)
        for part in (
            self.highlight_faces,
            self.rest,
            self.band,
            self.borders,
            self.beams,
            self.outline,
            self.front,
            self.moved,
            self.removed,
            self.ghost,
        ):
            self.root.addChild(part.root)
        self.root.addChild(front)
        self.root.addChild(self.worst_label.root)
        self.open()

    def hide_all(self):
        """Shows nothing, as there is no mesh."""
        self._hide_result()
        self.rest.hide()
        self.beams.hide()

    def show_whole(self, surface, beside=None):
        """Shows an unchanged mesh, while there is no result; of what is `beside` it, a ghost."""
        self._hide_result()
        self.rest.show(surface.points, surface.faces)
        self.beams.show(surface.beams)
        if beside is not None:
            self.ghost.show(beside.points, beside.faces)

    def _hide_result(self):
        self._data = None
        for part in (
            self.band,
            self.ghost,
            self.removed,
            self.borders,
            self.outline,
            self.front,
            self.moved,
            self.moved_under,
            self.worst,
            self.worst_label,
        ):
            part.hide()

    def show(self, data):
        """Shows a PreviewData."""
        self._data = data
        self.redraw()

    def redraw(self):
        """Shows the same again after a change of look or colouring."""
        data = self._data
        if data is None:
            return
        cut_away, only = self.look == LOOKS[0] and not len(data.removed.faces), self.look == LOOKS[2]
        through = len(data.removed.faces) > 0 and not only
        (negative, positive), band = data.rest, data.band
        if only:
            self.rest.hide()
            self.ghost.hide()
        elif cut_away:
            (negative, islands), (changed, others) = negative.parted(), data.band[0].parted()
            self._fill(self.rest, [negative], data)
            # Not its lip, which is where that of the other side is.
            self._fill(self.ghost, [positive, data.band[1].without_lip(), islands, others], None)
            band = [changed]
        elif through and self.look == LOOKS[0]:
            self.rest.hide()
            band, others = zip(*(side.parted() for side in data.band))
            self._fill(self.ghost, [negative, positive, *others], None)
        else:
            self._fill(self.rest, [negative, positive], data)
            self.ghost.hide()
        self._fill(self.band, band, data, self.colouring == "quality")
        self.removed.show(data.removed.points, data.removed.faces)
        self.borders.show(data.borders)
        self.beams.show(data.beams)
        self.outline.show(data.outline)
        self.front.show(data.front)
        under = data.in_front & (self.look == LOOKS[0])
        for part, chosen in ((self.moved, ~under), (self.moved_under, under)):
            part.show(data.moved[chosen & self.show_moved])
        if self.show_worst and len(data.worst):
            self.worst.show(data.worst)
            self.worst_label.show(
                data.worst_centre, translate("FemScalpel", "worst %1").replace("%1", f"{data.worst_ratio:.2f}")
            )
        else:
            self.worst.hide()
            self.worst_label.hide()

    def _fill(self, part, surfaces, data, by_quality=False):
        points, faces, first = [], [], 0
        for surface in surfaces:
            points.append(surface.points)
            faces.append(np.where(surface.faces < 0, -1, surface.faces + first))
            first += len(surface.points)
        rgb = None
        if by_quality:
            rgb = colours.quality_rgb(np.concatenate([s.quality for s in surfaces]))
        elif data is not None and self.colouring == "groups":
            palette = colours.families_rgb(data.families)
            rgb = palette[np.concatenate([s.family for s in surfaces])]
        part.show(np.concatenate(points), np.concatenate(faces), rgb)

    def highlight(self, shape):
        """Lights up a GroupShape; None puts the light out."""
        if shape is None:
            for part in (self.highlight_faces, self.highlight_lines, self.highlight_points):
                part.hide()
            return
        self.highlight_faces.show(shape.points, shape.faces)
        self.highlight_lines.show(shape.lines)
        self.highlight_points.show(shape.nodes)
