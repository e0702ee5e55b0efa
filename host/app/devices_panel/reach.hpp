// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/run/device_setup.hpp>
#include <host/app/run/live_run.hpp>
#include <host/app/scene/reach.hpp>
#include <tactus/run/device/device_numbers.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// The boxes that devices can reach, in the graph of a run. The devices are those that the session binds to the roles of the run. Roles whose tool
/// the mouse or a gesture moves are left out. The box is that of the profile, of the calibration, or, for a simulated device, of the one that it
/// stands for. Call it as often as you like: what it reads from the session is kept until that changes. [main thread]
class Reaches
{
public:
    explicit Reaches (const DeviceSetup& s) : setup (s) {}

    std::vector<scene::Reach> of (const LiveRun&);

private:
    struct Known
    {
        Json binding;
        std::optional<DeviceReach> box;
    };

    const DeviceSetup& setup;
    std::map<std::string, Known> known;   // by role
};

/// The box that a device can reach, in its own coordinates; empty if it is not known. Without the travel of an axis, its side is 0.
std::optional<DeviceReach> boxOf (const Json& binding, const hid::LoadedProfiles&);

}   // namespace tactus::host
