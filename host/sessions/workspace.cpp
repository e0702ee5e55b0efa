// SPDX-License-Identifier: GPL-3.0-or-later
#include "workspace.hpp"

#include <framework/text/object_reader.hpp>
#include <framework/text/units.hpp>

#include <utility>

namespace tactus::host
{

namespace
{
constexpr double least = 1e-3, most = 1e3;   // a scale beyond these limits must be a mistake
}

Workspace readWorkspace (const Json& json, std::string where, Messages& messages)
{
    ObjectReader in (json, std::move (where), messages);
    Workspace w;
    w.scale = in.number ("scale", unit::gain, { .min = least, .max = most }, w.scale);
    w.offset = in.vector ("offset", unit::metre, w.offset);
    in.finish();
    return w;
}

GuardLimits inWorkspace (GuardLimits limits, const Workspace& w) noexcept
{
    limits.max_speed *= w.scale;
    limits.max_energy *= w.scale;
    return limits;
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
