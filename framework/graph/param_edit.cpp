// SPDX-License-Identifier: MIT
#include "param_edit.hpp"

#include "endpoint_text.hpp"
#include "inside.hpp"
#include "instances.hpp"

#include <tactus/text/quote.hpp>

#include <algorithm>

namespace tactus::graph
{

Result<Command> paramEdit (const Graph& graph, std::string_view name, std::optional<Json> value)
{
    const auto parsed = parseEndpoint (name);
    if (! parsed) return Message::error ("param/name", {}, parsed.error().text, "name a parameter, such as drag.mu");
    const auto& e = *parsed;
    const auto step = firstStep (e.node);
    const auto* node = graph.root.find (step.name);
    if (node == nullptr) return Message::error ("edit/unknown_node", {}, "there is no node " + quote (step.name), "name a node of the graph");

    const auto instance = step.instance >= 0 ? "[" + std::to_string (step.instance) + "]/" : "";
    if (! step.rest.empty())
        return SetOverride { "", node->name, instance + toText ({ std::string (step.rest), e.port, e.index, e.component }), std::move (value) };
    if (instance.empty())
    {
        if (e.index >= 0 || e.component >= 0)
            return Message::error ("param/shape", {}, quote (name) + " is part of a value that is stored as a whole",
                                   "set all of " + node->name + "." + e.port);
        return SetParam { "", node->name, e.port, std::move (value) };
    }

    const auto* inside = insideOf (graph, *node).patch;
    const std::vector<std::pair<std::string, Endpoint>> none;
    const auto& exposed = inside != nullptr ? inside->expose.params : none;
    const auto param = std::ranges::find (exposed, e.port, &std::pair<std::string, Endpoint>::first);
    if (param == exposed.end())
        return Message::error ("param/unknown", {}, quote (step.name) + " exposes no parameter " + quote (e.port),
                               "name an inner parameter, such as " + e.node + "/drag.mu");
    auto end = param->second;
    if (e.index >= 0) end.index = e.index;
    if (e.component >= 0) end.component = e.component;
    return SetOverride { "", node->name, instance + toText (end), std::move (value) };
}

}   // namespace tactus::graph
