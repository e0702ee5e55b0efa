# SPDX-License-Identifier: MIT
"""What must be over when the main thread is over."""

from __future__ import annotations

import atexit
import threading
import traceback
from typing import Callable, List

_functions: List[Callable[[], None]] = []
_has_ended = False
_wait_for_threads: Callable[[], None] = threading._shutdown   # type: ignore[attr-defined]


def when_main_ends(function: Callable[[], None]) -> Callable[[], None]:
    """Calls this as soon as the main thread has ended: at the end of the script, after sys.exit, an exception or Ctrl-C. `atexit` alone is too late: it
    comes after the interpreter has waited for all threads that are not daemons. threading._register_atexit is too late as well if a pool that is
    imported later waits for its threads. `atexit` comes in addition, for an interpreter that does not call threading._shutdown."""
    _functions.append(function)
    return atexit.register(function)


def main_has_ended() -> bool:
    return _has_ended


def _shutdown() -> None:
    global _has_ended
    _has_ended = True
    for function in _functions:
        try:
            function()
        except BaseException:   # such as KeyboardInterrupt, at a second Ctrl-C
            traceback.print_exc()
    _wait_for_threads()


threading._shutdown = _shutdown   # type: ignore[attr-defined]   # the interpreter calls it by this name, before it waits for threads
