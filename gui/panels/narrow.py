# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes forms fit a narrow dock, as FreeCAD's is at first: captions wrap instead of being cut off."""

from PySide import QtCore, QtGui

from ..event_filter import EventFilter


class Captions(EventFilter):
    """Wraps the captions of the boxes to tick in some forms, and labels of several words, at the width they get."""

    def __init__(self, forms):
        super().__init__(forms[0])
        for form in forms:
            for label in form.findChildren(QtGui.QLabel):
                label.setWordWrap(label.wordWrap() or " " in label.text())
            for box in form.findChildren(QtGui.QCheckBox):
                self.add(box)

    def add(self, box):
        """Wraps the caption of a button, too."""
        policy = box.sizePolicy()
        policy.setHorizontalPolicy(QtGui.QSizePolicy.Ignored)
        box.setSizePolicy(policy)
        wrap(box)
        box.installEventFilter(self)

    def filtered(self, receiver, event):
        if event.type() == QtCore.QEvent.Resize and isinstance(receiver, QtGui.QAbstractButton):
            wrap(receiver)
        return False


def wrap(box):
    """Wraps the caption of a button that has its width already."""
    metrics = box.fontMetrics()
    lines = box.text().split("\n")
    wide = lambda text: metrics.size(QtCore.Qt.TextShowMnemonic, text).width()  # noqa: E731
    around = box.sizeHint().width() - max(map(wide, lines))
    room, words, wrapped = box.width() - around, " ".join(lines).split(" "), []
    for word in words:
        if wrapped and wide(f"{wrapped[-1]} {word}") <= room:
            wrapped[-1] += f" {word}"
        else:
            wrapped.append(word)
    box.setMinimumWidth(around + max(map(wide, words)))
    if wrapped != lines:
        box.setText("\n".join(wrapped))
        box.updateGeometry()


def share_by_captions(boxes):
    """Has buttons beside each other share their row by what their captions take."""
    for box in boxes:
        policy = box.sizePolicy()
        policy.setHorizontalStretch(min(255, 12 + box.fontMetrics().boundingRect(box.text()).width()))
        box.setSizePolicy(policy)
