// SPDX-License-Identifier: MIT
// Files that keep reports apart, over a pair of sockets.

#include "support/no_allocation.hpp"
#include "support/waiting.hpp"

#include <host/base/platform/report_file.hpp>

#include <catch2/catch.hpp>

#if defined(__linux__)

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <span>
#include <thread>

using namespace tactus::host;
using namespace std::chrono_literals;
using Kind = ReportFile::Outcome::Kind;
using Clock = ReportFile::Clock;

namespace
{
struct Link
{
    Link()
    {
        int both[2] {};
        REQUIRE (::socketpair (AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, both) == 0);
        device = both[0];
        file = ReportFile (both[1]);
    }
    ~Link() { unplug(); }

    bool send (std::span<const std::uint8_t> report) const { return ::write (device, report.data(), report.size()) == static_cast<ssize_t> (report.size()); }
    void unplug()
    {
        if (device >= 0) ::close (device);
        device = -1;
    }

    int device = -1;
    ReportFile file { -1 };
};

constexpr std::array<std::uint8_t, 4> first { 1, 2, 3, 4 }, second { 5, 6, 7, 8 };
}   // namespace

TEST_CASE ("each read of a report file takes one report, and truncates a long one", "[hid][platform]")
{
    Link link;
    REQUIRE (link.send (first));
    REQUIRE (link.send (second));
    std::array<std::uint8_t, 8> large {};
    std::array<std::uint8_t, 2> small {};
    auto got = link.file.read (large, {});
    CHECK (got.what == Kind::report);
    CHECK (got.size == 4);
    CHECK (large[3] == 4);
    got = link.file.read (small, {});
    CHECK (got.what == Kind::report);
    CHECK (got.size == 2);
    CHECK (small[1] == 6);
    CHECK (link.file.read (large, {}).what == Kind::nothing);
}

TEST_CASE ("a report file waits until the given time, or until a report arrives, and allocates nothing", "[hid][platform]")
{
    Link link;
    std::array<std::uint8_t, 8> into {};
    const tactus::test::Stopwatch watch;
    const auto until = tactus::test::fromNow (1500us);
    const NoAllocation watched;
    const auto in_vain = link.file.read (into, until);
    const int allocations = watched.allocations(), locks = watched.locks();
    CHECK (in_vain.what == Kind::nothing);
    CHECK (watch.hasRun (1500us));
    CHECK (allocations == 0);
    CHECK (locks == 0);

    bool sent = false;
    std::jthread sender { [&] {
        tactus::test::letPass (2ms);
        sent = link.send (first);
    } };
    const auto got = link.file.read (into, tactus::test::fromNow (60s));
    sender.join();
    CHECK (sent);
    CHECK (got.what == Kind::report);
}

TEST_CASE ("a report file says when its device is gone", "[hid][platform]")
{
    Link link;
    std::array<std::uint8_t, 8> into {};
    std::jthread puller { [&] {
        tactus::test::letPass (2ms);
        link.unplug();
    } };
    const auto waited = link.file.read (into, tactus::test::fromNow (60s));
    puller.join();
    CHECK (waited.what == Kind::failure);
    CHECK (waited.error != 0);
    CHECK (link.file.read (into, {}).what == Kind::failure);

    ReportFile closed { -1 };
    CHECK (closed.read (into, {}).what == Kind::failure);
    CHECK_FALSE (ReportFile::open ("/dev/there/is/no/such/device"));
    CHECK (ReportFile::open ("/dev/null"));
}

#endif
