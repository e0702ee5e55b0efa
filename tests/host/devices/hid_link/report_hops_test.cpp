// SPDX-License-Identifier: MIT
// How many threads a report passes on its way to the answer, over sockets, a serial line and UDP. TACTUS_HOPS=3000 prints the times of so many
// reports; tests/bench/wires.py makes a table of them.

#include "fake_board.hpp"
#include "socket_board.hpp"
#include "support/no_allocation.hpp"
#include "support/waiting.hpp"

#include <host/devices/hid_link/hid_clock.hpp>
#include <host/devices/hid_link/line_reader.hpp>
#include <tactus/run/realtime.hpp>

#include <catch2/catch.hpp>

#if defined(__linux__)

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <future>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

using namespace tactus;
using namespace tactus::host::hid;
using host::WireFile;
using namespace std::chrono_literals;

namespace
{
using Clock = std::chrono::steady_clock;

/// The board at the far end of a wire.
struct FarEnd
{
    virtual ~FarEnd() = default;
    virtual bool send (const Bytes& report) = 0;   ///< false if there is no room
    virtual Bytes hear() = 0;                      ///< waits; empty if nothing comes
    virtual ConnectedDevice where() const { return {}; }
    virtual bool speaksFirst() const { return false; }   ///< the device must answer while it is opened
};

struct SocketEnd final : FarEnd
{
    bool send (const Bytes& report) override { return sockets.send (report); }
    Bytes hear() override { return sockets.hear (20s); }

    test::SocketBoard sockets;
};

struct SerialEnd final : FarEnd
{
    explicit SerialEnd (const Profile& p) : framing (p.wires.serial->framing), lines (framing, outputShapes (p)), file (make (path)) {}

    static std::optional<WireFile> make (std::string& path)
    {
        auto made = WireFile::makeTerminal (path);
        REQUIRE (made);
        return std::move (*made);
    }

    bool send (const Bytes& report) override
    {
        Bytes bytes (longestFrame (framing, report.size()));
        bytes.resize (writeFrame (framing, report, bytes));
        return file->write (bytes).size == bytes.size();
    }

    Bytes hear() override
    {
        Bytes bytes (65);
        const auto got = lines.read (*file, std::span (bytes).subspan (1), test::fromNow (60s));
        bytes.resize (got.what == WireFile::Outcome::Kind::report ? got.size + 1 : 0);   // over HID, a 0 comes first
        return bytes;
    }

    ConnectedDevice where() const override
    {
        ConnectedDevice device;
        device.wire = Wire::serial;
        device.path = path;
        return device;
    }

    std::string path;
    Framing framing;
    LineReader lines;
    std::optional<WireFile> file;
};

struct UdpEnd final : FarEnd
{
    UdpEnd()
    {
        auto made = WireFile::listenUdp (port);
        REQUIRE (made);
        file.emplace (std::move (*made));
    }

    bool send (const Bytes& report) override { return file->write (report).size == report.size(); }
    Bytes hear() override
    {
        Bytes bytes (65);
        const auto got = file->read (std::span (bytes).subspan (1), test::fromNow (60s));
        bytes.resize (got.what == WireFile::Outcome::Kind::report ? got.size + 1 : 0);
        return bytes;
    }

    ConnectedDevice where() const override
    {
        ConnectedDevice device;
        device.wire = Wire::udp;
        device.path = "127.0.0.1:" + std::to_string (port);
        return device;
    }

    bool speaksFirst() const override { return true; }

    int port = 0;
    std::optional<WireFile> file;
};

/// The board sends a report and waits for the answer. False if none comes.
bool isAnswered (FarEnd& end, std::uint16_t count)
{
    if (! end.send (test::boardReport (count, count))) return false;
    for (;;)
    {
        const auto bytes = end.hear();
        if (bytes.empty()) return false;
        const test::Told told { bytes, test::Told::How::output, {} };
        if (told.isEffort() && told.echo() == count) return true;
    }
}

/// How often this thread of the program has gone to sleep. -1: unknown.
long sleepsOf (int thread)
{
    std::ifstream status ("/proc/self/task/" + std::to_string (thread) + "/status");
    for (std::string line; std::getline (status, line);)
        if (const std::string key = "voluntary_ctxt_switches:"; line.starts_with (key)) return std::atol (line.c_str() + key.size());
    return -1;
}

long sleepsOfAll()
{
    rusage usage {};
    ::getrusage (RUSAGE_SELF, &usage);
    return usage.ru_nvcsw;
}

struct Measured
{
    int answered = 0, allocations = 0, locks = 0;   // the last two of the tick thread
    std::uint64_t read_by_tick = 0;
    long sleeps_of_reader = 0, sleeps = 0;
    double seconds = 0.0;
    std::vector<double> us;   // from each report to its answer, sorted

    double quantile (double part) const { return us.empty() ? 0.0 : us[static_cast<std::size_t> (part * static_cast<double> (us.size() - 1))]; }
};

struct Ticking final : Ticked
{
    explicit Ticking (HidDevice& d) : device (d) {}
    bool tick (double) noexcept override
    {
        device.read();
        device.write ({});
        return ! over.load (std::memory_order_relaxed);
    }

    HidDevice& device;
    std::atomic<bool> over = false;
};

/// The board sends a report each millisecond, and as soon as the answer to the last one is there.
Measured measure (Wire wire, bool lend, int reports, bool real_time)
{
    const test::BoardProfile made { .more = R"("wires": { "serial": { "framing": "cobs" }, "udp": {} },)", .steps = "" };
    const auto profile = made.make();
    std::unique_ptr<FarEnd> end;
    if (wire == Wire::hid) end = std::make_unique<SocketEnd>();
    if (wire == Wire::serial) end = std::make_unique<SerialEnd> (*profile);
    if (wire == Wire::udp) end = std::make_unique<UdpEnd>();
    test::SocketBoard no_sockets;
    auto& sockets = wire == Wire::hid ? static_cast<SocketEnd&> (*end).sockets : no_sockets;
    const auto what = end->where();
    auto opening = std::async (std::launch::async,
                               [&] { return HidPort::open (sockets, what, profile, { .look_again = 1h, .real_time = real_time, .lend = lend }); });
    Bytes asked (1);
    while (end->speaksFirst() && opening.wait_for (1ms) != std::future_status::ready)
    {
        static_cast<UdpEnd&> (*end).file->read (asked, {});   // learns who asks
        end->send (test::boardReport (0));
    }
    auto opened = opening.get();
    REQUIRE (opened);
    HidDevice device { std::move (*opened) };
    device.prepare (1e-3);
    HidClock clock { device.port(), 1000.0 };
    Ticking ticking { device };
    Measured measured;
    std::jthread tick { [&] {
        if (real_time) becomeRealTime (std::nullopt);
        const NoAllocation watched;
        clock.drive (ticking);
        measured.allocations = watched.allocations();
        measured.locks = watched.locks();
    } };
    std::jthread board { [&] {
        if (real_time) becomeRealTime (std::nullopt);
        for (int i = 1; i <= 20; ++i)
            if (! isAnswered (*end, static_cast<std::uint16_t> (i))) return;
        const test::Stopwatch all;
        const auto sleeps = sleepsOfAll(), of_reader = sleepsOf (sockets.reading_thread);
        test::Pace pace { 1ms };
        for (int i = 21; i <= reports + 20; ++i)
        {
            pace.next();
            const test::Stopwatch one;
            if (! isAnswered (*end, static_cast<std::uint16_t> (i))) break;
            measured.us.push_back (1e6 * one.s());
        }
        measured.sleeps = sleepsOfAll() - sleeps;
        measured.sleeps_of_reader = sleepsOf (sockets.reading_thread) - of_reader;
        measured.seconds = all.s();
    } };
    board.join();
    ticking.over = true;
    tick.join();
    measured.answered = static_cast<int> (measured.us.size());
    measured.read_by_tick = device.port().counts().read_by_tick;
    std::ranges::sort (measured.us);
    return measured;
}

void print (const char* how, const Measured& m)
{
    const auto each = [&] (long sleeps) { return static_cast<double> (sleeps) / std::max (1, m.answered); };
    std::cout << how << ": " << m.answered << " reports, p50 " << m.quantile (0.5) << ", p90 " << m.quantile (0.9) << ", p99 " << m.quantile (0.99);
    std::cout << ", p99.9 " << m.quantile (0.999) << ", max " << m.quantile (1.0) << " us; " << each (m.sleeps) << " thread switches a report, ";
    std::cout << each (m.sleeps_of_reader) << " of them in the reading thread\n";
}
}   // namespace

TEST_CASE ("a report reaches the tick thread without a stop at another thread, an allocation or a lock", "[hid][hops][threads]")
{
    const auto* wanted = std::getenv ("TACTUS_HOPS");
    const int reports = wanted ? std::stoi (wanted) : 200;
    const auto through = measure (Wire::hid, false, reports, wanted != nullptr), directly = measure (Wire::hid, true, reports, wanted != nullptr);
    if (wanted) print ("HID (sockets), through the reading thread", through);
    if (wanted) print ("HID (sockets)", directly);

    CHECK (through.answered == reports);
    CHECK (through.read_by_tick == 0);
    CHECK (through.allocations == 0);
    CHECK (through.locks == 0);
    CHECK (directly.answered == reports);
    CHECK (directly.read_by_tick >= static_cast<std::uint64_t> (reports) + 20 - 2);   // the reading thread may have read the first two
    CHECK (directly.allocations == 0);
    CHECK (directly.locks == 0);
    // The reading thread checks once a second whether it has to read again.
    CHECK (directly.sleeps_of_reader >= 0);
    CHECK (static_cast<double> (directly.sleeps_of_reader) <= 2.0 * directly.seconds + 5.0);
}

TEST_CASE ("a report over a serial line or UDP is answered by the tick thread that reads it, without an allocation or a lock", "[hid][wires][hops][threads]")
{
    const auto* wanted = std::getenv ("TACTUS_HOPS");
    const int reports = wanted ? std::stoi (wanted) : 200;
    const auto wire = GENERATE (Wire::serial, Wire::udp);
    const auto measured = measure (wire, true, reports, wanted != nullptr);
    if (wanted) print (wire == Wire::serial ? "serial (pseudo-terminal, cobs)" : "UDP (on this computer)", measured);
    CHECK (measured.answered == reports);
    CHECK (measured.read_by_tick > static_cast<std::uint64_t> (reports));
    CHECK (measured.allocations == 0);
    CHECK (measured.locks == 0);
}

#endif
