// SPDX-License-Identifier: MIT
// The C API from five threads at once, mainly for TSan. TACTUS_LIVE_SECONDS makes the test longer.
#include "c_handles.hpp"
#include "support/waiting.hpp"

#include <support/temporary_folder.hpp>

#include <catch2/catch.hpp>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>
#include <vector>

using namespace tactus::test;

TEST_CASE ("C API: while a run ticks itself, one thread edits, and others push readings, read efforts, and stop and rearm", "[c_api][threads]")
{
    const MessageList m { tactus_messages_create() };
    const GraphHandle g { tactus_graph_load (TACTUS_SOURCE_DIR "/graphs/dry_wood.json", m.get()) };
    REQUIRE (g);
    tactus_run_options options = TACTUS_RUN_OPTIONS;
    options.rate_hz = 200.0;   // so that the ticks get time next to busy threads, even under TSan
    const RunHandle run { tactus_run_create (g.get(), &options, m.get()) };
    REQUIRE (run);
    tactus_device_options device = TACTUS_DEVICE_OPTIONS;
    REQUIRE (tactus_run_pushed_device (run.get(), "stylus", &device, m.get()) == TACTUS_OK);
    REQUIRE (tactus_run_open (run.get(), m.get()) == TACTUS_OK);
    tactus_start_options start = TACTUS_START_OPTIONS;
    start.buffer = 10'000;
    REQUIRE (tactus_run_start (run.get(), &start, m.get()) == TACTUS_OK);

    std::atomic<bool> stop = false;
    std::atomic<int> broken = 0, pushed = 0, read = 0, stopped = 0;
    std::vector<std::thread> others;
    const auto beside = [&] (std::function<void (int)> step) {
        others.emplace_back ([&stop, step = std::move (step)] {
            for (int i = 0; ! stop; ++i)
            {
                step (i);
                std::this_thread::yield();
            }
        });
    };
    beside ([&] (int i) {
        tactus_reading r TACTUS_READING;
        r.valid = 1;
        r.position[0] = 1e-5 * (i % 1000);
        r.position[2] = -1e-3;
        broken += tactus_run_push (run.get(), "stylus", &r) != TACTUS_OK;
        ++pushed;
    });
    beside ([&] (int) {
        tactus_effort e TACTUS_EFFORT;
        tactus_status status = TACTUS_STATUS;
        broken += tactus_run_take (run.get(), "stylus", &e) != TACTUS_OK || tactus_run_status (run.get(), &status) != TACTUS_OK;
        broken += ! std::isfinite (e.force[0] + e.force[1] + e.force[2]) || status.peak_force < status.force;
        ++read;
    });
    beside ([&] (int) {
        broken += tactus_run_emergency_stop (run.get()) != TACTUS_OK;
        letPass (std::chrono::milliseconds (20));
        broken += tactus_run_rearm (run.get()) != TACTUS_OK;
        letPass (std::chrono::milliseconds (20));
        ++stopped;
    });

    const auto* wanted = std::getenv ("TACTUS_LIVE_SECONDS");
    const std::chrono::milliseconds least { wanted ? 1000 * std::stoi (wanted) : 500 };
    std::vector<double> rows (tactus_run_record_count (run.get()) * 1000);
    size_t collected = 0;
    int edits = 0;
    for (const Stopwatch watch; ! watch.hasRun (least) || edits < 10 || pushed < 10 || read < 10 || stopped < 2; ++edits)
    {
        const auto mu = std::to_string (0.2 + 0.01 * (edits % 30));
        broken += tactus_graph_set_param (g.get(), "", "drag", "mu", mu.c_str(), m.get()) != TACTUS_OK;
        broken += tactus_run_edit (run.get(), g.get(), m.get()) != TACTUS_OK;
        broken += tactus_run_set (run.get(), "drag.mu", 0.5, m.get()) != TACTUS_OK;
        broken += tactus_run_attend (run.get(), m.get()) != TACTUS_OK;
        collected += tactus_run_collect (run.get(), rows.data(), 1000);
    }
    stop = true;
    for (auto& thread : others)
        thread.join();
    REQUIRE (tactus_run_stop (run.get()) == TACTUS_OK);
    INFO (said (m));
    CHECK (broken == 0);
    CHECK (collected > 0);
    tactus_status status = TACTUS_STATUS;
    tactus_run_status (run.get(), &status);
    CHECK (status.force == 0.0);
    CHECK (status.ticks > 0);   // under TSan, a starved run soon ends itself
}

TEST_CASE ("C API: a loop on a thread of its own ticks and logs, and another thread turns, probes, edits and stops", "[c_api][threads]")
{
    const TemporaryFolder folder;
    const auto log = (folder / "run.jsonl").string();
    const MessageList m { tactus_messages_create() };
    const GraphHandle g { tactus_graph_load (TACTUS_SOURCE_DIR "/graphs/dry_wood.json", m.get()) };
    REQUIRE (g);
    tactus_run_options options = TACTUS_RUN_OPTIONS;
    options.log = log.c_str();
    const RunHandle run { tactus_run_create (g.get(), &options, m.get()) };
    REQUIRE (run);
    REQUIRE (tactus_run_pushed_device (run.get(), "stylus", nullptr, m.get()) == TACTUS_OK);
    REQUIRE (tactus_run_open (run.get(), m.get()) == TACTUS_OK);
    std::atomic<int> ticked = 0, allowed = 1000;   // the log buffers 4000 ticks
    std::atomic<bool> is_over = false;
    std::jthread ticking ([&] {
        tactus_reading r TACTUS_READING;
        r.valid = 1;
        std::vector<double> records (tactus_run_record_count (run.get()));
        for (int k = 0; ! is_over; ++k)
        {
            r.position[2] = -1e-6 * (k % 1000);
            if (tactus_run_push (run.get(), "stylus", &r) != TACTUS_OK || tactus_run_tick (run.get()) != TACTUS_OK
                || tactus_run_get_records (run.get(), records.data()) != TACTUS_OK)
                is_over = true;
            for (++ticked; ticked >= allowed && ! is_over;)
                std::this_thread::yield();
        }
    });
    const char* ports[] = { "motor.force" };
    std::vector<double> rows (3000);
    int broken = tactus_run_probe (run.get(), ports, 1, m.get()) != TACTUS_OK;
    size_t collected = 0;
    for (int edits = 0; edits < 30; ++edits)
    {
        const auto mu = std::to_string (0.2 + 0.01 * edits);
        broken += tactus_graph_set_param (g.get(), "", "drag", "mu", mu.c_str(), m.get()) != TACTUS_OK;
        broken += tactus_run_edit (run.get(), g.get(), m.get()) != TACTUS_OK;
        broken += tactus_run_turn (run.get(), "roughness", 0.03 * edits, m.get()) != TACTUS_OK;
        broken += tactus_run_attend (run.get(), m.get()) != TACTUS_OK;
        const int before = ticked;
        allowed = before + 1000;
        while (ticked < before + 50 && ! is_over)
            std::this_thread::yield();
        collected += tactus_run_collect_probes (run.get(), nullptr, rows.data(), 1000);
    }
    tactus_effort e TACTUS_EFFORT;
    broken += tactus_run_stop (run.get()) != TACTUS_OK;   // while the other thread still ticks
    broken += tactus_run_take (run.get(), "stylus", &e) != TACTUS_OK || e.force[2] != 0.0;
    is_over = true;
    ticking.join();
    INFO (said (m));
    CHECK (broken == 0);
    CHECK (collected > 0);
    CHECK (ticked >= 1500);
}
