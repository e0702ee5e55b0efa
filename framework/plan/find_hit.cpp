// SPDX-License-Identifier: MIT
#include "find_hit.hpp"
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
/// Those inputs of a type that take hits.
std::vector<std::string> hitsOf (const NodeType& type)
{
    std::vector<std::string> names;
    for (const auto& row : type.inputs)
        if (takesHits (row)) names.emplace_back (row.id);
    return names;
}

Message unknownNode (const Plan& plan, const std::string& node)
{
    std::vector<std::string> names, struck;
    for (const auto& n : plan.flat.nodes)
    {
        names.push_back (n.path);
        for (const auto& input : hitsOf (*n.type))
            struck.push_back (n.path + "." + input);
    }
    return refused ("port/unknown_node", "there is no node " + inQuotes (node) + didYouMean (node, names), "what takes hits here: " + listed (struck));
}
}   // namespace

std::variant<std::vector<HitRef>, Message> findHits (const Plan& plan, std::string_view name)
{
    const auto parsed = graph::parseEndpoint (name);
    if (const auto* problem = std::get_if<std::string> (&parsed)) return refused ("hit/name", *problem, "name an input that takes hits, as in ring.hit");
    const auto& e = std::get<graph::Endpoint> (parsed);

    std::vector<HitRef> found;
    bool is_there = false;
    const auto add = [&] (std::size_t i, std::string_view port)
    {
        const auto inputs = hitsOf (*plan.flat.nodes[i].type);
        const auto input = std::ranges::find (inputs, port);
        if (input == inputs.end()) return;
        is_there = true;
        if (plan.instances[i].is_struck) found.push_back ({ plan.instances[i].knobs, static_cast<std::size_t> (input - inputs.begin()) });
    };

    const auto shown_as = e.node + "." + e.port;
    for (const auto& [text, ports] : plan.shown)
        if (graph::covers (shown_as, text) == text.size())
            for (const auto& port : ports)
                if (port.role == Role::input) add (static_cast<std::size_t> (port.node), plan.flat.sheet (port).id);

    const FlatNode* node = nullptr;
    if (! is_there)
        for (std::size_t i = 0; i < plan.flat.nodes.size(); ++i)
        {
            const auto& n = plan.flat.nodes[i];
            if (graph::covers (e.node, n.path) != n.path.size()) continue;
            node = &n;
            if (e.index < 0 && e.component < 0) add (i, e.port);
        }
    if (! found.empty()) return found;
    if (node == nullptr && ! is_there) return unknownNode (plan, e.node);
    if (is_there) return refused ("hit/not_running", inQuotes (e.node) + " does not run, so that nobody hears a hit", "end its bypass, or that of what it is in");
    return refused ("hit/unknown", inQuotes (e.node) + " (" + std::string (node->type->info.id) + ") has no input " + inQuotes (e.port) + " for hits" + didYouMean (e.port, hitsOf (*node->type)), "it has: " + listed (hitsOf (*node->type)));
}

std::string nameOfHit (const Plan& plan, std::size_t instance, std::size_t input)
{
    const auto& node = plan.flat.nodes[instance];
    return node.path + "." + hitsOf (*node.type)[input];
}

}   // namespace tactus::plan
