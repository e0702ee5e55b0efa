#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Nodes from plugins in Python: in the package itself, in sessions, and in the processes of sweeps. What is refused, and that the refusal holds in both
libraries."""

import concurrent.futures
import ctypes
import multiprocessing
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import numpy as np
import tactus
from support import ROOT, TestCase, parts, with_checksum
from tactus import _library

OBJECTS = pathlib.Path(os.environ.get("TACTUS_BUILD") or "/nowhere") / "tests/plugins/objects"
if not (OBJECTS / "live_node.tactus").exists() or not sys.platform.startswith("linux"):
    print("skipped: the plugins of the tests are not built")
    sys.exit(77)
HOME = tempfile.TemporaryDirectory()
os.environ["TACTUS_HOME"] = str(pathlib.Path(HOME.name) / "Tactus")   # no plugin of the user, and marks that no other test sees
os.environ.pop("TACTUS_PLUGINS", None)


def growing(type, slope=1.0):
    """A graph whose force grows by `slope` in 1000 ticks."""
    graph = tactus.Graph(name="growing", rate=1000)
    graph.add_node("hand", "device.position", role="stylus")
    graph.add_node("grow", type, {"slope": slope})
    graph.add_node("motor", "device.force", role="stylus")
    graph.connect("hand.position", "grow.position")
    graph.connect("grow.force", "motor.force")
    return graph


def forces(graph):
    return graph.render(duration=0.01, record=["grow.force"], devices={"stylus": "gesture:circle"})["grow.force"][:, 2]


def expected(slope=1.0):
    return slope * 1e-3 * np.arange(1.0, 11.0)


def counting():
    """An engine with a node in C++ and one in C, from plugins, and one that is compiled in."""
    graph = growing("live.growing")
    graph.add_node("swing", "signal.lfo")
    graph.add_node("count", "c.twice")
    graph.connect("swing.out", "count.in")
    return tactus.Engine(graph, devices={"stylus": "gesture:circle"})


def elsewhere(code, **variables):
    """What a new process prints."""
    done = subprocess.run([sys.executable, "-B", "-c", "import tactus\n" + code], capture_output=True, text=True, env={**os.environ, **variables})
    return done.returncode, done.stdout + done.stderr


class Plugins(TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def install(self, plugin, name=None):
        return pathlib.Path(shutil.copy(OBJECTS / f"{plugin}.tactus", self.folder / f"{name or plugin}.tactus"))

    def test_a_plugin_works_in_renders_sessions_and_sweeps(self):
        self.assertNotIn("live.growing", tactus.nodes())
        self.assertEqual(tactus.load_plugins(OBJECTS / "live_node.tactus"), ["live.growing"])
        self.assertEqual(tactus.load_plugins(OBJECTS / "live_node.tactus"), [])   # loaded already
        self.assertEqual(tactus.nodes()["live.growing"]["plugin"], str(OBJECTS / "live_node.tactus"))
        graph = growing("live.growing")
        self.same_bits(forces(graph), expected())
        with tactus.play(graph, device=["stylus=gesture:circle"], session="off", duration=0.05, record=["grow.force"]) as session:
            session.wait()
            played = session.collect()["grow.force"][:, 2]
        self.assertGreater(len(played), 10)
        self.same_bits(played, 1e-3 * np.arange(1.0, len(played) + 1.0))
        options = {"duration": 0.01, "record": ["grow.force"], "devices": {"stylus": "gesture:circle"}}
        with concurrent.futures.ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as workers:
            points = tactus.sweep(graph, {"grow.slope": [1.0, 2.0]}, executor=workers, **options)
        for point in points:
            self.same_bits(point.result["grow.force"][:, 2], expected(point.set["grow.slope"]))

    def test_a_graph_without_nodes_from_plugins_needs_none_elsewhere(self):
        self.assertEqual(tactus.Graph("dry_wood").__reduce__()[1][3], [])

    def test_what_is_refused(self):
        plugin = self.install("in_c")
        plugin.chmod(0o666)
        self.fails("plugin/foreign", tactus.load_plugins, plugin)
        self.fails("plugin/foreign", tactus.load_plugins, self.folder)
        self.assertNotIn(str(plugin), [sheet.get("plugin") for sheet in tactus.nodes().values()])
        self.fails("plugin/no_folder", tactus.load_plugins, self.folder / "nothing")
        two = self.fails("plugin/two_ids", tactus.load_plugins, OBJECTS / "five_nodes.tactus")
        self.assertEqual(len(two.messages), 5)
        self.assertNotIn("plugin", tactus.nodes()["friction.elasto_plastic"])
        empty = self.folder / "empty"
        empty.mkdir()
        with self.assertWarns(tactus.TactusWarning) as caught:
            tactus.load_plugins(empty)
        self.assertEqual(caught.warning.message.id, "plugin/none")
        self.fails("argument/type", tactus.load_plugins, 3)

    def test_of_a_folder_whatever_is_not_refused_is_loaded(self):
        self.install("in_c", "a")
        self.install("grown", "b")   # has the same node
        code = f"""
try: tactus.load_plugins({str(self.folder)!r})
except tactus.Error as why: print(why.id)
print(tactus.nodes()['c.twice']['plugin'])
print({{s['plugin'] for s in __import__('json').loads(tactus._tactus.nodes_json()) if 'plugin' in s}})
"""
        status, said = elsewhere(code)
        a = str(self.folder / "a.tactus")
        self.assertEqual((status, said), (0, f"plugin/two_ids\n{a}\n{{{a!r}}}\n"))

    def test_the_usual_folders(self):
        self.install("in_c")
        home = self.folder / "home"
        (home / "plugins").mkdir(parents=True)
        home.chmod(0o700)
        shutil.copy(OBJECTS / "live_node.tactus", home / "plugins")
        code = "print(tactus.load_plugins())"
        variables = {"TACTUS_PLUGINS": str(self.folder), "TACTUS_HOME": str(home)}
        self.assertEqual(elsewhere(code, **variables), (0, "['c.twice', 'live.growing']\n"))
        home.chmod(0o777)   # another user could put a plugin there
        status, said = elsewhere(code, **variables)
        self.assertEqual(status, 0)
        self.assertIn("['c.twice']\n", said)
        self.assertIn("home/foreign", said)

    def test_a_plugin_that_crashed_the_program_is_not_loaded_again(self):
        plugin = self.install("crashing")
        code = f"tactus.load_plugins({str(plugin)!r})"
        self.assertEqual(elsewhere(code)[0], 77)
        status, said = elsewhere(code)
        self.assertEqual(status, 1)
        self.assertIn("plugin/quarantined", said)

    def test_a_run_with_nodes_in_c_and_cpp_goes_on_where_it_was_saved(self):
        tactus.load_plugins(OBJECTS / "saves.tactus")
        tactus.load_plugins(OBJECTS / "live_node.tactus")
        run, other = counting(), counting()
        run.step(n=100)
        other.step(n=33)
        state = run.save()
        self.assertEqual(run.save(), state)   # saving changes nothing
        run.step(n=50)
        after = run.save()
        for again in (other, run):
            again.restore(state)
            self.assertEqual(again.save(), state)
            again.step(n=50)
            self.assertEqual(again.save(), after)

        head, payload = parts(state)   # a plugin can refuse the bytes, and its reason is told
        length, reasons = (8).to_bytes(8, "little"), []
        for place in (at for at in range(len(payload)) if payload[at:at + 8] == length):
            forged = payload[:place] + (7).to_bytes(8, "little") + payload[place + 8:]
            reasons.append(self.fails("state/graph", run.restore, with_checksum(head, forged)).text)
            self.assertEqual(run.save(), after)
        self.assertIn("the node 'count' does not take its state: 'another size'", "\n".join(reasons))

        kept, here = self.folder / "state", f"sys.path.insert(0, {str(pathlib.Path(__file__).parent)!r})\nimport plugins_test"
        kept.write_bytes(state)
        for plugin, more, function, expected in (("in_c", b"", "save()", "state/refused the node 'count' has a state that cannot be saved"),
                                                 ("saves", b"", f"restore(open({str(kept)!r}, 'rb').read())", "done"),
                                                 ("saves", b"more", f"restore(open({str(kept)!r}, 'rb').read())", "state/graph the state does not fit")):
            with self.subTest(plugin=plugin, more=more):
                copy = self.install(plugin, "copy" + more.decode())   # not over a file that is loaded
                copy.write_bytes(copy.read_bytes() + more)
                said = elsewhere(f"""
import sys
{here}
tactus.load_plugins({str(copy)!r})
tactus.load_plugins(plugins_test.OBJECTS / "live_node.tactus")
try:
    plugins_test.counting().{function}
    print("done")
except tactus.Error as why: print(why.id, why.text)
""")[1]
                self.assertIn(expected, said)
                self.assertEqual("another build" in said, bool(more), said)

    def test_the_c_functions_refuse_null(self):
        library = _library.live()
        self.assertEqual(library.tactus_plugins_load(b"", None), 2)
        self.assertEqual(library.tactus_plugins_replace(None, None), 2)
        self.assertEqual(library.tactus_plugins_compile(None, b"x", None), 2)
        self.assertEqual(library.tactus_plugins_compile(b"x", None, None), 2)
        library.tactus_last_misuse.restype = ctypes.c_char_p
        self.assertIn(b"NULL", library.tactus_last_misuse())

    @unittest.skipUnless(shutil.which(os.environ.get("CXX") or "c++"), "there is no compiler")
    def test_a_node_is_compiled_and_compiled_again(self):
        header = self.folder / "growing.hpp"
        text = (ROOT / "tests/plugins/objects/live_node.hpp").read_text(encoding="utf-8").replace('"live.growing"', '"mine.growing"')
        header.write_text(text, encoding="utf-8")
        real = os.environ.get("CXX") or "c++"
        compiler = self.folder / pathlib.Path(real).name   # says at which priority it runs
        compiler.write_text(f'#!/bin/sh\nnice >> "{self.folder}/priorities"\nexec {shutil.which(real)} "$@"\n', encoding="utf-8")
        compiler.chmod(0o700)
        with unittest.mock.patch.dict(os.environ, CXX=str(compiler)):
            self.assertEqual(tactus.compile_node(header), "mine.growing")
        self.assertEqual((self.folder / "priorities").read_text(encoding="utf-8"), f"{os.nice(0)}\n")
        graph = growing("mine.growing")
        old = tactus.Engine(graph, record=["grow.force"], devices={"stylus": "gesture:circle"})
        self.same_bits(forces(graph), expected())
        state = old.save()
        old.step(n=7)
        old.restore(state)
        header.write_text(text.replace("params.slope * 1e-3", "2.0 * params.slope * 1e-3"), encoding="utf-8")
        self.assertEqual(tactus.compile_node(header), "mine.growing")
        self.same_bits(forces(graph), expected(2.0))
        self.same_bits(old.step(n=10)["grow.force"][:, 2], expected())   # an engine keeps its nodes
        new = tactus.Engine(graph, record=["grow.force"], devices={"stylus": "gesture:circle"})
        self.assertIn("another build", self.fails("state/graph", new.restore, state).text)
        header.write_text(text.replace("ticks += 1.0;", "ticks += one;"), encoding="utf-8")
        why = self.fails("live/compile", tactus.compile_node, header)
        self.assertIn("one", why.text)
        self.assertIn("what is loaded stays as it is", why.remedy)
        header.write_text("int x;\n", encoding="utf-8")
        self.fails("live/no_node", tactus.compile_node, header)
        self.fails("live/no_header", tactus.compile_node, self.folder / "nothing.hpp")
        self.same_bits(forces(graph), expected(2.0))


if __name__ == "__main__":
    unittest.main()
