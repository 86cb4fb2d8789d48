# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is drawn and said can be read in FreeCAD's dark themes, and on screens of high resolution."""

import os
from unittest import mock

import numpy as np

from .gui_testing import *  # noqa: F403
from .test_crack_panel import CrackTest

#: Contrast that is wanted of texts, by the Web Content Accessibility Guidelines.
READABLE = 4.5


def contrast(first, second):
    """Of two QColors, from 1 to 21."""

    def luminance(colour):
        parts = (c / 12.92 if c <= 0.03928 else ((c + 0.055) / 1.055) ** 2.4 for c in colour.getRgbF()[:3])
        return sum(weight * part for weight, part in zip((0.2126, 0.7152, 0.0722), parts))

    bright, dark = sorted((luminance(first), luminance(second)), reverse=True)
    return (bright + 0.05) / (dark + 0.05)


def picture_of(box):
    """How a widget of the panel is seen on the screen; scrolls there."""
    areas = FreeCADGui.getMainWindow().findChildren(QtGui.QScrollArea)
    area = next(area for area in areas if area.isVisible() and area.isAncestorOf(box))
    for _ in range(2):  # the task boxes may grow meanwhile
        spin(0.15)
        area.ensureWidgetVisible(box, 0, 0)
    spin(0.1)
    corner = box.mapToGlobal(QtCore.QPoint(0, 0))
    screen = QtGui.QApplication.primaryScreen()
    return screen.grabWindow(0, corner.x(), corner.y(), box.width(), box.height()).toImage()


def best_contrast(picture, area):
    """Between the corner of an area of a picture, which must be background, and what is drawn in it."""
    colours = {picture.pixel(x, y) for x in range(area.left(), area.right()) for y in range(area.top(), area.bottom())}
    ground = QtGui.QColor(picture.pixel(area.left(), area.top()))
    return max(contrast(ground, QtGui.QColor(colour)) for colour in colours)


class Themes(CrackTest):
    def setUp(self):
        super().setUp()
        application = QtGui.QApplication.instance()
        self.addCleanup(application.setStyleSheet, application.styleSheet())

    def check(self):
        histogram = widget("histogram")
        scale = histogram.fontMetrics().height()

        def is_readable():
            picture = picture_of(histogram)
            ends = QtCore.QRect(0, picture.height() - scale - 2, 16, scale + 2)
            return best_contrast(picture, ends) > READABLE

        wait_until(is_readable, "a histogram whose scale can be read")  # a busy machine draws it later
        for name in ("status", "legend"):
            label = widget(name)
            picture = picture_of(label)
            ground = QtGui.QColor(picture.pixel(picture.width() - 1, 0))
            self.assertGreater(contrast(ground, label.palette().color(QtGui.QPalette.WindowText)), READABLE, name)
        styles = re.findall(r"color: (#\w{6}); background-color: (#\w{6})", widget("status").text())
        self.assertTrue(styles)
        for colour, ground in styles:
            self.assertGreater(contrast(QtGui.QColor(ground), QtGui.QColor(colour)), READABLE)

    def test_panel_opened_in_a_theme(self):
        for name in ("Behave-dark.qss", "Dark-blue.qss", "Darker-green.qss", "Light-orange.qss", "ProDark.qss"):
            if not os.path.exists(theme_file(name)):  # another release of FreeCAD
                continue
            with self.subTest(theme=name):
                choose_theme(name)
                self.look_at_panel(name)

    def look_at_panel(self, name):
        self.open_panel()
        try:
            picture_of(widget("histogram"))
            screenshot("theme_" + name)
            self.check()
            type_into("originX", "900")
            self.wait_for_message("geometryError")
            picture = picture_of(widget("geometryError"))
            self.assertGreater(best_contrast(picture, picture.rect()), READABLE)
        finally:
            press_cancel()

    def test_theme_chosen_while_the_panel_is_open(self):
        self.open_panel()
        self.check()
        for name in ("Dark-blue.qss", "Light-blue.qss", "ProDark.qss"):
            if os.path.exists(theme_file(name)):
                with self.subTest(theme=name):
                    choose_theme(name)
                    self.check()


class HighResolution(CrackTest):
    def test_labels_have_the_pixels_of_the_screen(self):
        from femscalpelgui.view import label

        pictures, draw = {}, label.label_picture

        def drawn(text, ratio=1.0):
            pictures[ratio] = draw(text, ratio)
            return pictures[ratio]

        for ratio in (1.0, 2.0, 1.25):
            with mock.patch.object(label, "pixel_ratio", lambda ratio=ratio: ratio):
                with mock.patch.object(label, "label_picture", drawn):
                    self.open_panel()
            screenshot(f"label_{ratio}")
            press_cancel()
        sizes = [np.array((picture.width(), picture.height())) for picture in map(pictures.get, (1.0, 2.0, 1.25))]
        self.assertLessEqual(abs(sizes[1] - 2 * sizes[0]).max(), 1)
        self.assertLessEqual(abs(sizes[2] - 1.25 * sizes[0]).max(), 1)
        self.assertGreater(len({pictures[2.0].pixel(x, sizes[1][1] // 2) for x in range(sizes[1][0])}), 2)  # drawn, too
