# SPDX-License-Identifier: MIT
"""The engine: step by step, with own devices, live."""

import _thread
import concurrent.futures
import subprocess
import sys
import unittest

import numpy as np
import tactus
from support import GRAPHS, TestCase, drag, positions
from waiting import eventually, while_busy

FEED = {"drag.position": (0, 0, 0), "drag.normal_force": 1.0}


def wall(guard=None):
    """A spring that a pushed device leans on."""
    graph = tactus.Graph(rate=1000)
    graph.add_node("hand", "device.position", role="pen")
    graph.add_node("plane", "deform.plane", {"stiffness": 1000})
    graph.add_node("motor", "device.force", role="pen")
    graph.connect("hand.position", "plane.position")
    graph.connect("plane.force", "motor.force")
    return graph, tactus.Engine(graph, devices={"pen": tactus.PushedDevice(guard=guard)})


class Steps(TestCase):
    def test_steps_of_any_length_are_the_render(self):
        p, load = positions(200), np.linspace(0, 2, 200)
        whole = drag().render(feed={"drag.position": p, "drag.normal_force": load}, record=["drag.force", "drag.state"])
        engine = tactus.Engine(drag(), feed=FEED, record=["drag.force", "drag.state"])
        parts, at = [], 0
        for n in (1, 1, 48, 0, 150):
            feed = {"drag.position": p[at], "drag.normal_force": load[at]} if n == 1 else {"drag.position": p[at:at + n], "drag.normal_force": load[at:at + n]}
            parts.append(engine.step(feed, n))
            at += n
        for port in whole:
            self.same_bits(whole[port], np.concatenate([part[port] for part in parts]))
        rows = tactus.Engine(drag(), feed=FEED, record=["drag.force", "drag.state"]).step_rows(np.column_stack([p, load]), 200)
        self.same_bits(rows[:, :3], whole["drag.force"])

    def test_values_that_are_left_out_stay(self):
        engine = tactus.Engine(drag(), feed=FEED, record=["drag.force"])
        engine.step()
        engine.step({"drag.position": (1e-3, 0, 0)})
        held = engine.step(n=3)["drag.force"]
        self.assertTrue(np.all(held[:, 0] < 0))
        self.assertTrue(np.all(engine.step({"drag.normal_force": 0.0}, n=2)["drag.force"] == 0))

    def test_wrong_feeds_are_refused(self):
        engine = tactus.Engine(drag(), feed=FEED)
        self.fails("feed/unknown", engine.step, {"drag.mu": 1})
        self.fails("feed/shape", engine.step, {"drag.position": (0, 0)})
        self.fails("feed/shape", engine.step, {"drag.normal_force": np.zeros(3)}, 4)
        self.fails("feed/shape", engine.step_rows, np.zeros((2, 3)), 2)
        self.fails("feed/shape", tactus.Engine, drag(), {"drag.position": (0, 0)})
        self.fails("run/length", engine.step_rows, None, -1)

    def test_a_set_value_ramps_and_hits_strike_once(self):
        engine = tactus.Engine(drag(), feed=FEED, record=["drag.force"])
        x = np.arange(400) * 1e-3
        forces = -engine.step({"drag.position": np.column_stack([x, 0 * x, 0 * x])})["drag.force"][:, 0]
        self.assertAlmostEqual(forces[-1], 0.4)
        engine.set("drag.mu", 0.8)
        forces = -engine.step({"drag.position": np.column_stack([0.4 + x, 0 * x, 0 * x])})["drag.force"][:, 0]
        self.assertLess(forces[0], 0.5)
        self.assertAlmostEqual(forces[-1], 0.8)
        self.assertLess(np.abs(np.diff(forces)).max(), 0.1)
        self.fails("param/unknown", engine.set, "drag.nu", 1)

    def test_a_hit_strikes_once(self):
        graph = tactus.Graph(rate=1000)
        graph.add_node("hold", "signal.sample_hold")
        engine = tactus.Engine(graph, feed={"hold.in": 0.0}, record=["hold.out"])
        engine.step({"hold.in": 1.0}, n=3)
        engine.hit("hold.hit", 0.5)
        self.assertEqual(engine.step({"hold.in": [2.0, 3.0, 4.0]})["hold.out"].tolist(), [2, 2, 2])
        self.fails("hit/value", engine.hit, "hold.hit", 1e9)

    def test_a_control_moves_its_targets(self):
        engine = tactus.Engine(tactus.Graph(GRAPHS / "dry_wood.json"), record=["motor.force"])
        other = tactus.Engine(tactus.Graph(GRAPHS / "dry_wood.json"), record=["motor.force"])
        engine.control("roughness", 1.0)
        self.assertGreater(np.ptp(engine.step(n=8000)["motor.force"] - other.step(n=8000)["motor.force"]), 0.01)
        self.fails("control/unknown", engine.control, "smoothness", 1)

    def test_an_interrupted_step_is_counted(self):
        engine = tactus.Engine(drag(), feed=FEED, record=["drag.state"])
        with self.assertRaises(KeyboardInterrupt):
            while_busy(_thread.interrupt_main)
            engine.step(n=10**8)
        self.assertGreater(engine.ticks, 0)
        self.assertEqual(engine.step()["t"][0], (engine.ticks - 1) / 1000)

    def test_an_edit_takes_over_without_a_step_of_the_state(self):
        graph = drag()
        engine = tactus.Engine(graph, feed=FEED, record=["drag.force"])
        engine.step()
        before = engine.step({"drag.position": (1e-3, 0, 0)})["drag.force"]
        self.assertAlmostEqual(before[0, 0], -0.4)
        graph.add_node("more", "signal.gain")
        engine.edit(graph)
        self.same_bits(before, engine.step()["drag.force"])
        self.fails("wire/width", graph.connect, "drag.force", "more.in")
        wrong = tactus.Graph.parse(graph.text.replace("signal.gain", "signal.gian"))   # a file may be wrong
        self.fails("node/unknown_type", engine.edit, wrong)
        self.same_bits(before, engine.step()["drag.force"])


class OwnDevices(TestCase):
    def test_readings_are_pushed_and_efforts_taken(self):
        _, engine = wall()
        self.same_bits(engine.take("pen").force, np.zeros(3))
        engine.push("pen", (0, 0, -1e-3))
        engine.step()
        effort = engine.take("pen")
        np.testing.assert_allclose(effort.force, (0, 0, 1.0))
        self.assertEqual((effort.torque.shape, effort.axes.shape, effort.signals.shape), ((3,), (0,), (0,)))
        self.fails("device/reading", engine.push, "pen", (0, 0))
        self.fails("device/not_pushed", engine.push, "other", (0, 0, 0))
        self.fails("device/not_pushed", engine.take, "other")

    def test_the_guard_acts_last_and_stops_end_with_rearm(self):
        _, engine = wall({"max_force": "3 N", "ramp": 0, "watchdog": "10 s"})   # one reading for all steps
        engine.push("pen", (0, 0, -1e-2))
        engine.step()
        np.testing.assert_allclose(engine.take("pen").force, (0, 0, 3.0))
        engine.emergency_stop()
        engine.step(n=100)
        self.same_bits(engine.take("pen").force, np.zeros(3))
        self.assertTrue(engine.status().is_emergency)
        engine.rearm()
        engine.step(n=2000)
        np.testing.assert_allclose(engine.take("pen").force, (0, 0, 3.0))

    def test_a_device_of_an_unknown_kind_or_role_is_refused(self):
        graph, _ = wall()
        self.fails("device/kind", tactus.Engine, graph, devices={"pen": 3})
        self.fails("api/unknown_role", tactus.Engine, graph, devices={"brush": tactus.PushedDevice()})
        self.fails("device/unknown_key", tactus.Engine, graph, devices={"pen": {"driver": "sim", "weight": 3}})


class Brakes(TestCase):
    def test_a_brake_gets_its_damping_within_what_the_device_has(self):
        graph = tactus.Graph(rate=1000)
        graph.add_node("amount", "signal.constant", {"value": 7})
        graph.add_node("brake", "device.brake", role="pen")
        graph.connect("amount.out", "brake.damping")
        engine = tactus.Engine(graph, devices={"pen": tactus.PushedDevice(brake=5.0)})
        engine.push("pen", (0, 0, 0))
        engine.step()
        self.assertEqual(engine.take("pen").brake, 5.0)


class Live(TestCase):
    def test_a_live_run_has_the_bits_of_the_render(self):
        graph = tactus.Graph(GRAPHS / "dry_wood.json")
        engine = tactus.Engine(graph)
        self.addCleanup(engine.stop)
        engine.start(duration=0.3)
        self.fails("engine/not_now", engine.step)
        parts = []

        def is_over():
            parts.append(engine.collect())
            return engine.status().phase == "over"
        self.assertTrue(eventually(is_over))
        parts.append(engine.collect())
        engine.stop()
        self.assertEqual(engine.lost, 0)
        whole = graph.render(duration=0.3)
        live = {port: np.concatenate([part[port] for part in parts]) for port in whole}
        self.assertGreaterEqual(len(live["t"]), len(whole["t"]))   # the live run adds ticks that bring the forces to zero
        for port in whole:
            self.same_bits(whole[port], live[port][:len(whole["t"])])

    def test_a_live_run_starts_once(self):
        with tactus.Engine(tactus.Graph(GRAPHS / "dry_wood.json")) as engine:
            engine.start()
            self.fails("engine/not_now", engine.start)
            engine.set("drag.mu", 0.1)
            engine.stop()
            self.fails("engine/not_now", engine.start)

    def test_an_interpreter_that_exits_stops_its_engines(self):
        script = f"import tactus\nengine = tactus.Engine(tactus.Graph({str(GRAPHS / 'dry_wood.json')!r}))\nengine.start()\nprint('started')"
        done = subprocess.run([sys.executable, "-W", "ignore", "-c", script], capture_output=True, text=True, timeout=120)
        self.assertEqual((done.returncode, done.stdout.strip(), done.stderr), (0, "started", ""))

    def test_threads_share_an_engine(self):
        engine = tactus.Engine(drag(), feed=FEED, record=["drag.force"])

        def work(i):
            for _ in range(50):
                if i % 2:
                    engine.set("drag.mu", 0.1 * i)
                else:
                    engine.step({"drag.position": positions(40, i)})
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            list(pool.map(work, range(4)))
        self.assertEqual(engine.status().phase, "idle")


if __name__ == "__main__":
    unittest.main()
