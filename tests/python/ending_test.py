# SPDX-License-Identifier: MIT
"""No force outlives what gave it: programs that end, in each way and with threads that go on, while a session pushes a board over UDP; sessions that are
closed while a call goes on; and forks."""

import json
import os
import signal
import subprocess
import sys
import threading
import unittest
from contextlib import suppress
from unittest import mock

import tactus
from support import GRAPHS, PROGRAM, TestCase, needs_live
import pushed_board
from pushed_board import PUSH
from tactus import _play
from waiting import eventually

BEGIN = """
import concurrent.futures, ctypes, os, signal, sys, threading
import tactus
signal.signal(signal.SIGINT, signal.default_int_handler)   # a shell starts what runs in the background without it
for_ever = threading.Event().wait
session = tactus.play(sys.argv[1], {"stylus": sys.argv[2]}, session="off")
while session.status().force < 0.39:
    session.wait(0.01)
"""
THREADS = {"no other thread": "",
           "a daemon thread": "threading.Thread(target=for_ever, daemon=True).start()",
           "a thread that never ends": "threading.Thread(target=for_ever).start()",
           "a pool that never ends": "concurrent.futures.ThreadPoolExecutor().submit(for_ever)"}
GOES_ON = ("a thread that never ends", "a pool that never ends")   # the interpreter waits for these
BY_ITSELF = {"the end of the script": "", "sys.exit": "sys.exit(3)", "an exception": "1 / 0", "Ctrl-C": "os.kill(os.getpid(), signal.SIGINT); for_ever()"}
AT_ONCE = {"os._exit": "os._exit(0)", "os.abort": "os.abort()", "a wild pointer": "ctypes.string_at(8)",
           **{name: f"os.kill(os.getpid(), signal.{name})" for name in ("SIGTERM", "SIGHUP", "SIGQUIT", "SIGKILL", "SIGSEGV")}}   # no Python runs: the guardian brings the board to rest


class Board(pushed_board.Board):
    def __init__(self):
        super().__init__(PROGRAM)

    def run(self, code):
        return subprocess.Popen([sys.executable, "-B", "-c", code, self.graph, self.device], stderr=subprocess.DEVNULL, start_new_session=True)


class Programs(TestCase):
    def ends(self, thread, end, goes_on):
        with self.subTest(end, thread=thread), Board() as board, board.run(BEGIN + THREADS[thread] + "\n" + end) as program:
            try:
                self.assertTrue(eventually(board.was_released))
                if goes_on:
                    self.assertIsNone(program.poll())
                else:
                    self.assertTrue(eventually(lambda: program.poll() is not None))
            finally:
                program.kill()

    def test_the_force_goes_when_the_main_thread_ends_whatever_other_threads_do(self):
        for thread in THREADS:
            for end in BY_ITSELF.values():
                self.ends(thread, end, thread in GOES_ON)

    def test_the_force_goes_when_the_program_ends_at_once(self):
        for thread in ("no other thread", "a thread that never ends"):
            for end in AT_ONCE.values():
                self.ends(thread, end, False)

    def test_the_force_goes_when_another_program_takes_its_place(self):
        self.ends("a thread that never ends", "os.execv('/bin/sleep', ['sleep', '600'])", True)

    def test_the_force_goes_before_what_atexit_calls_and_before_threads_raise(self):
        self.ends("no other thread", "import atexit; atexit.register(for_ever)", True)
        self.ends("no other thread", "threading._register_atexit(for_ever)", True)
        self.ends("a daemon thread", "threading.excepthook = lambda *_: for_ever()\nthreading.Thread(target=lambda: 1 / 0).start()", True)

    def test_the_force_goes_when_the_main_thread_ends_without_the_interpreter(self):
        self.ends("a thread that never ends", "ctypes.CDLL(None).pthread_exit(None)", True)

    def test_a_second_ctrl_c_keeps_no_force(self):
        self.ends("a thread that never ends", "session.close = lambda: signal.raise_signal(signal.SIGINT)\nsignal.raise_signal(signal.SIGINT)", True)


class Others(TestCase):
    """Programs with a thread that goes on after the main thread, and ends the program with 0 if all is as it should be."""

    BEGIN = "import os, sys, threading\nimport tactus\nfrom waiting import eventually\n"
    START = "\nthreading.Thread(target=lambda: os._exit(go_on())).start()\n"

    def goes_on(self, code):
        command = [sys.executable, "-B", "-c", self.BEGIN + code + self.START, GRAPHS / "dry_wood.json"]
        with subprocess.Popen(command, env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}) as program:
            try:
                self.assertTrue(eventually(lambda: program.poll() is not None))
            finally:
                program.kill()
        self.assertEqual(program.returncode, 0)

    def test_a_live_engine_ends_with_the_main_thread(self):
        self.goes_on("""
engine = tactus.Engine(tactus.Graph(sys.argv[1]), devices={"stylus": "gesture:circle"})
engine.start()
def go_on():
    return 0 if eventually(lambda: engine.status().phase == "over") else 1""")

    def test_no_session_begins_after_the_main_thread(self):
        self.goes_on("""
def go_on():
    threading.main_thread().join()
    try:
        tactus.play(sys.argv[1], {"stylus": "gesture:circle"}, session="off")
    except tactus.Error as why:
        return 0 if why.id == "session/main_thread" else 1
    return 1""")


class Inside:
    """While it exists, calls of a session run `first` inside, once."""

    def __init__(self, first):
        self._first, self._made = first, _play.Messages
        self._patch = mock.patch.object(_play, "Messages", self._make)

    def _make(self):
        first, self._first = self._first, None
        if first is not None:
            first()
        return self._made()

    def __enter__(self):
        self._patch.__enter__()

    def __exit__(self, *why):
        self._patch.__exit__(*why)


class Closing(TestCase):
    def setUp(self):
        self.session = tactus.play(tactus.Graph.parse(json.dumps(PUSH)), {"stylus": "gesture:circle"}, session="off")
        self.addCleanup(self.session.close)
        self.assertTrue(eventually(lambda: self.session.status().force > 0.39))

    def call(self, inside):
        """A call of the session, during which this runs."""
        with Inside(inside), suppress(tactus.Error):
            self.session.set("push.value", 0.4)

    def close_in_handler(self):
        before = signal.signal(signal.SIGUSR1, lambda *_: self.session.close())
        try:
            signal.raise_signal(signal.SIGUSR1)
        finally:
            signal.signal(signal.SIGUSR1, before)

    def test_a_signal_handler_may_close_what_it_interrupts(self):
        self.call(self.close_in_handler)
        self.fails("session/closed", self.session.emergency_stop)   # released, too

    def test_it_does_not_wait_for_a_thread_that_waits_for_what_it_interrupts(self):
        other = threading.Thread(target=lambda: self.call(lambda: None))

        def inside():
            other.start()
            self.assertTrue(eventually(lambda: len(self.session._calls) == 2))
            self.close_in_handler()
        self.call(inside)
        other.join()
        self.fails("session/closed", self.session.emergency_stop)

    def end_during_a_call(self, end):
        """Ends the session while a call of another thread goes on. Returns whether the end waits for that call."""
        is_inside, goes_on = threading.Event(), threading.Event()
        busy = threading.Thread(target=lambda: self.call(lambda: is_inside.set() or goes_on.wait()))
        ends = threading.Thread(target=end)
        busy.start()
        try:
            is_inside.wait()
            ends.start()
            self.assertTrue(eventually(lambda: self.session.status().phase == "over"))
            self.assertEqual(self.session.status().force, 0.0)
            self.session.emergency_stop()
            return ends.is_alive()
        finally:
            goes_on.set()
            busy.join()
            ends.join()

    def test_a_stop_does_not_wait_for_the_calls_of_other_threads(self):
        self.end_during_a_call(self.session.stop)

    def test_a_close_stops_before_it_waits_and_an_emergency_stop_is_taken_meanwhile(self):
        self.assertTrue(self.end_during_a_call(self.session.close))
        self.fails("session/closed", self.session.emergency_stop)


FORK = """
import multiprocessing
from tactus import _play
is_inside, made = threading.Event(), _play.Messages
def block():
    if threading.current_thread() is not threading.main_thread():
        is_inside.set()
        for_ever()
    return made()
_play.Messages = block
threading.Thread(target=session.set, args=("push.value", 0.4), daemon=True).start()
is_inside.wait()
if (child := os.fork()) == 0:
    {}
else:
    os.waitpid(child, 0)
    while session.status().phase == "running" and session.status().force < 0.39:   # a fork may make a tick late, so that a reading gets old
        threading.Event().wait(0.01)
    os._exit(0 if session.status().phase == "running" else 1)
"""


class Forks(TestCase):
    def test_a_child_ends_although_a_call_goes_on_and_its_parent_plays_on(self):
        for child in ("pass", "session.close()", "sys.exit()", "os.kill(os.getpid(), signal.SIGINT)",
                      "p = multiprocessing.get_context('fork').Process(target=session.close); p.start(); p.join()"):
            with self.subTest(child), Board() as board, board.run(BEGIN + FORK.format(child)) as program:
                try:
                    self.assertTrue(eventually(lambda: program.poll() is not None))
                    self.assertEqual(program.returncode, 0)
                finally:
                    with suppress(ProcessLookupError):
                        os.killpg(program.pid, signal.SIGKILL)   # a child that hangs


needs_live()   # the program plays a board

if __name__ == "__main__":
    unittest.main()
