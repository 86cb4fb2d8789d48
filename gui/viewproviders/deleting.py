# SPDX-License-Identifier: LGPL-2.1-or-later
"""What goes with the deletion of an object that an operator has made."""

from femscalpelobjects.analysis import analysis_of, take_out_of_analysis
from femscalpelobjects.ours import made_of


def before_deletion(obj):
    """Gives the analysis the source back, and shows what the object was made of where nothing else is made of it. Part
    of the step to undo that the deletion is."""
    if analysis_of(obj) is not None and obj.Source is not None:
        take_out_of_analysis(obj)
    if not obj.ViewObject.Visibility:
        return
    for mesh in made_of(obj):
        if not any(other != obj and mesh in made_of(other) for other in mesh.InList):
            mesh.ViewObject.Visibility = True
