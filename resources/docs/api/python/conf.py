# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sphinx' settings for the pages of the Python package; the build calls it with the package in PYTHONPATH."""

import femscalpel

project = "FemScalpel"
version = release = femscalpel.__version__
extensions = ["sphinx.ext.autodoc", "sphinx.ext.napoleon"]
napoleon_google_docstring = False
napoleon_use_rtype = False
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_default_options = {"exclude-members": "distances"}  # what distance() is made with
default_role = "code"
html_theme = "alabaster"
html_theme_options = {"description": "Cracks, drills and cuts finite-element meshes", "page_width": "70em"}
html_show_copyright = False
html_copy_source = False

# Numpy's style takes what stands before a colon in an attribute's comment for its type. Here it is part of the text.
written = {}


def keep(app, what, name, obj, options, lines):
    """Remembers the comment of an attribute or property before napoleon sees it."""
    if what in ("attribute", "property"):
        written[name] = list(lines)


def restore(app, what, name, obj, options, lines):
    """Puts it back afterwards."""
    if name in written:
        lines[:] = written.pop(name)


def list_tools(app, name, source):
    """Puts the tools where a page has the comment `every tool`."""
    tools = [f".. autoclass:: {tool}\n   :members:\n   :inherited-members: tuple\n" for tool in femscalpel.tools.TOOLS]
    source[0] = source[0].replace(".. every tool\n", "".join(tools))


def setup(app):
    """Called by Sphinx."""
    app.connect("source-read", list_tools)
    app.connect("autodoc-process-docstring", keep, priority=400)
    app.connect("autodoc-process-docstring", restore, priority=600)
