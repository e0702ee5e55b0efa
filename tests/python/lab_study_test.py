# SPDX-License-Identifier: MIT
"""Studies: designs, measures, results that survive, and the same bytes from each executor of this computer."""

import concurrent.futures
import contextlib
import dataclasses
import io
import itertools
import json
import os
import pathlib
import pickle
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import tracemalloc
import unittest
from unittest import mock
from xml.etree import ElementTree

import numpy as np
import tactus
from support import GRAPHS, PROGRAM, ROOT, TestCase, why_not_live
import waiting
from tactus import _library, _tactus, lab
from tactus.lab import _design, _drive, _points, _results, _study_report

WALL = ROOT / "docs/figures/stiffness_limit.json"
EXAMPLES = ROOT / "docs/examples/studies"
PEAK = lab.Measure("peak", "peak", port="motor.force", unit="N")


def wall(**changes):
    """A study of 30 short renders."""
    given = {"name": "wall", "graph": str(WALL), "duration": 0.05, "rate": 1000.0, "measures": [PEAK],
             "factors": [lab.Factor("wall.stiffness", low=1000.0, high=5000.0, count=6), lab.Factor("wall.damping", values=[0, 0.5, 1, 2, 5.0])]}
    return lab.Study(**{**given, **changes})


def points(design):
    return [design.at(i) for i in range(design.count)]


class Quiet(TestCase):
    """A folder for each test, and no warnings of renders in the output."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        self.enterContext(contextlib.redirect_stderr(io.StringIO()))


class Designs(Quiet):
    def made(self, kind, *factors):
        return points(_design.make(kind, factors, str(self.folder)))

    def test_a_grid_has_all_combinations_in_order_and_a_latin_hypercube_one_point_in_each_part(self):
        made = self.made(lab.Grid(), lab.Factor("a", values=[1, 2.0]), lab.Factor("b", low=1.0, high=100.0, count=3, log=True),
                         lab.Factor("c", values=["x", {"b": 1.0, "a": [2.0, 0.1]}]))
        self.assertEqual(made, list(itertools.product(["1", "2"], ["1", "10", "100"], ['"x"', '{"a": [2, 0.1], "b": 1}'])))
        factors = lab.Factor("a", low=0.0, high=1.0), lab.Factor("b", low=2.0, high=4.0)
        made = self.made(lab.Latin(points=50, seed=3), *factors)
        for column, factor in zip(zip(*made), factors):
            self.assertEqual(sorted(int((float(v) - factor.low) / (factor.high - factor.low) * 50) for v in column), list(range(50)))
        self.assertNotEqual(made, self.made(lab.Latin(points=50, seed=4), *factors))

    def test_a_sobol_sequence_is_that_of_joe_and_kuo(self):
        at = _design._sobol(10)
        made = np.array([at(i) for i in range(256)])
        for start, size in ((0, 256), (64, 64), (128, 32)):   # each block of 2^k points has one in each of 2^k parts, in each dimension
            for column in made[start:start + size].T:
                self.assertEqual(sorted((column * size).astype(int)), list(range(size)))
        with contextlib.suppress(ImportError):
            from scipy.stats import qmc
            self.assertTrue(np.array_equal(qmc.Sobol(10, scramble=False).random_base2(8), made))

    def test_a_table_gives_its_rows_and_what_is_wrong_is_refused(self):
        for name, text in (("t.csv", "drag.mu,drag.d_max,note\n0.2,20 um,a\n0.3,1e-4,b\n"), ("ragged.csv", "x\n1,2\n"), ("empty.csv", "x\n")):
            (self.folder / name).write_text(text)
        self.assertEqual(self.made(lab.FromTable(path="t.csv"), lab.Factor("drag.mu"), lab.Factor("drag.d_max")), [("0.2", '"20 um"'), ("0.3", "0.0001")])
        for name, problem in (("t.csv", "study/value"), ("ragged.csv", "study/value"), ("empty.csv", "study/value"), ("none.csv", "study/unreadable")):
            self.fails(problem, self.made, lab.FromTable(path=name), lab.Factor("x"))
        for factors in ([lab.Factor("a")], [lab.Factor("a", low=1.0, high=1.0)], [lab.Factor("a", low=0.0, high=1.0, log=True)],
                        [lab.Factor("a", values=[1], low=0.0)], [lab.Factor("a", values=[1])] * 2):
            self.fails("study/value", self.made, lab.Grid(), *factors)
        self.fails("study/no_recording", self.made, lab.Grid(), lab.Factor("recording", values=["*.wav"]))


class Measures(Quiet):
    def test_they_are_what_numpy_says_about_the_records_of_a_render(self):
        results = wall(duration=0.3, measures=[
            *(lab.Measure(kind, kind, port="motor.force", position="hand.position", low=20.0, high=200.0) for kind in ("peak", "rms", "work", "given", "band")),
            *(lab.Measure(kind, kind, port="motor.force.z") for kind in ("max", "min", "mean", "last")),
            lab.Measure("reach", "reach", port="hand.position.z", level=-0.004, hold=0.01),
            lab.Measure("below", "reach", port="hand.position.z", level=-0.1, above=False)]).run(self.folder / "out")
        for i in (0, 13, 29):
            values = {name: float(results[name][i]) for name in ("wall.stiffness", "wall.damping")}
            r = tactus.Graph(WALL).render(duration=0.3, rate=1000, set=values, record=["motor.force", "hand.position"])
            force, z = r["motor.force"], r["hand.position"][:, 2]
            size = np.linalg.norm(force, axis=1)
            work = np.cumsum((force[:-1] * np.diff(r["hand.position"], axis=0)).sum(axis=1))
            held = [k for k in range(len(z) - 10) if (z[k:k + 11] >= -0.004).all()]
            for name, value in {"peak": size.max(), "max": force[:, 2].max(), "min": force[:, 2].min(), "last": force[-1, 2], "below": np.nan,
                                "reach": held[0] / 1000.0 if held else np.nan, "band": _points.band(force, 1000.0, 20.0, 200.0),
                                "mean": force[:, 2].mean(), "rms": np.sqrt((size**2).mean()), "work": work[-1], "given": max(0.0, work.max())}.items():
                exact = name not in ("mean", "rms", "work", "given")
                self.assertTrue(np.isclose(results[name][i], value, 0.0 if exact else 1e-9, 0.0 if exact else 1e-9, equal_nan=True), name)

    def test_a_band_holds_the_rms_of_what_is_in_it(self):
        t = np.arange(1000) / 1000.0
        sine = 3.0 * np.sin(2 * np.pi * 50.0 * t) + 2.0 * np.sin(2 * np.pi * 300.0 * t) + 7.0
        for values, low, high, rms in ((sine, 40.0, 60.0, 3.0 / np.sqrt(2.0)), (np.stack([sine, sine, 0 * sine], axis=1), 0.0, 501.0, np.sqrt(13.0)),
                                       (np.arange(1000) % 2, 0.0, 501.0, 0.5)):   # the last: all of it at half the rate
            self.assertAlmostEqual(_points.band(values, 1000.0, low, high), rms, places=9)

    def test_settings_devices_rates_seeds_and_records(self):
        (self.folder / "still.csv").write_text("t,x,y,z\n0,0,0,0\n1,0,0,0\n")
        study = lab.Study(name="wood", graph="dry_wood", duration=0.2, keep=["motor.force"], folder=str(self.folder), factors=[
            lab.Factor("device:stylus/hand/stiffness", values=[300, 900]), lab.Factor("setting:board.window", values=["1 ms", "2 ms"]),
            lab.Factor("rate", values=[2000, 4000]), lab.Factor("seed", values=[1, 2]), lab.Factor("roughness", values=[0.2, 1])])
        results = study.run(self.folder / "out")
        self.assertEqual((results.rows, set(results["error"])), (32, {""}))
        for i in (0, 21, 31):
            graph = tactus.Graph("dry_wood")
            graph.set_setting("board", "window", results["setting:board.window"][i])
            device = json.loads(graph.text)["devices"]["stylus"]
            device["hand"]["stiffness"] = float(results["device:stylus/hand/stiffness"][i])
            graph.set_device("stylus", device)
            r = graph.render(duration=0.2, rate=float(results["rate"][i]), set={"roughness": float(results["roughness"][i])}, record=["motor.force"])
            for c, axis in enumerate("xyz"):
                self.same_bits(results[f"trace:motor.force.{axis}"][i], r["motor.force"][:, c])
        traced = dataclasses.replace(study, keep=[], factors=[lab.Factor("device:stylus", values=["trace:still.csv", "gesture:stroke", "hid:auto"])])
        self.assertEqual([e[:12] for e in traced.run(self.folder / "traced")["error"]], ["", "", "study/device"])


class Renders(Quiet):
    def test_a_run_that_goes_back_has_the_bits_and_messages_of_a_new_one(self):
        draw, different = random.Random(1), 0

        def near(value):
            found = re.fullmatch(r"(-?[\d.]+)(.*)", str(value))
            return json.dumps(f"{float(found[1]) * draw.uniform(0.8, 1.2)!r}{found[2]}" if found else value)

        for file in sorted(GRAPHS.glob("*.json")):
            graph = tactus.Graph(file)
            described = json.loads(graph.text)
            given = {f"{node}.{param}": value for node, about in described["nodes"].items() for param, value in about.get("params", {}).items()
                     if isinstance(value, (int, float, str))}
            names = [*given, *described.get("controls", {})]
            some = [[*map(near, given.values()), *(repr(draw.random()) for _ in names[len(given):])] for _ in range(3)]
            some += [[*some[0][:-1], '"3 apples"'], some[0]]   # one with an error, and after it the first one again
            together, *alone = (_tactus.Points(graph._graph, 0.0, [], {}, names, None, None, 1.0).render(each) for each in (some, *([one] for one in some)))
            self.assertEqual([error[1:] for error in together[1]], [error[1:] for _, found, _ in alone for error in found], file.name)
            self.assertEqual(together[2], {key: text for _, _, found in reversed(alone) for key, text in found.items()}, file.name)
            good = sorted({0, 1, 2, 3, 4} - {error[0] for error in together[1]})
            self.assertEqual([together[0][k].tobytes() for k in good], [alone[k][0].tobytes() for k in good], file.name)
            different += len({together[0][k].tobytes() for k in good}) > 1
        self.assertGreater(different, 30)   # the points are not all the same


def last_and_stiffness(records, point):
    return records["motor.force"][-1, 2] if "motor.force" in records else 0.0, point["wall.stiffness"] / (point["wall.damping"] != 0.5)


class Errors(Quiet):
    def test_a_bad_point_is_a_row_with_its_error_and_its_place(self):
        results = wall(factors=[lab.Factor("wall.stiffness", values=[1000, -5, "3 apples", 2000])]).run(self.folder / "out")
        self.assertEqual(list(results["error"] != ""), [False, True, True, False])
        self.assertIn("param/out_of_range", results["error"][1])
        self.assertIn("wall", results["error_place"][1] + results["error"][1])
        self.assertEqual(list(np.isnan(results["peak"])), [False, True, True, False])

    def test_functions_get_the_records_and_the_point_and_may_fail(self):
        study = wall(measures=[lab.Measure("f", "function", function="f", outputs=["z", "k"])])
        results = study.run(self.folder / "out", functions={"f": last_and_stiffness})
        bad = results["wall.damping"] == 0.5
        self.assertEqual((list(results["f_k"][~bad]), list(results["error"] != "")), (list(results["wall.stiffness"][~bad]), list(bad)))
        self.assertIn("ZeroDivisionError", results["error"][bad][0])
        self.assertRegex(results["error_place"][bad][0], r"^lab_study_test.py:\d+$")
        self.fails("study/no_function", study.prepare)

    def test_what_no_point_could_use_is_refused_at_once(self):
        for changes, name in (({"factors": [lab.Factor("wall.stifness", values=[1])]}, "param/unknown"),
                              ({"measures": [lab.Measure("p", "peak", port="motor.torgue")]}, "port/unknown"),
                              ({"measures": [lab.Measure("p", "max", port="motor.force")]}, "study/measure"),
                              ({"measures": [lab.Measure("p", "work", port="motor.force")]}, "study/missing"),
                              ({"measures": [PEAK, PEAK]}, "study/value"), ({"worst": "peek"}, "study/value"), ({"name": "a/b"}, "study/value"),
                              ({"maps": [lab.Map("peak", "wall.stiffness", "x")]}, "study/value"),
                              ({"devices": {"tool": "hid:auto"}}, "study/device"), ({"devices": {"tool": {"driver": "serial"}}}, "study/device"),
                              ({"factors": [lab.Factor("setting:wall", values=[1])]}, "study/value")):
            self.fails(name, wall(**changes).prepare)
        with mock.patch.object(_library, "_loaded", None), mock.patch("ctypes.CDLL", side_effect=OSError("it is not installed")):
            self.fails("live/library", wall(measures=[lab.Measure("s", "stable")]).prepare)

    def test_files_are_read_strictly(self):
        file, good, draw = self.folder / "s.json", wall().text(), random.Random(1)
        file.write_text(good)
        self.assertEqual(lab.Study.load(file).text(), good)
        for _ in range(400):
            at = draw.randrange(len(good))
            file.write_text(good[:at] + draw.choice(["", "x", "{", "1e999", "null", '"', "[[[["]) + good[at + draw.randrange(4):])
            with contextlib.suppress(tactus.Error):
                lab.Study.load(file).prepare()
        for pointer, change in (("/factors/0/vary", {"factors": [{"vary": 3}]}), ("/measures/0/kind", {"measures": [{"name": "a", "kind": "peek"}]}),
                                ("/measures/0/places", {"measures": [{"name": "a", "kind": "stable", "places": 3}]})):
            file.write_text(json.dumps({**json.loads(good), **change}))
            self.assertIn(pointer, self.fails("lab/unknown_key" if "places" in pointer else "lab/type", lab.Study.load, file).where)


class Results(Quiet):
    def bytes_of(self, study, out, executor=None, workers=1, **options):
        study.run(self.folder / out, executor, workers, **options)
        return (self.folder / out / "results.npz").read_bytes()

    def held(self, study):
        return _results.Held(study.prepare(), self.folder / "out", False, set())

    def test_each_executor_and_each_size_of_chunks_gives_the_same_bytes(self):
        kinds = [("peak", "motor.force"), ("rms", "motor.force"), ("mean", "motor.force.z"), ("work", "motor.force"), ("band", "motor.force")]
        study = wall(keep=["motor.force.z"], measures=[lab.Measure(kind, kind, port=port, position="hand.position") for kind, port in kinds],
                     factors=[lab.Factor("wall.stiffness", values=[1000, 2000, -1, 4000]), lab.Factor("wall.damping", values=[0, 1, 2])])
        here = self.bytes_of(study, "here")
        with mock.patch.object(_points, "ROOM", 1):
            self.assertEqual(self.bytes_of(study, "one by one"), here)
        with concurrent.futures.ThreadPoolExecutor(2) as threads:
            self.assertEqual(self.bytes_of(study, "threads", threads, 2), here)
        prepared = study.prepare()
        for shard in (2, 0, 1):
            _drive.drive(prepared, self.folder / "shards", shard=(shard, 3))
            if shard != 1:
                self.fails("study/missing", _results.merge, prepared, self.folder / "shards")
        _results.merge(prepared, self.folder / "shards")
        self.assertEqual((self.folder / "shards/results.npz").read_bytes(), here)
        self.assertEqual(len(list((self.folder / "shards/parts").iterdir())), 3)

    def test_a_worker_elsewhere_gets_the_files_of_the_graph_with_the_study(self):
        (self.folder / "g.json").write_bytes((GRAPHS / "pebbled_leather.json").read_bytes().replace(b"assets/", b""))
        text = json.loads((self.folder / "g.json").read_text())
        name = re.search(r'"([\w./]+\.(?:png|csv|obj|stl))"', json.dumps(text))[1]
        picture = np.linspace(0.0, 1.0, 256).reshape(16, 16)
        study = lab.Study(name="leather", graph=str(self.folder / "g.json"), duration=0.2, measures=[PEAK],
                          factors=[lab.Factor(next(iter(text["controls"])), values=[0.2, 0.9])])
        here = study.run(self.folder / "here", assets={name: picture})
        prepared = study.prepare(assets={name: picture})
        chunk = _points.Worker(pickle.loads(pickle.dumps(prepared)), is_far=True).render(points(prepared.design))
        self.assertEqual(chunk.errors, {})
        self.same_bits(chunk.rows["numbers"][:, 0], here["peak"])
        self.assertNotEqual(study.prepare(assets={name: picture * 0.5}).context, prepared.context)

    def test_nothing_is_rendered_twice(self):
        small = wall(factors=[lab.Factor("wall.stiffness", values=[1000, 2000]), lab.Factor("wall.damping", values=[0])])
        large = dataclasses.replace(small, factors=[lab.Factor("wall.stiffness", values=[3000, 2000, 1000]), lab.Factor("wall.damping", values=[0, 1])])
        equal = dataclasses.replace(large, design=lab.Latin(points=50))   # 6 different points
        small.run(self.folder / "out")
        for other, id, options in ((large, "study/exists", {}), (dataclasses.replace(small, duration=0.06), "study/other", {"resume": True})):
            self.fails(id, other.run, self.folder / "out", **options)
        progress = _drive.drive(large.prepare(), self.folder / "out", resume=True)
        self.assertEqual((progress.total, progress.fresh, self.held(large).count), (6, 4, 6))   # the key of a result does not depend on the design
        self.same_bits(_results.merge(large.prepare(), self.folder / "out")["peak"], large.run(self.folder / "fresh")["peak"])
        with mock.patch.object(_drive, "BLOCK", 7):
            self.assertEqual(_drive.drive(equal.prepare(), self.folder / "out", resume=True).fresh, 0)
            shutil.rmtree(self.folder / "out")
            results = equal.run(self.folder / "out")
        self.assertEqual((self.held(equal).count, results.rows), (6, 50))
        self.assertEqual(len(set(zip(results["wall.stiffness"], results["wall.damping"], results["peak"]))), 6)

    def test_memory_does_not_grow_with_the_points(self):
        def peak(count):
            study = wall(duration=0.002, design=lab.Sobol(points=count), factors=[lab.Factor("wall.stiffness", low=1000.0, high=5000.0),
                                                                                  lab.Factor("wall.damping", low=0.0, high=1.0)])
            prepared, out, found = study.prepare(), self.folder / str(count), []
            tracemalloc.start()
            for step in (lambda: _drive.drive(prepared, out), lambda: _drive.drive(prepared, out, resume=True), lambda: _results.merge(prepared, out),
                         lambda: _study_report.write(prepared, lab.Results(out), out / "report.html", [])):
                tracemalloc.reset_peak()
                with mock.patch.object(_drive.Progress, "chunk", lambda *_: 500), mock.patch.multiple(_drive, BLOCK=1000), \
                        mock.patch.multiple(_results, BLOCK=1000):
                    step()
                found.append(tracemalloc.get_traced_memory()[1])
            tracemalloc.stop()
            return np.array(found)

        peak(1000)   # what is imported or made once
        growth = (peak(20000) - peak(4000)) / 16000
        print(f"bytes per point: {growth}", file=sys.__stderr__)
        self.assertLess(growth.max(), 16)   # renders, resuming, merge, report

    def test_what_a_crash_cuts_off_is_rendered_again(self):
        study = wall()
        whole = self.bytes_of(study, "out")
        part = next((self.folder / "out/parts").iterdir())
        data, draw = part.read_bytes(), random.Random(2)
        for _ in range(12):
            cut = draw.randrange(len(data))
            for old in (self.folder / "out/parts").iterdir():
                old.unlink()
            part.write_bytes(data[:cut] if draw.random() < 0.6 else data[:cut] + bytes([data[cut] ^ 1]) + data[cut + 1:])
            self.assertEqual(self.bytes_of(study, "out", resume=True), whole)

    def test_results_that_differ_are_noticed_and_those_of_another_version_refused_or_marked(self):
        study, out = wall(), self.folder / "out"
        study.run(out)
        part, prepared = next((out / "parts").iterdir()), study.prepare()

        def add(stamp, change=0.0):
            chunk = _points.Worker(prepared, False).render([prepared.design.at(0)])
            chunk.rows["numbers"] += change
            with contextlib.closing(_results.part(out, prepared.context, stamp)) as added:
                added.add(chunk.to_json())

        add(_points.stamp())
        _results.merge(prepared, out)   # the same result twice is one row
        add(("0.1.0", "other-1"), 1e-9)
        self.assertIn("0.1.0", self.fails("study/other_version", _results.merge, prepared, out).text)
        _results.merge(prepared, out, mixed=True)   # on another computer, it may differ
        add(_points.stamp(), 1e-9)
        self.fails("study/differs", _results.merge, prepared, out, mixed=True)
        for own in (out / "parts").iterdir():
            if '"other-1"' not in own.read_text().splitlines()[0]:
                own.unlink()
        self.fails("study/other_version", study.run, out, resume=True)
        results = study.run(out, resume=True, mixed=True)
        self.assertEqual(list(results["origin"]), ["0.1.0 on other-1"] + [" on ".join(_points.stamp())] * 29)
        self.assertFalse(part.exists())

    def test_the_reader_of_the_page_reads_all(self):
        results = wall(keep=["motor.force.z"], factors=[lab.Factor("wall.stiffness", values=["1 N/mm", 2000, -1])]).run(self.folder / "out")
        source = re.search(r"```python\n(import json\n.*?)```", (ROOT / "docs/studies.md").read_text(encoding="utf-8"), re.S)[1]
        names = {}
        exec(source.replace("wall/results.npz", str(self.folder / "out/results.npz")), names)
        self.same_bits(names["peak"], results["peak"])
        self.assertEqual(names["errors"], list(results["error"]))
        self.assertEqual([each.tobytes() for each in names["forces"]], [each.tobytes() for each in results["trace:motor.force.z"]])
        self.assertEqual(len(lab.Results(self.folder / "out/times.npz")["worker"]), 3)
        data = (self.folder / "out/results.npz").read_bytes()
        for cut in range(0, len(data), 97):
            (self.folder / "cut").write_bytes(data[:cut])
            self.fails("study/unreadable", lab.load_results, self.folder / "cut")

    def test_chunks_are_about_a_second(self):
        told, now = io.StringIO(), [0.0]
        progress = _drive.Progress(10**6, 0, 0, None)
        sizes = [progress.chunk(10**6, 1)]
        for _ in range(8):
            progress.add(sizes[-1], 0, sizes[-1] / 512)
            sizes.append(progress.chunk(10**6, 1))
        self.assertEqual((sizes[:3], sizes[-1], progress.chunk(100, 4)), ([1, 8, 72], 512, 13))
        progress = _drive.Progress(1000, 0, 0, told, lambda: now[0])
        now[0] = 6.0
        progress.add(100, 1, 6.0)
        self.assertEqual(told.getvalue(), "100 of 1000 points, 1 with errors, 0:00:54 left\n")


class Report(Quiet):
    def test_the_page_works_offline_and_no_text_becomes_markup(self):
        factors = [lab.Factor("wall.stiffness", values=[1000, 5000, -1]), lab.Factor("wall.damping", values=[0, 0.5])]
        study = wall(about="<script>alert(1)</script>", factors=factors,
                     maps=[lab.Map("peak", "wall.damping", "wall.stiffness", limits=bool(PROGRAM))])
        page = _study_report.page(study.prepare(), study.run(self.folder / "out"), ["tactus", "study", "wa ll.json"])
        ElementTree.fromstring(re.sub(r"<meta[^>]*>|<!DOCTYPE html>", "", page))   # each tag is closed
        self.assertNotIn("<script", page)
        self.assertEqual(re.findall(r'(?:src|href)="(?!data:image/png)', page), [])
        self.assertIn("tactus study 'wa ll.json' --point", page.replace("&#x27;", "'"))
        self.assertIn("2 points with errors", page)
        if PROGRAM:
            self.assertRegex(page, 'stroke="#c00"[^>]*/><text[^>]*>—— passive<')

    def test_a_map_shows_each_cell_at_its_place(self):
        results = wall().run(self.folder / "out")
        axis = _study_report._Axis.of(results, "wall.stiffness", [results["wall.stiffness"]])
        self.assertEqual(list(axis.middles), sorted(set(results["wall.stiffness"])))
        self.assertEqual(list(axis.middles[axis.cells(results["wall.stiffness"])]), list(results["wall.stiffness"]))
        self.assertTrue(np.allclose(axis.at(np.array([1000.0, 1400.0, 5000.0])), [0.5, 1.0, 5.5]))
        colours = _study_report._colour(np.array([0.0, 1.0, np.nan]))
        self.assertEqual([tuple(c) for c in colours], [(68, 1, 84), (253, 231, 37), _study_report.GREY])


KILLS = int(os.environ.get("TACTUS_KILLS", "3"))


def descendants(pid):
    """The processes that a process has started, and those that they have started: numbers and command lines."""
    found = {}
    with contextlib.suppress(OSError):   # it ends
        for child in pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split():
            found[int(child)] = pathlib.Path(f"/proc/{child}/cmdline").read_text().replace("\0", " ")
            found.update(descendants(child))
    return found


class Killed(Quiet):
    """Processes of a study are killed at random, and it goes on: nothing is lost, and nothing is rendered twice."""

    def begin_study(self):
        self.study = wall(duration=100.0, factors=[lab.Factor("wall.stiffness", low=1000.0, high=5000.0, count=20),
                                                   lab.Factor("wall.damping", values=[0, 0.5, -1, 2])])
        (self.folder / "s.json").write_text(self.study.text())
        self.study.run(self.folder / "whole")
        self.prepared = self.study.prepare()

    def start(self, *words, file="s.json", out="out", before=(), **options):
        return subprocess.Popen([*before, sys.executable, "-B", "-m", "tactus.lab", "study", str(self.folder / file), "--out", str(self.folder / out), *words],
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=self.folder, **options)

    def held(self):
        """The points with results; each has one."""
        if not (self.folder / "out/parts").exists():
            return set()
        keys = _results.Held(self.prepared, self.folder / "out", False, set()).rows()["key"].tolist()
        self.assertEqual(len(set(keys)), len(keys), "a point was rendered twice")
        return set(keys)

    def same(self):
        self.assertEqual((self.folder / "out/results.npz").read_bytes(), (self.folder / "whole/results.npz").read_bytes())

    def survives(self, start, victims, is_over=lambda process: process.poll() is not None, stays=False):
        """start: begins or resumes the study. victims: the numbers of processes that may be killed. stays: the last kill is that of the process that was
        started, in the first half of the study, and the study stays as it is then."""
        seed = int(os.environ.get("TACTUS_SEED", "1"))
        print(f"{self.id()}: seed {seed}, {KILLS} kills", file=sys.__stderr__)
        draw, known, kills, count = random.Random(seed), set(), 0, self.prepared.design.count

        def next_kill():
            return len(known) + draw.randrange(1, 25) if kills < KILLS else count + 1

        for _ in range(20 + 10 * KILLS):
            process, wanted = start(), next_kill()
            while not is_over(process):
                now = self.held()
                self.assertLessEqual(known, now, "results were lost")
                known, is_last = now, stays and kills == KILLS - 1
                if len(known) >= wanted and (alive := victims(process)) and (not is_last or len(known) < count // 2):
                    with contextlib.suppress(ProcessLookupError):
                        os.kill(process.pid if is_last else draw.choice(alive), signal.SIGKILL)
                        kills += 1
                    wanted = next_kill()
                waiting.let_pass(0.01)
            if isinstance(process, subprocess.Popen):
                process.communicate()
            known = self.held()
            if stays and kills == KILLS:
                return
            if len(known) == count and (self.folder / "out/results.npz").exists():
                self.same()
                if kills >= KILLS:
                    return
                shutil.rmtree(self.folder / "out")   # it was faster than the kills; begin again
                known = set()
        self.fail("the study does not end")


class Command(Killed):
    def ran(self, *words, status=0, **options):
        process = self.start(*words, **options)
        said = process.communicate()
        self.assertEqual(process.returncode, status, said)
        return said[0] + said[1]

    def write(self, study):
        (self.folder / "s.json").write_text(study.text())

    def test_killed_at_random_it_loses_nothing(self):
        self.begin_study()
        self.survives(lambda: self.start("--workers", "2", "--resume"),
                      lambda process: [process.pid, *(pid for pid, words in descendants(process.pid).items() if "spawn_main" in words)])

    def test_a_full_disk_loses_nothing(self):
        self.write(wall(keep=["motor.force"], duration=0.5))
        self.ran("--executor", "serial", out="whole")

        def small():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (50000, 50000))   # a file cannot become larger, as on a disk that is full

        said = self.ran("--executor", "serial", status=1, preexec_fn=small)
        self.assertIn("--resume", said)
        count = int(re.search(r"(\d+) points of this process are on the disk", said)[1])
        self.assertTrue(0 < count < 30, said)
        self.assertIn(f"{count} of 30 points", self.ran("--status"))
        self.ran("--executor", "serial", "--resume")
        self.same()

    def test_functions_come_from_the_person_only(self):
        self.write(wall(measures=[lab.Measure("f", "function", function="f")]))
        self.assertIn("--functions", self.ran(status=1))
        (self.folder / "f.py").write_text("def f(records, point):\n    return point['wall.stiffness'] if point['wall.damping'] else 1 / 0\n")
        self.assertIn("6 with errors", self.ran("--functions", "f.py", "--workers", "2", "--to", "csv"))
        self.ran("--functions", "f.py", "--executor", "serial", out="whole")
        self.same()
        results = lab.load_results(self.folder / "out")
        self.assertEqual(results["error_place"][0], "functions.py:2")
        words = re.search(r"<code>(tactus study .*?)</code>", (self.folder / "out/report.html").read_text())[1].split()   # of the worst point
        self.ran(*words[3:])
        self.assertEqual(int(words[-1]), int(np.nanargmax(results["f"])))
        self.assertTrue((self.folder / f"out/point-{words[-1]}.csv").exists())
        self.assertEqual(len((self.folder / "out/results.csv").read_text().splitlines()), 31)

    def test_one_point_and_wrong_uses(self):
        self.write(wall(set={"wall.damping": 1}, factors=[lab.Factor("wall.stiffness", values=[1000, 2000]), lab.Factor("device:tool/mass", values=[0.2])]))
        self.assertIn("tactus-host", self.ran("--point", "1"))
        rows = np.loadtxt(self.folder / "out/point-1.csv", delimiter=",", skiprows=1)
        self.same_bits(rows[:, 3], tactus.Graph(self.folder / "out/point-1.json").render(duration=0.05)["motor.force"][:, 2])
        for words in (["--point", "2"], ["--shard", "2/2"], ["--workers", "0"], ["--executor", "none"]):
            self.ran(*words, status=2)
        self.ran("--status", out="none", status=1)
        self.assertIn("--array=0-1", self.ran("--executor", "slurm", "--workers", "8", "--dry-run"))
        if PROGRAM:
            done = subprocess.run([PROGRAM, "study", "s.json", "--out", "cli", "--executor", "serial"], capture_output=True, text=True, cwd=self.folder,
                                  env={**os.environ, "PATH": f"{pathlib.Path(sys.executable).parent}:{os.environ['PATH']}"})
            self.assertIn("2 points, 0 with errors", done.stdout, done.stderr)


class Examples(Quiet):
    """The numbers that docs/studies.md names."""

    def results(self, name):
        return lab.Study.load(EXAMPLES / f"{name}.json").run(self.folder / name)

    def test_the_wall(self):
        if why := why_not_live():   # as with a sanitizer
            print(f"skipped: {why}")
            self.skipTest(why)
        r = self.results("wall")
        for k, b, rank in zip(r["wall.stiffness"], r["wall.damping"], r["stable"]):
            self.assertEqual(rank == 2.0, k < 2.0 * (2.0 - b) / 0.001, (k, b, rank))
            if k <= 4100.0 or b == 0.0:
                self.assertEqual(rank == 0.0, k > 4000.0 and b == 0.0, (k, b, rank))   # without damping, what is not passive swings

    def test_the_wood(self):
        r = self.results("wood")
        self.assertTrue(0.013 < r["felt"].min() < 0.015 and 0.10 < r["felt"].max() < 0.115, (r["felt"].min(), r["felt"].max()))

        def rank_correlation(name):
            a, b = (np.argsort(np.argsort(r[column])) for column in (name, "felt"))
            return np.corrcoef(a, b)[0, 1]

        rough, hand, grip = map(rank_correlation, ("roughness", "device:stylus/hand/stiffness", "drag.d_max"))
        self.assertTrue(0.7 < rough < 0.9 and 0.5 < hand < 0.7 and abs(grip) < 0.3, (rough, hand, grip))

    def test_the_keys(self):
        r = self.results("keys")
        for name, known in (("bottom", (0.689, 0.7216, 0.801)), ("peak", (0.791, 1.480, 2.651))):
            self.assertTrue(np.allclose((r[name].min(), np.median(r[name]), r[name].max()), known, 0.01, 0.0), name)

    def test_the_fit(self):
        done = subprocess.run([sys.executable, "-B", str(EXAMPLES / "fit.py"), str(self.folder)], capture_output=True, text=True, check=True)
        self.assertEqual(re.findall(r"(\w+)\.csv: mu ([\d.]+)", done.stdout), [("felt", "0.35"), ("ice", "0.10"), ("oak", "0.25"), ("rubber", "0.80")])
        for rest in re.findall(r"rest ([\d.]+)", done.stdout):
            self.assertLess(abs(float(rest) - 0.02), 0.002)   # the noise of the recordings


if __name__ == "__main__":
    unittest.main()
