# SPDX-License-Identifier: MIT
"""Renders from Python against those of the program."""

import _thread
import concurrent.futures
import pathlib
import pickle
import tempfile
import unittest
import warnings

import numpy as np
import tactus
from support import GRAPHS, PROGRAM, TestCase, by_program, columns, drag, pixels, positions, quiet
from waiting import while_busy


@unittest.skipUnless(PROGRAM, "the program is not built")
class AgainstTheProgram(TestCase):
    def test_every_preset_has_the_bits_of_the_program(self):
        silent = set()
        pictures = {"assets/leather.png": pixels(GRAPHS / "assets/leather.png")}   # only the host decodes pictures
        for path in sorted(GRAPHS.glob("*.json")):
            with self.subTest(path.stem):
                mine = quiet(tactus.Graph(path).render, duration=2.0, assets=pictures)
                names, rows = by_program(path, "--duration", "2")
                my_names, my_rows = columns(mine)
                self.assertEqual(names, my_names)
                self.same_bits(rows, my_rows)
                if not np.any(my_rows[:, 1:]):
                    silent.add(path.stem)
        self.assertEqual(silent, set(), "in each preset, the tool should touch something within 2 s")

    def compare_feed(self, feed, *options, **arguments):
        with tempfile.TemporaryDirectory() as folder:
            graph, table = pathlib.Path(folder) / "drag.json", pathlib.Path(folder) / "feed.csv"
            drag().save(graph)
            names, rows = columns(feed)
            table.write_text("\n".join([",".join(names), *(",".join(repr(float(v)) for v in row) for row in rows)]), encoding="utf-8")
            theirs = by_program(graph, "--feed", str(table), "--record", "drag.force,drag.state", *options)
            mine = columns(tactus.Graph(graph).render(feed=feed, record=["drag.force", "drag.state"], **arguments))
        self.assertEqual(theirs[0], mine[0])
        self.same_bits(theirs[1], mine[1])
        return mine[1]

    def test_feeds_with_times_rates_and_non_finite_numbers_follow_the_rules_of_the_program(self):
        feed = {"drag.position": positions(300), "drag.normal_force": np.linspace(0, 2, 300)}
        self.compare_feed(feed)
        self.compare_feed(feed, "--rate", "4000", rate=4000)
        timed = {"t": np.arange(300) / 500 + 2, **feed}
        self.assertEqual(len(self.compare_feed(timed)), 300)
        self.assertEqual(len(self.compare_feed(timed, "--rate", "2000", rate=2000)), 1197)
        self.assertEqual(len(self.compare_feed(feed, "--duration", "0.1", duration=0.1)), 100)
        feed["drag.normal_force"][100:110] = [np.nan, np.inf] * 5
        self.assertTrue(np.any(self.compare_feed(feed)[:, -1] == -1))

    def test_set_and_devices_mean_what_the_options_of_the_program_mean(self):
        path = GRAPHS / "dry_wood.json"
        theirs = by_program(path, "--duration", "0.2", "--set", "drag.mu=0.7", "--set", "drag.d_max=20 um", "--device", "stylus=gesture:circle")
        mine = tactus.Graph(path).render(duration=0.2, set={"drag.mu": 0.7, "drag.d_max": "20 um"}, devices={"stylus": "gesture:circle"})
        self.same_bits(theirs[1], columns(mine)[1])
        described = tactus.Graph(path).render(duration=0.2, set={"drag.mu": np.float64(0.7), "drag.d_max": 2e-5},
                                              devices={"stylus": {"driver": "gesture", "path": "circle"}})
        self.same_bits(columns(mine)[1], columns(described)[1])


class Render(TestCase):
    def test_vectors_have_three_columns_and_components_one(self):
        feed = {"drag.position": positions(50), "drag.normal_force": 1.0}
        run = drag().render(feed=feed, record=["drag.force", "drag.deflection.x", "drag.state"])
        self.assertEqual({port: v.shape for port, v in run.items()},
                         {"t": (50,), "drag.force": (50, 3), "drag.deflection.x": (50,), "drag.state": (50,)})
        self.assertEqual(run.units, {"t": "s", "drag.force": "N", "drag.deflection.x": "m", "drag.state": "1"})
        self.same_bits(run["t"], np.arange(50) / 1000)
        self.assertEqual(run.rate_hz, 1000)

    def test_three_recorded_components_are_not_taken_for_a_vector(self):
        run = drag().render(feed={"drag.position": positions(5)}, record=["drag.force.x", "drag.force.y", "drag.force.z"])
        self.assertEqual(list(run), ["t", "drag.force.x", "drag.force.y", "drag.force.z"])

    def test_errors_have_an_id_a_place_and_a_remedy(self):
        self.fails("run/no_length", drag().render)
        self.fails("run/too_long", drag().render, duration=1e9)
        for rate in (-1, 0.5, 1e9, float("nan")):
            with self.subTest(rate):
                self.assertRaises(tactus.Error, drag().render, duration=0.01, rate=rate)
        self.fails("port/unknown_node", drag().render, duration=1, record=["nothing.force"])
        self.fails("feed/shape", drag().render, feed={"drag.position": np.zeros((5, 2))})
        self.fails("feed/shape", drag().render, feed={"drag.position": np.zeros((5, 3)), "drag.normal_force": np.zeros(4)})
        self.fails("api/value", drag().render, duration=1, set={"drag.mu": float("nan")})
        self.fails("api/unknown_role", drag().render, duration=1, devices={"stylus": "sim"})
        why = self.fails("param/unknown", drag().render, duration=1, set={"drag.nu": 1})
        self.assertTrue(why.text and why.remedy and why.messages[0].is_error)
        again = pickle.loads(pickle.dumps(why))
        self.assertEqual((again.id, str(again)), (why.id, str(why)))

    def test_warnings_are_python_warnings_at_the_line_of_the_caller(self):
        graph = tactus.Graph(rate=1000)
        graph.add_node("hand", "device.position", role="pen")
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            graph.render(duration=0.01, record=["hand.position"])
        self.assertEqual([w.message.message.id for w in caught], ["device/undescribed"])
        self.assertEqual(caught[0].filename, __file__)

    def test_threads_render_at_the_same_time_with_the_same_bits(self):
        graph = tactus.Graph(GRAPHS / "dry_wood.json")
        once = graph.render(duration=0.5)["motor.force"]
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            for run in pool.map(lambda _: graph.render(duration=0.5), range(8)):
                self.same_bits(once, run["motor.force"])

    def test_ctrl_c_ends_a_render_because_other_threads_run_meanwhile(self):
        # The other thread can interrupt the render only if the render lets it run, and the render ends early only if it looks for signals.
        with self.assertRaises(KeyboardInterrupt):
            while_busy(_thread.interrupt_main)
            drag().render(duration=1e5, record=["drag.state"])

    def test_a_feed_without_rows_is_refused(self):
        self.fails("feed/empty", drag().render, feed={"drag.position": np.zeros((0, 3))})


if __name__ == "__main__":
    unittest.main()
