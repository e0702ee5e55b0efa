// SPDX-License-Identifier: GPL-3.0-or-later
// The emergency stop of `tactus play`.

#include "host/cli/on_terminal.hpp"
#include "host/cli/running.hpp"
#include "support/waiting.hpp"

#include <host/devices/osc/osc_port.hpp>
#include <tactus/file/csv.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

using namespace tactus;
using test::Running;
using test::Scratch;

TEST_CASE ("SIGUSR1 triggers the emergency stop of a play: no force, the ticks continue, and only a person rearms", "[cli]")
{
    const Scratch scratch;
    const auto graph = R"({ "format": "tactus-graph", "version": 1, "rate_hz": 1000,
      "nodes": { "hand": { "type": "device.position", "role": "tip" }, "push": { "type": "signal.constant", "params": { "value": 2.0 } },
        "motor": { "type": "device.force", "role": "tip" } },
      "wires": [ "push.out -> motor.force.x" ] })";
    const auto recorded = scratch.path ("applied.csv"), log = scratch.path ("run.jsonl");
    Running play { { "play", scratch.write ("g.json", graph), "--device", "tip=sim", "--osc", "0", "--record", "motor.applied.x",
                     "--out", recorded, "--log", log } };
    REQUIRE (play.says ("Ctrl-C stops"));
    const auto said = play.err();
    const auto behind = [&] (const std::string& words) { return said.substr (said.find (words) + words.size()); };
    const int port = std::stoi (behind ("OSC on 127.0.0.1:"));
    const auto token = behind ("(token: ").substr (0, 12);
    const auto us = std::move (*host::OscPort::open (0));
    const auto rearm = [&] {
        us->send (port, juce::OSCMessage ("/tactus/rearm", juce::String (token), us->number()));
        const auto answer = us->next (std::chrono::minutes (1));
        REQUIRE (answer);
        return answer->getAddressPattern().toString().toStdString();
    };

    const auto ticks = [&] {
        const auto text = test::textOf (log);
        const std::string key = "\"tick\":";
        const auto at = text.rfind (key, text.rfind ('\n'));
        return at == std::string::npos ? 0 : std::stoi (text.substr (at + key.size()));
    };
    const auto goesOn = [&] {
        const int from = ticks();
        return test::soon ([&] { return ticks() > from + 200; });
    };

    REQUIRE (goesOn());
    const test::Stopwatch since_stop;
    play.signal (SIGUSR1);
    play.signal (SIGUSR2);
    CHECK (play.says ("SIGUSR2 does not rearm"));
    const auto first = rearm();
    if (! since_stop.hasRun (std::chrono::milliseconds (900))) CHECK (first == "/tactus/error");
    test::letPass (std::chrono::milliseconds (1100));
    CHECK (rearm() == "/tactus/done");
    REQUIRE (goesOn());
    const auto ran = play.stop();
    INFO (ran.err);
    CHECK (ran.status == 0);
    CHECK (ran.err.find ("the emergency stop was pressed") != std::string::npos);

    const auto table = readTable (std::filesystem::path (recorded));
    REQUIRE (table);
    std::vector<std::size_t> lengths;   // length of each phase in ticks: on, off, on
    for (std::size_t k = 1; k < table->rows(); ++k)
    {
        const auto is_off = [&] (std::size_t row) { return table->at (row, 1) == 0.0; };
        if (lengths.empty() || is_off (k) != is_off (k - 1)) lengths.push_back (0);
        ++lengths.back();
    }
    CAPTURE (lengths);
    REQUIRE (lengths.size() >= 3);
    CHECK (lengths[1] > 100);
    CHECK (lengths[2] > 100);
}

TEST_CASE ("every signal that would end or suspend a play ends it as Ctrl-C does: with the force at zero, and complete files", "[cli]")
{
    const Scratch scratch;
    const auto graph = scratch.write ("g.json", R"({ "format": "tactus-graph", "version": 1, "rate_hz": 1000,
      "nodes": { "push": { "type": "signal.constant", "params": { "value": 2.0 } }, "motor": { "type": "device.force", "role": "tip" } },
      "wires": [ "push.out -> motor.force.x" ] })");
    const auto ending = { SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGALRM, SIGVTALRM, SIGPROF, SIGXCPU, SIGPIPE, SIGTSTP,
                          SIGSYS, SIGTRAP, SIGIO, SIGPWR, SIGSTKFLT, SIGRTMIN, SIGRTMAX };
    for (const int number : ending)
    {
        CAPTURE (number);
        const auto recorded = scratch.path (std::to_string (number) + ".csv");
        const auto log = scratch.path (std::to_string (number) + ".jsonl");
        Running play { { "play", graph, "--device", "tip=sim", "--record", "motor.applied.x", "--out", recorded, "--log", log } };
        REQUIRE (test::soon ([&] { return test::textOf (log).find ("\"tick\":0,") != std::string::npos; }));   // it ticks
        // Reading and writing in the background neither suspends nor ends the program.
        play.signal (SIGTTIN);
        play.signal (SIGTTOU);
        play.signal (number);
        const auto ran = play.finish();
        CHECK (ran.status == 0);
        CHECK (ran.err.find ("slew limit") == std::string::npos);   // the device was not released before its force was zero
        const auto last = ran.err.rfind ("force ");                 // of the status
        REQUIRE (last != std::string::npos);
        CHECK (ran.err.substr (last).starts_with ("force  0.000 N"));
        const auto table = readTable (std::filesystem::path (recorded));
        REQUIRE (table);
        CHECK (table->rows() > 0);
    }
}

TEST_CASE ("one thread of a play handles the emergency signals, and where real-time priority is allowed, it comes before the tick", "[cli][safety]")
{
    const Scratch scratch;
    const auto graph = scratch.write ("g.json", R"({ "format": "tactus-graph", "version": 1, "rate_hz": 1000,
      "nodes": { "motor": { "type": "device.force", "role": "tip" } }, "wires": [] })");
    Running play { { "play", graph, "--device", "tip=sim", "--osc", "0", "--duration", "600" } };
    REQUIRE (play.says ("Ctrl-C stops"));

    /// A thread, as the kernel reports it.
    struct Thread
    {
        bool handles_signals = false;
        int priority = 0;
    };
    const auto threads = [&] {
        std::vector<Thread> all;
        for (const auto& task : std::filesystem::directory_iterator ("/proc/" + std::to_string (play.id()) + "/task"))
        {
            auto& thread = all.emplace_back();
            std::ifstream status (task.path() / "status"), stat (task.path() / "stat");
            for (std::string line; std::getline (status, line);)
                if (line.starts_with ("SigBlk:")) thread.handles_signals = (std::stoull (line.substr (7), nullptr, 16) >> (SIGUSR1 - 1) & 1) == 0;
            std::string text, field;
            std::getline (stat, text);
            std::istringstream fields (text.substr (text.rfind (')') + 1));
            for (int i = 3; i <= 40; ++i)   // starts after field 2, the name, which may contain anything
                fields >> field;
            thread.priority = std::stoi (field);
        }
        return all;
    };
    const auto handlers = [&] { return std::ranges::count (threads(), true, &Thread::handles_signals); };
    REQUIRE (test::soon ([&] { return handlers() == 1; }));
    const auto all = threads();
    const auto handler = std::ranges::find (all, true, &Thread::handles_signals);
    const auto highest = std::ranges::max (all, {}, &Thread::priority).priority;
    CHECK (handler->priority == highest);
    if (highest > 0) CHECK (std::ranges::count (all, highest, &Thread::priority) == 1);
    play.signal (SIGUSR1);
    play.signal (SIGUSR2);
    CHECK (play.says ("SIGUSR2 does not rearm"));
    CHECK (play.stop().status == 0);
}

TEST_CASE ("an emergency stop by a key is ended by a key, and by no message, even with the token", "[cli][osc][safety]")
{
    const Scratch scratch;
    const auto graph = R"({ "format": "tactus-graph", "version": 1, "rate_hz": 1000, "wires": [],
                            "nodes": { "motor": { "type": "device.force", "role": "tip" } } })";
    test::OnTerminal play { { "play", scratch.write ("g.json", graph), "--device", "tip=sim", "--osc", "0", "--duration", "600" }, true };
    REQUIRE (test::eventually ([&] { return play.err().find ("Ctrl-C ends the run") != std::string::npos; }));
    const auto said = play.err();
    const auto behind = [&] (const std::string& words) { return said.substr (said.find (words) + words.size()); };
    const int port = std::stoi (behind ("OSC on 127.0.0.1:"));
    const juce::String token (behind ("(token: ").substr (0, 12));
    const auto us = std::move (*host::OscPort::open (0));
    const auto ask = [&] (const juce::OSCMessage& message) {
        us->send (port, message);
        std::optional<juce::OSCMessage> answer;
        REQUIRE (test::eventually ([&] {
            play.err();   // otherwise it would wait for the terminal
            return answer || (answer = us->next());
        }));
        return *answer;
    };
    const auto withholds = [&] {
        const auto state = ask (juce::OSCMessage ("/tactus/guard", us->number()));
        REQUIRE (us->next (std::chrono::seconds (30)));   // /tactus/done
        return state[1].getInt32() != 0;
    };
    const auto rearms = [&] { return ask (juce::OSCMessage ("/tactus/rearm", token, us->number())); };

    play.type (" ");
    REQUIRE (test::eventually (withholds));
    test::letPass (std::chrono::milliseconds (1200));          // longer than the pause after a stop
    us->send (port, juce::OSCMessage ("/tactus/emergency"));   // a program that stops it again gains nothing
    test::letPass (std::chrono::milliseconds (1200));
    const auto refused = rearms();
    REQUIRE (refused.size() > 2);
    CHECK (refused[2].getString() == "run/stopped_by_person");
    CHECK (withholds());

    play.type ("r");
    CHECK (test::eventually ([&] { return ! withholds(); }));
    test::letPass (std::chrono::milliseconds (1200));   // longer than the pause after a rearm
    ask (juce::OSCMessage ("/tactus/emergency", us->number()));
    test::letPass (std::chrono::milliseconds (1200));
    CHECK (rearms().getAddressPattern().toString() == "/tactus/done");
    CHECK (test::eventually ([&] { return ! withholds(); }));
    play.signal (SIGINT);
    CHECK (play.finish() == 0);
}
