// SPDX-License-Identifier: MIT
// What a guard reports about a stop.
#include "guard.hpp"

#include <algorithm>

namespace tactus
{
namespace
{
int firstNotFinite (const Channels& all) noexcept
{
    return static_cast<int> (std::find_if_not (all.begin(), all.end(), [] (double v) { return isFinite (v); })
                             - all.begin());
}

void nameValue (Guard::Event& e, Guard::Event::Part part, const Vec3& v) noexcept
{
    e.part = part;
    e.wanted = { v.x(), v.y(), v.z() };
}

void nameChannel (Guard::Event& e, Guard::Event::Part part, const Channels& all) noexcept
{
    e.part = part;
    e.channel = firstNotFinite (all);
    e.wanted = { all[e.channel], 0.0, 0.0 };
}

void nameNotFinite (Guard::Event& e, const Effort& wanted) noexcept
{
    using Part = Guard::Event::Part;
    if (! isFinite (wanted.force))
        nameValue (e, Part::force, wanted.force);
    else if (! isFinite (wanted.torque))
        nameValue (e, Part::torque, wanted.torque);
    else if (! isFinite (wanted.brake) || wanted.brake < 0.0)
        nameValue (e, Part::brake, { wanted.brake, 0.0, 0.0 });
    else if (! isFinite (wanted.axes))
        nameChannel (e, Part::axis, wanted.axes);
    else
        nameChannel (e, Part::signal, wanted.signals);
}
}   // namespace

void Guard::describeStale (Event& e, const Reading& reading) const noexcept
{
    using Part = Event::Part;
    if (! isFinite (reading.position, reading.rotation)) nameValue (e, Part::reading, isFinite (reading.position) ? reading.rotation : Vec3 (reading.position));
    if (hasBrokenAxes (reading)) nameChannel (e, Part::reading, reading.axes);
    e.fault = reading.fault;
    e.value = reading.age;
    e.limit = limits.watchdog;
    if (reading.valid && e.part == Part::none && isRecent (reading)) describeFrozen (e);
}

void Guard::describeFrozen (Event& e) const noexcept
{
    const bool turns = still_turn.time() > still.time();
    const auto& frozen = turns ? still_turn : still;
    nameValue (e, turns ? Event::Part::torque : Event::Part::none, turns ? last.torque : last.force);
    e.fault = ReadingFault::frozen;
    e.channel = frozen.coordinate();
    e.value = frozen.time();
    e.limit = limits.max_still;
}

Guard::Event Guard::describeNow (Stop why, const Effort& wanted, const Reading& reading) const noexcept
{
    using Part = Event::Part;
    Event e { .why = why, .valid = reading.valid };
    const auto limitOf = [&] (double of_tool, double of_rotation, double of_axis) {
        if (seen_part == Part::axis) return of_axis;
        return seen_part == Part::torque ? of_rotation : of_tool;
    };

    switch (why)
    {
    case Stop::not_finite:
        nameNotFinite (e, wanted);
        break;
    case Stop::stale:
        describeStale (e, reading);
        break;
    case Stop::starved:
        e.value = behind;
        e.limit = limits.watchdog;
        break;
    case Stop::released:
        e.value = reading.pressure;
        e.limit = limits.dead_man_pressure;
        break;
    case Stop::speed:
        e.value = seen;
        e.part = seen_part;
        e.channel = seen_channel;
        e.limit = limitOf (limits.max_speed, limits.max_angular_speed, limits.max_axis_speed);
        break;
    case Stop::impulse:
        e.value = seen;
        e.part = seen_part;
        e.limit = limitOf (limits.max_impulse, limits.max_angular_impulse, limits.max_axis_impulse);
        e.window = limits.impulse_window;
        break;
    case Stop::energy:
        e.value = seen;
        e.limit = limits.max_energy;
        e.window = limits.energy_window;
        break;
    case Stop::none:
    case Stop::halted:
    case Stop::emergency:
        break;
    }
    return e;
}

}   // namespace tactus
