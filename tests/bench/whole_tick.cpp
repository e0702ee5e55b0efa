// SPDX-License-Identifier: MIT
// Runs a graph on its simulated device, so that callgrind can count the instructions of whole ticks: the runner, the engine, the
// device, the nodes and the guard (instructions.py).
//
//     whole_tick GRAPH.json TICKS

#include <tactus/file/graph_file.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/engine.hpp>
#include <tactus/run/runner.hpp>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

using namespace tactus;

extern "C"
{
    // Callgrind finds this function by name, so it must not be inlined.
    [[gnu::noinline]] bool whole_tick (Ticked&) noexcept;

    bool whole_tick (Ticked& run) noexcept { return run.tick (0.0); }
}

namespace
{
/// A clock whose time advances by one period a tick. While it drives a run it counts as a real one, so that lost time is detected;
/// before that it does not, so that the run makes no requests to the system.
class Counted final : public TickClock
{
public:
    explicit Counted (double period_s) : period (period_s) {}

    void drive (Ticked& run) noexcept override
    {
        is_driving = true;
        while (whole_tick (run))
            time += period;
        is_driving = false;
    }
    bool isRealTime() const noexcept override { return is_driving; }
    double now() const noexcept override { return time; }

private:
    const double period;
    double time = 0.0;
    bool is_driving = false;
};
}   // namespace

int main (int argc, char** argv)
{
    if (argc != 3) return 2;
    std::stringstream text;
    text << std::ifstream (argv[1]).rdbuf();
    const auto graph = readGraph (text.str()).graph;
    const auto plan = compile (graph, catalogue(), { .settles = true }).plan;   // as in a run
    if (! plan) return 1;

    Engine engine { plan };
    const auto& [role, description] = graph.devices.front();
    const auto hand = makeDevice (description, {});
    if (! hand.device) return 1;
    engine.attach (role, *hand.device, hand.limits);

    Counted clock { 1.0 / graph.rate_hz };
    Runner runner { engine, clock, graph.rate_hz, { .length = static_cast<std::uint64_t> (std::stoi (argv[2])) } };
    runner.start();
    runner.wait();
    std::printf ("%llu\n", static_cast<unsigned long long> (runner.status().ticks));
}
