// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/graph/graph.hpp>
#include <framework/json.hpp>
#include <framework/message.hpp>
#include <host/hid_link/open_device.hpp>

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tactus::host
{

/// A role and the description of its device.
using Described = std::pair<std::string, Json>;

/// All roles that the nodes of a graph name, inside its subgraphs too; some may never be used. [main thread]
std::vector<std::string> rolesNamed (const graph::Graph&);

/// What is said about the clock of a run, and by whom.
struct ClockWish
{
    std::string option;                 ///< of the command line: a role, "timer" or "audio"; "": nothing
    std::string session;                ///< likewise, of the session
    std::optional<double> rate_hz {};   ///< that the run is to have whatever ticks it
};

/// Who ticks a run.
struct ClockChoice
{
    std::string role {};          ///< whose device; "": none
    double rate_hz = 0.0;         ///< of that device
    Messages messages {};         ///< an error for an option that cannot be had, a warning for a session's
    bool by_sound_card = false;   ///< where no device does; else it is the timer
};

/// The rate at which a device would tick, in Hz; nothing if it would not. One that is only awaited can be chosen by name, and
/// is not taken where nobody says.
using TickRate = std::function<std::optional<double> (const Described&, bool may_wait)>;

/// The rate of a HID device that is connected, or that may be waited for and has a profile that is named; nothing if it has
/// no clock, as one that only speaks when something moves. [main thread]
std::optional<double> tickRateOf (const Json& description, hid::HidSystem&, const hid::LoadedProfiles&, bool may_wait);

/// The option outranks the session. Without both, the first device that can ticks, unless there is a rate. [main thread]
/// Ids: run/no_clock, run/two_rates, session/clock.
ClockChoice chooseClock (const ClockWish&, const std::vector<Described>&, const TickRate&);

}   // namespace tactus::host
