# SPDX-License-Identifier: LGPL-2.1-or-later
"""Marks picked points in the 3-D view, in front of everything."""

import numpy as np
from pivy import coin

from .colours import HIGHLIGHT
from .nodes import PointNode
from .overlay import Overlay, unpickable


class Marks(Overlay):
    """Points."""

    def __init__(self, view):
        super().__init__(view, "FemScalpelMarks")
        self._points = PointNode("FemScalpelPicked", HIGHLIGHT, 10.0)
        front = coin.SoAnnotation()
        for node in (unpickable(), self._points.root):
            front.addChild(node)
        self.root.addChild(front)
        self.open()

    def mark(self, points):
        """Shows these points and no others."""
        self._points.show(np.array(points, np.float32).reshape(-1, 3))
