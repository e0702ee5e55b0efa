# SPDX-License-Identifier: MIT
"""Graphs: reading, editing, undo, pickling, the catalogue."""

import json
import pathlib
import pickle
import tempfile
import unittest

import numpy as np
import tactus
from support import GRAPHS, TestCase, drag, positions


class Graphs(TestCase):
    def test_text_is_the_text_of_the_file(self):
        path = GRAPHS / "dry_wood.json"
        graph = tactus.Graph(path)
        self.assertEqual(graph.text, path.read_text(encoding="utf-8"))
        self.assertEqual(tactus.Graph.parse(graph.text).text, graph.text)
        self.assertEqual((graph.name, graph.rate), ("Dry wood", 4000))

    def test_every_edit_can_be_undone_and_redone(self):
        graph = drag()
        edits = [lambda: graph.add_node("grain", "texture.grating", {"amplitude": "60 mN"}),
                 lambda: graph.connect("grain.force", "drag.position", gain="1e-4 m/N", delay=2),
                 lambda: graph.set_param("drag", "mu", np.float64(0.3)),
                 lambda: graph.set_param("drag", "mu", None),
                 lambda: graph.set_key("grain", "bypass", True),
                 lambda: graph.add_node("hum", "signal.noise", settings={"seed": 3}),
                 lambda: graph.set_setting("hum", "seed", 7),
                 lambda: graph.set_device("stylus", {"driver": "sim", "mass": "50 g"}),
                 lambda: graph.rename_node("grain", "wood"),
                 lambda: graph.disconnect("wood.force", "drag.position", delay=2),
                 lambda: graph.connect("wood.force -> drag.position"),
                 lambda: graph.remove_node("wood")]
        texts = [graph.text]
        for edit in edits:
            edit()
            self.assertNotEqual(graph.text, texts[-1])
            texts.append(graph.text)
        for text in reversed(texts[:-1]):
            self.assertTrue(graph.undo())
            self.assertEqual(graph.text, text)
        self.assertTrue(all(graph.redo() for _ in edits))
        self.assertEqual(graph.text, texts[-1])
        self.assertFalse(graph.redo())

    def test_a_refused_edit_changes_nothing(self):
        graph = drag()
        text = graph.text
        self.fails("edit/name_taken", graph.add_node, "drag", "texture.grating")
        self.fails("edit/unknown_node", graph.set_param, "grain", "mu", 1)
        self.fails("edit/unknown_patch", graph.remove_node, "drag", patch="inside")
        self.fails("edit/unknown_wire", graph.disconnect, "drag.force -> drag.position")
        self.fails("wire/syntax", graph.connect, "drag.force > drag.position")
        self.fails("api/value", graph.set_param, "drag", "mu", object())
        self.fails("api/value", graph.set_param, "drag", "mu", float("inf"))
        self.assertEqual(graph.text, text)

    def test_errors_in_a_file_say_where(self):
        self.fails("file/unreadable", tactus.Graph, "there/is/no/such.json")
        why = self.fails("file/wrong_kind", tactus.Graph.parse, '{"format": "tactus-graph", "version": 2,\n "nodes": 3}')
        self.assertEqual((why.messages[0].line, why.where), (2, "/nodes"))
        self.fails("api/rate", tactus.Graph, rate=0)

    def test_save_and_load(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "drag.json"
            drag().save(path)
            self.assertEqual(tactus.Graph(path).text, drag().text)
            self.fails("output/unwritable", drag().save, pathlib.Path(folder) / "no" / "drag.json")

    def test_a_pickled_graph_takes_its_subgraph_files_along(self):
        with tempfile.TemporaryDirectory() as folder:
            drag().save(pathlib.Path(folder) / "part.json")
            part = json.loads((pathlib.Path(folder) / "part.json").read_text())
            part["expose"] = {"inputs": {"position": "drag.position", "load": "drag.normal_force"}, "outputs": {"force": "drag.force"}}
            (pathlib.Path(folder) / "part.json").write_text(json.dumps(part))
            whole = pathlib.Path(folder) / "whole.json"
            whole.write_text(json.dumps({"format": "tactus-graph", "version": 2, "name": "whole", "rate_hz": 1000, "wires": [],
                                         "nodes": {"a": {"type": "file:part.json"}}}))
            graph = tactus.Graph(whole)
            feed = {"a.position": positions(100), "a.load": np.ones(100)}
            before = graph.render(feed=feed, record=["a.force"])["a.force"]
            pickled = pickle.dumps(graph)
        after = pickle.loads(pickled).render(feed=feed, record=["a.force"])["a.force"]
        self.assertTrue(np.any(before != 0))
        self.same_bits(before, after)

    def test_the_catalogue_has_the_datasheets(self):
        sheets = tactus.nodes()
        self.assertGreater(len(sheets), 50)
        self.assertEqual(sheets["friction.elasto_plastic"]["id"], "friction.elasto_plastic")
        self.assertTrue(any(row["id"] == "d_max" for row in sheets["friction.elasto_plastic"]["params"]))


if __name__ == "__main__":
    unittest.main()
