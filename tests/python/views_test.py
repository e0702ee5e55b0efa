# SPDX-License-Identifier: MIT
"""What notebooks show: views of graphs, pictures, short reprs, data frames. A graph may come from a stranger, so nothing of it may become markup."""

import html.parser
import json
import sys
import unittest
import xml.etree.ElementTree
from types import SimpleNamespace

import numpy as np
import tactus
from tactus import _drawing, _views
from support import GRAPHS, TestCase, drag, positions

SVG = "{http://www.w3.org/2000/svg}"
# Everything that a picture consists of. No tag or attribute here can load, run or link to anything.
TAGS = {"svg", "g", "title", "rect", "text", "path"}
ATTRIBUTES = {"viewBox", "width", "height", "style", "font-family", "font-size", "font-weight", "fill", "x", "y", "rx", "stroke", "d", "stroke-dasharray",
              "opacity", "xmlns"}
STYLE = "max-width:100%;height:auto"
ATTACKS = ["<script>alert(1)</script>", "\"><img src=x onerror=alert(1)>", "' onload='alert(1)", "]]><script/>", "<!--", "&lt;script&gt;", "</svg></div><iframe>",
           "javascript:alert(1)", "\u202egnp.exe", "a\u0000b", "\x1b[31m", "{{7*7}}", "<style>*{display:none}</style>", "\ufffe", "x" * 100000]


def attacked(text):
    """A graph in which a stranger has put this text wherever the reader lets it through: ids of nodes, ports and roles have few characters."""
    return {"format": "tactus-graph", "version": 2, "name": text, "about": text, "tags": [text], "rate_hz": 1000,
            "nodes": {"a": {"type": "unknown." + text, "params": {"mu": text, "deep": [[text], {text: text}]}, "settings": {"seed": text}, text: text},
                      "b": {"type": "friction.elasto_plastic", "params": {"mu": text}}},
            "wires": [{"wire": "a.out -> b.position", text: text}, "a.out -> [3] -> b.normal_force"],
            "controls": {"c": {"name": text, "value": 0.5, "to": {"b.mu": [0, 1]}}}, "ui": {text: text}, text: text}


class Tags(html.parser.HTMLParser):
    """The tags and attributes that a browser finds in HTML."""

    def __init__(self):
        super().__init__()
        self.tags, self.attributes = set(), []

    def handle_starttag(self, tag, attributes):
        self.tags.add(tag)
        self.attributes += attributes

    def handle_comment(self, data):
        raise AssertionError(f"a comment: {data}")

    def handle_decl(self, decl):
        raise AssertionError(f"a declaration: {decl}")


class Attacks(TestCase):
    def graphs(self):
        for text in ATTACKS:
            graph = attacked(text)
            try:
                yield text, tactus.Graph.parse(json.dumps(graph))
            except tactus.Error as why:
                refused = {m.id for m in why.messages if m.is_error}
                self.assertTrue(refused, why)

    def test_nothing_of_a_graph_becomes_markup(self):
        seen = 0
        for text, graph in self.graphs():
            with self.subTest(text[:40]):
                self.harmless(graph)
                seen += len(graph.nodes) == 2
        self.assertGreaterEqual(seen, 8, "the reader refused nearly all of these graphs, so the pictures were not attacked")

    def test_nothing_of_a_name_that_was_given_in_python_becomes_markup(self):
        for text in ATTACKS:
            graph = None
            try:
                graph = tactus.Graph(name=text)
                graph.add_node("a", text, {text: text})
            except tactus.Error:
                pass
            if graph is not None:
                self.harmless(graph)

    def test_no_repr_steers_the_terminal(self):
        for text in ATTACKS:
            graph = {"nodes": {text: {"type": text, "role": text, "params": {text: text}}}, "wires": [{"wire": f"{text}.out -> b.in", "gain": text}, text],
                     "controls": {text: {"name": text, "value": 0.5, "to": {text: [0, 1]}}}}
            nodes, wires, controls = _views.nodes_in(graph), _views.wires_in(graph), _views.controls_in(graph)
            for each in (nodes, nodes[text], nodes[text].params, wires, wires[0], wires[1], controls, controls[text], controls[text].to):
                self.assertTrue(repr(each).isprintable())
                self.assertLess(len(repr(each)), 400)

    def test_nothing_of_a_node_becomes_markup_even_if_the_reader_let_it_through(self):
        for text in ATTACKS:
            graph = SimpleNamespace()
            node = _views.nodes_in({"nodes": {text: {"type": text, "role": text, "params": {text: text}}, "b": {"type": text}}})
            wires = _views.wires_in({"wires": [{"wire": f"{text}.out -> b.in", "gain": text}, f"b.{text} -> [3] -> b.{text}", text]})
            graph._repr_svg_ = lambda: _drawing.svg(node, wires)
            graph._repr_html_ = lambda: _drawing.html(text, 1000.0, node, wires)
            self.harmless(graph)

    def harmless(self, graph):
        drawn = graph._repr_svg_()
        for element in xml.etree.ElementTree.fromstring(drawn).iter():
            self.assertIn(element.tag.replace(SVG, ""), TAGS)
            self.assertLessEqual(set(element.attrib), ATTRIBUTES)
            self.assertIn(element.attrib.get("style", STYLE), STYLE)
        page = Tags()
        page.feed(graph._repr_html_())
        page.close()
        self.assertLessEqual(page.tags, TAGS | {"div", "p", "b"})
        self.assertLessEqual({name for name, _ in page.attributes}, {name.lower() for name in ATTRIBUTES})
        for whole in (drawn, graph._repr_html_()):
            self.assertLess(len(whole), 50000)
            whole.encode()
            self.assertFalse(any(c in whole for c in "\u202e\u0000\x1b\ufffe"))


class Pictures(TestCase):
    def test_a_picture_has_each_node_and_each_wire(self):
        for path in sorted(GRAPHS.glob("*.json")):
            graph = tactus.Graph(path)
            root = xml.etree.ElementTree.fromstring(graph._repr_svg_())
            names = [t.text for t in root.iter(SVG + "text") if t.get("font-weight")]
            self.assertEqual(names, list(graph.nodes), path.stem)
            self.assertEqual(sum(p.find(SVG + "title") is not None for p in root.iter(SVG + "path")), len(graph.wires), path.stem)
            places = [(r.get("x"), r.get("y")) for r in root.iter(SVG + "rect")]
            self.assertEqual(len(set(places)), len(places), f"{path.stem}: two nodes at the same place")

    def test_signals_run_from_left_to_right_and_delayed_wires_are_dashed(self):
        graph = drag()
        graph.add_node("gain", "vector.scale")
        graph.connect("drag.force", "gain.in")
        graph.connect("gain.out", "drag.position", gain="1e-4 m/N", delay=2)
        root = xml.etree.ElementTree.fromstring(graph._repr_svg_())
        x = [int(r.get("x")) for r in root.iter(SVG + "rect")]
        self.assertLess(x[0], x[1])
        self.assertEqual([p.get("stroke-dasharray") is not None for p in root.iter(SVG + "path")], [False, True])

    def test_large_graphs_give_small_pictures_and_loops_end(self):
        nodes = {f"n{i}": {"type": "signal.gain"} for i in range(3000)}
        wires = [f"n{i}.out -> n{(i + 1) % 3000}.in" for i in range(3000)] + [f"n{i}.out -> n{i}.in" for i in range(100)]
        graph = tactus.Graph.parse(json.dumps({"format": "tactus-graph", "version": 2, "nodes": nodes, "wires": wires}))
        drawn = graph._repr_svg_()
        self.assertIn("and 2800 more nodes", drawn)
        self.assertLess(len(drawn), 500000)

    def test_an_empty_graph_has_a_picture(self):
        xml.etree.ElementTree.fromstring(tactus.Graph()._repr_svg_())


class Views(TestCase):
    def test_nodes_wires_and_controls_are_those_of_the_file(self):
        graph = tactus.Graph(GRAPHS / "dry_wood.json")
        text = json.loads(graph.text)
        self.assertEqual({name: node.type for name, node in graph.nodes.items()}, {name: node["type"] for name, node in text["nodes"].items()})
        self.assertEqual(dict(graph.nodes["drag"].params), text["nodes"]["drag"]["params"])
        self.assertEqual(dict(graph.nodes["board"].settings), {"window": "1 ms"})
        self.assertEqual(graph.nodes["motor"].role, "stylus")
        self.assertEqual([str(wire) for wire in graph.wires], text["wires"])
        self.assertEqual((graph.wires[0].start, graph.wires[0].end), ("hand.position", "drag.position" if text["wires"][0].endswith("drag.position") else "board.position"))
        self.assertEqual((graph.controls["roughness"].value, graph.controls["roughness"].to["drag.mu"]), (0.5, [0.2, 0.6]))

    def test_a_wire_says_what_was_connected(self):
        graph = drag()
        graph.add_node("grain", "texture.grating")
        graph.connect("grain.force", "drag.position", gain="1e-4 m/N", delay=2)
        graph.connect("grain.force.x", "drag.mu", gain="1 1/N", add=True)
        first, second = graph.wires
        self.assertEqual((first.delay, first.gain, first.adds, first.is_enabled), (2, "1e-4 m/N", False, True))
        self.assertEqual((second.end, second.adds), ("drag.mu", True))
        for wire in graph.wires:
            graph.disconnect(str(wire))
        self.assertEqual(len(graph.wires), 0)

    def test_a_view_does_not_change_the_graph(self):
        graph = tactus.Graph(GRAPHS / "dry_wood.json")
        text = graph.text
        why = self.fails("view/read_only", graph.nodes["drag"].params.__setitem__, "mu", 0.1)
        self.assertIn("graph.set_param('drag'", why.remedy)
        self.fails("view/read_only", graph.nodes.__delitem__, "drag")
        self.fails("view/read_only", graph.controls.__setitem__, "roughness", 1)
        self.assertRaises(AttributeError, setattr, graph.nodes["drag"], "type", "x")
        graph.controls["roughness"].to["drag.mu"].append(3)
        self.assertEqual(graph.text, text)

    def test_views_say_what_they_are(self):
        graph = tactus.Graph(GRAPHS / "dry_wood.json")
        for view, begin in ((graph.nodes, "<nodes: hand, board"), (graph.nodes["drag"].params, "<params of drag: mu"), (graph.wires, "<wires: hand.position -> "),
                            (graph.controls, "<controls: roughness"), (graph.nodes["drag"], "<node drag: friction.elasto_plastic"),
                            (graph.nodes["motor"], "<node motor: device.force of stylus>"), (graph.controls["roughness"], "<control roughness: 0.5, moves")):
            self.assertTrue(repr(view).startswith(begin), repr(view))


class Reprs(TestCase):
    def objects(self):
        class Wall(tactus.Node):
            id = "own.wall"

        graph = tactus.Graph(GRAPHS / "dry_wood.json")
        run = graph.render(duration=0.5)
        engine = tactus.Engine(graph, devices={"stylus": tactus.PushedDevice(axes=["x"])})
        message = tactus.Message(True, "unit/mismatch", "/wires/3", "text " * 100, "remedy " * 100)
        return [graph, run, engine, engine.take("stylus"), engine.status(), tactus.PushedDevice(axes=["x"]), message, tactus.TactusWarning(message),
                tactus.Error([message]), Wall(), tactus.Signal(np.zeros((10000, 2)), 8000), tactus.Mesh(np.zeros((1000, 3)), np.zeros((1000, 3), int)),
                tactus.Point({"drag.mu": 0.2}, run), tactus.Health("stylus", "tactus_board", True, 0.001, 0.02, 1000.0, 5, 0, 0, ""),
                tactus.scalar("N/m", "slope"), tactus.vector("m"), tactus.choice(["a", "b"]), *self.reports()]

    def reports(self):
        condition = dict(id="contact", role="stylus", node="wall", verdict="stable", value=1.0, limit=2.0, margin=2.0, unit="N/m", law="", text="text " * 100,
                         remedy="remedy " * 100)
        check = tactus.Check({"scope": "word " * 100, "rate_hz": 4000, "not_judged": [], "conditions": [condition], "broken": False})
        limits = tactus.Limits({"role": "stylus", "node": "wall", "stiffness": 1.0, "damping": 1.0, "rate_hz": 4000.0, "passive": dict.fromkeys(("stiffness", "damping", "rate")), "stable": dict.fromkeys(("stiffness", "damping", "rate"))})
        residual = {"rms": 0.1, "left_out_rms": 0.1, "recording_rms": 1.0, "unit": "N"}
        value = {"name": "mu", "unit": "", "value": 0.3, "low": 0.2, "high": 0.4, "main": True}
        fit = tactus.Fit({"kind": "friction", "verdict": "good", "parameters": [value], "lacking": [], "notes": [], "residual": residual, "rows": 10})
        loss = dict(id="clip/rate", where="", text="text " * 100, remedy="remedy " * 100)
        written = tactus.Conversion({"files": [{"name": "a.ahap", "losses": [loss], "differences": ["word " * 100]}], "notes": []})
        return [check, check.conditions[0], written, limits, tactus.Interval(0.0, 1.0, True, True), fit, fit.values["mu"], tactus.Devices([condition] * 20),
                tactus.Event(3, "turn", "drag.mu", "text " * 100), tactus.Log(tactus.Records({"t": np.zeros(3)}, rate_hz=4000.0), {
                    "head": {"clocks": None, "program": ""}, "events": [], "is_cut_off": False})]

    def test_every_public_class_has_a_short_one(self):
        objects = self.objects()
        public = {getattr(tactus, name) for name in tactus.__all__ if isinstance(getattr(tactus, name), type)}
        missing = {c.__name__ for c in public if not any(isinstance(o, c) for o in objects)} - {"Session"}   # play_test has that
        self.assertEqual(missing, set())
        for each in objects:
            with self.subTest(type(each).__name__):
                self.assertLess(len(repr(each)), 260)
                self.assertNotIn("\n", repr(each))
                self.assertNotIn(" at 0x", repr(each))

    def test_they_say_what_is_inside(self):
        graph, run, *_ = self.objects()
        self.assertEqual(repr(graph), "<tactus.Graph 'Dry wood': 7 nodes, 10 wires, 4000 Hz>")
        self.assertEqual(repr(run), "<tactus.Records of 2000 ticks at 4000 Hz: motor.force (N), motor.torque (N*m)>")


class Frames(TestCase):
    def records(self):
        return drag().render(feed={"drag.position": positions(50), "drag.normal_force": 1.0}, record=["drag.force", "drag.state", "drag.deflection.x"])

    def test_a_data_frame_has_a_column_for_each_component_and_its_unit(self):
        run = self.records()
        frame = run.to_dataframe()
        self.assertEqual(list(frame.columns), ["drag.force.x", "drag.force.y", "drag.force.z", "drag.state", "drag.deflection.x"])
        self.assertEqual(frame.index.name, "t")
        self.same_bits(frame.index, run["t"])
        self.same_bits(frame[["drag.force.x", "drag.force.y", "drag.force.z"]], run["drag.force"])
        self.same_bits(frame["drag.state"], run["drag.state"])
        self.assertEqual(frame.attrs["units"], {"t": "s", "drag.force.x": "N", "drag.force.y": "N", "drag.force.z": "N", "drag.state": "1", "drag.deflection.x": "m"})
        self.assertEqual(frame.attrs["rate_hz"], 1000)

    def test_a_dataset_has_vectors_with_an_axis_and_units(self):
        run = self.records()
        data = run.to_xarray()
        self.same_bits(data["drag.force"].sel(axis="y"), run["drag.force"][:, 1])
        self.same_bits(data["t"], run["t"])
        self.assertEqual(data["drag.force"].dims, ("t", "axis"))
        self.assertEqual(data["drag.state"].dims, ("t",))
        self.assertEqual({name: data[name].attrs["units"] for name in ("t", "drag.force", "drag.state", "drag.deflection.x")},
                         {"t": "s", "drag.force": "N", "drag.state": "1", "drag.deflection.x": "m"})
        self.assertEqual(data.attrs["rate_hz"], 1000)

    def test_steps_and_empty_records_have_frames_too(self):
        engine = tactus.Engine(drag(), feed={"drag.position": (0, 0, 0), "drag.normal_force": 1.0}, record=["drag.force"])
        self.assertEqual(len(engine.step(n=0).to_dataframe()), 0)
        self.assertEqual(engine.step(n=3).to_xarray().sizes["t"], 3)

    def test_changed_records_are_refused(self):
        run = self.records()
        run["mine"] = np.zeros(3)
        self.fails("records/shape", run.to_dataframe)
        self.fails("records/shape", run.to_xarray)

    def test_a_package_that_is_missing_is_named(self):
        for name, function in (("pandas", "to_dataframe"), ("xarray", "to_xarray")):
            before = {key: sys.modules.pop(key) for key in list(sys.modules) if key.split(".")[0] == name}
            sys.modules[name] = None   # as if it were not installed
            try:
                why = self.fails(f"records/no_{name}", getattr(self.records(), function))
                self.assertIn(name, why.text)
                self.assertIn(f"python3-{name}", why.remedy)
            finally:
                del sys.modules[name]
                sys.modules.update(before)


try:
    import pandas   # noqa: F401
    import xarray   # noqa: F401
except ImportError:
    Frames = unittest.skip("pandas or xarray is not installed")(Frames)

if __name__ == "__main__":
    unittest.main()
