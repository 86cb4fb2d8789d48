# SPDX-License-Identifier: LGPL-2.1-or-later
"""FemScalpel in FreeCAD's window: commands, task panels, 3-D preview and view providers.

What is computed lives in `femscalpel`, what is kept in documents in `femscalpelobjects`; this package shows and asks.
"""
