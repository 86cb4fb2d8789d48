# SPDX-License-Identifier: LGPL-2.1-or-later
"""Histogram of mean ratios before and after, in the colours of the 3-D view."""

import numpy as np
from PySide import QtCore, QtGui

from ..translate import translate
from ..view.colours import quality_rgb


class Histogram(QtGui.QLabel):  # as themes say the colours of texts for labels
    """Bars for `after`, an outline for `before`; each an array of counts of equal bins over [0, 1]."""

    def __init__(self, parent=None):
        super().__init__(parent)
        self.setMinimumHeight(96)
        self.setObjectName("histogram")
        self.before = self.after = None
        self._ends = ("0", "1")
        self.setToolTip(
            translate(
                "FemScalpel", "Number of elements by mean ratio (1: equilateral, 0: flat). Bars: after; line: before"
            )
        )

    def show_counts(self, after, before=None, low=0.0, high=1.0, rgb=quality_rgb):
        """Shows counts; `rgb` gives the colours of the bins' middles."""
        self.after, self.before, self._rgb = after, before, rgb
        self._low, self._high = low, high
        self.update()

    def clear(self):
        """Shows nothing."""
        self.after = self.before = None
        self.update()

    def paintEvent(self, event):
        painter = QtGui.QPainter(self)
        if self.after is None:
            return
        text = self.fontMetrics().height()
        area = QtCore.QRectF(6, 4, self.width() - 12, self.height() - text - 8)
        count = len(self.after)
        top = max(1, max(self.after), *(self.before if self.before is not None else [0]))
        width = area.width() / count
        middles = self._low + (np.arange(count) + 0.5) / count * (self._high - self._low)
        for k, (n, rgb) in enumerate(zip(self.after, self._rgb(middles))):
            # A single element must be seen: it may be the one that matters.
            height = max(area.height() * n / top, 2.0 if n else 0.0)
            painter.fillRect(
                QtCore.QRectF(area.left() + k * width + 0.5, area.bottom() - height, width - 1, height),
                QtGui.QColor.fromRgbF(*[float(c) for c in rgb]),
            )
        painter.setPen(self.palette().color(self.foregroundRole()))
        if self.before is not None:
            line = QtGui.QPolygonF()
            for k, n in enumerate(self.before):
                y = area.bottom() - area.height() * n / top
                line.append(QtCore.QPointF(area.left() + k * width, y))
                line.append(QtCore.QPointF(area.left() + (k + 1) * width, y))
            painter.drawPolyline(line)
        painter.drawLine(area.bottomLeft(), area.bottomRight())
        low, high = f"{self._low:g}", f"{self._high:g}"
        base = self.height() - 4
        painter.drawText(int(area.left()), base, low)
        painter.drawText(int(area.right()) - self.fontMetrics().boundingRect(high).width() - 2, base, high)
        if self.before is not None:
            title = translate("FemScalpel", "mean ratio; line: before")
            painter.drawText(int(area.center().x() - self.fontMetrics().boundingRect(title).width() / 2), base, title)
