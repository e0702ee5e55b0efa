# SPDX-License-Identifier: MIT
"""The only ways in which a test in Python waits or looks at a clock, as waiting.hpp has them for C++."""

import threading
import time


def let_pass(least_s):
    """At least this time passes. What is tested may not depend on how much more passes."""
    time.sleep(least_s)


class Stopwatch:
    """The wall time of something, to print it."""

    def __init__(self):
        self.begin = time.monotonic()

    def __str__(self):
        return f"{time.monotonic() - self.begin:.0f} s"

    def has_run(self, least_s):
        return time.monotonic() - self.begin >= least_s


def eventually(condition, nap_s=0.01):
    """True as soon as the condition holds. The deadline is a number of looks, so a busy computer makes it longer."""
    looks, watch = 0, Stopwatch()
    while looks < 10000 or not watch.has_run(120):
        if condition():
            return True
        time.sleep(nap_s)
        looks += 1
    return False


def while_busy(call, processor_s=0.2):
    """Calls this on another thread, once the process has used so much of a processor: in the middle of a long computation that begins now."""
    begin = time.process_time()
    threading.Thread(target=lambda: eventually(lambda: time.process_time() - begin > processor_s) and call()).start()
