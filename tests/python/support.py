# SPDX-License-Identifier: MIT
"""What the tests of the Python package share."""

import ast
import contextlib
import csv
import functools
import io
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest
import warnings

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed")
    sys.exit(77)

import tactus
from tactus import _library

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "tests/install"), str(ROOT / "tests/support")]
import png_to_pgm   # noqa: E402

GRAPHS = ROOT / "graphs"
PROGRAM = os.environ.get("TACTUS_PROGRAM", "")
signal.signal(signal.SIGINT, signal.default_int_handler)   # a shell starts what runs in the background without it


def why_not_live():
    """The reason why nothing can be played or checked here, such as a build without libtactus_live; empty if it can."""
    try:
        _library.live()
        return ""
    except tactus.Error as why:
        return str(why)


def needs_live(needs_program=True):
    """Skips a whole script where nothing can be played or, if it needs that, there is no program."""
    if why := why_not_live() or (needs_program and not PROGRAM and "the program is not built"):
        print(f"skipped: {why}")
        sys.exit(77)


def quiet(function, *args, **kwargs):
    """Calls a function whose warnings do not matter here."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", tactus.TactusWarning)
        return function(*args, **kwargs)


def by_program(graph, *options):
    """The columns that `tactus render` writes."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out.csv"
        done = subprocess.run([PROGRAM, "render", str(graph), "--out", str(out), *options], capture_output=True, text=True)
        if done.returncode != 0:
            raise AssertionError(done.stderr)
        with open(out, encoding="utf-8") as file:
            rows = list(csv.reader(file))
    return rows[0], np.array([[float(v) for v in row] for row in rows[1:]])


def columns(records):
    """The columns of records, as `tactus render` writes them."""
    names, arrays = [], []
    for port, values in records.items():
        names += [port] if values.ndim == 1 else [f"{port}.{axis}" for axis in "xyz"]
        arrays.append(values.reshape(len(values), -1))
    return names, np.hstack(arrays)


def run_notebook(path):
    """Runs the cells in order, as Jupyter does. The names that they define, and of each cell its id, what it prints and shows, and what the file says of it."""
    names, told = {}, []
    for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] == "code":
            parts, said = ast.parse("".join(cell["source"])).body, io.StringIO()
            with contextlib.redirect_stdout(said):
                last = parts.pop() if isinstance(parts[-1], ast.Expr) else None
                exec(compile(ast.Module(parts, []), f"{path.name}: {cell['id']}", "exec"), names)
                shown = eval(compile(ast.Expression(last.value), path.name, "eval"), names) if last else None
            stored = "".join(text for output in cell["outputs"] for text in output.get("text", output.get("data", {}).get("text/plain", [])))
            told.append((cell["id"], said.getvalue() + ("" if shown is None else repr(shown)), stored))
    return names, told


def pixels(path):
    """The pixels of an 8-bit PNG that is grey, shape (rows, columns)."""
    return np.array(png_to_pgm.pixels(path), np.uint8)


def fnv1a(data):
    """contentHash, written apart from it."""
    value = 0xcbf29ce484222325
    for byte in data:
        value = (value ^ byte) * 0x100000001b3 % 2**64
    return b"%016x" % value


def parts(state):
    """Of a state of a run: the lines with the head, and the bytes behind the checksum."""
    head = b"".join(state.splitlines(keepends=True)[:4])
    return head, state[len(head) + 16:]


def with_checksum(head, payload):
    return head + fnv1a(payload) + payload


class TestCase(unittest.TestCase):
    @functools.cached_property
    def folder(self):
        """A folder for the files of this test."""
        made = tempfile.TemporaryDirectory()
        self.addCleanup(made.cleanup)
        return pathlib.Path(made.name)

    def same_bits(self, a, b):
        a, b = np.ascontiguousarray(a, dtype=float), np.ascontiguousarray(b, dtype=float)
        self.assertEqual(a.shape, b.shape)
        self.assertTrue(a.tobytes() == b.tobytes(), "the bits differ")

    def fails(self, id, function, *args, **kwargs):
        """Checks that a call raises an Error with this id, and returns the Error."""
        with self.assertRaises(tactus.Error) as caught:
            quiet(function, *args, **kwargs)
        self.assertEqual(caught.exception.id, id, str(caught.exception))
        return caught.exception

    def ran(self, *words, status=0, program=PROGRAM, **environment):
        """What a program says that must end with this status. It runs in the folder of this test, and finds the same Python."""
        done = subprocess.run([program, *map(str, words)], cwd=self.folder, capture_output=True, text=True, check=False,
                              env={**os.environ, "PATH": f"{pathlib.Path(sys.executable).parent}:{os.environ['PATH']}", **environment})
        self.assertEqual(done.returncode, status, done.stderr)
        return done.stdout or done.stderr


def drag(**params):
    """A contact that is dragged by a feed of positions."""
    graph = tactus.Graph(name="drag", rate=1000)
    graph.add_node("drag", "friction.elasto_plastic", params or {"mu": 0.4, "d_max": "0.4 mm"})
    return graph


def positions(n, seed=1):
    """A random walk over a few mm, shape (n, 3)."""
    return np.cumsum(np.random.default_rng(seed).normal(0, 1e-4, (n, 3)), axis=0)
