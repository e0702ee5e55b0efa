// SPDX-License-Identifier: MIT
#include "reconcile.hpp"
#include "endpoint_text.hpp"

#include <algorithm>
#include <deque>
#include <unordered_map>
#include <unordered_set>

namespace tactus::graph
{

namespace
{
/// Gives new nodes or wires the ids of the old ones with the same key, in order. Sets the matched pointers in both lists to null.
template <typename Thing, typename Key>
void handOn (std::vector<Thing*>& now, std::vector<const Thing*>& before, Key key)
{
    std::unordered_map<std::string, std::deque<const Thing**>> old;
    for (auto& thing : before)
        if (thing) old[key (*thing)].push_back (&thing);
    for (auto*& thing : now)
    {
        if (thing == nullptr) continue;
        const auto alike = old.find (key (*thing));
        if (alike == old.end() || alike->second.empty()) continue;
        thing->id = std::exchange (*alike->second.front(), nullptr)->id;
        alike->second.pop_front();
        thing = nullptr;
    }
}

template <typename Thing, typename... Keys>
void reconcile (std::vector<Thing>& now, const std::vector<Thing>& before, Keys... keys)
{
    std::vector<Thing*> here;
    std::vector<const Thing*> there;
    for (auto& thing : now)
        here.push_back (&thing);
    for (const auto& thing : before)
        there.push_back (&thing);
    (handOn (here, there, keys), ...);
}

void reconcile (Patch& now, const Patch& before)
{
    reconcile (now.nodes, before.nodes, [] (const Node& n) { return n.name + " " + n.type; });
    reconcile (
        now.wires, before.wires, [] (const Wire& w) { return toText (w); },
        [] (Wire w) {
            w.delay = w.delay > 0 ? 1 : 0;
            return toText (w);
        });
}

/// A file that is included in several places is processed once, so the work does not grow with the number of paths to it.
using Done = std::map<std::pair<const Graph*, const Graph*>, std::shared_ptr<const Graph>>;

void reconcile (Graph& now, const Graph& before, Done& done)
{
    reconcile (now.root, before.root);
    for (auto& [name, patch] : now.graphs)
        if (const auto* old = before.find (name)) reconcile (patch, *old);
    for (auto& [path, file] : now.files)
    {
        const auto old = before.files.find (path);
        if (old == before.files.end() || ! file || ! old->second || file == old->second) continue;
        auto& entry = done[{ file.get(), old->second.get() }];
        if (! entry)
        {
            auto copy = std::make_shared<Graph> (*file);
            reconcile (*copy, *old->second, done);
            entry = std::move (copy);
        }
        file = entry;
    }
}
}   // namespace

bool haveNodesInCommon (const Graph& a, const Graph& b)
{
    std::unordered_set<Id> ids;
    for (const auto& node : a.root.nodes)
        ids.insert (node.id);
    return std::ranges::any_of (b.root.nodes, [&] (const Node& node) { return ids.contains (node.id); });
}

void reconcile (Graph& now, const Graph& before)
{
    Done done;
    reconcile (now, before, done);
}

}   // namespace tactus::graph
