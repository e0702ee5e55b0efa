# SPDX-License-Identifier: MIT
"""The examples, the notebook and the experiments of the literature, with simulated observers."""

import ast
import contextlib
import importlib.util
import io
import json
import os
import sys
import unittest

from support import ROOT, TestCase
from tactus import lab

EXAMPLES = ROOT / "docs/examples/lab"
NOTEBOOK = ROOT / "docs/tutorials/lab.ipynb"

os.environ["MPLBACKEND"] = "Agg"
matplotlib = importlib.util.find_spec("matplotlib")


def run_cell(source, names):
    """What a cell prints, and then the value of its last expression, as Jupyter shows them."""
    *parts, last = ast.parse(source).body
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        exec(compile(ast.Module(parts, []), "cell", "exec"), names)
        shown = eval(compile(ast.Expression(last.value), "cell", "eval"), names)   # each cell ends with an expression
    return said.getvalue() + ("" if shown is None else repr(shown))


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
        cells = [cell for cell in json.loads(NOTEBOOK.read_text(encoding="utf-8"))["cells"] if cell["cell_type"] == "code"]
        names = {}
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        for cell in cells:
            stored = "".join(text for output in cell["outputs"] for text in output.get("text", output.get("data", {}).get("text/plain", [])))
            self.assertEqual(run_cell("".join(cell["source"]), names), stored, cell["id"])


if __name__ == "__main__":
    unittest.main()
