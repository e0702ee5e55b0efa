// SPDX-License-Identifier: MIT
#include "param_edit.hpp"

#include "inside.hpp"
#include "instances.hpp"
#include "text.hpp"

#include <framework/in_quotes.hpp>
#include <framework/refused.hpp>

#include <algorithm>

namespace tactus::graph
{

std::variant<Command, Message> paramEdit (const Graph& graph, std::string_view name, std::optional<Json> value)
{
    auto parsed = parseEndpoint (name);
    if (auto* problem = std::get_if<std::string> (&parsed)) return refused ("param/name", *problem, "name a parameter, as in drag.mu");
    auto& e = std::get<Endpoint> (parsed);
    const auto step = firstStep (e.node);
    const auto* node = graph.root.find (step.name);
    if (node == nullptr) return refused ("edit/unknown_node", "there is no node " + inQuotes (step.name), "name a node of the graph");

    const auto instance = step.instance >= 0 ? "[" + std::to_string (step.instance) + "]/" : "";
    if (! step.rest.empty()) return SetOverride { "", node->name, instance + toText ({ std::string (step.rest), e.port, e.index, e.component }), std::move (value) };
    if (instance.empty())
    {
        if (e.index >= 0 || e.component >= 0) return refused ("param/shape", inQuotes (name) + " is a part of what is kept as a whole", "give all of " + node->name + "." + e.port);
        return SetParam { "", node->name, e.port, std::move (value) };
    }

    const auto* inside = insideOf (graph, *node).patch;
    const auto shown = inside != nullptr ? std::ranges::find (inside->expose.params, e.port, &std::pair<std::string, Endpoint>::first) : std::vector<std::pair<std::string, Endpoint>>::const_iterator {};
    if (inside == nullptr || shown == inside->expose.params.end()) return refused ("param/unknown", inQuotes (step.name) + " shows no parameter " + inQuotes (e.port), "name one inside, as in " + e.node + "/drag.mu");
    auto end = shown->second;
    if (e.index >= 0) end.index = e.index;
    if (e.component >= 0) end.component = e.component;
    return SetOverride { "", node->name, instance + toText (end), std::move (value) };
}

}   // namespace tactus::graph
