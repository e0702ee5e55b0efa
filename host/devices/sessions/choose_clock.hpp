// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/hid_link/open_device.hpp>
#include <tactus/graph/graph.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/message.hpp>

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tactus::host
{

/// A role and the description of its device.
using Described = std::pair<std::string, Json>;

/// All roles named by the nodes of a graph, including its subgraphs; some may be unused. [main thread]
std::vector<std::string> rolesNamed (const graph::Graph&);

/// The requested clock of a run, by source.
struct ClockRequest
{
    std::string option;                 ///< from the command line: a role, "timer" or "audio"; "": none
    std::string session;                ///< from the session: the same kinds of names
    std::optional<double> rate_hz {};   ///< fixed rate of the run, whichever clock drives it
};

/// The clock that ticks a run.
struct ClockChoice
{
    std::string role {};          ///< the role whose device ticks the run; "": none
    double rate_hz = 0.0;         ///< rate at which that device ticks
    Messages messages {};         ///< an error if the clock of the option cannot be used, a warning if the session's cannot
    bool by_sound_card = false;   ///< if no device ticks the run: true for the sound card, false for a timer
};

/// The rate in Hz at which a device would tick the run; empty if it cannot tick a run. A device that is not available yet counts only with
/// `may_wait`: it must be chosen by name, and is never chosen automatically.
using TickRate = std::function<std::optional<double> (const Described&, bool may_wait)>;

/// The rate of a HID device that is connected, or of one with a named profile if it may be waited for. Empty if the device
/// has no clock, because it sends only when something moves, for example. [main thread]
std::optional<double> tickRateOf (const Json& description, hid::HidSystem&, const hid::LoadedProfiles&, bool may_wait);

/// The option takes precedence over the session. If neither names a clock, the first device that can tick the run does, unless
/// there is a fixed rate. [main thread]
ClockChoice chooseClock (const ClockRequest&, const std::vector<Described>&, const TickRate&);

}   // namespace tactus::host
