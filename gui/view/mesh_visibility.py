# SPDX-License-Identifier: LGPL-2.1-or-later
"""Takes FreeCAD's own drawing of the meshes out of the way, without touching the document."""

# Child of FreeCAD's switch that a hidden mesh would show: faces with their edges.
_FACES_AND_WIREFRAME = 3


class HiddenMeshes:
    """Hides the FEM meshes of a document while this lives, by their scene graph alone: no property changes."""

    def __init__(self, document, source):
        self._document = document
        self._beside = []
        self._before = [
            (o.Name, o.ViewObject.SwitchNode, o.ViewObject.SwitchNode.whichChild.getValue()) for o in self._meshes()
        ]
        mode = source.ViewObject.SwitchNode.whichChild.getValue()
        if mode < 0:
            mode = min(_FACES_AND_WIREFRAME, source.ViewObject.SwitchNode.getNumChildren() - 1)
        self._mode = mode
        self._hide()

    def _meshes(self):
        return [o for o in self._document.Objects if o.isDerivedFrom("Fem::FemMeshObject")]

    def renew(self):
        """Hides the meshes that there are now, after undo or redo."""
        modes = {name: mode for name, _, mode in self._before}
        self._before = [(o.Name, o.ViewObject.SwitchNode, modes.get(o.Name, self._mode)) for o in self._meshes()]
        self._hide()

    def _hide(self):
        for _, switch, _ in self._before:
            switch.whichChild = -1

    def pickable(self, meshes):
        """Shows these mesh objects, so that they can be clicked at, and hides the others."""
        self._hide()
        for mesh in meshes:
            mesh.ViewObject.SwitchNode.whichChild = self._mode

    def hide_beside(self, objects):
        """Hides these objects of the document, too, and shows again others that were hidden so."""
        self._show_beside()
        self._beside = [(o.Name, o.ViewObject.SwitchNode.whichChild.getValue()) for o in objects]
        for obj in objects:
            obj.ViewObject.SwitchNode.whichChild = -1

    def _show_beside(self):
        for name, mode in self._beside:
            obj = self._document.getObject(name)
            if obj is not None and obj.ViewObject.Visibility:
                obj.ViewObject.SwitchNode.whichChild = mode
        self._beside = []

    def restore(self):
        """Shows again what is meant to be shown."""
        self._show_beside()
        for name, switch, mode in self._before:
            obj = self._document.getObject(name)
            if obj is not None and obj.ViewObject.Visibility:
                switch.whichChild = mode if mode >= 0 else self._mode
