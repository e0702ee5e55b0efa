// SPDX-License-Identifier: GPL-3.0-or-later
#include "scope_port.hpp"

#include <tactus/graph/inside.hpp>
#include <tactus/graph/instances.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
constexpr int most_nodes = 20000;   // twice as many as a processor core computes in a tick

struct PortCollector
{
    const Catalogue& catalogue;
    std::vector<ScopePort> all;
    std::vector<const graph::Patch*> open {};   // those that contain the patch; a broken graph may contain itself
    int nodes = 0;

    /// `prefix` begins the names of the ports, and `first` their names in the first instances.
    void patch (const graph::Graph& g, const graph::Patch& p, const std::string& prefix, const std::string& first, std::size_t instances)
    {
        if (open.size() > deepest_subgraph || std::ranges::count (open, &p) > 0) return;
        open.push_back (&p);
        for (const auto& node : p.nodes)
        {
            if (++nodes > most_nodes) break;
            const auto count = static_cast<std::size_t> (std::max (1, graph::countOf (node).value_or (1)));
            const auto path = prefix + node.name, in_first = first + node.name + (count > 1 ? "[0]" : "");
            const auto face = faceOf (g, p, node, catalogue);
            for (const auto* ports : { &face.outputs, &face.inputs, &face.params })
                for (const auto& port : *ports)
                    if (! port.isChoice())
                        all.push_back ({ path + "." + port.id, path, node.id, node.type, port, in_first + "." + port.id, instances * count });
            if (const auto inside = graph::insideOf (g, node)) patch (*inside.owner, *inside.patch, path + "/", in_first + "/", instances * count);
        }
        open.pop_back();
    }
};
}   // namespace

std::vector<ScopePort> scopePorts (const graph::Graph& g, const Catalogue& c)
{
    PortCollector walk { c, {} };
    walk.patch (g, g.root, {}, {}, 1);
    return std::move (walk.all);
}

std::string motorPort (const std::vector<ScopePort>& ports)
{
    const auto isIt = [] (const ScopePort& p) { return p.type.starts_with ("device.force") && p.port.role == Role::input && p.port.id == "force"; };
    const auto motor = std::ranges::find_if (ports, isIt);
    if (motor == ports.end()) return {};
    return motor->instances > most_in_one_scope ? motor->first : motor->name;
}

}   // namespace tactus::host
