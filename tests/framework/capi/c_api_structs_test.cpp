// SPDX-License-Identifier: MIT
// Structs of the C API that are not initialised, or belong to another version.
#include "c_handles.hpp"

#include <support/no_allocation.hpp>

#include <catch2/catch.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

using namespace tactus::test;

namespace
{
const std::string text = R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1000,
    "nodes": { "hand": { "type": "device.position", "role": "stylus" }, "wall": { "type": "deform.plane" }, "motor": { "type": "device.force", "role": "stylus" } },
    "wires": [ "hand.position -> wall.position", "wall.force -> motor.force" ],
    "controls": { "hardness": { "to": { "wall.stiffness": [100, 1000] } } } })";

GraphHandle wall() { return GraphHandle { tactus_graph_parse (text.c_str(), text.size(), nullptr, nullptr) }; }

RunHandle pushedWall()
{
    const auto g = wall();
    RunHandle run { tactus_run_create (g.get(), nullptr, nullptr) };
    REQUIRE (tactus_run_pushed_device (run.get(), "stylus", nullptr, nullptr) == TACTUS_OK);
    REQUIRE (tactus_run_open (run.get(), nullptr) == TACTUS_OK);
    return run;
}

/// What a call that gets the struct with this size says: the initialiser is in the messages, if it takes some, and in tactus_last_misuse.
template <typename Struct, typename Call>
void refuses (Struct given, std::uint32_t size, const std::string& initialiser, bool takes_messages, Call&& call)
{
    const MessageList m { tactus_messages_create() };
    given.size = size;
    const Struct before = given;
    CAPTURE (initialiser, size);
    CHECK (call (&given, m.get()));
    CHECK (std::memcmp (&given, &before, sizeof given) == 0);
    CHECK (std::string (tactus_last_misuse()).find (initialiser) != std::string::npos);
    if (! takes_messages) return;
    REQUIRE (tactus_messages_count (m.get()) == 1);
    tactus_message message = TACTUS_MESSAGE;
    REQUIRE (tactus_messages_get (m.get(), 0, &message) == TACTUS_OK);
    CHECK (std::string (message.id) == "api/struct");
    CHECK (std::string (message.remedy).find (initialiser) != std::string::npos);
}
}   // namespace

TEST_CASE ("C API: a struct with a size of 0, or of no version, is refused, and the message names its initialiser", "[c_api]")
{
    const auto run = pushedWall();
    const auto g = wall();
    const MessageList full { tactus_messages_create() };
    CHECK (tactus_graph_load ("/nowhere.json", full.get()) == nullptr);
    const auto isMisuse = [] (tactus_result result) { return result == TACTUS_MISUSE; };
    for (const std::uint32_t size : { 0u, 3u, 8u, 100'000u, 0xcdcdcdcdu })
    {
        refuses (tactus_run_options TACTUS_RUN_OPTIONS, size, "TACTUS_RUN_OPTIONS", true,
                 [&] (auto* s, auto* m) { return tactus_run_create (g.get(), s, m) == nullptr; });
        const RunHandle closed { tactus_run_create (g.get(), nullptr, nullptr) };
        refuses (tactus_device_options TACTUS_DEVICE_OPTIONS, size, "TACTUS_DEVICE_OPTIONS", true,
                 [&] (auto* s, auto* m) { return isMisuse (tactus_run_pushed_device (closed.get(), "stylus", s, m)); });
        refuses (tactus_start_options TACTUS_START_OPTIONS, size, "TACTUS_START_OPTIONS", true,
                 [&] (auto* s, auto* m) { return isMisuse (tactus_run_start (run.get(), s, m)); });
        refuses (tactus_control TACTUS_CONTROL, size, "TACTUS_CONTROL", true,
                 [&] (auto* s, auto* m) { return isMisuse (tactus_graph_get_control (g.get(), "hardness", s, m)); });
        refuses (tactus_control TACTUS_CONTROL, size, "TACTUS_CONTROL", true,
                 [&] (auto* s, auto* m) { return isMisuse (tactus_run_get_control (run.get(), "hardness", s, m)); });
        refuses (tactus_reading TACTUS_READING, size, "TACTUS_READING", false,
                 [&] (auto* s, auto*) { return isMisuse (tactus_run_push (run.get(), "stylus", s)); });
        refuses (tactus_effort TACTUS_EFFORT, size, "TACTUS_EFFORT", false,
                 [&] (auto* s, auto*) { return isMisuse (tactus_run_take (run.get(), "stylus", s)); });
        refuses (tactus_status TACTUS_STATUS, size, "TACTUS_STATUS", false, [&] (auto* s, auto*) { return isMisuse (tactus_run_status (run.get(), s)); });
        refuses (tactus_message TACTUS_MESSAGE, size, "TACTUS_MESSAGE", false,
                 [&] (auto* s, auto*) { return isMisuse (tactus_messages_get (full.get(), 0, s)); });
    }
    CHECK (tactus_run_tick (run.get()) == TACTUS_OK);   // it was not started
}

TEST_CASE ("C API: a program that was compiled before a struct grew is served, and its memory beyond stays intact", "[c_api]")
{
    const auto g = wall();
    tactus_run_options options = TACTUS_RUN_OPTIONS;
    options.size = offsetof (tactus_run_options, log);   // as in the first version
    options.log = reinterpret_cast<const char*> (1);     // not a member for this program
    const RunHandle run { tactus_run_create (g.get(), &options, nullptr) };
    CHECK (run);
    CHECK (tactus_run_open (run.get(), nullptr) == TACTUS_OK);

    tactus_status status = TACTUS_STATUS;
    status.size = offsetof (tactus_status, is_emergency) + sizeof status.is_emergency;   // without what a compiler adds at the end
    CHECK (tactus_run_status (run.get(), &status) == TACTUS_OK);
    CHECK (status.size == offsetof (tactus_status, is_emergency) + sizeof status.is_emergency);
    status.size -= 1;
    CHECK (tactus_run_status (run.get(), &status) == TACTUS_MISUSE);
}

TEST_CASE ("C API: each thread learns why its own last call was a misuse, and the tick allocates nothing for it", "[c_api]")
{
    const auto run = pushedWall();
    CHECK (tactus_run_open (run.get(), nullptr) == TACTUS_MISUSE);
    CHECK (std::string (tactus_last_misuse()).find ("open already") != std::string::npos);
    CHECK (tactus_run_tick (nullptr) == TACTUS_MISUSE);
    CHECK (std::string (tactus_last_misuse()).find ("NULL") != std::string::npos);

    tactus_reading cleared;
    std::memset (&cleared, 0, sizeof cleared);
    const NoAllocation watch;
    const auto pushed = tactus_run_push (run.get(), "stylus", &cleared), tick = tactus_run_tick (nullptr);
    const int allocations = watch.allocations();
    CHECK (allocations == 0);
    CHECK (pushed == TACTUS_MISUSE);
    CHECK (tick == TACTUS_MISUSE);
}
