// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/device.hpp>

namespace tactus::host
{

/// Moves a workspace with the hand while a button is held, as one lifts a mouse. The force must not step, so the steps are:
///
///     pressed     the reading is not valid: the nodes keep the position that they know, and the guard takes the efforts to zero
///     at rest     only then does the workspace move with the hand
///     released    the reading is valid again, at the position that the nodes know, and the guard's ramp brings the force back
///
/// A press is carried through even if the button is released before the efforts are zero. So the position that nodes see never moves by more than
/// the tool does, whatever the hand does with the button. Force, torque and the efforts on axes have to be zero.
///
/// moveTo() puts the workspace elsewhere by the same steps, so that the tool is at another place of the graph. Then signals have to be zero, too, and
/// the reading is not valid for at least one tick: the guard takes what comes after it for a device that is somewhere else now, not for one that has
/// moved at a great speed, and its ramp begins. Nodes of other roles that use this position see it jump, without a ramp: a run with several roles must begin
/// again instead. Allocates nothing. [tick thread]
class Clutch
{
public:
    /// `origin` is where the origin of the device is in the graph without a clutch, in m.
    explicit Clutch (const Vec3& origin = Vec3::Zero()) noexcept : fixed (origin) {}

    /// Converts a reading in the workspace that does not move. `is_held`: the button is down, if the reading is valid.
    void operator() (Reading& reading, bool is_held) noexcept;

    /// The workspace shall be moved by this much in all, in m, as soon as nothing is on the device.
    void moveTo (const Vec3& moved) noexcept
    {
        goal = moved;
        has_goal = true;
    }
    bool hasGoal() const noexcept { return has_goal; }   ///< and is not there yet

    /// Takes what the guard has passed on.
    void wrote (const Effort& guarded) noexcept;

    /// The displacement of the workspace, in m.
    const Vec3& moved() const noexcept { return shift; }

private:
    enum class State
    {
        open,      // the tool moves in the graph
        closing,   // the guard takes the efforts to zero
        closed     // the workspace moves with the hand
    };

    Vec3 fixed, shift = Vec3::Zero(), seen = Vec3::Zero();   // seen: the position that the nodes know
    Vec3 goal = Vec3::Zero();
    State state = State::open;
    bool has_seen = false, has_goal = false, was_put = false;   // was_put: at its goal, since the clutch has closed
    bool is_at_rest = true, is_silent = true;
    double brake = 0.0;   // of the latest effort
};

}   // namespace tactus::host
