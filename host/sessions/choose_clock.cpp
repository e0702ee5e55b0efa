// SPDX-License-Identifier: GPL-3.0-or-later
#include "choose_clock.hpp"

#include <framework/in_quotes.hpp>
#include <framework/number_text.hpp>
#include <host/devices/problem.hpp>

#include <algorithm>
#include <set>

namespace tactus::host
{

namespace
{
constexpr std::string_view timer = "timer", sound_card = "audio";

Message warning (std::string text, std::string remedy)
{
    auto m = problem ("session/clock", "/clock", std::move (text), std::move (remedy));
    m.severity = Message::Severity::warning;
    return m;
}

void addNames (const Json& mapped, std::set<std::string>& names)
{
    if (mapped.is_string()) names.insert (mapped.get<std::string>());
    if (mapped.is_structured())
        for (const auto& inner : mapped)
            addNames (inner, names);
}

void addRoles (const graph::Graph& g, std::set<std::string>& names)
{
    const auto add = [&] (const graph::Patch& patch)
    {
        for (const auto& node : patch.nodes)
        {
            if (! node.role.empty()) names.insert (node.role);
            addNames (node.roles, names);
        }
    };
    add (g.root);
    for (const auto& [name, patch] : g.graphs)
        add (patch);
    for (const auto& [name, file] : g.files)
        addRoles (*file, names);
}

ClockChoice byOption (const ClockWish& wish, const std::vector<Described>& devices, const TickRate& rateOf)
{
    ClockChoice choice;
    const auto device = std::ranges::find (devices, wish.option, &Described::first);
    const auto rate = device != devices.end() ? rateOf (*device, true) : std::nullopt;
    if (! rate)
        choice.messages.push_back (problem ("run/no_clock", "--clock " + wish.option, "no device that is connected ticks for " + inQuotes (wish.option), "name a role whose device is a HID device with a rate in its profile, or write --clock timer or --clock audio"));
    else if (wish.rate_hz && *wish.rate_hz != *rate)
        choice.messages.push_back (problem ("run/two_rates", "--clock " + wish.option, "its device ticks at " + numberText (*rate) + " Hz, and the run is to have " + numberText (*wish.rate_hz) + " Hz", "leave out --rate, or write --clock timer"));
    else
        return { wish.option, *rate, {} };
    return choice;
}

ClockChoice byNobody (const ClockWish& wish, const std::vector<Described>& devices, const TickRate& rateOf)
{
    if (wish.rate_hz) return {};
    for (const auto& device : devices)
        if (const auto rate = rateOf (device, false)) return { device.first, *rate, {} };
    return {};
}

ClockChoice bySession (const ClockWish& wish, const std::vector<Described>& devices, const TickRate& rateOf)
{
    const auto device = std::ranges::find (devices, wish.session, &Described::first);
    if (device == devices.end())
    {
        auto choice = byNobody (wish, devices, rateOf);
        choice.messages.push_back (warning ("the session has " + inQuotes (wish.session) + " tick the run, and this graph has no such role", (choice.role.empty() ? "a timer" : inQuotes (choice.role)) + " ticks it; choose with --clock ROLE, or in the session: tactus session --clock ROLE"));
        return choice;
    }
    const auto rate = rateOf (*device, true);
    ClockChoice choice;
    if (! rate)
        choice.messages.push_back (warning ("the session has " + inQuotes (wish.session) + " tick the run, and its device has no clock", "a timer ticks it; bind the role to a HID device with a rate in its profile, or choose a timer: tactus session --clock timer"));
    else if (wish.rate_hz && *wish.rate_hz != *rate)
        choice.messages.push_back (warning ("the session has " + inQuotes (wish.session) + " tick the run at " + numberText (*rate) + " Hz, and the run is to have " + numberText (*wish.rate_hz) + " Hz", "a timer ticks it; leave out --rate and --feed to have the device do it"));
    else
        return { wish.session, *rate, {} };
    return choice;
}
}   // namespace

std::vector<std::string> rolesNamed (const graph::Graph& g)
{
    std::set<std::string> names;
    addRoles (g, names);
    return { names.begin(), names.end() };
}

std::optional<double> tickRateOf (const Json& description, hid::HidSystem& system, const hid::LoadedProfiles& all, bool may_wait)
{
    if (! hid::isHid (description)) return std::nullopt;
    auto profile = hid::findDevice (description, system, all).profile;
    if (! profile && may_wait)
    {
        const auto name = description.value ("profile", Json());
        const auto at = std::ranges::find_if (all.profiles, [&] (const auto& p)
                                              { return name == p->id; });
        if (at != all.profiles.end()) profile = *at;
    }
    const bool ticks = profile && profile->rate > 0.0 && std::ranges::count (profile->quirks, "only_changes") == 0;
    return ticks ? std::optional (profile->rate) : std::nullopt;
}

ClockChoice chooseClock (const ClockWish& wish, const std::vector<Described>& devices, const TickRate& rateOf)
{
    const auto& said = wish.option.empty() ? wish.session : wish.option;
    if (said == timer || said == sound_card) return { .by_sound_card = said == sound_card };
    if (! wish.option.empty()) return byOption (wish, devices, rateOf);
    return wish.session.empty() ? byNobody (wish, devices, rateOf) : bySession (wish, devices, rateOf);
}

}   // namespace tactus::host
