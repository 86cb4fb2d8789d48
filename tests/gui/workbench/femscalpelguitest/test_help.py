# SPDX-License-Identifier: LGPL-2.1-or-later
"""Help of every command and panel, by What's This and by the Help button; texts follow the language."""

import os

from femscalpelgui import help as pages
from femscalpelgui.commands import COMMANDS, IN_MENU
from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest, QTest
from .test_crack_panel import long_box

EVERY = [command for command in COMMANDS + IN_MENU if command is not None]


def help_text():
    return widget("helpText").toPlainText()


class Help(GuiTest):
    def close_help(self):
        widget("femscalpelHelp").close()
        spin(0.05)

    def heading(self, command):
        return command.MENU.replace("&", "").replace(" mesh…", "")

    def button_of(self, command):
        """The button of a command in the toolbar."""
        bars = FreeCADGui.getMainWindow().findChildren(QtGui.QToolBar, "FemScalpel")
        action = FreeCADGui.Command.get(command.NAME).getAction()[0]
        return next(box for bar in bars for box in [bar.widgetForAction(action)] if box is not None)

    def test_whats_this_of_every_button(self):
        self.add_mesh(long_box())
        spin(0.3)
        for command in filter(None, COMMANDS):
            with self.subTest(command=command.NAME):
                button = self.button_of(command)
                if not button.isVisible():  # behind the toolbar's arrow
                    self.ask_in_menu(command)
                else:
                    QtGui.QWhatsThis.enterWhatsThisMode()
                    QTest.mouseClick(button, QtCore.Qt.LeftButton)
                spin(0.05)
                self.assertTrue(is_shown("femscalpelHelp"))
                self.assertTrue(help_text().startswith(self.heading(command)), help_text()[:60])
                self.assertIsNone(QtGui.QApplication.activeModalWidget())
                self.assertFalse(QtGui.QWhatsThis.inWhatsThisMode())
                self.close_help()
        self.assertFalse(FreeCADGui.Control.activeDialog())

    def ask_in_menu(self, command):
        """What FreeCAD does with what was clicked at in the menu."""
        text = FreeCADGui.Command.get(command.NAME).getAction()[0].whatsThis()
        QtGui.QApplication.sendEvent(FreeCADGui.getMainWindow(), QtGui.QWhatsThisClickedEvent(text))

    def test_whats_this_of_every_entry(self):
        for command in EVERY:
            with self.subTest(command=command.NAME):
                self.ask_in_menu(command)
                self.assertTrue(help_text().startswith(self.heading(command)), help_text()[:60])
        screenshot("help")
        self.close_help()

    def test_pages_are_complete(self):
        for name in sorted(os.listdir(pages.PAGES)):
            with open(os.path.join(pages.PAGES, name), encoding="utf-8") as file:
                text = file.read()
            links = re.findall(r"\]\(([^)]+)\)", text)
            self.assertTrue(links, name)
            for link in links:
                self.assertTrue(os.path.exists(os.path.join(pages.PAGES, link)), (name, link))
        for command in EVERY:
            self.assertTrue(os.path.exists(pages.path_of(command.page())), command.NAME)

    def test_help_button_of_every_panel(self):
        self.add_mesh(long_box())
        for command in EVERY:
            if command.PANEL is None:
                continue
            with self.subTest(command=command.NAME):
                self.run_command(command.NAME)
                spin(0.1)
                press_button(QtGui.QDialogButtonBox.Help)
                self.assertTrue(help_text().startswith(self.heading(command)), help_text()[:60])
                self.assertTrue(FreeCADGui.Control.activeDialog())
                if command is EVERY[0]:
                    screenshot("help_of_panel")
                self.close_help()
                press_button(QtGui.QDialogButtonBox.Cancel, QtGui.QDialogButtonBox.Close)

    def test_links_and_back(self):
        pages.show("crack")
        browser = widget("helpText")
        browser.setSource(QtCore.QUrl("panel.md"))
        spin(0.05)
        self.assertTrue(help_text().startswith("What all panels share"))
        click("helpBack")
        self.assertTrue(help_text().startswith("Crack"))
        click("helpContents")
        self.assertTrue(help_text().startswith("The commands of FemScalpel"))
        self.close_help()


class Languages(GuiTest):
    def setUp(self):
        super().setUp()
        self.addCleanup(FreeCADGui.setLocale, "en")

    def test_commands_follow(self):
        german = {}
        FreeCADGui.setLocale("de")
        spin(0.2)
        for command in EVERY:
            with self.subTest(command=command.NAME):
                action = FreeCADGui.Command.get(command.NAME).getAction()[0]
                german[command.NAME] = action.text(), action.toolTip(), action.statusTip(), action.whatsThis()
                self.assertNotIn(command.TOOLTIP[:30], action.toolTip())
                self.assertNotEqual(action.statusTip(), command.TOOLTIP)
                self.assertNotEqual(action.whatsThis(), command.WHATS_THIS)
        self.assertEqual(german["FemScalpel_Crack"][0].replace("&", ""), "Riss")
        screenshot("german")
        self.add_mesh(long_box())
        pages.show("index")
        text = FreeCADGui.Command.get("FemScalpel_Drill").getAction()[0].whatsThis()
        QtGui.QApplication.sendEvent(FreeCADGui.getMainWindow(), QtGui.QWhatsThisClickedEvent(text))
        self.assertTrue(help_text().startswith("Drill"))
        widget("femscalpelHelp").close()
        FreeCADGui.setLocale("en")
        spin(0.2)
        for command in EVERY:
            action = FreeCADGui.Command.get(command.NAME).getAction()[0]
            self.assertEqual(action.statusTip(), command.TOOLTIP)
            self.assertEqual(action.text().replace("&", ""), command.MENU.replace("&", ""))

    def test_preferences_follow(self):
        """Opened in German, and while the language changes to English."""
        FreeCADGui.setLocale("de")
        spin(0.1)
        texts = {}

        def read(dialog):
            for language in ("de", "en"):
                FreeCADGui.setLocale(language)
                spin(0.1)
                texts[language] = [label.text() for label in dialog.findChildren(QtGui.QLabel)]
                screenshot("preferences_" + language)
            dialog.reject()

        with_dialog(QtGui.QDialog, read, lambda: FreeCADGui.showPreferences("FemScalpel"))
        self.assertIn("Warnen vor Elementen mit Mean ratio unter", texts["de"])
        self.assertIn("Warn of elements with a mean ratio below", texts["en"])
        self.assertNotIn("Warnen vor Elementen mit Mean ratio unter", texts["en"])
