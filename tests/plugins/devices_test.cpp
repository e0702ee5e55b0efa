// SPDX-License-Identifier: MIT
// Device nodes in a plugin: they see the reading of each tick, and a device that joins while they tick.
#include "load.hpp"
#include "support/no_allocation.hpp"
#include "support/sketch.hpp"

#include <catch2/catch.hpp>

#include <span>

using namespace tactus;

namespace
{
/// A pad with two axes. Its readings change on each tick.
struct Pad final : Device
{
    void prepare (double) override {}
    Reading read() noexcept override
    {
        ++ticks;
        Reading now { .position = Vec3 (0.001 * ticks, 0.0, 0.0) };
        now.axes = { 0.25 * ticks, -1.0 * ticks };
        return now;
    }
    void write (const Effort& e) noexcept override { applied = e.force; }
    DeviceLayout layout() const override { return { .axes = { "wheel", "trigger" } }; }

    int ticks = 0;
    Vec3 applied = Vec3::Zero();
};

Catalogue types() { return catalogue().with (test::load ("devices").types); }

test::Sketch sketch()
{
    test::Sketch s;
    s.node ("hand", "device.position").node ("trigger", "device.axis", Json::object(), { { "axis", "trigger" } }).node ("motor", "device.force");
    for (auto& node : s.graph.root.nodes)
        node.role = "pad";
    s.wire ("trigger.axis -> motor.force.y");
    return s;
}

CompileOptions options (const Plan* before = nullptr) { return { .rate_hz = 1000.0, .records = { "hand.position" }, .before = before }; }
}   // namespace

TEST_CASE ("a device node in a plugin reads the device of its role on each tick", "[plugins]")
{
    std::vector<double> seen[2];
    const Catalogue both[] { types(), catalogue() };
    for (int which = 0; which < 2; ++which)
    {
        const auto compiled = compile (sketch().graph, both[which], options());
        INFO (test::text (compiled.messages));
        REQUIRE (compiled.plan);
        Engine engine { compiled.plan };
        Pad pad;
        engine.attach ("pad", pad);
        for (int k = 0; k < 10; ++k)
        {
            engine.tick();
            for (const auto& tap : engine.plan().taps())
                seen[which].push_back (*tap.value);
            seen[which].push_back (pad.applied.y());
        }
        CHECK (pad.applied == Vec3 (0.0, -10.0, 0.0));
    }
    CHECK (seen[0] == seen[1]);
    CHECK (seen[0].size() == 40);
    CHECK (seen[0][36] == 0.001 * 10);
}

TEST_CASE ("a device node in a plugin is bound to a device that joins, without allocating in the tick", "[plugins]")
{
    const auto all = types();
    Engine engine { compile (sketch().graph, all, options()).plan };
    for (int k = 0; k < 3; ++k)
        engine.tick();   // no device yet

    Pad pad;
    const Engine::Joining joining { "pad", pad };
    engine.submit (compile (sketch().graph, all, options (&engine.newest())).plan, std::span (&joining, 1));
    {
        const NoAllocation watch;
        engine.tick();
        CHECK (watch.allocations() == 0);
        CHECK (watch.locks() == 0);
    }
    for (int k = 0; k < 100; ++k)
        engine.tick();
    CHECK (pad.applied == Vec3 (0.0, -101.0, 0.0));
}

TEST_CASE ("a device node in a plugin says what the device lacks", "[plugins]")
{
    const auto all = types();
    const DeviceLayout layout { .axes = { "wheel" } };
    std::string said[2];
    for (const auto* type : { all.find ("device.axis"), catalogue().find ("device.axis") })
    {
        const auto node = type->make();
        type->settings[0].set (node.get(), std::string ("trigger"));
        said[type->origin.empty() ? 1 : 0] = type->missing (node.get(), layout);
    }
    CHECK (said[0] == said[1]);
    CHECK (said[0].find ("no axis 'trigger'") != std::string::npos);
}
