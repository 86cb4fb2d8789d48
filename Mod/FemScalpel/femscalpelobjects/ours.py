# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which document objects are FemScalpel's own."""


def is_ours(obj):
    """Whether a document object is one of FemScalpel's."""
    return getattr(getattr(obj, "Proxy", None), "Type", "").startswith("FemScalpel::")
