// SPDX-License-Identifier: MIT
// Turning parameters while a graph runs.

#include "support/no_allocation.hpp"
#include "support/sketch.hpp"

#include "support/live.hpp"

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <thread>

using namespace tactus;
using test::Sketch;

namespace
{
constexpr int ramp = 80;   // ticks in 20 ms at 4 kHz

Sketch amplified()
{
    return Sketch {}.node ("one", "signal.constant", { { "value", 1.0 } }).node ("amp", "signal.gain", { { "gain", 1.0 } }).wire ("one.out -> amp.in");
}

struct Bench
{
    explicit Bench (const Sketch& s, std::vector<std::string> records = { "amp.out" })
        : live (s.graph, catalogue(), { .records = records }, s.compile ({ .records = records }).plan)
    {
    }

    double tick (int n = 1)
    {
        for (int k = 0; k < n; ++k)
            live.engine().tick();
        return *live.engine().plan().taps()[0].value;
    }

    void set (const std::string& name, const Json& value)
    {
        const auto turned = live.set (name, value);
        INFO ((turned ? "" : turned.error().text));
        REQUIRE (turned);
    }

    void edit (graph::Command c)
    {
        const auto messages = live.perform (std::move (c));
        INFO (test::text (messages));
        REQUIRE_FALSE (hasErrors (messages));
    }

    test::Live live;
};

std::string refusal (const Result<>& result) { return result ? "" : result.error().id; }
}   // namespace

TEST_CASE ("a ceiling that is set or taken away lets through no less than before and after, and no step", "[live]")
{
    const auto sketch = Sketch {}.node ("one", "signal.constant", { { "value", 2.5 } }).node ("amp", "layer.mix", { { "ceiling", 0.5 } });
    Bench bench (Sketch { sketch }.wire ("one.out -> amp.in[0]"));
    double before = bench.tick (10);
    REQUIRE (before == 0.5);
    for (const double ceiling : { 0.0, 0.5, 0.25, 0.0 })
    {
        const double after = ceiling == 0.0 ? 2.5 : ceiling, low = std::min (before, after), most = 1.01 * std::abs (after - before) / (ramp / 2);
        bench.set ("amp.ceiling", ceiling);
        for (int k = 0; k < ramp + 10; ++k)
        {
            const double now = bench.tick();
            CHECK (now >= low - 1e-12);
            CHECK (std::abs (now - before) <= most);
            before = now;
        }
        CHECK (before == after);
    }
}

TEST_CASE ("a parameter ramps to its target in a straight line of 20 ms, and jumps there before the first tick", "[live]")
{
    Bench bench { amplified() };
    bench.set ("amp.gain", 3.0);
    CHECK (bench.tick() == 3.0);
    bench.set ("amp.gain", 7.0);
    for (int k = 1; k <= ramp; ++k)
        CHECK (bench.tick() == Approx (3.0 + 4.0 * k / ramp));
    CHECK (bench.tick (100) == 7.0);
}

TEST_CASE ("a new target during a ramp starts a ramp from the current value", "[live]")
{
    Bench bench { amplified() };
    bench.tick();
    bench.set ("amp.gain", 2.0);
    CHECK (bench.tick (ramp / 2) == Approx (1.5));
    bench.set ("amp.gain", 0.0);
    CHECK (bench.tick (ramp / 2) == Approx (0.75));
    CHECK (bench.tick (ramp / 2) == 0.0);
}

TEST_CASE ("no matter how it is turned, a parameter never steps by more than one tick of a 20 ms ramp", "[live][property]")
{
    test::property ("targets from 0 to 1 at any ticks, between edits of another node", [] {
        Bench bench { amplified().node ("other", "signal.abs") };
        bench.tick();
        double last = 1.0, target = 1.0;
        for (int i = 0; i < 20; ++i)
        {
            if (*rc::gen::arbitrary<bool>())
            {
                target = *rc::gen::inRange (0, 1001) / 1000.0;
                bench.set ("amp.gain", target);
            }
            if (*rc::gen::inRange (0, 3) == 0) bench.edit (graph::SetNodeKey { "", "other", "note", Json (i) });
            for (int k = *rc::gen::inRange (0, 40); k > 0; --k)
            {
                const double value = bench.tick();
                RC_ASSERT (std::abs (value - last) <= 1.0 / ramp + 1e-12);
                last = value;
            }
        }
        RC_ASSERT (bench.tick (ramp) == target);
    });
}

TEST_CASE ("the stored value of a wired parameter ramps beneath the wire", "[live]")
{
    SECTION ("with (+) it has an effect immediately")
    {
        Bench bench { amplified().node ("add", "signal.constant", { { "value", 10.0 } }).wire ("add.out -> (+) amp.gain") };
        CHECK (bench.tick() == 11.0);
        bench.set ("amp.gain", 2.0);
        CHECK (bench.tick (ramp / 2) == Approx (11.5));
        CHECK (bench.tick (ramp / 2) == 12.0);
    }
    SECTION ("if the wire replaces it, it takes effect when the wire is removed, starting from the value of the wire")
    {
        Bench bench { amplified().node ("by", "signal.constant", { { "value", 10.0 } }).wire ("by.out -> amp.gain") };
        bench.set ("amp.gain", 2.0);
        CHECK (bench.tick (5) == 10.0);
        bench.edit (graph::RemoveWire { "", bench.live.graph().root.wires[1].id });
        CHECK (bench.tick (ramp / 2) == Approx (6.0));
        CHECK (bench.tick (ramp / 2) == 2.0);
    }
}

TEST_CASE ("a ramp continues through takeovers, and a value set live is kept", "[live]")
{
    Bench bench { amplified() };
    bench.tick();
    bench.set ("amp.gain", 5.0);
    bench.tick (ramp / 4);
    bench.edit (graph::RenameNode { "", "one", "uno" });
    CHECK (bench.tick (ramp / 4) == Approx (3.0));
    bench.edit (graph::SetParam { "", "uno", "value", Json (1.0) });
    CHECK (bench.tick (ramp / 2) == 5.0);
    bench.edit (graph::AddNode { "", Sketch::makeNode ("idle", "signal.abs") });
    CHECK (bench.tick (3) == 5.0);
}

TEST_CASE ("a value changed in the file is reached by a ramp too", "[live]")
{
    Bench bench { amplified() };
    bench.tick();
    bench.edit (graph::SetParam { "", "amp", "gain", Json (3.0) });
    CHECK (bench.tick (ramp / 2) == Approx (2.0));
    CHECK (bench.tick (ramp / 2) == 3.0);
}

TEST_CASE ("if an edit and a turn change one parameter between two ticks, the later one takes precedence", "[live]")
{
    Bench bench { amplified() };
    bench.tick();
    SECTION ("the turn")
    {
        bench.edit (graph::SetParam { "", "amp", "gain", 5.0 });
        bench.set ("amp.gain", 2.0);
        CHECK (bench.tick (ramp) == 2.0);
    }
    SECTION ("the edit")
    {
        bench.set ("amp.gain", 2.0);
        bench.edit (graph::SetParam { "", "amp", "gain", 5.0 });
        CHECK (bench.tick (ramp) == 5.0);
    }
    SECTION ("the turn, followed by an edit of something else")
    {
        bench.edit (graph::SetParam { "", "amp", "gain", 5.0 });
        bench.set ("amp.gain", 2.0);
        bench.edit (graph::SetParam { "", "one", "value", 3.0 });
        CHECK (bench.tick (ramp) == 6.0);
    }
}

TEST_CASE ("a turned parameter of a node that has never ticked keeps its value and its handle through any number of edits", "[live]")
{
    Bench bench { amplified() };
    bench.tick();
    bench.edit (graph::AddNode { "", Sketch::makeNode ("new", "signal.gain", { { "gain", 2.0 } }) });
    const auto gain = *bench.live.engine().param ("new.gain");
    bench.live.engine().set (gain, 7.0);
    bench.edit (graph::SetNodeKey { "", "one", "note", Json ("moved") });
    bench.edit (graph::AddWire { "", *graph::parseWire ("one.out -> new.in") });
    CHECK (bench.live.engine().param ("new.gain")->knobs == gain.knobs);
    const auto out = [&] {
        const auto& plan = bench.live.engine().plan();
        const auto node = std::ranges::find (plan.flat().nodes, "new", &plan::FlatNode::path);
        return *plan.instances()[static_cast<std::size_t> (node - plan.flat().nodes.begin())].param (0);
    };
    bench.tick();
    CHECK (out() == 7.0);
    bench.live.engine().set (gain, 3.0);
    bench.tick (ramp);
    CHECK (out() == 3.0);

    bench.edit (graph::AddNode { "", Sketch::makeNode ("late", "signal.gain", { { "gain", 2.0 } }) });
    bench.set ("late.gain", 7.0);
    bench.edit (graph::SetParam { "", "late", "gain", 4.0 });   // an edit after the turn takes precedence
    bench.tick();
    const auto late = *bench.live.engine().param ("late.gain");
    CHECK (late.knobs->all[late.index].value == 4.0);
}

TEST_CASE ("a node whose settings change keeps its turned values", "[live]")
{
    auto sketch =
        Sketch {}.node ("one", "signal.constant", { { "value", 1.0 } }).node ("mix", "signal.mix").wire ("one.out -> mix.in[0]").wire ("one.out -> mix.in[1]");
    Bench bench { sketch, { "mix.out" } };
    const double before = bench.tick();
    bench.set ("mix.gain[1]", 3.0);
    bench.tick (ramp);
    const double turned = bench.tick();
    CHECK (turned == before + 2.0);
    bench.edit (graph::SetSetting { "", "mix", "inputs", Json (3) });
    CHECK (bench.tick (3) == turned);
    bench.set ("mix.gain[2]", 0.5);
    CHECK (refusal (bench.live.set ("mix.gain[3]", 0.5)) == "param/shape");
}

TEST_CASE ("each parameter has its own ramp, under any of its names", "[live]")
{
    Sketch sketch;
    auto& inside = sketch.subgraph ("twice");
    sketch.add (inside, "amp", "signal.gain", { { "gain", 2.0 } });
    inside.expose.inputs = { { "x", { "amp", "in" } } };
    inside.expose.outputs = { { "y", { "amp", "out" } } };
    inside.expose.params = { { "factor", { "amp", "gain" } } };
    sketch.node ("one", "signal.constant", { { "value", 1.0 } })
        .node ("a", "graph:twice")
        .node ("b", "graph:twice")
        .wire ("one.out -> a.x")
        .wire ("one.out -> b.x");
    Bench bench { sketch, { "a.y", "b.y" } };
    bench.tick();
    bench.set ("a.factor", 4.0);
    bench.set ("b/amp.gain", 6.0);
    CHECK (bench.tick (ramp / 2) == Approx (3.0));
    CHECK (*bench.live.engine().plan().taps()[1].value == Approx (4.0));
}

TEST_CASE ("a choice applies immediately, by its name", "[live]")
{
    auto sketch = Sketch {}.node ("wave", "signal.lfo", { { "shape", "square" }, { "frequency", "1 Hz" } });
    Bench bench { sketch, { "wave.out" } };
    bench.tick (10);
    const auto square = bench.tick();
    bench.set ("wave.shape", "sine");
    CHECK (bench.tick() != square);
}

TEST_CASE ("a value that cannot be set is refused with a reason", "[live]")
{
    auto sketch = Sketch {}.node ("drag", "friction.elasto_plastic").node ("wall", "deform.plane").node ("wave", "signal.lfo");
    Bench bench { sketch, { "drag.force.x" } };
    CHECK (refusal (bench.live.set ("drag.mu", "0.4")) == "");
    CHECK (refusal (bench.live.set ("drag.d_max", "0.4 mm")) == "");
    CHECK (refusal (bench.live.set ("wall.normal", Json::array ({ 0, 1, 0 }))) == "");
    CHECK (refusal (bench.live.set ("drag.d_max", "0.4 N")) == "param/unit");
    CHECK (refusal (bench.live.set ("drag.d_max", "much")) == "param/value");
    CHECK (refusal (bench.live.set ("drag.mu", -1.0)) == "param/out_of_range");
    CHECK (refusal (bench.live.set ("drag.mi", 1.0)) == "param/unknown");
    CHECK (refusal (bench.live.set ("darg.mu", 1.0)) == "port/unknown_node");
    CHECK (refusal (bench.live.set ("wall.normal", 1.0)) == "param/shape");
    CHECK (refusal (bench.live.set ("drag.mu.x", 1.0)) == "param/shape");
    CHECK (refusal (bench.live.set ("wave.shape", "sinus")) == "param/unknown_choice");
    CHECK (refusal (bench.live.set ("mu", 1.0)) == "param/name");
}

TEST_CASE ("turning causes no allocation and no lock in the tick", "[live]")
{
    Bench bench { amplified() };
    bench.tick();
    const auto gain = *bench.live.engine().param ("amp.gain");
    const NoAllocation watch;
    for (int k = 0; k < 500; ++k)
    {
        if (k % 7 == 0) bench.live.engine().set (gain, 0.01 * k);
        bench.live.engine().tick();
    }
    CHECK (watch.allocations() == 0);
    CHECK (watch.locks() == 0);
}

TEST_CASE ("a parameter set from another thread ends at the last value, and values that are not finite are ignored", "[live]")
{
    Bench bench { amplified() };
    bench.tick();
    const auto gain = *bench.live.engine().param ("amp.gain");
    std::thread turner { [&] {
        for (int i = 0; i <= 20000; ++i)
            bench.live.engine().set (gain, 1e-3 * i);
        bench.live.engine().set (gain, std::nan (""));
    } };
    double last = 1.0;
    bool rises = true;
    for (int k = 0; k < 2000; ++k)
    {
        const double value = bench.tick();
        rises = rises && value - last < 1.0;
        last = value;
    }
    turner.join();
    CHECK (rises);
    CHECK (bench.tick (ramp + 1) == 20.0);
}
