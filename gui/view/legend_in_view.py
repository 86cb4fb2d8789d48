# SPDX-License-Identifier: LGPL-2.1-or-later
"""What colours mean, in a corner of the 3-D view: the panel's own may be scrolled out of sight."""

import math

import numpy as np
from pivy import coin
from PySide import QtCore, QtGui

from .label import pixel_ratio
from .overlay import Overlay, unpickable

_MARGIN = 10  # pixels from the edge of the view, and between what is in the box
_PATCH = 30  # pixels, the width of a patch
_WIDEST = 420  # pixels
_MOST = 14  # entries


class LegendInView(Overlay):
    """A list of patches of colour with what they mean, at the lower left of a 3-D view, in front of everything. It is
    looked at, not picked, and does not count for what fits into the view."""

    def __init__(self, view):
        super().__init__(view, "FemScalpelLegend")
        self.entries = []
        self._image = coin.SoImage()
        self._image.horAlignment = coin.SoImage.LEFT
        self._image.vertAlignment = coin.SoImage.BOTTOM
        self._place = coin.SoTranslation()
        self._place.enableNotify(False)  # it follows the camera while that draws
        follow = coin.SoCallback()
        follow.setCallback(self._follow)
        no_box = coin.SoResetTransform()
        no_box.whatToReset = coin.SoResetTransform.BBOX
        self._shown = coin.SoSwitch()
        inside = coin.SoAnnotation()
        for node in (unpickable(), follow, self._place, self._image, no_box):
            inside.addChild(node)
        self._shown.addChild(inside)
        self.root.addChild(self._shown)
        self.open()

    def show_entries(self, entries):
        """Shows [(colours, text)]: `colours` three numbers in [0, 1], or several such; nothing where there are none."""
        self.entries = list(entries)
        if self.entries:
            picture = legend_picture(self.entries, pixel_ratio())
            size = coin.SbVec2s(picture.width(), picture.height())
            self._image.image.setValue(size, 4, bytes(picture.constBits()))
        self._shown.whichChild = coin.SO_SWITCH_ALL if self.entries else coin.SO_SWITCH_NONE

    @property
    def is_shown(self):
        """Whether there is anything to be seen."""
        return bool(self.entries)

    def _follow(self, _, action):
        if not action.isOfType(coin.SoGLRenderAction.getClassTypeId()):
            return
        state = action.getState()
        volume = coin.SoViewVolumeElement.get(state)
        width, height = coin.SoViewportRegionElement.get(state).getViewportSizePixels().getValue()
        margin = _MARGIN * pixel_ratio()
        corner = coin.SbVec2f(margin / max(width, 1), margin / max(height, 1))
        near, far = volume.projectPointToLine(corner)
        middle = [(a + b) / 2 for a, b in zip(near.getValue(), far.getValue())]
        self._place.translation.setValue(*middle)


def legend_picture(entries, ratio=1.0):
    """The box as Coin reads images: RGBA from the bottom row up. `ratio`: pixels of the screen for one of the window's,
    as of pixel_ratio()."""
    if len(entries) > _MOST:
        entries = [*entries[: _MOST - 1], (None, "…")]
    font = QtGui.QApplication.font()
    font.setPixelSize(max(12, QtGui.QFontInfo(font).pixelSize()))
    metrics = QtGui.QFontMetrics(font)
    texts = [metrics.elidedText(text, QtCore.Qt.ElideMiddle, _WIDEST) for _, text in entries]
    row = metrics.height() + 2
    width = _PATCH + 3 * _MARGIN + max(metrics.boundingRect(text).width() for text in texts)
    height = row * len(entries) + _MARGIN
    picture = QtGui.QImage(math.ceil(ratio * width), math.ceil(ratio * height), QtGui.QImage.Format_RGBA8888)
    picture.setDevicePixelRatio(ratio)
    picture.fill(QtCore.Qt.transparent)
    painter = QtGui.QPainter(picture)
    painter.setRenderHint(QtGui.QPainter.Antialiasing)
    painter.setFont(font)
    # A ground of its own: the view's has any colours.
    painter.setPen(QtGui.QPen(QtGui.QColor(128, 128, 128), 1))
    painter.setBrush(QtGui.QColor(255, 255, 255, 225))
    painter.drawRoundedRect(QtCore.QRectF(0.5, 0.5, width - 1, height - 1), 4, 4)
    painter.setRenderHint(QtGui.QPainter.Antialiasing, False)
    for k, ((rgb, _), text) in enumerate(zip(entries, texts)):
        top = _MARGIN // 2 + k * row
        if rgb is not None:
            levels = (np.atleast_2d(np.asarray(rgb, float)) * 255).round().astype(int).tolist()
            step = _PATCH / len(levels)
            for n, level in enumerate(levels):
                left = _MARGIN + round(n * step)
                right = _MARGIN + round((n + 1) * step)
                painter.fillRect(left, top + 2, right - left, row - 4, QtGui.QColor(*level))
        painter.setPen(QtGui.QColor(30, 30, 30))
        left = _PATCH + 2 * _MARGIN
        painter.drawText(QtCore.QRect(left, top, width - left, row), int(QtCore.Qt.AlignVCenter), text)
    painter.end()
    return picture.mirrored(False, True)
