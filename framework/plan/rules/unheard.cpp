// SPDX-License-Identifier: MIT
#include "unheard.hpp"
#include <tactus/plan/flat/grouped.hpp>

#include <tactus/graph/instances.hpp>
#include <tactus/kit/at.hpp>
#include <tactus/text/json_text.hpp>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace tactus::plan
{

namespace
{
using graph::Graph;
using graph::Patch;

constexpr int deepest = 32;

/// The patch inside a subgraph node, and the graph that it is in; null if there is none.
std::pair<const Graph*, const Patch*> insideOf (const Graph& g, const std::string& type)
{
    if (type.starts_with ("graph:")) return { &g, g.find (std::string_view (type).substr (6)) };
    const auto file = g.files.find (type.substr (5));
    return file == g.files.end() ? std::pair<const Graph*, const Patch*> {} : std::pair { file->second.get(), &file->second->root };
}

/// Finds the ends of patches: nodes that drive a device, or may do so.
class Ends
{
public:
    Ends (const Graph& g, const Catalogue& c) : graph (g), types (c)
    {
        const auto note = [this] (std::string_view path) {
            if (const auto slash = path.rfind ('/'); slash != path.npos) named_inside.insert (graph::firstStep (path.substr (slash + 1)).name);
        };
        const auto collect = [&] (const Patch& patch) {
            for (const auto& w : patch.wires)
                note (w.from.node);
            for (const auto& [name, end] : patch.expose.outputs)
                note (end.node);
        };
        collect (g.root);
        for (const auto& [name, patch] : g.graphs)
            collect (patch);
    }

    /// True for a node that drives a device, a subgraph that contains one or that runs several times a tick, which is there to be heard or
    /// recorded, and a node that is unknown.
    bool isEnd (const Graph& g, const graph::Node& n, int depth = 0)
    {
        if (n.extra.contains ("times")) return true;
        if (! n.isSubgraph())
        {
            const auto* type = types.find (n.type);
            return type == nullptr || type->effort != nullptr;
        }
        const auto [owner, patch] = insideOf (g, n.type);
        if (patch == nullptr || depth >= deepest) return true;
        if (const auto known = has_end.find (patch); known != has_end.end()) return known->second;
        has_end[patch] = true;   // what contains itself is an error of its own
        const bool found = std::ranges::any_of (patch->nodes, [&, o = owner] (const auto& node) { return isEnd (*o, node, depth + 1); });
        return has_end[patch] = found;
    }

    void warn (const Patch& patch, const std::string& where, std::span<const std::string> recorded, Messages& messages)
    {
        std::unordered_map<std::string_view, int> number;
        for (std::size_t n = 0; n < patch.nodes.size(); ++n)
            number.emplace (patch.nodes[n].name, static_cast<int> (n));
        const auto numberOf = [&] (std::string_view path) {
            const auto found = number.find (graph::firstStep (path).name);
            return found == number.end() ? -1 : found->second;
        };
        const Grouped<int> before (patch.nodes.size(), [&] (auto visit) {
            for (const auto& w : patch.wires)
                if (const int from = numberOf (w.from.node), to = numberOf (w.to.node); from >= 0 && to >= 0) visit (to, from);
        });

        std::vector<bool> heard (patch.nodes.size(), false), leads_on (patch.nodes.size(), false);
        std::vector<int> open;
        for (std::size_t n = 0; n < patch.nodes.size(); ++n)   // not by its name, which a broken file may give to no node or to two
            if (isEnd (graph, patch.nodes[n]) || (! where.empty() && named_inside.contains (patch.nodes[n].name))) open.push_back (static_cast<int> (n));
        for (const auto& [name, end] : patch.expose.outputs)
            if (const int n = numberOf (end.node); n >= 0) open.push_back (n);
        if (open.empty()) return;
        for (const auto& port : recorded)
            if (const int n = numberOf (std::string_view (port).substr (0, port.find_first_of ("./"))); n >= 0) open.push_back (n);
        spread (std::move (open), before, heard);

        for (std::size_t n = 0; n < patch.nodes.size(); ++n)
            if (! heard[n])
                for (const int m : before[n])
                    leads_on[at (m)] = true;

        // The last nodes of chains, then those of loops, which have no last node.
        for (const bool in_loops : { false, true })
        {
            std::vector<int> last;
            for (std::size_t n = 0; n < patch.nodes.size(); ++n)
                if (! heard[n] && (in_loops || ! leads_on[n]))
                {
                    last.push_back (static_cast<int> (n));
                    messages.push_back (warningAbout (patch.nodes[n], where));
                }
            spread (std::move (last), before, heard);
        }
    }

private:
    const Graph& graph;
    const Catalogue& types;
    std::unordered_map<const Patch*, bool> has_end;
    std::unordered_set<std::string_view> named_inside;   ///< names of nodes inside of subgraphs from which wires outside start

    static void spread (std::vector<int> open, const Grouped<int>& before, std::vector<bool>& reached)
    {
        while (! open.empty())
        {
            const int n = open.back();
            open.pop_back();
            if (reached[at (n)]) continue;
            reached[at (n)] = true;
            for (const int m : before[at (n)])
                open.push_back (m);
        }
    }

    static Message warningAbout (const graph::Node& n, const std::string& where)
    {
        return Message::warning ("node/no_effect", where + "/nodes/" + pointerPart (n.name),
                                 "the outputs of '" + n.name + "' (" + n.type + ") reach no device, so it has no effect",
                                 "wire an output towards a device.force or another node that drives a device, expose or record it, or remove the node");
    }
};
}   // namespace

Messages unheardNodes (const Graph& g, const Catalogue& catalogue, std::span<const std::string> recorded)
{
    Messages messages;
    Ends ends { g, catalogue };
    ends.warn (g.root, "", recorded, messages);
    for (const auto& [name, patch] : g.graphs)
        ends.warn (patch, "/graphs/" + pointerPart (name), {}, messages);
    return messages;
}

}   // namespace tactus::plan
