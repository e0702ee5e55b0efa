// SPDX-License-Identifier: MIT
#pragma once

#include "session_file.hpp"
#include "workspace.hpp"

#include <host/devices/hid_link/open_device.hpp>
#include <tactus/run/device/make_device.hpp>

#include <functional>
#include <optional>

namespace tactus::host
{

/// The binding of a role in a session.
struct RoleBinding
{
    Json description;   ///< as in a graph
    Workspace workspace;
    std::filesystem::path folder;   ///< the folder of the session, which paths in the description are relative to
    Messages messages;
};

/// The binding of a role. Empty if the session does not bind it. [main thread]
std::optional<RoleBinding> bindingOf (const LoadedSession&, std::string_view role);

/// An open device for a role, with positions in the workspace of the graph.
struct BoundDevice
{
    std::unique_ptr<Device> device;   ///< null if there are errors
    Device* driver = nullptr;         ///< the same device without the workspace wrapper
    GuardLimits limits;
    std::string about;
    Messages messages;   ///< `where` and line numbers refer to the session file
};

/// The consequence if the device of a role does not open.
enum class Absence
{
    waits,     ///< a warning; the guard holds the efforts at zero until the device is available
    refuses,   ///< an error
};

/// Gives a role another device and keeps its guard and workspace, unless the new description has its own, or one of the two
/// devices is a sound card, whose guard and workspace are of a different kind.
Json rebound (const Json* before, Json description);

/// Opens a device, independently of sessions.
using OpenDevice = std::function<MadeDevice (const Json& description, const std::filesystem::path& folder)>;

/// Opens the device that a session binds a role to. Only a HID device with a named profile can be waited for: the parts of
/// other devices are unknown. [main thread] Ids: those of `OpenDevice`.
BoundDevice openBound (const LoadedSession&, std::string_view role, const RoleBinding&, const OpenDevice&, hid::HidSystem&, const hid::LoadedProfiles&,
                       Absence);

}   // namespace tactus::host
