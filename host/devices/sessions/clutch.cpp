// SPDX-License-Identifier: MIT
#include "clutch.hpp"
#include "workspace.hpp"

#include <algorithm>
#include <utility>

namespace tactus::host
{

void Clutch::operator() (Reading& reading, bool is_held) noexcept
{
    const Vec3 fresh = reading.position;
    const bool is_usable = reading.valid && isFinite (fresh);
    if (is_usable && ! has_seen)
    {
        seen = fresh + shift;
        has_seen = true;
    }
    if (is_usable && (is_held || has_goal) && state == State::open) state = State::closing;
    if (state == State::closing && is_at_rest) state = State::closed;
    if (has_goal && state == State::closed)
    {
        if (is_silent)
        {
            shift = goal;
            has_goal = false;
            was_put = true;
            has_seen = false;
        }
    }
    else if (is_usable && ! is_held && state == State::closed)
    {
        // Farther away, rounding would hide the motion of the tool from the guard. Then the workspace stays where it was.
        const Vec3 to = seen - fresh;
        const bool is_near = (fixed + to).cwiseAbs().maxCoeff() <= Workspace::farthest;
        if (! std::exchange (was_put, false) && is_near) shift = to;
        state = State::open;
    }
    else if (is_held)
        was_put = false;   // from now on, it moves with the hand

    if (! shift.isZero (0.0))
    {
        reading.position = fresh + shift;
        reading.true_position += shift;
    }
    if (state == State::open)
    {
        if (is_usable) seen = reading.position;
        return;
    }
    reading.valid = false;
    if (is_usable && reading.fault == ReadingFault::none) reading.fault = ReadingFault::moved;
    if (state == State::closed && isFinite (fresh))
    {
        reading.true_position += seen - reading.position;
        reading.position = seen;
        reading.true_velocity.setZero();
    }
}

void Clutch::wrote (const Effort& guarded) noexcept
{
    const bool no_axis = std::all_of (guarded.axes.begin(), guarded.axes.end(), [] (double e) { return e == 0.0; });
    is_at_rest = no_axis && guarded.force.isZero (0.0) && guarded.torque.isZero (0.0);
    const bool no_signal = std::all_of (guarded.signals.begin(), guarded.signals.end(), [] (double s) { return s == 0.0; });
    is_silent = no_signal && std::exchange (brake, guarded.brake) == guarded.brake;   // the brake has arrived where a stop takes it
}

}   // namespace tactus::host
