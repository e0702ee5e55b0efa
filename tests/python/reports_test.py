#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""check, limits, fit, convert, devices, logs and replays from Python: the same numbers as the commands, as objects with units, intervals and verdicts."""

import _thread
import importlib.util
import json
import math
import os
import pathlib
import pickle
import re
import threading
import unittest
import wave

import numpy as np
import tactus
from support import ROOT, TestCase, needs_live
from tactus import lab
from waiting import eventually, while_busy

needs_live()
os.environ["MPLBACKEND"] = "Agg"
HOSTILE = "<script>alert(1)</script>"


def strokes(rows=4000):
    """A tool that sticks and slides: mu 0.3, 1 N, stretched by at most 0.2 mm. With the noise of a sensor."""
    t = np.arange(rows) / 1000.0
    x = 3e-3 * np.sin(2.0 * np.pi * 1.0 * t)
    stretch, force = 0.0, []
    for step in np.diff(x, prepend=x[0]):
        stretch = min(max(stretch + step, -2e-4), 2e-4)
        force.append(-0.3 * stretch / 2e-4)
    return x, np.array(force) + 1e-3 * np.random.default_rng(1).standard_normal(rows)


class ReportsAndLogs(TestCase):
    def said(self, *words, **more):
        return json.loads(self.ran(*words, "--json", **more))

    def test_a_check_is_that_of_the_command_and_a_broken_condition_is_no_error(self):
        found = tactus.check("granite_wall")
        self.assertEqual(found.json, self.said("check", "granite_wall"))
        self.assertTrue(found.not_judged and not found.is_broken)
        first = found.conditions[0]
        self.assertEqual((first.role, first.unit, first.verdict), ("stylus", "N*s/m", "passive_here"))
        self.assertIn("not judged", found._repr_html_())
        self.assertIn("no judged condition is broken", repr(found))
        found = tactus.check(tactus.Graph("granite_wall"), devices={"stylus": "tactus_board"}, set={"wall.stiffness": 1e5}, rate=500.0)
        self.assertEqual(found.json, self.said("check", "granite_wall", "--device", "stylus=tactus_board", "--set", "wall.stiffness=1e5", "--rate", 500,
                                               status=1))
        self.assertTrue(found.is_broken and any(c.is_broken for c in found.conditions))
        self.assertEqual(tactus.check("pebbled_leather").json, self.said("check", "pebbled_leather"))   # it reads a picture

    def test_limits_are_those_of_the_command(self):
        found = tactus.limits("granite_wall")
        self.assertEqual(found.json, self.said("limits", "granite_wall"))
        self.assertEqual((found.role, found.rate), ("stylus", 2000.0))
        self.assertLess(found.stiffness, found.stable["stiffness"].high)
        self.assertIn("passive (sufficient)", found._repr_html_())
        self.fails("plot/nothing", found.plot)
        points = tactus.limits("granite_wall", x="wall.stiffness=500:4000", y="rate=1000:4000", steps=4)
        self.assertEqual(points.points.shape, (25, len(points.columns)))
        self.ran("limits", "granite_wall", "--x", "wall.stiffness=500:4000", "--y", "rate=1000:4000", "--steps", 4, "-o", "l.csv")
        self.assertEqual((self.folder / "l.csv").read_text().splitlines()[0], ",".join(points.columns))
        self.same_bits(np.loadtxt(self.folder / "l.csv", delimiter=",", skiprows=1), points.points)

    def test_a_fit_is_that_of_the_command_from_a_file_and_from_arrays(self):
        x, force = strokes()
        lab.Table({"position": x, "force": force}).write(self.folder / "strokes.csv")
        told = self.said("fit", "friction", "strokes.csv", "-o", "wood.json", "--load", "2 N")
        del told["recording"], told["preset"]
        fits = [tactus.fit("friction", self.folder / "strokes.csv", options={"load": "2 N"}),
                tactus.fit("friction", {"position": x, "force": force}, options={"load": 2.0}),
                tactus.fit("friction", {"a [mm]": 1e3 * x, "b": 1e3 * force}, columns={"position": "a [mm]", "force": "b"}, units={"force": "1 mN"},
                           options={"load": 2.0})]
        for fit in fits[:2]:
            self.assertEqual({key: fit.json[key] for key in told}, told)
        mu = fits[0].values["mu"]
        self.assertTrue(mu.low < 0.15 < mu.high and mu.unit in ("", "1"), mu)   # 0.3 N at 2 N
        self.assertAlmostEqual(fits[2].values["mu"].value, mu.value, places=6)
        self.assertEqual((fits[0].verdict, fits[0].rows), (told["verdict"], 4000))
        written = tactus.Graph(self.folder / "wood.json")
        self.assertEqual({n.type for n in fits[0].graph.nodes.values()}, {n.type for n in written.nodes.values()})
        self.assertEqual(fits[0].graph.nodes["drag"].params["mu"], written.nodes["drag"].params["mu"])
        self.assertIn("95 % interval", fits[0]._repr_html_())

    def test_devices_are_those_of_the_command(self):
        found = tactus.devices()
        self.assertEqual(list(found), [d for d in self.said("devices") if d.get("driver") != "audio"])
        self.assertIn("<table>", found._repr_html_())

    def test_a_conversion_is_that_of_the_command(self):
        clip, wav, pen = ROOT / "graphs/assets/heartbeat.haptic", self.folder / "a.wav", self.folder / "pen.events"
        pen.write_text("".join(f"E: 0.0{t}0000 {event}\n" for t in (0, 1) for event in
                               (f"0003 0000 {1000 + 200 * t}", "0003 0001 500", "0003 0018 1024", "0000 0000 0")))
        for source, name, options, words in ((clip, "a.ahap", {}, []), (clip, "a.hjif", {}, []), (clip, "a.csv", {"rate": 500.0}, ["--rate", "500"]),
                                             (clip, "a.wav", {}, []), (clip, "b.ahap", {"split": True}, ["--split"]), (wav, "d.hjif", {}, []),
                                             (pen, "pen.csv", {"options": {"force": 2.0}}, ["--force", "2 N"])):
            with self.subTest(name=name):
                made = tactus.convert(source, self.folder / name, **options)
                told = self.ran("convert", source, f"c_{name}", *words)
                for file in map(pathlib.Path, made.files):
                    self.assertEqual(file.read_bytes(), (self.folder / f"c_{file.name}").read_bytes())
                said = [sentence.replace(str(self.folder / name), f"c_{name}") for file in made.json["files"] for sentence in
                        [*(f"{loss['where']}: {loss['text']}" for loss in file["losses"]), *file["differences"]]]
                self.assertEqual(said, re.findall(r"  loss: (.*)", told))
                self.assertEqual(len(said), len(made.losses) + len(made.differences))
                self.assertIn("wrote", made._repr_html_())
        for id, source, name, options in (("wav/not_a_wav", pen.rename(wav), "e.ahap", {}), ("clip/unknown_kind", clip, "d.xyz", {}),
                                          ("api/option", clip, "d.hjif", {"split": True}), ("api/option", clip, "d.hjif", {"options": {"pitch": 1e-6}}),
                                          ("file/unreadable", self.folder / "none.ahap", "d.hjif", {}), ("output/is_input", clip, clip, {})):
            self.fails(id, tactus.convert, source, self.folder / name, **options)

    def test_recordings_are_read(self):
        t = np.arange(8000) / 8000.0
        ring = 20000.0 * np.exp(-8.0 * t) * np.sin(2.0 * np.pi * 440.0 * t)
        with wave.open(str(self.folder / "bell.wav"), "wb") as file:
            file.setparams((1, 2, 8000, 0, "NONE", ""))
            file.writeframes(ring.astype("<i2").tobytes())
        told = self.said("fit", "modes", "bell.wav", "-o", "bell.json")
        self.assertEqual(tactus.fit("modes", self.folder / "bell.wav").json["parameters"], told["parameters"])
        self.assertTrue(any(p["unit"] == "Hz" and abs(p["value"] - 440.0) < 0.5 for p in told["parameters"]), told["parameters"])

    def test_ctrl_c_ends_a_wait_at_once(self):
        graph = tactus.Graph("granite_wall")
        with self.assertRaises(KeyboardInterrupt):
            while_busy(_thread.interrupt_main)
            tactus.limits(graph, steps=400)   # takes minutes
        self.assertTrue(eventually(lambda: not any(thread.name.startswith("ThreadPool") for thread in threading.enumerate())))
        self.assertEqual(tactus.limits(graph, steps=2).columns[0], "rate (Hz)")

    def test_mistakes_have_a_place_a_cause_and_a_remedy(self):
        x, force = strokes(200)
        held, wall = {"position": x, "force": force}, ("granite_wall",)
        for id, call, given, more in (
                ("fit/column", tactus.fit, ("friction", {"a": x, "b": force}), {}), ("api/option", tactus.fit, ("wood", held), {}),
                *(("fit/option", tactus.fit, ("friction", held), {"options": options}) for options in ({"lod": 1}, {"load": "2 m"}, {"load": -1})),
                ("fit/option", tactus.fit, ("friction", held), {"columns": {"depth": "a"}}), ("wav/unreadable", tactus.fit, ("modes", "bell.wav"), {}),
                ("feed/shape", tactus.fit, ("friction", {**held, "force": force[1:]}), {}), ("argument/type", tactus.fit, ("friction", 3), {}),
                ("device/unknown_role", tactus.check, wall, {"devices": {"pen": "tactus_board"}}), ("api/option", tactus.check, wall, {"rate": 1.0}),
                ("port/unknown_node", tactus.check, wall, {"set": {"wal.stiffness": 1}}), ("argument/unknown", tactus.check, wall, {"sped": 1}),
                ("file/unreadable", tactus.check, ("granit_wall",), {}), ("api/option", tactus.limits, wall, {"x": "stiffness=0:1"}),
                ("limits/axis", tactus.limits, wall, {"x": "none.x=0:1", "y": "rate=500:600"})):
            with self.subTest(id=id):
                self.assertTrue(self.fails(id, call, *given, **more).remedy)

    def test_text_of_files_never_becomes_markup(self):
        report = tactus.check("granite_wall").json
        report["conditions"][0]["role"] = report["not_judged"][0]["what"] = report["scope"] = HOSTILE
        fit = tactus.Fit({"kind": HOSTILE, "verdict": "poor", "parameters": [], "lacking": [HOSTILE], "notes": [HOSTILE], "rows": 0,
                          "residual": {"rms": None, "left_out_rms": None, "recording_rms": 1, "unit": HOSTILE}})
        for shown in (tactus.Check(report), fit, tactus.Devices([{"product": HOSTILE}])):
            self.assertNotIn("<script", shown._repr_html_())

    @unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is not installed")
    def test_pictures_are_drawn(self):
        fit, limits = tactus.fit("friction", dict(zip(("position", "force"), strokes()))), tactus.limits("granite_wall", steps=3)
        self.assertGreaterEqual(len(fit.plot().axes[0].lines), 2)
        self.assertIn("stiffness", limits.plot().axes[0].get_xlabel())

    def played(self, name="run.jsonl"):
        """The log of a run in real time, and what it has recorded."""
        log = self.folder / name
        with tactus.play("dry_wood", {"stylus": "gesture:circle"}, session="off", record=["motor.force"], log=str(log), buffer=60.0) as session:
            session.set("drag.mu", 0.31)
            self.assertTrue(eventually(lambda: session.status().ticks >= 3000))
            session.stop()
            return log, session.collect()

    def test_a_log_is_read_as_arrays_and_played_again_with_the_same_bits(self):
        for name in ("run.jsonl", "run.tlog"):
            with self.subTest(name=name):
                before = lab.Silent().now()
                log, felt = self.played(name)
                read = tactus.read_log(log)
                after = lab.Silent().now()
                self.assertTrue(before.monotonic <= read.monotonic <= after.monotonic)
                self.assertAlmostEqual(read.wall - read.monotonic, after.wall - after.monotonic, delta=1.0)
                self.assertEqual((read.units["stylus.position"], read.units["passed"], read.rate_hz), ("m", "s", 4000.0))
                self.assertIn(("turn", "drag.mu", 0.31), [(e.kind, e.name, e.value) for e in read.events])
                self.assertFalse(read.is_cut_off)
                again = tactus.replay(log, record=["motor.force", "hand.position"])
                rows = len(again["t"])
                self.same_bits(again["hand.position"], read["stylus.position"][:rows])
                self.same_bits(again["motor.force"], felt["motor.force"][:rows])
                self.assertGreaterEqual(rows, 3000)
                self.assertGreater(np.abs(felt["motor.force"]).max(), 0.1)   # it is felt
                for part, whole in ((tactus.replay(log, record=["motor.force"], start=0.6, until=0.65), again),
                                    (tactus.read_log(log, start=0.6, until=0.65), read)):
                    for port, values in part.items():
                        self.same_bits(values, whole[port][2400:2600])
                self.ran("render", "--replay", log, "--record", "motor.force", "--out", "r.csv")
                self.same_bits(np.loadtxt(self.folder / "r.csv", delimiter=",", skiprows=1)[:, 1:], again["motor.force"])
                self.ran("capture", log, "--from", "0.6", "--until", "0.65", "--test", "t.jsonl")
                self.ran("test", "t.jsonl")

    def test_marks_find_their_ticks(self):
        log = tactus.read_log(self.played()[0])
        passed = np.cumsum(log["passed"][1:])
        self.assertAlmostEqual(log.at(log.monotonic + passed[99]), 100.0, places=6)
        self.assertTrue(math.isnan(log.at(log.monotonic - 1.0)) and math.isnan(log.at(log.monotonic + 1e6)))
        restored = pickle.loads(pickle.dumps(log))
        self.assertEqual((restored.monotonic, restored.events, restored.units), (log.monotonic, log.events, log.units))
        self.same_bits(restored["passed"], log["passed"])

    def test_another_graph_plays_a_log_and_assets_and_values_are_those_given(self):
        log, graph = self.played()[0], tactus.Graph("dry_wood")
        one, other = (tactus.replay(log, graph, record=["drag.force"], set=values) for values in (None, {"drag.d_max": "900 um"}))
        self.assertFalse(np.array_equal(one["drag.force"], other["drag.force"]))

    def test_a_packed_log_is_never_replaced(self):
        log = self.played("run.tlog")[0]
        whole = log.read_bytes()
        self.fails("output/exists", self.played, "run.tlog")
        self.assertEqual(log.read_bytes(), whole)
        self.assertLess(len(whole), 0.5 * len(self.played("run.jsonl")[0].read_bytes()) + 20000)

    def test_mistakes_are_told(self):
        odd, log = self.folder / "odd.jsonl", self.played()[0]
        odd.write_text("{}\n")
        self.fails("argument/value", tactus.read_log, odd, start=1.0, until=0.5)
        self.fails("port/unknown_node", tactus.replay, log, record=["nothing.force"])
        self.addCleanup(tactus.set_limits, "")
        for id, path, limit in (("file/unreadable", self.folder / "none.jsonl", ""), ("log/not_a_log", odd, ""), ("take/too_large", log, "numbers=1000")):
            tactus.set_limits(limit)
            self.fails(id, tactus.read_log, path)
            self.fails(id, tactus.replay, path)


if __name__ == "__main__":
    unittest.main()
