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
from support import GRAPHS, PROGRAM, ROOT, TestCase
import waiting
from tactus import _tactus, lab
from tactus.lab import _columns, _design, _drive, _measures, _parts, _study_report, _worker

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

    def test_a_grid_has_all_combinations_in_order(self):
        made = self.made(lab.Grid(), lab.Factor("a", values=[1, 2.0]), lab.Factor("b", low=1.0, high=100.0, count=3, log=True),
                         lab.Factor("c", values=["x", [0, 1]]))
        self.assertEqual(made, list(itertools.product(["1", "2"], ["1", "10", "100"], ['"x"', "[0, 1]"])))

    def test_equal_values_have_equal_texts(self):
        self.assertEqual(_design.text_of({"b": 1.0, "a": [2.0, 0.1]}), _design.text_of({"a": [2, 0.1], "b": 1}))
        self.assertNotEqual(_design.text_of(1), _design.text_of("1"))

    def test_each_part_of_a_latin_hypercube_has_one_point(self):
        made = self.made(lab.Latin(points=50, seed=3), lab.Factor("a", low=0.0, high=1.0), lab.Factor("b", low=2.0, high=4.0))
        for column, (low, high) in zip(zip(*made), ((0.0, 1.0), (2.0, 4.0))):
            self.assertEqual(sorted(int((float(v) - low) / (high - low) * 50) for v in column), list(range(50)))
        self.assertNotEqual(made, self.made(lab.Latin(points=50, seed=4), lab.Factor("a", low=0.0, high=1.0), lab.Factor("b", low=2.0, high=4.0)))

    def test_a_sobol_sequence_is_that_of_joe_and_kuo(self):
        at = _design._sobol(10)
        made = np.array([at(i) for i in range(256)])
        for start, size in ((0, 256), (64, 64), (128, 32)):   # each block of 2^k points has one in each of 2^k parts, in each dimension
            for column in made[start:start + size].T:
                self.assertEqual(sorted((column * size).astype(int)), list(range(size)))
        cells = {(int(a * 16), int(b * 16)) for a, b in made[:, :2]}
        self.assertEqual(len(cells), 256)   # the first two dimensions are a (0, 8, 2)-net
        try:
            from scipy.stats import qmc
        except ImportError:
            return
        self.assertTrue(np.array_equal(qmc.Sobol(10, scramble=False).random_base2(8), made))

    def test_a_table_gives_its_rows(self):
        (self.folder / "t.csv").write_text("drag.mu,drag.d_max,note\n0.2,20 um,a\n0.3,1e-4,b\n")
        self.assertEqual(self.made(lab.FromTable(path="t.csv"), lab.Factor("drag.mu"), lab.Factor("drag.d_max")), [("0.2", '"20 um"'), ("0.3", "0.0001")])
        self.fails("study/value", self.made, lab.FromTable(path="t.csv"), lab.Factor("x"))
        self.fails("study/unreadable", self.made, lab.FromTable(path="none.csv"), lab.Factor("x"))

    def test_wrong_factors_are_refused(self):
        for factor in (lab.Factor("a"), lab.Factor("a", low=1.0, high=1.0), lab.Factor("a", low=0.0, high=1.0, log=True), lab.Factor("a", values=[1], low=0.0)):
            self.fails("study/value", self.made, lab.Grid(), factor)
        self.fails("study/value", self.made, lab.Grid(), lab.Factor("a", values=[1]), lab.Factor("a", values=[1]))
        self.fails("study/no_recording", self.made, lab.Grid(), lab.Factor("recording", values=["*.csv"]))


class Measures(Quiet):
    def test_they_are_what_numpy_says_about_the_records_of_a_render(self):
        named = [*(lab.Measure(kind, kind, port="motor.force") for kind in ("peak", "rms")),
                 *(lab.Measure(kind, kind, port="motor.force.z") for kind in ("max", "min", "mean", "last")),
                 lab.Measure("work", "work", port="motor.force", position="hand.position"),
                 lab.Measure("given", "given", port="motor.force", position="hand.position"),
                 lab.Measure("reach", "reach", port="hand.position.z", level=-0.004, hold=0.01),
                 lab.Measure("below", "reach", port="hand.position.z", level=-0.1, above=False),
                 lab.Measure("band", "band", port="motor.force", low=20.0, high=200.0)]
        study = wall(measures=named, duration=0.3)
        results = study.run(self.folder / "out")
        for i in (0, 13, 29):
            values = {name: float(results[name][i]) for name in ("wall.stiffness", "wall.damping")}
            r = tactus.Graph(WALL).render(duration=0.3, rate=1000, set=values, record=["motor.force", "hand.position"])
            force, z = r["motor.force"], r["hand.position"][:, 2]
            size = np.linalg.norm(force, axis=1)
            for name, value in (("peak", size.max()), ("max", force[:, 2].max()), ("min", force[:, 2].min()), ("last", force[-1, 2])):
                self.assertEqual(results[name][i], value, name)
            work = np.cumsum((force[:-1] * np.diff(r["hand.position"], axis=0)).sum(axis=1))
            for name, value in (("mean", force[:, 2].mean()), ("rms", np.sqrt((size**2).mean())), ("work", work[-1]), ("given", max(0.0, work.max()))):
                self.assertAlmostEqual(results[name][i], value, delta=1e-9 * max(1.0, abs(value)), msg=name)
            held = [k for k in range(len(z) - 10) if (z[k:k + 11] >= -0.004).all()]
            self.assertEqual(results["reach"][i], held[0] / 1000.0) if held else self.assertTrue(np.isnan(results["reach"][i]))
            self.assertTrue(np.isnan(results["below"][i]))
            self.assertEqual(results["band"][i], _measures.band(force, 1000.0, 20.0, 200.0))

    def test_a_band_holds_the_rms_of_what_is_in_it(self):
        t = np.arange(1000) / 1000.0
        sine = 3.0 * np.sin(2 * np.pi * 50.0 * t) + 2.0 * np.sin(2 * np.pi * 300.0 * t) + 7.0
        for values, low, high, rms in ((sine, 40.0, 60.0, 3.0 / np.sqrt(2.0)), (np.stack([sine, sine, 0 * sine], axis=1), 0.0, 501.0, np.sqrt(13.0)),
                                       (np.arange(1000) % 2, 0.0, 501.0, 0.5)):   # the last: all of it at half the rate
            self.assertAlmostEqual(_measures.band(values, 1000.0, low, high), rms, places=9)

    def test_functions_get_the_records_and_the_point(self):
        measures = [lab.Measure("f", "function", function="f", outputs=["z", "k"])]
        results = wall(measures=measures).run(self.folder / "out", functions={"f": last_and_stiffness})
        self.assertEqual(list(results["f_k"]), list(results["wall.stiffness"]))
        self.fails("study/no_function", wall(measures=measures).prepare)

    def test_settings_devices_rates_seeds_and_records(self):
        study = lab.Study(name="wood", graph="dry_wood", duration=0.2, keep=["motor.force"], factors=[
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


class Renders(Quiet):
    def test_a_run_that_goes_back_has_the_bits_and_messages_of_a_new_one(self):
        draw = random.Random(1)

        def near(value):
            found = re.fullmatch(r"(-?[\d.]+)(.*)", str(value))
            return json.dumps(f"{float(found[1]) * draw.uniform(0.8, 1.2)!r}{found[2]}" if found else value)

        different = 0
        for file in sorted(GRAPHS.glob("*.json")):
            graph = tactus.Graph(file)
            described = json.loads(graph.text)
            given = {f"{node}.{param}": value for node, about in described["nodes"].items() for param, value in about.get("params", {}).items()
                     if isinstance(value, (int, float, str))}
            points = [[*map(near, given.values()), *(repr(draw.random()) for _ in described.get("controls", ()))] for _ in range(3)]
            points.append([*points[0][:-1], '"3 apples"'])   # one with an error, and after it the first one again
            points.append(points[0])

            def render(some):
                return _tactus.render_points(graph._graph, 0.0, [], {}, [*given, *described.get("controls", ())], some, {}, "", None, None, 1.0, [], True, 0)

            together, alone = render(points), [render([point]) for point in points]
            self.assertEqual([error[1:] for error in together["errors"]], [error[1:] for each in alone for error in each["errors"]], file.name)
            self.assertEqual(together["warnings"], {key: text for each in reversed(alone) for key, text in each["warnings"].items()}, file.name)
            self.assertEqual([rows.tobytes() for rows in together["rows"]], [each["rows"][0].tobytes() for each in alone], file.name)
            different += together["rows"][0].tobytes() != together["rows"][1].tobytes()
        self.assertGreater(different, 30)   # the points are not all the same


def last_and_stiffness(records, point):
    return records["motor.force"][-1, 2] if "motor.force" in records else 0.0, point["wall.stiffness"]


def breaks(records, point):
    return 1.0 / (point["wall.damping"] - 0.5)


class Errors(Quiet):
    def test_a_bad_point_is_a_row_with_its_error_and_its_place(self):
        factors = [lab.Factor("wall.stiffness", values=[1000, -5, "3 apples", 2000])]
        results = wall(factors=factors).run(self.folder / "out")
        self.assertEqual([bool(e) for e in results["error"]], [False, True, True, False])
        self.assertIn("param/out_of_range", results["error"][1])
        self.assertIn("wall", results["error_place"][1] + results["error"][1])
        self.assertEqual([bool(v) for v in np.isnan(results["peak"])], [False, True, True, False])

    def test_an_exception_in_a_function_is_one_too(self):
        results = wall(measures=[lab.Measure("f", "function", function="f")]).run(self.folder / "out", functions={"f": breaks})
        bad = [i for i, e in enumerate(results["error"]) if e]
        self.assertEqual(bad, [i for i, b in enumerate(results["wall.damping"]) if b == 0.5])
        self.assertIn("ZeroDivisionError", results["error"][bad[0]])
        self.assertRegex(results["error_place"][bad[0]], r"^lab_study_test.py:\d+$")

    def test_what_no_point_could_use_is_refused_at_once(self):
        for changes, name in (({"factors": [lab.Factor("wall.stifness", values=[1])]}, "param/unknown"),
                              ({"measures": [lab.Measure("p", "peak", port="motor.torgue")]}, "port/unknown_port"),
                              ({"measures": [lab.Measure("p", "work", port="motor.force")]}, "study/missing"),
                              ({"measures": [PEAK, PEAK]}, "study/value"), ({"worst": "peek"}, "study/value"), ({"name": "a/b"}, "study/value"),
                              ({"maps": [lab.Map("peak", "wall.stiffness", "x")]}, "study/value"),
                              ({"devices": {"tool": "hid:auto"}}, "study/device"), ({"devices": {"tool": {"driver": "serial"}}}, "study/device"),
                              ({"factors": [lab.Factor("setting:wall", values=[1])]}, "study/value")):
            with self.assertRaises(tactus.Error, msg=changes) as caught:
                wall(**changes).prepare()
            self.assertEqual(caught.exception.id.replace("port/unknown_port", "port/unknown"), name.replace("unknown_port", "unknown"), changes)
        results = wall(factors=[lab.Factor("device:tool", values=["gesture:tap", "hid:auto"])]).run(self.folder / "out")
        self.assertEqual([e[:12] for e in results["error"]], ["", "study/device"])

    def test_files_are_read_strictly(self):
        good = json.loads(wall().text())
        (self.folder / "s.json").write_text(json.dumps(good))
        self.assertEqual(lab.Study.load(self.folder / "s.json").text(), wall().text())
        draw = random.Random(1)
        text = json.dumps(good)
        for _ in range(400):
            at = draw.randrange(len(text))
            (self.folder / "s.json").write_text(text[:at] + draw.choice(["", "x", "{", "1e999", "null", '"', "[[[["]) + text[at + draw.randrange(4):])
            with contextlib.suppress(tactus.Error):
                lab.Study.load(self.folder / "s.json").prepare()
        for pointer, change in (("/factors/0/vary", {"factors": [{"vary": 3}]}), ("/measures/0/kind", {"measures": [{"name": "a", "kind": "peek"}]})):
            (self.folder / "s.json").write_text(json.dumps({**good, **change}))
            self.assertIn(pointer, self.fails("lab/type", lab.Study.load, self.folder / "s.json").where)


class Results(Quiet):
    def bytes_of(self, study, out, executor=None, workers=1, **options):
        study.run(self.folder / out, executor, workers, **options)
        return (self.folder / out / "results.tcol").read_bytes()

    def test_each_executor_gives_the_same_bytes(self):
        study = wall(keep=["motor.force.z"], factors=[lab.Factor("wall.stiffness", values=[1000, 2000, -1, 4000]),
                                                      lab.Factor("wall.damping", values=[0, 1, 2])])
        here = self.bytes_of(study, "here")
        with concurrent.futures.ThreadPoolExecutor(2) as threads:
            self.assertEqual(self.bytes_of(study, "threads", threads, 2), here)
        prepared = study.prepare()
        for shard in (2, 0, 1):
            _drive.drive(prepared, self.folder / "shards", shard=(shard, 3))
            if shard != 1:
                self.fails("study/missing", lab._parts.merge, prepared, self.folder / "shards")
        lab._parts.merge(prepared, self.folder / "shards")
        self.assertEqual((self.folder / "shards/results.tcol").read_bytes(), here)
        files = list((self.folder / "shards/parts").iterdir())
        self.assertEqual(len(files), 3)

    def test_a_worker_elsewhere_gets_the_files_of_the_graph_with_the_study(self):
        folder = self.folder / "there"
        folder.mkdir()
        (folder / "g.json").write_bytes((GRAPHS / "pebbled_leather.json").read_bytes().replace(b"assets/", b""))
        text = json.loads((folder / "g.json").read_text())
        names = re.findall(r'"([\w./]+\.(?:png|csv|obj|stl))"', json.dumps(text))
        self.assertTrue(names)
        picture = np.linspace(0.0, 1.0, 256).reshape(16, 16)
        study = lab.Study(name="leather", graph=str(folder / "g.json"), duration=0.2, factors=[lab.Factor(next(iter(text["controls"])), values=[0.2, 0.9])],
                          measures=[PEAK])
        here = self.bytes_of(study, "here", assets={names[0]: picture})
        prepared = study.prepare(assets={names[0]: picture})
        copied = _worker.pickle.loads(_worker.pickle.dumps(prepared))
        chunk = _worker.Worker(copied, is_far=True).render(points(prepared.design))
        results = lab.load_results(self.folder / "here")
        self.assertEqual(chunk.problems, [])
        self.same_bits(chunk.numbers[:, 0], results["peak"])
        self.assertNotEqual(study.prepare(assets={names[0]: picture * 0.5}).context, prepared.context)
        self.assertTrue(here)

    def test_nothing_is_rendered_twice(self):
        small = wall(factors=[lab.Factor("wall.stiffness", values=[1000, 2000]), lab.Factor("wall.damping", values=[0])])
        large = dataclasses.replace(small, factors=[lab.Factor("wall.stiffness", values=[3000, 2000, 1000]), lab.Factor("wall.damping", values=[0, 1])])
        small.run(self.folder / "out")
        self.fails("study/exists", large.run, self.folder / "out")
        progress = _drive.drive(large.prepare(), self.folder / "out", resume=True)
        self.assertEqual((progress.total, progress._first), (6, 2))   # the key of a result does not depend on the design
        self.assertEqual(len(_parts.Folder(large.prepare(), self.folder / "out", False, False).results().keys), 6)
        merged = lab._parts.merge(large.prepare(), self.folder / "out")
        fresh = large.run(self.folder / "fresh")
        self.same_bits(merged["peak"], fresh["peak"])
        self.fails("study/other", dataclasses.replace(small, duration=0.06).run, self.folder / "out", resume=True)

    def test_equal_points_are_rendered_once(self):
        study = wall(design=lab.Latin(points=50), factors=[lab.Factor("wall.stiffness", values=[1000, 2000]), lab.Factor("wall.damping", values=[0, 1.0])])
        with mock.patch.object(_drive, "BLOCK", 7):
            results = study.run(self.folder / "out")
            self.assertEqual((len(self.held(study)), results.rows), (4, 50))
            self.assertEqual(_drive.drive(study.prepare(), self.folder / "out", resume=True)._first, 50)
        by_number = {(k, b): v for k, b, v in zip(results["wall.stiffness"], results["wall.damping"], results["peak"])}
        self.assertEqual(len(by_number), 4)

    def held(self, study):
        return _parts.Folder(study.prepare(), self.folder / "out", False, False).results().keys

    def test_memory_does_not_grow_with_the_points(self):
        def peak(count):
            study = wall(duration=0.002, design=lab.Sobol(points=count), factors=[lab.Factor("wall.stiffness", low=1000.0, high=5000.0),
                                                                                  lab.Factor("wall.damping", low=0.0, high=1.0)])
            prepared, out, found = study.prepare(), self.folder / str(count), []
            tracemalloc.start()
            for step in (lambda: _drive.drive(prepared, out), lambda: _parts.merge(prepared, out),
                         lambda: _study_report.write(prepared, _columns.Results(out / "results.tcol", keeps=False), out / "report.html", [])):
                tracemalloc.reset_peak()
                with mock.patch.object(_drive._Sizes, "learn", lambda sizes, *_: sizes.__dict__.update(points=1000, seconds=2.0)):   # chunks of 500 points
                    step()
                found.append(tracemalloc.get_traced_memory()[1])
            tracemalloc.stop()
            return np.array(found)

        peak(1000)   # what is imported or made once
        growth = (peak(24000) - peak(8000)) / 16000
        print(f"bytes per point: {growth}", file=sys.__stderr__)
        self.assertLess(growth[0], 24)   # renders
        self.assertLess(growth.max(), 64)   # merge and report

    def test_what_a_crash_cuts_off_is_rendered_again(self):
        study = wall()
        whole = self.bytes_of(study, "out")
        part = next((self.folder / "out/parts").iterdir())
        data = part.read_bytes()
        draw = random.Random(2)
        for _ in range(12):
            cut = draw.randrange(len(data))
            damaged = data[:cut] if draw.random() < 0.6 else data[:cut] + bytes([data[cut] ^ 1]) + data[cut + 1:]
            for old in (self.folder / "out/parts").iterdir():
                old.unlink()
            part.write_bytes(damaged)
            if damaged[:8] != data[:8] and len(damaged) > 8:
                self.fails("study/part", study.run, self.folder / "out", resume=True)
                continue
            self.assertEqual(self.bytes_of(study, "out", resume=True), whole)

    def test_results_that_differ_are_noticed(self):
        study = wall()
        study.run(self.folder / "out")
        prepared = study.prepare()
        part = _parts.Part(self.folder / "out/parts", prepared.context, _worker.stamp())
        chunk, key = _worker.Worker(prepared, False).render([prepared.design.at(3)]), prepared.key(prepared.design.at(3))
        part.add(key, chunk)
        lab._parts.merge(prepared, self.folder / "out")   # the same result twice is one row
        chunk.numbers[0, 0] = np.nextafter(chunk.numbers[0, 0], np.inf)
        part.add(key, chunk)
        part.close()
        self.fails("study/differs", lab._parts.merge, prepared, self.folder / "out")

    def test_another_version_is_refused_or_marked(self):
        study = wall()
        study.run(self.folder / "out")
        part = next((self.folder / "out/parts").iterdir())
        prepared = study.prepare()
        other = _parts.Part(self.folder / "out/parts", prepared.context, ("0.1.0", "other-1"))
        other.add(prepared.key(prepared.design.at(0)), _worker.Worker(prepared, False).render([prepared.design.at(0)]))
        other.close()
        self.assertIn("0.1.0", self.fails("study/other_version", lab._parts.merge, prepared, self.folder / "out").text)
        part.unlink()
        self.fails("study/other_version", study.run, self.folder / "out", resume=True)
        results = study.run(self.folder / "out", resume=True, mixed=True)
        self.assertEqual([o["tactus"] for o in results.about["origins"]], ["0.1.0", tactus.__version__])
        self.assertEqual(list(results["origin"]), [0] + [1] * 29)

    def test_the_reader_of_the_page_reads_all(self):
        wall(keep=["motor.force.z"], factors=[lab.Factor("wall.stiffness", values=["1 N/mm", 2000, -1])]).run(self.folder / "out")
        page = (ROOT / "docs/studies.md").read_text(encoding="utf-8")
        source = re.search(r"```python\n(import json\n.*?def read_columns.*?)```", page, re.S)[1]
        self.assertLessEqual(len(source.strip().splitlines()), 30)
        names = {}
        exec(source, names)
        for file in ("results.tcol", "times.tcol"):
            mine, about = names["read_columns"](self.folder / "out" / file)
            theirs = _columns.Results(self.folder / "out" / file)
            self.assertEqual(about, theirs.about)
            for name, values in theirs.items():
                pairs = zip(mine[name], values) if isinstance(values, list) and values and not isinstance(values[0], str) else [(mine[name], values)]
                for a, b in pairs:
                    self.assertTrue(a == b if isinstance(b, list) else np.array_equal(a, b, equal_nan=b.dtype.kind == "f"), name)
        data = (self.folder / "out/results.tcol").read_bytes()
        for cut in range(0, len(data), 97):
            (self.folder / "cut").write_bytes(data[:cut])
            self.fails("study/unreadable", _columns.Results, self.folder / "cut")

    def test_chunks_are_about_a_second(self):
        sizes = _drive._Sizes(1, 10**6)
        self.assertEqual(sizes.next(), 1)
        for _ in range(8):
            size = sizes.next()
            sizes.learn(size, size * 0.002)
        self.assertEqual(sizes.next(), 500)
        told = io.StringIO()
        now = [0.0]
        progress = _drive.Progress(1000, 0, 0, told, lambda: now[0])
        now[0] = 6.0
        progress.add(100, 1)
        self.assertEqual(told.getvalue(), "100 of 1000 points, 1 with errors, 0:00:54 left\n")


class Report(Quiet):
    def test_the_page_works_offline_and_no_text_becomes_markup(self):
        factors = [lab.Factor("wall.stiffness", values=[1000, 5000, -1]), lab.Factor("wall.damping", values=[0, 0.5])]
        study = wall(about="<script>alert(1)</script>", factors=factors,
                     maps=[lab.Map("peak", "wall.damping", "wall.stiffness", limits=bool(PROGRAM))])
        results = study.run(self.folder / "out")
        page = _study_report.page(study.prepare(), results, ["tactus", "study", "wa ll.json"])
        ElementTree.fromstring(re.sub(r"<meta[^>]*>|<!DOCTYPE html>", "", page))   # each tag is closed
        self.assertNotIn("<script", page)
        self.assertEqual(re.findall(r'(?:src|href)="(?!data:image/png)', page), [])
        self.assertIn("tactus study 'wa ll.json' --point", page.replace("&#x27;", "'"))
        self.assertIn("2 points with errors", page)
        if PROGRAM:
            self.assertRegex(page, 'stroke="#c00"[^>]*/><text[^>]*>—— passive<')

    def test_a_map_shows_each_cell_at_its_place(self):
        measures = [lab.Measure("k", "function", function="f", outputs=["z", "k"])]
        results = wall(measures=measures).run(self.folder / "out", functions={"f": last_and_stiffness})
        axis = _study_report._Axis("wall.stiffness", results["wall.stiffness"], "")
        self.assertEqual(list(axis._middles), sorted(set(results["wall.stiffness"])))
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
        if not (self.folder / "out/study.json").exists():
            return set()
        keys = _parts.Folder(self.prepared, self.folder / "out", False, False).results().keys.tolist()
        self.assertEqual(len(set(keys)), len(keys), "a point was rendered twice")
        return set(keys)

    def same(self):
        self.assertEqual((self.folder / "out/results.tcol").read_bytes(), (self.folder / "whole/results.tcol").read_bytes())

    def survives(self, start, victims, is_over=lambda process: process.poll() is not None, stays=False):
        """start: begins or resumes the study. victims: the numbers of processes that may be killed. stays: the last kill is that of the process that was
        started, in the first half of the study, and the study stays as it is then."""
        seed = int(os.environ.get("TACTUS_SEED", "1"))
        print(f"{self.id()}: seed {seed}, {KILLS} kills", file=sys.__stderr__)
        draw, known, kills, count = random.Random(seed), set(), 0, self.prepared.design.count

        def next_kill():
            return len(known) + draw.randrange(1, 25) if kills < KILLS else count + 1

        while True:
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
            if len(known) == count and (self.folder / "out/results.tcol").exists():
                self.same()
                if kills >= KILLS:
                    return
                shutil.rmtree(self.folder / "out")   # it was faster than the kills; begin again
                known = set()


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
        said = self.ran("--functions", "f.py", "--workers", "2", "--to", "csv")
        self.assertIn("6 with errors", said)
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
        factors = [lab.Factor("wall.stiffness", values=[1000, 2000]), lab.Factor("device:tool/mass", values=[0.2])]
        self.write(wall(set={"wall.damping": 1}, factors=factors))
        self.assertIn("tactus-host", self.ran("--point", "1"))
        rows = np.loadtxt(self.folder / "out/point-1.csv", delimiter=",", skiprows=1)
        there = tactus.Graph(self.folder / "out/point-1.json").render(duration=0.05)
        self.assertEqual(len(rows), 50)
        self.same_bits(rows[:, 3], there["motor.force"][:, 2])
        for words in (["--point", "2"], ["--shard", "2/2"], ["--workers", "0"], ["--executor", "none"]):
            self.ran(*words, status=2)
        self.ran("--status", out="none", status=1)
        self.assertIn("--array=0-1", self.ran("--executor", "slurm", "--workers", "8", "--dry-run"))
        if PROGRAM:
            done = subprocess.run([PROGRAM, "study", "s.json", "--out", "cli", "--executor", "serial"], capture_output=True, text=True, cwd=self.folder,
                                  env={**os.environ, "PATH": f"{pathlib.Path(sys.executable).parent}:{os.environ['PATH']}"})
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("2 points, 0 with errors", done.stdout)


class Examples(Quiet):
    """The numbers that docs/studies.md names."""

    def results(self, name):
        return lab.Study.load(EXAMPLES / f"{name}.json").run(self.folder / name)

    def test_the_wall(self):
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
        for name, low, median, high in (("bottom", 0.689, 0.7216, 0.801), ("peak", 0.791, 1.480, 2.651)):
            for a, b in zip((low, median, high), (r[name].min(), np.median(r[name]), r[name].max())):
                self.assertLess(abs(b / a - 1.0), 0.01, name)

    def test_the_fit(self):
        done = subprocess.run([sys.executable, "-B", str(EXAMPLES / "fit.py"), str(self.folder)], capture_output=True, text=True, check=True)
        self.assertEqual(re.findall(r"(\w+)\.csv: mu ([\d.]+)", done.stdout), [("felt", "0.35"), ("ice", "0.10"), ("oak", "0.25"), ("rubber", "0.80")])
        for rest in re.findall(r"rest ([\d.]+)", done.stdout):
            self.assertLess(abs(float(rest) - 0.02), 0.002)   # the noise of the recordings
        source = (EXAMPLES / "fit.py").read_text(encoding="utf-8")
        self.assertLessEqual(len(source.splitlines()), 60)


if __name__ == "__main__":
    unittest.main()
