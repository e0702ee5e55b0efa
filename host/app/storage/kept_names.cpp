// SPDX-License-Identifier: GPL-3.0-or-later
#include "kept_names.hpp"

#include "snapshots.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace tactus::host
{

namespace
{
bool changesNames (const graph::Command& command)
{
    const auto is = [&]<typename... Edits> (std::variant<Edits...>*) { return (std::holds_alternative<Edits> (command.edit) || ...); };
    if (is ((std::variant<graph::RenameNode, graph::RenameSubgraph, graph::CollapseNodes, graph::ExpandNode>*)nullptr)) return true;
    const auto* batch = std::get_if<graph::Batch> (&command.edit);
    return batch != nullptr && std::ranges::any_of (batch->commands, changesNames);
}

const graph::Patch* inside (const graph::Graph& g, const graph::Node& n)
{
    return n.type.starts_with ("graph:") ? g.find (std::string_view (n.type).substr (6)) : nullptr;
}

/// The nodes along a path such as "finger/skin", as far as they are known.
std::vector<const graph::Node*> nodesAlong (const graph::Graph& g, std::string_view path)
{
    std::vector<const graph::Node*> all;
    const auto* patch = &g.root;
    while (patch != nullptr)
    {
        const auto name = path.substr (0, path.find ('/'));
        const auto* node = patch->find (name);
        if (node == nullptr) break;
        all.push_back (node);
        if (name.size() == path.size()) break;
        path.remove_prefix (name.size() + 1);
        patch = inside (g, *node);
    }
    return all;
}

const graph::Node* findIn (const graph::Patch& patch, const graph::Node& before)
{
    const auto isIt = [&] (const graph::Node& n) { return n.id == before.id || (! n.origin.empty() && n.origin.back().id == before.id); };
    const auto found = std::ranges::find_if (patch.nodes, isIt);
    return found == patch.nodes.end() ? nullptr : &*found;
}

/// The path of the last of these nodes, counted from a patch of the graph after the command: one of them may have got a subgraph around
/// it, or have been replaced by its contents. Empty if the node is not there.
std::optional<std::string> pathOf (const graph::Graph& after, const graph::Patch& patch, const std::vector<const graph::Node*>& along, std::size_t next)
{
    const bool is_last = next + 1 == along.size();
    const auto rest = [&] (const graph::Node& n, std::size_t from) -> std::optional<std::string> {
        const auto* within = inside (after, n);
        auto path = within != nullptr ? pathOf (after, *within, along, from) : std::nullopt;
        if (path) path->insert (0, n.name + "/");
        return path;
    };
    if (const auto* n = findIn (patch, *along[next])) return is_last ? std::optional (n->name) : rest (*n, next + 1);
    if (! is_last && findIn (patch, *along[next + 1]) != nullptr) return pathOf (after, patch, along, next + 1);
    for (const auto& n : patch.nodes)
        if (const auto* within = inside (after, n); within != nullptr && findIn (*within, *along[next]) != nullptr) return rest (n, next);
    return std::nullopt;
}

/// Sources by "path.param", with the paths of the graph after the command.
Json sourcesAfter (const graph::Graph& before, const graph::Graph& after, const Json& sources)
{
    auto renamed = Json::object();
    for (const auto& [key, source] : sources.items())
    {
        const auto path = std::string_view (key).substr (0, key.rfind ('.'));
        const auto along = nodesAlong (before, path);
        const auto to = along.empty() ? std::nullopt : pathOf (after, after.root, along, 0);
        std::size_t known = along.empty() ? 0 : along.size() - 1;   // slashes
        for (const auto* n : along)
            known += n->name.size();
        renamed[to ? *to + key.substr (known) : key] = source;
    }
    return renamed;
}
}   // namespace

graph::Command withNamesKept (const graph::Graph& before, graph::Command command)
{
    if (! changesNames (command) || ! before.extra.contains ("ui")) return command;
    auto after = before;
    if (! graph::apply (after, command) || ! after.extra.contains ("ui")) return command;
    auto ui = after.extra["ui"];
    if (! ui.is_object()) return command;
    if (auto snapshots = snapshotsAfter (before, [&] (const auto&) { return command; }); snapshots.is_object()) ui["snapshots"] = std::move (snapshots);
    if (const auto sources = ui.find ("sources"); sources != ui.end() && sources->is_object()) *sources = sourcesAfter (before, after, *sources);
    if (ui == after.extra["ui"]) return command;

    auto name = graph::nameOf (command);
    return graph::Batch { std::move (name), { std::move (command), graph::SetHeader { .ui = std::move (ui) } } };
}

}   // namespace tactus::host
