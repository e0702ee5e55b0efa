# SPDX-License-Identifier: MIT
"""A sweep on the workers of dask.distributed."""

import os
import sys
import unittest

import tactus
from support import GRAPHS, TestCase

try:
    from distributed import Client
except ImportError:
    print("skipped: python3-distributed is not installed")
    sys.exit(77)


def with_worker(records):
    return os.getpid(), records


class Dask(TestCase):
    def test_each_worker_gives_the_same_bits(self):
        graph = tactus.Graph(GRAPHS / "dry_wood.json")
        values, options = {"drag.mu": [0.2, 0.3, 0.4, 0.5]}, {"duration": 1.0, "record": ["motor.force"]}
        serial = tactus.sweep(graph, values, **options)
        with Client(n_workers=2, threads_per_worker=1, dashboard_address=None) as client:
            workers = list(client.scheduler_info()["workers"])
            for worker in workers:
                on_worker = tactus.sweep(graph, values, executor=client.get_executor(workers=[worker]), measure=with_worker, **options)
                self.assertNotIn(os.getpid(), [pid for pid, _ in (point.result for point in on_worker)])
                for here, there in zip(serial, on_worker):
                    self.assertEqual(here.set, there.set)
                    self.same_bits(here.result["motor.force"], there.result[1]["motor.force"])
        self.assertEqual(len(workers), 2)


if __name__ == "__main__":
    unittest.main()
