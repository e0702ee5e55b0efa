# SPDX-License-Identifier: MIT
"""The notebook and the script that draw Fig. 4, and tactus.plot."""

import pathlib
import sys
import tempfile
import unittest

import numpy as np
import tactus
from support import ROOT, TestCase, drag, positions, run_notebook

EXAMPLES = ROOT / "docs" / "examples" / "python"
sys.path.insert(0, str(EXAMPLES))

try:
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
except ImportError:
    print("skipped: python3-matplotlib is not installed")
    sys.exit(77)


def lines_of(ax):
    return [line.get_xydata() for line in ax.get_lines()]


class Fig4(TestCase):
    def of_the_docs(self):
        return tactus.Graph(ROOT / "docs" / "figures" / "friction_trace.json").render(
            duration=4, record=["tool.out", "contact.deflection", "contact.state"])

    def test_notebook_and_script_draw_the_same_curve_as_the_docs(self):
        import fig4
        names, _ = run_notebook(EXAMPLES / "fig4.ipynb")
        docs = self.of_the_docs()
        by_script = fig4.make_graph().render(duration=4.0, record=list(docs)[1:])
        for port in docs:
            self.same_bits(docs[port], names["run"][port])
            self.same_bits(docs[port], by_script[port])
        figure, ax = pyplot.subplots()
        self.addCleanup(pyplot.close, "all")
        fig4.draw(by_script, ax)
        drawn = lines_of(names["ax"])
        self.assertEqual(len(drawn), 501)   # 500 leashes and the path of the tool
        for a, b in zip(drawn, lines_of(ax)):
            self.same_bits(a, b)

    def test_the_leashes_are_never_longer_than_d_max(self):
        names, _ = run_notebook(EXAMPLES / "fig4.ipynb")
        self.addCleanup(pyplot.close, "all")
        lengths = [np.linalg.norm(np.diff(leash, axis=0)) for leash in lines_of(names["ax"])[:-1]]
        self.assertLess(max(lengths), 1 + 1e-9)
        self.assertGreater(np.mean(np.array(lengths) > 1 - 1e-9), 0.25)   # the contact slips there

    def test_the_script_writes_a_picture(self):
        import fig4
        with tempfile.TemporaryDirectory() as folder:
            picture = pathlib.Path(folder) / "fig4.png"
            before, sys.argv = sys.argv, ["fig4.py", str(picture)]
            try:
                fig4.main()
            finally:
                sys.argv = before
            self.assertTrue(picture.read_bytes().startswith(b"\x89PNG"))


class Plot(TestCase):
    def records(self):
        return drag().render(feed={"drag.position": positions(50), "drag.normal_force": 1.0}, record=["drag.force", "drag.state", "drag.deflection"])

    def test_ports_of_one_unit_share_axes(self):
        self.addCleanup(pyplot.close, "all")
        run = self.records()
        figure = tactus.plot(run)
        self.assertEqual([ax.get_ylabel() for ax in figure.axes], ["N", "1", "m"])
        self.assertEqual([len(ax.get_lines()) for ax in figure.axes], [3, 1, 3])
        self.assertEqual(figure.axes[-1].get_xlabel(), "t (s)")
        loop = tactus.plot(run, ["drag.force.x"], over="drag.deflection.x").axes[0]
        self.same_bits(loop.get_lines()[0].get_xydata(), np.column_stack([run["drag.deflection"][:, 0], run["drag.force"][:, 0]]))
        self.fails("plot/unknown", tactus.plot, run, ["drag.torque"])
        self.fails("plot/over", tactus.plot, run, ["drag.state"], "drag.force")


if __name__ == "__main__":
    unittest.main()
