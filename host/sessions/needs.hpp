// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/device.hpp>
#include <framework/json.hpp>
#include <framework/message.hpp>
#include <framework/plan/plan.hpp>
#include <host/hid/profile_reader.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// The parts of a device: what a graph takes of a role, or what a device has. A part that nobody wires is not taken.
struct DeviceParts
{
    bool position = false, rotation = false, pressure = false;   ///< that it reads
    bool force = false, torque = false;                          ///< that it gives
    bool truth = false;                                          ///< what only a simulated device knows of itself
    DeviceLayout others {};                                      ///< by name; of channels, as many as the highest

    bool operator== (const DeviceParts&) const = default;
};

struct RoleNeeds
{
    std::string role;
    DeviceParts parts;
};

/// What a graph needs of each of its roles, in the order of the plan. Nodes that are bypassed need nothing. [main thread]
std::vector<RoleNeeds> needsOf (const Plan&);

/// What a device has by its description, as far as one can see without it; nothing if only the device would tell, or if the
/// description is wrong. [main thread]
std::optional<DeviceParts> partsOf (const Json& description, const std::filesystem::path& folder, const hid::LoadedProfiles&);
DeviceParts partsOf (const hid::Profile&);

/// "position, force, axis 'trigger', signal output 2"; "nothing".
std::string describe (const DeviceParts&);

/// What is needed and not there, each as "no rotation", "no axis 'grip' (did you mean 'trigger'?); its axes: 'trigger'".
std::vector<std::string> lackingOf (const DeviceParts& needed, const DeviceParts& there);

/// A warning for each part of the tool that a role needs and its device does not have; the parts with names are told by
/// missingParts. Id: device/missing_tool.
Messages missingTools (const RoleNeeds&, const DeviceParts& there);

}   // namespace tactus::host
