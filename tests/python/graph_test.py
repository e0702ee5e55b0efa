# SPDX-License-Identifier: MIT
"""Graphs: reading, editing, undo, pickling, the catalogue."""

import contextlib
import json
import pathlib
import pickle
import tempfile
import unittest

import numpy as np
import tactus
from support import GRAPHS, TestCase, drag, positions


def wood():
    """A graph that compiles, with one of everything that can be edited."""
    graph = tactus.Graph()
    graph.add_node("hand", "device.position", role="stylus")
    graph.add_node("motor", "device.force", role="stylus")
    graph.add_node("drag", "friction.elasto_plastic")
    graph.add_node("board", "deform.plane")
    graph.add_node("gain", "signal.gain")
    graph.add_node("sum", "signal.add", settings={"inputs": 2})
    for wire in ("hand.position -> drag.position", "hand.position -> board.position", "board.resistance -> drag.normal_force",
                 "drag.force -> motor.force", "gain.out -> sum.in[0]"):
        graph.connect(wire)
    return graph


class Graphs(TestCase):
    def test_text_is_the_text_of_the_file(self):
        path = GRAPHS / "dry_wood.json"
        graph = tactus.Graph(path)
        self.assertEqual(graph.text, path.read_text(encoding="utf-8"))
        self.assertEqual(tactus.Graph.parse(graph.text).text, graph.text)
        self.assertEqual((graph.name, graph.rate), ("Dry wood", 4000))

    def test_a_batch_is_one_step_and_fails_as_a_whole(self):
        graph = wood()
        before = graph.text
        with graph.edit("swap") as same:
            self.assertIs(same, graph)
            graph.connect("hand.position", "board.position", delay=1)   # the second wire into a position, for now
            graph.disconnect("hand.position", "board.position")
            self.assertFalse(graph.undo())
        swapped = graph.text
        self.assertNotEqual(swapped, before)
        self.assertTrue(graph.undo())
        self.assertEqual(graph.text, before)
        self.assertTrue(graph.redo())
        self.assertEqual(graph.text, swapped)

        with self.assertRaises(tactus.Error) as raised, graph.edit():
            graph.add_node("more", "signal.gain")
            graph.connect("more.out", "more.in")   # only the end shows that the loop stays
        self.assertEqual(raised.exception.id, "graph/loop")
        self.assertEqual(graph.text, swapped)
        with self.assertRaises(tactus.Error) as raised, graph.edit():
            graph.add_node("more", "signal.gain")
            with contextlib.suppress(tactus.Error):
                graph.set_param("mroe", "gain", 2)
            with self.assertRaises(tactus.Error):
                graph.set_param("more", "gain", 2)
        self.assertEqual(raised.exception.id, "edit/unknown_node")
        self.assertEqual(graph.text, swapped)
        with self.assertRaises(ZeroDivisionError), graph.edit():
            graph.add_node("more", "signal.gain")
            _ = 1 / 0
        self.assertEqual(graph.text, swapped)
        with graph.edit(), self.assertRaises(tactus.Error) as raised:
            with graph.edit():
                pass
        self.assertEqual(raised.exception.id, "edit/in_batch")
        graph.add_node("more", "signal.gain")

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
                 lambda: graph.connect("wood.force -> drag.position", gain="1e-4 m/N"),
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

    def test_each_mistake_in_an_edit_is_refused_with_its_place_and_a_remedy(self):
        graph = wood()
        text = graph.text
        mistakes = [
            ("node/unknown_type", graph.add_node, "a", "friction.elastoplastic"),
            ("graph/unknown_subgraph", graph.add_node, "a", "graph:bark"),
            ("file/bad_value", graph.add_node, "a", ""),
            ("edit/name_taken", graph.add_node, "drag", "signal.gain"),
            ("graph/bad_id", graph.add_node, "Drag", "signal.gain"),
            ("graph/bad_id", graph.rename_node, "drag", "my drag"),
            ("edit/unknown_node", graph.rename_node, "drags", "stick"),
            ("edit/unknown_node", graph.remove_node, "drags"),
            ("edit/unknown_patch", lambda: graph.add_node("a", "signal.gain", patch="bark")),
            ("param/unknown", graph.add_node, "a", "signal.gain", {"gian": 2}),
            ("param/unit", graph.add_node, "a", "deform.plane", {"stiffness": "2 N"}),
            ("node/unknown_setting", graph.add_node, "a", "signal.add", {}, {"input": 2}),
            ("node/unknown_type", graph.set_key, "drag", "type", "friction.elasto"),
            ("edit/bad_value", graph.set_key, "drag", "type", None),
            ("edit/unknown_node", graph.set_param, "drags", "mu", 0.4),
            ("param/unknown", graph.set_param, "drag", "mue", 0.4),
            ("param/unknown", graph.set_param, "drag", "adhesion_curve", 1),
            ("port/wrong_side", graph.set_param, "drag", "normal_force", 1),
            ("param/unit", graph.set_param, "drag", "d_max", "0.4 N"),
            ("unit/syntax", graph.set_param, "drag", "d_max", "0.4 parsec"),
            ("unit/syntax", graph.set_param, "drag", "d_max", "small"),
            ("param/out_of_range", graph.set_param, "drag", "mu", -1),
            ("param/out_of_range", graph.set_param, "drag", "d_max", 0),
            ("api/value", graph.set_param, "drag", "mu", float("nan")),
            ("api/value", graph.set_param, "drag", "mu", -np.inf),
            ("param/value", graph.set_param, "drag", "mu", True),
            ("param/value", graph.set_param, "drag", "mu", [0.1, 0.2]),
            ("param/shape", graph.set_param, "board", "normal", 1),
            ("param/shape", graph.set_param, "board", "normal", np.zeros(2)),
            ("param/unknown_choice", graph.set_param, "drag", "adhesion", "stik"),
            ("param/unknown_choice", graph.set_param, "drag", "adhesion", 1),
            ("node/unknown_setting", graph.set_setting, "drag", "mu", 0.4),
            ("setting/value", graph.set_setting, "sum", "inputs", 0),
            ("setting/value", graph.set_setting, "board", "law", "steep"),
            ("graph/bad_id", graph.set_key, "hand", "role", "Left Hand"),
            ("file/wrong_kind", graph.set_key, "drag", "bypass", 1),
            ("node/needless_count", graph.set_key, "drag", "count", 2),
            ("rate/no_subgraph", graph.set_key, "drag", "every", 2),
            ("edit/unknown_device", graph.set_device, "thumb", None),
            ("edit/unknown_node", graph.connect, "hands.position", "drag.position"),
            ("port/unknown", graph.connect, "hand.positions", "sum.in[0]"),
            ("port/unknown", graph.connect, "board.resistance", "drag.force_normal"),
            ("port/wrong_side", graph.connect, "drag.position", "board.offset"),
            ("wire/unit", graph.connect, "board.depth", "drag.stiffness"),
            ("wire/unit", lambda: graph.connect("drag.stored_energy", "board.offset", gain="2 m/N")),
            ("unit/syntax", lambda: graph.connect("board.depth", "gain.in", gain="2 parsec")),
            ("wire/width", graph.connect, "board.force", "gain.in"),
            ("wire/two_into_one", graph.connect, "hand.position", "drag.position"),
            ("wire/onto_choice", graph.connect, "board.resistance", "drag.adhesion"),
            ("wire/add_to_input", lambda: graph.connect("board.resistance", "drag.normal_force", add=True)),
            ("wire/which_entry", graph.connect, "board.depth", "sum.in"),
            ("port/bad_index", graph.connect, "board.depth", "sum.in[2]"),
            ("port/not_a_vector", graph.connect, "board.depth.x", "sum.in[0]"),
            ("wire/syntax", graph.connect, "board.depth", "sum"),
            ("graph/loop", graph.connect, "sum.out", "sum.in[1]"),
            ("graph/loop", graph.connect, "sum.out", "gain.in"),
            ("edit/unknown_wire", graph.disconnect, "hand.position", "motor.force"),
        ]
        self.assertGreaterEqual(len(mistakes), 40)
        for id, edit, *arguments in mistakes:
            with self.subTest(id=id, arguments=arguments), self.assertRaises(tactus.Error) as raised:
                edit(*arguments)
            self.assertEqual(raised.exception.id, id, raised.exception)
            if id != "api/value":   # Python notices it before the graph does
                self.assertTrue(raised.exception.where and raised.exception.remedy, raised.exception)
            self.assertEqual(graph.text, text)

    def test_a_wire_is_removed_in_any_spelling(self):
        graph = wood()
        for start, *end in (("hand.position->drag.position",), (" board.resistance ", "drag.normal_force"), ("gain.out -> sum.in[00]",)):
            graph.disconnect(start, *end)
            self.assertTrue(graph.undo())

    def test_errors_in_a_file_say_where(self):
        self.fails("file/unreadable", tactus.Graph, "there/is/no/such.json")
        self.assertIn("tactus.Graph('dry_wood')", self.fails("file/unreadable", tactus.Graph, "no/graphs/dry_wood.json").remedy)
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
