// SPDX-License-Identifier: MIT
#include "choose_clock.hpp"
#include "role_fits.hpp"

#include <tactus/text/message.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <set>

namespace tactus::host
{

namespace
{
constexpr std::string_view timer = "timer", sound_card = "audio";

Message warning (std::string text, std::string remedy) { return Message::warning ("session/clock", "/clock", std::move (text), std::move (remedy)); }

void addNames (const Json& mapped, std::set<std::string>& names)
{
    if (mapped.is_string()) names.insert (mapped.get<std::string>());
    if (mapped.is_structured())
        for (const auto& inner : mapped)
            addNames (inner, names);
}

/// A file that is included in several places is looked at once.
void addRoles (const graph::Graph& g, std::set<std::string>& names, std::set<const graph::Graph*>& seen)
{
    const auto add = [&] (const graph::Patch& patch) {
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
        if (seen.insert (file.get()).second) addRoles (*file, names, seen);
}

ClockChoice byOption (const ClockRequest& wish, const std::vector<Described>& devices, const TickRate& rateOf)
{
    ClockChoice choice;
    const auto device = std::ranges::find (devices, wish.option, &Described::first);
    const auto rate = device != devices.end() ? rateOf (*device, true) : std::nullopt;
    if (device != devices.end() && namesPlugin (device->second))
        choice.messages.push_back (Message::error ("run/no_clock", "--clock " + wish.option,
                                                   "the device of the role " + quote (wish.option)
                                                       + " has a driver in a plugin, and devices of such drivers cannot tick a run",
                                                   "name a role with a HID device, or write --clock timer or --clock audio"));
    else if (! rate)
        choice.messages.push_back (
            Message::error ("run/no_clock", "--clock " + wish.option, "the role " + quote (wish.option) + " has no connected device that can tick the run",
                            "name a role whose device is a HID device with a rate in its profile, or write --clock timer or --clock audio"));
    else if (wish.rate_hz && *wish.rate_hz != *rate)
        choice.messages.push_back (Message::error ("run/two_rates", "--clock " + wish.option,
                                                   "the device of this role ticks at " + numberText (*rate) + " Hz, but the run needs "
                                                       + numberText (*wish.rate_hz) + " Hz",
                                                   "leave out --rate and --feed, or write --clock timer"));
    else
        return { wish.option, *rate, {} };
    return choice;
}

ClockChoice automatic (const ClockRequest& wish, const std::vector<Described>& devices, const TickRate& rateOf)
{
    if (wish.rate_hz) return {};
    for (const auto& device : devices)
        if (const auto rate = rateOf (device, false)) return { device.first, *rate, {} };
    return {};
}

ClockChoice bySession (const ClockRequest& wish, const std::vector<Described>& devices, const TickRate& rateOf)
{
    const auto device = std::ranges::find (devices, wish.session, &Described::first);
    if (device == devices.end())
    {
        auto choice = automatic (wish, devices, rateOf);
        choice.messages.push_back (warning ("the session names the role " + quote (wish.session) + " as the clock, but this graph has no such role",
                                            (choice.role.empty() ? "a timer" : quote (choice.role))
                                                + " ticks the run; choose with --clock ROLE, or in the session: tactus session --clock ROLE"));
        return choice;
    }
    const auto rate = rateOf (*device, true);
    ClockChoice choice;
    if (namesPlugin (device->second))
        choice.messages.push_back (warning ("the session names the role " + quote (wish.session)
                                                + " as the clock, but its device has a driver in a plugin, and devices of such drivers cannot tick a run",
                                            "a timer ticks the run; to choose it: tactus session --clock timer"));
    else if (! rate)
        choice.messages.push_back (
            warning ("the session names the role " + quote (wish.session) + " as the clock, but the device of this role cannot tick a run",
                     "a timer ticks the run; bind the role to a HID device with a rate in its profile, or choose a timer: tactus session --clock timer"));
    else if (wish.rate_hz && *wish.rate_hz != *rate)
        choice.messages.push_back (warning ("the session names the role " + quote (wish.session) + " as the clock, at " + numberText (*rate)
                                                + " Hz, but the run needs " + numberText (*wish.rate_hz) + " Hz",
                                            "a timer ticks the run; leave out --rate and --feed to let the device tick it"));
    else
        return { wish.session, *rate, {} };
    return choice;
}
}   // namespace

std::vector<std::string> rolesNamed (const graph::Graph& g)
{
    std::set<std::string> names;
    std::set<const graph::Graph*> seen;
    addRoles (g, names, seen);
    return { names.begin(), names.end() };
}

std::optional<double> tickRateOf (const Json& description, hid::HidSystem& system, const hid::LoadedProfiles& all, bool may_wait)
{
    if (! hid::isHid (description)) return std::nullopt;
    auto profile = hid::findDevice (description, system, all).profile;
    if (const auto name = description.value ("profile", Json()); ! profile && may_wait && name.is_string())
        profile = hid::profileNamed (all, name.asString());
    const bool ticks = profile && profile->rate > 0.0 && ! hid::sendsOnlyChanges (*profile);
    return ticks ? std::optional (profile->rate) : std::nullopt;
}

ClockChoice chooseClock (const ClockRequest& wish, const std::vector<Described>& devices, const TickRate& rateOf)
{
    const auto& said = wish.option.empty() ? wish.session : wish.option;
    if (said == timer || said == sound_card) return { .by_sound_card = said == sound_card };
    if (! wish.option.empty()) return byOption (wish, devices, rateOf);
    return wish.session.empty() ? automatic (wish, devices, rateOf) : bySession (wish, devices, rateOf);
}

}   // namespace tactus::host
