// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "binding.hpp"
#include "needs.hpp"

#include <framework/graph/graph.hpp>

#include <span>

namespace tactus::host
{

/// A role of a graph, what it needs, and what stands behind it.
struct RoleFit
{
    enum class From
    {
        session,
        graph,
        nobody   ///< a simulated tool at rest stands in
    };

    std::string role;
    DeviceParts needs;
    From from = From::nobody;
    Json description {};   ///< of the device, without "workspace"
    Workspace workspace {};
    std::optional<DeviceParts> there {};   ///< as of partsOf
    std::optional<bool> connected {};      ///< of a HID device
    std::vector<std::string> lacking {};   ///< as of lackingOf
    Messages messages {};                  ///< what is wrong with the description; `where` within it

    bool fits() const { return lacking.empty() && ! hasErrors (messages); }
};

/// In the order of the needs. `connected` are the devices that are plugged in. [main thread]
std::vector<RoleFit> fitsOf (const std::vector<RoleNeeds>&, const graph::Graph&, const LoadedSession&, const hid::LoadedProfiles&, std::span<const hid::ConnectedDevice> connected);

/// "hid tactus_board, serial B7", "gesture stroke", "sim".
std::string nameOf (const Json& description);

/// Whether a HID device that is plugged in is what a description asks for.
bool isAmong (const Json& description, std::span<const hid::ConnectedDevice>, const hid::LoadedProfiles&);

/// What is wrong with the description of a device, whatever its driver, as far as one can see without the device.
Messages checkDescription (const Json& description, const std::filesystem::path& folder, const hid::LoadedProfiles&);

/// What is wrong with the description of a binding, "workspace" and all.
Messages checkBinding (const Json& binding, const std::filesystem::path& folder, const hid::LoadedProfiles&);

}   // namespace tactus::host
