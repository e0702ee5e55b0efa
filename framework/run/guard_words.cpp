// SPDX-License-Identifier: MIT
// The stops of a guard in words.
#include "guard.hpp"

#include <tactus/kit/math/math.hpp>
#include <tactus/text/number_text.hpp>

#include <cmath>

namespace tactus
{
namespace
{
std::string inWords (double value) { return roundedText (value, 4); }

std::string inWords (const std::array<double, 3>& v) { return "(" + inWords (v[0]) + ", " + inWords (v[1]) + ", " + inWords (v[2]) + ")"; }
std::string inMilliseconds (double seconds) { return inWords (seconds * 1e3) + " ms"; }

std::string withinWindow (const Guard::Event& event, const char* unit)
{
    const auto limit = "; the limit is " + inWords (event.limit) + unit;
    return event.window > 0.0 && event.window < GuardLimits::none ? limit + " in " + inWords (event.window) + " s" : limit;
}

/// One of several coordinates is frozen only along its own part of the force, so that part is named.
std::string inWordsFrozen (const Guard::Event& event)
{
    const auto& f = event.wanted;
    const bool turn = event.part == Guard::Event::Part::torque, is_one = event.channel >= 0 && event.channel < 3;
    const auto at = static_cast<std::size_t> (is_one ? event.channel : 0);
    const double effort = is_one ? std::abs (f[at]) : math::hypot (f[0], f[1], f[2]);
    return std::string (turn ? "the rotation" : "the position") + (is_one ? std::string (turn ? " about " : " along ") + "xyz"[at] : "")
           + " has not changed for " + inWords (event.value) + " s while a " + (turn ? "torque of " : "force of ") + inWords (effort)
           + (turn ? " N*m turns" : " N pushes") + " the hand";
}

std::string inWordsStale (const Guard::Event& event)
{
    const auto& f = event.wanted;
    if (event.fault == ReadingFault::frozen)
        return event.valid ? inWordsFrozen (event) : "one of the encoders that measure the position does not change while the tool moves";
    const std::string why (describe (event.fault));
    if (! event.valid) return why.empty() ? "the device has no valid reading" : why;
    if (event.part == Guard::Event::Part::reading) return "the reading is not a number: " + inWords (f);
    if (event.value < 0.0) return "the reading is from the future, by " + inMilliseconds (-event.value) + ": the clock of the device differs from ours";
    if (! (event.value >= 0.0)) return "the age of the reading is not a number";
    return why + (why.empty() ? "" : ": ") + "the last reading is " + inMilliseconds (event.value) + " old; the watchdog allows "
           + inMilliseconds (event.limit);
}
}   // namespace

std::string describe (const Guard::Event& event)
{
    using Part = Guard::Event::Part;
    switch (event.why)
    {
    case Guard::Stop::none:
        return "not stopped";
    case Guard::Stop::halted:
        return "halted on request";
    case Guard::Stop::emergency:
        return "the emergency stop was pressed";

    case Guard::Stop::stale:
        return inWordsStale (event);

    case Guard::Stop::starved:
        return "the run cannot keep up: its ticks are " + inMilliseconds (event.value) + " behind; the watchdog allows " + inMilliseconds (event.limit);

    case Guard::Stop::released:
        if (event.limit > 0.0 && ! (event.value >= event.limit))
            return "the hand presses with " + inWords (event.value) + " N; the dead-man's switch requires " + inWords (event.limit) + " N";
        return "the dead-man's switch is not held";

    case Guard::Stop::speed:
    {
        if (event.part == Part::torque) return "the tool turns at " + inWords (event.value) + " rad/s; the limit is " + inWords (event.limit) + " rad/s";
        if (event.part == Part::none) return "the tool moves at " + inWords (event.value) + " m/s; the limit is " + inWords (event.limit) + " m/s";
        return "axis " + std::to_string (event.channel + 1) + " moves at " + inWords (event.value) + " units/s; the limit is " + inWords (event.limit)
               + " units/s";
    }
    case Guard::Stop::impulse:
        if (event.part == Part::torque) return "the impulse of the torque is " + inWords (event.value) + " N*m*s" + withinWindow (event, " N*m*s");
        if (event.part == Part::none) return "the impulse of the force is " + inWords (event.value) + " N*s" + withinWindow (event, " N*s");
        return "the impulse on the axes is " + inWords (event.value) + " N*s or N*m*s" + withinWindow (event, "");
    case Guard::Stop::energy:
        return "the device has given the hand " + inWords (event.value) + " J" + withinWindow (event, " J");

    case Guard::Stop::not_finite:
        break;
    }

    const std::string asked = "the graph asked for ", no_number = " that is not a number: ";
    switch (event.part)
    {
    case Part::axis:
        return asked + "an effort on axis " + std::to_string (event.channel + 1) + no_number + inWords (event.wanted[0]);
    case Part::signal:
        return asked + "a signal on channel " + std::to_string (event.channel + 1) + no_number + inWords (event.wanted[0]);
    case Part::brake:
        return asked + "a damping of the brake that is not a number of at least 0: " + inWords (event.wanted[0]) + " N*s/m";
    case Part::torque:
        return asked + "a torque" + no_number + inWords (event.wanted) + " N*m";
    default:
        return asked + "a force" + no_number + inWords (event.wanted) + " N";
    }
}

}   // namespace tactus
