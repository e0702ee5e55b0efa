// SPDX-License-Identifier: MIT
#pragma once

#include "tactus.h"

#include <tactus/kit/state_archive.hpp>
#include <tactus/kit/threads/snapshot.hpp>
#include <tactus/node/device.hpp>
#include <tactus/run/device/step_motion.hpp>
#include <tactus/run/guard.hpp>
#include <tactus/run/guard/shorten.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <utility>

namespace tactus::capi
{

/// A device whose readings come from one thread of the embedding program, and whose efforts any thread may read. No thread waits.
class PushedDevice final : public Device
{
public:
    using Seconds = double (*)() noexcept;   ///< a clock: the time since an arbitrary origin, in s   [any thread]

    static double steadySeconds() noexcept { return std::chrono::duration<double> (std::chrono::steady_clock::now().time_since_epoch()).count(); }

    explicit PushedDevice (DeviceLayout parts, Seconds clock = steadySeconds, const StepMotion& rules = {}, bool simulated = false)
        : has (std::move (parts)), now_s (clock), motion (rules), is_simulated (simulated)
    {
    }

    /// The age that a reading may reach before the guard brings the effort to zero, if the program does not set it. Most profiles of devices have the
    /// same value. A program that pushes at 60 Hz may be late by two readings.
    static constexpr double default_watchdog = 0.05;   // in s

    /// The limits of the program, with a watchdog. Only the program itself can ask for a longer one; a graph only tightens.
    static GuardLimits watched (GuardLimits limits) noexcept
    {
        if (limits.watchdog == GuardLimits::none) limits.watchdog = default_watchdog;
        return limits;
    }

    void prepare (double dt_s) override { period = next_period = dt_s; }

    /// From now on, a reading that is not renewed ages by the clock: a run may lose ticks. [main thread, before its tick thread starts]
    void useClock() noexcept { has_clock = true; }

    /// The next tick comes this much later than the last one, in s. [tick thread]
    void passTime (double s) noexcept { next_period = s; }

    /// A reading that is not renewed gets older, so that the guard's watchdog sees it.
    Reading read() noexcept override
    {
        const auto now = readings.load();
        const double passed = std::exchange (next_period, period);
        const bool is_new = now.number != last;
        last = now.number;
        silent = is_new ? 0.0 : silent + passed;
        if (now.number == 0) return { .valid = false };
        if (has_clock)   // a reading that came before a tick that is not late is new
        {
            const double old = now_s() - now.at_s;
            silent = std::max (silent, is_new ? old - period : old);
        }
        const auto& from = now.reading;
        Reading r { .position = Vec3 { from.position }, .rotation = Vec3 { from.rotation }, .pressure = from.pressure, .buttons = from.buttons };
        r.age = from.age_s + silent;
        r.valid = from.valid != 0;
        copy (from.axes, from.axis_count, r.axes);
        copy (from.signals, from.signal_count, r.signals);
        using Velocity = StepMotion::Velocity;
        return motion.moveAged (r, is_new, now.has_velocity != 0 ? std::optional (Velocity { Vec3 { now.linear }, Vec3 { now.angular } }) : std::nullopt);
    }

    void write (const Effort& of_tick) noexcept override
    {
        motion.take (of_tick);
        if (! motion.isInStep()) publish (motion.effort());   // the effort of a step is known after its last tick
    }

    bool serialize (StateArchive& archive) override
    {
        if (! is_simulated) return false;
        auto now = readings.load();
        bool is_new = now.number != last, has_reading = now.number != 0;
        auto& r = now.reading;
        archive (is_new, has_reading, r.valid, r.position, r.rotation, r.pressure, r.age_s, r.buttons, r.axis_count, r.signal_count, r.axes, r.signals,
                 now.has_velocity, now.linear, now.angular, silent, motion);
        if (! archive.restores()) return true;
        now.number = has_reading ? ++pushes : 0;
        last = is_new && has_reading ? 0 : now.number;
        readings.store (now);
        publish (motion.effort());
        return true;
    }

    /// Shortens the effort that is taken to these limits: a restored one may be from before they were tightened. [tick thread]
    void shorten (const GuardLimits& limits) noexcept
    {
        auto e = motion.effort();
        tactus::shorten (e, limits);
        publish (e);
    }

    void withhold() noexcept override { motion.withhold(); }
    DeviceLayout layout() const override { return has; }

    /// How it moves in tactus_run_step_for. [tick thread]
    StepMotion& steps() noexcept { return motion; }

    /// [one thread at a time]
    void push (const tactus_reading& r) noexcept { readings.store ({ r, ++pushes, now_s() }); }

    /// `linear` in m/s, `angular` in rad/s; three numbers each. [one thread at a time]
    void push (const tactus_reading& r, const double* linear, const double* angular) noexcept
    {
        Pushed p { r, ++pushes, now_s(), 1 };
        std::copy_n (linear, 3, p.linear);
        std::copy_n (angular, 3, p.angular);
        readings.store (p);
    }

    /// [any thread]
    tactus_effort effort() const noexcept
    {
        tactus_effort none {};
        none.size = sizeof none;
        return has_ended ? none : efforts.load();
    }

    void end() noexcept { has_ended = true; }   ///< from now on, there is no effort   [any thread]

private:
    struct Pushed
    {
        tactus_reading reading {};
        std::uint64_t number = 0;   // 0: nothing has been pushed yet
        double at_s = 0.0;
        std::uint64_t has_velocity = 0;
        double linear[3] = {}, angular[3] = {};   // m/s, rad/s
    };

    void publish (const Effort& e) noexcept
    {
        tactus_effort to {};
        to.size = sizeof to;
        std::copy_n (e.force.data(), 3, to.force);
        std::copy_n (e.torque.data(), 3, to.torque);
        to.axis_count = copy (e.axes, to.axes);
        to.signal_count = copy (e.signals, to.signals);
        to.brake = e.brake;
        efforts.store (to);
    }

    static void copy (const double* from, std::uint32_t count, Channels& to) noexcept
    {
        for (int i = static_cast<int> (std::min<std::uint32_t> (count, Channels::most)) - 1; i >= 0; --i)
            to.set (i, from[i]);
    }

    static std::uint32_t copy (const Channels& from, double* to) noexcept
    {
        std::copy (from.begin(), from.end(), to);
        return static_cast<std::uint32_t> (from.size());
    }

    DeviceLayout has;
    Seconds now_s;
    StepMotion motion;           // [tick thread]
    bool is_simulated = false;   // by the program, so no person holds it
    Snapshot<Pushed> readings;
    Snapshot<tactus_effort> efforts;
    std::uint64_t pushes = 0;   // [pushing thread]
    std::uint64_t last = 0;     // number of the reading of the last tick   [tick thread]
    double silent = 0.0;        // time since that reading arrived, in s      [tick thread]
    double period = 0.0, next_period = 0.0;
    bool has_clock = false;
    std::atomic<bool> has_ended = false;

    static_assert (Channels::most == TACTUS_CHANNELS);
};

}   // namespace tactus::capi
