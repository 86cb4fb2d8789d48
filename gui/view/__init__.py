# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is drawn in the 3-D view, and what is picked from it."""
