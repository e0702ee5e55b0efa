// SPDX-License-Identifier: MIT
// A simulator plays a graph in its own loop: it moves the tool, and the graph's force acts on the tool.
#include <tactus/file/graph_file.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/run/run.hpp>

#include <cstdio>

// The tool of the simulator. read and write run on the thread that calls Run::tick.
struct Tool final : tactus::Device
{
    void prepare (double dt_s) override { dt = dt_s; }
    tactus::Reading read() noexcept override { return { .position = position }; }
    void write (const tactus::Effort& e) noexcept override
    {
        velocity += dt / 0.05 * (e.force + tactus::Vec3 { 0.2, 0, -0.5 } - 2.0 * velocity);   // 50 g, pushed and dragged
        position += dt * velocity;
    }

    double dt = 0.0;
    tactus::Vec3 position { 0, 0, 0.001 }, velocity = tactus::Vec3::Zero();
};

int main (int argc, char** argv)
{
    const auto loaded = tactus::loadGraph (argc > 1 ? argv[1] : "dry_wood.json");
    const auto openDevice = [] (auto&&...) { return tactus::Run::RoleDevice { std::make_unique<Tool>(), { .max_force = 5.0 } }; };
    tactus::Run run { tactus::catalogue(), {}, openDevice };

    auto messages = loaded.messages;
    if (! tactus::hasErrors (messages)) messages = run.load (loaded.graph);
    if (! tactus::hasErrors (messages)) run.openDevices (loaded.graph, messages);
    for (const auto& m : messages)
        std::fprintf (stderr, "%s\n", describe (m).c_str());
    if (tactus::hasErrors (messages)) return 1;

    for (int k = 0; k < 4000; ++k)
    {
        run.tick();
        const auto f = run.engine().role (0).applied.force;
        if (k % 400 == 0) std::printf ("%5.3f s  %7.4f %7.4f %7.4f N\n", k / run.rate(), f.x(), f.y(), f.z());
    }
}
