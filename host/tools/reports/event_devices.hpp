// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/json.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// An event device with force feedback, as `tactus devices` lists it: a wheel, a joystick or a pad.
struct ListedEvents
{
    std::string path;
    bool may_open = false;
    Json json;          ///< for --json
    std::string text;   ///< three lines
};

/// The event devices of this computer. None where the driver `evdev` was not built.
std::vector<ListedEvents> listEventDevices();

}   // namespace tactus::host
