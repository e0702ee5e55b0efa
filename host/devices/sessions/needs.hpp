// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/device_plugins/driver_about.hpp>
#include <host/devices/hid/profile_reader.hpp>
#include <tactus/node/device.hpp>
#include <tactus/plan/plan.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/message.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// The parts of a device: either the parts that a graph needs from a role, or the parts that a device has. Parts that are not
/// wired are not needed.
struct DeviceParts
{
    bool position = false, rotation = false, pressure = false;   ///< inputs
    bool force = false, torque = false, brake = false;           ///< outputs
    bool truth = false;                                          ///< ground truth, which only a simulated device has
    DeviceLayout others {};                                      ///< parts with names, and channels up to the highest number

    bool operator== (const DeviceParts&) const = default;
};

struct RoleNeeds
{
    std::string role;
    DeviceParts parts;
};

/// The needs of a graph from each of its roles, in the order of the plan. Bypassed nodes need nothing. [main thread]
std::vector<RoleNeeds> needsOf (const Plan&);

/// The parts of a device according to its description; empty if only the device itself knows them, or if the description is
/// wrong. [main thread]
std::optional<DeviceParts> partsOf (const Json& description, const std::filesystem::path& folder, const hid::LoadedProfiles&);
DeviceParts partsOf (const hid::Profile&);
DeviceParts partsOf (const DriverAbout&);

/// The directions in which a device can move the tool: "y", or "x and y"; empty if it can move the tool in all of them. `axes`: those of its
/// workspace.
std::string movesAlong (const hid::Profile&, const Mat3& axes);

/// The same for its force: "x" or "x and y"; empty for all three, and for a device without a force.
std::string pushesAlong (const hid::Profile&, const Mat3& axes);

/// Describes parts, as in "position, force, axis 'trigger', signal output 2", or "nothing".
std::string describe (const DeviceParts&);

/// The missing parts, each as in "no rotation" or "no axis 'grip' (did you mean 'trigger'?); its axes: 'trigger'".
std::vector<std::string> lackingOf (const DeviceParts& needed, const DeviceParts& there);

/// A warning for each part of the tool that a role needs but its device lacks. missingParts reports the named parts.
/// Id: device/missing_tool.
Messages missingTools (const RoleNeeds&, const DeviceParts& there);

}   // namespace tactus::host
