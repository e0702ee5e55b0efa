// SPDX-License-Identifier: MIT
#include "guard.hpp"

#include <algorithm>
#include <charconv>

namespace tactus
{
namespace
{
// A few units in the last place under the limit, so that roundings on the way cannot end above it.
constexpr double just_under = 1.0 - 16.0 * std::numeric_limits<double>::epsilon();

/// v, or the vector of length `most` in its direction if it is longer. v must be finite; its length may overflow.
Vec3 shortened (const Vec3& v, double most) noexcept
{
    if (most == GuardLimits::none) return v;

    const double biggest = v.cwiseAbs().maxCoeff();
    if (biggest == 0.0) return v;

    const Vec3 scaled = v / biggest;
    const double length = scaled.norm();
    if (biggest * length <= most) return v;

    return scaled * (most / length * just_under);
}

/// From `from` towards `to`, but no further than `most`.
Vec3 approached (const Vec3& from, const Vec3& to, double most) noexcept
{
    if (most == GuardLimits::none) return to;

    // Halves, because the difference of two finite numbers need not be finite.
    const Vec3 half_way = 0.5 * to - 0.5 * from;
    const Vec3 half_step = shortened (half_way, 0.5 * most);
    return half_step == half_way ? to : Vec3 (from + 2.0 * half_step);
}

/// How much a tick may change: rate times T, where "no limit" stays that.
double perTick (double rate, double dt_s) noexcept { return rate == GuardLimits::none ? rate : rate * dt_s; }

double orNothing (double limit) noexcept { return limit >= 0.0 ? limit : 0.0; }
double orForever (double ramp) noexcept { return ramp >= 0.0 ? ramp : GuardLimits::none; }

/// Four digits, whatever the locale.
std::string inWords (double value)
{
    char text[32];
    return { text, std::to_chars (text, text + sizeof text, value, std::chars_format::general, 4).ptr };
}

std::string inWords (const Vec3& v) { return "(" + inWords (v.x()) + ", " + inWords (v.y()) + ", " + inWords (v.z()) + ")"; }
std::string inMilliseconds (double seconds) { return inWords (seconds * 1e3) + " ms"; }
}   // namespace

GuardLimits tightest (const GuardLimits& a, const GuardLimits& b) noexcept
{
    const auto less = [] (double x, double y)
    { return std::min (orNothing (x), orNothing (y)); };

    return {
        .max_force = less (a.max_force, b.max_force),
        .max_torque = less (a.max_torque, b.max_torque),
        .max_slew = less (a.max_slew, b.max_slew),
        .max_torque_slew = less (a.max_torque_slew, b.max_torque_slew),
        .ramp = std::max (orForever (a.ramp), orForever (b.ramp)),
        .watchdog = less (a.watchdog, b.watchdog),
    };
}

void Guard::prepare (const GuardLimits& wanted, double dt_s) noexcept
{
    *this = Guard();
    if (isFinite (dt_s) && dt_s > 0.0) dt = dt_s;
    limits = {
        .max_force = orNothing (wanted.max_force),
        .max_torque = orNothing (wanted.max_torque),
        .max_slew = orNothing (wanted.max_slew),
        .max_torque_slew = orNothing (wanted.max_torque_slew),
        .ramp = orForever (wanted.ramp),
        .watchdog = orNothing (wanted.watchdog),
    };
    enabled = 0.0;
}

Guard::Stop Guard::causeOf (const Effort& wanted, const Reading& reading) const noexcept
{
    if (! isFinite (wanted.force, wanted.torque)) return Stop::not_finite;
    if (! reading.valid || ! isFinite (reading.position, reading.rotation) || ! (reading.age <= limits.watchdog)) return Stop::stale;
    if (asked_to_halt) return Stop::halted;
    return Stop::none;
}

Effort Guard::operator() (const Effort& wanted, const Reading& reading) noexcept
{
    const auto cause = causeOf (wanted, reading);

    if (cause != Stop::none && reason == Stop::none)
    {
        const bool ends_a_run = cause == Stop::halted && event.why != Stop::none;   // the stop before it is what is asked for
        if (! ends_a_run) event = { .why = cause, .wanted = wanted, .age = reading.age, .watchdog = limits.watchdog, .valid = reading.valid };
        at_stop = last;
        withheld = 1.0;
        enabled = 0.0;
    }
    reason = cause;

    const auto smooth = crossfade (wanted);

    last.force = approached (last.force, shortened (smooth.force, limits.max_force), perTick (limits.max_slew, dt));
    last.torque = approached (last.torque, shortened (smooth.torque, limits.max_torque), perTick (limits.max_torque_slew, dt));
    return last;
}

Effort Guard::crossfade (const Effort& wanted) noexcept
{
    withheld = std::max (0.0, withheld - dt / fade_s);

    if (reason != Stop::none) return { withheld * at_stop.force, withheld * at_stop.torque };

    enabled = limits.ramp > 0.0 ? std::min (1.0, enabled + dt / limits.ramp) : 1.0;
    if (enabled == 1.0) return wanted;

    // Together never more than 1, so that coming back before the fade is over needs no care.
    const double rest = std::min (withheld, 1.0 - enabled);
    return { enabled * wanted.force + rest * at_stop.force, enabled * wanted.torque + rest * at_stop.torque };
}

std::string describe (const Guard::Event& event)
{
    switch (event.why)
    {
    case Guard::Stop::none:
        return "not stopped";
    case Guard::Stop::halted:
        return "halted on request";

    case Guard::Stop::stale:
        if (! event.valid) return "the device has no reading to give";
        if (! (event.age >= 0.0)) return "the reading has no age";
        return "the last reading is " + inMilliseconds (event.age) + " old, the watchdog allows " + inMilliseconds (event.watchdog);

    case Guard::Stop::not_finite:
        break;
    }

    const bool in_force = ! isFinite (event.wanted.force);
    return "the graph asked for a " + std::string (in_force ? "force" : "torque") + " that is not a number: "
           + inWords (in_force ? event.wanted.force : event.wanted.torque) + (in_force ? " N" : " N*m");
}

}   // namespace tactus
