# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which document objects are FemScalpel's own."""


def is_ours(obj):
    """Whether a document object is one of FemScalpel's."""
    return getattr(getattr(obj, "Proxy", None), "Type", "").startswith("FemScalpel::")


def made_of(obj):
    """The mesh objects that a document object's mesh is made from: its source, and what was added to that."""
    links = (getattr(obj, name, None) for name in ("Source", "Addition"))
    return [mesh for mesh in links if mesh is not None] if is_ours(obj) else []
