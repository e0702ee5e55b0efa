// SPDX-License-Identifier: GPL-3.0-or-later
// Pipes that nobody reads or writes: a program that waits for one still ends when it is told to, and reads none in place of a file.

#include "running.hpp"

#include <host/devices/osc/osc_port.hpp>
#include <tactus/plugin/plugin_library.hpp>

#include <catch2/catch.hpp>

#include <csignal>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

using namespace tactus;
using test::Running;
using test::runProgram;
using test::runTactus;
using test::Scratch;
using test::soon;

namespace
{
const std::string wood = TACTUS_SOURCE_DIR "/graphs/dry_wood.json";

std::string fifo (const Scratch& scratch, const std::string& name)
{
    const auto path = scratch.path (name);
    REQUIRE (mkfifo (path.c_str(), 0600) == 0);
    return path;
}

/// True if `tactus` has a handler for this signal, so it does not end the process by itself. (This program has handlers, too, and so has a copy of it.)
bool handles (const Running& program, int signal)
{
    if (test::textOf ("/proc/" + std::to_string (program.id()) + "/comm") != "tactus\n") return false;
    std::istringstream lines (test::textOf ("/proc/" + std::to_string (program.id()) + "/status"));
    for (std::string line; std::getline (lines, line);)
        if (line.starts_with ("SigCgt:")) return (std::stoull (line.substr (7), nullptr, 16) >> (signal - 1) & 1u) != 0;
    return false;
}

/// Waits until the program has ended. False if it does not.
bool ends (const Running& program)
{
    return soon ([&] {
        const auto stat = test::textOf ("/proc/" + std::to_string (program.id()) + "/stat");
        return stat.empty() || stat[stat.rfind (')') + 2] == 'Z';
    });
}

/// A pipe with room for 4096 bytes, which this object opens and does not read.
struct Stalled
{
    explicit Stalled (const std::string& path) : reader (open (path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) { fcntl (reader, F_SETPIPE_SZ, 4096); }
    ~Stalled() { close (reader); }
    Stalled (const Stalled&) = delete;
    Stalled& operator= (const Stalled&) = delete;

    /// True once bytes wait in the pipe. The writer has more than fit, so it waits, too.
    bool isWritten() const
    {
        int bytes = 0;
        return soon ([&] { return ioctl (reader, FIONREAD, &bytes) == 0 && bytes > 0; });
    }

    const int reader;
};
}   // namespace

TEST_CASE ("a render into a pipe that nobody opens ends with every stopping signal", "[cli][pipes]")
{
    const int number = GENERATE (SIGTERM, SIGINT, SIGHUP);
    const Scratch scratch;
    Running render { { "render", wood, "--duration", "1", "--out", fifo (scratch, "out.csv") } };
    REQUIRE (soon ([&] { return handles (render, number); }));
    render.signal (number);
    REQUIRE (ends (render));
    const auto ran = render.finish();
    INFO (ran.err);
    CHECK (ran.status == 1);
    CHECK (ran.err.find ("[output/unwritable]") != std::string::npos);
}

TEST_CASE ("a program that writes to a pipe that nobody reads ends when it is told to", "[cli][pipes]")
{
    const Scratch scratch;
    const auto pipe = fifo (scratch, "pipe.csv");
    const Stalled stalled (pipe);
    SECTION ("a file of a render")
    {
        Running render { { "render", wood, "--duration", "1000", "--out", pipe } };
        REQUIRE (stalled.isWritten());
        render.signal (SIGTERM);
        REQUIRE (ends (render));
        CHECK (render.finish().status == 1);
    }
    SECTION ("its standard output")
    {
        Running render { "sh", { "-c", "exec " TACTUS_PROGRAM " render " + wood + " --duration 1000 > " + pipe } };
        REQUIRE (stalled.isWritten());
        render.signal (SIGTERM);
        REQUIRE (ends (render));
        CHECK (render.finish().status == 1);
    }
    SECTION ("its messages")
    {
        const auto graph = [] (const std::string& nodes) {
            return R"({ "format": "tactus-graph", "version": 2, "rate_hz": 100, "nodes": { )" + nodes + R"("one": { "type": "signal.constant" } } })";
        };
        const auto file = scratch.write ("g.json", graph (""));
        Running play { "sh", { "-c", "exec " TACTUS_PROGRAM " play " + file + " --osc off --watch 2> " + pipe } };
        std::string said;
        REQUIRE (soon ([&] {
            char bytes[256];
            const auto got = read (stalled.reader, bytes, sizeof bytes);
            if (got > 0) said.append (bytes, static_cast<std::size_t> (got));
            return said.find ("Ctrl-C stops") != std::string::npos;
        }));
        std::string wrong;
        for (int i = 0; i < 100; ++i)
            wrong += "\"n" + std::to_string (i) + R"(": { "type": "signal.gain", "params": { "gain": "a lot" } }, )";
        scratch.write ("g.json", graph (wrong));
        REQUIRE (stalled.isWritten());
        play.signal (SIGTERM);
        CHECK (ends (play));
    }
    SECTION ("a recording of a play")
    {
        Running play { { "play", wood, "--osc", "off", "--out", pipe } };
        REQUIRE (stalled.isWritten());
        play.signal (SIGTERM);
        REQUIRE (ends (play));
        CHECK (play.finish().status == 1);
    }
}

TEST_CASE ("a slow reader of a pipe gets everything, also after a stop", "[cli][pipes]")
{
    const Scratch scratch;
    const auto pipe = fifo (scratch, "pipe.csv");
    const Stalled slow (pipe);
    Running play { { "play", wood, "--osc", "off", "--out", pipe, "--duration", "0.3" } };
    REQUIRE (slow.isWritten());
    std::string text;
    char bytes[512];
    const auto readSome = [&] {
        const auto got = read (slow.reader, bytes, sizeof bytes);
        if (got > 0) text.append (bytes, static_cast<std::size_t> (got));
        return got;
    };
    readSome();
    play.signal (SIGTERM);
    while (readSome() != 0)
    {
    }
    const auto ran = play.finish();
    INFO (ran.err);
    CHECK (ran.status == 0);
    CHECK (text.ends_with ("\n"));
}

TEST_CASE ("what reads a file refuses a pipe before it opens it", "[cli][pipes]")
{
    const Scratch scratch;
    const auto pipe = fifo (scratch, "in.tactus");
    for (const std::string command : { "validate", "check", "render", "play" })
    {
        const auto ran = runTactus ({ command, pipe });
        INFO (command << ran.err);
        CHECK (ran.status == 1);
    }
    const auto ran = runTactus ({ "convert", fifo (scratch, "pen.events"), scratch.path ("pen.csv") });
    INFO (ran.err);
    CHECK (ran.status == 1);
    CHECK (ran.err.find ("a named pipe") != std::string::npos);
    CHECK (runTactus ({ "fit", "switch", pipe, "-o", scratch.path ("key.json") }).status == 1);
    const auto library = PluginLibrary::load (pipe);   // as check-plugin does
    REQUIRE_FALSE (library);
    CHECK (library.error().id == "plugin/cannot_load");
}

TEST_CASE ("what another program answers cannot disturb the terminal, not even as an id", "[cli][osc]")
{
    const std::vector<std::string> command = GENERATE (values<std::vector<std::string>> ({ { "set", "a.b=1" }, { "hit", "a.b" }, { "probe", "a.b" } }));
    auto server = host::OscPort::open (0);
    REQUIRE (server);
    auto words = command;
    words.insert (words.end(), { "--osc", std::to_string ((*server)->number()) });
    Running program { words };
    const auto asked = (*server)->next (std::chrono::seconds (30));
    REQUIRE (asked);
    int port = 0;   // of the sender, which every command gives
    for (const auto& argument : *asked)
        if (argument.isInt32()) port = argument.getInt32();
    (*server)->send (port, juce::OSCMessage ("/tactus/error", juce::String ("/tactus/x"), juce::String ("where"), juce::String ("id\033[31m\nforged"),
                                             juce::String ("text\033[0m"), juce::String ("remedy\007")));
    REQUIRE (ends (program));
    const auto ran = program.finish();
    CHECK (ran.status == 1);
    CHECK (ran.err.find ("[id\\x1B[31m") != std::string::npos);
    CHECK (ran.err.find ('\033') == std::string::npos);
    CHECK (ran.err.find ("\nforged") == std::string::npos);
}
