// SPDX-License-Identifier: MIT
#include "find_hit.hpp"
#include <tactus/plan/flat/directory.hpp>

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/instances.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/quote.hpp>

namespace tactus::plan
{

namespace
{
/// The hit inputs of a type.
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
    for (const auto& n : plan.flat().nodes)
    {
        names.push_back (n.path);
        for (const auto& input : hitsOf (*n.type))
            struck.push_back (n.path + "." + input);
    }
    return Message::error ("port/unknown_node", {}, "there is no node " + quote (node) + didYouMean (node, names), "hit inputs here: " + listed (struck));
}
}   // namespace

Result<std::vector<HitRef>> findHits (const Plan& plan, std::string_view name)
{
    const auto parsed = graph::parseEndpoint (name);
    if (! parsed) return Message::error ("hit/name", {}, parsed.error().text, "name a hit input, such as ring.hit");
    const auto& e = *parsed;
    const auto& flat = plan.flat();

    std::vector<HitRef> found;
    bool exists = false;
    const auto add = [&] (std::size_t i, std::string_view port) {
        const auto inputs = hitsOf (*flat.nodes[i].type);
        const auto input = std::ranges::find (inputs, port);
        if (input == inputs.end()) return;
        exists = true;
        const auto& instance = plan.instances()[i];
        if (instance.is_struck) found.push_back ({ instance.knobs, at (input - inputs.begin()) });
    };

    const auto exposed_as = e.node + "." + e.port;
    for (const auto& [text, ports] : plan.exposed())
        if (graph::covers (exposed_as, text) == text.size())
            for (const auto& port : ports)
                if (port.role == Role::input) add (at (port.node), flat.sheet (port).id);

    const FlatNode* node = nullptr;
    if (! exists)
        for (std::size_t i = 0; i < flat.nodes.size(); ++i)
        {
            const auto& n = flat.nodes[i];
            if (graph::covers (e.node, n.path) != n.path.size()) continue;
            node = &n;
            if (e.index < 0 && e.component < 0) add (i, e.port);
        }
    if (! found.empty()) return found;
    if (node == nullptr && ! exists) return unknownNode (plan, e.node);
    if (exists)
        return Message::error ("hit/not_running", {}, quote (e.node) + " does not run, so a hit has no effect",
                               "turn off its bypass, or that of the subgraph that contains it");
    const auto inputs = hitsOf (*node->type);
    return Message::error ("hit/unknown", {},
                           quote (e.node) + " (" + std::string (node->type->info.id) + ") has no hit input " + quote (e.port) + didYouMean (e.port, inputs),
                           "it has: " + listed (inputs));
}

std::string nameOfHit (const Plan& plan, std::size_t instance, std::size_t input)
{
    const auto& node = plan.flat().nodes[instance];
    return node.path + "." + hitsOf (*node.type)[input];
}

}   // namespace tactus::plan
