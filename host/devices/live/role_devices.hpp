// SPDX-License-Identifier: MIT
#pragma once

#include "hardware.hpp"

#include <host/devices/sessions/binding.hpp>
#include <host/devices/sessions/choose_clock.hpp>
#include <host/devices/sessions/device_health.hpp>
#include <tactus/run/run.hpp>

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace tactus::host
{

/// The device that each role of a run gets: the one that the caller gives it, else the one that the session binds it to, else the one that the graph
/// describes, else a simulated tool at rest. [main thread]
class RoleDevices
{
public:
    struct Choice
    {
        std::vector<DeviceOption> given {};                             ///< by the user of the program, by role
        LoadedSession session {};                                       ///< of the user; may be empty
        std::function<bool (const std::string& role)> is_by_graph {};   ///< true: the role gets the device in the graph, even if the session binds it
        Absence absence = Absence::waits;                               ///< of a device that the session binds

        /// May replace the device that was opened for a role, or put another one around it. `workspace` is that of the session. May be null.
        std::function<void (const std::string& role, Run::RoleDevice&, const Workspace&, Messages&)> adopt {};
        std::string remedy = "describe a device for it under `devices`";   ///< for a role without any device, ROLE being its name; "": no warning
    };

    RoleDevices (Hardware h, Choice c) : hardware (std::move (h)), choice (std::move (c)) {}

    /// The session has changed: devices that are opened from now on are those of the new one.
    void rebind (LoadedSession s) { choice.session = std::move (s); }

    /// The descriptions of the devices of all roles that nodes of a graph name.
    std::vector<Described> describe (const graph::Graph&) const;

    /// The clock that ticks a run of the graph: the one that is asked for, else the session's, else the first device that can tick the run, unless
    /// there is a fixed rate.
    ClockChoice chooseClock (const graph::Graph&, const std::string& asked, std::optional<double> rate_hz) const;

    /// Opens the device of a role. Ids: those of Hardware::open and openBound, device/undescribed, device/not_by_graph.
    Run::RoleDevice open (const std::string& role, const graph::Graph&, const Plan&, Messages&);

    /// A warning for each role whose device comes from the graph, if an edit describes the device differently: it takes effect with the next
    /// run. Id: watch/device.
    Messages notTakenOver (const graph::Graph& before, const graph::Graph& after) const;

private:
    const DeviceOption* givenTo (const std::string& role) const;
    std::optional<RoleBinding> boundTo (const std::string& role) const;
    Run::RoleDevice openBound (const std::string& role, const RoleBinding&, const Plan&, Messages&);
    Run::RoleDevice openOther (const std::string& role, const graph::Graph&, const Plan&, Messages&);

    Hardware hardware;
    Choice choice;
    std::set<std::string> by_graph;   // roles whose device comes from the graph
};

/// Puts a workspace around a device that has none, so that it can be moved. [main thread]
void makeMovable (Run::RoleDevice&);

/// The real devices of a run, present or awaited. [main thread]
std::vector<RealDevice> realDevices (const Run&);

/// The devices of drivers in plugins. [main thread]
std::vector<PluginRole> pluginRoles (const Run&);

}   // namespace tactus::host
