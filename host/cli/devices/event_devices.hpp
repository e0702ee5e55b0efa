// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/tools/reports/event_devices.hpp>

#include <memory>
#include <string>

namespace tactus::host
{

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
