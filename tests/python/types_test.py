# SPDX-License-Identifier: MIT
"""The types of the package, as mypy --strict sees them."""

import ast
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import tactus
from support import ROOT

PACKAGE = ROOT / "framework" / "python" / "tactus"
EXAMPLES = ROOT / "docs" / "examples" / "python"

WRONG = """
import numpy as np
import tactus

graph = tactus.Graph("dry_wood")
graph.render(duration="1 s")                                # wrong
graph.render(duration=1.0, record=["drag.force"])
graph.nodes["drag"] = graph.nodes["hand"]                   # wrong
graph.wires[0].end = "drag.mu"                              # wrong
tactus.Engine("dry_wood")                                   # wrong
tactus.Engine(graph).push("stylus", np.zeros(3))
tactus.play(graph, callback=lambda records: records["t"])
tactus.play(graph, callback=3)                              # wrong
tactus.sweep(graph, {"drag.mu": 0.3})                       # wrong
tactus.Records({}, units={}).to_frame()                     # wrong
print(graph.render(duration=1.0)["t"].shape, graph.nodes["drag"].params["mu"], graph.wires[0].delay + 1)
"""


class Types(unittest.TestCase):
    def mypy(self, *paths):
        """What mypy says: the lines with errors by file name, and everything."""
        cache = pathlib.Path(tactus.__file__).parents[1] / ".mypy_cache"   # of the build folder: without it, mypy reads all of numpy
        variables = {**os.environ, "MYPYPATH": str(PACKAGE.parent)}
        variables.pop("LD_PRELOAD", None)   # of a sanitizer, which mypy does not need
        done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", cache, "--config-file", os.devnull, *paths],
                              capture_output=True, text=True, env=variables, cwd=PACKAGE.parent, check=False)
        return [(pathlib.Path(file).name, int(line)) for file, line in re.findall(r"^(\S+?):(\d+): error:", done.stdout, re.M)], done.stdout + done.stderr

    def test_the_package_and_the_examples_have_no_errors(self):
        errors, said = self.mypy(PACKAGE, *sorted(EXAMPLES.glob("*.py")), *sorted(EXAMPLES.with_name("lab").glob("*.py")))
        self.assertEqual(errors, [], said)
        self.assertIn("Success", said)

    def test_wrong_uses_are_found_where_they_are(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "wrong.py"
            path.write_text(WRONG)
            errors, said = self.mypy(path)
        self.assertEqual({line for _, line in errors}, {i for i, line in enumerate(WRONG.splitlines(), 1) if "# wrong" in line}, said)

    def test_the_stubs_have_what_the_module_has(self):
        tree = ast.parse((PACKAGE / "_tactus.pyi").read_text(encoding="utf-8"))
        stubs = {"": {node.name for node in tree.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}}
        stubs.update({node.name: {f.name for f in node.body if isinstance(f, ast.FunctionDef)} for node in tree.body if isinstance(node, ast.ClassDef)})
        for name, known in stubs.items():
            there = {n for n in vars(getattr(tactus._tactus, name) if name else tactus._tactus) if not n.startswith("_")}
            self.assertEqual(known - {"__init__"}, there, name)


try:
    import mypy   # noqa: F401
except ImportError:
    print("skipped: mypy is not installed")
    sys.exit(77)

if __name__ == "__main__":
    unittest.main()
