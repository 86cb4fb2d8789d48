# SPDX-License-Identifier: LGPL-2.1-or-later
"""A text in the 3-D view that stays readable on whatever is behind it."""

import math

import FreeCADGui
from pivy import coin
from PySide import QtCore, QtGui

from .nodes import Part

_LEADER = 22  # pixels from the point to the box
_PAD = 5


class LabelNode(Part):
    """A text in a box, always in front, with a line to the point it is about."""

    def __init__(self, name):
        super().__init__(name, coin.SoAnnotation())
        self._place = coin.SoTranslation()
        self._image = coin.SoImage()
        self._image.horAlignment = coin.SoImage.LEFT
        self._image.vertAlignment = coin.SoImage.BOTTOM
        self._inside.addChild(self._place)
        self._inside.addChild(self._image)
        self._text = ""

    @property
    def text(self):
        """What is shown, "" when nothing is."""
        return self._text if self.is_shown else ""

    def show(self, point, text):
        """Shows `text` beside `point`."""
        self._place.translation.setValue(*[float(x) for x in point])
        if text != self._text:
            self._text = text
            picture = label_picture(text, pixel_ratio())
            size = coin.SbVec2s(picture.width(), picture.height())
            self._image.image.setValue(size, 4, bytes(picture.constBits()))
        self.reveal()


def pixel_ratio():
    """Pixels of the screen, which Coin draws, for one of those that the window is laid out in."""
    return float(FreeCADGui.getMainWindow().devicePixelRatioF())


def label_picture(text, ratio=1.0):
    """The box with its line, from the bottom left corner, as Coin reads images: RGBA from the bottom row up. `ratio` as
    of pixel_ratio()."""
    font = QtGui.QApplication.font()
    font.setBold(True)
    font.setPixelSize(max(14, QtGui.QFontInfo(font).pixelSize() + 2))
    metrics = QtGui.QFontMetrics(font)
    box = QtCore.QRectF(_LEADER, 0.5, metrics.boundingRect(text).width() + 3 * _PAD, metrics.height() + _PAD)
    width, height = int(box.right()) + 2, int(box.bottom()) + _LEADER
    picture = QtGui.QImage(math.ceil(ratio * width), math.ceil(ratio * height), QtGui.QImage.Format_RGBA8888)
    picture.setDevicePixelRatio(ratio)
    picture.fill(QtCore.Qt.transparent)
    painter = QtGui.QPainter(picture)
    painter.setRenderHint(QtGui.QPainter.Antialiasing)
    painter.setFont(font)
    # A light line beneath the dark one: seen on any background.
    line = QtCore.QLineF(1, height - 1, box.left() + 3, box.bottom() - 3)
    for colour, width in ((QtCore.Qt.white, 4.0), (QtCore.Qt.black, 1.6)):
        painter.setPen(QtGui.QPen(QtGui.QColor(colour), width))
        painter.drawLine(line)
    painter.setPen(QtGui.QPen(QtGui.QColor(30, 30, 30), 1.2))
    painter.setBrush(QtGui.QColor(255, 255, 255))
    painter.drawRoundedRect(box, 4, 4)
    painter.drawText(box, int(QtCore.Qt.AlignCenter), text)
    painter.end()
    return picture.mirrored(False, True)
