// SPDX-License-Identifier: MIT
// A device as the clock of a run, and the loop through the device.

#include "fake_board.hpp"

#include <host/devices/hid_link/hid_clock.hpp>
#include <host/devices/hid_link/open_device.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/run/device/sim.hpp>
#include <tactus/run/engine.hpp>
#include <tactus/run/runner.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <map>
#include <set>

using namespace tactus;
using namespace tactus::host::hid;
using test::boardReport;
using test::Bytes;
using test::FakeBoard;
using test::openBoard;
using namespace std::chrono_literals;

namespace
{
struct Each final : Ticked
{
    explicit Each (std::function<bool (double)> f) : what (std::move (f)) {}
    bool tick (double late_s) noexcept override { return what (late_s); }

    std::function<bool (double)> what;
};

/// A stroke over the board, in nm: pressed down, moved back and forth.
std::array<std::int32_t, 3> placeAt (int k)
{
    const double t = 1e-3 * k;
    return { static_cast<std::int32_t> (2e7 * std::sin (6.0 * t)), static_cast<std::int32_t> (5e6 * std::sin (1.3 * t)),
             static_cast<std::int32_t> (-1e6 * std::min (1.0, 4.0 * t) * (1.0 + 0.2 * std::sin (9.0 * t))) };
}

/// Plays back readings, tick by tick.
struct Recorded final : Device
{
    explicit Recorded (const std::vector<Reading>& r) : readings (r) {}
    void prepare (double) override {}
    Reading read() noexcept override { return readings[std::min (k, readings.size() - 1)]; }
    void write (const Effort& e) noexcept override
    {
        asked.push_back (e);
        ++k;
    }

    const std::vector<Reading>& readings;
    std::vector<Effort> asked;
    std::size_t k = 0;
};

/// Records the time that passes from tick to tick.
struct Times final : Journal
{
    void passed (double s) noexcept override { now = s; }
    void ticked (const Plan&) noexcept override { all.push_back (std::exchange (now, 1e-3)); }
    void tookOver (const Plan&) noexcept override {}
    void turned (std::size_t, std::size_t, double) noexcept override {}
    void outdone (std::size_t, std::size_t) noexcept override {}
    void struck (std::size_t, std::size_t, double) noexcept override {}
    void late (std::uint64_t) noexcept override {}
    void tightened (std::size_t, const GuardLimits&) noexcept override {}
    void halted() noexcept override {}
    void resumed() noexcept override {}
    void emergency() noexcept override {}
    void rearmed() noexcept override {}

    double now = 1e-3;
    std::vector<double> all;
};

/// Records the readings of a device.
struct Listening final : Device
{
    explicit Listening (Device& d) : device (d) {}
    void prepare (double dt) override { device.prepare (dt); }
    Reading read() noexcept override
    {
        readings.push_back (device.read());
        return readings.back();
    }
    void write (const Effort& e) noexcept override { device.write (e); }

    Device& device;
    std::vector<Reading> readings;
};

std::shared_ptr<Plan> dryWood()
{
    const auto loaded = loadGraph (TACTUS_SOURCE_DIR "/graphs/dry_wood.json");
    auto compiled = compile (loaded.graph, catalogue(), { .rate_hz = 1000.0 });
    REQUIRE (compiled.plan);
    return compiled.plan;
}
}   // namespace

TEST_CASE ("reports drive the ticks, a timer takes over while none arrive, then reports drive them again", "[hid]")
{
    FakeBoard board;
    const auto device = openBoard (board);
    HidClock clock { device->port(), 1000.0 };
    int k = 0, timed = 0, fell_silent_at = 0;
    std::uint16_t count = 0;
    bool was_timed = false, driven_again = false;
    board.send (boardReport (++count));
    Each each { [&] (double late) {
        ++k;
        CHECK (late >= 0.0);
        const bool now_timed = clock.isByTimer();
        timed += now_timed;
        driven_again = driven_again || (was_timed && ! now_timed && k > 60);
        was_timed = now_timed;
        if (k < 50)
            board.send (boardReport (++count));
        else if (k >= 60 && fell_silent_at == 0)
            fell_silent_at = k;
        if (k >= 60) board.send (boardReport (++count));
        return k < 120;
    } };
    clock.drive (each);
    CHECK (k == 120);
    CHECK (timed >= 9);
    CHECK (clock.ticksByTimer() == static_cast<std::uint64_t> (timed));
    CHECK (driven_again);
}

// Long because it is one scenario: a live run, the same readings offline, and a comparison of the two.
TEST_CASE ("a live run over dry wood sends the same forces as the offline run, bit for bit", "[hid]")
{
    FakeBoard board;
    constexpr int length = 1500;
    std::atomic<int> sent = 0;
    const auto sendNext = [&] {
        const int k = ++sent;
        if (k > length) return;
        const auto [x, y, z] = placeAt (k);
        board.send (boardReport (static_cast<std::uint16_t> (k), x, y, z));
    };
    board.on_write = [&] (const Bytes& b)   // each answer triggers the next report
    {
        if (b.size() == 25 && b[2] == 1) sendNext();
    };

    const test::BoardProfile profile { .max_rate = 1e5, .ramp = 0.02 };
    const auto limits = limitsOf (*profile.make(), {});
    std::vector<Reading> readings;
    Times times;
    std::uint64_t replaced = 0;   // answers that never reached the board, because ticks of the timer made newer ones
    {
        const auto device = openBoard (board, profile);
        Listening listening { *device };
        Engine engine { dryWood() };
        engine.attach ("stylus", listening, limits);
        engine.report (times);
        HidClock clock { device->port(), 1000.0 };
        sendNext();
        Runner runner { engine, clock, 1000.0, { .length = length } };
        runner.start();
        runner.wait();
        readings = std::move (listening.readings);
        CHECK (device->counts().lost == 0);
        replaced = device->port().counts().dropped;
        CHECK (replaced <= clock.ticksByTimer());
    }

    // Run the same readings offline, with the times that the guard has counted.
    Recorded recorded { readings };
    Engine engine { dryWood() };
    engine.attach ("stylus", recorded, limits);
    for (const double passed : times.all)
    {
        engine.passTime (passed);
        engine.tick();
    }

    const auto numberOf = [] (const Reading& reading) {
        for (int k = 1; k <= length; ++k)
            if (const auto [x, y, z] = placeAt (k); reading.position == Vec3 (x * 1e-9, y * 1e-9, z * 1e-9)) return k;
        return 0;
    };
    const auto micro = [] (double newton) { return static_cast<std::int32_t> (std::floor (newton / 1e-6 + 0.5)); };
    std::map<int, std::set<std::array<std::int32_t, 3>>> offline;   // by report number; several forces where the timer ticked
    for (std::size_t i = 0; i < readings.size(); ++i)
    {
        const Vec3 f = recorded.asked[i].force;
        offline[numberOf (readings[i])].insert ({ micro (f.x()), micro (f.y()), micro (f.z()) });
    }

    // At its end the live run halts; the offline one does not.
    const int end = numberOf (readings.at (length - 1));
    std::size_t compared = 0, different = 0, with_force = 0, at_rest = 0;
    for (const auto& told : board.told())
    {
        at_rest += ! told.isDriven();   // while the guard waits after a stall of the computer
        if (told.isDriven() && told.echo() > 0 && told.echo() < end)
        {
            const std::array force { told.force (0), told.force (1), told.force (2) };
            ++compared;
            different += ! offline[told.echo()].contains (force);
            with_force += force[0] != 0;
        }
    }
    CHECK (end > length / 2);
    CHECK (different == 0);
    CHECK (compared + at_rest + replaced + 20 > static_cast<std::size_t> (end));
    CHECK (compared > static_cast<std::size_t> (end) / 4);
    CHECK (with_force > compared / 2);
}
