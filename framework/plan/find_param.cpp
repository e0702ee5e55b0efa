// SPDX-License-Identifier: MIT
#include "find_param.hpp"
#include "directory.hpp"

#include <framework/graph/text.hpp>
#include <framework/in_quotes.hpp>
#include <framework/near_miss.hpp>

namespace tactus::plan
{

namespace
{
Message refused (std::string id, std::string text, std::string remedy)
{
    Message m;
    m.id = std::move (id);
    m.text = std::move (text);
    m.remedy = std::move (remedy);
    return m;
}

std::variant<PortRef, Message> findPort (const Flat& flat, const graph::Endpoint& e)
{
    const auto node = std::ranges::find (flat.nodes, e.node, &FlatNode::path);
    if (node == flat.nodes.end())
    {
        std::vector<std::string> names;
        for (const auto& n : flat.nodes)
            names.push_back (n.path);
        return refused ("port/unknown_node", "there is no node " + inQuotes (e.node) + didYouMean (e.node, names), "nodes here: " + listed (names));
    }
    const auto& rows = node->type->params;
    const auto row = std::ranges::find (rows, e.port, &PortSheet::id);
    if (node->type->make == nullptr || row == rows.end())
    {
        std::vector<std::string> names;
        for (const auto& r : rows)
            names.emplace_back (r.id);
        return refused ("param/unknown", inQuotes (e.node) + " (" + std::string (node->type->info.id) + ") has no parameter " + inQuotes (e.port) + didYouMean (e.port, names), "it has: " + listed (names));
    }
    return PortRef { static_cast<int> (node - flat.nodes.begin()), Role::param, static_cast<int> (row - rows.begin()) };
}
}   // namespace

std::variant<ParamRef, Message> findParam (const Plan& plan, std::string_view name)
{
    const auto parsed = graph::parseEndpoint (name);
    if (const auto* problem = std::get_if<std::string> (&parsed)) return refused ("param/name", *problem, "name a parameter, as in drag.mu");
    const auto& e = std::get<graph::Endpoint> (parsed);

    PortRef port;
    if (const auto shown = plan.shown.find (e.node + "." + e.port); shown != plan.shown.end())
        port = shown->second;
    else
    {
        auto found = findPort (plan.flat, e);
        if (auto* message = std::get_if<Message> (&found)) return std::move (*message);
        port = std::get<PortRef> (found);
    }
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

}   // namespace tactus::plan
