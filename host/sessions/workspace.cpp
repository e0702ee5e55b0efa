// SPDX-License-Identifier: MIT
#include "workspace.hpp"

#include <tactus/text/object_reader.hpp>
#include <tactus/text/units.hpp>

#include <utility>

namespace tactus::host
{

namespace
{
constexpr double least = 1e-3, most = 1e3;   // a scale beyond these limits must be a mistake
constexpr double farthest = 1e3;             // in m; farther away, rounding would hide the motion of the tool from the guard
}   // namespace

Workspace readWorkspace (const Json& json, std::string where, Messages& messages)
{
    ObjectReader in (json, std::move (where), messages);
    Workspace w;
    w.scale = in.number ("scale", unit::gain, { .min = least, .max = most }, w.scale);
    w.offset = in.vector ("offset", unit::metre, w.offset);
    if (! (w.offset.cwiseAbs().maxCoeff() <= farthest))
    {
        in.error ("offset", "device/out_of_range", "the offset is more than 1000 m", "give the position of the device's origin in the graph, in m");
        w.offset = Vec3::Zero();
    }
    in.finish();
    return w;
}

GuardLimits inWorkspace (GuardLimits limits, const Workspace& w) noexcept
{
    limits.workspace_scale *= w.scale;
    limits.max_brake /= w.scale;
    limits.max_brake_slew /= w.scale;
    limits.brake_at_stop /= w.scale;
    return limits;
}

DeviceLayout WorkspaceDevice::layout() const
{
    auto has = device->layout();
    has.mechanics.mass /= workspace.scale;
    has.mechanics.damping /= workspace.scale;
    has.brake /= workspace.scale;
    return has;
}

void WorkspaceDevice::write (const Effort& guarded) noexcept
{
    if (guarded.brake == 0.0) return device->write (guarded);
    Effort scaled = guarded;
    scaled.brake *= workspace.scale;   // the same force at the speed of the device
    device->write (scaled);
}

Reading WorkspaceDevice::read() noexcept
{
    auto reading = device->read();
    reading.position = workspace.toGraph (reading.position);
    reading.true_position = workspace.toGraph (reading.true_position);
    reading.true_velocity *= workspace.scale;
    return reading;
}

}   // namespace tactus::host
