// SPDX-License-Identifier: GPL-3.0-or-later
#include "snapshots.hpp"

#include <host/app/text/filled.hpp>

#include <algorithm>
#include <functional>
#include <set>
#include <utility>

namespace tactus::host
{

namespace
{
/// A member of an object. Null if there is no such member, or if it is not an object.
const Json& at (const Json& object, const std::string& key)
{
    static const Json none;
    if (! object.is_object()) return none;
    const auto found = object.find (key);
    return found == object.end() ? none : *found;
}

const Json& snapshot (const graph::Graph& g, int number) { return at (at (at (g.extra, "ui"), "snapshots"), std::to_string (number)); }

Json valuesOf (const graph::Patch& patch)
{
    auto nodes = Json::object();
    for (const auto& n : patch.nodes)
        nodes[n.name] = { { "type", n.type }, { "params", n.params }, { "overrides", n.overrides } };
    return nodes;
}

Json valuesOf (const graph::Graph& g)
{
    auto controls = Json::object();
    for (const auto& c : g.controls)
        controls[c.id] = c.value;
    auto subgraphs = Json::object();
    for (const auto& [name, patch] : g.graphs)
        subgraphs[name] = valuesOf (patch);
    return { { "nodes", valuesOf (g.root) }, { "graphs", std::move (subgraphs) }, { "controls", std::move (controls) } };
}

/// Calls visit (name of the patch, patch) for the root, whose name is empty, and for each subgraph.
void forEachPatch (const graph::Graph& g, const std::function<void (const std::string&, const graph::Patch&)>& visit)
{
    visit ({}, g.root);
    for (const auto& [name, patch] : g.graphs)
        visit (name, patch);
}

const Json& nodesIn (const Json& snapshot, const std::string& patch)
{
    return patch.empty() ? at (snapshot, "nodes") : at (at (snapshot, "graphs"), patch);
}

/// Calls visit (name of the patch, name of the node, values) for each node of a snapshot that the graph does not have, or that has another type there.
void forEachMissing (const graph::Graph& g, const Json& then, const std::function<void (const std::string&, const std::string&, const Json&)>& visit)
{
    const auto look = [&] (const std::string& patch, const Json& nodes, const graph::Patch* in) {
        if (! nodes.is_object()) return;
        for (const auto& [name, values] : nodes.items())
            if (const auto* n = in != nullptr ? in->find (name) : nullptr; n == nullptr || at (values, "type") != n->type) visit (patch, name, values);
    };
    look ({}, at (then, "nodes"), &g.root);
    if (const auto& graphs = at (then, "graphs"); graphs.is_object())
        for (const auto& [patch, nodes] : graphs.items())
            look (patch, nodes, g.find (patch));
}

/// True if recall() would change nothing. The nodes of a snapshot usually have the order of the patch, so most are found without a search.
bool isAt (const graph::Patch& patch, const Json& nodes)
{
    if (! nodes.is_object()) return true;
    auto next = nodes.begin();
    for (const auto& n : patch.nodes)
    {
        if (next == nodes.end() || next.key() != n.name) next = nodes.find (n.name);
        if (next == nodes.end()) continue;
        const auto& then = next.value();
        ++next;
        if (at (then, "type") != n.type) continue;
        const auto isSame = [] (const Json& now, const Json& before) { return ! before.is_object() || now == before; };
        if (! isSame (n.params, at (then, "params")) || ! isSame (n.overrides, at (then, "overrides"))) return false;
    }
    return true;
}

/// Calls change() for each key whose value differs, with the old value and its position.
void differences (const Json& now, const Json& then, const std::function<void (const std::string&, std::optional<Json>, graph::Place)>& change)
{
    for (const auto& [key, value] : now.items())
        if (! then.contains (key)) change (key, std::nullopt, std::nullopt);
    std::size_t place = 0;
    for (const auto& [key, value] : then.items())
    {
        if (at (now, key) != value) change (key, value, place);
        ++place;
    }
}

void recall (const graph::Patch& patch, const std::string& name, const Json& nodes, std::vector<graph::Command>& commands)
{
    for (const auto& n : patch.nodes)
    {
        const auto& then = at (nodes, n.name);
        if (at (then, "type") != n.type) continue;
        const auto restore = [&]<typename Set> (const Json& now, const char* part) {
            const auto set = [&] (const std::string& key, std::optional<Json> value, graph::Place place) {
                Set command { name, n.name, key, std::move (value), place };
                commands.push_back (std::move (command));
            };
            if (at (then, part).is_object()) differences (now, at (then, part), set);
        };
        restore.template operator()<graph::SetParam> (n.params, "params");
        restore.template operator()<graph::SetOverride> (n.overrides, "overrides");
    }
}
}   // namespace

bool hasSnapshot (const graph::Graph& g, int number) { return snapshot (g, number).is_object(); }

graph::Command storeSnapshot (const graph::Graph& g, int number)
{
    Json ui = at (g.extra, "ui");
    if (! ui.is_object()) ui = Json::object();
    auto& all = ui["snapshots"];
    if (! all.is_object()) all = Json::object();
    all[std::to_string (number)] = valuesOf (g);
    return graph::Batch { filled (TRANS ("store snapshot %1"), number).toStdString(), { graph::SetHeader { .ui = std::move (ui) } } };
}

graph::Command clearSnapshot (const graph::Graph& g, int number)
{
    Json ui = at (g.extra, "ui");
    if (hasSnapshot (g, number)) ui["snapshots"].erase (std::to_string (number));
    return graph::Batch { filled (TRANS ("clear snapshot %1"), number).toStdString(), { graph::SetHeader { .ui = std::move (ui) } } };
}

std::optional<graph::Command> recallSnapshot (const graph::Graph& g, int number)
{
    const auto& then = snapshot (g, number);
    graph::Batch batch { filled (TRANS ("snapshot %1"), number).toStdString(), {} };
    recall (g.root, {}, at (then, "nodes"), batch.commands);
    for (const auto& [name, patch] : g.graphs)
        recall (patch, name, at (at (then, "graphs"), name), batch.commands);
    for (const auto& c : g.controls)
        if (const auto& value = at (at (then, "controls"), c.id); value.is_number() && value != c.value)
        {
            auto to = c;
            to.value = std::clamp (value.get<double>(), 0.0, 1.0);
            batch.commands.push_back (graph::ChangeControl { c.id, std::move (to) });
        }
    return batch.commands.empty() ? std::nullopt : std::optional<graph::Command> (std::move (batch));
}

std::vector<std::string> missingNodes (const graph::Graph& g, int number)
{
    std::vector<std::string> missing;
    forEachMissing (g, snapshot (g, number),
                    [&] (const std::string& patch, const std::string& name, const Json&) { missing.push_back (patch.empty() ? name : patch + "/" + name); });
    return missing;
}

std::vector<std::string> laterControls (const graph::Graph& g, int number)
{
    std::vector<std::string> names;
    for (const auto& c : g.controls)
        if (! at (at (snapshot (g, number), "controls"), c.id).is_number()) names.push_back (c.name.empty() ? c.id : c.name);
    return names;
}

Json snapshotsAfter (const graph::Graph& before, const std::function<graph::Command (const graph::Graph&)>& commandFor)
{
    auto all = at (at (before.extra, "ui"), "snapshots");
    for (int number = 1; number <= snapshot_count; ++number)
    {
        if (! hasSnapshot (before, number)) continue;
        const auto& then = snapshot (before, number);
        std::set<graph::Id> others;   // nodes that the snapshot does not hold
        forEachPatch (before, [&] (const std::string& name, const graph::Patch& patch) {
            for (const auto& n : patch.nodes)
                if (at (at (nodesIn (then, name), n.name), "type") != n.type) others.insert (n.id);
        });

        // The command changes the values of the snapshot as it changes those of the graph.
        auto held = before;
        std::erase_if (held.controls, [&] (const graph::Control& c) { return ! at (then, "controls").contains (c.id); });   // it does not hold what they set
        if (const auto recalled = recallSnapshot (before, number); recalled && ! graph::apply (held, *recalled, graph::Checks::none)) continue;
        if (! graph::apply (held, commandFor (held), graph::Checks::none)) continue;
        auto values = valuesOf (held);
        forEachPatch (held, [&] (const std::string& name, const graph::Patch& patch) {
            auto& nodes = name.empty() ? values["nodes"] : values["graphs"][name];
            for (const auto& n : patch.nodes)
                if (others.contains (n.id)) nodes.erase (n.name);
        });
        forEachMissing (before, then, [&] (const std::string& name, const std::string& node, const Json& of_node) {
            auto& nodes = name.empty() ? values["nodes"] : values["graphs"][name];
            const auto* patch = name.empty() ? &held.root : std::as_const (held).find (name);
            const bool is_taken = patch != nullptr && patch->find (node) != nullptr;   // by a node that the snapshot does not hold
            if (! nodes.contains (node) && ! is_taken) nodes[node] = of_node;
        });
        all[std::to_string (number)] = std::move (values);
    }
    return all;
}

bool isAtSnapshot (const graph::Graph& g, int number)
{
    if (! hasSnapshot (g, number)) return false;
    const auto& then = snapshot (g, number);
    const auto isHeld = [&] (const graph::Control& c) {
        const auto& value = at (at (then, "controls"), c.id);
        return ! value.is_number() || value == c.value;
    };
    return std::ranges::all_of (g.controls, isHeld) && isAt (g.root, at (then, "nodes"))
           && std::ranges::all_of (g.graphs, [&] (const auto& named) { return isAt (named.second, at (at (then, "graphs"), named.first)); });
}

}   // namespace tactus::host
