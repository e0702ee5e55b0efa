# SPDX-License-Identifier: MIT
"""Files that settings name, and arrays instead of files."""

import gc
import pathlib
import pickle
import tempfile
import unittest
import weakref

import numpy as np
import tactus
from support import GRAPHS, TestCase, pixels

RELIEF = np.array([[0.0, 0.2, 0.4, 0.2], [0.2, 1.0, 0.6, 0.2], [0.0, 0.2, 0.4, 0.2]])
CORNERS = [[0, 0, 0], [0.02, 0, 0], [0, 0.02, 0], [0.02, 0.02, 0]]
FACES = [[0, 1, 2], [1, 3, 2]]
PATH = np.column_stack([np.linspace(0.004, 0.012, 400), np.full(400, 0.007), np.linspace(0.002, -0.004, 400)])


def relief(kind, name, folder="", **more):
    graph = tactus.Graph.parse('{"format": "tactus-graph", "version": 2, "rate_hz": 1000}', folder)
    graph.add_node("it", "texture.height_map", settings={"map": {kind: name, "pitch": "1 mm", "height": "1 mm", **more}})
    return graph


def body(folder="", **mesh):
    graph = tactus.Graph.parse('{"format": "tactus-graph", "version": 2, "rate_hz": 1000}', folder)
    law = [{"power": [1000, 1]}, {"power": [1000, 1]}, {"power": [500, 1]}]
    graph.add_node("it", "deform.surface", settings={"surface": {"curves": [law], "mu": 0.5, **mesh}})
    return graph


def felt(graph, assets=None):
    force = graph.render(feed={"it.position": PATH}, record=["it.force"], assets=assets)["it.force"]
    assert np.any(force), "nothing is felt"
    return force


class Supplied(TestCase):
    def test_arrays_give_the_bits_of_the_files_that_they_replace(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "scan.csv").write_text("\n".join(",".join(map(str, row)) for row in RELIEF))
            (folder / "square.obj").write_text("".join(f"v {x} {y} {z}\n" for x, y, z in CORNERS) + "f 1 2 3\nf 2 4 3\n")
            read = felt(relief("csv", "scan.csv", folder))
            self.same_bits(felt(relief("csv", "none.csv", folder), {"none.csv": RELIEF}), read)
            mesh = felt(body(folder, mesh="square.obj"))
            self.same_bits(felt(body(mesh="none.obj"), {"none.obj": tactus.Mesh(CORNERS, FACES)}), mesh)
            self.same_bits(felt(body(nodes=CORNERS, triangles=FACES)), mesh)
            self.same_bits(felt(body(folder, mesh="square.obj"), {"other.obj": tactus.Mesh(CORNERS, FACES)}), mesh)   # another name: the file is read

    def test_a_preset_is_read_beside_its_file_wherever_the_program_runs(self):
        force = tactus.Graph(GRAPHS / "liver.json").render(duration=1.5)["motor.force"]
        self.assertTrue(np.any(force))

    def test_pixels_of_all_types_and_colours_give_the_same_bits(self):
        grey = (RELIEF * 255).astype(np.uint8)
        want = felt(relief("image", "a.png"), {"a.png": grey})
        deep = grey.astype(np.uint16) * 257
        for same in (grey / 255, deep, np.dstack([grey] * 3), np.dstack([grey] * 3 + [np.full_like(grey, 7)]), np.dstack([grey, grey]), grey[:, :, None]):
            with self.subTest(f"{same.dtype} {same.shape}"):
                self.same_bits(felt(relief("image", "a.png"), {"a.png": same}), want)
        colours = np.dstack([grey, grey // 2, grey // 3])
        luminance = (0.299 * grey + 0.587 * (grey // 2) + 0.114 * (grey // 3)) / 255
        self.assertTrue(np.allclose(felt(relief("image", "a.png"), {"a.png": colours}), felt(relief("image", "a.png"), {"a.png": luminance})))
        black_and_white = RELIEF > 0.3
        self.same_bits(felt(relief("image", "a.png"), {"a.png": black_and_white}), felt(relief("image", "a.png"), {"a.png": black_and_white.astype(float)}))

    def test_a_recording_has_a_rate_and_channels(self):
        ring = np.exp(-np.arange(200) / 40) * np.sin(np.arange(200) / 5)

        def rung(samples, channel):
            graph = tactus.Graph(rate=1000)
            graph.add_node("it", "vibration.wavetable", settings={"table": {"wav": "tap.wav", "channel": channel}})
            engine = tactus.Engine(graph, record=["it.value"], assets={"tap.wav": tactus.Signal(samples, 1000)})
            engine.hit("it.hit", 1.0)
            return engine.step(n=150)["it.value"]

        alone = rung(ring, 1)
        self.assertGreater(np.max(np.abs(alone)), 0.3)
        two = np.column_stack([np.zeros(200), ring])
        self.same_bits(rung(two, 2), alone)
        self.assertFalse(np.any(rung(two, 1)))

    def test_a_function_is_given_the_kind_and_the_path(self):
        asked = []

        def find(kind, path):
            asked.append((kind, path))
            return RELIEF if kind == "image" else None

        felt(relief("image", "a.png", "some/folder"), find)
        self.assertEqual(asked, [("image", str(pathlib.Path("some/folder/a.png")))])

    def test_the_longest_name_wins_and_a_name_is_whole_parts_of_a_path(self):
        graph = relief("image", "skins/hide.png", "/of/the/graph")
        want = felt(graph, {"skins/hide.png": RELIEF})
        self.same_bits(felt(graph, {"hide.png": RELIEF * 0, "skins/hide.png": RELIEF}), want)
        self.same_bits(felt(graph, {"/of/the/graph/skins/hide.png": RELIEF, "skins/hide.png": RELIEF * 0}), want)
        self.fails("setting/value", felt, graph, {"ide.png": RELIEF})

    def test_an_edit_asks_again_and_keeps_nothing_that_is_not_needed(self):
        pictures = {"a.png": RELIEF.copy()}
        graph = relief("image", "a.png")
        engine = tactus.Engine(graph, feed={"it.position": PATH[300]}, record=["it.force"], assets=lambda _, path: pictures[path])
        engine.step(n=10)
        gone = weakref.ref(pictures["a.png"])
        pictures["a.png"] = RELIEF[::-1].copy()
        engine.edit(graph)
        engine.step(n=10)
        gc.collect()
        self.assertIsNone(gone())

    def test_a_sweep_and_a_pickled_graph_take_assets(self):
        picture = {"leather.png": pixels(GRAPHS / "assets/leather.png")}
        graph = tactus.Graph(GRAPHS / "pebbled_leather.json")
        one = graph.render(duration=0.2, assets=picture)["motor.force"]
        point, = tactus.sweep(pickle.loads(pickle.dumps(graph)), {"drag.mu": [0.4]}, duration=0.2, assets=picture)
        self.assertEqual(one.shape, point.result["motor.force"].shape)


class Refused(TestCase):
    def test_a_file_that_cannot_be_read_says_why(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "a.png").write_bytes(b"x")
            (folder / "words.csv").write_text("1,2\nthree,4\n")
            self.assertIn("there is no such file", self.fails("setting/value", felt, relief("csv", "none.csv", folder)).text)
            self.assertIn("words.csv:2: 'three' is not a finite number", self.fails("setting/value", felt, relief("csv", "words.csv", folder)).text)
            self.assertIn("no decoder for pictures", self.fails("setting/value", felt, relief("image", "a.png", folder)).text)

    def test_arrays_of_the_wrong_form_are_refused(self):
        for wrong in (RELIEF[0], np.zeros((2, 2, 5)), np.zeros((2, 2), int), np.array([["a"]])):
            self.fails("asset/shape", felt, relief("image", "a.png"), {"a.png": wrong})
        self.fails("asset/shape", felt, relief("csv", "a.csv"), {"a.csv": np.zeros((2, 2, 2))})
        self.fails("asset/shape", felt, relief("csv", "a.csv"), {"a.csv": "numbers"})
        for wrong in (CORNERS, tactus.Mesh(np.zeros((3, 2)), FACES), tactus.Mesh(CORNERS, np.zeros((2, 3)))):
            self.fails("asset/shape", felt, body(mesh="a.obj"), {"a.obj": wrong})
        self.fails("mesh/no_such_point", felt, body(mesh="a.obj"), {"a.obj": tactus.Mesh(CORNERS, [[0, 1, 4]])})
        self.assertIn("not finite", self.fails("setting/value", felt, relief("image", "a.png"), {"a.png": RELIEF * np.nan}).text)
        self.assertIn("no numbers", self.fails("setting/value", felt, relief("image", "a.png"), {"a.png": np.zeros((0, 3))}).text)

    def test_an_exception_of_the_function_is_raised(self):
        def broken(kind, path):
            raise KeyError(path)

        with self.assertRaises(KeyError):
            felt(relief("image", "a.png"), broken)
        calls = []

        def breaks_later(kind, path):
            calls.append(path)
            return RELIEF if len(calls) == 1 else 1 / 0

        graph = relief("image", "a.png")
        engine = tactus.Engine(graph, feed={"it.position": PATH[300]}, record=["it.force"], assets=breaks_later)
        before = engine.step(n=5)["it.force"]
        self.assertRaises(ZeroDivisionError, engine.edit, graph)
        self.assertEqual(engine.step(n=5)["it.force"].shape, before.shape)   # the graph before the edit keeps playing

    def test_limits_are_those_of_the_program(self):
        try:
            tactus.set_limits("numbers=8")
            self.assertIn("the budget `numbers` allows 8", self.fails("setting/value", felt, relief("image", "a.png"), {"a.png": RELIEF}).text)
            self.fails("limits/value", tactus.set_limits, "numbers=many")
        finally:
            tactus.set_limits("")
        felt(relief("image", "a.png"), {"a.png": RELIEF})


if __name__ == "__main__":
    unittest.main()
