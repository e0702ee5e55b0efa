// SPDX-License-Identifier: MIT
// A run that ticks faster than its device reports: the guard gets the same reading several times.
#include <tactus/run/guard.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <string>

using namespace tactus;

namespace
{
constexpr double dt = 0.25e-3;       // of the run
constexpr int held = 4;              // ticks per reading
constexpr double hand_speed = 0.1;   // m/s, whatever the force
constexpr double limit = 0.02;       // J

struct Outcome
{
    double given = 0.0;   // energy that the device has given to the hand, in J
    bool is_stopped = false;
};

/// Runs for ten seconds with an effort that is `push` on tick k of each reading.
template <typename Push>
Outcome run (Push push)
{
    Guard guard;
    guard.prepare ({ .max_force = 3.0, .max_axis_effort = 3.0, .max_energy = limit, .energy_window = 1.0 }, dt, { .axes = { "arm" }, .efforts = { "arm" } });
    Outcome outcome;
    Reading reading;
    double position = 0.0;
    Effort on;
    for (int k = 0; k < 40'000 && ! outcome.is_stopped; ++k)
    {
        position += hand_speed * dt;
        outcome.given += (on.force.x() + on.torque.z() + on.axes[0]) * hand_speed * dt;
        if (k % held == 0)
        {
            reading.position.x() = reading.rotation.z() = position;
            reading.axes.set (0, position);
        }
        reading.age = k % held * dt;
        on = guard (push (k % held), reading);
        outcome.is_stopped = guard.stop() == Guard::Stop::energy;
    }
    return outcome;
}

Effort forceOf (double f) { return { .force = { f, 0.0, 0.0 } }; }
Effort torqueOf (double t) { return { .torque = { 0.0, 0.0, t } }; }
Effort axisOf (double e)
{
    Effort effort;
    effort.axes.set (0, e);
    return effort;
}
}   // namespace

TEST_CASE ("guard: an effort that turns round just before each reading cannot hide the energy that it gives", "[framework][guard]")
{
    const auto effort = GENERATE (&forceOf, &torqueOf, &axisOf);
    const int turns_at = GENERATE (0, 1, 2, 3);
    const auto outcome = run ([&] (int k) { return effort (k == turns_at ? -3.0 : 3.0); });
    CAPTURE (turns_at, outcome.given);
    CHECK (outcome.is_stopped);
    CHECK (outcome.given < 2.0 * limit);
}

TEST_CASE ("guard: a vibration within each reading that gives nothing on the whole is not stopped", "[framework][guard]")
{
    const int turns_at = GENERATE (0, 1);
    const auto outcome = run ([&] (int k) { return forceOf (k % 2 == turns_at ? 3.0 : -3.0); });
    CHECK_FALSE (outcome.is_stopped);
    CHECK (std::abs (outcome.given) < 1e-3);
}

TEST_CASE ("guard: a reading from the future is stale, because its clock differs", "[framework][guard]")
{
    const double ahead = GENERATE (1e-3, 1.0, 1e9);
    Guard guard;
    guard.prepare ({ .watchdog = 0.02 }, dt);
    Effort out;
    for (int k = 0; k < 40; ++k)
        out = guard (forceOf (1.0), { .age = k * dt - ahead });
    CHECK (out.force.x() == (ahead == 1e-3 ? 1.0 : 0.0));
    CHECK (guard.events() == 1);
    CHECK (guard.latest().why == Guard::Stop::stale);
    CHECK (describe (guard.latest()).find ("from the future") != std::string::npos);

    guard.prepare ({ .watchdog = 0.02 }, dt);
    CHECK (guard (forceOf (1.0), { .age = -0.5 * dt }).force.x() == 1.0);   // the jitter of a clock that is in step
}

TEST_CASE ("guard: a negative age does not hide a speed", "[framework][guard]")
{
    Guard guard;
    guard.prepare ({ .max_speed = 1.0 }, dt);
    Reading reading;
    for (int k = 0; k < 1000; ++k)
    {
        reading.position.x() = k * dt * 5.0;
        reading.age = -1e3 * k;
        guard ({}, reading);
    }
    CHECK (guard.stop() == Guard::Stop::speed);
}
