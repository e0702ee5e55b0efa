// SPDX-License-Identifier: GPL-3.0-or-later
#include "taps.hpp"
#include "probe_ring.hpp"

#include <framework/in_quotes.hpp>
#include <framework/refused.hpp>

#include <algorithm>

namespace tactus::host
{

std::vector<std::size_t> tapsOf (const Plan& plan, const std::vector<std::string>& ports)
{
    std::vector<std::size_t> taps;
    for (std::size_t i = 0; i < plan.taps.size(); ++i)
        if (std::ranges::any_of (ports, [&] (const std::string& port)
                                 { return isPartOf (plan.taps[i].name, port); }))
            taps.push_back (i);
    return taps;
}

std::vector<std::string> namesOf (const Plan& plan, const std::vector<std::size_t>& taps)
{
    std::vector<std::string> names;
    for (const auto tap : taps)
        names.push_back (plan.taps[tap].name);
    return names;
}

std::variant<Armed, Message> arm (const Plan& plan, const std::string& port, const std::string& watched, const Trigger& trigger)
{
    auto taps = tapsOf (plan, { port });
    const auto triggers = tapsOf (plan, { watched });
    if (triggers.size() != 1) return refused ("probe/trigger", inQuotes (watched) + " has " + std::to_string (triggers.size()) + " components, and a trigger watches one", triggers.empty() ? std::string ("name a port with one component") : "name one of them, as in " + plan.taps[triggers.front()].name);
    if (taps.size() > ProbeRing::most || taps.size() * trigger.ticks() > TriggeredCapture::most) return refused ("probe/too_many", std::to_string (trigger.ticks()) + " ticks of " + std::to_string (taps.size()) + " components are more than the " + std::to_string (TriggeredCapture::most) + " numbers, of at most " + std::to_string (ProbeRing::most) + " components, that there is room for", "ask for fewer before and after, or for one component");
    auto names = namesOf (plan, taps);
    return Armed { std::make_unique<TriggeredCapture> (trigger, plan.serial, std::move (taps), triggers.front()), std::move (names) };
}

}   // namespace tactus::host
