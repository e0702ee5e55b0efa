// SPDX-License-Identifier: MIT
#include "clutch.hpp"
#include "workspace.hpp"

#include <algorithm>

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
    if (is_usable && is_held && state == State::open) state = State::closing;
    if (state == State::closing && is_at_rest) state = State::closed;
    if (is_usable && ! is_held && state == State::closed)
    {
        // Farther away, rounding would hide the motion of the tool from the guard. Then the workspace stays where it was.
        const Vec3 to = seen - fresh;
        if ((fixed + to).cwiseAbs().maxCoeff() <= Workspace::farthest) shift = to;
        state = State::open;
    }

    reading.position = fresh + shift;
    reading.true_position += shift;
    if (state == State::open)
    {
        if (is_usable) seen = reading.position;
        return;
    }
    reading.valid = false;
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
}

}   // namespace tactus::host
