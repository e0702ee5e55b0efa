// SPDX-License-Identifier: MIT
#include "gesture_device.hpp"

#include <tactus/kit/state_archive.hpp>

#include <algorithm>

namespace tactus
{

GestureDevice::GestureDevice (const Gesture& gesture, const Placement& placement)
    : path (gesture, placement), surface (placement.offset.z())
{
}

void GestureDevice::prepare (double dt_s)
{
    dt = dt_s;
    tick = 0;
}

Reading GestureDevice::read() noexcept
{
    const auto [position, velocity] = path.at (static_cast<double> (tick) * dt);

    Reading reading;
    reading.position = position;
    reading.pressure = pad_stiffness * std::max (0.0, surface - position.z());
    reading.true_position = position;
    reading.true_velocity = velocity;
    return reading;
}

void GestureDevice::write (const Effort&) noexcept { ++tick; }

bool GestureDevice::serialize (StateArchive& archive)
{
    archive (tick);
    if (tick < 0) archive.refuse ("has a device that has not begun");
    return true;
}

}   // namespace tactus
