// SPDX-License-Identifier: GPL-3.0-or-later
// The emergency stop of `tactus play`.

#include "running.hpp"

#include <framework/json.hpp>
#include <host/io/csv.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>
#include <vector>

using namespace tactus;
using test::Running;
using test::Scratch;

TEST_CASE ("a signal is the emergency stop of a play: no force, the ticks go on, another signal rearms", "[cli]")
{
    const Scratch scratch;
    const Json graph { { "format", "tactus-graph" }, { "version", 1 }, { "rate_hz", 1000 },   //
                       { "nodes", { { "hand", { { "type", "device.position" }, { "role", "tip" } } }, { "push", { { "type", "signal.constant" }, { "params", { { "value", 2.0 } } } } }, { "motor", { { "type", "device.force" }, { "role", "tip" } } } } },
                       { "wires", { "push.out -> motor.force.x" } } };
    const auto recorded = scratch.path ("applied.csv");
    Running play { { "play", scratch.write ("g.json", graph.dump()), "--device", "tip=sim", "--osc", "off", "--record", "motor.applied.x", "--out", recorded } };
    REQUIRE (play.says ("Ctrl-C stops"));
    for (const int number : { SIGUSR1, SIGUSR2 })
    {
        std::this_thread::sleep_for (std::chrono::milliseconds (300));
        play.signal (number);
    }
    std::this_thread::sleep_for (std::chrono::milliseconds (300));
    const auto ran = play.stop();
    INFO (ran.err);
    CHECK (ran.status == 0);
    CHECK (ran.err.find ("the emergency stop was pressed") != std::string::npos);

    const auto table = host::readTable (std::filesystem::path (recorded));
    REQUIRE (table);
    std::vector<std::size_t> lengths;   // of what is on, off, on again
    for (std::size_t k = 1; k < table->rows(); ++k)
    {
        const auto is_off = [&] (std::size_t row)
        { return table->at (row, 1) == 0.0; };
        if (lengths.empty() || is_off (k) != is_off (k - 1)) lengths.push_back (0);
        ++lengths.back();
    }
    CAPTURE (lengths);
    REQUIRE (lengths.size() >= 3);
    CHECK (lengths[1] > 100);
    CHECK (lengths[2] > 100);
}
