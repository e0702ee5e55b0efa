#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The state of a run: saved at any tick and restored in the same run or in another one, it goes on with the same bits. Two runs are compared by the bytes of
their states, which contain every output, every value under way, and what the guards have counted. tests/every_node_test.cpp examines each type of node
alone, and tests/python/plugins_test.py has nodes from plugins."""

import json
import tempfile
import unittest
from collections import deque

import numpy as np
import tactus
from support import GRAPHS, TestCase, drag, parts, quiet, with_checksum
from tactus import _own

PRESETS = sorted(GRAPHS.glob("*.json"))
SAVES = 1000   # over all presets


def picture(kind, path):
    """In place of the pictures of presets, which Python does not read."""
    return np.random.default_rng(1).random((40, 60)) if kind == "image" else None


def engine(graph, **options):
    return quiet(tactus.Engine, tactus.Graph(str(graph)) if not isinstance(graph, tactus.Graph) else graph, assets=picture, **options)


class EveryPreset(TestCase):
    def test_random_saves_and_restores_have_the_bits_of_a_run_that_goes_on(self):
        each = -(-SAVES // len(PRESETS))
        total = 0
        for number, preset in enumerate(PRESETS):
            with self.subTest(preset=preset.name):
                random = np.random.default_rng(number)
                controls = list(json.loads(preset.read_text(encoding="utf-8")).get("controls", {}))
                run, other = engine(preset), engine(preset)
                start = run.save()
                other.step(n=int(random.integers(1, 300)))   # another past
                for _ in range(each):
                    run.step(n=int(random.integers(1, 120)))
                    if controls and random.random() < 0.3:
                        run.control(str(random.choice(controls)), float(random.random()))
                    state, n = run.save(), int(random.integers(1, 60))
                    self.assertEqual(run.save(), state)   # saving changes nothing
                    run.step(n=n)
                    after = run.save()
                    again = run if random.random() < 0.5 else other
                    again.restore(state)
                    self.assertEqual(again.save(), state)
                    again.step(n=n)
                    self.assertEqual(again.save(), after)
                    total += 1
                run.restore(start)   # a reset
                fresh = engine(preset)
                self.assertEqual(run.save(), fresh.save())
                for one in (run, fresh):
                    one.step(n=100)
                self.assertEqual(run.save(), fresh.save())
        self.assertGreaterEqual(total, SAVES)


class Count(tactus.Node):
    """Has a state that Tactus does not know."""
    id = "own.count"
    outputs = {"out": tactus.scalar("1")}

    def prepare(self, rate_hz):
        self.n = 0

    def tick(self, inputs, params):
        self.n += 1
        return {"out": self.n}


class Remembering(tactus.Node):
    """Has a state of each kind."""
    id = "own.remembering"
    outputs = {"out": tactus.scalar("1")}
    state = ("n", "past", "seen", "dice")

    def prepare(self, rate_hz):
        self.n, self.seen, self.past = 0, {"mean": -0.0, (1, None): [True, "a"]}, deque([0.0], maxlen=3)
        self.window, self.random = np.zeros((2, 3)), np.random.default_rng(1)

    @property
    def dice(self):
        return [self.random.bit_generator.state, self.window, self.window[0, 0]]

    @dice.setter
    def dice(self, state):
        self.random.bit_generator.state, self.window = state[:2]

    def tick(self, inputs, params):
        self.n += 1
        self.window[self.n % 2, self.n % 3] += self.random.normal()
        self.past.append(float(self.window.sum()))
        self.seen["mean"] += self.past[0] / 3
        return {"out": self.seen["mean"] + self.n}


class NodesInPython(TestCase):
    def engine(self, kind):
        graph = tactus.Graph(name="count", rate=1000)
        graph.add_node("here", kind.id)
        return engine(graph, nodes=[kind], record=["here.out"])

    def test_a_run_goes_on_where_it_was_saved(self):
        run, clone = self.engine(Remembering), self.engine(Remembering)
        run.step(n=40)
        clone.step(n=7)
        state = run.save()
        expected = run.step(n=50)["here.out"]
        for again in (run, clone):
            again.restore(state)
            self.assertEqual(again.save(), state)
            self.same_bits(again.step(n=50)["here.out"], expected)

    def test_values_keep_their_types(self):
        nan = float("nan")
        for value in (1, True, -0.0, 1e-320, nan, "\0é", None, 2 ** 200, [], (1, [2.5]), deque([1], 2), deque(), {"a": 1}, {1.5: (None,)}, np.float32(1.1),
                      np.int8(-3), np.array(2.0), np.zeros((0, 3)), np.array([[1 + 2j]]), np.arange(6.0).reshape(2, 3).T, np.array([True, False]),
                      [np.uint64(2 ** 63)]):
            back = _own._restored(json.loads(json.dumps(_own._plain(value))))
            self.assertIs(type(back), type(value))
            self.assertEqual(repr(back), repr(value))
            self.assertEqual(getattr(back, "dtype", None), getattr(value, "dtype", None))
        for wrong in (np.random.default_rng(1), np.array([None]), {1, 2}, [lambda: 0], np.datetime64("2026-01-01"), 1j, TestCase):
            with self.assertRaisesRegex(TypeError, "cannot be saved"):
                _own._plain(wrong)

    def test_a_state_that_does_not_fit_is_refused_and_changes_nothing(self):
        run = self.engine(Remembering)
        run.step(n=5)
        state = run.save()
        head, payload = parts(state)
        start = payload.index(b'{"n": 5')
        length = int.from_bytes(payload[start - 8:start], "little")
        text = payload[start:start + length].decode()
        for old, new in (('"n"', '"m"'), ('{"n": 5', '["n", 5'), ("<f8", "|O8"), ("<f8", "<f9"), ('"shape": [2, 3]', '"shape": [3, 3]'), ("deque", "open"),
                         ('"PCG64"', '"PCG65"'), (text, ""), (text, "[" * length)):
            forged = text.replace(old, new, 1).encode()
            self.assertNotEqual(forged, text.encode())
            whole = payload[:start - 8] + len(forged).to_bytes(8, "little") + forged + payload[start + length:]
            self.fails("state/graph", run.restore, with_checksum(head, whole))
            self.assertEqual(run.save(), state)
        for size in (length - 1, 2 ** 63):
            self.fails("state/graph", run.restore, with_checksum(head, payload[:start - 8] + size.to_bytes(8, "little") + payload[start:]))
        self.assertEqual(run.save(), state)

    def test_what_a_class_must_say(self):
        refused = self.fails("state/refused", self.engine(Count).save)
        self.assertIn("'here'", refused.text)
        self.assertIn("Count", refused.text)

        class Late(Remembering):
            id = "own.late"
            state = ("nothing",)
        self.assertIn("nothing", self.fails("state/refused", self.engine(Late).save).text)

        class Unchanging(Remembering):
            id = "own.unchanging"
            state = ()
        run = self.engine(Unchanging)
        run.restore(run.save())


class Refusals(TestCase):
    def test_states_that_do_not_fit_change_nothing(self):
        run = engine(GRAPHS / "dry_wood.json")
        run.step(n=100)
        state = run.save()
        head, payload = parts(state)
        self.assertEqual(with_checksum(head, payload), state)
        other = engine(GRAPHS / "denim.json").save()
        faster = engine(GRAPHS / "dry_wood.json", rate=8000).save()
        edited = tactus.Graph(str(GRAPHS / "dry_wood.json"))
        edited.set_param("drag", "mu", 0.9)
        for id, wrong in (("state/format", b""), ("state/format", b"hello"), ("state/graph", other), ("state/graph", faster),
                          ("state/graph", engine(edited).save()), ("state/damaged", state[:-1]),
                          ("state/damaged", state + b"\0"), ("state/damaged", state[:-1] + bytes([state[-1] ^ 1])), ("state/damaged", head),
                          ("state/format", state.replace(b" 0.", b" 9.", 1)), ("state/graph", with_checksum(head, payload + b"\0")),
                          ("state/graph", with_checksum(head, payload[:-1]))):
            self.fails(id, run.restore, wrong)
            self.assertEqual(run.save(), state)
        self.fails("argument/type", run.restore, "text")

    def test_a_state_of_other_devices_or_rules_is_refused(self):
        def made(**options):
            return engine(GRAPHS / "dry_wood.json", devices={"stylus": tactus.PushedDevice(simulated=True, **options)})
        same = made(between="linear", step_effort="mean", axes=["x"], guard={"max_force": "3 N"})
        same.push("stylus", (0, 0, -1e-4), axes=[0.5])
        quiet(same.step, 0.01)
        state = same.save()
        other = made(between="linear", step_effort="mean", axes=["x"], guard={"max_force": "2 N", "watchdog": "20 ms"})
        other.restore(state)   # limits may differ
        self.assertEqual(parts(other.save()), parts(state))
        for words, options in (("rules for steps", {"step_effort": "mean", "axes": ["x"]}), ("rules for steps", {"between": "linear", "axes": ["x"]}),
                               ("other devices", {"axes": ["y"]}), ("other devices", {}), ("other devices", {"axes": ["x"], "signal_outputs": 1}),
                               ("other devices", {"axes": ["x"], "buttons": ["down"]}), ("other devices", {"axes": ["x"], "brake": 3.0}),
                               ("other devices", {"axes": ["x"], "efforts": ["x"]})):
            rules = {} if words == "rules for steps" else {"between": "linear", "step_effort": "mean"}
            run = made(**{**rules, **options})
            before = run.save()
            with self.subTest(options=options):
                why = self.fails("state/graph", run.restore, state)
                self.assertIn(words, why.text)
                self.assertEqual(run.save(), before)
        old = self.fails("state/format", same.restore, state.replace(b"state\n2 ", b"state\n1 ", 1))
        self.assertIn("another build", old.text)

    def test_a_restored_run_gives_no_more_than_the_limits_of_now(self):
        graph = tactus.Graph(name="push", rate=1000)
        graph.add_node("push", "signal.constant", {"value": "4 N"})
        graph.add_node("motor", "device.force", role="tool")
        graph.connect("push.out", "motor.force.x")
        graph.connect("push.out", "motor.force.y")

        def made(**guard):
            return engine(graph, devices={"tool": tactus.PushedDevice(simulated=True, guard={"max_slew": "100 N/s", **guard})})

        def force(run):
            return np.linalg.norm(run.take("tool").force)
        loose = made(max_force="5 N")
        for _ in range(200):
            loose.push("tool")
            loose.step(n=1)
        self.assertAlmostEqual(force(loose), 5.0, places=9)
        state = loose.save()
        tight, same = made(max_force="2 N"), made(max_force="5 N")
        for run, most in ((tight, 2.0), (same, 5.0)):
            run.restore(state)
            self.assertAlmostEqual(force(run), most, places=9)
            for _ in range(20):
                run.push("tool")
                run.step(n=1)
                self.assertLessEqual(force(run), most * (1 + 1e-9))
        self.same_bits(same.take("tool").force, loose.take("tool").force)

    def test_forged_states_are_refused_or_run(self):
        """Whatever the bytes are, nothing crashes (this test runs with the address sanitizer, too)."""
        random = np.random.default_rng(3)
        for preset in PRESETS:
            run = engine(preset)
            run.step(n=200)
            head, payload = parts(run.save())
            for _ in range(20):
                forged = bytearray(payload)
                for at in random.integers(0, len(forged), int(random.integers(1, 6))):
                    forged[at] = int(random.choice([0, 1, 127, 128, 255, int(random.integers(256))]))
                before = run.save()
                try:
                    run.restore(with_checksum(head, bytes(forged)))
                except tactus.Error as why:
                    if why.id == "state/stopped":  # a forged state has pressed the emergency stop, which no state undoes
                        run = engine(preset)
                        continue
                    self.assertEqual(why.id, "state/graph")
                    self.assertEqual(run.save(), before)
                run.step(n=20)

    def test_what_cannot_be_saved_is_named(self):
        held = engine(GRAPHS / "dry_wood.json", devices={"stylus": tactus.PushedDevice()})
        self.assertIn("'stylus'", str(self.fails("state/refused", held.save)))

        live = engine(GRAPHS / "dry_wood.json")
        live.start(duration=0.01)
        self.fails("engine/not_now", live.save)
        live.stop()


class Uses(TestCase):
    def pushed(self, **rules):
        return engine(GRAPHS / "dry_wood.json", devices={"stylus": tactus.PushedDevice(simulated=True, **rules)})

    def test_a_loop_of_steps_with_a_pushed_device(self):
        for rules in ({}, {"between": "linear", "step_effort": "mean"}, {"between": "by_velocity", "step_effort": "mean"}):
            with self.subTest(rules=rules):
                path = np.cumsum(np.random.default_rng(1).normal(0, 2e-4, (60, 3)), axis=0)

                def play(run, rows):
                    forces = []
                    for at in rows:
                        run.push("stylus", at)
                        run.step(1 / 60)   # a remainder is kept
                        forces.append(run.take("stylus").force)
                    return np.array(forces)
                run, clone = self.pushed(**rules), self.pushed(**rules)
                play(run, path[:30])
                state = run.save()
                last = run.take("stylus").force
                expected = play(run, path[30:])
                clone.restore(state)
                self.same_bits(clone.take("stylus").force, last)
                self.same_bits(play(clone, path[30:]), expected)
                run.restore(state)
                self.same_bits(play(run, path[30:]), expected)

    def test_a_trace_and_a_gesture_go_on_where_they_were(self):
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as trace:
            trace.write("t,x,y,z\n" + "".join(f"{k / 100},{k % 7 / 1e4},0,{-k % 5 / 1e4}\n" for k in range(200)))
            trace.flush()
            for device in (f"trace:{trace.name}", "gesture:circle"):
                with self.subTest(device=device):
                    run, clone = (engine(GRAPHS / "dry_wood.json", devices={"stylus": device}) for _ in range(2))
                    run.step(n=500)
                    state = run.save()
                    run.step(n=300)
                    clone.restore(state)
                    clone.step(n=300)
                    self.assertEqual(clone.save(), run.save())

    def test_what_was_set_before_the_state_is_in_it(self):
        run, other = engine(drag(), feed={"drag.position": np.zeros(3)}), engine(drag(), feed={"drag.position": np.zeros(3)})
        run.set("drag.mu", 0.7)       # before the first tick: at once
        state = run.save()
        other.restore(state)
        self.assertEqual(other.save(), state)
        run.step(n=10)
        run.set("drag.mu", 0.2)       # a ramp, which has not begun
        state = run.save()
        run.step(n=500)
        after = run.save()
        other.restore(state)
        other.step(n=500)
        self.assertEqual(other.save(), after)
        fresh = engine(drag(), feed={"drag.position": np.zeros(3)})
        start = fresh.save()
        fresh.step(n=5)
        fresh.restore(start)
        fresh.set("drag.mu", 0.9)     # before the first tick again: at once
        again = engine(drag(), feed={"drag.position": np.zeros(3)})
        again.set("drag.mu", 0.9)
        for one in (fresh, again):
            one.step(n=1)
        self.assertEqual(fresh.save(), again.save())

    def test_a_stop_is_not_undone(self):
        run = engine(GRAPHS / "dry_wood.json")
        run.step(n=400)
        before = run.save()
        run.emergency_stop()
        self.fails("state/stopped", run.restore, before)
        run.step(n=400)
        stopped = run.save()
        self.fails("state/stopped", run.restore, before)
        run.rearm()
        run.restore(stopped)          # a state of a stop is one
        self.assertTrue(run.status().is_emergency)
        run.step(n=100)
        run.rearm()
        run.restore(before)
        run.step(n=1)
        self.assertFalse(run.status().is_emergency)

    def test_an_edited_graph_is_another_one(self):
        graph = tactus.Graph(str(GRAPHS / "dry_wood.json"))
        run = engine(graph)
        run.step(n=10)
        state = run.save()
        graph.add_node("more", "signal.constant")
        run.edit(graph)
        self.fails("state/edit", run.save)
        run.step(n=1)
        self.fails("state/graph", run.restore, state)
        edited = run.save()
        run.step(n=10)
        run.restore(edited)
        self.assertEqual(run.save(), edited)


if __name__ == "__main__":
    unittest.main()
