#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets in one file (.tactus), written by Python's zipfile module: good ones, and ones that a stranger made to do harm: pack_test.py TACTUS GRAPHS"""

import io
import json
import os
import pathlib
import random
import struct
import subprocess
import sys
import tempfile
import unittest
import zipfile

TACTUS, GRAPHS = sys.argv[1], pathlib.Path(sys.argv[2])
ZIP = GRAPHS / "heartbeat.json"


def assets_of(graph):
    """The files below the folder of the presets that a graph names."""
    found = []

    def look(value):
        if isinstance(value, str) and value.startswith("assets/"):
            found.append(value)
        elif isinstance(value, dict):
            for inner in value.values():
                look(inner)
        elif isinstance(value, list):
            for inner in value:
                look(inner)
    look(graph["nodes"])
    look(graph.get("graphs", {}))
    return found


class Packs(unittest.TestCase):
    def setUp(self):
        self.home = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.home.name)
        self.temporary = self.folder / "tmp"
        self.temporary.mkdir()
        self.pack = self.folder / "preset.tactus"

    def tearDown(self):
        self.assertEqual(list(self.temporary.iterdir()), [])   # what was unpacked is gone
        self.home.cleanup()

    def run_tactus(self, *arguments):
        return subprocess.run([TACTUS, *map(str, arguments)], capture_output=True, text=True, errors="replace", timeout=120,
                              env={**os.environ, "TMPDIR": str(self.temporary)})

    def write(self, files, method=zipfile.ZIP_DEFLATED):
        with zipfile.ZipFile(self.pack, "w", method) as archive:
            for name, data in files:
                archive.writestr(name, data)

    def good(self):
        text = ZIP.read_text()
        return [("graph.json", text)] + [(a, (GRAPHS / a).read_bytes()) for a in assets_of(json.loads(text))]

    def refused(self, message):
        done = self.run_tactus("validate", self.pack)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn(f"[{message}]", done.stderr)

    def test_a_pack_plays_as_the_graph_with_its_files(self):
        files = self.good()
        self.assertGreater(len(files), 1)
        for method in (zipfile.ZIP_DEFLATED, zipfile.ZIP_STORED):
            self.write(files, method)
            self.assertEqual(self.run_tactus("validate", self.pack).returncode, 0)
            ours, theirs = (self.run_tactus("render", g, "--duration", "0.5") for g in (self.pack, ZIP))
            self.assertEqual((ours.returncode, theirs.returncode), (0, 0), ours.stderr)
            self.assertGreater(len(ours.stdout), 1000)
            self.assertEqual(ours.stdout, theirs.stdout)

    def test_no_file_leaves_the_folder(self):
        for name in ("../evil.csv", "/tmp/evil.csv", "a/../../evil.csv", "..\\evil.csv", "C:/evil.csv", ".bashrc", "a/.hidden/x.csv", "a//b.csv", "x\x01.csv",
                     "trailing./x.csv", "nul", "a/COM1.csv", "a/" * 20 + "x.csv", "n" * 300):
            self.write(self.good() + [(name, "1,2\n")])
            self.refused("pack/name")
        self.assertFalse((self.folder / "evil.csv").exists())

    def test_no_link(self):
        link = zipfile.ZipInfo("assets/link.csv")
        link.create_system = 3
        link.external_attr = 0o120777 << 16
        self.write(self.good())
        with zipfile.ZipFile(self.pack, "a") as archive:
            archive.writestr(link, "/etc/passwd")
        self.refused("pack/name")

    def test_no_path_out_of_it(self):
        for path in ("/etc/passwd", "../secret.csv", "assets/../../secret.csv", "C:\\secret.csv", "..\\secret.csv"):
            graph = json.loads(ZIP.read_text())
            for node in graph["nodes"].values():
                if node["type"] == "signal.clip":
                    node["settings"]["clip"] = path
            self.write([("graph.json", json.dumps(graph))])
            self.refused("pack/outside")
        graph = {"format": "tactus-graph", "version": 2, "nodes": {"inner": {"type": "file:../other.json"}}}
        self.write([("graph.json", json.dumps(graph))])
        self.refused("pack/outside")
        graph = {"format": "tactus-graph", "version": 2, "devices": {"tip": {"driver": "trace", "path": "/etc/passwd"}}, "nodes": {}}
        self.write([("graph.json", json.dumps(graph))])
        self.refused("pack/outside")

    def test_budgets(self):
        self.write(self.good() + [(f"a{i}.csv", "1") for i in range(1001)])
        self.refused("pack/too_many")
        self.write(self.good() + [(f"zeros{i}.csv", bytes(60_000_000)) for i in range(5)])   # 300 MB in 300 KB
        self.assertLess(self.pack.stat().st_size, 2_000_000)
        self.refused("pack/too_large")
        # An archive that says less than it holds.
        self.write(self.good() + [("liar.csv", bytes(5_000_000))])
        data = bytearray(self.pack.read_bytes())
        at = data.rfind(b"PK\x01\x02")
        self.assertEqual(struct.unpack_from("<I", data, at + 24)[0], 5_000_000)
        for said in (10, 5_000_001, 0xffffffff):
            struct.pack_into("<I", data, at + 24, said)
            self.pack.write_bytes(data)
            done = self.run_tactus("validate", self.pack)
            self.assertIn(done.returncode, (0, 1))
            if said > 5_000_000:
                self.assertEqual(done.returncode, 1)

    def test_what_is_no_pack(self):
        for data in (b"", b"PK", b"PK\x03\x04", b"\x7fELF" + bytes(100), ZIP.read_bytes(), b"PK\x05\x06" + bytes(18)):
            self.pack.write_bytes(data)
            self.refused("pack/not_a_pack")
        self.write([("other.json", "{}")])
        self.refused("pack/no_graph")
        self.write(self.good() + [("GRAPH.JSON", "{}")])
        self.refused("pack/twice")
        self.write([("graph.json", "{")])
        self.refused("file/syntax")
        self.pack.unlink()
        self.refused("file/unreadable")

    def test_damaged_packs_do_no_harm(self):
        self.write(self.good())
        whole = self.pack.read_bytes()
        chance = random.Random(1)
        for k in range(150):
            data = bytearray(whole)
            if k % 3 == 0:
                del data[chance.randrange(len(data)):]
            for _ in range(chance.randrange(1, 8)):
                if data:
                    # The list of files at the end is where most can go wrong.
                    at = chance.randrange(len(data)) if k % 2 else len(data) - 1 - chance.randrange(min(len(data), 300))
                    data[at] = chance.randrange(256)
            self.pack.write_bytes(data)
            done = self.run_tactus("validate", self.pack)
            self.assertIn(done.returncode, (0, 1), f"round {k}: {done.returncode} {done.stderr}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
