// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/canvas/port_card.hpp>
#include <host/app/canvas/scene.hpp>

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace tactus::host
{

/// Live state of the running graph, shown on the canvas.
struct LiveState
{
    static constexpr int most_level = 4;

    bool runs = false;
    std::map<graph::Id, int> states;                                   ///< the state of each node that reports one
    std::map<graph::Id, double> costs;                                 ///< the cost of each node, as a fraction of a tick; empty while costs are hidden
    std::map<graph::Id, double> hits;                                  ///< position of a hit along its wire, 0…1
    std::map<graph::Id, int> levels;                                   ///< how much each wire carries, 1 to most_level; nothing: not in the map
    std::map<std::pair<graph::Id, std::string>, std::string> driven;   ///< what wires set params to, by node and param
    std::optional<PortCard> card;                                      ///< of the port under the pointer
    std::map<graph::Id, std::string> problems;                         ///< messages about nodes and wires

    /// The limits of devices that a node breaks or nearly breaks.
    struct Limit
    {
        bool is_broken = false;
        std::string text;

        bool operator== (const Limit&) const = default;
    };
    std::map<graph::Id, Limit> limits;

    bool operator== (const LiveState&) const = default;
};

/// Everything on the canvas that is not part of the graph.
struct Highlights
{
    std::set<graph::Id> selected;   ///< ids of nodes, wires and notes
    std::optional<Bend> bend {};    ///< the selected one; its wire is selected, too
    graph::Id hovered = 0;
    /// While a wire is being drawn: true for the sockets it may connect to. The others are dimmed.
    std::function<bool (const SceneNode&, const FacePort&)> fits {};
    LiveState live {};
};

}   // namespace tactus::host
