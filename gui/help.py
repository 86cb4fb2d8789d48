# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pages about the commands, in a window of their own: from the panels' Help button and by What's This. They are the
Markdown files that are installed with the workbench, so that nothing is fetched from anywhere."""

import os

import FreeCADGui
from PySide import QtCore, QtGui

from .event_filter import EventFilter
from .translate import FOLDER, QT_TRANSLATE_NOOP, translate

PAGES = os.path.join(FOLDER, "resources", "docs", "commands")
_PREFIX = "femscalpel:"  # of What's This texts of widgets
_NAME = "femscalpelHelp"
_LANGUAGE = QT_TRANSLATE_NOOP("FemScalpel", "These pages are in English.")  # told where FreeCAD is not


def path_of(page):
    """The file of a page, such as "crack"."""
    return os.path.join(PAGES, page + ".md")


def tag(page):
    """A What's This text that leads to a page."""
    return _PREFIX + page


def page_of(text):
    """The page that a What's This text is for, also that of a command; None where it is none of ours."""
    from .commands import COMMANDS, IN_MENU

    if text.startswith(_PREFIX):
        return text[len(_PREFIX) :]
    for command in filter(None, COMMANDS + IN_MENU):
        if text in (command.WHATS_THIS, translate(command.NAME, command.WHATS_THIS)):
            return command.page()
    return None


def show(page):
    """Shows a page and returns the window."""
    main = FreeCADGui.getMainWindow()
    dialog = main.findChild(QtGui.QDialog, _NAME) or _make(main)
    _label(dialog)
    note = dialog.findChild(QtGui.QLabel, "helpLanguage")
    note.setText(translate("FemScalpel", _LANGUAGE))
    note.setVisible(note.text() != _LANGUAGE)
    dialog.findChild(QtGui.QTextBrowser).setSource(QtCore.QUrl.fromLocalFile(path_of(page)))
    dialog.show()
    dialog.raise_()
    return dialog


def _make(main):
    dialog = QtGui.QDialog(main)
    dialog.setObjectName(_NAME)
    browser = QtGui.QTextBrowser()
    browser.setObjectName("helpText")
    browser.setOpenExternalLinks(True)
    buttons = QtGui.QDialogButtonBox(QtGui.QDialogButtonBox.Close)
    buttons.rejected.connect(dialog.reject)
    for name, run, available in (
        ("helpBack", browser.backward, browser.backwardAvailable),
        ("helpContents", lambda: show("index"), None),
    ):
        button = buttons.addButton("", QtGui.QDialogButtonBox.ActionRole)
        button.setObjectName(name)
        button.clicked.connect(lambda *_, run=run: run())
        if available is not None:
            button.setEnabled(False)
            available.connect(button.setEnabled)
    note = QtGui.QLabel()
    note.setObjectName("helpLanguage")
    note.setWordWrap(True)
    layout = QtGui.QVBoxLayout(dialog)
    layout.addWidget(note)
    layout.addWidget(browser)
    layout.addWidget(buttons)
    dialog.resize(640, 600)
    return dialog


def _label(dialog):
    """Gives it its texts in the language that FreeCAD has now."""
    dialog.setWindowTitle(translate("FemScalpel", "FemScalpel: help"))
    for name, text in (
        ("helpBack", translate("FemScalpel", "Back")),
        ("helpContents", translate("FemScalpel", "All commands")),
    ):
        dialog.findChild(QtGui.QPushButton, name).setText(text)


class _WhatsThis(EventFilter):
    """Event filter of FreeCAD's main window, which is told what was clicked at in What's This mode. FreeCAD itself
    looks for a page of the text's name in its wiki, by an add-on that is most often not there."""

    def filtered(self, receiver, event):
        if event.type() != QtCore.QEvent.WhatsThisClicked:
            return False
        page = page_of(event.href())
        if page is None:
            return False
        show(page)
        return True


_filters = []  # kept, as Qt holds no reference


def watch_whats_this():
    """From now on What's This leads to the pages of our commands and panels."""
    if not _filters:
        _filters.append(_WhatsThis())
        FreeCADGui.getMainWindow().installEventFilter(_filters[-1])
