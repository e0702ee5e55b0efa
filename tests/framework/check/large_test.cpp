// SPDX-License-Identifier: MIT
#include <tactus/check/hands.hpp>
#include <tactus/check/measure.hpp>
#include <tactus/node/generic.hpp>

#include "support/sketch.hpp"

#include <catch2/catch.hpp>

using namespace tactus;

namespace
{
/// A node without a force that counts the ticks of all copies of its graph.
struct TickCounter
{
    using Inputs = In<Vec3>;
    using Outputs = Out<Vec3>;
    using Params = Empty;

    static constexpr Info info { .id = "test.tick_counter", .name = "Tick counter", .summary = "Counts ticks.", .source = "none" };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", unit::metre, "anything"),
        output (&Outputs::out, "out", unit::newton, "no force"),
    };

    Params params {};

    Outputs tick (const Inputs&) noexcept
    {
        ++ticks;
        return {};
    }

    static inline std::size_t ticks = 0;
};

const Catalogue& catalogueThatCounts()
{
    static const Catalogue all = [] {
        std::vector<NodeType> types (catalogue().begin(), catalogue().end());
        types.push_back (describe<TickCounter>());
        return Catalogue { std::move (types) };
    }();
    return all;
}

/// So many planes and gratings on one hand. Each grating has its own period and amplitude, and some are not reached.
graph::Graph board (int pairs)
{
    test::Sketch s;
    s.node ("hand", "device.position").node ("motor", "device.force");
    for (auto& node : s.graph.root.nodes)
        node.role = "tip";
    s.node ("counter", "test.tick_counter").wire ("hand.position -> counter.in").wire ("counter.out -> motor.force");
    for (int i = 0; i < pairs; ++i)
    {
        const auto plane = "plane" + std::to_string (i), grating = "grating" + std::to_string (i);
        s.node (plane, "deform.plane", { { "stiffness", 2.0 }, { "offset", -1e-5 * i } });
        s.node (grating, "texture.grating", { { "amplitude", i % 7 == 3 ? 0.0 : 0.001 * (1 + i % 5) }, { "spatial_frequency", 100.0 + 10.0 * i } });
        for (const auto& node : { plane, grating })
            s.wire ("hand.position -> " + node + ".position").wire (node + ".force -> motor.force");
    }
    s.graph.rate_hz = 1000.0;
    s.graph.devices.emplace_back ("tip", Json { { "driver", "gesture" }, { "path", "circle" } });
    return s.graph;
}

struct Counted
{
    check::Demand demand;
    std::size_t ticks;
};

Counted measured (int pairs, std::size_t ticks)
{
    const auto graph = board (pairs);
    const check::Subject subject { graph, catalogueThatCounts() };
    const auto motion = check::recordMotion (subject, {}, ".", 1.0).motion;
    REQUIRE (motion.ticks > 0);
    TickCounter::ticks = 0;
    auto demand = check::measure (subject, motion, { .ticks = ticks });
    return { std::move (demand), TickCounter::ticks };
}
}   // namespace

TEST_CASE ("a check takes about as many ticks as it may, however many textures a graph has", "[check]")
{
    constexpr std::size_t may = 80'000;
    for (const int pairs : { 20, 60, 120 })
    {
        const auto ticks = measured (pairs, may).ticks;
        INFO (pairs << " textures: " << ticks << " ticks");
        CHECK (ticks < may + may / 4);
    }
    const auto all = measured (60, std::numeric_limits<std::size_t>::max()).ticks;
    CHECK (all > 3 * may);
}

TEST_CASE ("the steepest textures of a large graph are measured, and the others count with their own force", "[check]")
{
    const auto some = measured (60, 80'000).demand, all = measured (60, std::numeric_limits<std::size_t>::max()).demand;
    REQUIRE (some.textures.size() == all.textures.size());
    REQUIRE (some.unreached.size() == all.unreached.size());
    CHECK (! all.unreached.empty());
    for (std::size_t t = 0; t < all.textures.size(); ++t)
    {
        const auto &a = some.textures[t], &b = all.textures[t];
        INFO (some.nodes[a.node].path);
        CHECK (a.node == b.node);
        CHECK (a.role == b.role);
        CHECK (a.spatial_frequency == b.spatial_frequency);
        CHECK (a.amplitude == Approx (b.amplitude).epsilon (1e-9));   // each is wired directly to the motor
        CHECK (a.slope == Approx (b.slope).epsilon (1e-9));
        CHECK (a.speed == Approx (b.speed).epsilon (1e-9));
    }
    for (std::size_t u = 0; u < all.unreached.size(); ++u)
        CHECK (some.unreached[u].node == all.unreached[u].node);
    REQUIRE_FALSE (some.roles[0].slopes.empty());
    CHECK (some.roles[0].slopes.size() < all.roles[0].slopes.size());
}
