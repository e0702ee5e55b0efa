// SPDX-License-Identifier: MIT
// A simulator with steps of 5 ms gets the force of a graph at 4 kHz: steps dry_wood.json. See docs/steps.md for the rules and their delays.
#include <tactus/file/graph_file.hpp>
#include <tactus/kit/state_archive.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/run/device/step_motion.hpp>
#include <tactus/run/run.hpp>
#include <tactus/run/stepper.hpp>

#include <cstdio>
#include <memory>
#include <utility>

// The tool, as the graph sees it.
struct Tool final : tactus::Device
{
    void prepare (double) override {}
    tactus::Reading read() noexcept override { return motion.move (reading, std::exchange (is_new, false)); }
    void write (const tactus::Effort& effort) noexcept override { motion.take (effort); }
    void withhold() noexcept override { motion.withhold(); }

    // In the device: it can be saved, because no person holds it.
    bool serialize (tactus::StateArchive& archive) override
    {
        archive (motion, reading, is_new);
        return true;
    }

    void moveTo (const tactus::Vec3& position)
    {
        reading.position = position;
        is_new = true;
    }

    tactus::StepMotion motion { tactus::StepMotion::Readings::linear, tactus::StepMotion::Efforts::last };
    tactus::Reading reading {};
    bool is_new = false;
};

static int fail (const tactus::Message& why)
{
    std::fprintf (stderr, "%s\n", describe (why).c_str());
    return 1;
}

int main (int argc, char** argv)
{
    const auto loaded = tactus::loadGraph (argc > 1 ? argv[1] : "dry_wood.json");
    Tool* tool = nullptr;   // which the run owns
    tactus::Run run { tactus::catalogue(), {}, [&] (auto&&...) {
                         auto made = std::make_unique<Tool>();
                         tool = made.get();
                         return tactus::Run::RoleDevice { std::move (made), { .max_force = 5.0, .watchdog = 0.05 } };
                     } };
    auto messages = loaded.messages;
    if (! tactus::hasErrors (messages)) messages = run.load (loaded.graph);
    if (! tactus::hasErrors (messages)) run.openDevices (loaded.graph, messages);
    for (const auto& m : messages)
        std::fprintf (stderr, "%s\n", describe (m).c_str());
    if (tactus::hasErrors (messages) || tool == nullptr) return 1;

    tactus::Stepper steps { run };
    steps.add (tool->motion);

    // In the loop.
    const tactus::Run::MoreState more = [&] (tactus::StateArchive& archive) { archive (steps); };
    const auto start = run.save (loaded.graph, more);
    if (! start) return fail (start.error());

    constexpr double dt = 0.005;
    tactus::Vec3 position { 0, 0, 0.001 }, velocity = tactus::Vec3::Zero();
    for (int k = 0; k < 200; ++k)
    {
        tool->moveTo (position);
        const auto ticks = steps.step (dt);   // 20
        const auto force = tool->motion.effort().force;
        if (const auto& guard = run.engine().role (0).guard; guard.isLatched())
        {
            std::printf ("the guard has stopped the force: %s\n", describe (guard.latest()).c_str());
            return 1;
        }
        velocity += dt / 0.5 * (force + tactus::Vec3 { 0.2, 0, -0.5 } - 20.0 * velocity);   // 500 g, pushed and dragged: the physics of the simulator
        position += dt * velocity;
        if (k % 20 == 0)
            std::printf ("%5.3f s  %zu ticks  z %7.4f mm  %7.4f %7.4f %7.4f N\n", k * dt, ticks, 1e3 * position.z(), force.x(), force.y(), force.z());
    }

    if (auto back = run.restore (*start, loaded.graph, more); ! back) return fail (back.error());
    tool->moveTo ({ 0, 0, 0.001 });
    steps.step (dt);
    std::printf ("again from the start: %7.4f N\n", tool->motion.effort().force.z());
    return 0;
}
