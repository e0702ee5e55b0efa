// SPDX-License-Identifier: GPL-3.0-or-later
#include "hardware.hpp"

#include <host/hid_link/describe_counts.hpp>
#include <host/hid_link/profile_shelf.hpp>

#include <algorithm>
#include <cstdio>

namespace tactus::host
{
namespace
{
std::string milliseconds (double s)
{
    char text[32];
    std::snprintf (text, sizeof text, "%.2f", 1e3 * s);
    return text;
}
}   // namespace

const hid::LoadedProfiles& Hardware::profiles()
{
    if (! loaded) loaded = hid::profilesAtHand();
    return *loaded;
}

MadeDevice Hardware::open (const Json& description, const std::filesystem::path& folder)
{
    if (! allowed || ! hid::isHid (description)) return makeDevice (description, folder);
    return hid::openDevice (description, folder, hid::thisComputer(), profiles());
}

std::optional<double> Hardware::clockRate (const Json& description)
{
    if (! hid::isHid (description)) return std::nullopt;
    const auto found = hid::findDevice (description, hid::thisComputer(), profiles());
    const bool ticks = found.profile && found.profile->rate > 0.0 && std::ranges::count (found.profile->quirks, "only_changes") == 0;
    return ticks ? std::optional (found.profile->rate) : std::nullopt;
}

std::string statusOf (std::span<const RealDevice> devices, const hid::HidClock* clock)
{
    std::string text;
    for (const auto& [role, device] : devices)
    {
        if (! device->port().isConnected()) text += "   " + role + " is unplugged";
        const auto counts = device->counts();
        if (counts.lost > 0) text += "   " + role + " lost " + std::to_string (counts.lost);
    }
    if (clock != nullptr && clock->isByTimer()) text += "   ticked by the timer, as no reports come";
    return text;
}

std::string accountOf (std::span<const RealDevice> devices, const hid::HidClock* clock)
{
    std::string text;
    for (const auto& [role, device] : devices)
    {
        const auto read = device->counts();
        const auto port = device->port().counts();
        text += role + " (" + device->port().profile()->id + "): " + std::to_string (port.reports) + " reports, " + hid::describe (read, port) + "\n";
        if (port.writes > 0)
            text += "    sent " + std::to_string (port.writes) + ", " + std::to_string (port.write_errors) + " failed, " + std::to_string (port.dropped) + " overwritten before; "
                    + "from report to answer " + milliseconds (port.latency_min) + " to " + milliseconds (port.latency_max) + " ms, mean " + milliseconds (port.latency_mean) + " ms\n";
        if (port.silences > 0) text += "    the ticks stood still " + std::to_string (port.silences) + " times for longer than its watchdog, and it was let go\n";
        if (port.departures > 0) text += "    it was unplugged " + std::to_string (port.departures) + " times" + (device->port().isConnected() ? "" : ", and is still away") + "\n";
        if (const auto trouble = device->port().trouble(); ! trouble.empty()) text += "    last trouble: " + trouble + "\n";
    }
    if (clock != nullptr && clock->ticksByTimer() > 0) text += "    " + std::to_string (clock->ticksByTimer()) + " ticks came from the timer, as no reports came\n";
    return text;
}

}   // namespace tactus::host
