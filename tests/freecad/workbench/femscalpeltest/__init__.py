# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tests of the FemScalpel workbench, for TestFemScalpelApp and its like."""
