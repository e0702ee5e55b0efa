// SPDX-License-Identifier: MIT
// Probes and the log of a run through the C API.
#include "c_handles.hpp"
#include "support/waiting.hpp"

#include <support/temporary_folder.hpp>
#include <tactus/run/replay.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

using namespace tactus::test;

namespace
{
const std::string text = R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1000,
    "nodes": { "hand": { "type": "device.position", "role": "stylus" }, "wall": { "type": "deform.plane", "params": { "stiffness": "1 N/mm" } },
               "motor": { "type": "device.force", "role": "stylus" }, "ramp": { "type": "signal.lfo", "params": { "shape": "saw", "frequency": "1 mHz" } } },
    "wires": [ "hand.position -> wall.position", "wall.force -> motor.force" ],
    "controls": { "softness": { "value": 0, "to": { "wall.damping": [0, 2] } } } })";

GraphHandle wall (const MessageList& m) { return GraphHandle { tactus_graph_parse (text.c_str(), text.size(), nullptr, m.get()) }; }

RunHandle opened (const MessageList& m, const char* log = nullptr)
{
    const auto g = wall (m);
    tactus_run_options options = TACTUS_RUN_OPTIONS;
    options.log = log;
    RunHandle run { tactus_run_create (g.get(), &options, m.get()) };
    INFO (said (m));
    REQUIRE (run);
    REQUIRE (tactus_run_pushed_device (run.get(), "stylus", nullptr, m.get()) == TACTUS_OK);
    REQUIRE (tactus_run_open (run.get(), m.get()) == TACTUS_OK);
    return run;
}

/// One tick with the tool at this height.
void tick (tactus_run* run, double z)
{
    tactus_reading reading = TACTUS_READING;
    reading.valid = 1;
    reading.position[2] = z;
    REQUIRE (tactus_run_push (run, "stylus", &reading) == TACTUS_OK);
    REQUIRE (tactus_run_tick (run) == TACTUS_OK);
}

void probe (tactus_run* run, std::vector<const char*> ports)
{
    const MessageList m { tactus_messages_create() };
    const auto result = tactus_run_probe (run, ports.data(), ports.size(), m.get());
    INFO (said (m));
    REQUIRE (result == TACTUS_OK);
}
}   // namespace

TEST_CASE ("C API: probes give the latest value, and a queue of all samples with their ticks", "[c_api]")
{
    const MessageList m { tactus_messages_create() };
    const auto run = opened (m);
    CHECK (tactus_run_probe_count (run.get()) == 0);
    CHECK (tactus_run_collect_probes (run.get(), nullptr, nullptr, 5) == 0);
    probe (run.get(), { "motor.force", "ramp.out" });
    REQUIRE (tactus_run_probe_count (run.get()) == 4);
    CHECK (std::string (tactus_run_probe_name (run.get(), 2)) == "motor.force.z");
    CHECK (std::string (tactus_run_probe_name (run.get(), 3)) == "ramp.out");
    CHECK (tactus_run_probe_name (run.get(), 4) == nullptr);

    double values[4];
    REQUIRE (tactus_run_probed (run.get(), values, 4) == TACTUS_OK);
    CHECK (std::isnan (values[2]));   // no tick yet
    CHECK (tactus_run_probed (run.get(), values, 3) == TACTUS_MISUSE);
    for (int k = 0; k < 10; ++k)
        tick (run.get(), -1e-4 * k);
    for (int i = 0; i < 2; ++i)   // asking for the latest takes nothing out of the queue
    {
        REQUIRE (tactus_run_probed (run.get(), values, 4) == TACTUS_OK);
        CHECK (values[2] == Approx (0.9));
    }
    double rows[4 * 8];
    std::uint64_t ticks[8];
    REQUIRE (tactus_run_collect_probes (run.get(), ticks, rows, 8) == 8);
    for (int k = 0; k < 8; ++k)
    {
        CHECK (ticks[k] == static_cast<std::uint64_t> (k));
        CHECK (rows[4 * k + 2] == Approx (0.1 * k).margin (1e-12));
    }
    CHECK (tactus_run_collect_probes (run.get(), nullptr, rows, 8) == 2);
    CHECK (tactus_run_collect_probes (run.get(), nullptr, rows, 8) == 0);
    CHECK (tactus_run_lost_probes (run.get()) == 0);
}

TEST_CASE ("C API: samples that nobody collects are lost and counted, and the latest value stays the latest", "[c_api]")
{
    const MessageList m { tactus_messages_create() };
    const auto run = opened (m);
    probe (run.get(), { "ramp.out" });
    constexpr int many = 10'000;
    double value = 0.0, last = 0.0;
    for (int k = 0; k < many; ++k)
    {
        tick (run.get(), 0.0);
        if (k % 100 != 99) continue;
        REQUIRE (tactus_run_probed (run.get(), &value, 1) == TACTUS_OK);
        CHECK (value > last);
        last = value;
    }
    std::vector<double> rows (many);
    std::vector<std::uint64_t> ticks (many);
    const auto got = tactus_run_collect_probes (run.get(), ticks.data(), rows.data(), many);
    CHECK (got == 4096);
    CHECK (got + tactus_run_lost_probes (run.get()) == many);
    CHECK (ticks[got - 1] == got - 1);   // the oldest are kept
    tick (run.get(), 0.0);
    REQUIRE (tactus_run_collect_probes (run.get(), ticks.data(), rows.data(), many) == 1);
    CHECK (ticks[0] == many);
}

TEST_CASE ("C API: a wrong probe leaves the earlier ones, no ports end them, and an edit neither loses nor mixes samples", "[c_api]")
{
    const MessageList m { tactus_messages_create() };
    const auto run = opened (m);
    probe (run.get(), { "wall.force.z" });
    const char* nowhere = "wall.colour";
    CHECK (tactus_run_probe (run.get(), &nowhere, 1, m.get()) == TACTUS_FAILED);
    CHECK (tactus_run_probe_count (run.get()) == 1);
    for (int k = 0; k < 5; ++k)
        tick (run.get(), -1e-3);
    const auto g = wall (m);
    REQUIRE (tactus_graph_set_param (g.get(), "", "wall", "stiffness", "500", m.get()) == TACTUS_OK);
    REQUIRE (tactus_graph_add_node (g.get(), "", "idle", "signal.abs", m.get()) == TACTUS_OK);
    REQUIRE (tactus_run_edit (run.get(), g.get(), m.get()) == TACTUS_OK);
    for (int k = 0; k < 100; ++k)
        tick (run.get(), -1e-3);
    std::vector<double> rows (200);
    REQUIRE (tactus_run_collect_probes (run.get(), nullptr, rows.data(), 200) == 105);
    CHECK (rows[4] == Approx (1.0));
    CHECK (rows[104] == Approx (0.5));

    REQUIRE (tactus_graph_remove_node (g.get(), "", "wall", m.get()) == TACTUS_OK);
    tactus_messages_clear (m.get());
    CHECK (tactus_run_edit (run.get(), g.get(), m.get()) == TACTUS_FAILED);
    tactus_message message = TACTUS_MESSAGE;
    REQUIRE (tactus_messages_get (m.get(), 0, &message) == TACTUS_OK);
    CHECK (std::string (message.where) == "record wall.force.z");
    probe (run.get(), {});
    CHECK (tactus_run_probe_count (run.get()) == 0);
    CHECK (tactus_run_edit (run.get(), g.get(), m.get()) == TACTUS_OK);
    CHECK (tactus_run_probe (nullptr, &nowhere, 1, m.get()) == TACTUS_MISUSE);
    CHECK (tactus_run_probe (run.get(), nullptr, 1, m.get()) == TACTUS_MISUSE);
}

TEST_CASE ("C API: probes of a run that was started arrive in order while it plays", "[c_api]")
{
    const MessageList m { tactus_messages_create() };
    const auto run = opened (m);
    tactus_start_options start = TACTUS_START_OPTIONS;
    start.length = 400;
    REQUIRE (tactus_run_start (run.get(), &start, m.get()) == TACTUS_OK);
    probe (run.get(), { "ramp.out" });
    std::vector<std::uint64_t> ticks;
    std::vector<double> values;
    tactus_status status = TACTUS_STATUS;
    while (status.phase != TACTUS_OVER)
    {
        REQUIRE (tactus_run_status (run.get(), &status) == TACTUS_OK);
        REQUIRE (tactus_run_attend (run.get(), m.get()) == TACTUS_OK);
        std::uint64_t some_ticks[50];
        double some[50];
        const auto got = tactus_run_collect_probes (run.get(), some_ticks, some, 50);
        ticks.insert (ticks.end(), some_ticks, some_ticks + got);
        values.insert (values.end(), some, some + got);
        letPass (std::chrono::milliseconds (1));
    }
    for (std::size_t i = 1; i < ticks.size(); ++i)
    {
        CHECK (ticks[i] == ticks[i - 1] + 1);
        CHECK (values[i] > values[i - 1]);
    }
    CHECK (tactus_run_lost_probes (run.get()) == 0);
}

namespace
{
/// The forces of a replayed log, on z.
std::vector<double> replayed (const std::string& log)
{
    auto opened = tactus::Replay::open (log, { .records = { "motor.force.z" } });
    INFO ((opened ? "" : opened.error().text));
    REQUIRE (opened);
    auto& replay = **opened;
    std::vector<double> forces;
    for (auto more = replay.tick(); more && *more; more = replay.tick())
        forces.push_back (*replay.run().engine().plan().taps()[0].value);
    CHECK_FALSE (replay.end());
    return forces;
}
}   // namespace

TEST_CASE ("C API: the log of a loop with a pushed device, a turned control, late ticks and an edit replays bit for bit", "[c_api]")
{
    const TemporaryFolder folder;
    const auto path = (folder / "run.jsonl").string();
    const MessageList m { tactus_messages_create() };
    std::vector<double> forces;
    {
        const auto run = opened (m, path.c_str());
        std::vector<double> records (tactus_run_record_count (run.get()));
        for (int k = 0; k < 3000; ++k)
        {
            tactus_reading reading = TACTUS_READING;
            reading.valid = 1;
            reading.position[2] = -1e-3 * std::abs (std::sin (0.01 * k));
            if (k < 1000 || k > 1200) tactus_run_push (run.get(), "stylus", &reading);
            if (k == 500) REQUIRE (tactus_run_turn (run.get(), "softness", 0.4, m.get()) == TACTUS_OK);
            if (k == 800) REQUIRE (tactus_run_set (run.get(), "wall.stiffness", 700.0, m.get()) == TACTUS_OK);
            if (k == 1500)
            {
                const auto g = wall (m);
                REQUIRE (tactus_graph_set_param (g.get(), "", "wall", "stiffness", "500", m.get()) == TACTUS_OK);
                REQUIRE (tactus_run_edit (run.get(), g.get(), m.get()) == TACTUS_OK);
            }
            REQUIRE ((k % 7 == 3 ? tactus_run_tick_after (run.get(), 3e-3) : tactus_run_tick (run.get())) == TACTUS_OK);
            REQUIRE (tactus_run_get_records (run.get(), records.data()) == TACTUS_OK);
            forces.push_back (records[2]);
            if (k % 100 == 0) REQUIRE (tactus_run_attend (run.get(), m.get()) == TACTUS_OK);
        }
        REQUIRE (tactus_run_stop (run.get()) == TACTUS_OK);
        REQUIRE (tactus_run_attend (run.get(), m.get()) == TACTUS_OK);
    }
    INFO (said (m));
    const auto again = replayed (path);
    REQUIRE (again.size() == forces.size());
    CHECK (std::memcmp (again.data(), forces.data(), forces.size() * sizeof (double)) == 0);
    CHECK (forces[100] != 0.0);
}

TEST_CASE ("C API: tactus_run_steps logs a render of any length", "[c_api]")
{
    const TemporaryFolder folder;
    const auto path = (folder / "run.jsonl").string();
    const MessageList m { tactus_messages_create() };
    {
        const auto run = opened (m, path.c_str());
        REQUIRE (tactus_run_steps (run.get(), 20'000, nullptr, nullptr) == TACTUS_OK);   // 20 s; the log buffers one
        CHECK (tactus_run_stop (run.get()) == TACTUS_OK);
    }
    CHECK (replayed (path).size() == 20'000);
}

TEST_CASE ("C API: a log that cannot be written, or that nobody writes, is told once", "[c_api]")
{
    const MessageList m { tactus_messages_create() };
    {
        const auto g = wall (m);
        tactus_run_options options = TACTUS_RUN_OPTIONS;
        options.log = "/nowhere/run.jsonl";
        const RunHandle run { tactus_run_create (g.get(), &options, m.get()) };
        CHECK (tactus_run_open (run.get(), m.get()) == TACTUS_FAILED);
        CHECK (said (m).find ("output/unwritable") != std::string::npos);
        CHECK (tactus_run_tick (run.get()) == TACTUS_MISUSE);
    }
    const TemporaryFolder folder;
    const auto path = (folder / "run.jsonl").string();
    const auto run = opened (m, path.c_str());
    for (int k = 0; k < 20'000; ++k)   // without tactus_run_attend
        tick (run.get(), 0.0);
    tactus_messages_clear (m.get());
    CHECK (tactus_run_attend (run.get(), m.get()) == TACTUS_FAILED);
    CHECK (said (m).find ("log/broken") != std::string::npos);
    CHECK (tactus_run_attend (run.get(), m.get()) == TACTUS_OK);
}
