// SPDX-License-Identifier: GPL-3.0-or-later
// The key of `tactus play` that lets the workspace of a device move with the hand.

#include "host/cli/on_terminal.hpp"
#include "support/waiting.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <string>

using namespace tactus;
using test::OnTerminal;
using test::Running;
using test::Scratch;
using test::soon;

namespace
{
/// Pushes with 0.5 N. The position is read, so that there is something to move.
const std::string graph = R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1000,
  "nodes": { "half": { "type": "signal.constant", "params": { "value": 0.5 } }, "hand": { "type": "device.position", "role": "stylus" },
    "wall": { "type": "deform.plane", "params": { "stiffness": 1 } }, "motor": { "type": "device.force", "role": "stylus" } },
  "wires": ["half.out -> motor.force.z", "hand.position -> wall.position", "wall.force -> motor.force"] })";

/// The force in the last whole report that a fake board has heard, as it is written in its log, and without the number of the report.
std::string lastForce (const std::string& log)
{
    constexpr std::size_t of_report = 26, of_force = 3 * 4 * 3 - 1;   // "54 01 01 00 " and the number before it, in characters
    std::ifstream file (log);
    std::string found;
    for (std::string line; std::getline (file, line);)
        if (const auto at = line.find ("< 54"); at != line.npos && line.size() > at + of_report + of_force) found = line.substr (at + of_report, of_force);
    return found;
}

const std::string none = "00 00 00 00 00 00 00 00 00 00 00 00", pushed = "00 00 00 00 00 00 00 00 20 a1 07 00";   // 500000 uN
const auto* const apart = "S moves the workspace";
}   // namespace

TEST_CASE ("S in the terminal of a play lets the workspace move, without force, until S comes again", "[cli][wires][safety]")
{
    const Scratch scratch;
    const auto log = scratch.path ("log"), board = scratch.path ("board");
    Running fake { { "fake-device", "tactus_board", "--wire", "serial", "--link", board, "--log", log, "--hand",
                     scratch.write ("hand.json", R"({ "driver": "sim", "mass": "1000 kg" })") } };
    REQUIRE (soon ([&] { return fake.out().find ('\n') != std::string::npos; }));
    OnTerminal play { { "play", scratch.write ("push.json", graph), "--device", "stylus=serial:tactus_board@" + board, "--session", "off", "--osc", "off" },
                      false };
    REQUIRE (soon ([&] { return play.err().find (apart) != std::string::npos; }));
    REQUIRE (soon ([&] { return lastForce (log) == pushed; }));
    play.type ("s");
    REQUIRE (soon ([&] { return play.err().find ("moves with the hand, without force") != std::string::npos; }));
    CHECK (soon ([&] { return lastForce (log) == none; }));
    // An S that follows sooner is that of a key held down.
    CHECK (test::stays (std::chrono::milliseconds (900), [&] { return lastForce (log) == none; }));
    play.type ("S");
    CHECK (soon ([&] { return play.err().find ("the workspace stays") != std::string::npos; }));
    CHECK (soon ([&] { return lastForce (log) == pushed; }));
    play.signal (SIGINT);
    CHECK (play.finish() == 0);
}

TEST_CASE ("S in the terminal of a play without a real device says that there is nothing to move", "[cli]")
{
    const Scratch scratch;
    OnTerminal play { { "play", scratch.write ("push.json", graph), "--device", "stylus=sim", "--session", "off", "--osc", "off" }, false };
    REQUIRE (soon ([&] { return play.err().find (apart) != std::string::npos; }));
    play.type ("s");
    CHECK (soon ([&] { return play.err().find ("no device whose position its graph reads") != std::string::npos; }));
    play.signal (SIGINT);
    CHECK (play.finish() == 0);
}
