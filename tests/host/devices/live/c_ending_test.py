#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""No force outlives a C or C++ program that plays through libtactus_live, in whichever way it ends: c_ending_test.py ENDING_PROGRAM TACTUS"""

import os
import pathlib
import signal
import subprocess
import sys
import unittest
from contextlib import suppress

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / "support"))
from pushed_board import Board   # noqa: E402
from waiting import eventually   # noqa: E402

ENDS = ("the end of main", "exit", "exit of another thread", "_exit", "quick_exit", "abort", "an exception", "an exception in another thread",
        "SIGINT", "SIGTERM", "SIGHUP", "SIGQUIT", "SIGKILL", "SIGSEGV", "a fork that outlives it")
GOES_ON = ("pthread_exit", "exec", "exit, and a function of atexit that never returns", "quick_exit, and a function of at_quick_exit that never returns")
program, tactus = sys.argv[1:3]


class Endings(unittest.TestCase):
    def test_the_force_goes_however_a_program_ends(self):
        for way in ENDS + GOES_ON:
            with self.subTest(way), Board(tactus) as board:
                ran = subprocess.Popen([program, board.graph, "stylus=" + board.device, way], stderr=subprocess.DEVNULL, start_new_session=True)
                try:
                    self.assertTrue(eventually(board.was_released))
                    if way in GOES_ON:
                        self.assertIsNone(ran.poll())
                    else:
                        self.assertTrue(eventually(lambda: ran.poll() is not None))
                        self.assertNotEqual(ran.returncode, 2)   # it has played
                finally:
                    kill_all(ran)


def kill_all(ran):
    """With its children."""
    with suppress(ProcessLookupError):
        os.killpg(ran.pid, signal.SIGKILL)
    ran.wait()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
