# SPDX-License-Identifier: MIT
"""Sessions: graphs that play on devices. These play on gestures; tests/guest plays on a virtual board."""

import queue
import subprocess
import sys
import threading
import unittest

import numpy as np
import tactus
from support import GRAPHS, TestCase, needs_live
from waiting import eventually

WOOD = str(GRAPHS / "dry_wood.json")
CIRCLE = ["stylus=gesture:circle"]


def play(**options):
    return tactus.play(WOOD, device=CIRCLE, session="off", **options)


class Play(TestCase):
    def wait_for(self, holds):
        self.assertTrue(eventually(holds))

    def test_a_session_plays_a_preset_and_records_it(self):
        with tactus.play("dry_wood", device=CIRCLE, session="off", duration=1.0, record=["motor.force"]) as session:
            self.assertTrue(session.wait(60))
            records = session.collect()
            self.assertEqual(session.lost, 0)
            self.assertEqual((session.rate, session.clock), (4000.0, ""))
        self.assertEqual(records["motor.force"].shape[1], 3)
        self.assertGreater(len(records["t"]), 0)   # a busy computer loses ticks
        self.assertEqual(records.units["motor.force"], "N")
        self.assertGreater(np.abs(records["motor.force"]).max(), 0.0)

    def test_live_values_are_arrays(self):
        with play() as session:
            session.probe("motor.force", "drag.state")
            self.wait_for(lambda: np.any(session.values()["motor.force"] != 0.0))
            self.assertEqual(session.values()["motor.force"].shape, (3,))
            self.assertEqual(np.ndim(session.values()["drag.state"]), 0)

    def test_parameters_controls_and_edits_take_effect_while_it_plays(self):
        with play() as session:
            session.set("drag.mu", 0.2)
            session.control("roughness", 0.9)
            graph = tactus.Graph(WOOD)
            graph.set_param("drag", "mu", 0.7)
            session.edit(graph)
            self.fails("param/unknown", session.set, "drag.nothing", 1)
            self.fails("control/unknown", session.control, "nothing", 0.5)
            self.assertEqual(session.status().phase, "running")

    def test_wrong_arguments_are_errors_with_their_reasons(self):
        self.fails("device/unknown_role", tactus.play, WOOD, ["pen=gesture:circle"], session="off")
        self.fails("file/unreadable", tactus.play, "no_such_preset", session="off")
        self.fails("run/rate", tactus.play, WOOD, rate=-1)

    def test_an_exception_stops_the_forces_and_releases_the_devices(self):
        with self.assertRaises(ZeroDivisionError):
            with play() as session:
                self.wait_for(lambda: session.status().force > 0.0)
                1 / 0
        self.fails("session/closed", session.status)

    def test_emergency_stop_and_rearm(self):
        with play() as session:
            self.wait_for(lambda: session.status().force > 0.0)
            session.emergency_stop()
            self.fails("run/rearm_too_early", session.rearm)
            self.wait_for(lambda: session.status().force == 0.0)
            self.wait_for(lambda: any(m.id == "run/guard" for m in session.events()))

    def test_a_program_that_ends_or_raises_with_a_session_open_does_not_hang(self):
        for end in ("", "raise SystemExit(0)", "1 / 0", "import os; os.kill(os.getpid(), 2)"):
            code = f"import tactus; s = tactus.play({WOOD!r}, {CIRCLE!r}, session='off'); s.wait(0.1); {end}"
            done = subprocess.run([sys.executable, "-B", "-c", code], stderr=subprocess.PIPE, timeout=120, check=False)
            self.assertIn(done.returncode, (0, 1, -2, 130), done.stderr.decode())

    def test_a_thread_may_stop_what_another_one_waits_for(self):
        with play() as session:
            threading.Thread(target=lambda: eventually(lambda: session.status().ticks > 400) and session.stop()).start()
            self.assertTrue(session.wait(60))


class Callback(TestCase):
    wait_for = Play.wait_for

    def test_it_gets_every_recorded_tick_in_order(self):
        parts, threads = [], set()

        def keep(records):
            parts.append(records)
            threads.add(threading.current_thread())
        with play(record=["motor.force"], duration=1.0, callback=keep) as session:
            self.assertTrue(session.wait(60))
        self.assertGreaterEqual(len(parts), 1)   # a busy computer calls it late
        self.assertEqual(parts[0].units["motor.force"], "N")
        t = np.concatenate([part["t"] for part in parts])
        self.same_bits(t, np.arange(len(t)) / 4000)
        self.assertGreater(len(t), 0)
        self.assertNotIn(threading.main_thread(), threads)

    def test_an_exception_in_it_stops_the_run_with_zero_force_and_is_raised_at_the_caller(self):
        def fail(records):
            if np.any(records["motor.force"]):
                raise ZeroDivisionError("of the callback")
        for end in ("wait", "status", "set", "end of with"):
            with self.subTest(end):
                with self.assertRaisesRegex(ZeroDivisionError, "of the callback"):
                    with play(record=["motor.force"], callback=fail) as session:
                        self.wait_for(lambda: session.status().phase == "over")
                        self.assertEqual(session.status().force, 0.0)
                        if end == "wait":
                            session.wait(60)
                        elif end == "set":
                            session.set("drag.mu", 0.2)

    def test_an_exception_ends_a_wait_without_a_limit(self):
        def fail(records):
            raise SystemExit(3)
        with self.assertRaises(SystemExit):
            with play(record=["motor.force"], callback=fail) as session:
                session.wait()

    def test_an_exception_is_raised_once(self):
        def fail(records):
            raise KeyError("once")
        session = play(record=["motor.force"], callback=fail)
        self.assertRaises(KeyError, session.wait)
        self.assertEqual(session.status().phase, "over")
        session.close()

    def test_a_slow_one_delays_no_tick_and_what_it_misses_is_counted(self):
        goes_on, calls = threading.Event(), []

        def block(records):
            calls.append(records)
            goes_on.wait()
        try:
            with play(record=["motor.force"], buffer=0.05, callback=block) as session:
                self.wait_for(lambda: calls)
                before = session.status().ticks
                self.wait_for(lambda: session.status().ticks > before + 4000)   # a second of ticks, while the callback does not return
                self.assertEqual(len(calls), 1)
                self.assertGreater(session.lost, 0)
                lost, ticked = session.lost, session.status().ticks
                goes_on.set()
                session.stop()
                self.assertGreater(ticked, lost)
        finally:
            goes_on.set()
        self.assertLessEqual(sum(len(c["t"]) for c in calls[:2]), 4 * 200 + len(calls[0]["t"]))   # no more than the buffer kept

    def test_it_may_use_the_session(self):
        seen = []

        def use(records):
            session = opened.get(timeout=60) if not seen else seen[0]
            seen.append(session)
            session.set("drag.mu", 0.2)
            if len(seen) == 3:
                session.stop()
        opened = queue.Queue()
        with play(record=["motor.force"], callback=use) as session:
            opened.put(session)
            self.assertTrue(session.wait(60))
            self.fails("session/callback", session.collect)

    def test_it_may_close_the_session(self):
        opened, done = queue.Queue(), threading.Event()

        def close(records):
            if not done.is_set():
                opened.get(timeout=60).close()
                done.set()
        session = play(record=["motor.force"], callback=close)
        opened.put(session)
        self.assertTrue(done.wait(60))
        self.assertEqual(repr(session), "<tactus.Session, closed>")

    def test_a_program_that_ends_with_a_callback_does_not_hang_and_shows_its_exception(self):
        for body, shown in (("pass", ""), ("raise ZeroDivisionError", "ZeroDivisionError")):
            code = (f"import threading, tactus\ndef f(r):\n    {body}\n"
                    f"s = tactus.play({WOOD!r}, {CIRCLE!r}, session='off', record='motor.force', callback=f)\n"
                    "while s.status().ticks < 100 and s.status().phase != 'over': threading.Event().wait(0.01)")   # session.wait would raise it
            done = subprocess.run([sys.executable, "-B", "-c", code], stderr=subprocess.PIPE, timeout=120, check=False)
            self.assertIn(shown, done.stderr.decode())
            self.assertEqual(done.returncode, 0)


class Shown(TestCase):
    def test_a_session_has_a_short_repr(self):
        with play() as session:
            self.assertRegex(repr(session), r"^<tactus.Session, running: \d+ ticks, [\d.e-]+ N>$")
        self.assertEqual(repr(session), "<tactus.Session, closed>")

    def test_devices_are_given_as_in_a_render(self):
        with tactus.play(WOOD, {"stylus": "gesture:circle"}, session="off") as session:
            session.probe("motor.force")


needs_live(needs_program=False)

if __name__ == "__main__":
    unittest.main()
