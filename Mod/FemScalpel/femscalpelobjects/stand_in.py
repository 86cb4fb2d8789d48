# SPDX-License-Identifier: LGPL-2.1-or-later
"""What an object of FemScalpel would be, without being in a document: to compute its mesh before it is made or changed.

A stand-in that is not quite like the object is of no use, but does no harm: what it has computed is taken only for an
object with the same digest of all inputs, see MeshOperation.adopt().
"""

import FreeCAD

_QUANTITIES = ("App::PropertyLength", "App::PropertyDistance", "App::PropertyAngle", "App::PropertyArea")
_PLAIN = {
    "App::PropertyBool": bool,
    "App::PropertyInteger": int,
    "App::PropertyFloat": float,
    "App::PropertyString": str,
    "App::PropertyPlacement": FreeCAD.Placement,
    "App::PropertyVector": FreeCAD.Vector,
    "App::PropertyStringList": list,
    "App::PropertyMap": dict,
}
_LISTS = ("App::PropertyLinkList", "App::PropertyLinkListHidden", "App::PropertyLinkSubListGlobal")


class StandIn:
    """Has properties as a document object, and of its other attributes those that a MeshOperation asks for."""

    def __init__(self, document, stands_for=None):
        own = {
            "Document": document,
            "StandsFor": stands_for,  #: the document object, None where it is yet to be made
            "ViewObject": None,
            "Proxy": None,
            "State": [],
            "ExpressionEngine": [],
            "_kinds": {},
            "_values": {},
            "_choices": {},
        }
        self.__dict__.update(own)

    @classmethod
    def of(cls, obj, left_out):
        """One with the properties of `obj`, which do not include the group Result and those left out."""
        out = cls(obj.Document, obj)
        for name in obj.PropertiesList:
            section = obj.getGroupOfProperty(name)
            if name in left_out or section == "Result":
                continue
            out.addProperty(obj.getTypeIdOfProperty(name), name, section)
            if out._kinds[name][0] == "App::PropertyEnumeration":
                setattr(out, name, obj.getEnumerationsOfProperty(name))
            setattr(out, name, getattr(obj, name))
        out.__dict__["Proxy"] = type(obj.Proxy).__new__(type(obj.Proxy))
        out.Proxy.loads(None)
        return out

    @property
    def PropertiesList(self):
        """Names of the properties."""
        return list(self._values)

    def addProperty(self, kind, name, section="", text="", attributes=0):
        """As of document objects."""
        self._kinds[name] = kind, section
        if kind in _QUANTITIES:
            value = FreeCAD.Units.Quantity(0)
        elif kind in _LISTS or kind == "App::PropertyVectorList":
            value = []
        else:
            value = _PLAIN[kind]() if kind in _PLAIN else 0 if kind == "App::PropertyIntegerConstraint" else None
        self._values[name] = value

    def getGroupOfProperty(self, name):
        """As of document objects."""
        return self._kinds[name][1]

    def getTypeIdOfProperty(self, name):
        """As of document objects."""
        return self._kinds[name][0]

    def getEnumerationsOfProperty(self, name):
        """As of document objects."""
        return self._choices.get(name, [])

    def setEditorMode(self, name, mode):
        """As of document objects: there is no editor."""

    def __getattr__(self, name):
        try:
            return self.__dict__["_values"][name]
        except KeyError:
            raise AttributeError(name) from None

    def __setattr__(self, name, value):
        if name in self.__dict__:
            self.__dict__[name] = value
        elif name not in self._values:
            raise AttributeError(name)
        else:
            self._values[name] = self._as_property(name, value)

    def _as_property(self, name, value):
        """`value` as a property returns it that it was given to."""
        kind = self._kinds[name][0]
        if kind in _QUANTITIES:
            return FreeCAD.Units.Quantity(getattr(value, "Value", value))
        if kind == "App::PropertyEnumeration":
            if not isinstance(value, str):
                self._choices[name] = list(value)
                return self._choices[name][0]
            if value not in self._choices.get(name, ()):
                raise ValueError(f"{value!r} is not part of the enumeration {name}")
            return value
        if kind == "App::PropertyIntegerConstraint":
            return value[0] if isinstance(value, tuple) else int(value)
        if kind == "App::PropertyVectorList":
            return [FreeCAD.Vector(*vector) for vector in value]
        if kind == "App::PropertyVector":
            return FreeCAD.Vector(*value)
        return _PLAIN[kind](value) if kind in _PLAIN else value


class Workshop:
    """In place of a document for the functions of ObjectsFemScalpel: what they make is a StandIn."""

    def __init__(self, document):
        self._document = document
        self.made = None

    def __eq__(self, other):
        return other == self._document

    def __ne__(self, other):
        return other != self._document

    __hash__ = None

    def addObject(self, kind, name):
        """As of documents."""
        self.made = StandIn(self._document)
        return self.made

    def removeObject(self, name):
        """As of documents."""
        self.made = None
