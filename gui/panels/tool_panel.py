# SPDX-License-Identifier: LGPL-2.1-or-later
"""The task panel of an operator: geometry, options, live preview. One subclass per operator says what is special."""

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

import femscalpel
from femscalpelobjects import following
from femscalpelobjects.geometry import geometry_of
from femscalpelobjects.picked_geometry import axes_of

from ..refinement_guard import Guard, TooMuch
from ..translate import form, icon, translate
from ..view import preview_scene
from ..view.preview_data import group_in_preview, preview_of
from ..viewproviders.made_crack import drawn_in
from . import fields, group_table
from .expressions import Expressions, NewExpressions
from .foresight import WithForesight
from .histogram import Histogram
from .legend import Legend, entries_of
from .placements import as_text
from .report_dialog import show_report
from .refinement_question import RefinementQuestion, refining_text
from .summary import PiecesText, sentence, summary
from .view_panel import ViewPanel
from .with_ok import WithOk
from .with_options import OPTION_ERRORS, WithOptions


#: Property of the label that says what the preview is, see ToolPanel._say_settled().
SETTLED = "femscalpelSettled"


class ToolPanel(WithOptions, WithOk, WithForesight, ViewPanel):
    """Asks for one operation on the mesh of `source_object`, or edits the object `edited`.

    Nothing is put into the document before OK; OK does everything in one transaction, by Gui.doCommand.
    """

    LARGE = (*ViewPanel.LARGE, "shown", "_foreseen", "_outcome")
    #: Set by subclasses.
    TITLE = ICON = GROUP_NAME = OBJECT_NAME = MAKE = ""
    #: Whether the operator's surface has two sides, one of which can be cut away to look at it.
    TWO_SIDES = True
    #: Whether operation() gives the whole mesh always.
    WHOLE = False

    _refining = QtCore.Signal(object, int)  # a Cost and of which update() it is, from the other thread

    def __init__(self, source_object, edited=None):
        super().__init__(source_object, edited)
        self._pieces = PiecesText(source_object)
        self.shown = None  # PreviewData of the newest request, None while it is not there or was an error
        self._ticket, self._settled = 0, 0
        self._ok = True  # whether the button is enabled
        self._first = edited is None  # whether nothing was entered yet
        self._agreed = 0, None  # elements that the user has agreed to, and the inputs that was for
        self._inputs, self._updates = None, 0  # of the newest update(), and how many there were
        self._cost = None  # of what is being refined
        self._summary = ""
        self._refining.connect(self._say_refining, QtCore.Qt.QueuedConnection)

        self.geometry = self.make_geometry()
        self.options = FreeCADGui.PySideUic.loadUi(form("options.ui"))
        self.result = FreeCADGui.PySideUic.loadUi(form("result.ui"))
        self.form = [self.geometry.window, self.options, self.result]
        self._set_up_options()
        self._set_up_result()
        self._question = RefinementQuestion(self.form[0], self._refine_to, self._agree)
        self.add_inputs()
        if edited is not None:
            self._read_edited()
        self.expressions = Expressions(edited, self.form) if edited else NewExpressions(source_object, self.form)
        self.form[0].setWindowTitle(translate("FemScalpel", self.TITLE))
        for box, name in zip(self.form, (self.ICON, "FemScalpel", "FemScalpel_MeshQuality")):
            box.setWindowIcon(QtGui.QIcon(icon(name)))

        # The handles first: the label of the worst element is drawn over them.
        self.geometry.add_handles(self.view)
        self.scene = preview_scene.PreviewScene(self.view)
        self.scene.look = self.result.look.currentData()
        self.geometry.changed.connect(self.update)
        self.geometry.picking_changed.connect(self._picking)
        self._say_reading()
        self.start()
        self._hide_parts(True)

    def _read_edited(self):
        self.read(self.edited)
        if self.geometry.followed is not None:
            self.geometry.followed.read(self.edited)
            if following.is_expressed(self.edited):
                self.geometry.read_expressed(self.edited)
                self.enter_turn(self.edited.Turn.Value)

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

    def placement(self):
        """The tool as the document object holds it."""
        return self.geometry.placement()

    def size_is_of(self, axes):
        """Whether the radius is that of picked geometry, of which there are the Axes."""
        radius = self.geometry.radius()
        return axes.radius is not None and abs(axes.radius - radius) <= 1e-9 * max(1.0, radius)

    def following_text(self, text):
        """A line that has the object `text` follow the geometry that was picked, "" where there is none."""
        targets = self.geometry.targets() if self.geometry.followed is not None else []
        if not targets:
            return ""
        offset = axes_of(targets).placement.inverse().multiply(self.placement())
        parts = ", ".join(f"({self._text_of(part)}, {name!r})" for part, name in targets)
        return f"ObjectsFemScalpel.followGeometry({text}, [{parts}], {as_text(offset)})"

    def turn(self):
        """By how many degrees the tool is turned about its direction."""
        return 0.0

    def enter_turn(self, degrees):
        """Enters that."""

    def expressed_lines(self, text, paths):
        """Lines that give the object `text` what says its placement if expressions for some of these paths do."""
        if not {path.split(".")[0] for path in paths} & set(following.EXPRESSED):
            return []
        return [f"{text}.{name} = {value}" for name, value in self.geometry.expressed(self.turn()).items()]

    def placement_text(self):
        """The placement as exact Python text."""
        return as_text(self.placement())

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
        self.legend = Legend()
        r.rows.insertWidget(1, self.legend)
        self._table_tools = group_table.set_up(r.groups)
        r.report.clicked.connect(self._show_report)
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
        self.scene.hide_all()
        self._no_result(str(error))
        self._say_settled()

    def reading_again(self):
        self._end_foresight()
        self.geometry.stop_picking()
        self.worker.cancel()
        self.shown, self._ticket, self._settled = None, 0, 0
        self._say_reading()
        self.geometry.list_groups(self.source_object)
        self._preserve.list_groups(self._group_names())

    def _say_reading(self):
        self.result.status.setProperty(SETTLED, False)
        self._status(translate("FemScalpel", "Reading the mesh…"))

    def document_changed(self, stepped):
        self.expressions.document_changed()
        picking = self.geometry.is_picking()
        if picking:
            self._meshes.pickable(self.pickable())
        self._hide_parts(not picking)
        was_broken = self.geometry.followed is not None and self.geometry.followed.look_again()
        if stepped:
            self._read_edited()
        if stepped or was_broken:
            self.update()

    def update(self):
        """Asks for a new preview of what is entered now."""
        if self._closed or self.source is None:
            return
        self._steady.hold()
        self._end_foresight()
        if self.geometry.followed is not None:
            targets = self.geometry.targets()
            self.geometry.followed.say_size(bool(targets) and self.size_is_of(axes_of(targets)))
        problem = self.geometry.error()
        self.geometry.show_error(problem)
        self._updates += 1
        idle = "" if problem else self.idle()
        if problem or idle:
            self._ask_nothing()
            if idle:
                self._clear_errors()
            self._no_result(idle or translate("FemScalpel", "No preview."))
            return
        self._given_up, self._cost = False, None
        try:
            tool = self.tool()
            operate, source = self.operation(tool, self.entered()), self.source
            self._inputs = self.arguments()
        except (femscalpel.Error, ValueError, TypeError) as error:
            self._ask_nothing()
            self._place_error(error)
            return
        surface, region, whole = self.surface(tool), self.removed_region(tool), self.WHOLE
        self._question.wait()
        guard = self._guard()
        # What was agreed to takes long: any change ends it at once.
        self._ticket = self.worker.request(
            lambda: preview_of(source, operate, surface, region, whole, guard), gives_way=self._agreed[0] > 0
        )
        self._set_ok(True)
        ticket = self._ticket
        self._say_settled()
        if self.shown is None:
            self._clear_errors()
            self._say_computing(ticket)
        else:
            QtCore.QTimer.singleShot(400, lambda: self._say_computing(ticket))

    def _ask_nothing(self):
        """There is nothing to be computed of what is entered now; what was asked for before ends."""
        self._ticket = self._settled = 0
        if self._making is None:
            self.worker.cancel()
        self._say_settled()

    def _guard(self):
        """The Guard of what is entered now. What was agreed to holds for that alone: anything else is asked anew."""
        if self._agreed[1] != self._inputs:
            self._agreed = 0, None
        number = self._updates
        return Guard(self.source.order, lambda cost: self._refining.emit(cost, number), self._agreed[0])

    def _say_settled(self):
        """Notes at what is said whether it is about what is entered now, for what drives the window from outside."""
        self.result.status.setProperty(SETTLED, not self._is_waiting())

    def _is_waiting(self):
        return not self._closed and self._settled < self._ticket

    def _say_computing(self, ticket):
        if self._is_waiting() and ticket == self._ticket:
            self._status(self._awaited())

    def _awaited(self):
        """What is waited for."""
        return refining_text(self._cost) if self._cost else translate("FemScalpel", "Computing the new mesh…")

    def _say_refining(self, cost, number):
        """Says what a refinement comes to that is about to be made; not of one that was given up."""
        if number != self._updates:
            return
        self._cost = cost
        if self._is_waiting():
            self._status(refining_text(cost))

    def _agree(self, elements):
        """Has a preview made of what is entered although it takes so many elements."""
        self._agreed = elements, self._inputs
        self.update()

    def finished(self, ticket, value):
        if self._heard(ticket, value) or ticket < self._settled or not self._ticket:
            return
        self._settled = ticket
        self._say_settled()
        self._first = False
        self._steady.hold()
        self._clear_errors()
        self._set_ok(True)
        self.shown = value
        self.scene.show(value)
        report = value.result.report
        self.histogram.show_counts(report.quality.after.histogram, report.quality.before.histogram)
        group_table.fill(self.result.groups, report.groups, self._table_tools)
        self.result.report.setEnabled(True)
        self._show_legend()
        self._light_up()
        self._summary = summary(report) + self._pieces(value.parting)
        self._status(self._summary)
        self._foresee_soon()
        fields.show_first_digits(self.form)
        self._fit_buttons()

    def failed(self, ticket, error):
        if self._heard(ticket, None, error) or ticket < self._settled or not self._ticket:
            return
        self._settled = ticket
        self._say_settled()
        self._steady.hold()
        if isinstance(error, femscalpel.ToolError) and self._first and ticket == self._ticket:
            self._first = False
            if self.geometry.move_into(self.source):  # it tells
                return
        self._first = False
        if isinstance(error, TooMuch):
            self._clear_errors()
            self._no_result(translate("FemScalpel", "No preview yet: see the question above."))
            self._steady.show(self._question.ask(error))
            return
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
        self._show_legend()
        self.result.report.setEnabled(False)
        self.result.groups.setRowCount(0)
        self._status(status)

    def idle(self):
        """What is said where nothing is asked for yet, "" where something is."""
        return ""

    def beside(self):
        """A Surface that is shown as a ghost while there is no result, None for none."""
        return None

    def own_errors(self):
        """Labels for messages about the panel's own fields, by the operator's parameter."""
        return {}

    def _clear_errors(self):
        self._question.hide()
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
        if not any(label.isVisibleTo(self._top_of(label)) for label in self._error_labels() if label.text()):
            fields.show_error(self.result.resultError, text)  # its field is not one of this panel's
        self._no_result(translate("FemScalpel", "No preview: see the message in red."))

    def _error_labels(self):
        options = [getattr(self.options, name) for name in set(OPTION_ERRORS.values())]
        return [*options, *self.own_errors().values(), self.result.resultError, self.geometry.error_label()]

    def _top_of(self, label):
        """The form that a label is in."""
        return next(form for form in self.form if form.isAncestorOf(label))

    def _status(self, text):
        self.result.status.setText(text)
        # The panel's own may be scrolled out of sight.
        bar = FreeCADGui.getMainWindow().statusBar()
        bar.showMessage(text) if text.endswith("…") else bar.clearMessage()

    def _restyle(self):
        r = self.result
        self.scene.look, self.scene.colouring = r.look.currentData(), r.colouring.currentData()
        self.scene.show_moved, self.scene.show_worst = r.moved.isChecked(), r.worst.isChecked()
        self.scene.redraw()
        if self.shown is not None:
            self._show_legend()

    def _show_legend(self):
        entries = entries_of(self.scene, self.shown, drawn_in(self.document)) if self.shown is not None else []
        self.legend.show_entries(entries)
        self.legend_in_view.show_entries(entries)

    def _show_report(self):
        """The report of what is shown, to be read, copied and saved."""
        if self.shown is not None:
            report = self.shown.result.report
            show_report(translate("FemScalpel", self.TITLE), report.to_text(), report.to_json())

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

    def in_the_way(self):
        """Objects that are hidden while nothing is picked: the part the mesh was made from has its faces where the mesh
        has them."""
        part = geometry_of(self.source_object)
        return [part] if part is not None and part.ViewObject.Visibility else []

    def _hide_parts(self, hidden):
        self._meshes.hide_beside(self.in_the_way() if hidden else [])

    def _picking(self, on):
        if self._closed:
            return
        self._meshes.pickable(self.pickable() if on else ())
        self.geometry.show_grips(not on)
        self._hide_parts(not on)
        switch = self.scene.root
        graph = self.view.getSceneGraph()
        if on and graph.findChild(switch) >= 0:
            graph.removeChild(switch)
        elif not on and graph.findChild(switch) < 0:
            graph.addChild(switch)

    def clear_view(self):
        self._end_foresight()
        if self.expressions is not None:
            self.expressions.put_back()
        self.geometry.close()
        self.scene.close()

    def forget_widgets(self):
        self.options = (
            self.result
        ) = self.histogram = self.legend = self._table_tools = self._feature_angle = self._refine_size = None
        self._preserve = None
