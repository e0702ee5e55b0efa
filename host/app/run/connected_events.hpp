// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace tactus::host
{

/// A wheel, a joystick or a pad with force feedback at an event device of Linux.
struct ConnectedEvents
{
    std::string name, path;
    std::string trouble {};   ///< what this user has to do before it can be opened; empty: nothing

    bool operator== (const ConnectedEvents&) const = default;
};

/// The event devices of this computer. None where the driver `evdev` was not built. Opens each of them for a moment. [any thread]
std::vector<ConnectedEvents> connectedEvents();

}   // namespace tactus::host
