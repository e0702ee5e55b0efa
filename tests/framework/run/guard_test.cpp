// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/run/guard.hpp>

#include <catch2/catch.hpp>

#include <bit>
#include <cstdint>
#include <vector>

using namespace tactus;

namespace
{
constexpr double dt = 1e-3;
constexpr double endless = std::numeric_limits<double>::infinity();
const double not_a_number = std::numeric_limits<double>::quiet_NaN();

const Reading fresh;
const Reading silent { .valid = false };

Guard guardWith (const GuardLimits& limits)
{
    Guard guard;
    guard.prepare (limits, dt);
    return guard;
}

Effort pushing (double x, double y = 0.0, double z = 0.0) { return { .force = { x, y, z } }; }

bool sameBits (const Vec3& a, const Vec3& b)
{
    for (int i = 0; i < 3; ++i)
        if (std::bit_cast<std::uint64_t> (a[i]) != std::bit_cast<std::uint64_t> (b[i])) return false;
    return true;
}

bool sameBits (const Channels& a, const Channels& b)
{
    for (int i = 0; i < std::max (a.size(), b.size()); ++i)
        if (a.has (i) && b.has (i) ? std::bit_cast<std::uint64_t> (a[i]) != std::bit_cast<std::uint64_t> (b[i]) : a[i] != b[i]) return false;
    return true;
}

double norm (const Vec3& v) { return v.stableNorm(); }

// Numbers of all magnitudes, up to the limits of a double; some are whole numbers, so that values repeat.
rc::Gen<double> anyFinite()
{
    return rc::gen::oneOf (
        rc::gen::map (rc::gen::inRange (-20, 21), [] (int i) { return 1.0 * i; }),
        rc::gen::map (rc::gen::inRange (-1'000'000, 1'000'001), [] (int i) { return 1e-5 * i; }),
        rc::gen::element (0.0, -0.0, 5e-324, -1e-310, 1e154, -1.7e308, 1.7e308));
}

rc::Gen<double> anyNumber()
{
    return rc::gen::weightedOneOf<double> ({ { 30, anyFinite() }, { 1, rc::gen::element (endless, -endless, not_a_number) } });
}

rc::Gen<Vec3> vectorOf (const rc::Gen<double>& part)
{
    return rc::gen::map (rc::gen::tuple (part, part, part), [] (const auto& t) { return Vec3 (std::get<0> (t), std::get<1> (t), std::get<2> (t)); });
}

rc::Gen<Channels> channelsOf (const rc::Gen<double>& part)
{
    return rc::gen::map (rc::gen::container<std::vector<double>> (part), [] (const auto& values) {
        Channels all;
        for (std::size_t i = 0; i < std::min (values.size(), std::size_t { 4 }); ++i)
            all.set (static_cast<int> (i), values[i]);
        return all;
    });
}

struct Tick
{
    Effort wanted;
    Reading reading;
    bool halt = false, stop = false, rearm = false;
};

rc::Gen<Tick> anyTick()
{
    const auto rarely = rc::gen::map (rc::gen::inRange (0, 12), [] (int i) { return i == 0; });
    const auto age = rc::gen::weightedOneOf<double> ({ { 20, rc::gen::just (0.0) }, { 1, rc::gen::element (0.004, 0.1, endless, not_a_number, -1.0) } });

    const auto brake = rc::gen::weightedOneOf<double> ({ { 20, rc::gen::map (anyFinite(), [] (double v) { return std::abs (v); }) }, { 1, anyNumber() } });
    const auto wanted = rc::gen::map (
        rc::gen::tuple (vectorOf (anyNumber()), vectorOf (anyNumber()), channelsOf (anyNumber()), channelsOf (anyNumber()), brake), [] (const auto& t) {
            return Effort { std::get<0> (t), std::get<1> (t), std::get<2> (t), std::get<3> (t), std::get<4> (t) };
        });
    const auto near_place = rc::gen::map (rc::gen::inRange (-100, 101), [] (int i) { return 1e-5 * i; });
    const auto places = vectorOf (rc::gen::weightedOneOf<double> ({ { 20, near_place }, { 1, anyNumber() } }));
    const auto buttons = rc::gen::map (rc::gen::inRange (0, 20), [] (int i) { return i < 18 ? 1u : 0u; });

    return rc::gen::map (rc::gen::tuple (wanted, places, age, rarely, rarely, rarely, buttons),
                         [] (const auto& t) {
                             Tick tick;
                             tick.wanted = std::get<0> (t);
                             tick.reading.position = std::get<1> (t);
                             tick.reading.age = std::get<2> (t);
                             tick.reading.valid = ! std::get<3> (t);
                             tick.reading.buttons = std::get<6> (t);
                             tick.halt = std::get<4> (t);
                             tick.rearm = std::get<5> (t);
                             tick.stop = tick.rearm && tick.halt;
                             return tick;
                         });
}

rc::Gen<GuardLimits> anyLimits()
{
    const auto limit = rc::gen::element (endless, endless, 0.0, 0.1, 3.0, 12.0);
    const auto slew = rc::gen::element (endless, endless, 0.0, 10.0, 500.0, 1e5);
    const auto ramp = rc::gen::element (0.0, 0.0, 0.002, 0.5, endless);
    const auto watchdog = rc::gen::element (endless, 0.02, 0.0);

    const auto rarely = rc::gen::element (endless, endless, endless, 0.01, 0.5);
    const auto window = rc::gen::element (0.0, 0.01, 1.0, endless);
    const auto buttons = rc::gen::element (0u, 0u, 1u);

    return rc::gen::map (rc::gen::tuple (limit, limit, slew, slew, ramp, watchdog, limit, slew, limit, rarely, rarely, window, rarely, window, buttons),
                         [] (const auto& t) {
                             return GuardLimits {
                                 .max_force = std::get<0> (t),
                                 .max_torque = std::get<1> (t),
                                 .max_slew = std::get<2> (t),
                                 .max_torque_slew = std::get<3> (t),
                                 .ramp = std::get<4> (t),
                                 .watchdog = std::get<5> (t),
                                 .max_axis_effort = std::get<6> (t),
                                 .max_axis_slew = std::get<7> (t),
                                 .max_signal = std::get<8> (t),
                                 .max_speed = std::get<9> (t),
                                 .max_impulse = std::get<10> (t),
                                 .impulse_window = std::get<11> (t),
                                 .max_energy = std::get<12> (t),
                                 .energy_window = std::get<13> (t),
                                 .dead_man_buttons = std::get<14> (t),
                             };
                         });
}

std::vector<Tick> anyRun()
{
    return *rc::gen::container<std::vector<Tick>> (anyTick());
}

/// Calls check (tick, effort before, effort now) for every tick of a run.
template <typename Check>
void play (Guard& guard, const std::vector<Tick>& run, Check check)
{
    Effort before;
    for (const auto& tick : run)
    {
        tick.halt ? guard.halt() : guard.resume();
        if (tick.rearm) guard.rearm();
        if (tick.stop) guard.emergencyStop();
        const Effort now = guard (tick.wanted, tick.reading);
        check (tick, before, now);
        before = now;
    }
}
}   // namespace

TEST_CASE ("guard: without limits, a finite effort passes through bit for bit, regardless of earlier efforts", "[framework][guard]")
{
    test::property ("any run", [] {
        auto guard = guardWith ({});
        auto run = anyRun();
        for (auto& tick : run)
            tick.stop = tick.rearm = false;   // after rearm() there is a ramp
        play (guard, run, [&] (const Tick& tick, const Effort&, const Effort& now) {
            if (guard.stop() != Guard::Stop::none) return;
            RC_ASSERT (sameBits (now.force, tick.wanted.force));
            RC_ASSERT (sameBits (now.torque, tick.wanted.torque));
            RC_ASSERT (sameBits (now.axes, tick.wanted.axes));
            RC_ASSERT (sameBits (now.signals, tick.wanted.signals));
            RC_ASSERT (now.brake == tick.wanted.brake);
        });
    });
}

TEST_CASE ("guard: a stop before the first effort is marked, and the next one is not", "[framework][guard]")
{
    auto guard = guardWith ({ .watchdog = 10e-3 });
    guard (pushing (1.0), silent);
    CHECK (guard.latest().why == Guard::Stop::stale);
    CHECK (guard.latest().at_start);
    CHECK_FALSE (guard.hasBegun());
    guard (pushing (1.0), fresh);
    CHECK (guard.hasBegun());
    CHECK (guard.latest().at_start);
    guard (pushing (1.0), { .age = 1.0, .valid = false });
    CHECK (guard.events() == 2);
    CHECK_FALSE (guard.latest().at_start);
    guard.prepare ({ .watchdog = 10e-3 }, dt);
    CHECK_FALSE (guard.hasBegun());
}

TEST_CASE ("guard: a value that is not a number never reaches a device", "[framework][guard]")
{
    test::property ("any run, any limits", [] {
        auto guard = guardWith (*anyLimits());
        play (guard, anyRun(),
              [] (const Tick&, const Effort&, const Effort& now) { RC_ASSERT (isFinite (now.force, now.torque, now.axes, now.signals, now.brake)); });
    });

    test::property ("any limits, and any time between two ticks: none, less than none, or not a number", [] {
        auto guard = guardWith (*anyLimits());
        for (const auto& tick : anyRun())
        {
            const double passed = *rc::gen::element (0.0, 0.0, dt, 5e-324, -1.0, endless, not_a_number);
            const auto& now = guard (tick.wanted, tick.reading, passed);
            RC_ASSERT (isFinite (now.force, now.torque, now.axes, now.signals, now.brake));
        }
    });

    test::property ("limits, periods and ages that are not numbers", [] {
        const auto wild = rc::gen::element (not_a_number, -1.0, endless, -endless, 0.0, 1.0, 1.7e308);
        Guard guard;
        guard.prepare ({ *wild, *wild, *wild, *wild, *wild, *wild, *wild, *wild, *wild, *wild, *wild, *wild, *wild, *wild, *wild }, *wild);
        play (guard, anyRun(), [&] (const Tick&, const Effort&, const Effort& now) {
            RC_ASSERT (isFinite (now.force, now.torque, now.axes, now.signals, now.brake));
            RC_ASSERT_FALSE (describe (guard.latest()).empty());
        });
    });
}

TEST_CASE ("guard: a change across the whole range of a double remains finite", "[framework][guard]")
{
    Guard guard;
    guard.prepare ({ .max_slew = 1.7e308 }, 1.0);

    CHECK (guard (pushing (1.7e308), fresh).force.x() == Approx (1.7e308));
    CHECK (std::abs (guard (pushing (-1.7e308), fresh).force.x()) < 1e300);
    CHECK (guard (pushing (-1.7e308), fresh).force.x() == Approx (-1.7e308));
}

TEST_CASE ("guard: no output exceeds its limit", "[framework][guard]")
{
    test::property ("any run, any limits", [] {
        const auto limits = *anyLimits();
        auto guard = guardWith (limits);
        play (guard, anyRun(), [&] (const Tick&, const Effort&, const Effort& now) {
            RC_ASSERT (norm (now.force) <= limits.max_force * (1 + 1e-15));
            RC_ASSERT (norm (now.torque) <= limits.max_torque * (1 + 1e-15));
            for (const double axis : now.axes)
                RC_ASSERT (std::abs (axis) <= limits.max_axis_effort);
            for (const double signal : now.signals)
                RC_ASSERT (std::abs (signal) <= limits.max_signal);
        });
    });
}

TEST_CASE ("guard: one factor scales force, torque and axes, so what they do together keeps its direction", "[framework][guard]")
{
    const GuardLimits limits { .max_force = 2.0, .max_torque = 0.1, .max_axis_effort = 1.0, .max_signal = 1.0 };
    const auto limited = [&] (const Effort& wanted) {
        auto guard = guardWith (limits);
        return guard (wanted, fresh);
    };

    SECTION ("the part that exceeds its limit most decides; signals are limited by themselves")
    {
        const auto e = limited ({ .force = { 3, 0, 0 }, .torque = { 0, 0.05, 0 }, .axes = { 0.5, -4.0 }, .signals = { 5.0, 0.3 } });
        CHECK (e.axes[1] == Approx (-1.0));
        CHECK (e.axes[0] == Approx (0.125));
        CHECK (e.force.x() == Approx (0.75));
        CHECK (e.torque.y() == Approx (0.0125));
        CHECK (e.signals[0] == 1.0);
        CHECK (e.signals[1] == 0.3);
    }

    SECTION ("a part that is limited to 0 does not remove the others")
    {
        auto none = limits;
        none.max_torque = 0.0;
        auto guard = guardWith (none);
        const auto e = guard ({ .force = { 1, 0, 0 }, .torque = { 0, 0.05, 0 } }, fresh);
        CHECK (e.force.x() == 1.0);
        CHECK (e.torque.isZero (0.0));
    }

    test::property ("a slew limit of one part moves all along a straight line", [] {
        const auto any = [] { return *rc::gen::inRange (-100, 101) / 100.0; };
        auto guard = guardWith ({ .max_slew = 1.0 / dt, .max_torque_slew = 0.1 / dt, .max_axis_slew = 0.5 / dt });
        Effort last;
        for (int k = 0; k < 10; ++k)
        {
            const Effort to { .force = { any(), any(), 0 }, .torque = { any(), 0, 0 }, .axes = { any() } };
            const auto now = guard (to, fresh);
            const double way = to.torque.x() - last.torque.x();
            RC_PRE (std::abs (way) > 1e-3);
            const double s = (now.torque.x() - last.torque.x()) / way;
            RC_ASSERT (s >= 0.0);
            RC_ASSERT (s <= 1.0 + 1e-12);
            RC_ASSERT ((now.force - last.force - s * (to.force - last.force)).norm() <= 1e-12);
            RC_ASSERT (std::abs (now.axes[0] - last.axes[0] - s * (to.axes[0] - last.axes[0])) <= 1e-12);
            last = now;
        }
    });
}

TEST_CASE ("guard: the effort never changes faster than the slew limit, even in stops and recoveries", "[framework][guard]")
{
    test::property ("any run, any limits", [] {
        const auto limits = *anyLimits();
        auto guard = guardWith (limits);
        play (guard, anyRun(), [&] (const Tick&, const Effort& before, const Effort& now) {
            // The slack is the rounding error of a sum: one ulp of the force itself.
            const auto slack = [] (const Vec3& a, const Vec3& b) { return 1e-15 * (norm (a) + norm (b)); };
            RC_ASSERT (norm (0.5 * now.force - 0.5 * before.force) <= 0.5 * limits.max_slew * dt + slack (now.force, before.force));
            RC_ASSERT (norm (0.5 * now.torque - 0.5 * before.torque) <= 0.5 * limits.max_torque_slew * dt + slack (now.torque, before.torque));
            for (int i = 0; i < std::max (now.axes.size(), before.axes.size()); ++i)
                RC_ASSERT (std::abs (0.5 * now.axes[i] - 0.5 * before.axes[i])
                           <= 0.5 * limits.max_axis_slew * dt + 1e-15 * (std::abs (now.axes[i]) + std::abs (before.axes[i])));
        });
    });
}

TEST_CASE ("guard: an effort near the largest double exceeds no limit, not by one bit", "[framework][guard][safety]")
{
    const auto huge = GENERATE (1e300, 1.7e306, 1e308, 1.7e308);
    const auto most = GENERATE (0.01, 0.3, 7e-5);

    SECTION ("of slew")
    {
        auto guard = guardWith ({ .max_slew = most / dt });
        CHECK (guard ({ .force = { 0, -huge, 1e-5 * huge } }, fresh).force.norm() <= most);
        CHECK (guard ({ .force = { huge, 0, 0 }, .torque = { 0, huge, 0 } }, fresh).force.y() >= -most);
    }

    SECTION ("of size")
    {
        auto guard = guardWith ({ .max_force = most, .max_torque = most });
        const auto now = guard ({ .force = { 0.5 * huge, -huge, 0 }, .torque = { 0, 0.3 * huge, huge } }, fresh);
        CHECK (now.force.norm() <= most);
        CHECK (now.torque.norm() <= most);
        CHECK (std::max (now.force.norm(), now.torque.norm()) > 0.999 * most);
    }
}

TEST_CASE ("guard: a stop takes the fade time and is never a step, regardless of its cause and of anything that happens meanwhile", "[framework][guard]")
{
    test::property ("any run, any limits except slew limits, which lengthen the stop", [] {
        auto limits = *anyLimits();
        limits.max_slew = limits.max_torque_slew = limits.max_axis_slew = endless;
        auto guard = guardWith (limits);
        Effort at_stop;
        int ticks = 0;
        play (guard, anyRun(), [&] (const Tick&, const Effort& before, const Effort& now) {
            if (guard.stop() == Guard::Stop::none)
            {
                ticks = 0;
                return;
            }
            if (ticks++ == 0) at_stop = before;
            const double part = dt / Guard::fade_s * (1 + 1e-12);
            RC_ASSERT (norm (0.5 * now.force - 0.5 * before.force) <= 0.5 * part * norm (at_stop.force) + 1e-320);
            RC_ASSERT (norm (0.5 * now.torque - 0.5 * before.torque) <= 0.5 * part * norm (at_stop.torque) + 1e-320);
            for (int i = 0; i < at_stop.axes.size(); ++i)
                RC_ASSERT (std::abs (0.5 * now.axes[i] - 0.5 * before.axes[i]) <= 0.5 * part * std::abs (at_stop.axes[i]) + 1e-320);
            for (int i = 0; i < at_stop.signals.size(); ++i)
                RC_ASSERT (std::abs (0.5 * now.signals[i] - 0.5 * before.signals[i]) <= 0.5 * part * std::abs (at_stop.signals[i]) + 1e-320);
            if (ticks > Guard::fade_s / dt + 1) RC_ASSERT (guard.isAtRest());
        });
    });
}

TEST_CASE ("guard: a force above the limit keeps its direction", "[framework][guard]")
{
    test::property ("any force", [] {
        const auto wanted = *vectorOf (anyFinite());
        const auto most = *rc::gen::element (0.1, 3.0, 12.0);
        auto guard = guardWith ({ .max_force = most });
        const Vec3 now = guard ({ .force = wanted }, fresh).force;

        if (norm (wanted) <= most)
            RC_ASSERT (sameBits (now, wanted));
        else
        {
            const double scale = wanted.cwiseAbs().maxCoeff();
            RC_ASSERT (norm (now) == Approx (most).epsilon (1e-14));
            RC_ASSERT ((now.normalized() - (wanted / scale).normalized()).norm() < 1e-14);
        }
    });
}

TEST_CASE ("guard: a session starts from zero and reaches full effort after the ramp", "[framework][guard]")
{
    auto guard = guardWith ({ .ramp = 0.1 });
    double before = 0.0;

    for (int k = 1; k <= 100; ++k)
    {
        const double now = guard (pushing (2.0), fresh).force.x();
        CHECK (now == Approx (2.0 * k / 100));
        CHECK (now - before < 2.0 / 100 + 1e-12);
        before = now;
    }
    CHECK (guard (pushing (2.0), fresh).force.x() == 2.0);
}

TEST_CASE ("guard: a stop is not a step, even without any limits", "[framework][guard]")
{
    const auto [bad, seen, why] = GENERATE (table<Effort, Reading, Guard::Stop> ({
        { pushing (not_a_number), fresh, Guard::Stop::not_finite },
        { { .torque = { 0, endless, 0 } }, fresh, Guard::Stop::not_finite },
        { pushing (4.0), silent, Guard::Stop::stale },
    }));

    auto guard = guardWith ({});
    double before = guard (pushing (4.0), fresh).force.x();
    REQUIRE (before == 4.0);

    for (int k = 1; k <= 5; ++k)
    {
        const double now = guard (bad, seen).force.x();
        CHECK (now == Approx (4.0 * (1 - k / 5.0)).margin (1e-12));
        CHECK (guard.stop() == why);
    }
    CHECK (guard (bad, seen).force.x() == 0.0);
    CHECK (guard.isAtRest());
}

TEST_CASE ("guard: with a slew limit, a stop takes as long as the limit requires", "[framework][guard]")
{
    auto guard = guardWith ({ .max_slew = 100.0 });
    for (int k = 0; k < 100; ++k)
        guard (pushing (4.0), fresh);

    int ticks = 0;
    while (! guard.isAtRest() && ticks < 1000)
    {
        guard (pushing (not_a_number), fresh);
        ++ticks;
    }
    CHECK (ticks == Approx (40).margin (4));   // 4 N at 0.1 N per tick, after a fade of 5 ticks
}

TEST_CASE ("guard: after a single bad tick, the effort returns through the ramp, without a step", "[framework][guard]")
{
    auto guard = guardWith ({ .ramp = 0.05 });
    Effort last;
    for (int k = 0; k < 60; ++k)
        last = guard (pushing (1.0), fresh);
    REQUIRE (last.force.x() == 1.0);

    double before = guard (pushing (not_a_number), fresh).force.x(), lowest = before, largest_change = 1.0 - before;
    for (int k = 0; k < 49; ++k)
    {
        const double now = guard (pushing (1.0), fresh).force.x();
        largest_change = std::max (largest_change, std::abs (now - before));
        lowest = std::min (lowest, now);
        before = now;
    }
    CHECK (lowest == Approx (0.1).margin (0.03));
    CHECK (largest_change < 0.21);   // one fifth, because the fade takes 5 ticks
    CHECK (guard (pushing (1.0), fresh).force.x() == Approx (1.0));
    CHECK (guard.stop() == Guard::Stop::none);
}

TEST_CASE ("guard: while the effort returns after a stop, it never exceeds a constant push, however short the ramp is", "[framework][guard]")
{
    const double ramp = GENERATE (0.0, 0.001, 0.002, 0.004, 0.006, 0.02);
    auto guard = guardWith ({ .ramp = ramp });
    for (int k = 0; k < 30; ++k)
        guard (pushing (1.0), fresh);

    guard (pushing (not_a_number), fresh);
    for (int k = 0; k < 30; ++k)
        CHECK (guard (pushing (1.0), fresh).force.x() <= 1.0);
}

TEST_CASE ("guard: a reading older than the watchdog time stops the force, but a younger one does not", "[framework][guard]")
{
    auto guard = guardWith ({ .watchdog = 0.02 });

    CHECK (guard (pushing (1.0), { .age = 0.02 }).force.x() == 1.0);
    CHECK (guard (pushing (1.0), { .age = 0.0201 }).force.x() < 1.0);
    CHECK (guard.stop() == Guard::Stop::stale);

    for (int k = 0; k < 10; ++k)
        guard (pushing (1.0), { .age = 0.1 });
    CHECK (guard.isAtRest());

    CHECK (guard (pushing (1.0), { .age = not_a_number }).force.x() == 0.0);
    for (int k = 0; k < 29; ++k)
        REQUIRE (guard (pushing (1.0), fresh).force.x() == 0.0);
    guard (pushing (1.0), fresh);   // 30 ms, but for rounding
    CHECK (guard (pushing (1.0), fresh).force.x() == 1.0);
}

TEST_CASE ("guard: a device that reports too rarely gets no pulse with each report", "[framework][guard][safety]")
{
    const int apart = GENERATE (24, 35, 100, 1000), good = GENERATE (1, 2);   // ms between groups of reports, and reports in a group
    auto guard = guardWith ({ .watchdog = 0.02 });
    guard (pushing (1.0), fresh);
    double most = 0.0;
    for (int k = 1; k < 5000; ++k)
    {
        const int since = k % apart;
        const double age = since < good ? 0.0 : 1e-3 * (since - good + 1);
        const double force = guard (pushing (1.0), { .age = age }).force.x();
        if (k > 40) most = std::max (most, force);
    }
    CHECK (most == 0.0);

    // Reports that come in time again bring the force back.
    for (int k = 0; k < 32; ++k)
        guard (pushing (1.0), fresh);
    CHECK (guard (pushing (1.0), fresh).force.x() == 1.0);
}

TEST_CASE ("guard: a halt keeps the device at rest until it is resumed", "[framework][guard]")
{
    auto guard = guardWith ({ .max_slew = 1000.0, .ramp = 0.01 });
    for (int k = 0; k < 20; ++k)
        guard (pushing (3.0), fresh);
    REQUIRE (! guard.isAtRest());

    guard.halt();
    for (int k = 0; k < 10; ++k)
        guard (pushing (3.0), fresh);
    CHECK (guard.isAtRest());
    CHECK (guard.stop() == Guard::Stop::halted);

    guard.resume();
    for (int k = 0; k < 20; ++k)
        guard (pushing (3.0), fresh);
    CHECK (guard (pushing (3.0), fresh).force.x() == Approx (3.0));
}

TEST_CASE ("guard: the reason for a stop is reported with its numbers, and kept after the stop", "[framework][guard]")
{
    auto guard = guardWith ({ .watchdog = 0.02 });
    CHECK (describe (guard.latest()) == "not stopped");

    guard (pushing (1.0), { .age = 0.031 });
    CHECK (describe (guard.latest()) == "the last reading is 31 ms old; the watchdog allows 20 ms");
    guard (pushing (1.0), { .age = 0.5 });
    CHECK (describe (guard.latest()) == "the last reading is 31 ms old; the watchdog allows 20 ms");

    guard (pushing (1.0), fresh);
    CHECK (guard.stop() == Guard::Stop::none);
    CHECK (guard.latest().why == Guard::Stop::stale);

    guard (pushing (0.5, not_a_number, 1), fresh);
    CHECK (describe (guard.latest()) == "the graph asked for a force that is not a number: (0.5, nan, 1) N");
    guard (pushing (1.0), fresh);

    guard (pushing (1.0), silent);
    CHECK (describe (guard.latest()) == "the device has no valid reading");
}

TEST_CASE ("guard: the halt that ends a run does not hide the earlier reason for withholding the force", "[framework][guard]")
{
    Guard guard;
    guard.prepare ({}, dt);
    guard ({ .force = Vec3 (not_a_number, 0, 0) }, fresh);
    guard ({}, fresh);
    guard.halt();
    guard ({}, fresh);
    CHECK (guard.stop() == Guard::Stop::halted);
    CHECK (guard.latest().why == Guard::Stop::not_finite);
}

TEST_CASE ("guard: a graph that asks for more than the limits on most ticks of a second is reported, until it does not", "[guard]")
{
    auto guard = guardWith ({ .max_force = 1.0 });
    const auto run = [&] (double seconds, double force, int of_ten) {
        for (int k = 0; k < static_cast<int> (seconds / dt); ++k)
            guard (pushing (k % 10 < of_ten ? force : 0.5), fresh);
    };
    run (3.0, 1.0, 10);   // just within the limit
    CHECK_FALSE (guard.isClipping());
    run (3.0, 5.0, 3);   // peaks
    CHECK_FALSE (guard.isClipping());
    run (2.5, 5.0, 8);
    CHECK (guard.isClipping());
    run (2.5, 0.5, 10);
    CHECK_FALSE (guard.isClipping());
    run (2.5, 5.0, 10);
    CHECK (guard.isClipping());
    guard.halt();   // a stop has a message of its own
    run (2.5, 0.0, 10);
    CHECK (guard.stop() == Guard::Stop::halted);
}
