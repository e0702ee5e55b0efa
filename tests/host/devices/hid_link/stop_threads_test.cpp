// SPDX-License-Identifier: MIT
// All that can stop a run at the same time, while a device ticks it and its graph is edited: mainly for TSan. TACTUS_LIVE_SECONDS makes
// the test longer.

#include "fake_board.hpp"
#include "support/live.hpp"
#include "support/random_edit.hpp"
#include "support/random_graph.hpp"
#include "support/sketch.hpp"
#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <host/devices/failsafe/failsafe.hpp>
#include <host/devices/hid_link/hid_clock.hpp>
#include <tactus/run/runner.hpp>

#include <catch2/catch.hpp>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <thread>
#include <vector>

using namespace tactus;
using namespace tactus::host;
using namespace std::chrono_literals;

namespace
{
std::atomic<Engine*> stopped_by_signal { nullptr };

extern "C" void stopFromHandler (int)
{
    if (auto* engine = stopped_by_signal.load()) engine->emergencyStop();
}

/// A part to edit, and a part that pushes the tool on the board.
test::Sketch pushedAndEdited()
{
    test::Sketch s { test::prefixed (test::randomGraph (6, 30), "e_", "right") };
    s.node ("push", "signal.constant", { { "value", 1.0 } }).node ("join", "vector.join").node ("motor", "device.force");
    return s.wire ("push.out -> join.x").wire ("join.out -> motor.force");
}

/// Looks for alarms of the failsafe before each tick, as `play` and the window do.
struct Alarmed final : TickHooks
{
    explicit Alarmed (Engine& e) : engine (e) {}
    void before (std::uint64_t) noexcept override
    {
        if (const auto now = Failsafe::alarms(); now != seen)
        {
            seen = now;
            engine.emergencyStop();
        }
    }
    void after (std::uint64_t, bool) noexcept override {}

    Engine& engine;
    std::uint32_t seen = Failsafe::alarms();
};

/// Calls a function again and again on its own threads.
class Beside
{
public:
    template <typename F>
    void add (std::chrono::microseconds pause, F what)
    {
        all.emplace_back ([pause, what] (const std::stop_token& over) mutable {
            for (; ! over.stop_requested(); test::letPass (pause))
                what();
        });
    }
    void end() { all.clear(); }

private:
    std::vector<std::jthread> all;
};
}   // namespace

// Long because it is one scenario: all threads work on one run.
TEST_CASE ("stops by a signal, from threads and by the failsafe, rearms, edits and the reports of a board go together", "[hid][safety][threads]")
{
    const TemporaryFolder folder;
    const auto file = (folder / "device").string();
    std::ofstream { file }.close();

    const auto sketch = pushedAndEdited();
    const CompileOptions options { .rate_hz = 1000.0 };
    const auto first = sketch.compile (options);
    INFO (test::text (first.messages));
    REQUIRE (first.plan);
    test::Live live { sketch.graph, catalogue(), options, first.plan };
    auto& engine = live.engine();
    test::FakeBoard board;
    const auto device = test::openBoard (board);
    engine.attach ("stylus", *device, { .max_force = 2.0, .ramp = 0.002, .watchdog = 1.0 });
    hid::HidClock clock { device->port(), 1000.0 };
    Alarmed alarmed { engine };
    Runner runner { engine, clock, 1000.0, { .hooks = &alarmed } };
    runner.start();

    stopped_by_signal = &engine;
    const auto before = std::signal (SIGUSR1, stopFromHandler);
    auto failsafe = Failsafe::arm (file, { { { 'r' }, false } });
    REQUIRE (failsafe);

    std::atomic<int> stops = 0, rearms = 0, pushes = 0, broken = 0;
    Beside beside;
    beside.add (900us, [&, count = std::uint16_t {}]() mutable {
        ++count;
        board.send (test::boardReport (count, count));
    });
    beside.add (5ms, [&] { broken += ! failsafe->beat (true) && Failsafe::alarms() == 0; });
    beside.add (11ms, [&] {
        std::raise (SIGUSR1);
        ++stops;
    });
    beside.add (17ms, [&] { engine.emergencyStop(); });
    beside.add (7ms, [&] {
        engine.rearm();
        ++rearms;
    });
    beside.add (300us, [&] {
        const auto now = runner.status();
        broken += ! (now.force <= 2.0);
        pushes += now.force > 0.0;
        for (const auto& stop : engine.guardLog().since())
            broken += describe (stop.event).empty();
    });

    std::mt19937 random { 7 };
    const auto* wanted = std::getenv ("TACTUS_LIVE_SECONDS");
    const std::chrono::milliseconds least { wanted ? 1000 * std::stoi (wanted) : 500 };
    for (const test::Stopwatch watch; ! watch.hasRun (least) || stops < 10 || rearms < 10 || pushes < 10;)
    {
        if (live.history().position() > 50)
            while (live.history().position() > 0)
                live.undo();
        auto messages = live.perform (test::randomEdit (random, live.graph(), "e_", "right"));
        while (hasErrors (messages))
            messages = live.undo();
        runner.poll();
    }
    beside.end();
    engine.emergencyStop();
    runner.stop();
    runner.wait();
    stopped_by_signal = nullptr;
    std::signal (SIGUSR1, before);

    CHECK (broken == 0);
    CHECK (engine.isEmergency());
    CHECK (engine.isAtRest());
    if (wanted) std::cout << runner.status().ticks << " ticks, " << stops << " signals, " << rearms << " rearms, " << pushes << " looks under force\n";
}
