# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is put into the scene graph of a 3-D view beside the document's objects, and taken out again."""

from pivy import coin

#: The part of the depth of the view that pictures have: so they are before what is at the same place.
_NEARER = 0.9995


class Overlay:
    """A named separator in a view's scene graph."""

    def __init__(self, view, name):
        self._view = view
        self.root = coin.SoSeparator()
        self.root.setName(name)

    def open(self):
        """Puts it into the view."""
        self._view.getSceneGraph().addChild(self.root)

    def show(self, on):
        """Takes it out of the view for the time being, or puts it there again."""
        graph = self._view.getSceneGraph()
        if on != (graph.findChild(self.root) >= 0):
            graph.addChild(self.root) if on else graph.removeChild(self.root)

    def close(self):
        """Takes it out of the view."""
        try:
            graph = self._view.getSceneGraph()
        except (RuntimeError, AttributeError):  # the view is gone, and its graph with it
            return
        if graph.findChild(self.root) >= 0:
            graph.removeChild(self.root)


class Picture(Overlay):
    """An Overlay that is looked at, not picked: clicks go through to what can be selected. Well lit; ghosts are
    blended; in front of what FreeCAD draws at the same place, such as the faces of the CAD part."""

    def __init__(self, view, name):
        super().__init__(view, name)
        blend = coin.SoTransparencyType()
        blend.value = coin.SoTransparencyType.DELAYED_BLEND
        # FreeCAD's faces are moved back like ours, see FaceNode, so that the difference is this alone.
        nearer = coin.SoDepthBuffer()
        nearer.range.setValue(0.0, _NEARER)
        for node in (unpickable(), blend, nearer, *_lights()):
            self.root.addChild(node)


def unpickable():
    """A node after which nothing can be picked."""
    pick = coin.SoPickStyle()
    pick.style = coin.SoPickStyle.UNPICKABLE
    return pick


def _lights():
    """Lights beside FreeCAD's own, which leaves faces seen at an angle too dark to tell colours apart."""
    for direction, intensity in (((0.6, 1.0, -0.8), 0.45), ((-1.0, -0.3, -0.3), 0.45), ((0.2, -0.4, 1.0), 0.3)):
        light = coin.SoDirectionalLight()
        light.direction.setValue(*direction)
        light.intensity = intensity
        yield light
