# SPDX-License-Identifier: MIT
"""The tables that tactus.lab writes, read back by readers of others where they are installed."""

import csv
import importlib.util
import json
import math
import struct
import unittest

import numpy as np
from support import TestCase, drag, positions
from tactus import lab

NUMBERS = np.concatenate([np.random.default_rng(1).normal(0, 1e3, 40), [0.1, 1e-300, -0.0, 1e308, 5e-324, math.pi]])
TEXTS = ["", "wood", "ä µ", "a,b", 'say "hi"'] + [f"t{i}" for i in range(41)]


def has(module):
    return importlib.util.find_spec(module) is not None


class Writers(TestCase):
    def setUp(self):
        self.table = lab.Table({"t": np.arange(46) / 1000.0, "motor.force.x": NUMBERS, "name": TEXTS}, {"t": "s", "motor.force.x": "N"},
                               {"graph": "abc"}, 1000.0)

    def test_text_keeps_every_bit_and_has_a_sidecar(self):
        for end, separator in (("csv", ","), ("tsv", "\t")):
            self.table.write(self.folder / f"x.{end}")
            with open(self.folder / f"x.{end}", encoding="utf-8", newline="") as file:
                rows = list(csv.reader(file, delimiter=separator))
            self.assertEqual(rows[0], list(self.table))
            self.same_bits([float(row[1]) for row in rows[1:]], NUMBERS)
            self.assertEqual([row[2] for row in rows[1:]], TEXTS)
            self.assertEqual(json.loads((self.folder / "x.json").read_text()),
                             {"SamplingFrequency": 1000.0, "graph": "abc", "t": {"Units": "s"}, "motor.force.x": {"Units": "N"}})
        lab.Table({"a": [math.nan, None, 1.5]}).write(self.folder / "n.tsv")
        self.assertEqual((self.folder / "n.tsv").read_text(), "a\nn/a\nn/a\n1.5\n")

    @unittest.skipUnless(has("h5py"), "h5py is not installed")
    def test_hdf5_is_read_by_h5py(self):
        import h5py
        self.table.write(self.folder / "x.h5")
        with h5py.File(self.folder / "x.h5") as file:
            self.same_bits(file["motor.force.x"][()], NUMBERS)
            self.assertEqual([v.decode() for v in file["name"][()]], TEXTS)
            self.assertEqual(file["t"].attrs["units"], "s")

    @unittest.skipUnless(has("scipy"), "scipy is not installed")
    def test_mat_is_read_by_scipy(self):
        import scipy.io
        self.table.write(self.folder / "x.mat")
        read = scipy.io.loadmat(self.folder / "x.mat", chars_as_strings=True)
        self.same_bits(read["motor_force_x"][:, 0], NUMBERS)
        self.assertEqual([str(cell[0]) if cell.size else "" for cell in read["name"][:, 0]], TEXTS)
        self.assertEqual(json.loads(str(read["about"][0]))["columns"]["motor_force_x"], "motor.force.x")
        lab.Table({"a.b": [1.0], "a_b": [2.0], "3": [3.0], "x" * 80: [4.0]}).write(self.folder / "y.mat")
        self.assertEqual({k: float(v[0, 0]) for k, v in scipy.io.loadmat(self.folder / "y.mat").items() if not k.startswith("__") and k != "about"},
                         {"a_b": 1.0, "a_b_2": 2.0, "x3": 3.0, "x" * 59: 4.0})

    @unittest.skipUnless(has("pyxdf"), "pyxdf is not installed")
    def test_xdf_is_read_by_pyxdf(self):
        import pyxdf
        self.table.write(self.folder / "x.xdf")
        streams, _ = pyxdf.load_xdf(str(self.folder / "x.xdf"), synchronize_clocks=False, dejitter_timestamps=False)
        by_type = {stream["info"]["type"][0]: stream for stream in streams}
        self.same_bits(by_type["Haptics"]["time_series"][:, 1], NUMBERS)
        self.same_bits(by_type["Haptics"]["time_stamps"], self.table["t"])
        self.assertEqual([row[0] for row in by_type["Markers"]["time_series"]], TEXTS)

    def test_xdf_has_the_chunks_of_its_specification(self):
        self.table.write(self.folder / "x.xdf")
        data = (self.folder / "x.xdf").read_bytes()
        self.assertEqual(data[:4], b"XDF:")
        at, tags = 4, []
        while at < len(data):
            self.assertEqual(data[at], 8)
            length, tag = struct.unpack_from("<QH", data, at + 1)
            tags.append((tag, struct.unpack_from("<I", data, at + 11)[0] if tag > 1 else 0))
            if tags[-1] == (3, 1):
                count = struct.unpack_from("<Q", data, at + 16)[0]
                rows = np.frombuffer(data, dtype=[("flag", "u1"), ("time", "<f8"), ("v", "<f8", 2)], count=count, offset=at + 24)
                self.same_bits(rows["v"][:, 1], NUMBERS)
            at += 9 + length
        self.assertEqual((at, tags), (len(data), [(1, 0), (2, 1), (3, 1), (6, 1), (2, 2), (3, 2), (6, 2)]))
        lab.Table({"t": [0.0, 1.0], "name": ["a", "b"], "value": ["c", "d"], "level": [1, 2]}).write(self.folder / "y.xdf")
        self.assertEqual((self.folder / "y.xdf").read_bytes().count(b"<channel_count>1<"), 2)   # libxdf reads one text of a sample

    def test_records_of_a_run_become_a_table(self):
        run = drag().render(feed={"drag.position": positions(50), "drag.normal_force": 1.0}, record=["drag.force", "drag.state"])
        table = lab.table_of(run, {"device": "none"})
        self.assertEqual(list(table), ["t", "drag.force.x", "drag.force.y", "drag.force.z", "drag.state"])
        self.same_bits(table["drag.force.y"], run["drag.force"][:, 1])
        self.assertEqual((table.units["drag.force.y"], table.rate_hz), ("N", 1000.0))
        self.assertIn("drag.state", table._repr_html_())

    def test_wrong_tables_are_errors_and_leave_the_old_file(self):
        self.table.write(self.folder / "x.csv")
        before = (self.folder / "x.csv").read_bytes()
        self.fails("lab/format", self.table.write, self.folder / "x.docx")
        self.fails("lab/shape", lab.Table, {"a": [1.0], "b": [1.0, 2.0]})
        self.fails("lab/no_times", lab.Table({"a": [1.0]}).write, self.folder / "x.xdf")
        self.assertEqual((self.folder / "x.csv").read_bytes(), before)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["x.csv", "x.json"])


if __name__ == "__main__":
    unittest.main()
