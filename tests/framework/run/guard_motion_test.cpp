// SPDX-License-Identifier: MIT
// The guard's limits on rotation, axes and signals, and how limits are read and combined.
#include "support/sketch.hpp"

#include <support/property.hpp>
#include <tactus/run/device/guard_limits.hpp>
#include <tactus/run/run.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>

using namespace tactus;
using test::Sketch;

namespace
{
constexpr double dt = 1e-3;

Guard guardWith (const GuardLimits& limits, const DeviceLayout& layout = {})
{
    Guard guard;
    guard.prepare (limits, dt, layout);
    return guard;
}

/// A rotation vector no longer than pi, as devices report it.
Vec3 turnedTo (const Vec3& axis, double angle) { return axis * std::remainder (angle, 2.0 * std::numbers::pi); }

Vec3 anyDirection()
{
    const auto part = [] { return *rc::gen::inRange (-100, 101) / 100.0; };
    const Vec3 v (part(), part(), part());
    RC_PRE (v.norm() > 0.1);
    return v.normalized();
}

/// The tick at which the guard stops, counted from 1; 0 if it does not stop within `most` ticks.
template <typename Tick>
int stopsAt (Guard& guard, int most, Tick tick)
{
    for (int k = 0; k < most; ++k)
    {
        tick (k);
        if (guard.stop() != Guard::Stop::none) return k + 1;
    }
    return 0;
}

const DeviceLayout named { .axes = { "other", "trigger" }, .efforts = { "trigger" } };
const DeviceLayout numbered { .axes = { "x", "axis1", "axis2" }, .efforts = { "effort1", "effort2" } };
const DeviceLayout unknown { .axes = { "axis2", "pressure" }, .efforts = { "effort1" } };

std::string idsOf (const Messages& messages)
{
    std::string all;
    for (const auto& m : messages)
        all += (all.empty() ? "" : " ") + m.id + m.where;
    return all;
}

/// A device that reports the force it gets to its owner.
class Tool final : public Device
{
public:
    explicit Tool (double& f) : force (f) {}
    void prepare (double) override {}
    Reading read() noexcept override { return {}; }
    void write (const Effort& e) noexcept override { force = e.force.x(); }

private:
    double& force;
};
}   // namespace

TEST_CASE ("guard: a torque that drives the hand counts as energy, whatever the axis, and one that brakes does not", "[framework][guard]")
{
    test::property ("any axis, past any number of turns", [] {
        const Vec3 axis = anyDirection();
        const double speed = *rc::gen::element (0.5, 3.0, 20.0), torque = *rc::gen::element (-0.4, 0.05, 1.0);
        constexpr double most = 0.02;
        auto guard = guardWith ({ .max_energy = most, .energy_window = 1.0 });
        const int stopped = stopsAt (guard, 4000, [&] (int k) { guard ({ .torque = torque * axis }, { .rotation = turnedTo (axis, speed * k * dt) }); });
        const double power = torque * speed - most;
        if (power <= 0.0) RC_ASSERT (stopped == 0);
        if (power > 0.0 && most / power < 3.9) RC_ASSERT (std::abs (stopped - most / power / dt) <= 2.0);
    });
}

TEST_CASE ("guard: energy counts only the force and the torque that the motors rendered", "[framework][guard]")
{
    const auto stopped = [] (const Vec3& lost_force, const Vec3& lost_torque) {
        auto guard = guardWith ({ .max_energy = 0.01, .energy_window = 1.0 });
        return stopsAt (guard, 1000, [&] (int k) {
            Reading reading { .position = { 0.5 * k * dt, 0.0, 0.0 }, .rotation = { 0.5 * k * dt, 0.0, 0.0 } };
            reading.unrendered_force = lost_force;
            reading.unrendered_torque = lost_torque;
            guard ({ .force = { 1.0, 0.0, 0.0 }, .torque = { 1.0, 0.0, 0.0 } }, reading);
        });
    };
    const Vec3 none = Vec3::Zero(), all { 1.0, 0.0, 0.0 };
    CHECK (stopped (none, none) == Approx (0.01 / (1.0 - 0.01) / dt).margin (2.0));
    CHECK (stopped (all, none) == Approx (0.01 / (0.5 - 0.01) / dt).margin (2.0));
    CHECK (stopped (none, 0.5 * all) == Approx (0.01 / (0.75 - 0.01) / dt).margin (2.0));
    CHECK (stopped (all, all) == 0);
}

TEST_CASE ("guard: impulse counts only the force and the torque that the motors rendered", "[framework][guard]")
{
    const auto stopped = [] (const GuardLimits& limits, const Vec3& lost) {
        auto guard = guardWith (limits);
        return stopsAt (guard, 1000, [&] (int) {
            Reading reading;
            reading.unrendered_force = reading.unrendered_torque = lost;
            guard ({ .force = { 1.0, 0.0, 0.0 }, .torque = { 1.0, 0.0, 0.0 } }, reading);
        });
    };
    const Vec3 none = Vec3::Zero(), half { 0.5, 0.0, 0.0 }, unknown = Vec3::Constant (std::nan (""));
    for (const GuardLimits& limits : { GuardLimits { .max_impulse = 0.1, .impulse_window = 2.0 }, { .max_angular_impulse = 0.1, .impulse_window = 2.0 } })
    {
        CHECK (stopped (limits, none) == Approx (0.1 / dt).margin (3.0));
        CHECK (stopped (limits, half) == Approx (0.2 / dt).margin (3.0));
        CHECK (stopped (limits, 2.0 * half) == 0);
        CHECK (stopped (limits, unknown) == stopped (limits, none));
    }
}

TEST_CASE ("guard: an effort that drives an axis counts as energy, if the guard knows which axis it pushes", "[framework][guard]")
{
    const auto stopped = [] (const DeviceLayout& layout, int axis, double effort) {
        auto guard = guardWith ({ .max_energy = 0.01, .energy_window = 1.0 }, layout);
        return stopsAt (guard, 1000, [&] (int k) {
            Reading reading;
            reading.axes.set (axis, 2.0 * k * dt);
            guard ({ .axes = { effort } }, reading);
        });
    };
    CHECK (stopped (named, 1, 0.5) == Approx (0.01 / (1.0 - 0.01) / dt).margin (2.0));
    CHECK (stopped (named, 1, -0.5) == 0);
    CHECK (stopped (named, 0, 0.5) == 0);
    CHECK (stopped (numbered, 1, 0.5) > 0);
    CHECK (stopped (numbered, 0, 0.5) == 0);
    CHECK (stopped (numbered, 2, 0.5) == 0);
    CHECK (stopped (unknown, 0, 0.5) == 0);
}

TEST_CASE ("guard: torque and axis effort together give little more than the limit on the energy", "[framework][guard]")
{
    constexpr double most = 1e-3, speed = 20.0;
    auto guard = guardWith ({ .max_energy = most, .energy_window = 10.0 }, named);
    double given = 0.0;
    Effort applied;
    for (int k = 0; k < 10'000; ++k)   // 1 Nm and 5 Nm at 20 rad/s for 10 s: 1200 J without the limit
    {
        given += (applied.torque.z() + applied.axes[0]) * speed * dt;
        Reading reading { .rotation = turnedTo (Vec3::UnitZ(), speed * k * dt) };
        reading.axes.set (1, speed * k * dt);
        applied = guard ({ .torque = { 0, 0, 1 }, .axes = { 5.0 } }, reading);
    }
    CHECK (guard.stop() == Guard::Stop::energy);
    CHECK (given < most + 120.0 * (Guard::fade_s + 3 * dt));   // the excess is noticed after a few ticks, and the fade follows
}

TEST_CASE ("guard: bad readings in between do not hide motion, and an axis that is not a number makes the reading stale", "[framework][guard]")
{
    auto guard = guardWith ({ .max_speed = 0.5, .max_energy = 0.01, .energy_window = 1.0 });
    CHECK (stopsAt (guard, 1000, [&] (int k) {
               const bool is_good = k % 2 == 0;
               guard ({ .force = { 1, 0, 0 } }, { .position = { 1.0 * k * dt, 0, 0 }, .valid = is_good });
               if (! is_good) CHECK (guard.stop() != Guard::Stop::none);
           })
           > 0);
    for (int k = 0; k < 1000 && ! Guard::latches (guard.stop()); ++k)
        guard ({ .force = { 1, 0, 0 } }, { .position = { 0.1 + 1.0 * k * dt, 0, 0 }, .valid = k % 2 == 0 });
    CHECK (Guard::latches (guard.stop()));

    auto broken = guardWith ({ .max_energy = 0.01, .energy_window = 1.0 }, named);
    Reading reading;
    reading.axes.set (1, std::numeric_limits<double>::quiet_NaN());
    broken ({ .axes = { 1.0 } }, reading);
    CHECK (broken.stop() == Guard::Stop::stale);
    CHECK (describe (broken.latest()).starts_with ("the reading is not a number"));
    reading.axes.set (1, 0.0);
    broken ({ .axes = { 1.0 } }, reading);
    CHECK (broken.stop() == Guard::Stop::none);
}

TEST_CASE ("guard: a tool that turns too fast, or an axis that moves too fast, causes a stop with its numbers", "[framework][guard]")
{
    test::property ("5 % below or above the limit", [] {
        const bool too_fast = *rc::gen::arbitrary<bool>();
        const double limit = *rc::gen::element (0.5, 6.0), speed = limit * (too_fast ? 1.05 : 0.95);
        const Vec3 axis = anyDirection();
        auto turning = guardWith ({ .max_angular_speed = limit });
        RC_ASSERT ((stopsAt (turning, 200, [&] (int k) { turning ({}, { .rotation = turnedTo (axis, 3.0 + speed * k * dt) }); }) > 0) == too_fast);

        auto sliding = guardWith ({ .max_axis_speed = limit }, named);
        const auto slide = [&] (int k) {
            Reading reading;
            reading.axes.set (1, -speed * k * dt);
            sliding ({}, reading);
        };
        RC_ASSERT ((stopsAt (sliding, 200, slide) > 0) == too_fast);
        if (! too_fast) return;
        RC_ASSERT (describe (turning.latest()).starts_with ("the tool turns at "));
        RC_ASSERT (describe (sliding.latest()).starts_with ("axis 2 moves at "));
    });
}

TEST_CASE ("guard: a torque, or efforts on axes, that push for too long cause a stop", "[framework][guard]")
{
    const auto seconds = [] (const GuardLimits& limits, const Effort& effort) {
        auto guard = guardWith (limits, numbered);
        return dt * stopsAt (guard, 2000, [&] (int) { guard (effort, {}); });
    };
    CHECK (seconds ({ .max_angular_impulse = 0.1, .impulse_window = 2.0 }, { .torque = { 0, -0.2, 0 } }) == Approx (0.5).margin (2 * dt));
    CHECK (seconds ({ .max_angular_impulse = 0.1, .impulse_window = 2.0 }, { .force = { 9, 9, 9 } }) == 0.0);
    CHECK (seconds ({ .max_axis_impulse = 0.1, .impulse_window = 2.0 }, { .axes = { 0.1, -0.1 } }) == Approx (0.5).margin (2 * dt));
    CHECK (seconds ({ .max_impulse = 0.1, .impulse_window = 2.0 }, { .torque = { 9, 9, 9 }, .axes = { 9.0 } }) == 0.0);
}

TEST_CASE ("guard: a signal never changes faster than its slew limit, even in stops", "[framework][guard]")
{
    test::property ("any signal, with stops in between", [] {
        auto guard = guardWith ({ .max_signal = 2.0, .max_signal_slew = 100.0 });
        double before = 0.0;
        for (const int v : *rc::gen::container<std::vector<int>> (60, rc::gen::inRange (-50, 51)))
        {
            const auto out = guard ({ .signals = { 0.1 * v } }, { .valid = v % 7 != 0 }).signals[0];
            RC_ASSERT (std::abs (out - before) <= 0.1 * (1.0 + 1e-12));
            RC_ASSERT (std::abs (out) <= 2.0);
            before = out;
        }
    });
}

TEST_CASE ("guard: limits with which a stop would take longer than half a second are refused", "[framework][guard]")
{
    const auto found = [] (const char* json) {
        Messages messages;
        readGuardLimits (Json::parse (json), "/guard", messages);
        return idsOf (messages);
    };
    CHECK (found (R"({"max_force": "5 N", "max_slew": "10 N/s"})").empty());
    CHECK (found (R"({"max_force": "5 N", "max_slew": "9.9 N/s"})") == "device/slow_stop/guard/max_slew");
    CHECK (found (R"({"max_torque": "1 N*m", "max_torque_slew": "1 N*m/s"})") == "device/slow_stop/guard/max_torque_slew");
    CHECK (found (R"({"max_axis_effort": 1, "max_axis_slew": 1})") == "device/slow_stop/guard/max_axis_slew");
    CHECK (found (R"({"max_signal": 1, "max_signal_slew": 1})") == "device/slow_stop/guard/max_signal_slew");
    CHECK (found (R"({"max_slew": "1 N/s"})").empty());   // the device's profile may set max_force
    CHECK (found (R"({"max_angular_impulse": "1 N*m*s"})") == "device/missing/guard");
}

TEST_CASE ("a run: the guard that the graph describes holds for any device of the role", "[run][guard]")
{
    Sketch s;
    s.node ("push", "signal.constant", { { "value", 50.0 } }).node ("motor", "device.force").wire ("push.out -> motor.force.x");
    const auto appliedWith = [&] (const GuardLimits& own, const char* guard) {
        s.graph.devices = { { "stylus", Json { { "driver", "hid" }, { "guard", Json::parse (guard) } } } };
        double force = 0.0;
        const auto opener = [&] (const std::string&, const graph::Graph&, const Plan&, Messages&) -> Run::RoleDevice {
            return { std::make_unique<Tool> (force), own };
        };
        Run run { catalogue(), { .rate_hz = 1000.0 }, opener };
        auto messages = run.load (s.graph);
        run.openDevices (s.graph, messages);
        for (int k = 0; k < 100; ++k)
            run.tick();
        return std::pair { force, idsOf (messages) };
    };
    CHECK (appliedWith ({}, R"({"max_force": "2 N"})").first == Approx (2.0));
    CHECK (appliedWith ({ .max_force = 1.0 }, R"({"max_force": "2 N"})").first == Approx (1.0));
    CHECK (appliedWith ({ .max_force = 3.0 }, "{}").first == Approx (3.0));
    CHECK (appliedWith ({ .max_force = 30.0 }, R"({"max_slew": "50 N/s"})").second == "device/slow_stop/devices/stylus/guard/max_slew");
    CHECK (appliedWith ({ .max_force = 20.0 }, R"({"max_slew": "50 N/s"})").second.empty());
    CHECK (appliedWith ({}, R"({"max_slew": "50 N/s"})") == std::pair { 0.0, std::string ("device/slow_stop/devices/stylus/guard/max_slew") });
    CHECK (appliedWith ({ .max_signal_slew = 50.0 }, R"({"max_force": "1 N"})").second == "device/slow_stop/devices/stylus/guard/max_signal_slew");
    CHECK (appliedWith ({}, R"({"max_signal": "2 N"})").second.empty());
    CHECK (appliedWith ({}, R"({"max_signal": "2 apples"})").second == "device/unit/devices/stylus/guard/max_signal");
    CHECK (appliedWith ({}, R"({"dead_man_button": "grip"})").second == "device/unknown_button/devices/stylus/guard/dead_man_button");
}

TEST_CASE ("guard: a session can tighten a profile's limits, but never loosen them", "[framework][guard]")
{
    const GuardLimits profile { .max_force = 3.3, .max_slew = 500.0, .ramp = 0.2, .watchdog = 0.02 };
    const GuardLimits session { .max_force = 10.0, .max_torque = 0.1, .max_slew = 200.0, .ramp = 0.1, .watchdog = 1.0 };

    CHECK (tightest (profile, session) == GuardLimits { .max_force = 3.3, .max_torque = 0.1, .max_slew = 200.0, .ramp = 0.2, .watchdog = 0.02 });
    CHECK (tightest (profile, {}) == profile);

    const GuardLimits short_window { .max_impulse = 1.0, .impulse_window = 0.1, .max_energy = 0.5, .energy_window = 2.0, .dead_man_buttons = 1 };
    const GuardLimits long_window {
        .max_axis_effort = 2.0,
        .max_signal = 1.0,
        .max_speed = 1.0,
        .max_impulse = 3.0,
        .impulse_window = 1.0,
        .max_energy = 0.1,
        .dead_man_pressure = 0.5,
        .dead_man_buttons = 4,
    };
    const auto both = tightest (short_window, long_window);
    CHECK (both == tightest (long_window, short_window));
    CHECK (both == GuardLimits {
               .max_axis_effort = 2.0,
               .max_signal = 1.0,
               .max_speed = 1.0,
               .max_impulse = 1.0,
               .impulse_window = 1.0,
               .max_energy = 0.1,
               .energy_window = 0.0,
               .dead_man_pressure = 0.5,
               .dead_man_buttons = 5,
           });
    CHECK (tightest (both, {}) == both);
    CHECK (tightest ({ .impulse_window = 5.0 }, short_window).impulse_window == 0.1);   // the window of an unused limit does not count
    CHECK (tightest (profile, { .max_force = std::numeric_limits<double>::quiet_NaN(), .ramp = std::numeric_limits<double>::quiet_NaN() }).max_force == 0.0);
}
