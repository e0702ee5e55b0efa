// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "device_bindings.hpp"

#include <host/app/inspector/describe.hpp>

namespace tactus::host
{

/// The remarks on the cards of the devices panel. [main thread]
class DeviceRemarks
{
public:
    DeviceRemarks (const DeviceBindings& b, const LiveRun& r, const DeviceSetup& s) : bindings (b), run (r), setup (s) {}

    Remark fit (const std::string& role) const;      ///< what the role needs, and what its device lacks
    Remark status (const std::string& role) const;   ///< whether the device is connected and works, and whether its guard has stopped it
    Remark clock() const;                            ///< what ticks the run, and what the system refuses to a run that drives a device
    Remark sound() const;

private:
    Remark ofEvents (const Json& description) const;
    Remark tick() const;

    const DeviceBindings& bindings;
    const LiveRun& run;
    const DeviceSetup& setup;
};

}   // namespace tactus::host
