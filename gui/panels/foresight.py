# SPDX-License-Identifier: LGPL-2.1-or-later
"""Has the mesh that OK would make computed while nobody does anything, so that OK need not."""

import FreeCAD
from PySide import QtCore

import ObjectsFemScalpel
from femscalpelobjects import contents
from femscalpelobjects.stand_in import StandIn, Workshop

from ..progress import Steps

#: Milliseconds that what is entered has to stay.
_PAUSE = 500
#: Elements of a mesh above which its memory is not taken before OK.
_MOST = 1_000_000


class WithForesight:
    """The part of a ToolPanel that computes ahead, on the panel's other thread: for a stand-in of the object that OK
    would make or change. Any change of what is entered ends that at once.

    An object takes the outcome only if it is to be made from the same to the last bit, see MeshOperation.begin().
    """

    _foreseeing = None  # (ticket, Steps) of what is computed ahead
    _foreseen = None  # its outcome
    _foresights = frozenset()  # tickets of all

    def _foresee_soon(self):
        ticket = self._ticket
        QtCore.QTimer.singleShot(_PAUSE, lambda: self._foresee(ticket))

    def _foresee(self, ticket):
        if self._closed or self._progress is not None or ticket != self._ticket or self._is_waiting():
            return
        if self.shown is None or self._foreseeing is not None or self._foreseen is not None:
            return
        if max(self.source.mesh.cell_count, self.shown.result.mesh.cell_count) > _MOST:
            return
        self._remember_source()
        try:
            stand_in = self._stand_in()
            compute = stand_in.Proxy.begin(stand_in)
        except Exception:  # of many types; OK meets it, too, and says so
            return
        if compute is None:
            return
        steps = Steps()
        self._foreseeing = self.worker.request(lambda: compute(steps), gives_way=True), steps
        self._foresights |= {self._foreseeing[0]}

    def _stand_in(self):
        """What is like the object that OK would make or change."""
        names = {"FreeCAD": FreeCAD}
        if self.edited is not None:
            out = StandIn.of(self.edited, contents.ASIDE)
            for name, text in self.settings().items():
                setattr(out, name, eval(text, names))  # text that OK has FreeCAD run, too
            return out
        workshop = Workshop(self.document)
        arguments = {name: eval(text, names) for name, text in self.arguments().items()}
        getattr(ObjectsFemScalpel, self.MAKE)(workshop, self.source_object, name=self.OBJECT_NAME, **arguments)
        return workshop.made

    def _is_foresight(self, ticket, value):
        """Whether this is what was computed ahead, which is kept then if it is still right."""
        if ticket not in self._foresights:
            return False
        if self._foreseeing is not None and ticket == self._foreseeing[0]:
            self._foreseeing, self._foreseen = None, value
        return True

    def _end_foresight(self):
        """Something else is entered."""
        if self._foreseeing is not None:
            self._foreseeing[1].given_up = True
        self._foreseeing = self._foreseen = None

    def _wait_for_foresight(self, progress):
        """Waits for what is being computed ahead; False when the user has cancelled."""
        if self._foreseeing is None:
            return True
        steps = self._foreseeing[1]
        steps.progress = progress
        return progress.wait_for(lambda: self._foreseeing is None or self._closed, steps.say)
