# SPDX-License-Identifier: LGPL-2.1-or-later
"""Ending what runs from another thread."""

from . import _engine


class CancelToken:
    """Ends computations from another thread.

    What runs in ``with token:`` ends with :class:`Cancelled` within a fifth of a second of ``token.cancel()``: every
    function of the package that takes long, in the thread that entered. Nothing is changed or written then: meshes and
    sessions stay as they were, and of a file that was being written the old one. (Ctrl-C needs no token: it ends what
    Python's main thread runs with KeyboardInterrupt.)

    Once cancelled, a token stays so. Tokens nest; each is left in the thread and order it was entered.

    Examples
    --------
    >>> token = CancelToken()
    >>> threading.Timer(10, token.cancel).start()
    >>> with token:
    ...     result = crack(mesh, plane)
    """

    __slots__ = ("_token",)

    def __init__(self):
        self._token = _engine.CancelToken()

    def cancel(self) -> None:
        """Ends what runs in this token. From any thread, as often as you like."""
        self._token.cancel()

    @property
    def cancelled(self) -> bool:
        """Whether cancel() was called."""
        return self._token.cancelled

    def __enter__(self) -> "CancelToken":
        self._token.enter()
        return self

    def __exit__(self, *exception) -> None:
        self._token.leave()
