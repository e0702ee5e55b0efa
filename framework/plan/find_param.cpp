// SPDX-License-Identifier: MIT
#include "find_param.hpp"
#include "directory.hpp"

#include <framework/graph/instances.hpp>
#include <framework/graph/text.hpp>
#include <framework/in_quotes.hpp>
#include <framework/near_miss.hpp>
#include <framework/refused.hpp>

namespace tactus::plan
{

namespace
{
bool isCovered (std::string_view path, std::string_view by) { return graph::covers (by, path) == path.size(); }

std::variant<Ports, Message> findPorts (const Flat& flat, const graph::Endpoint& e)
{
    Ports found;
    const FlatNode* node = nullptr;
    for (std::size_t i = 0; i < flat.nodes.size(); ++i)
    {
        if (! isCovered (flat.nodes[i].path, e.node)) continue;
        node = &flat.nodes[i];
        const auto row = std::ranges::find (node->type->params, e.port, &PortSheet::id);
        if (node->type->make != nullptr && row != node->type->params.end()) found.push_back ({ static_cast<int> (i), Role::param, static_cast<int> (row - node->type->params.begin()) });
    }
    if (node == nullptr)
    {
        std::vector<std::string> names;
        for (const auto& n : flat.nodes)
            names.push_back (n.path);
        return refused ("port/unknown_node", "there is no node " + inQuotes (e.node) + didYouMean (e.node, names), "nodes here: " + listed (names));
    }
    if (found.empty())
    {
        std::vector<std::string> names;
        for (const auto& r : node->type->params)
            names.emplace_back (r.id);
        return refused ("param/unknown", inQuotes (e.node) + " (" + std::string (node->type->info.id) + ") has no parameter " + inQuotes (e.port) + didYouMean (e.port, names), "it has: " + listed (names));
    }
    return found;
}

/// What subgraphs show under the name.
Ports shownAs (const std::string& name, const Plan& plan)
{
    Ports found;
    for (const auto& [text, ports] : plan.shown)
        if (isCovered (text, name) && ports.front().role == Role::param) found.insert (found.end(), ports.begin(), ports.end());
    return found;
}

std::variant<ParamRef, Message> oneNumber (const Plan& plan, PortRef port, const graph::Endpoint& e, std::string_view name)
{
    if (e.index >= 0 && port.index < 0) port.index = e.index;
    if (e.component >= 0 && port.component < 0) port.component = e.component;

    const auto& sheet = plan.flat.sheet (port);
    const auto size = sheet.list ? plan.flat.node (port).list_size : sheet.width;
    const int component = sheet.list ? port.index : sheet.width > 1 ? port.component
                                                                    : 0;
    const bool fits = (sheet.list || port.index < 0) && (sheet.width > 1 || port.component < 0);
    if (! fits || component < 0 || component >= size)
        return refused ("param/shape", inQuotes (name) + " is not one number", sheet.list ? "name one of its " + std::to_string (size) + " entries, as in " + e.node + "." + e.port + "[0]" : sheet.width > 1 ? "name a component: .x, .y or .z"
                                                                                                                                                                                                              : "it is a plain number: leave out the component and the entry");
    return ParamRef { plan.instances[static_cast<std::size_t> (port.node)].knobs, Knobs::indexOf (*plan.flat.node (port).type, static_cast<std::size_t> (port.port), static_cast<std::size_t> (component)), &sheet };
}
}   // namespace

std::variant<std::vector<ParamRef>, Message> findParams (const Plan& plan, std::string_view name)
{
    const auto parsed = graph::parseEndpoint (name);
    if (const auto* problem = std::get_if<std::string> (&parsed)) return refused ("param/name", *problem, "name a parameter, as in drag.mu");
    const auto& e = std::get<graph::Endpoint> (parsed);

    auto ports = shownAs (e.node + "." + e.port, plan);
    if (ports.empty())
    {
        auto found = findPorts (plan.flat, e);
        if (auto* message = std::get_if<Message> (&found)) return std::move (*message);
        ports = std::move (std::get<Ports> (found));
    }
    std::vector<ParamRef> params;
    for (const auto& port : ports)
    {
        auto one = oneNumber (plan, port, e, name);
        if (auto* message = std::get_if<Message> (&one)) return std::move (*message);
        params.push_back (std::move (std::get<ParamRef> (one)));
    }
    return params;
}

std::string nameOf (const Plan& plan, std::size_t instance, std::size_t knob)
{
    const auto& params = plan.flat.nodes[instance].type->params;
    std::size_t p = 0;
    for (; knob >= Knobs::roomOf (params[p]); ++p)
        knob -= Knobs::roomOf (params[p]);
    const int component = static_cast<int> (knob);
    return plan.flat.nameOf ({ .node = static_cast<int> (instance), .role = Role::param, .port = static_cast<int> (p), .index = params[p].list ? component : -1, .component = ! params[p].list && params[p].width > 1 ? component : -1 });
}

}   // namespace tactus::plan
