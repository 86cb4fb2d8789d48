# SPDX-License-Identifier: LGPL-2.1-or-later
"""What all task panels share: a mesh read on another thread, the 3-D view to themselves, and leaving without a
trace."""

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui
from pivy import coin

import femmesh_bridge
import femscalpel
from femscalpelobjects import contents
from femscalpelobjects.whole import whole_of

from .. import help
from ..latest_wins import LatestWins
from ..translate import translate
from ..view.legend_in_view import LegendInView
from ..view.mesh_visibility import HiddenMeshes
from ..view.preview_data import PreviewSource
from .document_watch import DocumentWatch, is_gone
from .field_filter import FieldFilter
from .narrow import Captions
from .sections import name_fields
from .steady import Steady


#: Milliseconds for which the status bar says what has become of a panel.
TOLD = 15_000

# Forms that FreeCAD has deleted itself; Python must never do it again.
_lost = []


class ViewPanel(QtCore.QObject):
    """A task panel about the mesh of one object. Subclasses make `form` first, then call start()."""

    #: What a closed panel gives up: meshes, and what was drawn of them.
    LARGE = ("source", "scene")

    def __init__(self, source_object, edited=None):
        super().__init__()
        self.source_object, self.edited = source_object, edited
        self._labels = source_object.Label, edited.Label if edited is not None else ""
        self.document = source_object.Document
        self.view = _view(self.document)
        self.source = None  # PreviewSource, once it was read
        self.form = []
        self._closed = False
        self._reading = None
        self._watch = None
        self._box = None  # QDialogButtonBox, while the panel is shown

    def start(self):
        """Names the mesh, takes the view and starts reading the mesh; loaded() or failed() follow."""
        name = QtGui.QLabel(translate("FemScalpel", "Mesh: %1").replace("%1", self.source_object.Label))
        name.setObjectName("meshName")
        name.setTextFormat(QtCore.Qt.PlainText)
        name.setWordWrap(True)
        self.form[0].layout().insertWidget(0, name)
        for form in self.form:
            form.setWhatsThis(help.tag(self.page()))
            name_fields(form)
        self._fields, self._steady, self._captions = FieldFilter(self.form), Steady(self.form), Captions(self.form)
        self._meshes = HiddenMeshes(self.document, self.source_object)
        self.legend_in_view = LegendInView(self.view)
        self._keys = self.view.addEventCallbackPivy(coin.SoKeyboardEvent.getClassTypeId(), self._key)
        self.worker = LatestWins(self._arrived, self._broke)
        # FreeCAD can take the panel away without asking, as when the document is closed.
        self._forms = list(self.form)
        self._forms[0].destroyed.connect(lambda *_: self._died())
        self._watch = DocumentWatch(self.document, self.edited, self._document_changed, self.is_busy)
        self._read()

    def know_mesh(self):
        """`source` is what the source object has now."""
        self._changes = contents.changes_of(self.source_object)

    def _read(self):
        femmesh = self.source_object.FemMesh
        self.know_mesh()
        self._reading = self.worker.request(lambda: self.read_mesh(femmesh))

    def _fit_buttons(self):
        """Help is its icon alone, and themes do not widen the other buttons: the panel would be wider than its dock."""
        if self._closed or self._box is None:
            return
        button = self._box.button(QtGui.QDialogButtonBox.Help)
        if not isinstance(button, QtGui.QAbstractButton):  # what PySide 2 has kept of something that lay there before
            return
        if QtGui.QApplication.instance().styleSheet():
            for other in self._box.findChildren(QtGui.QPushButton):
                other.setStyleSheet("min-width: 0px; padding: 3px 6px;")
        mark = "?" if button.icon().isNull() else ""  # styles without icons
        if button.text() != mark:
            button.setToolTip(button.text().replace("&", ""))
            button.setText(mark)
            button.setStyleSheet("min-width: 0px; padding: 3px;")

    def modifyStandardButtons(self, box):
        """Called by FreeCAD, with the box of the panel's buttons. Not to be looked for: PySide 2 would keep what it
        makes of a box that it finds after FreeCAD has deleted that, and hand it out for what comes to lie there."""
        self._box = box
        self._fit_buttons()

    @classmethod
    def page(cls):
        """The name of its page of help."""
        return cls.__module__.rsplit(".", 1)[-1]

    def helpRequested(self):
        """The Help button."""
        help.show(self.page())

    def read_mesh(self, femmesh):
        """The PreviewSource of the FemMesh of the source object; called on another thread."""
        mesh = femmesh_bridge.from_femmesh(femmesh)
        source = PreviewSource(whole_of(self.source_object) or mesh)
        source.digest = contents.digest_of_mesh(mesh)
        return source

    def loaded(self):
        """The mesh was read: `source` is there."""
        raise NotImplementedError

    def not_loaded(self, error):
        """The mesh could not be read."""
        raise NotImplementedError

    def finished(self, ticket, value):
        """Work asked of `worker` is done."""

    def failed(self, ticket, error):
        """Work asked of `worker` has failed."""

    def _arrived(self, ticket, value):
        if self._closed:
            return
        if ticket == self._reading:
            self._reading = None
            self.source = value
            self.loaded()
        else:
            self.finished(ticket, value)

    def _broke(self, ticket, error):
        if self._closed:
            return
        if ticket == self._reading:
            self._reading = None
            self.not_loaded(error)
        else:
            self.failed(ticket, error)

    # What happens to the document while the panel is open.

    def is_busy(self):
        """Whether it is the panel itself that changes the document just now."""
        return False

    def _document_changed(self, gone, stepped):
        if self._closed:
            return
        if gone and any(obj is not None and is_gone(obj) for obj in (self.edited, self.source_object)):
            self.leave()
            self._tell_lost()
            return
        self._meshes.renew()
        if self._changes != contents.changes_of(self.source_object):
            self.source = None
            self.reading_again()
            if "Invalid" in self.source_object.State or not self.source_object.FemMesh.NodeCount:
                self._reading = None
                self.know_mesh()
                text = translate("FemScalpel", "%1 has no mesh any more. Undo what took it away, or cancel.")
                self.not_loaded(femscalpel.Error(text.replace("%1", self.source_object.Label)))
            else:
                self._read()
        self.document_changed(stepped)

    def reading_again(self):
        """The source has another mesh, which is read now; loaded() or not_loaded() follow once more."""

    def document_changed(self, stepped):
        """The document has changed; `stepped`: `edited` by undo or redo."""

    def _tell_lost(self):
        """Says why the panel was closed, where it is for the lack of what it is about."""
        if self.document not in FreeCAD.listDocuments().values():
            return
        for obj, label in ((self.edited, self._labels[1]), (self.source_object, self._labels[0])):
            if label and is_gone(obj):
                text = translate("FemScalpel", "%1 is not there any more, so its panel was closed.")
                text = text.replace("%1", label)
                FreeCAD.Console.PrintWarning(text + "\n")
                FreeCADGui.getMainWindow().statusBar().showMessage(text, TOLD)
                return

    def _key(self, callback):
        event = callback.getEvent()
        if event.getKey() == coin.SoKeyboardEvent.ESCAPE and event.getState() == coin.SoButtonEvent.DOWN:
            callback.setHandled()
            # The view must not lose the callback while it is in it.
            QtCore.QTimer.singleShot(0, self._escape)

    def _escape(self):
        if not self._closed:
            self.reject()

    def reject(self):
        """Cancel, Close or Escape."""
        self.leave()
        return True

    def leave(self):
        """Closes the panel."""
        if self._closed:
            return
        self.close()
        FreeCADGui.Control.closeDialog()

    def close(self):
        """Takes everything out of the view and ends the work."""
        if self._closed:
            return
        self._closed = True
        self._watch.close()
        self._steady.close()
        self.worker.close()
        self.clear_view()
        self.legend_in_view.close()
        self._meshes.restore()
        try:
            self.view.removeEventCallbackPivy(coin.SoKeyboardEvent.getClassTypeId(), self._keys)
        except (RuntimeError, AttributeError):  # the view is gone
            pass
        bar = FreeCADGui.getMainWindow().statusBar()
        if bar.currentMessage().endswith("…"):  # what the panel was waiting for
            bar.clearMessage()
        self._give_up_forms()
        self.form = self._box = None
        self.forget_widgets()
        QtCore.QTimer.singleShot(0, self._forget)

    def _give_up_forms(self):
        # FreeCAD's form loader makes Python keep what it has made of the fields in a form for good, and PySide 2 would
        # hand that out for what comes to lie in the place of fields that are deleted: panels would no longer open. So
        # the forms are taken back from FreeCAD before it deletes them, and stay, hidden. Their signals keep the panel.
        forms, self._forms = self._forms, []
        for form in forms:
            form.hide()
            form.setParent(None)

    def _died(self):
        _lost.extend(self._forms)
        self._forms = []
        self.end()

    def end(self):
        """FreeCAD takes the panel away; nothing where it is closed."""
        if not self._closed:
            self.close()
            QtCore.QTimer.singleShot(0, self._tell_lost)

    def clear_view(self):
        """Takes the panel's own nodes out of the view."""
        raise NotImplementedError

    def forget_widgets(self):
        """Drops references to widgets."""
        raise NotImplementedError

    def _forget(self):
        """Drops all that is large."""
        if self.is_busy():  # with a document that was closed meanwhile
            QtCore.QTimer.singleShot(100, self._forget)
            return
        for name in self.LARGE:
            setattr(self, name, None)


def abort_transaction(document):
    """Takes back what was done since the transaction was opened."""
    document.abortTransaction()
    # FreeCAD would still put the next change, such as one while undoing, into a new transaction of that name.
    FreeCAD.closeActiveTransaction(True)


def _view(document):
    gui = FreeCADGui.getDocument(document.Name)
    view = gui.ActiveView
    return view if hasattr(view, "getSceneGraph") else gui.mdiViewsOfType("Gui::View3DInventor")[0]
