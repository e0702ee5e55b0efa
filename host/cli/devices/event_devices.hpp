// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/text/json.hpp>

#include <memory>
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

/// An open event device whose readings are shown. It gets no force.
class ProbedEvents
{
public:
    virtual ~ProbedEvents() = default;

    virtual void poll() = 0;                               ///< every few ms
    virtual std::string text (double seconds) const = 0;   ///< since it was opened
    virtual Json json() const = 0;
    virtual const std::string& path() const = 0;
};

/// Null if it cannot be opened; says why on stderr.
std::unique_ptr<ProbedEvents> probeEventDevice (const ListedEvents&);

}   // namespace tactus::host
