# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the commands that try random cases have in common."""

import argparse


def case_arguments(description, kinds):
    """A parser of how many cases, of which kinds, and whether those that were refused are listed."""
    out = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    out.add_argument("--cases", type=int, default=30, help="of each kind")
    out.add_argument("--seed", type=int, default=0, help="of the first")
    out.add_argument("--kind", choices=list(kinds), help="only this")
    out.add_argument("--refused", action="store_true", help="list those that were refused")
    return out
