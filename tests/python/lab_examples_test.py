# SPDX-License-Identifier: MIT
"""The examples, the notebook and the experiments of the literature, with simulated observers."""

import ast
import importlib.util
import os
import sys
import unittest

from support import ROOT, TestCase, run_notebook
from tactus import lab

EXAMPLES = ROOT / "docs/examples/lab"

os.environ["MPLBACKEND"] = "Agg"
matplotlib = importlib.util.find_spec("matplotlib")


class Literature(TestCase):
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


class Examples(TestCase):
    def test_they_have_forty_lines_at_most(self):
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
class Notebook(TestCase):
    def test_its_outputs_are_those_of_this_program(self):
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        for cell, said, stored in run_notebook(ROOT / "docs/tutorials/lab.ipynb")[1]:
            self.assertEqual(said, stored, cell)


if __name__ == "__main__":
    unittest.main()
