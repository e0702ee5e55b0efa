// SPDX-License-Identifier: GPL-3.0-or-later
// A full disk or a flood of OSC packets during a run does not affect the force, as docs/safety.md claims.

#include "running.hpp"
#include "support/waiting.hpp"

#include <host/devices/osc/osc_port.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

using namespace tactus;
using test::Running;
using test::runTactus;
using test::Scratch;
using test::textOf;

namespace
{
const std::string wood = TACTUS_SOURCE_DIR "/graphs/dry_wood.json";
const std::string ports = "drag.force,drag.state,motor.force,motor.applied";

/// The peak memory of a process, in kB.
long peakOf (long process)
{
    std::ifstream status ("/proc/" + std::to_string (process) + "/status");
    for (std::string line; std::getline (status, line);)
        if (line.starts_with ("VmHWM:")) return std::stol (line.substr (6));
    return -1;
}

/// Sends 20 000 packets per second to a port until it is stopped. Half of them are OSC messages that change nothing.
class Flood
{
public:
    explicit Flood (int port)
        : thread ([this, port] (const std::stop_token& stop) { run (port, stop); })
    {
    }

    int sent() const { return count; }

private:
    void run (int port, const std::stop_token& stop)
    {
        const auto silent = std::move (*host::OscPort::open (0));
        juce::DatagramSocket socket;
        socket.bindToPort (0, "127.0.0.1");
        std::mt19937 random (1);
        const test::Stopwatch watch;
        while (! stop.stop_requested())
        {
            const auto due = static_cast<int> (20'000.0 * watch.s());
            for (; count < due; ++count)
                if (count % 2 == 0)
                    silent->send (port, juce::OSCMessage ("/tactus/param", juce::String ("drag.mu"), juce::String ("0.4"), silent->number()));
                else
                {
                    char bytes[64];
                    for (auto& b : bytes)
                        b = static_cast<char> (random());
                    socket.write ("127.0.0.1", port, bytes, 1 + static_cast<int> (random() % sizeof bytes));
                }
            test::letPass (std::chrono::milliseconds (1));
        }
    }

    std::atomic<int> count = 0;
    std::jthread thread;
};
/// Plays with a limit on the size of files, in units of 512 bytes. It fails like a full disk and needs no disk.
test::Ran playWithLimit (const std::string& limit, const std::vector<std::string>& options)
{
    std::vector<std::string> all { "-c", "ulimit -f " + limit + "; exec \"$0\" \"$@\"", TACTUS_PROGRAM, "play", wood, "--osc", "off", "--ticks", "4000" };
    all.insert (all.end(), options.begin(), options.end());
    return test::runProgram ("sh", all);
}
}   // namespace

TEST_CASE ("a full disk ends a recording, but neither the run nor the other recording", "[cli][safety]")
{
    const Scratch scratch;
    const auto csv = scratch.path ("live.csv"), wav = scratch.path ("live.wav");
    const auto ran = playWithLimit ("600", { "--record", ports, "--out", csv, "--out", wav });   // the CSV is four times as large as the WAV
    INFO (ran.err);
    CHECK (ran.status == 1);
    CHECK (ran.err.find (csv + ": warning: cannot be written: ") != std::string::npos);
    CHECK (ran.err.find ("the run continues [output/unwritable]") != std::string::npos);
    for (const auto& left : std::filesystem::directory_iterator (scratch.path (".")))
        CHECK (left.path().filename() == "live.wav");   // and there is no half-written file

    CHECK (runTactus ({ "render", wood, "--duration", "1", "--record", ports, "--out", scratch.path ("offline.wav") }).status == 0);
    CHECK (std::filesystem::file_size (wav) > 4000 * 4 * 10);
    CHECK (test::sameRows (wav, scratch.path ("offline.wav"), ran.err));
}

TEST_CASE ("a full disk ends a log after a complete line, but does not end the run", "[cli][safety]")
{
    const Scratch scratch;
    const auto log = scratch.path ("run.jsonl"), wav = scratch.path ("live.wav");
    const auto ran = playWithLimit ("200", { "--record", "drag.state", "--log", log, "--out", wav });
    INFO (ran.err);
    CHECK (ran.status == 1);
    CHECK (ran.err.find (log + ": warning: cannot be written: ") != std::string::npos);
    CHECK (ran.err.find ("the run continues [output/unwritable]") != std::string::npos);
    CHECK (runTactus ({ "render", wood, "--duration", "1", "--record", "drag.state", "--out", scratch.path ("offline.wav") }).status == 0);
    CHECK (test::sameRows (wav, scratch.path ("offline.wav"), ran.err));

    const auto again = runTactus ({ "render", "--replay", log, "--record", "drag.state", "--out", scratch.path ("again.csv") });
    INFO (again.err);
    CHECK (again.status == 0);
    CHECK (again.err.find ("[log/cut_off]") != std::string::npos);
    CHECK (textOf (scratch.path ("again.csv")).size() > 1000);
}

TEST_CASE ("a flood of OSC changes no bit of the force and uses no memory", "[cli][osc][safety]")
{
    const Scratch scratch;
    Running play { { "play", wood, "--osc", "0", "--ticks", "8000", "--record", ports, "--out", scratch.path ("live.csv") } };
    REQUIRE (play.says ("Ctrl-C stops"));
    const auto text = play.err();
    const std::string before = "OSC on 127.0.0.1:";
    Flood flood { std::stoi (text.substr (text.find (before) + before.size())) };
    long at_first = 0, in_the_end = 0;
    const bool is_over = test::soon ([&] {
        const auto peak = peakOf (play.id());
        if (peak > 0 && flood.sent() > 10'000) in_the_end = peak;
        if (at_first == 0) at_first = in_the_end;
        return peak < 0;
    });
    REQUIRE (is_over);
    const auto ran = play.finish();
    INFO (ran.err);
    CHECK (ran.status == 0);
    CHECK (at_first > 0);   // 10 000 packets came in time
    CHECK (in_the_end - at_first < 8'000);
    CHECK (runTactus ({ "render", wood, "--duration", "2", "--record", ports, "--out", scratch.path ("offline.csv") }).status == 0);
    CHECK (test::sameRows (scratch.path ("live.csv"), scratch.path ("offline.csv"), ran.err));
}
