// SPDX-License-Identifier: MIT
// Instances of a subgraph under edits: which continue, and which start from scratch.

#include "support/chance_hand.hpp"
#include "support/sketch.hpp"

#include "support/live.hpp"
#include <tactus/graph/param_edit.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using graph::SetNodeKey;
using test::Sketch;

namespace
{
/// Instances that count their ticks through a delay inside, and receive their input four ticks late.
Sketch counters (int count)
{
    Sketch s;
    auto& part = s.subgraph ("part");
    s.add (part, "count", "signal.add").add (part, "one", "signal.constant", { { "value", 1.0 } }).add (part, "heard", "signal.gain");
    s.add (part, "one.out -> count.in[0]").add (part, "count.out -> [1] -> count.in[1]");
    part.expose = { { { "in", { "heard", "in" } } }, { { "out", { "count", "out" } }, { "heard", { "heard", "out" } } }, { { "step", { "one", "value" } } } };
    s.node ("clock", "graph:part").node ("finger", "graph:part").wire ("clock.out -> [4] -> finger.in");
    if (count > 0) s.graph.root.nodes.back().extra["count"] = count;
    return s;
}

struct Bench
{
    explicit Bench (const Sketch& s) : live (s.graph, catalogue(), {}, s.compile().plan) {}

    void edit (graph::Command command)
    {
        const auto messages = live.perform (std::move (command));
        INFO (test::text (messages));
        REQUIRE_FALSE (hasErrors (messages));
    }

    void count (std::optional<Json> n) { edit (SetNodeKey { "", "finger", "count", std::move (n) }); }

    void tick (int n = 1)
    {
        for (int k = 0; k < n; ++k)
            live.engine().tick();
    }

    /// The current value of an output of a node.
    double at (const std::string& path, const std::string& port)
    {
        const auto& plan = live.engine().plan();
        const auto node = std::ranges::find (plan.flat().nodes, path, &plan::FlatNode::path);
        REQUIRE (node != plan.flat().nodes.end());
        const auto& instance = plan.instances()[static_cast<std::size_t> (node - plan.flat().nodes.begin())];
        const auto record = std::ranges::find (plan.records(), instance.node.get(), &Record::self);
        REQUIRE (record != plan.records().end());
        const auto row = std::ranges::find (node->type->outputs, port, &PortSheet::id);
        return *reinterpret_cast<const double*> (static_cast<const std::byte*> (record->outputs) + row->offset);
    }

    double counted (const std::string& part) { return at (part + "/count", "out"); }
    double heard (const std::string& part) { return at (part + "/heard", "out"); }

    double param (const std::string& name)
    {
        const auto ref = *live.engine().param (name);
        return ref.knobs->all[ref.index].value;
    }

    test::Live live;
};
}   // namespace

TEST_CASE ("when the count changes, the remaining instances continue, including the values in transit to them", "[live][instances]")
{
    Bench bench { counters (2) };
    bench.tick (10);
    CHECK (bench.counted ("finger[1]") == 10.0);
    CHECK (bench.heard ("finger[1]") == 6.0);

    bench.count (4);
    bench.tick();
    for (const auto* old : { "finger[0]", "finger[1]" })
    {
        CHECK (bench.counted (old) == 11.0);
        CHECK (bench.heard (old) == 7.0);
    }
    CHECK (bench.counted ("finger[3]") == 1.0);
    CHECK (bench.heard ("finger[3]") == 0.0);

    bench.count (1);
    bench.tick();
    CHECK (bench.counted ("finger[0]") == 12.0);
    CHECK (bench.heard ("finger[0]") == 8.0);
    bench.count (std::nullopt);
    bench.tick();
    CHECK (bench.counted ("finger") == 13.0);
    CHECK (bench.heard ("finger") == 9.0);
    bench.count (3);
    bench.tick();
    CHECK (bench.counted ("finger[0]") == 14.0);
    CHECK (bench.heard ("finger[0]") == 10.0);
    CHECK (bench.counted ("finger[2]") == 1.0);
    bench.live.undo();
    bench.tick();
    CHECK (bench.counted ("finger") == 15.0);
}

TEST_CASE ("instances continue when they are expanded to nodes, collapsed again, or moved", "[live][instances]")
{
    Bench bench { counters (3) };
    bench.count (1);
    bench.tick (5);
    bench.count (3);
    bench.tick (5);   // so that the instances differ
    const auto check = [&] (const std::string& first, const std::string& last, double ticks) {
        bench.tick();
        CHECK (bench.counted (first) == ticks);
        CHECK (bench.heard (first) == ticks - 4.0);
        CHECK (bench.counted (last) == ticks - 5.0);
        CHECK (bench.heard (last) == (ticks - 5.0 < 5.0 ? 0.0 : ticks - 4.0));
    };
    check ("finger[0]", "finger[2]", 11.0);
    bench.edit (graph::CollapseNodes { "", { "finger" }, "hand", "hand" });
    check ("hand/finger[0]", "hand/finger[2]", 12.0);
    bench.edit (graph::RenameNode { "hand", "finger", "digit" });
    check ("hand/digit[0]", "hand/digit[2]", 13.0);
    bench.edit (graph::CollapseNodes { "part", { "count", "one" }, "inner", "inner" });
    bench.tick();
    CHECK (bench.counted ("hand/digit[2]/inner") == 9.0);
    bench.live.undo();
    check ("hand/digit[0]", "hand/digit[2]", 15.0);
    bench.edit (graph::ExpandNode { "", "hand" });
    check ("digit[0]", "digit[2]", 16.0);
    bench.edit (graph::ExpandNode { "", "digit" });
    check ("digit_0", "digit_2", 17.0);
    bench.edit (graph::ExpandNode { "", "digit_2" });
    bench.tick();
    CHECK (bench.at ("count", "out") == 13.0);
    CHECK (bench.counted ("digit_0") == 18.0);
    bench.live.undo();
    check ("digit_0", "digit_2", 19.0);
    bench.live.undo();
    check ("digit[0]", "digit[2]", 20.0);
    bench.live.undo();
    check ("hand/digit[0]", "hand/digit[2]", 21.0);
}

TEST_CASE ("a parameter is turned in all instances or in one, by any of its names", "[live][instances][turn]")
{
    Bench bench { counters (3) };
    bench.tick();
    const auto turn = [&] (const std::string& name, double value, std::vector<double> expected) {
        INFO (name);
        CHECK (bench.live.set (name, value));
        bench.tick (200);
        for (std::size_t k = 0; k < 3; ++k)
            CHECK (bench.param ("finger[" + std::to_string (k) + "]/one.value") == expected[k]);
    };
    turn ("finger.step", 2.0, { 2.0, 2.0, 2.0 });
    turn ("finger[1].step", 3.0, { 2.0, 3.0, 2.0 });
    turn ("finger[2]/one.value", 4.0, { 2.0, 3.0, 4.0 });
    turn ("finger[*]/one.value", 5.0, { 5.0, 5.0, 5.0 });
    turn ("finger/one.value", 6.0, { 6.0, 6.0, 6.0 });
    turn ("finger[*].step", 7.0, { 7.0, 7.0, 7.0 });
    CHECK (bench.param ("clock.step") == 1.0);
    for (const auto* wrong : { "finger[3].step", "finger[3]/one.value", "clock[0].step" })
    {
        const auto turned = bench.live.set (wrong, 1.0);
        REQUIRE_FALSE (turned);
        CHECK (turned.error().id == "port/unknown_node");
    }
}

TEST_CASE ("storing a turned value with an edit changes only its own instance", "[live][instances]")
{
    Bench bench { counters (3) };
    bench.tick();
    bench.edit (*graph::paramEdit (bench.live.graph(), "finger[1]/one.value", 0.5));
    bench.tick (200);
    CHECK (bench.param ("finger[0].step") == 1.0);
    CHECK (bench.param ("finger[1].step") == 0.5);
    bench.edit (*graph::paramEdit (bench.live.graph(), "finger.step", 2.0));
    bench.tick (200);
    CHECK (bench.param ("finger[0].step") == 2.0);
    CHECK (bench.param ("finger[1].step") == 0.5);
    bench.live.undo();
    bench.live.undo();
    bench.tick (200);
    CHECK (bench.param ("finger[1].step") == 1.0);
}

TEST_CASE ("adding and removing fingers of one hand does not affect the other hand", "[live][instances]")
{
    Sketch s;
    auto& finger = s.subgraph ("finger");
    s.add (finger, "at", "device.position")
        .add (finger, "wall", "deform.plane")
        .add (finger, "drag", "friction.elasto_plastic")
        .add (finger, "motor", "device.force");
    s.add (finger, "at.position -> wall.position")
        .add (finger, "at.position -> drag.position")
        .add (finger, "wall.resistance -> drag.normal_force")
        .add (finger, "wall.force -> [3] -> motor.force")
        .add (finger, "drag.force -> motor.force");
    for (const std::string hand : { "left", "right" })
    {
        s.node (hand, "graph:finger");
        s.graph.root.nodes.back().extra["count"] = 3;
        s.graph.root.nodes.back().roles = { { "stylus", hand } };
        s.graph.root.nodes.back().overrides = { { "[1]/drag.mu", 0.9 }, { "[2]/wall.offset", "0.5 mm" } };
    }
    constexpr std::size_t ticks = 2000;
    const auto felt = [&] (bool edited) {
        Bench bench { s };
        test::ChanceHand left { 1, ticks }, right { 2, ticks };
        bench.live.engine().attach ("left", left);
        bench.live.engine().attach ("right", right);
        for (std::size_t k = 0; k < ticks; ++k)
        {
            if (edited && k % 10 == 9) bench.edit (SetNodeKey { "", "right", "count", Json (3 + static_cast<int> (k / 10) % 4) });
            bench.tick();
        }
        return std::pair { left.efforts, right.efforts };
    };
    const auto [left, right] = felt (true);
    const auto [quiet_left, quiet_right] = felt (false);
    std::size_t left_differs = 0, right_differs = 0;
    for (std::size_t k = 0; k < ticks; ++k)
    {
        left_differs += ! test::operator== (left[k], quiet_left[k]);
        right_differs += ! test::operator== (right[k], quiet_right[k]);
    }
    CHECK (left_differs == 0);
    CHECK (right_differs > ticks / 2);
}
