# SPDX-License-Identifier: LGPL-2.1-or-later
"""The crack of a finished mesh, drawn with FreeCAD's own picture of it: the border of the lips and the front."""

import zlib

from pivy import coin
from PySide import QtCore

import femmesh_bridge

from ..latest_wins import LatestWins
from ..view.crack_lines import crack_shape
from ..view.nodes import FaceNode, LineNode
from ..view.overlay import unpickable

#: Colours of cracks, each told from the others and from colours of groups.
_COLOURS = ((0.86, 0.12, 0.16), (0.85, 0.30, 0.0), (0.70, 0.0, 0.45), (0.45, 0.10, 0.60), (0.60, 0.25, 0.10))
_KINDS = ("FemScalpel::Crack", "FemScalpel::FaceCrack", "FemScalpel::CylindricalCrack", "FemScalpel::CurvedCrack")
#: How much of what covers the crack is seen through when it is lit.
_SEEN_THROUGH = 75


def colour_of(obj):
    """The colour of an object's crack; that of an object stays."""
    return _COLOURS[zlib.crc32(obj.Name.encode()) % len(_COLOURS)]


def drawn_in(document):
    """(colour, label) of the cracks of a document's objects that are drawn in its view."""
    found = []
    for obj in document.Objects:
        crack = getattr(getattr(obj.ViewObject, "Proxy", None), "crack", None)
        if isinstance(crack, MadeCrack) and crack.is_drawn:
            found.append((colour_of(obj), obj.Label))
    return found


class MadeCrack:
    """The nodes FemScalpelMadeCrack in the root of a view provider: lines where the crack is seen, dashed where it is
    covered; with light() also the lips, seen through the part."""

    def __init__(self, vobj):
        self._vobj = vobj
        self._worker = None
        self.is_lit, self._solid = False, 0
        rgb = colour_of(vobj.Object)
        self._switch = coin.SoSwitch()
        self._switch.setName("FemScalpelMadeCrack")
        self._switch.whichChild = coin.SO_SWITCH_NONE
        self.outline = LineNode("FemScalpelMadeOutline", rgb, 4.0)
        self.front = LineNode("FemScalpelMadeFront", rgb, 6.0)
        self.lips = FaceNode("FemScalpelMadeLips", rgb, edges=tuple(0.5 * c for c in rgb))
        self._hidden = [LineNode("FemScalpelCoveredOutline", rgb, 2.0), LineNode("FemScalpelCoveredFront", rgb, 3.0)]
        covered = coin.SoAnnotation()
        for part in self._hidden:
            part.dash()
            covered.addChild(part.root)
        nearer = coin.SoDepthBuffer()  # than the edges of FreeCAD's picture, which are where the lines are
        nearer.range.setValue(0.0, 0.9995)
        for node in (unpickable(), nearer, self.outline.root, self.front.root, self.lips.root, covered):
            self._switch.addChild(node)
        vobj.RootNode.addChild(self._switch)
        self._known, self._shape = False, None
        QtCore.QTimer.singleShot(0, self.show)

    @property
    def is_one(self):
        """Whether the object is a crack."""
        return getattr(getattr(self._vobj.Object, "Proxy", None), "Type", "") in _KINDS

    @property
    def is_drawn(self):
        """Whether there is something of it in the view."""
        shape = self._shape
        shown = self._switch.whichChild.getValue() == coin.SO_SWITCH_ALL and shape is not None
        return shown and len(shape.outline) + len(shape.front) > 0

    def mesh_changed(self):
        """The object has another mesh."""
        self._known, self._shape = False, None
        for part in (self.outline, self.front, self.lips, *self._hidden):
            part.hide()
        QtCore.QTimer.singleShot(0, self.show)

    def show(self):
        """Draws the crack of a visible object, which is first looked for on another thread."""
        try:
            obj, visible = self._vobj.Object, self._vobj.Visibility
            seen = visible and self.is_one and obj.FemMesh.NodeCount > 0 and "Invalid" not in obj.State
        except (ReferenceError, RuntimeError, AttributeError):  # it is gone
            self._end()
            return
        self._switch.whichChild = coin.SO_SWITCH_ALL if seen else coin.SO_SWITCH_NONE
        if not seen or self._known:
            return
        self._known = True
        shape = getattr(obj.Proxy, "crack_shape", None)
        if shape is not None:
            self._draw(shape)
            return
        femmesh, name = obj.FemMesh, obj.GroupName
        self._end()
        self._worker = LatestWins(self._found, lambda *_: self._end())
        self._worker.request(lambda: crack_shape(femmesh_bridge.from_femmesh(femmesh), name))

    def _found(self, ticket, shape):
        self._end()
        self._draw(shape)

    def _end(self):
        worker, self._worker = self._worker, None
        if worker is not None:
            worker.close()

    def _draw(self, shape):
        for part in (self.outline, self._hidden[0]):
            part.show(shape.outline)
        for part in (self.front, self._hidden[1]):
            part.show(shape.front)
        if self.is_lit:
            self.lips.show(shape.points, shape.faces)
        self._shape = shape

    def light(self):
        """Shows the lips through the part, or no longer."""
        self.is_lit = not self.is_lit
        if self.is_lit:
            self._solid, self._vobj.Transparency = self._vobj.Transparency, _SEEN_THROUGH
            if self._shape is not None:
                self.lips.show(self._shape.points, self._shape.faces)
        else:
            self._vobj.Transparency = self._solid
            self.lips.hide()
