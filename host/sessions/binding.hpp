// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "session_file.hpp"
#include "workspace.hpp"

#include <host/devices/make_device.hpp>
#include <host/hid_link/open_device.hpp>

#include <functional>
#include <optional>

namespace tactus::host
{

/// What a session binds a role to.
struct RoleBinding
{
    Json description;   ///< as a graph has it
    Workspace workspace;
    std::filesystem::path folder;   ///< where paths in the description start: that of the session
    Messages messages;
};

/// Nothing if the session does not name the role. [main thread]
std::optional<RoleBinding> bindingOf (const LoadedSession&, std::string_view role);

/// A device for a role, in the graph's workspace.
struct BoundDevice
{
    std::unique_ptr<Device> device;   ///< null if there are errors
    Device* driver = nullptr;         ///< the same, without the workspace around it
    GuardLimits limits;
    std::string about;
    Messages messages;   ///< `where` and lines as of the session
};

/// What becomes of a role whose device does not open.
enum class Absence
{
    waits,     ///< its guard holds the efforts at zero until it comes; that is a warning
    refuses,   ///< it is an error
};

/// A role that gets another device keeps what a person has said of it: its guard and its workspace, unless the new description
/// has its own, or one of the two is a sound card, which has another kind of both.
Json boundAnew (const Json* before, Json description);

/// What opens a device without regard to sessions.
using OpenDevice = std::function<MadeDevice (const Json& description, const std::filesystem::path& folder)>;

/// Opens what a session binds a role to. Only a HID device with a profile that is named can be waited for: of others nobody
/// knows what they will have. [main thread] Ids: those of what opens it.
BoundDevice openBound (const LoadedSession&, std::string_view role, const RoleBinding&, const OpenDevice&, hid::HidSystem&, const hid::LoadedProfiles&, Absence);

}   // namespace tactus::host
