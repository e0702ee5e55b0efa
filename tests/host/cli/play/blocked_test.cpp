// SPDX-License-Identifier: GPL-3.0-or-later
// An emergency stop of `tactus play` takes effect while the main thread waits or works, as docs/safety.md claims.
//
// In each try the main thread is stuck from before the stop until after the last tick: the tick thread ends by itself after Ctrl-C,
// and only then is the main thread released. So if the log contains the stop, no step of the stop waited for the main thread.

#include "host/cli/on_terminal.hpp"
#include "support/waiting.hpp"

#include <host/devices/osc/osc_port.hpp>
#include <tactus/file/csv.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace tactus;
using test::OnTerminal;
using test::runTactus;
using test::Scratch;
using test::soon;
using test::textOf;

namespace
{
constexpr double rate_hz = 100.0;   // slow, so that the log has room for many seconds

/// Pushes with 2 N, and more nodes. The device moves, so that the log has something to write on each tick.
std::string graphWith (const std::string& more_nodes)
{
    return R"({ "format": "tactus-graph", "version": 1, "rate_hz": 100, "devices": { "tip": { "driver": "gesture", "path": "circle" } },
      "nodes": { )"
           + more_nodes + R"("push": { "type": "signal.constant", "params": { "value": 2 } },
        "hand": { "type": "device.position", "role": "tip" }, "motor": { "type": "device.force", "role": "tip" } },
      "wires": [ "push.out -> motor.force.x" ] })";
}

/// A mesh of 48 MB, written once. Reading it takes more than a second.
std::string largeMesh()
{
    static const Scratch folder;
    static const auto path = [] {
        constexpr int n = 700;   // 490 000 points; the budget allows 500 000
        std::string text;
        for (int i = 0; i < n * n; ++i)
        {
            char line[80];
            std::snprintf (line, sizeof line, "v %.15f %.15f %.15f\n", 1e-3 * (i / n), 1e-3 * (i % n), 1e-5 * (i % 7));
            text += line;
        }
        for (int i = 1; i < n * (n - 1); ++i)
            if (i % n != 0)
                for (const auto& [a, b, c] : { std::array { i, i + n, i + 1 }, std::array { i + 1, i + n, i + n + 1 } })
                    text += "f " + std::to_string (a) + " " + std::to_string (b) + " " + std::to_string (c) + "\n";
        REQUIRE (text.size() > 48'000'000);
        return folder.write ("large.obj", text);
    }();
    return path;
}

/// A named pipe with little room, whose reader stalls until it is asked to read.
class Stalled
{
public:
    explicit Stalled (const std::string& path)
    {
        mkfifo (path.c_str(), 0600);
        reader = open (path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
        fcntl (reader, F_SETPIPE_SZ, 4096);
    }
    ~Stalled() { close (reader); }
    Stalled (const Stalled&) = delete;
    Stalled& operator= (const Stalled&) = delete;

    /// The number of bytes that wait to be read.
    std::size_t waiting() const
    {
        int bytes = 0;
        return ioctl (reader, FIONREAD, &bytes) == 0 ? static_cast<std::size_t> (bytes) : 0;
    }

    /// Reads what is there. False once the writer has closed it.
    bool readOn()
    {
        char bytes[4096];
        ssize_t size = 0;
        while ((size = read (reader, bytes, sizeof bytes)) > 0)
            text.append (bytes, static_cast<std::size_t> (size));
        return size < 0;
    }

    std::string text;

private:
    int reader = -1;
};

/// True while a UDP port of this machine has packets that its program has not read.
bool hasUnreadPackets (int port)
{
    char wanted[16];
    std::snprintf (wanted, sizeof wanted, ":%04X", static_cast<unsigned> (port));
    std::ifstream sockets ("/proc/net/udp");
    for (std::string line, slot, local, remote, state, queues; std::getline (sockets, line);)
    {
        std::istringstream (line) >> slot >> local >> remote >> state >> queues;
        if (local.ends_with (wanted) && ! queues.ends_with (":00000000")) return true;
    }
    return false;
}

enum class Way
{
    key,
    signal,
    osc
};

/// Presses the emergency stop, and waits until it has been received.
void press (Way way, const OnTerminal& play, int port)
{
    switch (way)
    {
    case Way::key:
        play.type ("  ");   // the second key is read after the first one has been acted upon
        REQUIRE (soon ([&] { return ! play.hasUnreadKeys(); }));
        return;
    case Way::signal:
        play.signal (SIGUSR1);
        REQUIRE (soon ([&] { return ! play.hasPending (SIGUSR1); }));
        return;
    case Way::osc:
        const auto us = std::move (*host::OscPort::open (0));
        for (int i = 0; i < 2; ++i)   // the same
            us->send (port, juce::OSCMessage ("/tactus/emergency"));
        REQUIRE (soon ([&] { return ! hasUnreadPackets (port); }));
    }
}

/// Waits until something has been written, but nothing more. A log is written every 20 ms, unless the main thread is stuck.
template <typename Written>
bool waitForSilence (Written&& written, std::chrono::milliseconds patience = std::chrono::milliseconds (300))
{
    return soon ([&] {
        const std::size_t before = written();
        return before > 0 && test::stays (patience, [&] { return written() == before; });
    });
}

/// Presses the stop, lets the ticks end while the main thread is stuck, and returns whether they ended.
bool stopAndEnd (Way way, OnTerminal& play)
{
    const auto text = play.err();
    const std::string before = "OSC on 127.0.0.1:";
    press (way, play, std::stoi (text.substr (text.find (before) + before.size())));
    test::letPass (std::chrono::milliseconds (200));   // for some ticks without force; not judged
    const auto threads = play.threads();
    play.signal (SIGINT);
    return soon ([&] { return play.threads() < threads; });   // the tick thread has ended
}

/// Checks that the log contains the stop, and that a replay has no force after it.
void checkLog (const std::string& log, const Scratch& scratch)
{
    const auto text = textOf (log);
    const auto at = text.find (R"("emergency":true)");
    REQUIRE (at != std::string::npos);
    const std::string head = R"({"tick":)";
    const auto stop = std::stoul (text.substr (text.rfind (head, at) + head.size()));

    const auto replayed = runTactus ({ "render", "--replay", log, "--record", "motor.applied.x", "--out", scratch.path ("again.csv") });
    INFO (replayed.err);
    REQUIRE (replayed.status == 0);
    const auto table = readTable (std::filesystem::path (scratch.path ("again.csv")));
    REQUIRE (table);
    REQUIRE (table->rows() > stop);
    CHECK (stop > 0);
    std::size_t wrong = 0;   // row k holds the force of tick k - 1; the fade of 5 ms takes less than a tick
    for (std::size_t k = 0; k < table->rows(); ++k)
        wrong += table->at (k, 1) != (k >= 1 && k <= stop ? 2.0 : 0.0);
    CHECK (wrong == 0);
}

const char* const ready = "Ctrl-C ends the run";   // printed if there are keys
}   // namespace

TEST_CASE ("an emergency stop takes effect while the main thread waits for a stopped terminal", "[cli][safety]")
{
    const auto way = GENERATE (Way::key, Way::signal, Way::osc);
    const Scratch scratch;
    const auto log = scratch.path ("run.jsonl");
    OnTerminal play { { "play", scratch.write ("g.json", graphWith ("")), "--osc", "0", "--duration", "600", "--log", log }, true };
    REQUIRE (soon ([&] { return play.err().find (ready) != std::string::npos; }));
    play.type ("\x13");   // Ctrl-S
    REQUIRE (waitForSilence ([&] { return textOf (log).size(); }));
    REQUIRE (stopAndEnd (way, play));
    play.type ("\x11");   // Ctrl-Q
    CHECK (play.finish() == 0);
    checkLog (log, scratch);
}

TEST_CASE ("an emergency stop takes effect while the main thread waits for the reader of a recording or a log", "[cli][safety]")
{
    const auto way = GENERATE (Way::key, Way::signal, Way::osc);
    const bool into_log = GENERATE (true, false);
    const Scratch scratch;
    const auto log = scratch.path ("run.jsonl");
    Stalled pipe { scratch.path (into_log ? "pipe.jsonl" : "pipe.csv") };
    std::vector<std::string> arguments { "play", scratch.write ("g.json", graphWith ("")), "--osc", "0", "--duration", "600", "--log" };
    if (into_log)
        arguments.push_back (scratch.path ("pipe.jsonl"));
    else
        arguments.insert (arguments.end(), { log, "--record", "hand.position,hand.rotation,motor.applied", "--out", scratch.path ("pipe.csv") });
    OnTerminal play { arguments, false };
    REQUIRE (soon ([&] { return play.err().find (ready) != std::string::npos; }));
    REQUIRE (waitForSilence ([&] { return pipe.waiting(); }, std::chrono::milliseconds (800)));   // a recording is written every 500 ms
    REQUIRE (stopAndEnd (way, play));
    REQUIRE (soon ([&] { return ! pipe.readOn(); }));
    CHECK (play.finish() == 0);
    if (into_log) scratch.write ("run.jsonl", pipe.text);
    checkLog (log, scratch);
}

TEST_CASE ("an emergency stop takes effect while the main thread compiles an edit that names a large mesh", "[cli][safety][watch]")
{
    const auto way = GENERATE (Way::key, Way::signal, Way::osc);
    const Scratch scratch;
    const auto log = scratch.path ("run.jsonl"), graph = scratch.write ("g.json", graphWith (""));
    const auto edited = scratch.write ("edited.json", graphWith (R"("big": { "type": "deform.surface", "settings": { "surface": { "mesh": ")" + largeMesh()
                                                                 + R"(", "mu": 0.3, "curves": [ [ { "power": [60, 1] } ] ] } } }, )"));
    OnTerminal play { { "play", graph, "--watch", "--osc", "0", "--duration", "600", "--log", log }, false };
    REQUIRE (soon ([&] { return play.err().find (ready) != std::string::npos; }));
    std::filesystem::rename (edited, graph);
    REQUIRE (waitForSilence ([&] {
        REQUIRE (play.err().find ("error") == std::string::npos);   // the edit is refused, and nothing is compiled
        return textOf (log).size();
    }));
    REQUIRE (stopAndEnd (way, play));
    if (play.err().find ("loaded") != std::string::npos) WARN ("this machine compiles so fast that the try proves nothing");
    CHECK (play.finish() == 0);
    checkLog (log, scratch);
}

TEST_CASE ("a rearm over OSC that came before a stop does not undo it, however late it is handled", "[cli][safety]")
{
    const Scratch scratch;
    const auto log = scratch.path ("run.jsonl");
    OnTerminal play { { "play", scratch.write ("g.json", graphWith ("")), "--osc", "0", "--duration", "600", "--log", log }, true };
    REQUIRE (soon ([&] { return play.err().find (ready) != std::string::npos; }));
    const auto said = play.err();
    const auto behind = [&] (const std::string& words) { return said.substr (said.find (words) + words.size()); };
    const int port = std::stoi (behind ("OSC on 127.0.0.1:"));
    const auto us = std::move (*host::OscPort::open (0));
    juce::OSCMessage rearm ("/tactus/rearm");
    rearm.addString (behind ("(token: ").substr (0, 12));
    rearm.addInt32 (us->number());

    play.type ("\x13");   // Ctrl-S
    REQUIRE (waitForSilence ([&] { return textOf (log).size(); }));
    us->send (port, rearm);
    REQUIRE (soon ([&] { return ! hasUnreadPackets (port); }));
    press (Way::signal, play, port);
    test::letPass (std::chrono::milliseconds (1200));   // longer than the pause after a stop
    play.type ("\x11");                                 // Ctrl-Q
    const auto answer = us->next (std::chrono::seconds (30));
    REQUIRE (answer);
    CHECK (answer->getAddressPattern().toString() == "/tactus/error");
    play.signal (SIGINT);
    CHECK (play.finish() == 0);
    checkLog (log, scratch);
}
