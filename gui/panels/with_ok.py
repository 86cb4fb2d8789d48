# SPDX-License-Identifier: LGPL-2.1-or-later
"""OK of the panels of operators: makes or changes the document object, with signs of life."""

import FreeCAD
import FreeCADGui
from PySide import QtGui

import femscalpel
from femscalpelobjects import contents
from femscalpelobjects.following import follows
from femscalpelobjects.ours import is_ours, made_of

from .. import qt
from ..macro import record_import
from ..progress import Progress, Steps
from ..translate import translate
from . import fields
from .summary import made_text, sentence
from .view_panel import TOLD, abort_transaction

#: Seconds that a cancelled computation may take to end.
_PATIENCE = 2.0


class WithOk:
    """The part of a ToolPanel that makes or changes the document object.

    The mesh is made on the panel's other thread. Its object takes it when it is computed, so that for the document it
    is as if the recorded lines had done it all.
    """

    _progress = None  # while OK is at work
    _making = _outcome = None  # ticket of what the other thread makes for OK, and (value, error) once it is there
    _given_up = False  # whether the user has cancelled the preview of what is entered

    def getStandardButtons(self):
        return qt.number(QtGui.QDialogButtonBox.Ok | QtGui.QDialogButtonBox.Cancel | QtGui.QDialogButtonBox.Help)

    def _set_ok(self, enabled):
        if enabled != self._ok:
            self._ok = enabled
            if self._box is not None:
                self._box.button(QtGui.QDialogButtonBox.Ok).setEnabled(enabled)

    def modifyStandardButtons(self, box):
        """As of ViewPanel; there may be an error already."""
        super().modifyStandardButtons(box)
        box.button(QtGui.QDialogButtonBox.Ok).setEnabled(self._ok)

    def _take_input(self, on):
        """Whether fields and buttons take input. FreeCAD would crash of another click on one of its buttons before it
        is done with the first."""
        for widget in [*(self.form or ()), self._box]:
            if widget is not None:
                widget.setEnabled(on)

    def accept(self):
        """OK: makes or changes the document object; stays open with a message when that is not possible."""
        if self._progress is not None or self._closed:
            return False
        self._watch.hurry()
        if self._closed:
            return False
        self.geometry.stop_picking()
        self._progress = Progress(translate("FemScalpel", self.TITLE), self._status)
        self._take_input(False)
        try:
            obj = self._do(self._progress)
        finally:
            self._progress.close()
            self._progress = None
            self._take_input(True)
        if obj is None:
            return False
        if self.edited is not None:
            self.expressions = None  # they stay
        self.leave()
        self._tell_extents(obj)
        if self.edited is None:
            FreeCADGui.Selection.clearSelection()
            FreeCADGui.Selection.addSelection(self.document.Name, obj.Name)
        return True

    @staticmethod
    def _tell_extents(obj):
        """Says how large what was made is, now that the panel is gone."""
        texts = [made_text(obj.Proxy.report)] if obj.Proxy.report is not None else []
        if obj.HoleRadius.Value:
            texts.append(translate("FemScalpel", "Radius of the hole: %1.").replace("%1", obj.HoleRadius.UserString))
        if any(texts):
            text = f"{obj.Label}: {' '.join(filter(None, texts))}"
            FreeCAD.Console.PrintMessage(text + "\n")
            FreeCADGui.getMainWindow().statusBar().showMessage(text, TOLD)

    def _do(self, progress):
        """The object made or changed, None where the panel is to stay."""
        if self._given_up:
            self.update()
        say = lambda: progress.say(self._waits_for())  # noqa: E731
        say()
        if not progress.wait_for(self._is_settled, say) or self._closed:
            self._give_up()
            return None
        if self.shown is None:
            return None
        self._status(self._summary)
        lines = self._changing() if self.edited is not None else ()
        self.document.openTransaction(translate("FemScalpel", self.TITLE))
        try:
            obj = self._change_object(lines) if self.edited is not None else self._make_object()
            if progress.cancelled:  # while FreeCAD took the mesh over
                raise femscalpel.Cancelled("cancelled")
            if "Invalid" in obj.State or obj.FemMesh.NodeCount == 0:
                raise femscalpel.Error(
                    translate("FemScalpel", "The object could not be computed; see the report view.")
                )
        except femscalpel.Cancelled:
            abort_transaction(self.document)
            self._status(translate("FemScalpel", "Cancelled: nothing was changed."))
            return None
        except Exception as error:
            abort_transaction(self.document)
            fields.show_error(self.result.resultError, sentence(str(error)))
            self._status(self._summary)
            return None
        self.document.commitTransaction()
        return obj

    def _waits_for(self):
        """What OK waits for before it begins."""
        return translate("FemScalpel", "Reading the mesh…") if self.source is None else self._awaited()

    def _is_settled(self):
        """Whether the newest preview is there, or its error."""
        if self._closed:
            return True
        reading = self.source is None and self._reading is not None
        return not reading and not (self._ticket and self._settled < self._ticket)

    def is_busy(self):
        return self._progress is not None

    def _give_up(self):
        """Ends the preview that OK waits for."""
        if self._closed:
            return
        if self.source is None:
            self._status(translate("FemScalpel", "Reading the mesh…"))
            return
        self.worker.cancel()
        self._ticket = self._settled = 0
        self._say_settled()
        self._given_up = True
        self._status(translate("FemScalpel", "Cancelled. OK, or a change, computes again."))

    def reject(self):
        """Cancel: leaves everything as it was. While something is being picked, only ends that."""
        if self._progress is not None:
            self._progress.cancelled = True
            return False
        if self.geometry.is_picking():
            self.geometry.stop_picking()
            return False
        return super().reject()

    # The other thread's part.

    def _heard(self, ticket, value, error=None):
        """Whether this is what OK waits for."""
        if self._is_foresight(ticket, value):
            return True
        if ticket != self._making:
            return False
        self._outcome = (value, error)
        return True

    def _compute(self, obj):
        """Has the mesh of `obj` made on the other thread, for its recomputation. Raises what that does, and
        femscalpel.Cancelled."""
        progress = self._progress
        if not self._wait_for_foresight(progress) or self._closed:
            self._end_foresight()
            self._stop_computing()
        compute = obj.Proxy.begin(obj, self._foreseen)
        if compute is None:
            contents.unread(obj.Source)
            self._say_taking(progress)
            return
        steps = Steps(progress)
        self._outcome = None
        self._making = self.worker.request(lambda: compute(steps))
        done = progress.wait_for(lambda: self._outcome is not None or self._closed, steps.say)
        self._making = None
        if not done or self._closed:
            self._stop_computing()
        (made, error), self._outcome = self._outcome, None
        if error is not None:
            raise error
        obj.Proxy.adopt(made)
        self._say_taking(progress)

    def _stop_computing(self):
        self.worker.cancel()
        self.worker.wait_until_idle(_PATIENCE)
        raise femscalpel.Cancelled("cancelled")

    @staticmethod
    def _say_taking(progress):
        progress.say(translate("FemScalpel", "FreeCAD takes the mesh over…"))
        progress.paint()

    def _compute_following(self, obj):
        """As _compute() for the objects made of `obj`, each recomputed so that the next can begin. One that cannot be
        made says so when the document is recomputed."""
        for other in _made_from(obj):
            try:
                self._compute(other)
            except femscalpel.Cancelled:
                raise
            except (femscalpel.Error, ValueError, TypeError):
                return
            other.recompute()

    # The document.

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
        label = self._free_label(obj)
        if label != obj.Label:
            FreeCADGui.doCommand(f"{self._text_of(obj)}.Label = {label!r}")
        expressions, text = self.expressions.take(obj, self.form), self._text_of(obj)
        lines = [self.following_text(text), *self.expressed_lines(text, expressions)]
        lines += [f"{text}.setExpression{pair!r}" for pair in expressions.items()]
        for line in filter(None, lines):
            FreeCADGui.doCommand(line)
        self._remember_source()
        self._compute(obj)
        FreeCADGui.doCommand(f"{document}.recompute()")
        if "Invalid" not in obj.State and self.options.intoAnalysis.isChecked():
            FreeCADGui.doCommand(f"ObjectsFemScalpel.putIntoAnalysis({self._text_of(obj)})")
        self.hide_object(self.source_object)
        return obj

    def _free_label(self, obj):
        """What a new object is called in the tree: "Crack", then "Crack 2" and so on."""
        taken = {other.Label for other in self.document.Objects if other != obj}
        title = translate("FemScalpel", self.TITLE)
        label, number = title, 2
        while label in taken:
            label, number = f"{title} {number}", number + 1
        return label

    def _remember_source(self):
        """The mesh was read for the preview already."""
        contents.learn(self.source_object, self.source.mesh, self.source.digest, self._changes)

    def hide_object(self, obj):
        """Hides an object of the document, by a recorded line."""
        FreeCADGui.doCommandGui(
            f"FreeCADGui.getDocument({self.document.Name!r}).getObject({obj.Name!r}).Visibility = False"
        )

    def _changing(self):
        """Lines that change the object. What FreeCAD has set of expressions is put back, for undo."""
        text = self._text_of(self.edited)
        lines = [f"{text}.{name} = {value}" for name, value in self.settings().items()]
        lines += filter(None, [self.following_text(text)])
        lines += self.expressed_lines(text, self.expressions.now())
        lines += [f"{text}.setExpression{pair!r}" for pair in self.expressions.changes().items()]
        self.expressions.put_back()
        return lines

    def _change_object(self, lines):
        record_import()
        text = self._text_of(self.edited)
        if follows(self.edited):
            FreeCADGui.doCommand(f"ObjectsFemScalpel.followGeometry({text}, None)")
        for line in lines:
            FreeCADGui.doCommand(line)
        self._remember_source()
        self._compute(self.edited)
        self.edited.recompute()
        if "Invalid" not in self.edited.State:
            self._compute_following(self.edited)
        FreeCADGui.doCommand(f"{self._text_of(None)}.recompute()")
        return self.edited

    def leave(self):
        if self._closed:
            return
        self.close()
        if self.edited is not None:
            FreeCADGui.getDocument(self.document.Name).resetEdit()
        FreeCADGui.Control.closeDialog()


def _made_from(obj):
    """The objects of FemScalpel that are made of the mesh of `obj`, each behind those it is made of."""
    found = []

    def add(mesh):
        for other in mesh.InList:
            if is_ours(other) and mesh in made_of(other):
                if other in found:
                    found.remove(other)
                found.append(other)
                add(other)

    add(obj)
    return found
