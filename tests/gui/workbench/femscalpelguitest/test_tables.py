# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables are sorted, filtered, copied and saved; reports are saved; the legend says what colours mean."""

import csv
import json
import os
import tempfile
import types
from unittest import mock

import numpy as np

import femmesh_bridge
import ObjectsFemScalpel
from femscalpelgui.panels import group_table
from femscalpelgui.panels import legend as legends
from femscalpelgui.panels.table_tools import TableTools
from femscalpelgui.viewproviders import made_crack
from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest, QTest
from .test_crack_panel import CrackTest, long_box


def shown_names(name="groups"):
    """First cells of the rows of a table that are shown, from top to bottom."""
    return column(0, name)


def column(number, name="groups"):
    table = widget(name)
    rows = map(table.verticalHeader().logicalIndex, range(table.rowCount()))
    return [table.item(row, number).text() for row in rows if not table.isRowHidden(row)]


def click_header(number, name="groups"):
    """Clicks a header of a table."""
    header = widget(name).horizontalHeader()
    place = QtCore.QPoint(
        header.sectionViewportPosition(number) + header.sectionSize(number) // 2, header.height() // 2
    )
    QTest.mouseClick(header.viewport(), QtCore.Qt.LeftButton, QtCore.Qt.NoModifier, place)
    spin(0)


def type_filter(text):
    field = widget("filter")
    field.setFocus()
    field.selectAll()
    QTest.keyClick(field, QtCore.Qt.Key_Delete)
    QTest.keyClicks(field, text)
    spin(0)


def answering(path, chosen=""):
    """In place of the file dialog that asks where to save."""
    return mock.patch.object(QtGui.QFileDialog, "getSaveFileName", staticmethod(lambda *args: (path, chosen)))


def clipboard():
    return QtGui.QApplication.clipboard().text()


class Folder:
    def setUp(self):
        super().setUp()
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)


class GroupTable(Folder, CrackTest):
    def open_panel(self):
        super().open_panel()
        choose("patch", "HalfPlane")
        wait_until(lambda: is_settled() and "front of" in widget("status").text(), "a crack with a front")

    def test_sorted_and_filtered(self):
        self.open_panel()
        first = shown_names()
        click_header(0)
        self.assertEqual(shown_names(), sorted(first, key=str.lower))
        screenshot("table_sorted")
        click_header(0)
        self.assertEqual(shown_names(), sorted(first, key=str.lower, reverse=True))
        click_header(3)
        counts = [int(text) for text in column(3)]
        self.assertEqual(counts, sorted(counts))
        self.assertGreater(len(set(map(len, map(str, counts)))), 1)  # as texts they would be in another order
        type_filter("crack")
        self.assertEqual(sorted(shown_names()), ["CRACK_FRONT", "CRACK_N", "CRACK_P"])
        before = widget("status").text()
        type_into("offset", "0.3")
        wait_until(lambda: is_settled() and widget("status").text() != before, "the new preview")
        self.assertEqual(sorted(shown_names()), ["CRACK_FRONT", "CRACK_N", "CRACK_P"])
        counts = [int(text) for text in column(3)]
        self.assertEqual(counts, sorted(counts))
        click_row("groups", "CRACK_P")
        click_header(0)
        self.assertEqual(widget("groups").selectedItems()[0].text(), "CRACK_P")
        screenshot("table_filtered")

    def test_columns_fit(self):
        self.open_panel()
        table, last = widget("groups"), widget("groups").columnCount() - 1
        widths = []
        for width in (330, 640):
            if not resize_panel(width):
                self.skipTest("the task panel lies over the 3-D view, not in a dock of its own width")
            spin(0.1)
            shown = [number for number in range(last + 1) if not table.isColumnHidden(number)]
            for number in shown[1:]:
                self.assertGreaterEqual(table.columnWidth(number), table.sizeHintForColumn(number))
            self.assertLessEqual(
                table.columnViewportPosition(last) + table.sizeHintForColumn(last), table.viewport().width()
            )
            self.assertGreaterEqual(table.columnWidth(0), min(table.sizeHintForColumn(0), 80))
            widths.append(len(shown))
            screenshot(f"table_at_{width}")
        self.assertLess(widths[0], widths[1])
        self.assertEqual(widths[1], last + 1)
        self.assertIn("faces", table.item(0, 0).toolTip())

    def test_copied_and_saved(self):
        self.open_panel()
        click("copyTable")
        lines = [line.split("\t") for line in clipboard().splitlines()]
        self.assertEqual(lines[0][:2], ["Group", "Kind"])
        self.assertEqual([line[0] for line in lines[1:]], shown_names())
        type_filter("_P")
        QTest.keyClick(widget("groups"), QtCore.Qt.Key_C, QtCore.Qt.ControlModifier)
        self.assertEqual([line.split("\t")[0] for line in clipboard().splitlines()[1:]], ["CRACK_P"])
        type_filter("")
        with answering(self.path("groups")):
            click("saveTable")
        with open(self.path("groups.csv"), newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["Group"] for row in rows], shown_names())
        self.assertEqual([row["After"] for row in rows], column(3))
        with answering(self.path("no/such/folder.csv")):
            text = message_during(lambda: click("saveTable"))
        self.assertIn(self.path("no/such/folder.csv"), text)
        self.assertIn("No such file", text)

    def test_report_saved(self):
        self.open_panel()
        click("report")
        text = widget("reportText").toPlainText()
        self.assertRegex(text, r"made +crack of area [\d.]+; front of length [\d.]+")
        with answering(self.path("report.txt")):
            click("saveReport")
        with answering(self.path("report.json")):
            click("saveReport")
        with open(self.path("report.txt"), encoding="utf-8") as file:
            self.assertEqual(file.read(), text)
        with open(self.path("report.json"), encoding="utf-8") as file:
            data = json.load(file)
        self.assertEqual(data["operation"], "crack")
        self.assertIn("CRACK_P", [group["name"] for group in data["groups"]])
        click("copyReport")
        self.assertEqual(clipboard(), text)
        screenshot("report_of_the_panel")
        widget("femscalpelReport").close()

    def test_extents_are_told(self):
        self.open_panel()
        wait_until(lambda: "Crack of 10.00 mm², front of 5.00 mm" in widget("status").text(), "the half plane's sizes")
        press_ok()
        bar = FreeCADGui.getMainWindow().statusBar().currentMessage()
        self.assertRegex(bar, r"^Crack: Crack of 10\.00 mm², front of 5\.00 mm")
        crack = self.doc.Crack
        report = crack.Proxy.report
        self.assertEqual(crack.CrackArea.Value, {e.what: e.measure for e in report.extents}["crack"])
        self.assertEqual(crack.FrontLength.Value, {e.what: e.measure for e in report.extents}["front"])
        self.assertIn(f"front of length {crack.FrontLength.Value:.6g}", "\n".join(crack.GroupReport))

    def test_report_of_a_loaded_document(self):
        crack = ObjectsFemScalpel.makeCrack(self.doc, self.mesh, origin=(2.9, 2.5, 2), normal=(1, 0, 0))
        self.doc.recompute()
        self.doc.saveAs(self.path("saved.FCStd"))
        expected = list(crack.GroupReport)
        FreeCAD.closeDocument(self.doc.Name)
        self.doc = FreeCAD.openDocument(self.path("saved.FCStd"))
        spin(0.2)
        from femscalpelgui.panels.report_dialog import show_report_of

        show_report_of(self.doc.Crack)
        with answering(self.path("loaded.json")):
            click("saveReport")
        with open(self.path("loaded.json"), encoding="utf-8") as file:
            data = json.load(file)
        self.assertEqual(data["nodes_added"], self.doc.Crack.NodesAdded)
        self.assertEqual(len(data["pieces"]), 2)
        self.assertEqual(widget("reportText").toPlainText().splitlines(), expected)
        widget("femscalpelReport").close()

    def assertLegendSeen(self, entries):
        """That the colours of the first patches are in the lower left corner of the view, one under the other."""
        picture = canvas_picture()[-200:, :60].astype(int)
        rows = []
        for rgb, _ in entries:
            wanted = (np.atleast_2d(rgb)[0] * 255).round()
            found = np.argwhere((abs(picture - wanted) <= 3).all(axis=2))
            self.assertGreater(len(found), 20, f"{wanted} is not seen")
            rows.append(found[:, 0].mean())
        self.assertEqual(rows, sorted(rows))

    def test_legend(self):
        self.open_panel()
        legend = widget("legend")
        texts = [text for _, text in legend.entries]
        self.assertTrue(any("mean ratio" in text for text in texts))
        self.assertTrue(any(text.startswith("front") for text in texts))
        type_into("offset", "0.3")
        wait_until(lambda: any("moved nodes" in text for _, text in legend.entries), "moved nodes")
        self.assertLegendSeen(legend.entries)
        screenshot("legend_quality")
        window, size = FreeCADGui.getMainWindow(), FreeCADGui.getMainWindow().size()
        self.addCleanup(window.resize, size)
        window.resize(size.width() - 200, size.height() - 150)
        view().setCameraType("Perspective")
        spin(0.3)
        self.assertLegendSeen(legend.entries)
        view().fitAll()
        view().fitAll()
        spin(0.2)
        self.assertLegendSeen(legend.entries)
        view().setCameraType("Orthographic")
        window.resize(size)
        spin(0.2)
        click("moved")
        self.assertFalse(any("moved nodes" in text for _, text in legend.entries))
        choose("colouring", "groups")
        texts = [text for _, text in legend.entries]
        self.assertFalse(any("mean ratio" in text for text in texts))
        self.assertTrue(any("LEFT" in text for text in texts), texts)
        families = [tuple(rgb) for rgb, text in legend.entries if text.isupper() or "∩" in text]
        self.assertGreater(len(families), 4)
        self.assertEqual(len(set(families)), len(families))
        screenshot("legend_groups")
        click("moved")
        type_into("originX", "900")
        self.wait_for_message("geometryError")
        self.assertFalse(is_shown("legend"))
        press_cancel()
        self.assertIsNone(in_scene("FemScalpelLegend"))

    def test_legend_names_cracks_that_are_there(self):
        crack = ObjectsFemScalpel.makeCrack(self.doc, self.mesh, origin=(2.9, 2.5, 2), normal=(1, 0, 0))
        self.doc.recompute()
        self.mesh.ViewObject.Visibility = False
        wait_until(lambda: crack.ViewObject.Proxy.crack.is_drawn, "the crack's outline")
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(self.doc.Name, "Crack")
        self.run_command("FemScalpel_Drill")
        self.wait_for_preview()
        entries = {text: rgb for rgb, text in widget("legend").entries}
        self.assertEqual(entries["existing crack: Crack"], made_crack.colour_of(crack))
        self.assertLegendSeen(widget("legend").entries)
        screenshot("legend_of_a_crack_that_is_there")
        press_cancel()
        crack.ViewObject.Visibility = False
        self.run_command("FemScalpel_Drill")
        self.wait_for_preview()
        self.assertFalse(any(text.startswith("existing") for _, text in widget("legend").entries))

    def test_legend_of_many_groups(self):
        data = mock.Mock(families=[(f"G{k}",) for k in range(20)] + [()])
        surface = mock.Mock(family=np.repeat(np.arange(21), np.arange(21) + 1))
        data.rest, data.band = (surface,), ()
        entries = legends._families(data)
        self.assertEqual([text for _, text in entries[:2]], ["in no group", "G19"])
        self.assertIn("14 other", entries[-1][1])


class Inspector(Folder, GuiTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.add_mesh(long_box())
        self.run_command("FemScalpel_GroupInspector")
        wait_until(lambda: widget("groups").rowCount() > 0, "the list of groups")

    def checked(self):
        table = widget("groups")
        rows = range(table.rowCount())
        return sorted(table.item(r, 0).text() for r in rows if table.item(r, 0).checkState() == QtCore.Qt.Checked)

    def test_sorted_rows_keep_what_they_are(self):
        mesh = femmesh_bridge.from_femmesh(self.mesh.FemMesh)
        item = widget("groups").findItems("TOP", QtCore.Qt.MatchExactly)[0]
        item.setCheckState(QtCore.Qt.Checked)
        spin(0)
        click_header(3)
        sizes = [int(text) for text in column(3)]
        self.assertEqual(sizes, sorted(sizes))
        click_header(3)
        self.assertEqual([int(text) for text in column(3)], sorted(sizes, reverse=True))
        for row, name in enumerate(shown_names()):
            self.assertIn(column(3)[row], [str(len(g.ids)) for g in mesh.groups.all() if g.name == name])
        self.assertEqual(self.checked(), ["TOP"])
        self.assertEqual(points_drawn("FemScalpelInspector"), len(mesh.groups["TOP"]))
        screenshot("inspector_sorted")
        widget("groups").findItems("TOP", QtCore.Qt.MatchExactly)[0].setText("ROOF")
        names = lambda: [g.name for g in femmesh_bridge.from_femmesh(self.mesh.FemMesh).groups.all()]  # noqa: E731
        wait_until(lambda: sorted(names()) == ["CORE", "FIX", "LEFT", "RIGHT", "ROOF"], "the mesh's new name")
        self.assertEqual(self.checked(), ["ROOF"])

    def test_filtered(self):
        type_filter("LEF")
        self.assertEqual(shown_names(), ["LEFT"])
        click("all")
        self.assertEqual(self.checked(), ["LEFT"])
        type_filter("")
        self.assertEqual(self.checked(), ["LEFT"])
        screenshot("inspector_filtered")

    def test_saved(self):
        with answering(self.path("groups.csv")):
            click("saveTable")
        with open(self.path("groups.csv"), newline="", encoding="utf-8") as file:
            rows = {row["Group"]: row for row in csv.DictReader(file)}
        self.assertEqual(float(rows["LEFT"]["Measure"]), 100)
        self.assertEqual(rows["LEFT"]["Kind"], "volumes")


class MistakenTable(QtGui.QTableWidget):
    """As PySide 2 at times returns another object in place of an item."""

    def horizontalHeaderItem(self, column):
        return QtGui.QSpacerItem(1, 1)


class Tables(GuiTest):
    def test_fits_are_bounded_at_every_width(self):
        """Each width of a table is fitted once, whatever bars come and go; and then the window is at rest."""
        box = QtGui.QWidget()
        self.addCleanup(box.deleteLater)
        layout = QtGui.QVBoxLayout(box)
        table = QtGui.QTableWidget()
        table.setFixedHeight(170)
        layout.addWidget(table)
        tools = group_table.set_up(table)
        box.resize(560, 240)
        box.show()
        laid_out = []
        table.horizontalHeader().sectionResized.connect(lambda *_: laid_out.append(1))
        names = ("CORE", "LEFT", "RIGHT", "TOP", "FIX", "CRACK_P", "CRACK_N", "CRACK_FRONT", "HOLE_WALL")
        for rows in range(13):
            group_table.fill(table, [self.record(f"{names[k % 9]}{k // 9 or ''}", k) for k in range(rows)], tools)
            spin(0)
            for width in (*range(560, 260, -13), *range(260, 560, 29)):
                with mock.patch.object(TableTools, "fit", autospec=True, side_effect=TableTools.fit) as fit:
                    laid_out.clear()
                    box.resize(width, 240)
                    for _ in range(2):
                        spin(0)
                    self.assertLessEqual(fit.call_count, 1, f"{rows} rows, {width} pixels")
                    self.assertLessEqual(len(laid_out), 40, f"{rows} rows, {width} pixels")
                    self.assertEqual(table.horizontalScrollBar().value(), 0)
                as_resized = self.layout_of(table)
                tools.fit()
                spin(0)
                self.assertEqual(self.layout_of(table), as_resized, f"{rows} rows, {width} pixels")

    @staticmethod
    def layout_of(table):
        columns = range(table.columnCount())
        return [(table.isColumnHidden(k), table.columnWidth(k)) for k in columns], table.viewport().width()

    @staticmethod
    def record(name, number):
        measure = 100.0 + number
        return types.SimpleNamespace(
            name=name,
            kind="element",
            dimension=3,
            status="changed",
            nodes_moved=3,
            boundary_drift=0.1,
            count_before=1000 * number,
            count_after=1000 * number + 7,
            measure_before=measure,
            measure_after=measure * 1.001,
        )

    def test_a_name_is_seen_before_an_empty_column(self):
        box = QtGui.QWidget()
        self.addCleanup(box.deleteLater)
        layout = QtGui.QVBoxLayout(box)
        table = QtGui.QTableWidget(2, 4)
        table.setHorizontalHeaderLabels(["Group", "Size", "Measure", "What uses it, and what for"])
        layout.addWidget(table)
        for row, name in enumerate(("CRACK_OF_THE_FLANGE_N", "CRACK_OF_THE_FLANGE_P")):
            for column, text in enumerate((name, "44", "600 mm²", "")):
                table.setItem(row, column, QtGui.QTableWidgetItem(text))
            table.item(row, 0).setCheckState(QtCore.Qt.Unchecked)
        tools = TableTools(table, "Groups")
        box.resize(360, 240)
        box.show()
        tools.arrange()
        spin(0)
        self.assertTrue(table.isColumnHidden(3))
        self.assertGreaterEqual(table.columnWidth(0), table.sizeHintForColumn(0))
        table.item(0, 3).setText("Load")
        tools.arrange()
        self.assertFalse(table.isColumnHidden(3))
        table.item(0, 3).setText("")
        box.resize(800, 240)
        spin(0)
        self.assertFalse(table.isColumnHidden(3))

    def test_mistaken_items(self):
        box = QtGui.QWidget()
        layout = QtGui.QVBoxLayout(box)
        table = MistakenTable(1, 3)
        table.setHorizontalHeaderLabels(["Name", "", "Size"])
        layout.addWidget(table)
        for column, text in enumerate(("LEFT", "", "12")):
            table.setItem(0, column, QtGui.QTableWidgetItem(text))
        tools = TableTools(table, "Groups")
        tools.copy()
        self.assertEqual(QtGui.QApplication.clipboard().text().split("\n")[:2], ["Name\tSize", "LEFT\t12"])
