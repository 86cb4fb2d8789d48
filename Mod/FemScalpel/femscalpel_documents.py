# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tells of documents whose objects of FemScalpel have lost what they are: they keep their mesh, but do not recompute.

FreeCAD saves with each object which Python class it is of. It loses that where the class cannot be loaded when the
document is opened: without FemScalpel, and where FreeCAD does not permit to load it, as FemScalpel is on Python's path,
but not among FreeCAD's add-ons, and no script has imported it yet.
"""

import FreeCAD

_observers = []  # kept, as FreeCAD holds no reference


def lost_objects(document):
    """The objects of a document that were FemScalpel's."""
    made = (o for o in document.Objects if "NodeSetCounts" in o.PropertiesList)
    return [o for o in made if getattr(o, "Proxy", None) is None]


def watch():
    """Tells of such documents from now on; when called for the first time, of those that are open, too."""
    if _observers:
        return
    _observers.append(
        Opened(
            lambda document: _tell(
                document,
                "because it was saved where it had been opened without FemScalpel, or because FreeCAD did not "
                "permit to load them now, which it says above: then give freecad -M an absolute path. Close it "
                "without saving, and open it again, or a copy saved before.",
            )
        )
    )
    FreeCAD.addDocumentObserver(_observers[0])
    for document in FreeCAD.listDocuments().values():
        _tell(
            document,
            "because it was opened while FreeCAD did not know FemScalpel. Close it without saving, and open it again "
            "now, or after 'import ObjectsFemScalpel', or where FemScalpel is among FreeCAD's add-ons.",
        )


class Opened:
    """Document observer that calls `tell(document)` once for each document that is opened."""

    def __init__(self, tell):
        self._tell, self._told = tell, set()

    # FreeCAD has no word for the end of opening, but makes the document the active one then.
    def slotActivateDocument(self, document):
        if document.Name not in self._told and not document.Restoring:
            self._told.add(document.Name)
            self._tell(document)

    def slotDeletedDocument(self, document):
        self._told.discard(document.Name)


def _tell(document, why):
    lost = lost_objects(document)
    if lost:
        FreeCAD.Console.PrintWarning(
            f"Document {document.Label}: its objects of FemScalpel ({', '.join(o.Label for o in lost)}) have lost what "
            f"they are and do not recompute, {why}\n"
        )
