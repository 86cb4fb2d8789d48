# SPDX-License-Identifier: LGPL-2.1-or-later
"""The task panel of an operator: geometry, options, live preview. One subclass per operator says what is special."""

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

import femscalpel
from femscalpelobjects import operator_options

from .. import preferences
from ..macro import record_import
from ..translate import form, icon, translate
from ..view import preview_scene
from ..view.preview_data import group_in_preview, preview_of
from . import fields, group_table
from .histogram import Histogram
from .placements import as_text
from .preserve_input import PreserveInput
from .summary import PiecesText, sentence, summary
from .view_panel import ViewPanel, abort_transaction

#: Labels for messages about an option, by the operators' parameter; what is about others is shown at the geometry.
OPTION_ERRORS = {
    "name": "nameError",
    "method": "methodError",
    "transition": "methodError",
    "feature_angle": "methodError",
    "refine": "refineError",
    "preserve": "preserveError",
}
#: Rows of the options in their form.
OPTION_ROWS = {"group_name": 0, "method": 2, "transition": 4, "feature_angle": 5, "refine": 6, "preserve": 9}


class ToolPanel(ViewPanel):
    """Asks for one operation on the mesh of `source_object`, or edits the object `edited`.

    Nothing is put into the document before OK; OK does everything in one transaction, by Gui.doCommand.
    """

    #: Set by subclasses.
    TITLE = ICON = GROUP_NAME = OBJECT_NAME = MAKE = ""
    #: The options that the operator has, as the functions of ObjectsFemScalpel call them.
    OFFERED = tuple(OPTION_ROWS)
    #: Whether the operator's surface has two sides, one of which can be cut away to look at it.
    TWO_SIDES = True
    #: Whether operation() gives the whole mesh always.
    WHOLE = False

    def __init__(self, source_object, edited=None):
        super().__init__(source_object)
        self.edited, self._pieces = edited, PiecesText(source_object)
        self.shown = None  # PreviewData of the newest request, None while it is not there or was an error
        self._ticket, self._settled = 0, 0
        self._ok = True  # whether the button is enabled

        self.geometry = self.make_geometry()
        self.options = FreeCADGui.PySideUic.loadUi(form("options.ui"))
        self.result = FreeCADGui.PySideUic.loadUi(form("result.ui"))
        self.form = [self.geometry.window, self.options, self.result]
        self._set_up_options()
        self._set_up_result()
        self.add_inputs()
        if edited is not None:
            self.read(edited)
        self.form[0].setWindowTitle(translate("FemScalpel", self.TITLE))
        for box, name in zip(self.form, (self.ICON, "FemScalpel", "FemScalpel_MeshQuality")):
            box.setWindowIcon(QtGui.QIcon(icon(name)))

        # The handles first: the label of the worst element is drawn over them.
        self.geometry.add_handles(self.view)
        self.scene = preview_scene.PreviewScene(self.view)
        self.scene.look = self.result.look.currentData()
        self.geometry.changed.connect(self.update)
        self.geometry.picking_changed.connect(self._picking)
        self._status(translate("FemScalpel", "Reading the mesh…"))
        self.start()

    # What subclasses say.

    def make_geometry(self):
        """The GeometryInput."""
        raise NotImplementedError

    def add_inputs(self):
        """Adds further inputs to the options; each must call update() when it changes."""

    def insert_form(self, name):
        """Puts a Qt Designer form above the options, and returns it."""
        inserted = FreeCADGui.PySideUic.loadUi(form(name))
        self.options.rows.insertWidget(0, inserted)
        return inserted

    def tool(self):
        """The femscalpel.Tool as entered."""
        raise NotImplementedError

    def surface(self, tool):
        """Something whose distance(points) is zero on what the operator makes: lips, walls. Or a function that returns
        such of a Result; called on another thread."""
        return tool

    def removed_region(self, tool):
        """Something whose distance(points) is negative where the operator removes material; None when it removes
        none."""
        return None

    def operation(self, tool, options):
        """A function of a femscalpel.Scalpel that returns the Result; called on another thread, so it must not look at
        the panel. Unless WHOLE, it takes the operator's `band_only` as its second argument."""
        raise NotImplementedError

    def read(self, obj):
        """Enters what a document object holds."""
        o = self.options
        if "group_name" in self.OFFERED:
            o.groupName.setText(obj.GroupName)
        if "method" in self.OFFERED:
            o.method.setCurrentIndex(o.method.findData(obj.Method))
        if "transition" in self.OFFERED:
            o.transition.setValue(obj.Transition)
        if "feature_angle" in self.OFFERED:
            self._feature_angle.set(obj.FeatureAngle.Value)
        if "refine" in self.OFFERED:
            o.refine.setCurrentIndex(o.refine.findData(obj.Refine))
            if obj.Refine == "Size":
                self._refine_size.set(obj.RefineSize.Value)
        if "preserve" in self.OFFERED:
            self._preserve.set(obj.PreservedGroups)

    def arguments(self):
        """Arguments of the function ObjectsFemScalpel.MAKE, as Python text by name, without document and source."""
        given = self._given().items()
        return {name: repr(value) for name, value in given if value is not None or name not in ("refine", "preserve")}

    def settings(self):
        """Properties of the document object as Python text by name."""
        return {name: repr(value) for name, value in operator_options.to_properties(self._given()).items()}

    def _given(self):
        """What the options say, as ObjectsFemScalpel's functions take it."""
        options = self.entered()
        given = {
            "method": options["method"],
            "transition": options["transition"] or 0,
            "group_name": options["name"],
            "feature_angle": options["feature_angle"],
            "refine": options["refine"],
            "preserve": options["preserve"],
        }
        return {name: value for name, value in given.items() if name in self.OFFERED}

    def placement(self):
        """The tool as the document object holds it."""
        return self.geometry.placement()

    def placement_text(self):
        """The placement as exact Python text."""
        return as_text(self.placement())

    # Set-up.

    def _set_up_options(self):
        o = self.options
        for name in preferences.METHODS:
            o.method.addItem(
                {
                    "snap": translate("FemScalpel", "snap: move and split"),
                    "deform": translate("FemScalpel", "deform: only move nodes"),
                }[name],
                name,
            )
        o.method.setCurrentIndex(o.method.findData(preferences.method()))
        o.transition.setValue(preferences.transition())
        self._feature_angle = fields.Number(o.featureAngle, self.update, 30)
        for text, data in (
            (translate("FemScalpel", "where the tool is finer"), "Automatic"),
            (translate("FemScalpel", "never"), "Never"),
            (translate("FemScalpel", "to an edge length"), "Size"),
        ):
            o.refine.addItem(text, data)
        self._refine_size = fields.Number(o.refineSize, self.update, self.geometry.size / 50)
        o.refine.currentIndexChanged.connect(lambda *_: self._choose_refinement())
        self._choose_refinement()
        self._preserve = PreserveInput(o, self._group_names(), self.update)
        o.groupName.setText(self._free_name())
        o.groupName.textChanged.connect(lambda *_: self.update())
        o.method.currentIndexChanged.connect(lambda *_: self.update())
        o.transition.valueChanged.connect(lambda *_: self.update())
        for row in (row for name, row in OPTION_ROWS.items() if name not in self.OFFERED):
            for column in (0, 1):
                o.grid.itemAtPosition(row, column).widget().hide()
        analysis = self._analysis()
        o.intoAnalysis.setVisible(analysis is not None and self.edited is None)
        o.intoAnalysis.setChecked(analysis is not None and self.edited is None and preferences.put_into_analysis())

    def _choose_refinement(self):
        for box in (self.options.refineSizeLabel, self.options.refineSize):
            box.setVisible(self.options.refine.currentData() == "Size")
        self.update()

    def _group_names(self):
        """Names of the groups of the source, each once."""
        femmesh = self.source_object.FemMesh
        return list(dict.fromkeys(femmesh.getGroupName(g) for g in femmesh.Groups))

    def _free_name(self):
        taken = self._group_names()
        name, number = self.GROUP_NAME, 2
        while any(t.startswith(name + "_") for t in taken):
            name, number = f"{self.GROUP_NAME}{number}", number + 1
        return name

    def _analysis(self):
        """The analysis putIntoAnalysis() would use."""
        mesh = self.source_object
        while mesh is not None:
            for analysis in self.document.findObjects("Fem::FemAnalysis"):
                if mesh in analysis.Group:
                    return analysis
            mesh = getattr(mesh, "Source", None)
        return None

    def _set_up_result(self):
        r = self.result
        looks = (
            translate("FemScalpel", "Cut away"),
            translate("FemScalpel", "Whole part"),
            translate("FemScalpel", "Changed part"),
        )
        for text, data in list(zip(looks, preview_scene.LOOKS))[0 if self.TWO_SIDES else 1 :]:
            r.look.addItem(text, data)
        colourings = (translate("FemScalpel", "By quality"), translate("FemScalpel", "By group"))
        for text, data in zip(colourings, preview_scene.COLOURINGS):
            r.colouring.addItem(text, data)
        self.histogram = Histogram()
        r.histogramLayout.addWidget(self.histogram)
        group_table.set_up(r.groups)
        for box in (r.look, r.colouring):
            box.currentIndexChanged.connect(lambda *_: self._restyle())
        for box in (r.moved, r.worst):
            box.toggled.connect(lambda *_: self._restyle())
        r.groups.itemSelectionChanged.connect(self._light_up)

    # Preview.

    def loaded(self):
        self.geometry.source = self.source
        if self.options.refine.currentData() != "Size":
            self._refine_size.set(self.source.edge_length() / 2)
        self.scene.show_whole(self.source.whole())
        self.update()

    def not_loaded(self, error):
        self._no_result(str(error))

    def entered(self):
        """What the options say: name, method, transition (None: automatic), feature_angle, refine (None: automatic),
        preserve (None: all groups)."""
        o = self.options
        refine = {"Automatic": None, "Never": False, "Size": self._refine_size.value}[o.refine.currentData()]
        return {
            "name": o.groupName.text(),
            "method": o.method.currentData(),
            "transition": o.transition.value() or None,
            "feature_angle": self._feature_angle.value,
            "refine": refine,
            "preserve": self._preserve.value(),
        }

    def update(self):
        """Asks for a new preview of what is entered now."""
        if self._closed or self.source is None:
            return
        problem = self.geometry.error()
        self.geometry.show_error(problem)
        if problem:
            self._ticket = self._settled = 0
            self._no_result(translate("FemScalpel", "No preview."))
            return
        try:
            tool = self.tool()
            operate, source = self.operation(tool, self.entered()), self.source
        except (femscalpel.Error, ValueError, TypeError) as error:
            self._ticket = self._settled = 0
            self._place_error(error)
            return
        surface, region, whole = self.surface(tool), self.removed_region(tool), self.WHOLE
        self._ticket = self.worker.request(lambda: preview_of(source, operate, surface, region, whole))
        self._set_ok(True)
        if self.shown is None:
            self._clear_errors()
        ticket = self._ticket
        QtCore.QTimer.singleShot(0 if self.shown is None else 400, lambda: self._say_computing(ticket))

    def _say_computing(self, ticket):
        if not self._closed and self._settled < ticket == self._ticket:
            self._status(translate("FemScalpel", "Computing…"))

    def finished(self, ticket, value):
        if ticket < self._settled or not self._ticket:
            return
        self._settled = ticket
        self._clear_errors()
        self._set_ok(True)
        self.shown = value
        self.scene.show(value)
        report = value.result.report
        self.histogram.show_counts(report.quality.after.histogram, report.quality.before.histogram)
        group_table.fill(self.result.groups, report.groups)
        self._light_up()
        self._status(summary(report) + self._pieces(value.parting))

    def failed(self, ticket, error):
        if ticket < self._settled or not self._ticket:
            return
        self._settled = ticket
        self._place_error(error)
        self._set_ok(ticket < self._ticket)  # what is entered now may be right
        if not isinstance(error, (femscalpel.Error, ValueError, TypeError)):
            FreeCAD.Console.PrintError(f"FemScalpel: {type(error).__name__}: {error}\n")

    def _no_result(self, status):
        self.shown = None
        self._set_ok(False)
        if self.source is not None:
            self.scene.show_whole(self.source.whole(), self.beside())
        self.scene.highlight(None)
        self.histogram.clear()
        self.result.groups.setRowCount(0)
        self._status(status)

    def beside(self):
        """A Surface that is shown as a ghost while there is no result, None for none."""
        return None

    def own_errors(self):
        """Labels for messages about the panel's own fields, by the operator's parameter."""
        return {}

    def _clear_errors(self):
        self.geometry.show_error("")
        for label in set(OPTION_ERRORS.values()):
            fields.show_error(getattr(self.options, label), "")
        for label in (*self.own_errors().values(), self.result.resultError):
            fields.show_error(label, "")

    def _place_error(self, error):
        """Shows an error at the field that caused it."""
        self._clear_errors()
        text, parameter = sentence(str(error)), getattr(error, "parameter", None)
        label = OPTION_ERRORS.get(parameter)
        if label is None and isinstance(error, femscalpel.QualityError) and "method" in self.OFFERED:
            label = "methodError"
        if parameter in self.own_errors():
            fields.show_error(self.own_errors()[parameter], text)
        elif label is not None:
            fields.show_error(getattr(self.options, label), text)
        elif isinstance(error, (femscalpel.ToolError, femscalpel.UnsupportedElementError, femscalpel.QualityError)):
            self.geometry.show_error(text)
        else:
            fields.show_error(self.result.resultError, text)
        self._no_result(translate("FemScalpel", "No preview: see the message in red."))

    def _status(self, text):
        self.result.status.setText(text)

    def _restyle(self):
        r = self.result
        self.scene.look, self.scene.colouring = r.look.currentData(), r.colouring.currentData()
        self.scene.show_moved, self.scene.show_worst = r.moved.isChecked(), r.worst.isChecked()
        self.scene.redraw()

    def _light_up(self):
        chosen = group_table.selected(self.result.groups)
        if chosen is None or self.shown is None:
            self.scene.highlight(None)
            return
        self.scene.highlight(group_in_preview(self.source, self.shown, *chosen))

    # Picking.

    def pickable(self):
        """The mesh objects that are shown while something is picked."""
        return (self.source_object,)

    def _picking(self, on):
        if self._closed:
            return
        self._meshes.pickable(self.pickable() if on else ())
        switch = self.scene.root
        graph = self.view.getSceneGraph()
        if on and graph.findChild(switch) >= 0:
            graph.removeChild(switch)
        elif not on and graph.findChild(switch) < 0:
            graph.addChild(switch)

    # OK and Cancel.

    def getStandardButtons(self):
        return int(QtGui.QDialogButtonBox.Ok | QtGui.QDialogButtonBox.Cancel)

    def _set_ok(self, enabled):
        if enabled != self._ok:
            self._ok = enabled
            # Looked for each time: Python must not keep what FreeCAD deletes.
            for box in FreeCADGui.getMainWindow().findChildren(QtGui.QDialogButtonBox):
                if box.isVisible() and box.button(QtGui.QDialogButtonBox.Ok):
                    box.button(QtGui.QDialogButtonBox.Ok).setEnabled(enabled)

    def accept(self):
        """OK: makes or changes the document object; stays open with a message when that is not possible."""
        self.geometry.stop_picking()
        self._wait()
        if self.shown is None:
            return False
        self.document.openTransaction(translate("FemScalpel", self.TITLE))
        try:
            obj = self._change_object() if self.edited is not None else self._make_object()
            if "Invalid" in obj.State or obj.FemMesh.NodeCount == 0:
                raise femscalpel.Error(
                    translate("FemScalpel", "The object could not be computed; see the report view.")
                )
        except Exception as error:
            abort_transaction(self.document)
            fields.show_error(self.result.resultError, sentence(str(error)))
            return False
        self.document.commitTransaction()
        self.leave()
        if self.edited is None:
            FreeCADGui.Selection.clearSelection()
            FreeCADGui.Selection.addSelection(self.document.Name, obj.Name)
        return True

    def reject(self):
        """Cancel: leaves everything as it was. While something is being picked, only ends that."""
        if self.geometry.is_picking():
            self.geometry.stop_picking()
            return False
        return super().reject()

    def _wait(self):
        """Lets the newest preview arrive; the window stays alive meanwhile."""
        while self.source is None and self._reading is not None or (self._ticket and self._settled < self._ticket):
            FreeCADGui.updateGui()
            QtCore.QThread.msleep(5)

    def _text_of(self, obj):
        document = (
            "FreeCAD.ActiveDocument"
            if FreeCAD.ActiveDocument == self.document
            else f"FreeCAD.getDocument({self.document.Name!r})"
        )
        return document if obj is None else f"{document}.getObject({obj.Name!r})"

    def _make_object(self):
        document = self._text_of(None)
        arguments = [document, self._text_of(self.source_object), f"name={self.OBJECT_NAME!r}"]
        arguments += [f"{name}={text}" for name, text in self.arguments().items()]
        record_import()
        before = set(self.document.Objects)
        FreeCADGui.doCommand(f"ObjectsFemScalpel.{self.MAKE}({', '.join(arguments)})")
        obj = next(o for o in self.document.Objects if o not in before)
        FreeCADGui.doCommand(f"{document}.recompute()")
        if "Invalid" not in obj.State and self.options.intoAnalysis.isChecked():
            FreeCADGui.doCommand(f"ObjectsFemScalpel.putIntoAnalysis({self._text_of(obj)})")
        self.hide_object(self.source_object)
        return obj

    def hide_object(self, obj):
        """Hides an object of the document, by a recorded line."""
        FreeCADGui.doCommandGui(
            f"FreeCADGui.getDocument({self.document.Name!r}).getObject({obj.Name!r}).Visibility = False"
        )

    def _change_object(self):
        record_import()
        text = self._text_of(self.edited)
        for name, value in self.settings().items():
            FreeCADGui.doCommand(f"{text}.{name} = {value}")
        FreeCADGui.doCommand(f"{self._text_of(None)}.recompute()")
        return self.edited

    def leave(self):
        if self._closed:
            return
        self.close()
        if self.edited is not None:
            FreeCADGui.getDocument(self.document.Name).resetEdit()
        FreeCADGui.Control.closeDialog()

    def clear_view(self):
        self.geometry.close()
        self.scene.close()

    def forget_widgets(self):
        self.options = self.result = self.histogram = self._feature_angle = self._refine_size = None
        self._preserve = None
