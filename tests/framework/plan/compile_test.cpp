// SPDX-License-Identifier: MIT
#include "support/sketch.hpp"

#include <catch2/catch.hpp>

using namespace tactus;
using tactus::test::has;
using tactus::test::Sketch;

namespace
{
/// The first tap after a number of ticks.
double run (const Sketch& sketch, std::string record, int ticks = 1)
{
    auto [plan, messages] = sketch.compile ({ .records = { std::move (record) } });
    INFO (tactus::test::text (messages));
    REQUIRE (plan);
    for (int k = 0; k < ticks; ++k)
        plan->tick();
    return *plan->taps().at (0).value;
}

Messages problems (const Sketch& sketch, CompileOptions options = {}) { return sketch.compile (std::move (options)).messages; }
}   // namespace

TEST_CASE ("a wire adds no delay: a chain responds within the tick, regardless of the order in which it was written", "[plan]")
{
    const auto forwards = Sketch {}
                              .node ("a", "signal.constant", { { "value", 3.0 } })
                              .node ("b", "signal.gain", { { "gain", 2.0 } })
                              .node ("c", "signal.abs")
                              .wire ("a.out -> b.in")
                              .wire ("b.out -> c.in");
    const auto backwards = Sketch {}
                               .node ("c", "signal.abs")
                               .node ("b", "signal.gain", { { "gain", 2.0 } })
                               .node ("a", "signal.constant", { { "value", 3.0 } })
                               .wire ("b.out -> c.in")
                               .wire ("a.out -> b.in");

    CHECK (run (forwards, "c.out") == 6.0);
    CHECK (run (backwards, "c.out") == 6.0);
}

TEST_CASE ("an explicit delay delays a wire by that many ticks", "[plan]")
{
    const auto sketch = Sketch {}
                            .node ("count", "signal.add")
                            .node ("one", "signal.constant", { { "value", 1.0 } })
                            .node ("late", "signal.gain")
                            .wire ("one.out -> count.in[0]")
                            .wire ("count.out -> [1] -> count.in[1]")
                            .wire ("count.out -> [3] -> late.in");

    CHECK (run (sketch, "count.out", 5) == 5.0);
    CHECK (run (sketch, "late.out", 5) == 2.0);
}

TEST_CASE ("a delay node opens a loop, and a plain loop is refused, with its chain and a suggested place for a delay", "[plan]")
{
    auto sketch = Sketch {}
                      .node ("one", "signal.constant", { { "value", 1.0 } })
                      .node ("sum", "signal.add")
                      .node ("half", "signal.gain", { { "gain", 0.5 } })
                      .wire ("one.out -> sum.in[0]")
                      .wire ("sum.out -> half.in");

    SECTION ("with a delay node")
    {
        sketch.node ("late", "signal.delay").wire ("half.out -> late.in").wire ("late.out -> sum.in[1]");
        CHECK (run (sketch, "sum.out", 3) == 1.75);
    }
    SECTION ("without")
    {
        sketch.wire ("half.out -> sum.in[1]");
        const auto messages = problems (sketch);
        REQUIRE (has (messages, "graph/loop"));
        CHECK (messages[0].text.find ("half.out -> sum.in[1], then sum.out -> half.in") != std::string::npos);
        CHECK (messages[0].remedy.find ("half.out -> [1] -> sum.in[1]") != std::string::npos);
        CHECK (messages[0].where == "/wires/2");
    }
}

TEST_CASE ("forces into one sink are summed, and positions into one input are refused, naming both wires", "[plan]")
{
    auto sketch = Sketch {}.node ("hand", "device.position").node ("there", "device.truth").node ("x", "signal.constant").node ("motor", "device.force");
    sketch.node ("a", "vector.join").node ("b", "vector.join").node ("c", "vector.join").node ("two", "signal.constant", { { "value", "2 N" } });
    sketch.wire ("two.out -> a.x")
        .wire ("two.out -> b.x")
        .wire ("two.out -> c.x")
        .wire ("a.out -> motor.force")
        .wire ("b.out -> motor.force")
        .wire ("c.out -> motor.force");
    CHECK (run (sketch, "motor.force.x") == 6.0);

    sketch.node ("split", "vector.split").wire ("hand.position -> split.in").wire ("there.position -> split.in");
    const auto messages = problems (sketch);
    REQUIRE (has (messages, "wire/two_into_one"));
    CHECK (messages[0].text.find ("hand.position -> split.in") != std::string::npos);
}

TEST_CASE ("a wire into a parameter replaces its value, and (+) adds to it, both within the hard range", "[plan]")
{
    auto sketch = Sketch {}
                      .node ("three", "signal.constant", { { "value", 3.0 } })
                      .node ("amp", "signal.gain", { { "gain", 10.0 } })
                      .node ("one", "signal.constant", { { "value", 1.0 } })
                      .wire ("one.out -> amp.in");

    SECTION ("replaced") { CHECK (run (sketch.wire ("three.out -> amp.gain"), "amp.out") == 3.0); }
    SECTION ("added") { CHECK (run (sketch.wire ("three.out -> (+) amp.gain"), "amp.out") == 13.0); }
    SECTION ("fed: a feed overrides the wire")
    {
        auto [plan, messages] = sketch.wire ("three.out -> amp.gain").compile ({ .feeds = { "amp.gain" }, .records = { "amp.out" } });
        REQUIRE (plan);
        plan->feeds()[0] = 7.0;
        plan->tick();
        CHECK (*plan->taps()[0].value == 7.0);
    }
    SECTION ("a driven value is clamped to the hard range")
    {
        auto [plan, messages] =
            Sketch {}.node ("drag", "friction.elasto_plastic").compile ({ .feeds = { "drag.mu", "drag.d_max" }, .records = { "drag.mu", "drag.d_max" } });
        REQUIRE (plan);
        plan->setFeeds (std::vector { -3.0, 0.0 });
        plan->tick();
        CHECK (*plan->taps()[0].value == 0.0);
        CHECK (*plan->taps()[1].value == 1e-9);
    }
    SECTION ("a nan at a parameter is a fault of the node, which ends when the nan does")
    {
        auto [plan, messages] = sketch.compile ({ .feeds = { "amp.gain" }, .records = { "amp.out" } });
        REQUIRE (plan);
        plan->feeds()[0] = std::numeric_limits<double>::quiet_NaN();
        plan->tick();
        CHECK (*plan->taps()[0].value == 0.0);
        plan->feeds()[0] = 2.0;
        plan->tick();
        CHECK (*plan->taps()[0].value == 2.0);
    }
}

TEST_CASE ("a subgraph shows its exposed ports, and its parameters can be set from outside", "[plan]")
{
    Sketch sketch;
    auto& twice = sketch.subgraph ("twice");
    sketch.add (twice, "amp", "signal.gain", { { "gain", 2.0 } });
    twice.expose = { { { "x", { "", "", -1, -1 } } }, {}, {} };
    twice.expose.inputs = { { "x", { "amp", "in" } } };
    twice.expose.outputs = { { "y", { "amp", "out" } } };
    twice.expose.params = { { "factor", { "amp", "gain" } } };
    sketch.node ("one", "signal.constant", { { "value", 1.0 } }).node ("first", "graph:twice").node ("second", "graph:twice", { { "factor", 5.0 } });
    sketch.wire ("one.out -> first.x").wire ("first.y -> second.x");

    CHECK (run (sketch, "second.y") == 10.0);
    CHECK (run (sketch, "first/amp.out") == 2.0);

    SECTION ("overrides take precedence over params")
    {
        sketch.graph.root.nodes[1].overrides = { { "amp.gain", 7.0 } };
        CHECK (run (sketch, "second.y") == 35.0);
    }
    SECTION ("a bypassed subgraph passes on only inputs that have the same name as an output")
    {
        sketch.graph.root.nodes[1].bypass = true;
        CHECK (run (sketch, "second.y") == 0.0);
        twice.expose.outputs = { { "x", { "amp", "out" } } };
        sketch.graph.root.wires.back() = *graph::parseWire ("first.x -> second.x");
        CHECK (run (sketch, "second.x") == 5.0);
    }
    SECTION ("a subgraph that contains itself is refused")
    {
        sketch.add (twice, "again", "graph:twice");
        CHECK (has (problems (sketch), "graph/recursive"));
    }
}

TEST_CASE ("a bypassed node passes `in` on to `out`", "[plan]")
{
    auto sketch = Sketch {}
                      .node ("one", "signal.constant", { { "value", 1.0 } })
                      .node ("amp", "signal.gain", { { "gain", 9.0 } })
                      .node ("sum", "signal.add")
                      .wire ("one.out -> amp.in")
                      .wire ("amp.out -> sum.in[0]")
                      .wire ("one.out -> sum.in[1]");
    sketch.graph.root.nodes[1].bypass = true;
    CHECK (run (sketch, "amp.out") == 1.0);
    sketch.graph.root.nodes[2].bypass = true;
    CHECK (run (sketch, "sum.out") == 2.0);
}

TEST_CASE ("a bypassed node outputs 1 for a gain and 0 for everything else, including a direction and an output that is -1 at rest", "[plan]")
{
    auto sketch = Sketch {}.node ("body", "deform.surface").node ("edge", "contact.window");
    for (auto& n : sketch.graph.root.nodes)
        n.bypass = true;
    CHECK (run (sketch, "edge.gain") == 1.0);
    CHECK (run (sketch, "body.normal.x") == 0.0);
    CHECK (run (sketch, "body.triangle") == 0.0);
}

TEST_CASE ("controls set their targets, but --set and wires take precedence", "[plan]")
{
    auto sketch = Sketch {}.node ("one", "signal.constant", { { "value", 1.0 } }).node ("amp", "signal.gain", { { "gain", 9.0 } }).wire ("one.out -> amp.in");
    graph::Control control { .id = "loud", .name = "Loud", .value = 0.25, .to = { { "amp.gain", 2.0, 6.0 } } };
    sketch.graph.controls.push_back (control);

    CHECK (run (sketch, "amp.out") == 3.0);
    const auto with = [&] (std::string name, Json value) {
        auto plan = sketch.compile ({ .records = { "amp.out" }, .overrides = { { std::move (name), std::move (value) } } }).plan;
        plan->tick();
        return *plan->taps()[0].value;
    };
    CHECK (with ("amp.gain", 8.0) == 8.0);
    CHECK (with ("loud", 1.0) == 6.0);
}

TEST_CASE ("units are checked on wires, on values, and through generic nodes", "[plan]")
{
    auto sketch = Sketch {}.node ("hand", "device.position").node ("motor", "device.force");

    SECTION ("a length wired into a force is refused, and a gain with a unit fixes it")
    {
        sketch.wire ("hand.position -> motor.force");
        REQUIRE (has (problems (sketch), "wire/unit"));
        sketch.graph.root.wires[0].gain = "-200 N/m";
        CHECK (problems (sketch).empty());
    }
    SECTION ("through an adder")
    {
        sketch.node ("sum", "vector.add").wire ("hand.position -> sum.in[0]").wire ("sum.out -> motor.force");
        CHECK (has (problems (sketch), "wire/unit"));
    }
    SECTION ("a product carries the product of the dimensions")
    {
        sketch.node ("split", "vector.split").node ("k", "signal.constant", { { "value", "200 N/m" } }).node ("f", "signal.multiply");
        sketch.wire ("hand.position -> split.in").wire ("split.x -> f.in[0]").wire ("k.out -> f.in[1]").wire ("f.out -> motor.force.x");
        CHECK (problems (sketch).empty());
        sketch.graph.root.nodes[3].params["value"] = "200 N";
        CHECK (has (problems (sketch), "node/unit"));
    }
    SECTION ("a generic parameter takes the unit of the wire")
    {
        sketch.node ("c", "signal.constant", { { "value", "2 mm" } }).wire ("c.out -> motor.force.x");
        CHECK (has (problems (sketch), "param/unit"));
    }
    SECTION ("a torque wired into an energy is only a warning")
    {
        sketch.node ("drag", "friction.elasto_plastic").wire ("drag.stored_energy -> motor.torque.x");
        const auto messages = problems (sketch);
        REQUIRE (has (messages, "wire/quantity"));
        CHECK_FALSE (hasErrors (messages));
    }
}

TEST_CASE ("all mistakes are reported together, each with its own id", "[plan]")
{
    auto sketch = Sketch {}
                      .node ("a", "signal.gian")
                      .node ("b", "signal.gain", { { "gian", 1.0 }, { "gain", "soft" } })
                      .node ("c", "signal.lfo", { { "shape", "sinus" } })
                      .node ("d", "signal.add", Json::object(), { { "inputs", 0 } })
                      .node ("hand", "device.position")
                      .wire ("b.oot -> c.frequency")
                      .wire ("x.out -> b.in")
                      .wire ("b.in -> b.in")
                      .wire ("hand.position -> b.in")
                      .wire ("b.out.x -> d.in[0]")
                      .wire ("b.out -> d.in")
                      .wire ("b.out -> d.in[9]")
                      .wire ("b.out -> c.shape")
                      .wire ("b.out -> (+) b.in");
    const auto messages = problems (sketch);
    INFO (tactus::test::text (messages));
    for (const auto* id :
         { "node/unknown_type", "port/unknown", "param/unknown", "unit/syntax", "param/unknown_choice", "setting/value", "port/unknown_node", "port/wrong_side",
           "wire/width", "port/not_a_vector", "wire/which_entry", "port/bad_index", "wire/onto_choice", "wire/add_to_input" })
    {
        INFO (id);
        CHECK (has (messages, id));
    }
    for (const auto& m : messages)
    {
        CHECK_FALSE (m.text.empty());
        CHECK_FALSE (m.remedy.empty());
        CHECK_FALSE (m.where.empty());
    }
}

TEST_CASE ("a node of unknown type keeps its place and outputs 0", "[plan]")
{
    auto sketch = Sketch {}
                      .node ("one", "signal.constant", { { "value", 1.0 } })
                      .node ("who", "acme.magic")
                      .node ("sum", "signal.add")
                      .wire ("one.out -> who.in")
                      .wire ("who.out -> sum.in[0]")
                      .wire ("one.out -> sum.in[1]");
    const auto compiled = sketch.compile ({ .records = { "sum.out" } });
    CHECK (has (compiled.messages, "node/unknown_type"));
    REQUIRE (compiled.plan);
    compiled.plan->tick();
    CHECK (*compiled.plan->taps()[0].value == 1.0);
}

TEST_CASE ("the delay of each path from hand to motor is known", "[plan]")
{
    auto sketch = Sketch {}
                      .node ("hand", "device.position")
                      .node ("split", "vector.split")
                      .node ("sum", "signal.add")
                      .node ("late", "signal.delay", Json::object(), { { "ticks", 3 } })
                      .node ("f", "signal.multiply")
                      .node ("k", "signal.constant", { { "value", "1 N/m" } })
                      .node ("motor", "device.force");
    sketch.wire ("hand.position -> split.in")
        .wire ("split.x -> sum.in[0]")
        .wire ("split.x -> late.in")
        .wire ("late.out -> [2] -> sum.in[1]")
        .wire ("sum.out -> f.in[0]")
        .wire ("k.out -> f.in[1]")
        .wire ("f.out -> motor.force.x");
    const auto compiled = sketch.compile();
    INFO (tactus::test::text (compiled.messages));
    REQUIRE (compiled.plan);
    REQUIRE (compiled.plan->delays().size() == 1);
    const auto& d = compiled.plan->delays()[0];
    CHECK (d.source == "hand");
    CHECK (d.sink == "motor");
    CHECK (d.shortest == 0);
    CHECK (d.longest == 5);
    CHECK_FALSE (d.recirculates);
}

TEST_CASE ("the quantity of a generic port does not depend on the order of wires: a hit and a speed cannot be summed", "[plan]")
{
    const auto twice = Sketch {}.node ("knock", "contact.impact").node ("amp", "signal.gain").wire ("knock.hit -> amp.in").wire ("knock.hit -> amp.in");
    CHECK (problems (twice).empty());

    const auto mixed = [] (bool hit_first) {
        auto sketch = Sketch {}.node ("knock", "contact.impact").node ("hand", "device.truth").node ("amp", "signal.gain");
        hit_first ? sketch.wire ("knock.hit -> amp.in").wire ("hand.velocity.x -> amp.in")
                  : sketch.wire ("hand.velocity.x -> amp.in").wire ("knock.hit -> amp.in");
        return problems (sketch);
    };
    for (const bool hit_first : { true, false })
    {
        CHECK (has (mixed (hit_first), "wire/two_into_one"));
        CHECK (has (mixed (hit_first), "wire/quantity"));
    }
}

TEST_CASE ("a force times a ratio is a force, so its components can be summed, but a product of two units is not", "[plan]")
{
    const auto summed = [] (const char* vector, const char* factor, const char* times) {
        auto sketch = Sketch {}.node ("hand", "device.position").node ("drag", "friction.elasto_plastic").node ("touch", "contact.window");
        sketch.node ("unit", "vector.normalize").wire ("hand.position -> unit.in");
        sketch.node ("wall", "deform.plane").node ("felt", "vector.scale").node ("again", "vector.scale").node ("sum", "signal.gain");
        sketch.wire (std::string (vector) + " -> felt.in").wire (std::string (factor) + " -> felt.gain");
        sketch.wire ("felt.out -> again.in").wire (std::string (times) + " -> again.gain");
        for (const char axis : { 'x', 'y', 'z' })
            sketch.wire (std::string ("again.out.") + axis + " -> sum.in");
        return problems (sketch);
    };
    CHECK (summed ("drag.force", "touch.gain", "touch.gain").empty());
    CHECK (summed ("unit.out", "wall.resistance", "touch.gain").empty());
    CHECK (has (summed ("drag.deflection", "touch.gain", "touch.gain"), "wire/two_into_one"));   // a length
    CHECK (has (summed ("drag.force", "wall.resistance", "touch.gain"), "wire/two_into_one"));
}

TEST_CASE ("feeds keep their order in the presence of a placeholder, and its ports are recorded as 0", "[plan]")
{
    auto sketch = Sketch {}.node ("who", "acme.magic").node ("amp", "signal.gain");
    const auto plan = sketch.compile ({ .feeds = { "who.in", "amp.in" }, .records = { "who.out", "amp.out" } }).plan;
    REQUIRE (plan);
    REQUIRE (plan->feeds().size() == 2);
    plan->setFeeds (std::vector { 5.0, 7.0 });
    plan->tick();
    REQUIRE (plan->taps().size() == 2);
    CHECK (plan->taps()[0].name == "who.out");
    CHECK (*plan->taps()[0].value == 0.0);
    CHECK (*plan->taps()[1].value == 7.0);
}

TEST_CASE ("a record keeps the requested name, even for an exposed port", "[plan]")
{
    Sketch sketch;
    auto& inside = sketch.subgraph ("grain");
    sketch.add (inside, "wave", "texture.grating");
    inside.expose.outputs = { { "force", { "wave", "force" } } };
    sketch.node ("grain", "graph:grain").node ("mix", "signal.mix");
    const auto names = [&] (std::vector<std::string> records) {
        std::vector<std::string> all;
        const auto plan = sketch.compile ({ .records = std::move (records) }).plan;
        for (const auto& tap : plan->taps())
            all.push_back (tap.name);
        return all;
    };
    CHECK (names ({ "grain.force", "grain.force" }) == std::vector<std::string> { "grain.force.x", "grain.force.y", "grain.force.z" });
    CHECK (names ({ "grain/wave.force.z", "mix.in" }) == std::vector<std::string> { "grain/wave.force.z", "mix.in[0]", "mix.in[1]" });
    sketch.graph.root.nodes[0].bypass = true;
    CHECK (names ({ "grain.force" }) == std::vector<std::string> { "grain.force.x", "grain.force.y", "grain.force.z" });
}

TEST_CASE ("an unused subgraph is checked too, under its own pointer", "[plan]")
{
    Sketch sketch;
    auto& inside = sketch.subgraph ("grain");
    sketch.add (inside, "wave", "texture.grating", { { "amplitude", "3 m" } }).add (inside, "z.force -> wave.position");
    const auto messages = problems (sketch);
    INFO (tactus::test::text (messages));
    REQUIRE (has (messages, "port/unknown_node"));
    CHECK (has (messages, "param/unit"));
    CHECK (messages[0].where == "/graphs/grain/wires/0");
}

TEST_CASE ("a small file cannot request a billion nodes or all memory", "[plan]")
{
    Sketch sketch;
    for (int depth = 0; depth < 28; ++depth)
    {
        auto& patch = sketch.subgraph ("g" + std::to_string (depth));
        const auto inner = depth == 27 ? std::string ("signal.constant") : "graph:g" + std::to_string (depth + 1);
        sketch.add (patch, "a", inner).add (patch, "b", inner);
    }
    sketch.node ("top", "graph:g0");
    CHECK (has (problems (sketch), "graph/too_large"));

    auto delays = Sketch {}.node ("a", "signal.constant").node ("b", "signal.expression", Json::object(), { { "inputs", 64 } });
    for (int i = 0; i < 64; ++i)
        delays.wire ("a.out -> [1000000] -> b.in[" + std::to_string (i) + "]");
    CHECK (has (problems (delays), "graph/too_large"));
}

TEST_CASE ("a bypassed subgraph keeps the array ports it exposes", "[plan]")
{
    Sketch sketch;
    auto& inside = sketch.subgraph ("mixer");
    sketch.add (inside, "mix", "signal.add", Json::object(), { { "inputs", 3 } });
    inside.expose.inputs = { { "in", { "mix", "in" } } };
    inside.expose.outputs = { { "out", { "mix", "out" } } };
    sketch.node ("one", "signal.constant", { { "value", 1.0 } }).node ("mixer", "graph:mixer").wire ("one.out -> mixer.in[0]").wire ("one.out -> mixer.in[2]");
    CHECK (run (sketch, "mixer.out") == 2.0);
    sketch.graph.root.nodes[1].bypass = true;
    CHECK (run (sketch, "mixer.out") == 2.0);
}

TEST_CASE ("a bypassed product passes on wired entries, but not the default 1 of unwired ones", "[plan]")
{
    auto sketch = Sketch {}.node ("three", "signal.constant", { { "value", 3.0 } }).node ("times", "signal.multiply").wire ("three.out -> times.in[0]");
    sketch.graph.root.nodes[1].bypass = true;
    CHECK (run (sketch, "times.out") == 3.0);
}

TEST_CASE ("ten thousand mistakes quickly give a thousand messages", "[plan]")
{
    Sketch sketch;
    for (int i = 0; i < 10000; ++i)
        sketch.wire ("x" + std::to_string (i) + ".out -> y.in");
    CHECK (problems (sketch).size() == 1000);
}
