# SPDX-License-Identifier: MIT
"""Sweeps on executors: the same bits from each worker."""

import concurrent.futures
import multiprocessing
import unittest

import numpy as np
import tactus
from support import GRAPHS, TestCase

VALUES = {"drag.mu": [0.2, 0.4], "drag.d_max": ["20 um", 5e-5]}
OPTIONS = {"duration": 1.0, "record": ["motor.force", "drag.state"], "set": {"drag.static_ratio": 1.5}}


def largest(records):
    return float(np.abs(records["motor.force"]).max())


class Sweeps(TestCase):
    @classmethod
    def setUpClass(cls):
        cls.graph = tactus.Graph(GRAPHS / "dry_wood.json")
        cls.serial = tactus.sweep(cls.graph, VALUES, **OPTIONS)

    def compare(self, points):
        self.assertEqual([p.set for p in points], [p.set for p in self.serial])
        for mine, other in zip(self.serial, points):
            self.assertEqual(list(mine.result), list(other.result))
            self.assertEqual((mine.result.units, mine.result.rate_hz), (other.result.units, other.result.rate_hz))
            for port in mine.result:
                self.same_bits(mine.result[port], other.result[port])

    def test_the_points_are_all_combinations_in_order(self):
        self.assertEqual([tuple(p.set.values()) for p in self.serial], [(0.2, "20 um"), (0.2, 5e-5), (0.4, "20 um"), (0.4, 5e-5)])
        alone = self.graph.render(duration=1.0, record=["motor.force"], set={"drag.mu": 0.4, "drag.d_max": "20 um", "drag.static_ratio": 1.5})
        self.same_bits(alone["motor.force"], self.serial[2].result["motor.force"])
        self.assertTrue(np.any(self.serial[0].result["motor.force"] != self.serial[2].result["motor.force"]))

    def test_threads_give_the_same_bits(self):
        with concurrent.futures.ThreadPoolExecutor(2) as executor:
            self.compare(tactus.sweep(self.graph, VALUES, executor=executor, **OPTIONS))

    def test_processes_give_the_same_bits(self):
        with concurrent.futures.ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as executor:
            self.compare(tactus.sweep(self.graph, VALUES, executor=executor, **OPTIONS))
            measured = tactus.sweep(self.graph, VALUES, executor=executor, measure=largest, **OPTIONS)
            self.assertEqual([p.result for p in measured], [largest(p.result) for p in self.serial])
            self.fails("param/unknown", tactus.sweep, self.graph, {"drag.nu": [1]}, executor=executor, **OPTIONS)


if __name__ == "__main__":
    unittest.main()
