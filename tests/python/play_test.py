# SPDX-License-Identifier: MIT
"""Sessions: graphs that play on devices. These play on gestures; tests/guest plays on a virtual board."""

import subprocess
import sys
import threading
import time
import unittest

import numpy as np
import tactus
from support import GRAPHS, TestCase

WOOD = str(GRAPHS / "dry_wood.json")
CIRCLE = ["stylus=gesture:circle"]


def play(**options):
    return tactus.play(WOOD, device=CIRCLE, session="off", **options)


class Play(TestCase):
    def wait_for(self, holds):
        """A busy computer only takes longer."""
        for _ in range(12000):
            if holds():
                return
            time.sleep(0.005)
        self.fail("it did not happen")

    def test_a_session_plays_a_preset_and_records_it(self):
        with tactus.play("dry_wood", device=CIRCLE, session="off", duration=0.5, record=["motor.force"]) as session:
            self.assertTrue(session.wait(60))
            records = session.collect()
            self.assertEqual(session.lost, 0)
            self.assertEqual((session.rate, session.clock), (4000.0, ""))
        self.assertEqual(records["motor.force"].shape[1], 3)
        self.assertGreaterEqual(len(records["t"]), 2000)
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
            code = f"import tactus, time; s = tactus.play({WOOD!r}, {CIRCLE!r}, session='off'); time.sleep(0.1); {end}"
            done = subprocess.run([sys.executable, "-B", "-c", code], stderr=subprocess.PIPE, timeout=120, check=False)
            self.assertIn(done.returncode, (0, 1, -2, 130), done.stderr.decode())

    def test_a_thread_may_stop_what_another_one_waits_for(self):
        with play() as session:
            threading.Timer(0.2, session.stop).start()
            self.assertTrue(session.wait(60))


class Shown(TestCase):
    def test_a_session_has_a_short_repr(self):
        with play() as session:
            self.assertRegex(repr(session), r"^<tactus.Session, running: \d+ ticks, [\d.e-]+ N>$")
        self.assertEqual(repr(session), "<tactus.Session, closed>")

    def test_devices_are_given_as_in_a_render(self):
        with tactus.play(WOOD, {"stylus": "gesture:circle"}, session="off") as session:
            session.probe("motor.force")


try:
    from tactus._library import live
    live()
except tactus.Error as why:
    print(f"skipped: {why}")
    sys.exit(77)

if __name__ == "__main__":
    unittest.main()
