# SPDX-License-Identifier: MIT
"""Calls a function with what a session records, while it plays."""

from __future__ import annotations

import threading
from typing import Any, Callable, Optional

from ._messages import Error, Message
from ._records import Records

_APART = 0.02        # between two calls, in s: faster than the eye, and little for Python
_PATIENCE = 5.0      # how long the end of a session waits for the function, in s


class Caller:
    """A thread of Python that calls a function with records. It is never the tick thread, which goes on while the function computes, and does not wait for
    it: what no longer fits into the buffer of records is lost, and counted."""

    def __init__(self, function: Callable[[Records], Any], collect: Callable[[], Records], halt: Callable[[], None]):
        """collect: returns what was recorded since its last call. halt: brings the forces to zero, and ends the run."""
        self._function, self._collect, self._halt = function, collect, halt
        self._failure: Optional[BaseException] = None
        self._ends = threading.Event()
        self._thread = threading.Thread(target=self._run, name="tactus callback", daemon=True)   # it does not keep the program from ending

    def start(self) -> None:
        self._thread.start()

    def _run(self) -> None:
        try:
            is_last = False
            while not is_last:
                is_last = self._ends.wait(_APART)   # after the end of the run, there is more to collect
                records = self._collect()
                if len(records["t"]):
                    self._function(records)
        except BaseException as why:   # such as SystemExit: it ends the run, too
            if self._ends.is_set() and isinstance(why, Error) and why.id == "session/closed":
                return
            self._failure = why
            self._halt()

    def is_this_thread(self) -> bool:
        return threading.current_thread() is self._thread

    def end(self, waits: bool) -> Optional[Message]:
        """Ends the calls. With `waits`, the function has had the last records. Returns what is wrong."""
        self._ends.set()
        if not waits or self.is_this_thread() or not self._thread.is_alive():
            return None
        self._thread.join(_PATIENCE)
        if not self._thread.is_alive():
            return None
        return Message(False, "session/callback", "callback", f"the callback has not returned within {_PATIENCE:g} s after the end of the run",
                       "let it compute less, or return sooner")

    def failure(self) -> Optional[BaseException]:
        """The exception that the function has raised, but only once."""
        why, self._failure = self._failure, None
        return why
