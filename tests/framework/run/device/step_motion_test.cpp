// SPDX-License-Identifier: MIT
// A device in C++ whose program stops moving it, compared with the same loop through the C API.
#include <tactus/file/graph_file.hpp>
#include <tactus/kit/state_archive.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/run/device/step_motion.hpp>
#include <tactus/run/stepper.hpp>

#include <framework/capi/c_handles.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using namespace tactus;
using namespace tactus::test;

namespace
{
/// Pushes the tool with 2 N whatever it does, at 1 kHz.
constexpr const char* pushing_graph = R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1000,
    "devices": { "stylus": { "driver": "sim", "guard": { "max_force": "1.5 N" } } },
    "nodes": { "push": { "type": "signal.constant", "params": { "value": "2 N" } }, "motor": { "type": "device.force", "role": "stylus" } },
    "wires": [ "push.out -> motor.force.x" ] })";

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
    Vec3 place = Vec3::Zero();
    bool is_new = false;
};

constexpr double step_s = 0.004;
constexpr int moved = 10, steps = 40;   // in the first ones, the tool is moved

/// A spring to the origin, at 1 kHz.
constexpr const char* spring_graph = R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1000,
    "nodes": { "hand": { "type": "device.position", "role": "stylus" }, "motor": { "type": "device.force", "role": "stylus" } },
    "wires": [ { "wire": "hand.position -> motor.force", "gain": "-100 N/m" } ] })";

/// A run of a graph in C++.
struct Rig
{
    explicit Rig (StepMotion::Readings readings, double watchdog_s = GuardLimits::none, const char* text = pushing_graph)
        : run { catalogue(), {}, [=, this] (auto&&...) {
                   auto made = std::make_unique<OwnTool> (readings);
                   tool = made.get();
                   return Run::RoleDevice { std::move (made), { .watchdog = watchdog_s } };
               } }
    {
        const auto loaded = readGraph (text);
        REQUIRE (! hasErrors (loaded.messages));
        graph = loaded.graph;
        graph.devices.clear();   // and with it the guard
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

std::vector<double> forcesInCpp (StepMotion::Readings readings, double watchdog_s)
{
    Rig rig { readings, watchdog_s };
    std::vector<double> forces;
    for (int k = 0; k < steps; ++k)
    {
        rig.tool->is_new = k < moved;
        rig.stepper->step (step_s);
        forces.push_back (rig.tool->motion.effort().force.x());
    }
    return forces;
}

std::vector<double> forcesInC (tactus_between between, const char* guard)
{
    const MessageList m { tactus_messages_create() };
    const GraphHandle graph { tactus_graph_parse (pushing_graph, std::string (pushing_graph).size(), nullptr, m.get()) };
    REQUIRE (tactus_graph_set_device (graph.get(), "stylus", nullptr, m.get()) == TACTUS_OK);
    const RunHandle run { tactus_run_create (graph.get(), nullptr, m.get()) };
    REQUIRE (run);
    tactus_device_options options = TACTUS_DEVICE_OPTIONS;
    options.between = between;
    options.guard = guard;
    REQUIRE (tactus_run_pushed_device (run.get(), "stylus", &options, m.get()) == TACTUS_OK);
    REQUIRE (tactus_run_open (run.get(), m.get()) == TACTUS_OK);
    tactus_reading reading = TACTUS_READING;
    reading.valid = 1;
    std::vector<double> forces;
    for (int k = 0; k < steps; ++k)
    {
        if (k < moved) REQUIRE (tactus_run_push (run.get(), "stylus", &reading) == TACTUS_OK);
        REQUIRE (tactus_run_step_for (run.get(), step_s) == TACTUS_OK);
        tactus_effort effort = TACTUS_EFFORT;
        REQUIRE (tactus_run_take (run.get(), "stylus", &effort) == TACTUS_OK);
        forces.push_back (effort.force[0]);
    }
    return forces;
}
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
    Rig rig { StepMotion::Readings::linear, GuardLimits::none, spring_graph };
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

TEST_CASE ("Steps: in C++, a tool that is no longer moved loses its effort after the watchdog, as in C", "[steps][safety]")
{
    using R = StepMotion::Readings;
    for (const auto& [in_cpp, in_c] : { std::pair { R::hold, TACTUS_HOLD }, { R::linear, TACTUS_LINEAR }, { R::by_velocity, TACTUS_BY_VELOCITY } })
    {
        const auto forces = forcesInCpp (in_cpp, 0.05);
        CHECK (forces == forcesInC (in_c, nullptr));   // 50 ms is the default there
        CHECK (forces[moved + 10] == 2.0);             // 44 ms without a new reading
        CHECK (forces[moved + 15] == 0.0);             // 64 ms, and the fade lasts 5 ms
        CHECK (forcesInCpp (in_cpp, 0.03) == forcesInC (in_c, R"({ "watchdog": "30 ms" })"));
        CHECK (forcesInCpp (in_cpp, GuardLimits::none).back() == 2.0);   // without a watchdog, as a device in C++ is by itself
    }
}
