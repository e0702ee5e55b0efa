// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/run/connected_events.hpp>
#include <host/app/text/filled.hpp>
#include <host/devices/hid/profile_reader.hpp>
#include <host/devices/hid_link/transport.hpp>
#include <host/devices/sessions/offered_devices.hpp>
#include <tactus/text/json.hpp>

#include <span>
#include <string>
#include <vector>

namespace tactus::host
{

inline constexpr const char* sound_card = NEEDS_TRANS ("sound card");   // the label, in English

inline constexpr const char* event_driver = "evdev";   ///< the driver of event devices, a plugin

/// A device that a role can be bound to.
struct BindingChoice
{
    std::string label;
    Json description;         ///< without a guard; null: as in the graph
    std::string numbers {};   ///< id of the profile whose numbers the simulated device gets; empty for other choices

    bool operator== (const BindingChoice&) const = default;
};

/// The choices for a role: as in the graph, a simulated tool, the sound card, each connected device that has a profile, each of `without_profile`, which
/// have force feedback, each event device, by its name if that is unique, each offered device, a simulation of each device that is known only by its
/// numbers, the gestures, and the present binding of the role if it is none of these.
std::vector<BindingChoice> bindingChoices (const Json* bound_now, std::span<const hid::ConnectedDevice>, const hid::LoadedProfiles&,
                                           std::span<const hid::ConnectedDevice> without_profile = {}, std::span<const ConnectedEvents> = {},
                                           std::span<const OfferedDevice> = {});

/// The device of a binding, without its workspace and guard, and, if its driver is one of Tactus, without its channels, calibration and rate.
Json deviceOfBinding (Json binding);

/// A simulated device with the numbers of a profile. It keeps the guard of the previous binding, so that no limit is lost, unless that
/// was a sound card.
Json simulationOf (const hid::Profile& profile, const Json* before);

}   // namespace tactus::host
