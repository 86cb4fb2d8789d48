# SPDX-License-Identifier: LGPL-2.1-or-later
"""View providers of the document objects."""
