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
default_role = "code"
html_theme = "alabaster"
html_theme_options = {"description": "Cracks, drills and cuts finite-element meshes", "page_width": "70em"}
html_show_copyright = False
html_copy_source = False
