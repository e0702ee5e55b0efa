# SPDX-License-Identifier: MIT
"""Protocols of tactus.lab, the order of their trials, and their procedures; the examples, the notebook and the experiments of the literature."""

import ast
import collections
import itertools
import json
import math
import os
import sys
import unittest
from importlib.util import find_spec

import numpy as np
import tactus
from support import ROOT, TestCase, run_notebook
from tactus import lab
from tactus.lab._procedures import Draw, PsiTrack, StaircaseTrack, latin_square

EXAMPLES = ROOT / "docs/examples/lab"
os.environ["MPLBACKEND"] = "Agg"
matplotlib = find_spec("matplotlib")


def block(name="main", task="2ifc", procedure=None, **more):
    return lab.Block(name=name, task=task, procedure=procedure or lab.Constant(levels=(1.0, 2.0, 3.0), repeats=4),
                     varies=lab.Varies(target="x", unit="N"), **more)


def protocol(*blocks, **more):
    return lab.Protocol(name="tried", blocks=list(blocks) or [block()], **more)


def walk(plan, answer):
    """Goes through a plan, with the answers of a function. The texts, and the trials."""
    texts, trials = [], []
    while (step := plan.step) is not None:
        (trials if isinstance(step, lab.Trial) else texts).append(step)
        plan.answer(answer(step) if isinstance(step, lab.Trial) else None)
    return texts, trials


class Protocols(TestCase):
    def load(self, data):
        (self.folder / "p.json").write_text(data if isinstance(data, str) else json.dumps(data), encoding="utf-8")
        return lab.Protocol.load(self.folder / "p.json")

    def test_a_file_and_python_say_the_same(self):
        made = protocol(block("a", conditions=["rough"]), block("b", "yes_no", lab.Staircase(start=2.0, high=5.0), catch=0.2),
                        block("c", procedure=lab.Psi(levels=(1.0, 2.0), widths=(0.5, 1.0))), conditions=[lab.Condition(name="rough", controls={"x": 0.5})],
                        seed=7, order="latin_square", triggers=lab.Triggers(port="/dev/null"), hand={"yes": lab.HandAnswer(port="hand.x", above=0.1)})
        made.save(self.folder / "p.json")
        read = lab.Protocol.load(self.folder / "p.json")
        self.assertEqual((read, read.hash()), (made, made.hash()))

    def test_each_mistake_names_its_place_and_the_remedy(self):
        stairs = {"kind": "staircase", "start": 2.0, "high": 5.0}
        for id, where, key, value in (   # what is changed in the protocol or, below /blocks/0, in its block
                ("lab/unknown_key", "/seeed", "seeed", 1), ("lab/type", "/blocks", "blocks", []), ("lab/value", "/name", "name", "a/b"),
                ("lab/type", "/blocks/0/task", "task", "4afc"), ("lab/type", "/blocks/0/procedure", "procedure", {**stairs, "kind": "quest"}),
                *(("lab/value", f"/blocks/0/procedure/{key}", "procedure", {**stairs, key: value}) for key, value in (("down", 0), ("start", 9.0))),
                *(("lab/type", "/blocks/0/procedure/start", "procedure", {**stairs, "start": start}) for start in ("1", math.nan)),
                *(("lab/type", "/blocks/0/practice", "practice", count) for count in (1.5, True)),
                ("lab/value", "/blocks/0/conditions", "conditions", ["none"]), ("lab/value", "/blocks/0/procedure", "task", "magnitude"),
                ("lab/device", "/devices/pen", "devices", {"pen": "hid:auto"}), ("lab/value", "/hand/maybe", "hand", {"maybe": {"port": "a", "above": 1}}),
                ("lab/value", "/triggers/codes/trial", "triggers", {"port": "x", "codes": {"trial": 256}})):
            with self.subTest(id + where):
                data = json.loads(protocol(block(procedure=lab.Staircase(start=2.0, high=5.0))).text())
                (data["blocks"][0] if where.startswith("/blocks/0") else data)[key] = value
                self.assertEqual(self.fails(id, self.load, data).where, where)
        self.assertEqual(self.fails("lab/missing", self.load, {"blocks": []}).where, "/")
        for text in ("", "[1]", "{", '{"format": 3}', "[" * 100000):
            self.assertRaises(tactus.Error, self.load, text)

    def test_levels_must_fit_the_graph(self):
        data = {"name": "wood", "graph": "dry_wood", "blocks": [{"name": "a", "task": "greater", "varies": {"target": "roughness"},
                                                               "procedure": {"kind": "constant", "levels": [0.2, 0.9]}}]}
        self.assertEqual(self.load(data).graph_of(lab.Condition(name="a")).name, "Dry wood")
        for id, key, value in (("lab/value", "procedure", {"kind": "constant", "levels": [0.2, 1.5]}), ("lab/value", "varies", {"target": "no_such_control"}),
                               ("param/unknown", "varies", {"target": "drag.nothing"})):
            data["blocks"][0][key] = value
            self.fails(id, self.load, data)

    def test_the_schema_has_every_field_with_its_meaning(self):
        schema = lab.schema()
        self.assertEqual(set(schema["properties"]), set(lab.Protocol.__dataclass_fields__))
        blocks = schema["properties"]["blocks"]["items"]
        procedures = blocks["properties"]["procedure"]["oneOf"]
        self.assertEqual([option["properties"]["kind"]["enum"] for option in procedures], [["constant"], ["staircase"], ["psi"]])
        for part in (schema, blocks, *procedures):
            for name, field in part["properties"].items():
                self.assertTrue(field.get("description") or "oneOf" in field, name)
            self.assertFalse(part["additionalProperties"])

    def test_a_snapshot_of_a_file_or_of_the_window_gives_values_and_the_condition_overrides_them(self):
        (self.folder / "s.json").write_text('{"set": {"drag.mu": 0.2}, "controls": {"roughness": 0.1}}', encoding="utf-8")
        made = protocol(folder=str(self.folder))
        values = made.values_of(lab.Condition(name="a", snapshot="s.json", controls={"roughness": 0.7}))
        self.assertEqual(values, ({"drag.mu": 0.2}, {"roughness": 0.7}))
        wood = json.loads(tactus.Graph("dry_wood").text)
        stored = {"nodes": {"drag": {"type": wood["nodes"]["drag"]["type"], "params": {"mu": 0.11}, "overrides": {}}, "gone": {"type": "x", "params": {}}},
                  "graphs": {}, "controls": {"roughness": 0.9}}
        (self.folder / "g.json").write_text(json.dumps({**wood, "ui": {"snapshots": {"2": stored}}}), encoding="utf-8")
        made = protocol(graph="g.json", folder=str(self.folder))
        graph = made.graph_of(lab.Condition(name="a", snapshot="2", set={"grain.amplitude": 0.05}))
        self.assertEqual((dict(graph.nodes["drag"].params), graph.controls["roughness"].value), ({"mu": 0.11}, 0.9))
        self.assertEqual(graph.nodes["grain"].params["amplitude"], 0.05)
        self.assertEqual(self.fails("lab/value", made.graph_of, lab.Condition(name="a", snapshot="3")).remedy, "its snapshots: 2")

    def test_it_follows_from_the_seed_and_the_participant(self):
        first, again, *others = ([(t.level, t.expected) for t in walk(lab.Plan(protocol(seed=seed), participant), lambda t: "first")[1]]
                                 for seed, participant in ((1, "01"), (1, "01"), (2, "01"), (1, "02")))
        self.assertEqual(first, again)
        self.assertNotIn(first, others)

    def test_the_draws_are_those_of_every_version(self):
        self.assertEqual(Draw(1, "01", "main").order(range(8)), [0, 6, 5, 4, 1, 7, 3, 2])
        z = [Draw(9, i).normal() for i in range(4000)]
        self.assertLess(abs(np.mean(z)), 4.0 / math.sqrt(4000))
        self.assertLess(abs(np.std(z) - 1.0), 0.05)

    def test_constant_stimuli_come_equally_often_in_rounds_and_the_position_of_the_comparison_varies(self):
        made = protocol(block(conditions=["a", "b"], procedure=lab.Constant(levels=(1.0, 2.0, 3.0), repeats=20)),
                        conditions=[lab.Condition(name="a"), lab.Condition(name="b")])
        trials = walk(lab.Plan(made), lambda t: "first")[1]
        self.assertEqual(set(collections.Counter((t.condition, t.level) for t in trials).values()), {20})
        of_a = [t.level for t in trials if t.condition == "a"]
        self.assertTrue(all(sorted(of_a[i:i + 3]) == [1.0, 2.0, 3.0] for i in range(0, 60, 3)))
        firsts = sum(t.expected == "first" for t in trials)
        self.assertTrue(40 < firsts < 80, firsts)
        self.assertEqual({t.expected: t.intervals[0].level == t.level for t in trials}, {"first": True, "second": False})

    def test_practice_catch_trials_breaks_and_missed_trials(self):
        made = protocol(block(practice=3, catch=0.25, break_every=6, instructions="read this", procedure=lab.Constant(levels=(1.0, 2.0), repeats=30)),
                        instructions="welcome")
        texts, trials = walk(lab.Plan(made), lambda t: None if t.number % 7 == 0 else t.expected)
        missed = sum(t.number % 7 == 0 and t.kind == "main" for t in trials)
        self.assertEqual(texts[:3], ["welcome", "read this", "The practice is over."])
        self.assertEqual(texts.count("Take a break."), 9)   # a trial without an answer brings no second one
        self.assertEqual([t.kind for t in trials[:3]], ["practice"] * 3)
        counts = collections.Counter(t.kind for t in trials)
        self.assertEqual(counts["main"], 60 + missed)   # a missed trial comes again
        self.assertTrue(0.1 < counts["catch"] / (counts["catch"] + counts["main"]) < 0.4, counts)
        self.assertEqual({t.level for t in trials if t.kind == "catch"}, {0.0})

    def test_abx_and_match_have_their_intervals(self):
        for t in walk(lab.Plan(protocol(block(task="abx"))), lambda t: "a")[1]:
            self.assertEqual(t.intervals[2].level, t.intervals["ab".index(t.expected)].level)
        for t in walk(lab.Plan(protocol(block(task="match", step=0.1))), lambda t: 2.0)[1]:
            self.assertEqual([i.label for i in t.intervals], ["standard", "yours"])

    def test_a_latin_square_is_balanced(self):
        for n in (2, 3, 4, 5, 6):
            rows = [latin_square(n, i) for i in range(n if n % 2 == 0 else 2 * n)]
            for place in range(n):
                self.assertEqual(set(collections.Counter(row[place] for row in rows).values()), {len(rows) // n})
            follows = collections.Counter((row[i], row[i + 1]) for row in rows for i in range(n - 1))
            self.assertEqual((len(follows), len(set(follows.values()))), (n * (n - 1), 1))
        made = protocol(block("a"), block("b"), order="latin_square")
        firsts = [walk(lab.Plan(made, participant), lambda t: "first")[1][0].block.name for participant in ("01", "02", "03")]
        self.assertEqual(firsts, ["a", "b", "a"])

    def run_track(self, track, chance, seed=1):
        draw, levels = Draw(seed, "answers"), []
        while (level := track.level()) is not None:
            levels.append(level)
            track.answer(level, float(draw.uniform() < chance(level)))
        return levels

    def test_a_staircase_steps_as_its_rule_says_and_its_reversals_have_a_mean(self):
        track = StaircaseTrack(lab.Staircase(start=10.0, steps=(4.0, 2.0, 1.0), low=0.0, trials=12))
        levels = []
        for outcome in (1, 1, 1, 1, 0, 1, 1, 0, 1, 1, 1, 1):
            levels.append(track.level())
            track.answer(track.level(), float(outcome))
        self.assertEqual(levels, [10, 10, 6, 6, 2, 4, 4, 3, 4, 4, 3, 3])
        self.assertEqual(track.turns, [2, 4, 3, 4])
        self.assertIsNone(track.level())
        weighted = StaircaseTrack(lab.Staircase(start=10.0, steps=(1.0,), down=1, up_factor=3.0))
        weighted.answer(10.0, 0.0)
        self.assertEqual(weighted.level(), 13.0)
        ratio = StaircaseTrack(lab.Staircase(start=8.0, steps=(2.0,), down=1, scale="ratio", reversals=2))
        for outcome, after in ((1, 4.0), (1, 2.0), (0, 4.0), (1, None)):
            ratio.answer(ratio.level(), float(outcome))
            self.assertEqual(ratio.level(), after)
        self.assertEqual(lab.mean_of_turns([9.0, 9.0, 1.0, 3.0, 2.0]), 2.5)
        self.assertAlmostEqual(lab.mean_of_turns([9.0, 9.0, 1.0, 4.0], ratio=True), 2.0)
        self.assertTrue(math.isnan(lab.mean_of_turns([1.0])))

    def test_staircases_converge_where_they_should(self):
        """1 up 1 down at 50 %, 2 down at 70.7 %, weighted 3:1 at 75 % (Levitt 1971, Kaernbach 1991)."""
        for rule, aim in (({"down": 1}, 0.5), ({"down": 2}, math.sqrt(0.5)), ({"down": 1, "up_factor": 3.0}, 0.75)):
            track = StaircaseTrack(lab.Staircase(start=3.0, steps=(0.5, 0.1), low=-100.0, trials=4000, **rule))
            levels = self.run_track(track, lambda x: 1.0 / (1.0 + math.exp(-x)))
            there = 1.0 / (1.0 + math.exp(-np.mean(levels[100:])))
            self.assertLess(abs(there - aim), 0.02, rule)

    def test_the_psi_method_finds_the_threshold_and_asks_near_it(self):
        given = lab.Psi(levels=tuple(np.linspace(1.0, 10.0, 19)), widths=(0.25, 0.5, 1.0, 2.0), lapses=(0.0, 0.02, 0.05), trials=150)
        track = PsiTrack(given)
        levels = self.run_track(track, lambda x: float(lab.probability("logistic", x, 4.0, 0.5, 0.5, 0.02)))
        over, possible = track.posterior.sum(axis=(1, 2)), np.array(given.levels)
        mean = over @ possible
        self.assertLess(abs(mean - 4.0), 3.0 * math.sqrt(over @ (possible - mean) ** 2) + 0.1)
        self.assertLess(np.median(np.abs(np.array(levels) - 4.0)), 1.6)
        self.assertAlmostEqual(float(track.posterior.sum()), 1.0, 12)

    def test_the_next_level_of_psi_is_that_of_the_least_expected_entropy(self):
        """Written again, with a list of hypotheses."""
        given = lab.Psi(levels=(1.0, 2.0, 4.0), thresholds=(1.0, 3.0), widths=(0.5, 1.0), lapses=(0.0, 0.04), trials=9)
        track, hypotheses = PsiTrack(given), list(itertools.product(given.thresholds, given.widths, given.lapses))
        right = {x: np.array([0.5 + (0.5 - lapse) / (1.0 + math.exp(-(x - t) / w)) for t, w, lapse in hypotheses]) for x in given.levels}
        belief = np.full(8, 0.125)
        for outcome in (1.0, 0.0, 1.0, 1.0, 0.0):
            joints = {x: (belief * right[x], belief * (1.0 - right[x])) for x in given.levels}
            entropies = {x: -sum(joint @ np.log(joint / joint.sum()) for joint in both) for x, both in joints.items()}
            level = track.level()
            self.assertAlmostEqual(entropies[level], min(entropies.values()), 9)
            track.answer(level, outcome)
            belief = joints[level][0 if outcome else 1]
            belief = belief / belief.sum()


class Examples(TestCase):
    def run_one(self, name, **observer):
        window = lab.Simulated(lab.Observer(**observer, seed=3))
        return lab.Experiment(lab.Protocol.load(EXAMPLES / f"{name}.json"), self.folder, window=window, stage=lab.Silent()).run()

    def test_the_stiffness_jnd(self):
        fit = self.run_one("stiffness", threshold=500.0, width=105.0, lapse=0.01).fit()
        self.assertEqual(int(fit.trials.sum()), 280)
        self.assertTrue(fit.threshold_interval.low < 500.0 < fit.threshold_interval.high, fit)
        self.assertTrue(fit.width_interval.low < 105.0 < fit.width_interval.high, fit)
        self.assertLess(abs(fit.jnd / 500.0 - 0.23), 0.07)   # ln (3) * 105 / 500

    def test_the_magnitude_of_roughness(self):
        law = self.run_one("roughness", threshold=1.0, width=1.0, gain=40.0, exponent=0.6, noise=0.2).fit()
        self.assertTrue(law.exponent_interval.low < 0.6 < law.exponent_interval.high, law)

    def test_the_detection_of_a_grating(self):
        data = self.run_one("grating", threshold=0.02, width=0.004)
        fit = data.fit()
        self.assertTrue(fit.threshold_interval.low < 0.02 < fit.threshold_interval.high, fit)
        self.assertLess(abs(lab.mean_of_turns(data.turns()["graph/0"], ratio=True) - 0.0185), 0.006)

    def test_examples_have_forty_lines_at_most(self):
        for path in EXAMPLES.glob("*.py"):
            self.assertLessEqual(len(path.read_text(encoding="utf-8").splitlines()), 40, path.name)
            ast.parse(path.read_text(encoding="utf-8"))

    def test_the_staircase_finds_the_threshold(self):
        said = self.ran("-B", EXAMPLES / "staircase.py", *([self.folder] if matplotlib else []), program=sys.executable)
        low, high = (float(x.rstrip("),")) for x in said.split("95 % ")[1].split(",")[0].split(" to "))
        self.assertTrue(low < 0.4 < high, said)
        if matplotlib:
            self.assertTrue((self.folder / "fit.svg").read_text(encoding="utf-8").startswith("<?xml"))

    def test_the_participant_learns_the_wall_twice(self):
        sys.path.insert(0, str(EXAMPLES))
        import learns_a_wall
        forces = learns_a_wall.learn()
        self.assertTrue(forces[0] > 1.5 and abs(forces[5] - 1.0) < 0.05, forces)   # it overshoots, and learns
        self.assertTrue(forces[6] > 1.5 and abs(forces[11] - 1.0) < 0.05, forces)  # a stiffer wall
        self.assertIn("<td>12</td>", self.ran("-B", EXAMPLES / "learns_a_wall.py", program=sys.executable))

    @unittest.skipUnless(matplotlib, "python3-matplotlib is not installed")
    def test_the_outputs_of_the_notebook_are_those_of_this_program(self):
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        for cell, said, stored in run_notebook(ROOT / "docs/tutorials/lab.ipynb")[1]:
            self.assertEqual(said, stored, cell)


if __name__ == "__main__":
    unittest.main()
