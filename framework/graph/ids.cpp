// SPDX-License-Identifier: MIT
#include "ids.hpp"
#include "instances.hpp"

#include <algorithm>

namespace tactus::graph
{

namespace
{
/// Visits every node and wire, in file order.
template <typename Graph, typename Visit>
void forEach (Graph& graph, Visit visit)
{
    const auto patch = [&] (auto& p) {
        for (auto& node : p.nodes)
            visit (node);
        for (auto& wire : p.wires)
            visit (wire);
    };
    patch (graph.root);
    for (auto& [name, subgraph] : graph.graphs)
        patch (subgraph);
}

bool isIdNumber (const Json& value) { return value.is_number_unsigned(); }

bool isAncestor (const Json& value)
{
    return value.is_array() && value.size() == 2 && isIdNumber (value[0]) && isIdNumber (value[1]) && value[1].get<Id>() < static_cast<Id> (most_instances);
}

bool isEntry (const Json& value)
{
    if (! value.is_array()) return isIdNumber (value);
    return value.size() > 1 && isIdNumber (value[0]) && std::all_of (value.begin() + 1, value.end(), isAncestor);
}
}   // namespace

Json idsOf (const Graph& graph)
{
    auto all = Json::array();
    forEach (graph, [&] (const auto& thing) {
        if (thing.origin.empty())
        {
            all.push_back (thing.id);
            return;
        }
        auto& entry = all.emplace_back (Json::array ({ thing.id }));
        for (const auto& [id, instance] : thing.origin)
            entry.push_back (Json::array ({ id, static_cast<Id> (instance) }));
    });
    return all;
}

bool giveIds (Graph& graph, const Json& ids)
{
    if (! ids.is_array() || ! std::ranges::all_of (ids, isEntry)) return false;
    std::size_t count = 0;
    forEach (graph, [&] (const auto&) { ++count; });
    if (count != ids.size()) return false;

    auto next = ids.begin();
    forEach (graph, [&] (auto& thing) {
        const auto& entry = *next++;
        thing.origin.clear();
        thing.id = entry.is_array() ? entry[0].get<Id>() : entry.get<Id>();
        for (std::size_t i = 1; entry.is_array() && i < entry.size(); ++i)
            thing.origin.push_back ({ entry[i][0].get<Id>(), entry[i][1].get<int>() });
    });
    return true;
}

}   // namespace tactus::graph
