// SPDX-License-Identifier: MIT
// Small graphs that ask for much. Each is refused before the work is done.

#include "support/sketch.hpp"
#include "support/with_limits.hpp"

#include <catch2/catch.hpp>

using namespace tactus;
using Catch::Matchers::Contains;
using tactus::test::has;
using tactus::test::Sketch;

namespace
{
/// Each subgraph contains the next one twice.
Sketch nested (int levels)
{
    Sketch sketch;
    for (int i = 0; i < levels; ++i)
    {
        const auto inner = i + 1 == levels ? std::string ("signal.add") : "graph:g" + std::to_string (i + 1);
        auto& patch = sketch.subgraph ("g" + std::to_string (i));
        sketch.add (patch, "a", inner);
        if (i + 1 < levels) patch.nodes.back().extra["count"] = 2;
    }
    return sketch;
}

/// The refusal for exceeding a budget; empty if there is none.
std::string refusal (const Sketch& sketch)
{
    const auto messages = sketch.compile().messages;
    INFO (tactus::test::text (messages));
    const auto found = std::ranges::find (messages, "graph/too_large", &Message::id);
    return found == messages.end() ? "" : found->text + "; " + found->remedy;
}

Json modes (int count)
{
    auto all = Json::array();
    for (int i = 0; i < count; ++i)
        all.push_back ({ { "frequency", 100.0 + i }, { "decay", 10.0 }, { "amplitude", 1.0 } });
    return all;
}
}   // namespace

TEST_CASE ("budgets: 64 levels of count 2 are refused, used or not", "[plan][budget]")
{
    auto used = nested (64);
    used.node ("top", "graph:g0");
    CHECK_THAT (refusal (used), Contains ("--limits"));
    CHECK_THAT (refusal (nested (64)), Contains ("--limits"));
}

TEST_CASE ("budgets: thousands of wires to unknown ports give a limited list of problems", "[plan][budget]")
{
    Sketch sketch;
    sketch.node ("a", "signal.gain");
    for (int i = 0; i < 10'000; ++i)
        sketch.wire ("a.out -> a.port" + std::to_string (i));
    const auto compiled = sketch.compile();
    CHECK (compiled.plan == nullptr);
    CHECK (compiled.messages.size() <= most_messages + 10);   // later stages may add a few
    CHECK (has (compiled.messages, "port/unknown"));
}

TEST_CASE ("budgets: unused subgraphs count together with the graph", "[plan][budget]")
{
    const WithLimits limits ("nodes=100");
    CHECK (refusal (nested (5)).empty());
    Sketch many;
    for (int i = 0; i < 60; ++i)
        many.add (many.subgraph ("g" + std::to_string (i)), "a", "signal.add");
    CHECK_THAT (refusal (many), Contains ("`nodes` allows 100"));
}

TEST_CASE ("budgets: a table of many modes and samples is refused before it is computed", "[plan][budget]")
{
    const auto table = [] (int count, int length) {
        return Sketch {}.node ("ring", "vibration.wavetable", Json::object(), { { "table", { { "modes", modes (count) }, { "length", length } } } });
    };
    CHECK (refusal (table (20, 4000)).empty());
    CHECK_THAT (refusal (table (10'000, 1'000'000)), Contains ("`time`") && Contains ("--limits time="));
}

TEST_CASE ("budgets: delays in nodes take memory together", "[plan][budget]")
{
    Sketch sketch;
    for (int i = 0; i < 100; ++i)
        sketch.node ("n" + std::to_string (i), "signal.delay", Json::object(), { { "ticks", 1'000'000 } });
    CHECK_THAT (refusal (sketch), Contains ("`memory`"));
}

TEST_CASE ("budgets: settings count for each instance that reads them", "[plan][budget]")
{
    const WithLimits limits ("time=0.005s");
    const auto instances = [] (int count) {
        Sketch sketch;
        sketch.add (sketch.subgraph ("bar"), "ring", "vibration.modal", Json::object(), { { "modes", modes (50) } });
        sketch.node ("bars", "graph:bar");
        sketch.graph.root.nodes.back().extra["count"] = count;
        return sketch;
    };
    CHECK (refusal (instances (10)).empty());
    CHECK_THAT (refusal (instances (1000)), Contains ("`time`"));
}

TEST_CASE ("budgets: a texture with a thousand models at a thousand speeds and forces is refused", "[plan][budget]")
{
    const auto noise = [] (int count) {
        auto models = Json::array();
        for (int i = 0; i < count; ++i)
            models.push_back ({ { "speed", 0.001 * i }, { "force", 0.001 * i }, { "rate", 1000.0 }, { "coefficients", { 0.1 } }, { "variance", 1e-3 } });
        return Sketch {}.node ("noise", "texture.noise", Json::object(), { { "models", models } });
    };
    CHECK (refusal (noise (50)).empty());
    CHECK_THAT (refusal (noise (1000)), Contains ("`time`"));
}

TEST_CASE ("budgets: a graph has a limited number of roles", "[plan][budget]")
{
    const WithLimits limits ("roles=3");
    Sketch sketch;
    for (int i = 0; i < 4; ++i)
    {
        sketch.node ("n" + std::to_string (i), "device.position");
        sketch.graph.root.nodes.back().role = "r" + std::to_string (std::min (i, 2));
    }
    CHECK (refusal (sketch).empty());
    sketch.graph.root.nodes.back().role = "r3";
    CHECK_THAT (refusal (sketch), Contains ("`roles` allows 3"));
}
