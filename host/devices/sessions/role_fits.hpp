// SPDX-License-Identifier: MIT
#pragma once

#include "binding.hpp"
#include "needs.hpp"

#include <tactus/graph/graph.hpp>

#include <span>

namespace tactus::host
{

/// A role of a graph, its needs, and the device bound to it.
struct RoleFit
{
    enum class From
    {
        session,
        graph,
        none   ///< no device is described, so the role gets a simulated tool at rest
    };

    std::string role;
    DeviceParts needs;
    From from = From::none;
    Json description {};   ///< description of the device, without "workspace"
    Workspace workspace {};
    std::optional<DeviceParts> there {};   ///< parts of the device, from partsOf
    std::optional<bool> connected {};      ///< set only for a HID device with a profile, and false for a serial port that does not exist
    std::string along {};                  ///< the only directions in which the device moves in the graph, as movesAlong
    std::string pushes {};                 ///< the only directions in which it pushes, as pushesAlong
    std::vector<std::string> lacking {};   ///< missing parts, from lackingOf
    Messages messages {};                  ///< problems of the description; `where` is relative to it

    bool fits() const { return lacking.empty() && ! hasErrors (messages); }
};

/// One entry for each role, in the order of the needs. `connected`: the devices that are plugged in. No driver of a plugin is loaded, because the window
/// calls this several times a second: the descriptions that a session has for such drivers are not checked. [main thread]
std::vector<RoleFit> fitsOf (const std::vector<RoleNeeds>&, const graph::Graph&, const LoadedSession&, const hid::LoadedProfiles&,
                             std::span<const hid::ConnectedDevice> connected);

/// A short name for a description, such as "hid tactus_board, serial B7", "gesture stroke" or "sim".
std::string nameOf (const Json& description);

/// True if the driver of a description is none of Tactus, so that it must be in a plugin, which may not be installed. Loads nothing.
bool namesPlugin (const Json& description);

/// True if a connected HID device matches the description. On other wires: false if the port does not exist; else empty, because only a run asks the
/// device.
std::optional<bool> isConnected (const Json& description, std::span<const hid::ConnectedDevice>, const hid::LoadedProfiles&);

/// Checks the description of a device with any driver, as far as that is possible without the device. Loads the driver if it is in a plugin.
Messages checkDescription (const Json& description, const std::filesystem::path& folder, const hid::LoadedProfiles&);

/// Checks the description of a binding, including its workspace.
Messages checkBinding (const Json& binding, const std::filesystem::path& folder, const hid::LoadedProfiles&);

}   // namespace tactus::host
