#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Steps longer than a tick: which readings the ticks get, which effort a step has, and what stiffness a simulated mass can hold with each rule, compared
with the eigenvalues of the loop and with the verdict of `tactus check`."""

import itertools
import json
import math
import subprocess
import tempfile
import unittest
import warnings

import numpy as np
import tactus
from support import PROGRAM, ROOT, TestCase, quiet

RATE = 4000
RULES = [("hold", "last"), ("hold", "mean"), ("linear", "last"), ("linear", "mean"), ("by_velocity", "last"), ("by_velocity", "mean")]


def spring(stiffness=100.0):
    """A spring to the origin, in all directions: force = -stiffness position."""
    graph = tactus.Graph(name="spring", rate=RATE)
    graph.add_node("hand", "device.position", role="tool")
    graph.add_node("motor", "device.force", role="tool")
    graph.connect("hand.position", "motor.force", gain=f"{-stiffness} N/m")
    return graph


def engine(graph, between="hold", step_effort="last", **options):
    device = tactus.PushedDevice(between=between, step_effort=step_effort, **options)
    return tactus.Engine(graph, record=["hand.position", "hand.rotation"], devices={"tool": device})


def step(run, ticks, *args, **kwargs):
    """Pushes, runs a step, and returns the effort of the step."""
    run.push("tool", *args, **kwargs)
    assert run.step(ticks / RATE) == ticks
    return run.take("tool")


class Steps(TestCase):
    def test_a_step_has_the_bits_of_its_ticks(self):
        path = np.cumsum(np.random.default_rng(1).normal(0, 1e-4, (50, 3)), axis=0)
        stepped, ticked = (quiet(tactus.Engine, tactus.Graph("dry_wood"), devices={"stylus": tactus.PushedDevice()}) for _ in range(2))
        for at in path:
            for run in (stepped, ticked):
                run.push("stylus", at)
            self.assertEqual(stepped.step(0.002), 8)
            ticked.step(n=8)
            self.same_bits(stepped.take("stylus").force, ticked.take("stylus").force)
        self.assertEqual(stepped.ticks, 400)

    def test_linear_and_by_velocity_have_the_bits_of_readings_that_are_pushed_tick_by_tick(self):
        start, then, n = np.array([1e-3, -2e-3, 5e-4]), np.array([3e-3, 1e-3, -5e-4]), 8
        speed = (then - start) / (n * (1 / RATE))
        for between, at in (("linear", lambda i: start + (i + 1) / n * (then - start) if i + 1 < n else then),
                            ("by_velocity", lambda i: then + i * (1 / RATE) * speed if i > 0 else then)):
            for effort in ("last", "mean"):
                with self.subTest(between=between, effort=effort):
                    stepped, ticked = (quiet(tactus.Engine, tactus.Graph("dry_wood"), devices={"stylus": device}) for device in (
                        tactus.PushedDevice(between=between, step_effort=effort), tactus.PushedDevice()))
                    for run in (stepped, ticked):
                        run.push("stylus", start)
                        run.step(n=1)
                    stepped.push("stylus", then)
                    stepped.step(n / RATE)
                    forces = []
                    for i in range(n):
                        ticked.push("stylus", at(i))
                        ticked.step(n=1)
                        forces.append(ticked.take("stylus").force)
                    expected = forces[-1] if effort == "last" else sum(forces[1:], forces[0]) / n
                    self.same_bits(stepped.take("stylus").force, expected)

    def test_a_velocity_that_is_given_counts(self):
        run = engine(spring(1.0), "by_velocity")
        force = step(run, 8, (1e-3, 0, 0), velocity=(0.5, 0, 0)).force
        self.assertAlmostEqual(force[0], -(1e-3 + 7 / RATE * 0.5), places=15)
        force = step(run, 8, (2e-3, 0, 0)).force   # not pushed with one: the way since the last step
        self.assertAlmostEqual(force[0], -(2e-3 + 7 * 1e-3 / 8), places=15)
        run.step(8 / RATE)                         # no reading came: the tool is held
        self.assertAlmostEqual(run.take("tool").force[0], -2e-3, places=15)

    def test_rotations_turn_the_shortest_way(self):
        graph = tactus.Graph(name="turn", rate=RATE)
        graph.add_node("hand", "device.position", role="tool")
        graph.add_node("motor", "device.force", role="tool")
        graph.connect("hand.rotation", "motor.torque", gain="1 N*m/rad")
        for between, steps, expected in (("linear", [(0, 0, 3.0), (0, 0, -3.0)], None), ("by_velocity", [(0, 0, 0.1), (0, 0, 0.2)], 0.2 + 0.1 * 7 / 8)):
            run = engine(graph, between)
            for rotation in steps:
                torque = step(run, 8, rotation=rotation).torque
            if expected is None:   # 3 and -3 rad are 0.28 rad apart, across half a turn; the last tick has the new reading
                self.same_bits(torque, (0, 0, -3.0))
                means = engine(graph, between, "mean")
                for rotation in steps:
                    torque = step(means, 2, rotation=rotation).torque   # the mean of half of the way, which is half a turn, and of -3 rad
                self.assertAlmostEqual(abs(torque[2] * 2 + 3.0), math.pi, places=12)
            else:
                self.assertAlmostEqual(torque[2], expected, places=12)

    def test_what_remains_of_a_period_is_kept(self):
        run = engine(spring())
        run.push("tool", (0, 0, 0))
        self.assertEqual([run.step(1 / 60) for _ in range(6)], [66, 67, 67, 66, 67, 67])
        self.assertEqual([run.step(0.0001) for _ in range(5)], [0, 0, 1, 0, 1])
        self.assertEqual(sum(run.step(0.001) for _ in range(1000)), 4000)

    def test_a_stop_is_not_late_in_a_mean(self):
        run = engine(spring(), "hold", "mean")
        self.assertAlmostEqual(step(run, 80, (1e-2, 0, 0)).force[0], -1.0, places=12)
        run.emergency_stop()
        self.assertEqual(step(run, 80, (1e-2, 0, 0)).force[0], 0.0)   # 20 ms, longer than the fade
        stale = engine(spring(), "by_velocity", "mean")
        step(stale, 8, (1e-2, 0, 0), velocity=(1, 0, 0))
        for _ in range(10):   # nothing is pushed for 200 ms
            stale.step(0.02)
        self.assertEqual(stale.take("tool").force[0], 0.0)

    def test_a_tool_that_is_no_longer_moved_loses_its_effort_after_the_watchdog(self):
        """The same times as in tests/framework/run/device/step_motion_test.cpp: 50 ms, or those of the guard, and a fade of 5 ms."""
        for (between, _), (guard, last, first) in itertools.product(RULES[::2], ((None, 10, 15), ({"watchdog": "30 ms"}, 5, 10))):
            run, forces = engine(spring(), between, guard=guard), []
            for k in range(40):
                if k < 10:
                    run.push("tool", (-2e-2, 0, 0))
                run.step(0.004)
                forces.append(run.take("tool").force[0])
            with self.subTest(between=between, guard=guard):
                self.assertAlmostEqual(min(forces[:11 + last]), 2.0, places=12)
                self.assertEqual(set(forces[10 + first:]), {0.0})

    def test_the_guard_of_a_preset_stops_a_simulated_tool_too_unless_the_graph_has_none(self):
        """A mass of 500 g that rests on dry wood: 30 N s in 10 s are over after 6 s."""
        mass, gravity, damping, dt = 0.5, 9.81, 10.0, 0.004
        for is_open in (False, True):
            graph = tactus.Graph("dry_wood")
            if is_open:
                graph.set_device("stylus", None)
            run = quiet(tactus.Engine, graph, devices={"stylus": tactus.PushedDevice(between="linear", simulated=True)})
            z, v, t, stop = 0.0, 0.0, 0.0, ""
            while t < 12.0 and z > -0.05:
                run.push("stylus", (0, 0, z))
                quiet(run.step, dt)
                effort = run.take("stylus")
                stop = stop or effort.stop and f"{effort.stop} after {t:.0f} s"
                v += dt * (effort.force[2] / mass - gravity - damping / mass * v)
                z += dt * v
                t += dt
            with self.subTest(is_open=is_open):
                if is_open:
                    self.assertEqual(stop, "")
                    self.assertAlmostEqual(effort.force[2], mass * gravity, delta=0.05)
                else:
                    self.assertEqual(stop, "impulse after 6 s")
                    self.assertLess(z, -0.05)   # it has fallen through

    def test_a_latched_stop_is_seen(self):
        """A loop that the guard has stopped learns it from the effort, and once from a warning. tests/framework/capi/c_api_guard_test.cpp has the numbers."""
        run = engine(spring(), guard={"max_impulse": "0.1 N*s", "impulse_window": "10 s"}, simulated=True)
        self.assertEqual(step(run, 8, (1e-2, 0, 0)).stop, "")
        before = run.save()
        with self.assertWarns(tactus.TactusWarning) as caught:
            for _ in range(60):   # 0.12 N s
                step(run, 8, (1e-2, 0, 0))
        message = caught.warning.message
        self.assertEqual((message.id, message.where), ("guard/stopped", "/devices/tool"))
        self.assertIn("the limit is 0.1 N*s in 10 s", message.text)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            effort = step(run, 8, (1e-2, 0, 0))
            self.assertEqual((effort.stop, effort.force[0]), ("impulse", 0.0))
            run.restore(before)
            self.assertEqual((run.take("tool").stop, step(run, 8, (1e-2, 0, 0)).stop), ("", ""))
            run.emergency_stop()   # which the program asked for
            self.assertEqual(step(run, 8, (1e-2, 0, 0)).stop, "emergency")

    def test_what_step_records_can_be_collected(self):
        run, other = engine(spring(), "linear"), engine(spring(), "linear")
        path = np.random.default_rng(2).normal(0, 1e-3, (30, 3))
        places = [np.zeros(3)]
        for k, at in enumerate(path):
            step(run, 8 + k % 3, at)
            places += [places[-1] + (i + 1) / (8 + k % 3) * (at - places[-1]) for i in range(8 + k % 3)] if k else [at] * 8
            places = places[1:] if k == 0 else places
        rows = run.collect()
        self.assertEqual(rows["hand.position"].shape, (270, 3))
        self.assertLess(np.max(abs(rows["hand.position"] - np.array(places))), 1e-15)
        self.assertAlmostEqual(rows["t"][-1], 269 / RATE)
        self.assertEqual((run.lost, len(run.collect()["t"])), (0, 0))
        quiet(run.step, n=5)   # returns its rows, and keeps none
        step(run, 8)
        self.assertEqual(len(run.collect()["t"]), 8)
        for _ in range(11):
            other.step(1.0)
        self.assertEqual((len(other.collect()["t"]), other.lost), (10 * RATE, RATE))

    def test_a_loop_that_does_not_use_the_rules_of_its_device_is_warned_once(self):
        for rules in (("linear", "last"), ("hold", "mean")):
            run = engine(spring(), *rules)
            run.push("tool")
            with self.assertWarns(tactus.TactusWarning) as caught:
                run.step(n=20)
            self.assertEqual(caught.warning.message.id, "step/rules")
            self.assertIn("step(0.005)", caught.warning.message.remedy)
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                run.step(n=20)
                engine(spring()).step(n=20)
                engine(spring(), *rules).step(n=1)

    def test_wrong_steps_are_refused(self):
        run = engine(spring())
        for wrong in (0.0, -1e-3, math.nan, 1.1, math.inf, 0, 2):
            self.fails("argument/value", run.step, wrong)
        self.fails("argument/type", run.step, True)
        self.fails("argument/value", run.step, 0.002, 8)
        self.fails("argument/type", engine, spring(), "spline")
        self.fails("argument/type", engine, spring(), "hold", "first")
        self.assertEqual(self.fails("argument/type", engine, spring(), "by velocity").remedy, "write 'by_velocity'")
        self.fails("device/reading", run.push, "tool", velocity=3.0)
        self.assertEqual(run.ticks, 0)


MASS, DAMPING = 0.5, 10.0 / 0.5 / RATE   # kg, and of the mass in 1/tick
METHODS = ("exact", "semi-implicit", "explicit")
PAGE_RULES = {"hold or linear, last": [("hold", "last"), ("linear", "last")], "hold, mean": [("hold", "mean")], "linear, mean": [("linear", "mean")],
              "by velocity, mean": [("by_velocity", "mean")], "by velocity, last": [("by_velocity", "last")]}


class Loop:
    """A mass on a spring in a simulator with steps of n ticks, which moves it by one of the methods of the page, and holds the effort from step to step. The
    unit of time is a tick, and that of mass the mass. `damping` is on the mass, beside the spring."""

    def __init__(self, n, method, rule, stiffness, damping=0.0):
        self.n, self.method, self.rule, self.stiffness, self.damping = n, method, rule, stiffness, damping

    def moved(self, x, v, a):
        """A step of the physics. x, v and a are numbers, or rows of a matrix."""
        n, b = self.n, self.damping
        if self.method == "exact":
            decay = math.exp(-b * n)
            gain, way = ((1 - decay) / b, (n - (1 - decay) / b) / b) if b else (n, n * n / 2)
            return x + gain * v + way * a, decay * v + gain * a
        faster = v + n * (a - b * v)
        return x + n * (faster if self.method == "semi-implicit" else v), faster

    def matrix(self):
        """Of a step, for x, v, and x of the step before."""
        between, effort = self.rule
        ticks = np.arange(1, self.n + 1) if effort == "mean" else np.array([self.n])
        new = (ticks / self.n).mean() if between == "linear" else 1.0
        lead = (ticks - 1).mean() if between == "by_velocity" else 0.0
        x, v, _ = np.eye(3)
        return np.array([*self.moved(x, v, -self.stiffness * np.array([new, lead, 1 - new])), x])

    def delay(self):
        """In ticks. A spring that is late by D makes a swing grow by exp(K D t/2)."""
        swing = max(np.linalg.eigvals(self.matrix()), key=lambda z: z.imag)
        return 2 * math.log(abs(swing)) / self.n / self.stiffness

    def played(self, steps):
        """x and v after each step, with the force of the library; x begins at 1 mm."""
        run = engine(spring(self.stiffness * MASS * RATE**2), *self.rule)
        x, v = 1e-3, 0.0
        step(run, self.n, (x, 0, 0))
        for _ in range(steps):
            force = step(run, self.n, (x, 0, 0), velocity=(v * RATE, 0, 0)).force[0]
            x, v = self.moved(x, v, force / MASS / RATE**2)
            yield x, v

    def grows(self):
        """True if the tool swings ever more, in a run."""
        size = []
        for x, v in self.played(1500):
            size.append(abs(x) + self.n * abs(v))
            if not 1e-12 < size[-1] < 1e3:
                break
        half = len(size) // 2
        return max(size[half:]) > max(size[:half])


def page_table(after):
    """The rows of the first table after a text in docs/steps.md: the rule, and the cells by method."""
    lines = (ROOT / "docs/steps.md").read_text(encoding="utf-8").split(after)[1].split("\n")
    first = next(k for k, line in enumerate(lines) if line.startswith("|"))
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in itertools.takewhile(lambda line: line.startswith("|"), lines[first:])]
    assert rows[0] == ["between, effort", *METHODS], rows[0]
    return {row[0]: dict(zip(rows[0][1:], row[1:])) for row in rows[2:]}


class Loops(TestCase):
    def test_the_delays_of_the_page_are_those_of_the_eigenvalues(self):
        table = page_table("The delay in ticks, for steps of")
        self.assertEqual(set(table), set(PAGE_RULES))
        for name, methods in table.items():
            for method, cell in methods.items():
                for rule, n in itertools.product(PAGE_RULES[name], (4, 8, 20, 80)):
                    stated = eval(cell.replace("*n*", "n").replace("3 n", "3*n"), {"n": n})
                    with self.subTest(rule=rule, method=method, ticks=n):
                        self.assertAlmostEqual(Loop(n, method, rule, 1e-6 / n**2).delay(), stated, delta=1e-3 * n)

    def test_the_rates_of_the_page_are_those_of_the_delays(self):
        for name, methods in page_table("this is:\n").items():
            for method, cell in methods.items():
                delay = Loop(8, method, PAGE_RULES[name][0], 1e-8).delay()
                with self.subTest(rule=name, method=method):
                    if cell == "no delay":
                        self.assertAlmostEqual(delay, 0.0, delta=1e-3)
                    else:
                        self.assertEqual(cell, f"{RATE / (2 * delay):.0f} Hz")

    def test_the_library_makes_these_loops(self):
        for method, rule, n in itertools.product(METHODS, RULES, (4, 20, 80)):
            loop = Loop(n, method, rule, 0.04 / n**2)   # a swing lasts 31 steps
            state = np.array([1e-3, 0.0, 1e-3])
            with self.subTest(method=method, rule=rule, ticks=n):
                for x, v in loop.played(100):
                    state = loop.matrix() @ state
                    self.assertAlmostEqual(x, state[0], delta=1e-9)
                    self.assertAlmostEqual(v, state[1], delta=1e-9)

    def test_a_mass_that_moves_exactly_comes_to_rest_up_to_the_stiffness_of_the_eigenvalues(self):
        for n, rule in itertools.product((4, 8, 20, 80), RULES[:4] + RULES[5:]):   # 1, 2, 5 and 20 ms
            low, high = 1e-9, 1.0
            while high / low > 1 + 1e-9:
                middle = math.sqrt(low * high)
                rests = max(abs(np.linalg.eigvals(Loop(n, "exact", rule, middle, DAMPING).matrix()))) < 1
                low, high = (middle, high) if rests else (low, middle)
            with self.subTest(ticks=n, rule=rule):
                self.assertFalse(Loop(n, "exact", rule, 0.98 * low, DAMPING).grows())
                self.assertTrue(Loop(n, "exact", rule, 1.02 * low, DAMPING).grows())

    def test_the_stiffness_that_semi_implicit_steps_without_delay_allow(self):
        n = 20   # as in docs/examples/steps/main.cpp
        most = (4 - 2 * DAMPING * n) / n**2
        self.assertIn(f"that is {most * MASS * RATE**2 / 1000:.0f} kN/m", (ROOT / "docs/steps.md").read_text(encoding="utf-8"))
        for rule, part in itertools.product(RULES[:3], (0.98, 1.02)):
            with self.subTest(rule=rule, part=part):
                self.assertEqual(Loop(n, "semi-implicit", rule, part * most, DAMPING).grows(), part > 1)

    @unittest.skipUnless(PROGRAM, "there is no program")
    def test_check_judges_such_a_loop_at_the_rate_of_the_page(self):
        for n, rule in ((4, ("linear", "last")), (20, ("hold", "mean")), (8, ("linear", "mean")), (80, ("linear", "mean"))):
            delay = n / 2 if rule != ("linear", "mean") else n - 1 / 2
            for part, is_passive in ((0.98, True), (1.02, False)):
                loop = Loop(n, "exact", rule, part * DAMPING / delay, DAMPING)   # 1: the largest stiffness that is passive
                with self.subTest(ticks=n, rule=rule, part=part), tempfile.NamedTemporaryFile("w", suffix=".json") as file:
                    graph = tactus.Graph(name="wall", rate=RATE)
                    graph.add_node("hand", "device.position", role="tool")
                    graph.add_node("wall", "deform.plane", {"stiffness": loop.stiffness * MASS * RATE**2})
                    graph.add_node("motor", "device.force", role="tool")
                    graph.connect("hand.position", "wall.position")
                    graph.connect("wall.force", "motor.force")
                    graph.set_device("tool", {"driver": "sim", "mass": MASS, "damping": DAMPING * MASS * RATE})
                    file.write(graph.text)
                    file.flush()
                    done = subprocess.run([PROGRAM, "check", file.name, "--json", "--rate", repr(RATE / (2 * delay))], capture_output=True, text=True)
                    condition = next(c for c in json.loads(done.stdout)["conditions"] if c["id"] == "stiffness")
                    self.assertEqual(condition["verdict"] in ("passive", "passive_here"), is_passive, condition)
                if is_passive:
                    self.assertFalse(loop.grows())


if __name__ == "__main__":
    unittest.main()
