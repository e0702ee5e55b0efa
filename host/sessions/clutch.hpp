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
/// the tool does, whatever the hand does with the button. Force, torque and the efforts on axes have to be zero. Allocates nothing. [tick thread]
class Clutch
{
public:
    /// `origin` is where the origin of the device is in the graph without a clutch, in m.
    explicit Clutch (const Vec3& origin = Vec3::Zero()) noexcept : fixed (origin) {}

    /// Converts a reading in the workspace that does not move. `is_held`: the button is down, if the reading is valid.
    void operator() (Reading& reading, bool is_held) noexcept;

    /// Takes what the guard has passed on.
    void wrote (const Effort& guarded) noexcept;

    /// How far the workspace has moved, in m.
    const Vec3& moved() const noexcept { return shift; }

private:
    enum class State
    {
        open,      // the tool moves in the graph
        closing,   // the guard takes the efforts to zero
        closed     // the workspace moves with the hand
    };

    Vec3 fixed, shift = Vec3::Zero(), seen = Vec3::Zero();   // seen: the position that the nodes know
    State state = State::open;
    bool has_seen = false, is_at_rest = true;
};

}   // namespace tactus::host
