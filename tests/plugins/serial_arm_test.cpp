// SPDX-License-Identifier: MIT
// The example driver (docs/examples/device_plugin) with a board at the other end of a pseudo-terminal: a graph is played on it.
#include "load.hpp"
#include "support/sketch.hpp"
#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <catch2/catch.hpp>

#include <host/cli/program.hpp>
#include <host/cli/running.hpp>
#include <host/devices/device_plugins/open_plugin_device.hpp>
#include <host/devices/hid_link/open_device.hpp>
#include <host/devices/live/live_session.hpp>
#include <tactus/text/caught.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

using namespace tactus;
using namespace std::chrono_literals;

namespace
{
/// The board of the arm, as its firmware would be. A hand holds the tool at a height.
class Board
{
public:
    /// It writes so many lines at once, like an adapter that waits for more.
    explicit Board (unsigned at_once = 1) : lines_at_once (at_once)
    {
        int other = -1;
        char name[128];
        REQUIRE (::openpty (&line, &other, name, nullptr, nullptr) == 0);
        port = name;
        kept_open = other;   // so that the board sees no end while no driver has the port open
        ::fcntl (line, F_SETFL, O_NONBLOCK);
        runs = std::thread ([this] { static_cast<void> (caught ("the board", [this] { run(); })); });
    }
    ~Board()
    {
        unplug();
        runs.join();
    }
    Board (const Board&) = delete;
    Board& operator= (const Board&) = delete;

    std::string port;
    std::atomic<double> height = 0.01;     // where the hand moves the tool, at 0.1 m/s, in m
    std::atomic<bool> is_silent = false;   // it sends nothing

    /// As if the cable was pulled.
    void unplug()
    {
        if (! is_over.exchange (true)) test::letPass (5ms);   // the other thread ends its turn
        const std::lock_guard lock (mutex);
        if (line >= 0) ::close (std::exchange (line, -1));
        if (kept_open >= 0) ::close (std::exchange (kept_open, -1));
    }

    /// The forces of the lines that came, along z, in N.
    std::vector<double> forces() const
    {
        const std::lock_guard lock (mutex);
        return all;
    }
    double force() const
    {
        const auto now = forces();
        return now.empty() ? 0.0 : now.back();
    }
    std::string lastLine() const
    {
        const std::lock_guard lock (mutex);
        return last;
    }
    int broken() const { return broken_lines; }

private:
    void run()
    {
        std::string waiting, lines;
        test::Pace pace { 1ms };
        double z = height;
        for (unsigned long long count = 1; ! is_over; ++count)
        {
            {
                const std::lock_guard lock (mutex);
                char text[128];
                z += std::clamp (height - z, -1e-4, 1e-4);
                const int size = std::snprintf (text, sizeof text, "%llu 0 0 %.0f\n", count, 1e9 * z);
                if (! is_silent) lines.append (text, static_cast<std::size_t> (size));
                if (count % lines_at_once == 0)
                {
                    if (::write (line, lines.data(), lines.size()) < 0)
                    {
                    }   // nobody reads
                    lines.clear();
                }
                for (ssize_t got = 0; (got = ::read (line, text, sizeof text)) > 0;)
                    waiting.append (text, static_cast<std::size_t> (got));
                for (auto end = waiting.find ('\n'); end != waiting.npos; end = waiting.find ('\n'))
                {
                    take (waiting.substr (0, end));
                    waiting.erase (0, end + 1);
                }
            }
            pace.next();
        }
    }

    void take (const std::string& text)
    {
        long long x = 0, y = 0, z = 0;
        if (text.empty()) return;
        last = text;
        if (std::sscanf (text.c_str(), "%lld %lld %lld", &x, &y, &z) == 3)
            all.push_back (1e-6 * static_cast<double> (z));
        else
            ++broken_lines;
    }

    const unsigned lines_at_once;
    int line = -1, kept_open = -1;
    mutable std::mutex mutex;
    std::vector<double> all;
    std::string last;
    std::atomic<int> broken_lines = 0;
    std::atomic<bool> is_over = false;
    std::thread runs;
};

constexpr auto wall = R"({ "format": "tactus-graph", "version": 2, "name": "wall", "rate_hz": 1000,
  "nodes": { "hand": { "type": "device.position", "role": "stylus" },
             "wall": { "type": "deform.plane", "params": { "stiffness": 500 } },
             "motor": { "type": "device.force", "role": "stylus" } },
  "wires": ["hand.position -> wall.position", "wall.force -> motor.force"] })";

using test::soon;

const host::hid::LoadedProfiles& noProfiles()
{
    static const host::hid::LoadedProfiles none;
    return none;
}
}   // namespace

TEST_CASE ("a graph is played on a serial device whose driver is a plugin", "[plugins][safety]")
{
    ::setenv ("TACTUS_PLUGINS", test::driverFolder().c_str(), 1);
    Board board;
    test::Sketch s;
    s.node ("hand", "device.position").node ("wall", "deform.plane", { { "stiffness", 500.0 } }).node ("motor", "device.force");
    s.wire ("hand.position -> wall.position").wire ("wall.force -> motor.force");
    host::LiveSession::Options options;
    options.devices.given = { { "stylus", host::parsePluginDevice ("serial_arm:" + board.port), {} } };
    host::Hardware hardware { host::hid::thisComputer(), noProfiles, nullptr };
    {
        host::LiveSession session { catalogue(), hardware, std::move (options) };
        auto messages = session.load (s.graph);
        INFO (test::text (messages));
        REQUIRE (session.isLoaded());
        CHECK (session.clockRole().empty());   // a timer ticks the run
        messages = session.openDevices();
        INFO (test::text (messages));
        REQUIRE_FALSE (hasErrors (messages));
        CHECK (session.drivesDevice());
        CHECK_FALSE (test::has (messages, "device/missing_tool"));
        REQUIRE (session.pluginRoles().size() == 1);
        CHECK (session.pluginRoles()[0].device->about().rate_hz == 1000.0);
        CHECK (board.force() == 0.0);
        session.start ({});
        const auto until = [&] (auto isSo) {
            return soon ([&] {
                session.poll();
                return isSo();
            });
        };
        CHECK (until ([&] { return board.forces().size() > 100; }));
        CHECK (board.force() == 0.0);   // the tool is above the wall

        board.height = -2e-3;   // 2 mm x 500 N/m
        CHECK (until ([&] { return board.force() == Approx (1.0); }));
        CHECK (until ([&] { return ! session.health().empty() && session.health()[0].rate_hz; }));
        CHECK (session.health()[0].profile == "serial_arm");
        CHECK (session.health()[0].connected);

        board.height = -20e-3;   // 10 N would be more than its driver allows
        CHECK (until ([&] { return board.force() == Approx (3.0); }));
        board.height = 1e-3;
        CHECK (until ([&] { return board.force() == 0.0; }));

        board.height = -2e-3;
        CHECK (until ([&] { return board.force() == Approx (1.0); }));
        board.is_silent = true;   // the board hangs
        CHECK (until ([&] { return board.force() == 0.0; }));
        board.is_silent = false;
        CHECK (until ([&] { return board.force() == Approx (1.0); }));

        const auto ended = session.end();
        CHECK (ended.log);
        CHECK (soon ([&] { return board.force() == 0.0; }));
    }
    CHECK (soon ([&] { return board.lastLine() == "0 0 0"; }));
    CHECK (board.broken() == 0);
    double most = 0.0;
    for (const double f : board.forces())
        most = std::max (most, std::abs (f));
    CHECK (most <= 3.0 + 1e-6);
}

TEST_CASE ("a serial device that is unplugged loses the force, and the driver finds it again", "[plugins][safety]")
{
    ::setenv ("TACTUS_PLUGINS", test::driverFolder().c_str(), 1);
    const TemporaryFolder folder;
    const auto port = (folder / "tty").string();
    auto board = std::make_unique<Board>();
    std::filesystem::create_symlink (board->port, port);
    const auto made = host::openPluginDevice ({ { "driver", "serial_arm" }, { "port", port } });
    INFO (test::text (made.messages));
    REQUIRE (made.device);
    auto& device = dynamic_cast<host::PluginDevice&> (*made.device);
    device.prepare (1e-3);
    const auto isValid = [&] {
        const auto reading = device.read();
        device.write ({});
        return reading.valid;
    };
    CHECK (soon (isValid));
    board.reset();
    CHECK (soon ([&] { return ! device.isConnected(); }));
    CHECK_FALSE (isValid());

    board = std::make_unique<Board>();
    std::filesystem::remove (port);
    std::filesystem::create_symlink (board->port, port);
    CHECK (soon (isValid));
    CHECK (device.counts().departures == 1);
}

TEST_CASE ("a serial device whose lines come in batches is driven, and none of them is lost", "[plugins]")
{
    ::setenv ("TACTUS_PLUGINS", test::driverFolder().c_str(), 1);
    Board board { 16 };
    const auto made = host::openPluginDevice ({ { "driver", "serial_arm" }, { "port", board.port } });
    INFO (test::text (made.messages));
    REQUIRE (made.device);
    auto& device = dynamic_cast<host::PluginDevice&> (*made.device);
    device.prepare (1e-3);
    int after_lost = 0, valid = 0;
    const auto tick = [&] {
        const auto reading = device.read();
        after_lost += reading.fault == ReadingFault::lost ? 1 : 0;
        valid += reading.valid ? 1 : 0;
        Effort effort;
        if (reading.valid) effort.force.z() = 1.0;
        device.write (effort);
        return board.force() == Approx (1.0) && valid >= 500;
    };
    CHECK (test::eventually (1ms, tick));
    CHECK (after_lost == 0);
    CHECK (device.counts().readings > 100);
    CHECK (device.counts().lost == 0);
    CHECK (board.broken() == 0);
}

TEST_CASE ("a program that is killed while it pushes leaves a serial device at rest", "[plugins][safety]")
{
    Board board;
    board.height = -2e-3;
    const test::Scratch scratch;
    const auto graph = scratch.write ("wall.json", wall);
    test::Running play { { "play", graph, "--device", "stylus=serial_arm:" + board.port, "--plugins", test::driverFolder().string(), "--session", "off",
                           "--osc", "off" } };
    REQUIRE (play.says ("Ctrl-C stops"));
    REQUIRE (soon ([&] { return board.force() == Approx (1.0); }));
    play.signal (SIGKILL);
    CHECK (soon ([&] { return board.lastLine() == "0 0 0"; }));
    CHECK (test::stays (50ms, [&] { return board.force() == 0.0; }));
}

TEST_CASE ("play on a serial device ends with an account of it, and check-plugin examines it", "[plugins]")
{
    Board board;
    const test::Scratch scratch;
    const auto graph = scratch.write ("wall.json", wall);
    const std::vector<std::string> words { "play", graph, "--device", "stylus=serial_arm:" + board.port, "--plugins", test::driverFolder().string(),
                                           "--session", "off", "--osc", "off", "--duration", "1" };
    const auto ran = test::runTactus (words);
    INFO (ran.err);
    CHECK (ran.status == 0);
    CHECK (ran.err.find ("stylus (serial_arm): ") != std::string::npos);
    CHECK (ran.err.find (" efforts written, 0 failed") != std::string::npos);

    const auto checked = test::runTactus ({ "check-plugin", test::driverFile ("serial_arm").string(), "--strict", "3", "--open",
                                            Json { { "port", board.port } }.dump() });
    INFO (checked.out);
    CHECK (checked.status == 0);
    CHECK (checked.out.find ("driver 'serial_arm', version '1.0.0'") != std::string::npos);
    CHECK (board.force() == 0.0);

    const auto offline = test::runTactus ({ "render", graph, "--device", "stylus=serial_arm:" + board.port, "--plugins", test::driverFolder().string(),
                                            "--duration", "0.1" });
    CHECK (offline.status != 0);
    CHECK (offline.err.find ("device/real") != std::string::npos);
}
