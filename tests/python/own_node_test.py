# SPDX-License-Identifier: MIT
"""Nodes written in Python."""

import concurrent.futures
import math
import sys
import unittest

import numpy as np
import tactus
from support import ROOT, TestCase, positions

sys.path.insert(0, str(ROOT / "docs" / "examples" / "python"))


class Ridges(tactus.Node):
    """texture.grating, written in Python."""

    id = "own.ridges"
    inputs = {"position": tactus.vector("m", "tool position")}
    params = {"amplitude": tactus.scalar("N", default=0.1, hard=(0, None)), "spatial_frequency": tactus.scalar("1/m", default=200.0),
              "along": tactus.vector("1", default=(1, 0, 0)), "shape": tactus.choice(["sine", "cosine"])}
    outputs = {"force": tactus.vector("N"), "value": tactus.scalar("N"), "state": tactus.scalar("1")}

    def tick(self, inputs, params):
        s = float(params.along @ inputs.position)
        wave = math.sin if params.shape == "sine" else math.cos
        value = params.amplitude * wave(2.0 * math.pi * params.spatial_frequency * s)
        return {"force": value * params.along, "value": value, "state": 1}


class Counter(tactus.Node):
    id = "own.counter"
    inputs = {"step": tactus.scalar("1")}
    params = {"limit": tactus.scalar("1", default=1e300, hard=(0, None))}
    outputs = {"count": tactus.scalar("1"), "state": tactus.scalar("1")}

    def prepare(self, rate_hz):
        self.count = 0.0
        self.rate_hz = rate_hz

    def tick(self, inputs, params):
        self.count += inputs.step
        if self.count > params.limit:
            raise ArithmeticError("counted too far")
        return {"count": self.count if self.count < 50 else math.inf, "state": 0}


def graph_of(kind, **params):
    graph = tactus.Graph(rate=1000)
    graph.add_node("own", kind.id, params)
    return graph


def count(steps, **params):
    return graph_of(Counter, **params).render(feed={"own.step": np.asarray(steps, dtype=float)}, record=["own.count", "own.state"], nodes=[Counter])


class OwnNodes(TestCase):
    def test_a_model_in_python_is_the_model_in_cpp(self):
        graph = graph_of(Ridges, amplitude="60 mN", spatial_frequency=1200)
        graph.add_node("wood", "texture.grating", {"amplitude": "60 mN", "spatial_frequency": 1200})
        p = positions(500)
        run = graph.render(feed={"own.position": p, "wood.position": p}, record=["own.force", "own.value", "wood.force", "wood.value"], nodes=[Ridges])
        np.testing.assert_allclose(run["own.force"], run["wood.force"], rtol=1e-12, atol=1e-15)
        np.testing.assert_allclose(run["own.value"], run["wood.value"], rtol=1e-12, atol=1e-15)
        again = graph.render(feed={"own.position": p, "wood.position": p}, record=["own.force"], nodes=[Ridges])
        self.same_bits(run["own.force"], again["own.force"])

    def test_choices_vectors_wires_and_ranges_work_as_in_cpp(self):
        p = positions(20)
        cosine = graph_of(Ridges, shape="cosine", along=[0, 1, 0]).render(feed={"own.position": p}, record=["own.force"], nodes=[Ridges])["own.force"]
        np.testing.assert_allclose(cosine[:, 1], 0.1 * np.cos(2 * np.pi * 200 * p[:, 1]))
        fed = graph_of(Ridges).render(feed={"own.position": p, "own.amplitude": np.full(20, -3.0)}, record=["own.force"], nodes=[Ridges])
        self.assertTrue(np.all(fed["own.force"] == 0))   # clamped to the hard range
        self.fails("param/out_of_range", graph_of(Ridges, amplitude=-1).render, duration=0.1, record=["own.force"], nodes=[Ridges])
        self.fails("param/unknown_choice", graph_of(Ridges, shape="square").render, duration=0.1, record=["own.force"], nodes=[Ridges])
        wrong = graph_of(Ridges)
        wrong.add_node("ground", "deform.plane")
        wrong.connect("ground.force", "own.position")
        self.fails("wire/unit", wrong.render, duration=0.1, record=["own.force"], nodes=[Ridges])

    def test_a_non_finite_number_gives_zero_and_leaves_no_trace(self):
        run = count([1, 1, np.nan, 1, np.inf, 1, 1])
        self.assertEqual(run["own.count"].tolist(), [1, 2, 0, 1, 0, 1, 2])
        self.assertEqual(run["own.state"].tolist(), [0, 0, -1, 0, -1, 0, 0])
        self.assertEqual(count([49, 1, 1])["own.count"].tolist(), [49, 0, 1])   # on the second tick, tick() returns inf

    def test_an_exception_ends_the_run_and_is_raised(self):
        with self.assertRaisesRegex(ArithmeticError, "too far"):
            count([1] * 100, limit=10)
        engine = tactus.Engine(graph_of(Counter, limit=10), feed={"own.step": 1.0}, nodes=[Counter])
        with self.assertRaises(ArithmeticError):
            engine.step(n=100)
        self.fails("engine/failed", engine.step)

    def test_exceptions_in_init_prepare_and_results_are_raised(self):
        class Broken(Counter):
            def prepare(self, rate_hz):
                raise OSError("no table")

        class Short(Counter):
            def tick(self, inputs, params):
                return {"count": 1.0}

        with self.assertRaises(OSError):
            graph_of(Broken).render(duration=0.1, record=["own.count"], nodes=[Broken])
        with self.assertRaisesRegex(TypeError, "count, state"):
            graph_of(Short).render(duration=0.1, record=["own.count"], nodes=[Short])

    def test_an_edit_keeps_the_state_of_a_node(self):
        graph = graph_of(Counter)
        engine = tactus.Engine(graph, feed={"own.step": 1.0}, record=["own.count"], nodes=[Counter])
        engine.step(n=3)
        graph.add_node("more", "own.counter")
        engine.edit(graph)
        self.assertEqual(engine.step(n=2)["own.count"].tolist(), [4, 5])

    def test_own_nodes_do_not_run_live(self):
        engine = tactus.Engine(graph_of(Counter), feed={"own.step": 1.0}, nodes=[Counter])
        self.fails("node/offline", engine.start)

    def test_a_node_that_steps_its_own_engine_is_refused(self):
        engines = []

        class Own(Counter):
            def tick(self, inputs, params):
                engines[0].step()

        engines.append(tactus.Engine(graph_of(Own), nodes=[Own]))
        self.fails("engine/busy", engines[0].step)

    def test_descriptions_are_checked(self):
        def kind(**members):
            return type("Kind", (Counter,), members)
        self.fails("node/id_taken", tactus.Engine, tactus.Graph(), nodes=[kind(id="signal.gain")])
        self.fails("node/id_taken", tactus.Engine, tactus.Graph(), nodes=[Counter, kind()])
        self.fails("node/id", tactus.Engine, tactus.Graph(), nodes=[kind(id="")])
        self.fails("node/unit", tactus.Engine, tactus.Graph(), nodes=[kind(inputs={"step": tactus.scalar("mm")})])
        self.fails("node/unit", tactus.Engine, tactus.Graph(), nodes=[kind(inputs={"step": tactus.scalar("parsec")})])
        self.fails("node/quantity", tactus.Engine, tactus.Graph(), nodes=[kind(inputs={"step": tactus.scalar("m", quantity="width")})])
        self.fails("node/choice", tactus.Engine, tactus.Graph(), nodes=[kind(inputs={"step": tactus.choice(["a", "b"])})])
        self.fails("node/default", tactus.vector, "m", default=(0, 0))
        self.fails("node/kind", tactus.Engine, tactus.Graph(), nodes=[Counter()])

    def test_a_graph_without_the_class_does_not_compile(self):
        self.fails("node/unknown_type", graph_of(Counter).render, duration=0.1)

    def test_engines_give_back_what_they_use(self):
        for _ in range(600):   # more than there are slots for node types
            tactus.Engine(graph_of(Counter), feed={"own.step": 1.0}, nodes=[Counter]).step()

    def test_threads_have_nodes_of_their_own(self):
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            for run in pool.map(lambda _: count([0.1] * 200), range(12)):
                self.same_bits(run["own.count"], np.cumsum([0.1] * 200))

    def test_the_example_attracts_with_the_pull_that_is_set(self):
        import own_node
        for point in tactus.sweep(own_node.make_graph(), {"magnet.pull": [0.5, 2]}, duration=1.0, nodes=[own_node.Magnet]):
            largest = np.linalg.norm(point.result["motor.force"], axis=1).max()
            self.assertLessEqual(largest, point.set["magnet.pull"] * (1 + 1e-12))
            self.assertGreater(largest, 0.5 * point.set["magnet.pull"])


if __name__ == "__main__":
    unittest.main()
