// SPDX-License-Identifier: MIT
#include "port_probes.hpp"

#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus
{

Result<std::vector<std::string>> PortProbes::probe (Run& run, const graph::Graph& graph, const std::vector<std::string>& ports)
{
    auto earlier = std::exchange (probed, ports);
    auto edit = run.edit (graph);
    const auto refuse = [&] (Message why) {
        probed = std::move (earlier);
        return why;
    };
    if (edit.plan() == nullptr) return refuse (*std::ranges::find (edit.messages(), Message::Severity::error, &Message::severity));
    for (const auto& port : ports)
        if (tapsOf (*edit.plan(), { port }).empty())
            return refuse (Message::error ("probe/several", {}, quote (port) + " refers to the ports of several inner instances",
                                           "name the inner port, as in hand/finger[*]/drag.force"));
    const auto taps = tapsOf (*edit.plan(), ports);
    if (taps.size() > ProbeRing::most)
        return refuse (Message::error ("probe/too_many", {},
                                       "all probes together would have " + std::to_string (taps.size()) + " components, but there is room for "
                                           + std::to_string (ProbeRing::most),
                                       "wait until other probes have ended"));
    auto names = namesOf (*edit.plan(), taps);
    edit.commit();
    return names;
}

std::vector<std::string> PortProbes::clear() { return std::exchange (probed, {}); }

void PortProbes::planComes (const Plan& plan)
{
    constexpr double highest_rate_hz = 1000.0;
    ring.drain ([] (const ProbeRing::Frame&) {});
    serial = plan.serial();
    ring.select (tapsOf (plan, probed), static_cast<std::uint32_t> (std::max (1.0, std::round (plan.rateHz() / highest_rate_hz))));
}

}   // namespace tactus
