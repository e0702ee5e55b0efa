# SPDX-License-Identifier: MIT
"""Mistakes that people type in Python: each is refused with an id, a place and a remedy, and in the words of Python."""

import math
import re
import unittest

import numpy as np
import tactus
from support import GRAPHS, TestCase, drag, why_not_live

WOOD = str(GRAPHS / "dry_wood.json")
CIRCLE = {"stylus": "gesture:circle"}
NOT_PYTHON = re.compile(r"--[a-z]|tactus_(run|graph|session|messages|text)_|incompatible (function|constructor) arguments|_tactus\.|0x[0-9a-f]{6}")


def graph():
    return tactus.Graph(WOOD)


def render(**options):
    return graph().render(**{"duration": 0.01, **options})


def engine(**options):
    return tactus.Engine(graph(), **options)


def pushed(**options):
    return engine(devices={"stylus": tactus.PushedDevice(**options)})


def fed():
    return tactus.Engine(drag(), feed={"drag.position": (0, 0, 0), "drag.normal_force": 1.0})


def play(**options):
    with tactus.play(WOOD, **{"device": CIRCLE, "session": "off", **options}):
        pass


# What was typed, what it is called (id), and where it is (part of the place).
MISTAKES = [
    # Graphs
    ("Graph(3)", lambda: tactus.Graph(3), "argument/type", "path"),
    ("a preset with a typing error", lambda: tactus.Graph("dry_wod"), "file/unreadable", "dry_wod"),
    ("a file that is not there", lambda: tactus.Graph("no/such.json"), "file/unreadable", "no/such.json"),
    ("a path with a null character", lambda: tactus.Graph("dry\0wood"), "argument/value", "path"),
    ("a path with half of a character", lambda: tactus.Graph("dry\ud800wood"), "argument/value", "path"),
    ("a rate as text", lambda: tactus.Graph(rate="4000"), "argument/type", "rate"),
    ("a rate that is not a number", lambda: tactus.Graph(rate=math.nan), "argument/value", "rate"),
    ("a file where text belongs", lambda: tactus.Graph.parse(GRAPHS / "dry_wood.json"), "argument/type", "text"),
    ("params as a list", lambda: graph().add_node("a", "signal.gain", ["gain"]), "argument/type", "params"),
    ("a name that is a number", lambda: graph().add_node(3, "signal.gain"), "argument/type", "name"),
    ("a parameter that is NaN", lambda: graph().set_param("drag", "mu", math.nan), "api/value", "drag.mu"),
    ("a parameter that is an object", lambda: graph().set_param("drag", "mu", object()), "api/value", "drag.mu"),
    ("a complex number", lambda: graph().set_param("drag", "mu", 1j), "api/value", "drag.mu"),
    ("a value that contains itself", lambda: graph().set_param("drag", "mu", _endless()), "api/value", "drag.mu"),
    ("a negative delay", lambda: graph().connect("hand.position", "drag.position", delay=-1), "argument/value", "delay"),
    ("a delay of half a tick", lambda: graph().connect("hand.position", "drag.position", delay=0.5), "argument/type", "delay"),
    ("a wire between numbers", lambda: graph().connect(1, 2), "argument/type", "start"),
    ("a device as text in a graph", lambda: graph().set_device("stylus", "sim"), "argument/type", "description"),
    ("an assignment to a view", lambda: _assign(graph().nodes, "new"), "view/read_only", "new"),
    ("an assignment to the params of a view", lambda: _assign(graph().nodes["drag"].params, "mu"), "view/read_only", "mu"),
    # Renders
    ("a duration as text", lambda: render(duration="1 s"), "argument/type", "duration"),
    ("a negative duration", lambda: render(duration=-1), "argument/value", "duration"),
    ("a duration of NaN", lambda: render(duration=math.nan), "argument/value", "duration"),
    ("a rate of 0", lambda: render(rate=0), "run/rate", "rate"),
    ("a rate as text in a render", lambda: render(rate="4 kHz"), "argument/type", "rate"),
    ("a record that is a number", lambda: render(record=3), "argument/type", "record"),
    ("a record with a typing error", lambda: render(record=["drag.forc"]), "port/unknown", "drag.forc"),
    ("a record of an unknown node", lambda: render(record=["drug.force"]), "port/unknown_node", "drug.force"),
    ("set as a list", lambda: render(set=["drag.mu=0.3"]), "argument/type", "set"),
    ("set with numbers as keys", lambda: render(set={0: 0.3}), "argument/type", "set"),
    ("set out of range", lambda: render(set={"drag.mu": -1}), "param/out_of_range", "drag.mu"),
    ("set to the wrong unit", lambda: render(set={"drag.mu": "20 um"}), "param/unit", "drag.mu"),
    ("set to NaN", lambda: render(set={"drag.mu": math.nan}), "api/value", "drag.mu"),
    ("set without a node", lambda: render(set={"mu": 0.3}), "control/unknown", "mu"),
    ("set of an unknown parameter", lambda: render(set={"drag.nu": 0.3}), "param/unknown", "drag.nu"),
    ("devices as a list", lambda: render(devices=["stylus=sim"]), "argument/type", "devices"),
    ("a device that is a number", lambda: render(devices={"stylus": 3}), "device/kind", "stylus"),
    ("a device with a typing error", lambda: render(devices={"stylus": "gestur:circle"}), "device/option", "stylus"),
    ("a device of an unknown role", lambda: render(devices={"pen": "sim"}), "api/unknown_role", "/devices"),
    ("a real device in a render", lambda: render(devices={"stylus": "hid:auto"}), "device/real", "/devices/stylus"),
    ("a device with an unknown key", lambda: render(devices={"stylus": {"driver": "sim", "weight": 3}}), "device/unknown_key", "weight"),
    ("a feed as a list", lambda: render(feed=[1, 2]), "argument/type", "feed"),
    ("a feed of text", lambda: render(feed={"drag.position": "here"}), "feed/type", "drag.position"),
    ("a feed of digits as text", lambda: render(feed={"drag.position": ["1", "2"]}), "feed/type", "drag.position"),
    ("a feed of complex numbers", lambda: render(feed={"drag.position": np.zeros((3, 3)) * 1j}), "feed/type", "drag.position"),
    ("a feed of uneven rows", lambda: render(feed={"drag.position": [[1, 2, 3], [1, 2]]}), "feed/type", "drag.position"),
    ("a feed with two columns", lambda: render(feed={"drag.position": np.zeros((5, 2))}), "feed/shape", "drag.position"),
    ("feeds of two lengths", lambda: render(feed={"drag.position": np.zeros((5, 3)), "drag.normal_force": [1, 2]}), "feed/shape", "feed"),
    ("a vector that is fed with one column", lambda: render(feed={"drag.position": [1, 2, 3]}), "feed/width", "drag.position"),
    ("nodes without a list", lambda: render(nodes=tactus.Node), "argument/type", "nodes"),
    ("nodes that are no classes", lambda: render(nodes=[3]), "node/kind", "nodes"),
    ("assets as a number", lambda: render(assets=3), "argument/type", "assets"),
    ("a budget with a typing error", lambda: tactus.set_limits("point=1M"), "limits/value", "set_limits"),
    ("an argument with a typing error", lambda: render(duratoin=1), "argument/unknown", "duratoin"),
    ("an argument of another function", lambda: tactus.play(WOOD, devices=CIRCLE), "argument/unknown", "devices"),
    ("a node without a type", lambda: graph().add_node("a"), "argument/count", "add_node"),
    ("too many arguments", lambda: tactus.Graph("dry_wood", "wood"), "argument/count", "Graph"),
    # Engines
    ("an engine of a path", lambda: tactus.Engine(WOOD), "argument/type", "graph"),
    ("a number of ticks with a point", lambda: engine().step(n=1.5), "argument/type", "n"),
    ("a negative number of ticks", lambda: engine().step(n=-1), "run/length", "n"),
    ("rows as text", lambda: engine().step_rows("rows"), "feed/type", "rows"),
    ("rows of the wrong shape", lambda: fed().step_rows(np.zeros((1, 3))), "feed/shape", "rows"),
    ("a step that feeds another port", lambda: fed().step({"drag.mu": 1}), "feed/unknown", "drag.mu"),
    ("a set of a number", lambda: engine().set(3, 1), "argument/type", "param"),
    ("a set out of range while it runs", lambda: engine().set("drag.mu", -1), "param/out_of_range", "drag.mu"),
    ("a control with a typing error", lambda: engine().control("roughnes", 1), "control/unknown", "roughnes"),
    ("a control beyond its end", lambda: engine().control("roughness", 2), "control/value", "roughness"),
    ("a control at NaN", lambda: engine().control("roughness", math.nan), "argument/value", "value"),
    ("a hit where none is taken", lambda: engine().hit("drag.hit", 1), "hit/unknown", "drag.hit"),
    ("an edit with text", lambda: engine().edit(WOOD), "argument/type", "graph"),
    ("a reading with two components", lambda: pushed().push("stylus", (0, 0)), "device/reading", "position"),
    ("a reading that is a number", lambda: pushed().push("stylus", 3), "device/reading", "position"),
    ("buttons as a float", lambda: pushed().push("stylus", buttons=1.5), "argument/type", "buttons"),
    ("a guard in the wrong unit", lambda: pushed(guard={"max_force": "3 m"}), "device/unit", "max_force"),
    ("a guard with a typing error", lambda: pushed(guard={"max_forc": "3 N"}), "device/unknown_key", "max_forc"),
    ("too many signals", lambda: pushed(signal_inputs=1000), "argument/value", "signal_inputs"),
    ("a brake below 0", lambda: pushed(brake=-1.0), "argument/value", "brake"),
    ("a buffer of less than nothing", lambda: engine().start(buffer=-1), "argument/value", "buffer"),
    # Sessions
    ("a session of a preset with a typing error", lambda: tactus.play("dry_wod"), "file/unreadable", "dry_wod"),
    ("a device option without =", lambda: play(device=["stylus"]), "device/option", "stylus"),
    ("an unknown driver", lambda: play(device={"stylus": "hyd:auto"}), "device/option", "stylus"),
    ("an unknown profile", lambda: play(device={"stylus": "hid:no_such"}), "hid/unknown_profile", "stylus"),
    ("a role that is not there", lambda: play(device={"pen": "gesture:circle"}), "device/unknown_role", "device"),
    ("a clock that is not there", lambda: play(clock="pen"), "run/no_clock", "pen"),
    ("a session file that is not there", lambda: play(session="no/such.json"), "session/unreadable", "no/such.json"),
    ("a log in a folder that is not there", lambda: play(log="no/such/run.log"), "output/unwritable", "no/such/run.log"),
    ("strict as text", lambda: play(strict="yes"), "argument/type", "strict"),
    ("a core as text", lambda: play(core="0"), "argument/type", "core"),
    ("a callback that is no function", lambda: play(callback=3, record=["motor.force"]), "argument/type", "callback"),
    ("a callback without records", lambda: play(callback=print), "argument/value", "callback"),
    # The rest
    ("a sweep over one value", lambda: tactus.sweep(graph(), {"drag.mu": 0.3}), "argument/type", "drag.mu"),
    ("a sweep over text", lambda: tactus.sweep(graph(), {"drag.d_max": "20 um"}), "argument/type", "drag.d_max"),
    ("a plot of a number", lambda: tactus.plot(3), "argument/type", "records"),
    ("a range of one number", lambda: tactus.scalar(hard=3), "argument/type", "range"),
    ("a default that is not a choice", lambda: tactus.choice(["smooth", "rough"], default="ruff"), "node/default", "default"),
]


def _endless():
    value = []
    value.append(value)
    return value


def _assign(view, name):
    view[name] = 0.3


class Mistakes(TestCase):
    def test_each_is_refused_with_its_place_and_a_remedy_in_the_words_of_python(self):
        without_library = bool(why_not_live())
        for typed, make, id, where in MISTAKES:
            with self.subTest(typed):
                if without_library and "play" in make.__code__.co_names:
                    continue
                with self.assertRaises(tactus.Error) as caught:
                    make()
                why = next(m for m in caught.exception.messages if m.is_error)
                self.assertEqual(why.id, id)
                self.assertIn(where, why.where, why)
                self.assertTrue(why.text and why.remedy, why)
                self.assertIsNone(NOT_PYTHON.search(str(caught.exception)), str(caught.exception))

    def test_there_are_at_least_forty_different_ones(self):
        self.assertGreaterEqual(len({typed for typed, *_ in MISTAKES}), 40)
        self.assertEqual(len({typed for typed, *_ in MISTAKES}), len(MISTAKES))

    def test_a_refused_feed_leaves_the_engine_as_it_was(self):
        disturbed, other = (tactus.Engine(drag(), feed={"drag.position": (0, 0, 0), "drag.normal_force": 1.0}, record=["drag.force"]) for _ in range(2))
        for one in (disturbed, other):
            one.step({"drag.position": (1e-3, 0, 0)})
        for wrong in ({"drag.position": "here"}, {"drag.mu": 1}, {"drag.position": np.zeros((3, 2))}, {"drag.normal_force": 0, "drag.position": "here"}):
            self.assertRaises(tactus.Error, disturbed.step, wrong)
        self.assertEqual(disturbed.ticks, other.ticks)
        self.same_bits(disturbed.step(n=3)["drag.force"], other.step(n=3)["drag.force"])

    def test_numbers_of_numpy_are_numbers(self):
        run = graph().render(duration=np.float32(0.01), rate=np.int64(4000), set={"drag.mu": np.array(0.3)})
        self.assertEqual(len(run["t"]), 40)
        self.assertEqual(len(engine().step(n=np.int64(5))["t"]), 5)


if __name__ == "__main__":
    unittest.main()
