// SPDX-License-Identifier: MIT
#include "c_handles.hpp"
#include "support/waiting.hpp"

#include <framework/capi/pushed_device.hpp>
#include <support/temporary_folder.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/run.hpp>
#include <tactus/text/json.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

extern "C" int renderInC (const char* path, double* records, size_t ticks);   // c_api_c99.c
extern "C" const char* playInC (const char* path, const char* log);           // returns what went wrong, or NULL

using namespace tactus::test;

namespace
{
const std::string presets = TACTUS_SOURCE_DIR "/graphs/";

/// A tool that presses against a spring along z.
GraphHandle spring (tactus_messages* m)
{
    GraphHandle g { tactus_graph_create ("Spring", 1000.0, m) };
    REQUIRE (tactus_graph_add_node (g.get(), "", "hand", "device.position", m) == TACTUS_OK);
    REQUIRE (tactus_graph_set_key (g.get(), "", "hand", "role", "\"stylus\"", m) == TACTUS_OK);
    REQUIRE (tactus_graph_add_node (g.get(), "", "wall", "deform.plane", m) == TACTUS_OK);
    REQUIRE (tactus_graph_set_param (g.get(), "", "wall", "stiffness", "\"1 N/mm\"", m) == TACTUS_OK);
    REQUIRE (tactus_graph_add_node (g.get(), "", "motor", "device.force", m) == TACTUS_OK);
    REQUIRE (tactus_graph_set_key (g.get(), "", "motor", "role", "\"stylus\"", m) == TACTUS_OK);
    REQUIRE (tactus_graph_add_wire (g.get(), "", "hand.position -> wall.position", m) == TACTUS_OK);
    REQUIRE (tactus_graph_add_wire (g.get(), "", "wall.force -> motor.force", m) == TACTUS_OK);
    return g;
}

RunHandle pushedSpring (const char* guard, tactus_messages* m)
{
    const auto g = spring (m);
    RunHandle run { tactus_run_create (g.get(), nullptr, m) };
    REQUIRE (run);
    tactus_device_options device = TACTUS_DEVICE_OPTIONS;
    device.guard = guard;
    REQUIRE (tactus_run_pushed_device (run.get(), "stylus", &device, m) == TACTUS_OK);
    REQUIRE (tactus_run_open (run.get(), m) == TACTUS_OK);
    return run;
}

tactus_reading at (double z)
{
    tactus_reading r TACTUS_READING;
    r.valid = 1;
    r.position[2] = z;
    return r;
}

double forceZ (const tactus_run* run)
{
    tactus_effort e TACTUS_EFFORT;
    REQUIRE (tactus_run_take (run, "stylus", &e) == TACTUS_OK);
    return e.force[2];
}
}   // namespace

TEST_CASE ("C API: a graph that names a real device opens and runs, with a tool at rest", "[c_api]")
{
    const MessageList m { tactus_messages_create() };
    const std::string text = R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1000,
        "devices": { "stylus": { "driver": "hid", "profile": "pid", "calibration": { "full_force": "1 mN" }, "guard": { "max_force": "1 N" } } },
        "nodes": { "push": { "type": "signal.constant", "params": { "value": "5 N" } }, "motor": { "type": "device.force", "role": "stylus" } },
        "wires": [ "push.out -> motor.force.x" ] })";
    const GraphHandle g { tactus_graph_parse (text.c_str(), text.size(), nullptr, m.get()) };
    const RunHandle run { tactus_run_create (g.get(), nullptr, m.get()) };
    REQUIRE (run);
    CHECK (tactus_run_open (run.get(), m.get()) == TACTUS_OK);
    CHECK (tactus_messages_have_errors (m.get()) == 0);
    CHECK (said (m).find ("device/not_by_graph") != std::string::npos);
    CHECK (tactus_run_steps (run.get(), 10, nullptr, nullptr) == TACTUS_OK);
}

TEST_CASE ("C API: a loop of your own can say that ticks were late, and the guard counts seconds", "[c_api][safety]")
{
    const MessageList m { tactus_messages_create() };
    const auto run = pushedSpring (R"({ "watchdog": "20 ms" })", m.get());
    const auto reading = at (-1e-3);
    REQUIRE (tactus_run_push (run.get(), "stylus", &reading) == TACTUS_OK);
    CHECK (tactus_run_tick_after (run.get(), -1.0) == TACTUS_MISUSE);
    CHECK (tactus_run_tick_after (run.get(), std::nan ("")) == TACTUS_MISUSE);
    for (int k = 0; k < 10; ++k)   // the reading becomes 18 ms old
        REQUIRE (tactus_run_tick_after (run.get(), 2e-3) == TACTUS_OK);
    CHECK (forceZ (run.get()) == Approx (1.0));
    for (int k = 0; k < 6; ++k)
        REQUIRE (tactus_run_tick_after (run.get(), 2e-3) == TACTUS_OK);
    CHECK (forceZ (run.get()) == 0.0);
}

TEST_CASE ("C API: a stop leaves no force behind in a run that the program ticks itself", "[c_api][safety]")
{
    const MessageList m { tactus_messages_create() };
    const auto run = pushedSpring (nullptr, m.get());
    const auto reading = at (-1e-3);
    REQUIRE (tactus_run_push (run.get(), "stylus", &reading) == TACTUS_OK);
    REQUIRE (tactus_run_tick (run.get()) == TACTUS_OK);
    REQUIRE (forceZ (run.get()) == Approx (1.0));
    REQUIRE (tactus_run_stop (run.get()) == TACTUS_OK);
    CHECK (forceZ (run.get()) == 0.0);
    CHECK (tactus_run_tick (run.get()) == TACTUS_MISUSE);
}

TEST_CASE ("C API: a pushed device that was refused is gone, and nothing touches it any more", "[c_api][safety]")
{
    const MessageList m { tactus_messages_create() };
    const auto g = spring (m.get());
    REQUIRE (tactus_graph_set_device (g.get(), "stylus", R"({ "driver": "sim", "guard": { "max_slew": "5 N/s" } })", m.get()) == TACTUS_OK);
    const RunHandle run { tactus_run_create (g.get(), nullptr, m.get()) };
    REQUIRE (tactus_run_pushed_device (run.get(), "stylus", nullptr, m.get()) == TACTUS_OK);
    REQUIRE (tactus_run_open (run.get(), m.get()) == TACTUS_FAILED);
    CHECK (said (m).find ("device/slow_stop") != std::string::npos);
    const auto reading = at (0.0);
    CHECK (tactus_run_push (run.get(), "stylus", &reading) == TACTUS_MISUSE);
    CHECK (tactus_run_stop (run.get()) == TACTUS_OK);
}

TEST_CASE ("C API: in real time, a reading that is not renewed ages by the clock, even if ticks are lost", "[c_api][safety]")
{
    tactus::capi::PushedDevice device { {} };
    device.prepare (1e-3);
    device.useClock();
    const auto reading = at (0.0);
    device.push (reading);
    CHECK (device.read().age == 0.0);
    letPass (std::chrono::milliseconds (15));   // at 1 kHz, 15 ticks, of which one comes
    CHECK (device.read().age >= 0.015);
    device.push (reading);
    CHECK (device.read().age == 0.0);
}

TEST_CASE ("C API: a render has the same bits as the engine in C++", "[c_api]")
{
    for (const std::string preset : { "dry_wood", "padded_bench", "two_fingers" })
    {
        CAPTURE (preset);
        constexpr size_t ticks = 2000;
        const auto path = presets + preset + ".json";

        const MessageList m { tactus_messages_create() };
        const GraphHandle g { tactus_graph_load (path.c_str(), m.get()) };
        const RunHandle run { tactus_run_create (g.get(), nullptr, m.get()) };
        REQUIRE (tactus_run_open (run.get(), m.get()) == TACTUS_OK);
        const auto width = tactus_run_record_count (run.get());
        std::vector<double> records (ticks * width);
        REQUIRE (tactus_run_steps (run.get(), ticks, nullptr, records.data()) == TACTUS_OK);
        CHECK (tactus_run_duration (run.get()) > 0.0);

        const auto loaded = tactus::loadGraph (path);
        tactus::Run own { tactus::catalogue(), {}, [&] (const std::string& role, const auto& graph, const auto&, auto&) {
                             auto made = tactus::makeDevice (*graph.device (role), graph.folder);
                             return tactus::Run::RoleDevice { std::move (made.device), made.limits };
                         } };
        tactus::Messages messages;
        REQUIRE_FALSE (tactus::hasErrors (own.load (loaded.graph)));
        own.openDevices (loaded.graph, messages);
        size_t differing = 0;
        double largest = 0.0;
        for (size_t k = 0; k < ticks; ++k)
        {
            own.tick();
            const auto& taps = own.engine().plan().taps();
            REQUIRE (taps.size() == width);
            for (size_t i = 0; i < width; ++i)
            {
                differing += std::memcmp (taps[i].value, &records[k * width + i], sizeof (double)) != 0;
                largest = std::max (largest, std::abs (*taps[i].value));
            }
        }
        CHECK (differing == 0);
        CHECK (largest > 0.0);
        CHECK (std::string (tactus_run_record_name (run.get(), 0)).find ('.') != std::string::npos);
    }
}

TEST_CASE ("C API: a program in C99 renders a preset", "[c_api]")
{
    std::vector<double> records (12'000);
    REQUIRE (renderInC ((presets + "dry_wood.json").c_str(), records.data(), 4000) == 0);
    CHECK (std::any_of (records.begin(), records.end(), [] (double v) { return v != 0.0; }));
}

TEST_CASE ("C API: a program in C99 plays a device of its own, turns and probes it, and logs it", "[c_api]")
{
    const TemporaryFolder folder;
    const auto log = (folder / "run.jsonl").string();
    const char* wrong = playInC ((presets + "dry_wood.json").c_str(), log.c_str());
    INFO ((wrong != nullptr ? wrong : ""));
    CHECK (wrong == nullptr);
    CHECK (std::filesystem::file_size (log) > 1000);
}

TEST_CASE ("C API: a graph that is built by edits is the same as its text, and each edit can be undone", "[c_api]")
{
    const MessageList m { tactus_messages_create() };
    const auto g = spring (m.get());
    const Text text { tactus_graph_text (g.get()) };
    const GraphHandle again { tactus_graph_parse (text.get(), std::strlen (text.get()), nullptr, m.get()) };
    REQUIRE (again);
    CHECK (std::string (Text { tactus_graph_text (again.get()) }.get()) == text.get());

    REQUIRE (tactus_graph_remove_wire (g.get(), "", "wall.force -> motor.force", m.get()) == TACTUS_OK);
    CHECK (std::string (Text { tactus_graph_text (g.get()) }.get()) != text.get());
    CHECK (tactus_graph_undo (g.get()) == 1);
    CHECK (std::string (Text { tactus_graph_text (g.get()) }.get()) == text.get());
    CHECK (tactus_graph_redo (g.get()) == 1);
    int steps = 0;
    while (tactus_graph_undo (g.get()) == 1)
        ++steps;
    CHECK (steps == 9);
}

TEST_CASE ("C API: a batch of edits is one step, and one that fails changes nothing", "[c_api]")
{
    const MessageList m { tactus_messages_create() };
    const auto g = spring (m.get());
    const Text text { tactus_graph_text (g.get()) };
    const auto isUnchanged = [&] { return std::string (Text { tactus_graph_text (g.get()) }.get()) == text.get(); };

    const auto rewire = [] (tactus_graph* graph, void*) {
        CHECK (tactus_graph_perform_all (
                   graph, "inner", [] (tactus_graph*, void*) { return TACTUS_OK; }, nullptr, nullptr)
               == TACTUS_MISUSE);
        CHECK (tactus_graph_undo (graph) == 0);
        const auto removed = tactus_graph_remove_wire (graph, "", "wall.force -> motor.force", nullptr);
        return removed == TACTUS_OK ? tactus_graph_add_node (graph, "", "more", "signal.gain", nullptr) : removed;
    };
    REQUIRE (tactus_graph_perform_all (g.get(), "rewire", rewire, nullptr, m.get()) == TACTUS_OK);
    CHECK_FALSE (isUnchanged());
    CHECK (tactus_graph_undo (g.get()) == 1);
    CHECK (isUnchanged());

    const auto fails = [] (tactus_graph* graph, void* own) {
        CHECK (tactus_graph_add_node (graph, "", "more", "signal.gain", nullptr) == TACTUS_OK);
        (void)tactus_graph_set_param (graph, "", "nobody", "gain", "2", nullptr);   // ignores that it fails
        *static_cast<int*> (own) += 1;
        return TACTUS_OK;
    };
    int calls = 0;
    CHECK (tactus_graph_perform_all (g.get(), "fails", fails, &calls, m.get()) == TACTUS_FAILED);
    CHECK (calls == 1);
    tactus_message why = TACTUS_MESSAGE;
    REQUIRE (tactus_messages_get (m.get(), tactus_messages_count (m.get()) - 1, &why) == TACTUS_OK);
    CHECK (std::string (why.id) == "edit/unknown_node");
    CHECK (isUnchanged());

    const auto stops = [] (tactus_graph* graph, void*) {
        CHECK (tactus_graph_add_node (graph, "", "more", "signal.gain", nullptr) == TACTUS_OK);
        return TACTUS_MISUSE;
    };
    CHECK (tactus_graph_perform_all (g.get(), "stops", stops, nullptr, m.get()) == TACTUS_MISUSE);
    CHECK (isUnchanged());
    CHECK (tactus_graph_perform_all (g.get(), "none", nullptr, nullptr, m.get()) == TACTUS_MISUSE);
    CHECK (tactus_graph_add_node (g.get(), "", "more", "signal.gain", m.get()) == TACTUS_OK);   // the graph is in no batch
}

TEST_CASE ("C API: a problem is reported with its id, place and remedy", "[c_api]")
{
    const MessageList m { tactus_messages_create() };
    CHECK (tactus_graph_load ("/nowhere/graph.json", m.get()) == nullptr);
    REQUIRE (tactus_messages_count (m.get()) == 1);
    CHECK (tactus_messages_have_errors (m.get()) == 1);
    tactus_message message = TACTUS_MESSAGE;
    REQUIRE (tactus_messages_get (m.get(), 0, &message) == TACTUS_OK);
    CHECK (std::string (message.id) == "file/unreadable");
    CHECK (message.text[0] != '\0');
    CHECK (message.remedy[0] != '\0');
    CHECK (tactus_messages_get (m.get(), 1, &message) == TACTUS_MISUSE);

    const auto lastId = [&] {
        tactus_messages_get (m.get(), tactus_messages_count (m.get()) - 1, &message);
        return std::string (message.id);
    };
    const auto g = spring (m.get());
    CHECK (tactus_graph_add_wire (g.get(), "", "wall.force motor.force", m.get()) == TACTUS_FAILED);
    CHECK (lastId() == "wire/syntax");
    CHECK (tactus_graph_remove_wire (g.get(), "", "wall.force -> hand.position", m.get()) == TACTUS_FAILED);
    CHECK (lastId() == "edit/unknown_wire");
    CHECK (tactus_graph_set_param (g.get(), "", "wall", "stiffness", "{", m.get()) == TACTUS_FAILED);
    CHECK (lastId() == "api/value");
    CHECK (tactus_graph_create ("x", std::nan (""), m.get()) == nullptr);
    CHECK (lastId() == "api/rate");
    const RunHandle run { tactus_run_create (g.get(), nullptr, m.get()) };
    CHECK (tactus_run_device (run.get(), "finger", "sim", m.get()) == TACTUS_FAILED);
    CHECK (lastId() == "api/unknown_role");
    tactus_device_options device = TACTUS_DEVICE_OPTIONS;
    device.guard = "{\"max_slew\": 1}";
    CHECK (tactus_run_pushed_device (run.get(), "stylus", &device, m.get()) == TACTUS_FAILED);
    CHECK (lastId() == "device/slow_stop");
    tactus_run_options options = TACTUS_RUN_OPTIONS;
    const char* records[] = { "wall.colour" };
    options.records = records;
    options.record_count = 1;
    CHECK (tactus_run_create (g.get(), &options, m.get()) == nullptr);
}

TEST_CASE ("C API: a pushed device is guarded, and silence removes its force", "[c_api]")
{
    const MessageList m { tactus_messages_create() };
    const auto run = pushedSpring ("{\"max_force\": \"2 N\", \"watchdog\": \"20 ms\"}", m.get());
    tactus_run_tick (run.get());
    CHECK (forceZ (run.get()) == 0.0);   // no reading has been pushed yet

    auto reading = at (-0.001);
    for (int k = 0; k < 50; ++k)
    {
        tactus_run_push (run.get(), "stylus", &reading);
        tactus_run_tick (run.get());
    }
    CHECK (forceZ (run.get()) == Approx (1.0));
    reading = at (-0.010);
    tactus_run_push (run.get(), "stylus", &reading);
    tactus_run_tick (run.get());
    CHECK (forceZ (run.get()) == Approx (2.0));   // the guard limits the 10 N of the spring
    for (int k = 0; k < 50; ++k)
        tactus_run_tick (run.get());
    CHECK (forceZ (run.get()) == 0.0);
}

TEST_CASE ("C API: an emergency stop removes the force until it is rearmed", "[c_api]")
{
    const MessageList m { tactus_messages_create() };
    const auto run = pushedSpring (nullptr, m.get());
    const auto reading = at (-0.001);
    const auto play = [&] (int ticks) {
        for (int k = 0; k < ticks; ++k)
        {
            tactus_run_push (run.get(), "stylus", &reading);
            tactus_run_tick (run.get());
        }
        return forceZ (run.get());
    };
    CHECK (play (10) == Approx (1.0));
    tactus_run_emergency_stop (run.get());
    CHECK (play (50) == 0.0);
    tactus_status status = TACTUS_STATUS;
    tactus_run_status (run.get(), &status);
    CHECK (status.is_emergency == 1);
    tactus_run_rearm (run.get());
    CHECK (play (2000) == Approx (1.0));
}

TEST_CASE ("C API: feeds drive ports, parameters are set, and an edit takes over without a step", "[c_api]")
{
    const MessageList m { tactus_messages_create() };
    const auto g = spring (m.get());
    const char* feeds[] = { "wall.position.z" };
    const char* records[] = { "wall.force.z" };
    tactus_run_options options = TACTUS_RUN_OPTIONS;
    options.feeds = feeds;
    options.feed_count = 1;
    options.records = records;
    options.record_count = 1;
    const RunHandle run { tactus_run_create (g.get(), &options, m.get()) };
    REQUIRE (run);
    REQUIRE (tactus_run_open (run.get(), m.get()) == TACTUS_OK);
    const std::vector<double> depth (200, -0.002);
    std::vector<double> force (200);
    REQUIRE (tactus_run_steps (run.get(), 200, depth.data(), force.data()) == TACTUS_OK);
    CHECK (force.back() == Approx (2.0));

    REQUIRE (tactus_run_set (run.get(), "wall.stiffness", 500.0, m.get()) == TACTUS_OK);
    REQUIRE (tactus_run_steps (run.get(), 200, depth.data(), force.data()) == TACTUS_OK);
    CHECK (force.back() == Approx (1.0));
    CHECK (tactus_run_set (run.get(), "wall.hardness", 1.0, m.get()) == TACTUS_FAILED);

    REQUIRE (tactus_graph_set_param (g.get(), "", "wall", "stiffness", "250", m.get()) == TACTUS_OK);
    REQUIRE (tactus_run_edit (run.get(), g.get(), m.get()) == TACTUS_OK);
    REQUIRE (tactus_run_steps (run.get(), 200, depth.data(), force.data()) == TACTUS_OK);
    CHECK (force.front() > 0.9);   // the force fades from 1 N to 0.5 N
    CHECK (force.back() == Approx (0.5));
}

TEST_CASE ("C API: a graph that is read again continues where the one that plays is", "[c_api]")
{
    const MessageList m { tactus_messages_create() };
    const auto read = [&] (const std::string& more) {
        const std::string text = R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1000, "nodes": { )" + more +
                                 R"("wave": { "type": "signal.lfo", "params": { "shape": "saw", "frequency": "1 Hz" } }, "louder": { "type": "signal.gain" } },
            "wires": [ "wave.out -> louder.in" ] })";
        return GraphHandle { tactus_graph_parse (text.c_str(), text.size(), nullptr, m.get()) };
    };
    const char* records[] = { "louder.out" };
    tactus_run_options options = TACTUS_RUN_OPTIONS;
    options.records = records;
    options.record_count = 1;
    const auto g = read ("");
    const RunHandle run { tactus_run_create (g.get(), &options, m.get()) };
    INFO (said (m));
    REQUIRE (tactus_run_open (run.get(), m.get()) == TACTUS_OK);
    std::vector<double> before (300), after (100);
    REQUIRE (tactus_run_steps (run.get(), before.size(), nullptr, before.data()) == TACTUS_OK);
    const auto again = read (R"("idle": { "type": "signal.constant" }, )");
    REQUIRE (tactus_run_edit (run.get(), again.get(), m.get()) == TACTUS_OK);
    REQUIRE (tactus_run_steps (run.get(), after.size(), nullptr, after.data()) == TACTUS_OK);
    CHECK (before.back() == Approx (2 * 0.299).margin (0.003));
    CHECK (after.front() == Approx (2 * 0.3).margin (0.003));
}

TEST_CASE ("C API: a graph that is read from text gets the files that it includes from the program", "[c_api]")
{
    const MessageList m { tactus_messages_create() };
    const auto read = [&] (const std::string& body) {
        const auto text = R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1000, )" + body + " }";
        return GraphHandle { tactus_graph_parse (text.c_str(), text.size(), nullptr, m.get()) };
    };
    const auto part = read (R"("nodes": { "three": { "type": "signal.constant", "params": { "value": 3 } } }, "expose": { "outputs": { "out": "three.out" } })");
    const auto g = read (R"("nodes": { "a": { "type": "file:part.json" }, "b": { "type": "signal.gain" } }, "wires": [ "a.out -> b.in" ])");
    const char* records[] = { "b.out" };
    tactus_run_options options = TACTUS_RUN_OPTIONS;
    options.records = records;
    options.record_count = 1;
    CHECK (RunHandle { tactus_run_create (g.get(), &options, m.get()) } == nullptr);
    CHECK (tactus_graph_set_file (g.get(), nullptr, part.get(), m.get()) == TACTUS_MISUSE);
    REQUIRE (tactus_graph_set_file (g.get(), "part.json", part.get(), m.get()) == TACTUS_OK);
    tactus_messages_clear (m.get());
    const RunHandle run { tactus_run_create (g.get(), &options, m.get()) };
    INFO (said (m));
    REQUIRE (run);
    REQUIRE (tactus_run_open (run.get(), m.get()) == TACTUS_OK);
    double out = 0.0;
    REQUIRE (tactus_run_steps (run.get(), 1, nullptr, &out) == TACTUS_OK);
    CHECK (out == 3.0);
}

TEST_CASE ("C API: a run in real time records every tick, and ends at rest", "[c_api]")
{
    const MessageList m { tactus_messages_create() };
    const GraphHandle g { tactus_graph_load ((presets + "dry_wood.json").c_str(), m.get()) };
    const RunHandle run { tactus_run_create (g.get(), nullptr, m.get()) };
    REQUIRE (tactus_run_open (run.get(), m.get()) == TACTUS_OK);
    tactus_start_options start = TACTUS_START_OPTIONS;
    start.length = 400;
    start.buffer = 100'000;
    REQUIRE (tactus_run_start (run.get(), &start, m.get()) == TACTUS_OK);
    CHECK (tactus_run_tick (run.get()) == TACTUS_MISUSE);   // the tick thread ticks this run
    tactus_status status = TACTUS_STATUS;
    do
    {
        letPass (std::chrono::milliseconds (5));
        CHECK (tactus_run_attend (run.get(), m.get()) == TACTUS_OK);
        tactus_run_status (run.get(), &status);
    } while (status.phase != TACTUS_OVER);
    REQUIRE (tactus_run_stop (run.get()) == TACTUS_OK);
    CHECK (status.ticks >= 400);
    CHECK (status.force == 0.0);
    std::vector<double> rows (tactus_run_record_count (run.get()) * 1000);
    size_t count = 0;
    while (const auto more = tactus_run_collect (run.get(), rows.data(), 1000))
        count += more;
    CHECK (count >= 400);
    CHECK (tactus_run_lost (run.get()) == 0);
}

TEST_CASE ("C API: null handles and pointers are refused, and freeing null does nothing", "[c_api]")
{
    tactus_messages_free (nullptr);
    tactus_graph_free (nullptr);
    tactus_run_free (nullptr);
    tactus_text_free (nullptr);
    CHECK (tactus_messages_count (nullptr) == 0);
    CHECK (tactus_graph_text (nullptr) == nullptr);
    CHECK (tactus_graph_add_node (nullptr, "", "a", "signal.add", nullptr) == TACTUS_MISUSE);
    CHECK (tactus_run_create (nullptr, nullptr, nullptr) == nullptr);
    CHECK (tactus_run_tick (nullptr) == TACTUS_MISUSE);
    CHECK (tactus_run_open (nullptr, nullptr) == TACTUS_MISUSE);
    CHECK (tactus_run_emergency_stop (nullptr) == TACTUS_MISUSE);
    CHECK (tactus_run_collect (nullptr, nullptr, 1) == 0);
    CHECK (tactus_run_role (nullptr, 0) == nullptr);
}

TEST_CASE ("C API: the datasheets of all nodes are listed as JSON", "[c_api]")
{
    const Text text { tactus_nodes_json() };
    const auto all = tactus::Json::parse (text.get());
    size_t count = 0;
    for (const auto& type : tactus::catalogue())
        count += ! type.info.id.empty();
    CHECK (all.size() == count);
    CHECK (all[0].contains ("inputs"));
    CHECK (tactus_api_version() == TACTUS_API_VERSION);
    CHECK (std::string (tactus_version()).find ('.') != std::string::npos);
}
