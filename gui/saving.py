# SPDX-License-Identifier: LGPL-2.1-or-later
"""Texts saved by the user, and copied."""

import os
import tempfile

import FreeCADGui
from PySide import QtGui

from .translate import translate


def save(title, name, formats):
    """Asks where to, under the `title`, and writes a text there. Returns the path, "" when nothing was written; then
    the user knows why.

    `formats`: {name of the format: (ending, function that gives the text)}; `name`: suggested, without ending.
    """
    filters = {f"{what} (*{ending})": (ending, make) for what, (ending, make) in formats.items()}
    first = next(iter(filters.values()))[0]
    path, chosen = QtGui.QFileDialog.getSaveFileName(
        FreeCADGui.getMainWindow(), title, name + first, ";;".join(filters)
    )
    if not path:
        return ""
    chosen = chosen if chosen in filters else next(iter(filters))
    known = {ending: make for ending, make in filters.values()}
    ending = os.path.splitext(path)[1].lower()
    if ending not in known:  # a name without one, or another than the dialog's
        ending = filters[chosen][0]
        path += ending
        if os.path.exists(path):  # the dialog has not asked
            answer = QtGui.QMessageBox.question(
                FreeCADGui.getMainWindow(),
                title,
                translate("FemScalpel", "%1 exists already. Replace it?").replace("%1", path),
                QtGui.QMessageBox.Yes | QtGui.QMessageBox.No,
            )
            if answer != QtGui.QMessageBox.Yes:
                return ""
    try:
        write(path, known[ending]())
    except OSError as error:
        text = translate("FemScalpel", "%1 cannot be written: %2. Choose another folder or name.")
        text = text.replace("%2", error.strerror or str(error)).replace("%1", path)
        QtGui.QMessageBox.warning(FreeCADGui.getMainWindow(), title, text)
        return ""
    return path


def write(path, text):
    """Writes a text file, whole or not at all. Raises OSError."""
    path = os.path.realpath(path)  # what a link points to, not the link
    handle, beside = tempfile.mkstemp(dir=os.path.dirname(path), prefix=".femscalpel-")
    try:
        with os.fdopen(handle, "w", encoding="utf-8", newline="") as file:
            file.write(text)
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(beside, os.stat(path).st_mode & 0o777 if os.path.exists(path) else 0o666 & ~mask)
        os.replace(beside, path)
    except OSError:
        os.unlink(beside)
        raise


def copy(text):
    """Puts a text onto the clipboard."""
    QtGui.QApplication.clipboard().setText(text)
