// SPDX-License-Identifier: MIT
#include "taps.hpp"
#include <tactus/run/probe_ring.hpp>

#include <tactus/text/quote.hpp>
#include <tactus/text/result.hpp>

#include <algorithm>

namespace tactus
{

std::vector<std::size_t> tapsOf (const Plan& plan, const std::vector<std::string>& ports)
{
    std::vector<std::size_t> taps;
    for (std::size_t i = 0; i < plan.taps().size(); ++i)
        if (std::ranges::any_of (ports, [&] (const std::string& port) { return isPartOf (plan.taps()[i].name, port); }))
            taps.push_back (i);
    return taps;
}

std::vector<std::string> namesOf (const Plan& plan, const std::vector<std::size_t>& taps)
{
    std::vector<std::string> names;
    for (const auto tap : taps)
        names.push_back (plan.taps()[tap].name);
    return names;
}

Result<Armed> arm (const Plan& plan, const std::string& port, const std::string& watched, const Trigger& trigger)
{
    auto taps = tapsOf (plan, { port });
    const auto triggers = tapsOf (plan, { watched });
    if (triggers.size() != 1)
    {
        const auto remedy = triggers.empty() ? std::string ("name a port with one component") : "name one, such as " + plan.taps()[triggers.front()].name;
        return Message::error ("probe/trigger", {}, quote (watched) + " has " + std::to_string (triggers.size()) + " components; a trigger watches only one",
                               remedy);
    }
    if (taps.size() > ProbeRing::most || taps.size() * trigger.ticks() > TriggeredCapture::most)
    {
        const auto asked = std::to_string (trigger.ticks()) + " ticks of " + std::to_string (taps.size()) + " components";
        const auto room = std::to_string (TriggeredCapture::most) + " numbers and " + std::to_string (ProbeRing::most) + " components";
        return Message::error ("probe/too_many", {}, "a capture of " + asked + " is too large; it can hold at most " + room,
                               "request fewer ticks before and after the edge, or only one component");
    }
    auto names = namesOf (plan, taps);
    return Armed { std::make_unique<TriggeredCapture> (trigger, plan.serial(), std::move (taps), triggers.front()), std::move (names) };
}

}   // namespace tactus
