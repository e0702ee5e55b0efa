// SPDX-License-Identifier: MIT
// Controls, vectors and choices through the C API.
#include "c_handles.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace tactus::test;

namespace
{
const std::string text = R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1000,
    "nodes": { "wave": { "type": "signal.lfo", "params": { "frequency": "1 Hz" } }, "push": { "type": "vector.from_frame" } },
    "controls": { "pace": { "name": "Pace", "value": 0.25, "to": { "wave.frequency": [1, 5] } }, "size": { "to": { "wave.amplitude": [0, 2] } } } })";

GraphHandle waves (const MessageList& m) { return GraphHandle { tactus_graph_parse (text.c_str(), text.size(), nullptr, m.get()) }; }

RunHandle opened (const tactus_graph* g, const MessageList& m, const char* record, const char* set = nullptr)
{
    tactus_run_options options = TACTUS_RUN_OPTIONS;
    options.records = &record;
    options.record_count = 1;
    options.sets = &set;
    options.set_count = set != nullptr;
    RunHandle run { tactus_run_create (g, &options, m.get()) };
    INFO (said (m));
    REQUIRE (run);
    REQUIRE (tactus_run_open (run.get(), m.get()) == TACTUS_OK);
    return run;
}

/// The first `width` records after many ticks, when all ramps have ended.
std::vector<double> settled (tactus_run* run)
{
    const auto width = tactus_run_record_count (run);
    std::vector<double> rows (200 * width);
    REQUIRE (tactus_run_steps (run, 200, nullptr, rows.data()) == TACTUS_OK);
    return { rows.end() - static_cast<std::ptrdiff_t> (width), rows.end() };
}

double valueOf (const tactus_run* run, const char* id)
{
    tactus_control control = TACTUS_CONTROL;
    REQUIRE (tactus_run_get_control (run, id, &control, nullptr) == TACTUS_OK);
    return control.value;
}

std::string lastId (const MessageList& m)
{
    const auto all = said (m);
    const auto last = all.substr (0, all.size() - 1).rfind ('\n') + 1;
    return all.substr (last, all.find (':', last) - last);
}
}   // namespace

TEST_CASE ("C API: a program lists the controls of a graph, and sets one as an undo step", "[c_api]")
{
    const MessageList m { tactus_messages_create() };
    const auto g = waves (m);
    REQUIRE (g);
    REQUIRE (tactus_graph_control_count (g.get()) == 2);
    CHECK (std::string (tactus_graph_control_id (g.get(), 1)) == "size");
    CHECK (tactus_graph_control_id (g.get(), 2) == nullptr);
    const auto pace = [&] {
        tactus_control control = TACTUS_CONTROL;
        REQUIRE (tactus_graph_get_control (g.get(), "pace", &control, m.get()) == TACTUS_OK);
        CHECK (std::string (control.id) == "pace");
        CHECK (std::string (control.name) == "Pace");
        return control.value;
    };
    CHECK (pace() == 0.25);
    REQUIRE (tactus_graph_set_control (g.get(), "pace", 1.0, m.get()) == TACTUS_OK);
    CHECK (pace() == 1.0);
    CHECK (tactus_graph_undo (g.get()) == 1);
    CHECK (pace() == 0.25);

    for (const double wrong : { -0.1, 1.1, std::nan (""), std::numeric_limits<double>::infinity() })
    {
        CHECK (tactus_graph_set_control (g.get(), "pace", wrong, m.get()) == TACTUS_FAILED);
        CHECK (lastId (m) == "control/value");
    }
    CHECK (tactus_graph_set_control (g.get(), "pase", 0.5, m.get()) == TACTUS_FAILED);
    CHECK (lastId (m) == "control/unknown");
    CHECK (said (m).find ("did you mean 'pace'") != std::string::npos);
    tactus_control control = TACTUS_CONTROL;
    CHECK (tactus_graph_get_control (g.get(), nullptr, &control, m.get()) == TACTUS_FAILED);
    CHECK (pace() == 0.25);
}

TEST_CASE ("C API: a turned control of a run moves its parameters, and says where it stands", "[c_api]")
{
    const MessageList m { tactus_messages_create() };
    const auto g = waves (m);
    const auto run = opened (g.get(), m, "wave.out");
    REQUIRE (tactus_run_control_count (run.get()) == 2);
    CHECK (std::string (tactus_run_control_id (run.get(), 0)) == "pace");
    CHECK (valueOf (run.get(), "pace") == 0.25);
    REQUIRE (tactus_run_turn (run.get(), "size", 0.0, m.get()) == TACTUS_OK);
    CHECK (valueOf (run.get(), "size") == 0.0);
    CHECK (settled (run.get()).front() == 0.0);   // an amplitude of 0
    REQUIRE (tactus_run_turn (run.get(), "size", 1.0, m.get()) == TACTUS_OK);
    CHECK (settled (run.get()).front() != 0.0);

    CHECK (tactus_run_turn (run.get(), "size", std::nan (""), m.get()) == TACTUS_FAILED);
    CHECK (lastId (m) == "control/value");
    CHECK (tactus_run_turn (run.get(), "volume", 0.5, m.get()) == TACTUS_FAILED);
    CHECK (lastId (m) == "control/unknown");
    CHECK (tactus_run_turn (run.get(), nullptr, 0.5, m.get()) == TACTUS_MISUSE);
    CHECK (valueOf (run.get(), "size") == 1.0);
}

TEST_CASE ("C API: a control stands where the last of --set, a turn and an edit has put it", "[c_api]")
{
    const MessageList m { tactus_messages_create() };
    const auto g = waves (m);
    CHECK (valueOf (opened (g.get(), m, "wave.out", "pace=0.75").get(), "pace") == 0.75);

    const auto run = opened (g.get(), m, "wave.out");
    REQUIRE (tactus_run_turn (run.get(), "pace", 0.5, m.get()) == TACTUS_OK);
    REQUIRE (tactus_graph_set_control (g.get(), "size", 0.0, m.get()) == TACTUS_OK);
    REQUIRE (tactus_run_edit (run.get(), g.get(), m.get()) == TACTUS_OK);
    CHECK (valueOf (run.get(), "pace") == 0.5);   // the edit does not touch it
    CHECK (valueOf (run.get(), "size") == 0.0);
    CHECK (settled (run.get()).front() == 0.0);
    REQUIRE (tactus_graph_set_control (g.get(), "pace", 1.0, m.get()) == TACTUS_OK);
    REQUIRE (tactus_run_edit (run.get(), g.get(), m.get()) == TACTUS_OK);
    CHECK (valueOf (run.get(), "pace") == 1.0);
}

TEST_CASE ("C API: a vector is set as a whole or by component, all of it or nothing", "[c_api]")
{
    const MessageList m { tactus_messages_create() };
    const auto g = waves (m);
    const auto run = opened (g.get(), m, "push.out");
    const double three[] = { 1.0, -2.0, 3.0 }, broken[] = { 7.0, std::nan (""), 7.0 };
    REQUIRE (tactus_run_set_vector (run.get(), "push.origin", three, 3, m.get()) == TACTUS_OK);
    CHECK (settled (run.get()) == std::vector<double> { 1.0, -2.0, 3.0 });
    REQUIRE (tactus_run_set (run.get(), "push.origin.y", 5.0, m.get()) == TACTUS_OK);
    CHECK (settled (run.get()) == std::vector<double> { 1.0, 5.0, 3.0 });
    REQUIRE (tactus_run_set_value (run.get(), "push.origin", "[0, 0, 1]", m.get()) == TACTUS_OK);
    CHECK (settled (run.get()) == std::vector<double> { 0.0, 0.0, 1.0 });

    CHECK (tactus_run_set_vector (run.get(), "push.origin", broken, 3, m.get()) == TACTUS_FAILED);
    CHECK (tactus_run_set_vector (run.get(), "push.origin", three, 2, m.get()) == TACTUS_FAILED);
    CHECK (tactus_run_set_vector (run.get(), "push.origin", three, 0, m.get()) == TACTUS_FAILED);
    CHECK (tactus_run_set_vector (run.get(), "wave.frequency", three, 3, m.get()) == TACTUS_FAILED);
    CHECK (tactus_run_set_vector (run.get(), "push.colour", three, 3, m.get()) == TACTUS_FAILED);
    CHECK (tactus_run_set_vector (run.get(), "push.origin", nullptr, 3, m.get()) == TACTUS_MISUSE);
    CHECK (tactus_run_set_value (run.get(), "push.origin", "3 N", m.get()) == TACTUS_FAILED);
    CHECK (settled (run.get()) == std::vector<double> { 0.0, 0.0, 1.0 });
}

TEST_CASE ("C API: a choice is set by its name, and a wrong name lists the right ones", "[c_api]")
{
    const MessageList m { tactus_messages_create() };
    const auto g = waves (m);
    const auto run = opened (g.get(), m, "wave.out");
    for (const char* name : { "square", "\"square\"" })   // also as in JSON
    {
        REQUIRE (tactus_run_set_value (run.get(), "wave.shape", "sine", m.get()) == TACTUS_OK);
        REQUIRE (tactus_run_set_value (run.get(), "wave.shape", name, m.get()) == TACTUS_OK);
        CHECK (std::abs (settled (run.get()).front()) == Approx (1.0));   // a square wave is at its peak all the time
    }
    CHECK (tactus_run_set_value (run.get(), "wave.shape", "squar", m.get()) == TACTUS_FAILED);
    CHECK (lastId (m) == "param/unknown_choice");
    CHECK (said (m).find ("did you mean 'square'") != std::string::npos);
    CHECK (tactus_run_set_value (run.get(), "wave.frequency", "3 N", m.get()) == TACTUS_FAILED);
    CHECK (lastId (m) == "param/unit");
    CHECK (tactus_run_set_value (run.get(), "wave.frequency", "2 kHz", m.get()) == TACTUS_OK);
    CHECK (tactus_run_set_value (run.get(), "wave.frequency", nullptr, m.get()) == TACTUS_MISUSE);
}
