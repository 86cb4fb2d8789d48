# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panels, one file each, and the widgets they share; forms are Qt Designer files beside them."""
