#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The example with MuJoCo: the peg slides over the wood, drops into the hole, stands on its floor and is held by its wall. Needs libmujoco-dev."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from support import GRAPHS, PROGRAM, ROOT, TestCase

EXAMPLE = ROOT / "docs/examples/mujoco"
COMPILER = shutil.which(os.environ.get("CXX") or "c++")
BUILD = pathlib.Path(PROGRAM).resolve().parents[1] if PROGRAM else None
LINE = re.compile(r"([\d.]+) s  x +(\S+) mm  z +(\S+) mm  wood +(\S+) +(\S+) +(\S+) N  walls +(\S+) N")


def missing():
    """What the test needs and is not here."""
    if COMPILER is None:
        return "there is no compiler"
    if BUILD is None or not (BUILD / "libtactus.so").exists():
        return "libtactus is not built"
    found = subprocess.run([COMPILER, "-x", "c++", "-fsyntax-only", "-"], input="#include <mujoco/mujoco.h>\n", capture_output=True, text=True)
    return "" if found.returncode == 0 else "libmujoco-dev is not installed"


class PegInHole(TestCase):
    def test_the_peg_is_felt_through_the_wood_and_ends_in_the_hole(self):
        with tempfile.TemporaryDirectory() as folder:
            program = os.path.join(folder, "peg_in_hole")
            subprocess.run([COMPILER, "-std=c++17", "-O1", "-Wall", "-Wextra", "-Werror", f"-I{BUILD}/include", str(EXAMPLE / "main.cpp"), f"-L{BUILD}",
                            f"-Wl,-rpath,{BUILD}", "-ltactus", "-lmujoco", "-o", program], check=True)
            runs = [subprocess.run([program, str(EXAMPLE / "peg.xml"), str(GRAPHS / "dry_wood.json")], capture_output=True, text=True) for _ in range(2)]
        self.assertEqual((runs[0].returncode, runs[0].stderr), (0, ""), runs[0].stdout)
        self.assertEqual(runs[0].stdout, runs[1].stdout)
        rows = [[float(v) for v in line.groups()] for line in map(LINE.match, runs[0].stdout.splitlines()) if line]
        self.assertEqual(len(rows), 12)
        pressing = rows[1]                                   # after 0.5 s: at rest on the wood, 0.8 N over its stiffness of 2 N/mm deep
        self.assertAlmostEqual(pressing[2], -0.4, delta=0.01)
        self.assertAlmostEqual(pressing[5], 0.8, delta=0.01)
        dragged = rows[3]                                    # after 1 s: pulled along x, held back by the friction of the wood
        self.assertLess(dragged[3], -0.1)
        self.assertAlmostEqual(dragged[5], 0.8, delta=0.1)
        self.assertEqual(dragged[6], 0.0)
        self.assertLess(rows[3][1] - rows[1][1], 20 * 0.5)   # mm; and behind the hand
        ended = rows[-1]                                     # on the floor of the hole, 8 mm deeper; the hand pulls by 15 mm of its 200 N/m
        self.assertAlmostEqual(ended[2], -8.4, delta=0.01)
        self.assertAlmostEqual(ended[5], 0.8, delta=0.02)
        self.assertGreater(ended[6], 1.0)
        self.assertAlmostEqual(ended[6] - ended[3], 200 * (0.015 - ended[1] * 1e-3), delta=0.05)
        self.assertLess(abs(ended[1]), 1.2)
        self.assertRegex(runs[0].stdout, r"in the hole, 8\.4\d mm deep")


if __name__ == "__main__":
    if why := missing():
        print(f"skipped: {why}")
        sys.exit(77)
    unittest.main()
