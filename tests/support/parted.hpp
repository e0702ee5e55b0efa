// SPDX-License-Identifier: MIT
#pragma once

#include "sketch.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tactus::test
{

/// A graph with a subgraph "part", filled by the test, and a node "sec" that runs it at its own rate.
struct Parted : Sketch
{
    explicit Parted (Json rate,
                     const Json& shows = { { "in", "amp.in" } },
                     const Json& gives = { { "out", "amp.out" } },
                     const Json& params = Json::object())
    {
        subgraph ("part");
        use ("sec", "part", std::move (rate));
        expose ("part", shows, gives, params);
    }

    graph::Patch& part() { return subgraph ("part"); }

    Parted& use (const std::string& name, const std::string& patch, Json rate)
    {
        node (name, "graph:" + patch);
        graph.root.nodes.back().extra = std::move (rate);
        return *this;
    }

    void expose (const std::string& patch, const Json& inputs, const Json& outputs, const Json& params = Json::object())
    {
        const auto list = [] (const Json& names) {
            std::vector<std::pair<std::string, graph::Endpoint>> all;
            for (const auto& [name, end] : names.items())
                all.emplace_back (name, *graph::parseEndpoint (end.get<std::string>()));
            return all;
        };
        subgraph (patch).expose = { list (inputs), list (outputs), list (params) };
    }
};

/// A plan with feeds and records, ticked row by row.
struct PlanRun
{
    PlanRun (const Sketch& sketch, std::vector<std::string> feeds, std::vector<std::string> records, double rate_hz = 0.0)
    {
        auto compiled = sketch.compile ({ .rate_hz = rate_hz, .feeds = std::move (feeds), .records = std::move (records) });
        INFO (text (compiled.messages));
        REQUIRE (compiled.plan);
        plan = compiled.plan;
        messages = compiled.messages;
    }

    const Tap& tick (std::vector<double> fed = {}, std::size_t tap = 0)
    {
        std::ranges::copy (fed, plan->feeds().begin());
        plan->tick();
        return plan->taps().at (tap);
    }

    std::shared_ptr<Plan> plan;
    Messages messages;
};

inline Json every (int k, const char* hold = nullptr)
{
    Json rate { { "every", k } };
    if (hold) rate["hold"] = hold;
    return rate;
}

inline Json times (int m) { return { { "times", m } }; }

/// A section that doubles its input and passes it to an outer node.
inline Parted doubling (Json rate)
{
    Parted sketch { std::move (rate) };
    sketch.add (sketch.part(), "amp", "signal.gain", { { "gain", 2.0 } });
    sketch.node ("after", "signal.gain").wire ("sec.out -> after.in");
    return sketch;
}

/// A path from a hand to a motor through a section. The two wires are "split.x -> late.in" inside and "sec.out -> motor.force.x"
/// outside, or variants of them.
inline Parted fromHandToMotor (Json rate, const std::string& inside, const std::string& outside)
{
    Parted sketch { std::move (rate), { { "in", "split.in" } }, { { "out", "out.out" } } };
    auto& part = sketch.part();
    sketch.add (part, "split", "vector.split").add (part, "late", "signal.gain").add (part, "out", "signal.multiply");
    sketch.add (part, "k", "signal.constant", { { "value", "1 N/m" } });
    sketch.add (part, inside).add (part, "late.out -> out.in[0]").add (part, "k.out -> out.in[1]");
    sketch.node ("hand", "device.position").node ("motor", "device.force").wire ("hand.position -> sec.in").wire (outside);
    return sketch;
}

}   // namespace tactus::test
