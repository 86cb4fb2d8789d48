# SPDX-License-Identifier: LGPL-2.1-or-later
"""What objects say in the report view."""

import FreeCAD

if FreeCAD.GuiUp:
    from femscalpelgui.messages import in_language


def said(text):
    """What the engine or an object says, in the language of the window; English without one."""
    return in_language(text) if FreeCAD.GuiUp else text
