# SPDX-License-Identifier: LGPL-2.1-or-later
"""Work on another thread that the user waits for, while the window lives and says what is done."""

import femscalpel

from .latest_wins import LatestWins
from .progress import Progress

#: Seconds that what was begun may take to be taken back once it is cancelled.
_PATIENCE = 2.0


def done_on_thread(title, text, work):
    """What `work` returns, called on another thread as work(tell), where tell(fraction done) may be called now and
    then. Raises what it does, and femscalpel.Cancelled when the user ends it.

    `title`: of the dialog that comes up when it takes long; `text`: what is being done.
    """
    outcome, step = [], [None]
    worker = LatestWins(
        lambda ticket, value: outcome.append((value, None)), lambda ticket, error: outcome.append((None, error))
    )
    progress = Progress(title, lambda said: None)

    def tell(fraction):
        step[0] = fraction
        if progress.cancelled:
            raise femscalpel.Cancelled("cancelled")

    try:
        progress.say(text)
        worker.request(lambda: work(tell))
        if not progress.wait_for(lambda: outcome, lambda: progress.say(text, step[0])):
            worker.cancel()
            worker.wait_until_idle(_PATIENCE)
            raise femscalpel.Cancelled("cancelled")
    finally:
        worker.close()
        progress.close()
    value, error = outcome[0]
    if error is not None:
        raise error
    return value
