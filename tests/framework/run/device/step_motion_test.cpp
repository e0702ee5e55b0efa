// SPDX-License-Identifier: MIT
// A device in C++ in a loop with long steps. tests/python/steps_test.py has the rules, and the same loop through the C API.
#include <tactus/file/graph_file.hpp>
#include <tactus/kit/state_archive.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/run/device/step_motion.hpp>
#include <tactus/run/stepper.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

using namespace tactus;

namespace
{
struct OwnTool final : Device
{
    explicit OwnTool (StepMotion::Readings r) : motion (r, StepMotion::Efforts::last) {}
    void prepare (double) override {}
    Reading read() noexcept override { return motion.move ({ .position = place }, std::exchange (is_new, false)); }
    void write (const Effort& effort) noexcept override { motion.take (effort); }
    void withhold() noexcept override { motion.withhold(); }
    bool serialize (StateArchive& archive) override
    {
        archive (is_new, place, motion);
        return true;
    }

    StepMotion motion;
    Vec3 place { -0.02, 0.0, 0.0 };
    bool is_new = false;
};

/// A spring to the origin, at 1 kHz: 2 N at the first place.
struct Rig
{
    explicit Rig (StepMotion::Readings readings, double watchdog_s = GuardLimits::none)
        : run { catalogue(), {}, [=, this] (auto&&...) {
                   auto made = std::make_unique<OwnTool> (readings);
                   tool = made.get();
                   return Run::RoleDevice { std::move (made), { .watchdog = watchdog_s } };
               } }
    {
        auto loaded = readGraph (R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1000,
            "nodes": { "hand": { "type": "device.position", "role": "stylus" }, "motor": { "type": "device.force", "role": "stylus" } },
            "wires": [ { "wire": "hand.position -> motor.force", "gain": "-100 N/m" } ] })");
        REQUIRE (! hasErrors (loaded.messages));
        graph = loaded.graph;
        auto messages = run.load (graph);
        run.openDevices (graph, messages);
        REQUIRE (! hasErrors (messages));
        stepper.emplace (run);
        stepper->add (tool->motion);
    }

    graph::Graph graph;
    OwnTool* tool = nullptr;   // which the run owns
    Run run;
    std::optional<Stepper> stepper;
};
}   // namespace

TEST_CASE ("Steps: a step of a length that makes no sense runs no tick", "[steps]")
{
    Rig rig { StepMotion::Readings::linear };
    for (const double wrong : { 0.0, -0.001, 1.1, std::nan (""), GuardLimits::none })
        CHECK (rig.stepper->step (wrong) == 0);
    CHECK (rig.stepper->step (0.0004) == 0);   // shorter than a period
    CHECK (rig.stepper->step (0.0006) == 1);
}

TEST_CASE ("Steps: in C++, a state takes the Stepper with it, and what was saved with one is restored with one", "[steps][state]")
{
    Rig rig { StepMotion::Readings::linear };
    const auto more = [&] (StateArchive& archive) { archive (*rig.stepper); };
    const auto forward = [&] {
        std::vector<double> forces;
        for (int k = 0; k < 5; ++k)
        {
            rig.tool->place.x() += 0.001;
            rig.tool->is_new = true;
            forces.push_back (static_cast<double> (rig.stepper->step (0.0037)));   // 3 or 4 ticks
            forces.push_back (rig.tool->motion.effort().force.x());
        }
        return forces;
    };
    (void)forward();
    const auto place = rig.tool->place;
    const auto saved = rig.run.save (rig.graph, more);
    REQUIRE (saved);
    const auto forces = forward();
    REQUIRE (rig.run.restore (*saved, rig.graph, more));
    rig.tool->place = place;
    CHECK (forward() == forces);
    CHECK (forces.front() != forces.back());

    const auto without = rig.run.restore (*saved, rig.graph);
    REQUIRE (! without);
    CHECK (without.error().remedy.find ("MoreState") != std::string::npos);
    const auto plain = rig.run.save (rig.graph);
    REQUIRE (plain);
    const auto with = rig.run.restore (*plain, rig.graph, more);
    REQUIRE (! with);
    CHECK (with.error().remedy.find ("MoreState") != std::string::npos);
}

TEST_CASE ("Steps: in C++, a tool that is no longer moved loses its effort after the watchdog, if there is one", "[steps][safety]")
{
    using R = StepMotion::Readings;
    for (const auto readings : { R::hold, R::linear, R::by_velocity })
        for (const auto& [watchdog_s, last, first] : { std::tuple { 0.05, 10, 15 }, { 0.03, 5, 10 }, { GuardLimits::none, 29, 30 } })
        {
            Rig rig { readings, watchdog_s };
            for (int k = 0; k < 40; ++k)
            {
                rig.tool->is_new = k < 10;
                rig.stepper->step (0.004);
                const double force = rig.tool->motion.effort().force.x();
                INFO ("step " << k);
                if (k <= 10 + last) CHECK (force == Approx (2.0));   // (last + 1) 4 ms without a new reading
                if (k >= 10 + first) CHECK (force == 0.0);           // after the fade, which lasts 5 ms
            }
        }
}
