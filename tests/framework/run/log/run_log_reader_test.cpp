// SPDX-License-Identifier: MIT
#include "support/corpus.hpp"

#include <fuzz/run_log_target.hpp>
#include <tactus/run/log/run_log_reader.hpp>

#include <catch2/catch.hpp>

#include <sstream>

using namespace tactus;

namespace
{
const std::string head = R"({"format":"tactus-run","version":1,"program":"test","rate_hz":1000.0,)"
                         R"("feeds":["a.in"],"guards":{"stylus":{"max_force":2.5,"watchdog":"inf"}}})"
                         "\n";
const std::string first = R"({"tick":0,"graph":{},"feed":[1.0]})"
                          "\n";

Result<RunLogReader> opened (const std::string& text) { return RunLogReader::open (std::make_unique<std::istringstream> (text), "run.jsonl"); }

/// The id and location of the first error in a log.
std::string problem (const std::string& text)
{
    auto log = opened (text);
    if (! log) return log.error().id + " " + log.error().where;
    for (;;)
    {
        const auto line = log->next();
        if (! line) return line.error().id + " " + line.error().where;
        if (! *line) return "";
    }
}
}   // namespace

TEST_CASE ("a log reports changes, and everything else keeps its last value", "[runlog]")
{
    const std::string lines = R"({"tick":3,"turn":{"drag.mu":0.5,"a.b":"nan"},"late":[7,9],"kept":["x.y"],"guards":{"thumb":{"max_force":1}},)"
                              R"("halt":true,"read":{"stylus":{"position":[1,-0.0,"inf"],"valid":0}},"feed":["-inf"]})"
                              "\n"
                              R"({"tick":4,"read":{"stylus":{"pressure":2}},"something_new":[1,{}]})"
                              "\n"
                              R"({"tick":9,"end":true})"
                              "\n";
    auto log = *opened (head + first + lines + "never read");
    CHECK (log.head().guards.at ("stylus").max_force == 2.5);
    CHECK (log.head().guards.at ("stylus").watchdog == GuardLimits::none);
    CHECK (log.head().guards.at ("stylus").ramp == 0.0);
    const auto zero = **log.next();
    CHECK (zero.graph);
    CHECK (zero.feed == std::vector<double> { 1.0 });
    const auto three = **log.next();
    CHECK (three.tick == 3);
    CHECK (three.line == 3);
    REQUIRE (three.turns.size() == 2);
    CHECK (three.turns[0] == std::pair<std::string, double> { "drag.mu", 0.5 });
    CHECK (std::isnan (three.turns[1].second));
    CHECK (three.late == std::vector<std::uint64_t> { 7, 9 });
    CHECK (three.halt == true);
    CHECK (three.kept == std::vector<std::string> { "x.y" });
    CHECK (three.guards.at ("thumb").max_force == 1.0);
    REQUIRE (three.readings.size() == 1);
    CHECK (three.readings[0].second.position.x() == 1.0);
    CHECK (std::signbit (three.readings[0].second.position.y()));
    CHECK (std::isinf (three.readings[0].second.position.z()));
    CHECK_FALSE (three.readings[0].second.valid);
    CHECK (std::isinf ((*three.feed)[0]));
    const auto four = **log.next();
    CHECK (four.readings[0].second.pressure == 2.0);
    CHECK (four.readings[0].second.position.x() == 1.0);
    CHECK_FALSE (four.feed);
    CHECK_FALSE (four.halt);
    CHECK ((**log.next()).last == RunTick::Last::end);
    CHECK_FALSE (*log.next());
    CHECK_FALSE (log.isCutOff());
}

TEST_CASE ("a log records the other parts of a device, the readings that were used, and emergency stops", "[runlog]")
{
    auto log = *opened (R"({"format":"tactus-run","version":2,"rate_hz":1000.0,"guards":{"pad":{"max_speed":1.5,"dead_man_buttons":5}},)"
                        R"("devices":{"pad":{"axes":["a","b"],"efforts":["b"],"buttons":["","grip"],"signal_inputs":1,"signal_outputs":2}}})"
                        "\n"
                        R"({"tick":0,"graph":{},"read":{"pad":{"axes":[0.5,"nan"],"signals":[2]}}})"
                        "\n"
                        R"({"tick":4,"rearm":true,"emergency":true,"devices":{"thumb":{"axes":["c"]}},"read":{"pad":{"axes":[]}}})"
                        "\n");
    CHECK (log.head().guards.at ("pad").max_speed == 1.5);
    CHECK (log.head().guards.at ("pad").dead_man_buttons == 5);
    const DeviceLayout pad { .axes = { "a", "b" }, .efforts = { "b" }, .buttons = { "", "grip" }, .signal_inputs = 1, .signal_outputs = 2 };
    CHECK (log.head().devices.at ("pad") == pad);
    const auto zero = **log.next();
    const auto& read = zero.readings.at (0).second;
    CHECK (read.axes.size() == 2);
    CHECK (read.axes[0] == 0.5);
    CHECK (std::isnan (read.axes[1]));
    CHECK (read.signals[0] == 2.0);
    CHECK_FALSE (zero.rearm);
    CHECK_FALSE (zero.emergency);
    const auto four = **log.next();
    CHECK (four.rearm);
    CHECK (four.emergency);
    CHECK (four.devices.at ("thumb").axes == std::vector<std::string> { "c" });
    CHECK (four.readings.at (0).second.axes.size() == 0);
    CHECK (four.readings.at (0).second.signals[0] == 2.0);

    const auto head_with = [] (const std::string& what) { return problem (R"({"format":"tactus-run","version":2,"rate_hz":1000.0,)" + what + "}\n"); };
    CHECK (head_with (R"("devices":{"a":{"axes":[1]}})").starts_with ("log/value"));
    CHECK (head_with (R"("devices":{"a":{"signal_inputs":33}})").starts_with ("log/value"));
    CHECK (head_with (R"("devices":{"a":{"signal_inputs":18446744073709551615}})").starts_with ("log/value"));
    CHECK (head_with (R"("guards":{"a":{"dead_man_buttons":-1}})").starts_with ("log/value"));
    std::string many = "0";
    for (int i = 0; i < Channels::most; ++i)
        many += ",0";
    CHECK (problem (head + first + R"({"tick":1,"read":{"stylus":{"axes":[)" + many + "]}}}\n").starts_with ("log/value"));
}

TEST_CASE ("the log of a program that died is read up to its last complete line", "[runlog]")
{
    for (const std::string rest : { "", "{\"tick\":1", "{\"tick\":1,\"halt\":true}" })
    {
        auto log = *opened (head + first + rest);
        CHECK ((**log.next()).tick == 0);
        CHECK_FALSE (*log.next());
        CHECK (log.isCutOff());
    }
}

TEST_CASE ("problems in a log are reported with line and column", "[runlog]")
{
    const auto after = [] (const std::string& line) { return problem (head + first + line + "\n"); };
    CHECK (problem ("") == "log/not_a_log run.jsonl:1");
    CHECK (problem ("{}\n") == "log/not_a_log run.jsonl:1");
    CHECK (problem ("t,x\n0,1\n") == "log/not_a_log run.jsonl:1");
    CHECK (problem ("[]\n") == "log/not_a_log run.jsonl:1");
    CHECK (problem (R"({"format":"tactus-run","version":999})"
                    "\n")
           == "log/newer_version run.jsonl:1");
    CHECK (problem (R"({"format":"tactus-run","version":0})"
                    "\n")
           == "log/unknown_version run.jsonl:1");
    CHECK (problem (R"({"format":"tactus-run","version":1})"
                    "\n")
           == "log/missing run.jsonl:1");
    CHECK (problem (R"({"format":"tactus-run","version":1,"rate_hz":0.5})"
                    "\n")
           == "log/value run.jsonl:1:36");
    CHECK (problem (R"({"format":"tactus-run","version":1,"rate_hz":1e3,"guards":{"a":{"ramp":true}}})"
                    "\n")
           == "log/value run.jsonl:1:65");
    CHECK (problem (head + R"({"tick":1,"graph":{}})"
                           "\n")
           == "log/order run.jsonl:2");
    CHECK (problem (head + R"({"tick":0})"
                           "\n")
           == "log/missing run.jsonl:2");
    CHECK (after (R"({"tick":0})") == "log/order run.jsonl:3");
    CHECK (after (R"({"turn":{}})") == "log/missing run.jsonl:3");
    CHECK (after (R"({"tick":1.5})") == "log/value run.jsonl:3:2");
    CHECK (after (R"({"tick":-1})") == "log/value run.jsonl:3:2");
    CHECK (after (R"({"tick":1,"halt":1})") == "file/wrong_kind run.jsonl:3:11");
    CHECK (after (R"({"tick":1,"feed":[1,2]})") == "log/value run.jsonl:3:11");
    CHECK (after (R"({"tick":1,"late":[2,1]})") == "log/value run.jsonl:3:11");
    CHECK (after (R"({"tick":1,"turn":{"a.b":"much"}})") == "log/value run.jsonl:3:19");
    CHECK (after (R"({"tick":1,"read":{"a":{"position":[1,2]}}})") == "log/value run.jsonl:3:24");
    CHECK (after (R"({"tick":1,)") == "file/syntax run.jsonl:3:11");
    CHECK (after ("nonsense").starts_with ("file/syntax run.jsonl:3:"));
}

TEST_CASE ("every file of the run_log corpus is either read or refused") { CHECK (test::replay ("run_log", fuzz::tryRunLog) > 50); }
