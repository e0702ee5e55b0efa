// SPDX-License-Identifier: GPL-3.0-or-later
#include "missing_ends.hpp"

#include <host/app/text/filled.hpp>

#include <algorithm>
#include <array>
#include <string_view>

namespace tactus::host
{

namespace
{
constexpr std::array<std::string_view, 5> readers { "device.position", "device.axis", "device.pressure", "device.button", "device.signal_in" };
constexpr std::array<std::string_view, 3> drivers { "device.force", "device.effort", "device.signal_out" };

template <std::size_t N>
bool hasOne (const graph::Graph& g, const std::array<std::string_view, N>& types)
{
    const auto isOne = [&] (const graph::Node& n) { return std::ranges::find (types, n.type) != types.end(); };
    return std::ranges::any_of (g.root.nodes, isOne)
           || std::ranges::any_of (g.graphs, [&] (const auto& subgraph) { return std::ranges::any_of (subgraph.second.nodes, isOne); });
}
}   // namespace

Messages missingEnds (const graph::Graph& g)
{
    Messages all;
    if (g.root.nodes.empty()) return all;
    if (! hasOne (g, readers))
        all.push_back (Message::warning ("graph/no_hand", "", TRANS ("the graph has no hand: no node reads the position of a tool").toStdString(),
                                         TRANS ("add device.position, and wire it to what the tool touches").toStdString()));
    if (! hasOne (g, drivers))
        all.push_back (Message::warning ("graph/no_motor", "", TRANS ("the graph has no motor: no node sends a force or a vibration to a device").toStdString(),
                                         TRANS ("add device.force, and wire the forces to it").toStdString()));
    return all;
}

}   // namespace tactus::host
