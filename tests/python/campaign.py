# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the commands that try random cases have in common."""

import argparse
import collections
import time

import femscalpel as fs


def case_arguments(description, kinds):
    """A parser of how many cases, of which kinds, and whether those that were refused are listed."""
    out = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    out.add_argument("--cases", type=int, default=30, help="of each kind")
    out.add_argument("--seed", type=int, default=0, help="of the first")
    out.add_argument("--kind", choices=list(kinds), help="only this")
    out.add_argument("--refused", action="store_true", help="list those that were refused")
    return out


class Tally:
    """What became of random cases: how many were refused, by what, and the faults of those that were made."""

    def __init__(self, kind, list_refused, named=lambda error: type(error).__name__):
        """`named`: what a refusal counts as."""
        self.kind, self.list_refused, self.named = kind, list_refused, named
        self.refused, self.failed, self.seconds, self.made = collections.Counter(), {}, 0.0, 0

    def run(self, seed, operate):
        """The result of operate(), or nothing when it was refused."""
        start = time.perf_counter()
        try:
            result = operate()
        except fs.Error as error:
            self.refused[self.named(error)] += 1
            self.tell(seed, str(error))
            return None
        self.seconds += time.perf_counter() - start
        self.made += 1
        return result

    def tell(self, seed, text):
        """A line about a case, if such are wanted."""
        if self.list_refused:
            print(f"  {self.kind} {seed}: {text}")

    @property
    def mean_seconds(self):
        return self.seconds / max(1, self.made)

    def is_sound(self):
        """Lists what failed; whether nothing did."""
        for seed, faults in self.failed.items():
            print(f"  FAILED {self.kind} {seed}: {'; '.join(faults)}")
        return not self.failed
