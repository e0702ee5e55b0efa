// SPDX-License-Identifier: MIT
#include "find_param.hpp"
#include <tactus/plan/flat/directory.hpp>

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/instances.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/quote.hpp>

namespace tactus::plan
{

namespace
{
bool isCovered (std::string_view path, std::string_view by) { return graph::covers (by, path) == path.size(); }

Result<Ports> findPorts (const Flat& flat, const graph::Endpoint& e)
{
    Ports found;
    const FlatNode* node = nullptr;
    for (std::size_t i = 0; i < flat.nodes.size(); ++i)
    {
        if (! isCovered (flat.nodes[i].path, e.node)) continue;
        node = &flat.nodes[i];
        const auto row = std::ranges::find (node->type->params, e.port, &PortSheet::id);
        if (node->type->make != nullptr && row != node->type->params.end())
            found.push_back ({ static_cast<int> (i), Role::param, static_cast<int> (row - node->type->params.begin()) });
    }
    if (node == nullptr)
    {
        std::vector<std::string> names;
        for (const auto& n : flat.nodes)
            names.push_back (n.path);
        return Message::error ("port/unknown_node", {}, "there is no node " + quote (e.node) + didYouMean (e.node, names), "nodes here: " + listed (names));
    }
    if (found.empty())
    {
        std::vector<std::string> names;
        for (const auto& r : node->type->params)
            names.emplace_back (r.id);
        return Message::error ("param/unknown", {},
                               quote (e.node) + " (" + std::string (node->type->info.id) + ") has no parameter " + quote (e.port) + didYouMean (e.port, names),
                               "it has: " + listed (names));
    }
    return found;
}

/// The params that subgraphs expose under this name.
Ports exposedAs (const std::string& name, const Plan& plan)
{
    Ports found;
    for (const auto& [text, ports] : plan.exposed())
        if (isCovered (text, name) && ports.front().role == Role::param) found.insert (found.end(), ports.begin(), ports.end());
    return found;
}

/// Narrows a port to the one number that the name refers to.
Result<ParamRef> oneNumber (const Plan& plan, PortRef port, const graph::Endpoint& e, std::string_view name)
{
    if (e.index >= 0 && port.index < 0) port.index = e.index;
    if (e.component >= 0 && port.component < 0) port.component = e.component;

    const auto& node = plan.flat().node (port);
    const auto& sheet = plan.flat().sheet (port);
    const bool vector = sheet.width > 1;
    const int size = sheet.list ? node.list_size : sheet.width;
    int component = vector ? port.component : 0;
    if (sheet.list) component = port.index;
    const bool fits = (sheet.list || port.index < 0) && (vector || port.component < 0);
    if (! fits || component < 0 || component >= size)
    {
        std::string remedy = vector ? "name a component: .x, .y or .z" : "it is a plain number: leave out the component and the entry";
        if (sheet.list) remedy = "name one of its " + std::to_string (size) + " entries, as in " + e.node + "." + e.port + "[0]";
        return Message::error ("param/shape", {}, quote (name) + " does not name a single number", std::move (remedy));
    }
    return ParamRef { plan.instances()[at (port.node)].knobs, Knobs::indexOf (*node.type, at (port.port), at (component)), &sheet };
}
}   // namespace

Result<std::vector<ParamRef>> findParams (const Plan& plan, std::string_view name)
{
    const auto parsed = graph::parseEndpoint (name);
    if (! parsed) return Message::error ("param/name", {}, parsed.error().text, "name a parameter, such as drag.mu");
    const auto& e = *parsed;

    auto ports = exposedAs (e.node + "." + e.port, plan);
    if (ports.empty())
    {
        auto found = findPorts (plan.flat(), e);
        if (! found) return std::move (found).error();
        ports = *std::move (found);
    }
    std::vector<ParamRef> params;
    for (const auto& port : ports)
    {
        auto one = oneNumber (plan, port, e, name);
        if (! one) return std::move (one).error();
        params.push_back (*std::move (one));
    }
    return params;
}

std::string nameOf (const Flat& flat, std::size_t instance, std::size_t knob)
{
    const auto& params = flat.nodes[instance].type->params;
    std::size_t p = 0;
    for (; knob >= Knobs::roomOf (params[p]); ++p)
        knob -= Knobs::roomOf (params[p]);
    const int component = static_cast<int> (knob);
    PortRef port { .node = static_cast<int> (instance), .role = Role::param, .port = static_cast<int> (p) };
    if (params[p].list)
        port.index = component;
    else if (params[p].width > 1)
        port.component = component;
    return flat.nameOf (port);
}

}   // namespace tactus::plan
