// SPDX-License-Identifier: GPL-3.0-or-later
// Which patch the canvas shows: the subgraphs entered, and their instances.
#include "canvas.hpp"

#include <host/app/model/patch.hpp>
#include <tactus/graph/instances.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host
{

namespace
{
bool leadsTo (const graph::Node& node, const std::string& subgraph) { return node.type == "graph:" + subgraph; }

/// The subgraph nodes on the path to a patch. Empty if the patch cannot be reached from the root.
std::optional<Canvas::Breadcrumbs> breadcrumbsTo (const graph::Graph& g, const std::string& patch)
{
    std::vector<Canvas::Breadcrumbs> open { {} };
    std::set<std::string> seen;
    for (std::size_t i = 0; i < open.size(); ++i)
    {
        const auto path = open[i];
        const auto here = path.empty() ? std::string() : path.back().second;
        if (here == patch) return path;
        const auto* in = findPatch (g, here);
        if (in == nullptr || ! seen.insert (here).second) continue;
        for (const auto& n : in->nodes)
            if (n.type.starts_with ("graph:"))
            {
                open.push_back (path);
                open.back().emplace_back (n.name, n.type.substr (6));
            }
    }
    return std::nullopt;
}
}   // namespace

/// Follows renamed nodes and subgraphs after an edit, and cuts the path before the first node that no longer exists.
void Canvas::updateBreadcrumbs()
{
    const auto& g = document.graph();
    const auto* in = &g.root;
    for (std::size_t i = 0; i < entered.size(); ++i)
    {
        auto& [name, subgraph] = entered[i];
        const auto* node = in->find (name);
        if (node != nullptr && node->type.starts_with ("graph:") && g.find (subgraph) == nullptr) subgraph = node->type.substr (6);
        if (node == nullptr || ! leadsTo (*node, subgraph))
        {
            const auto other = std::ranges::find_if (in->nodes, [&to = subgraph] (const graph::Node& n) { return leadsTo (n, to); });
            if (other == in->nodes.end()) return entered.resize (i);
            name = other->name;
        }
        in = g.find (subgraph);
        if (in == nullptr) return entered.resize (i);
    }
}

std::string Canvas::address (const std::string& port) const
{
    std::string path, names;
    const auto* in = &document.graph().root;
    for (const auto& [name, subgraph] : entered)
    {
        const auto* node = in == nullptr ? nullptr : in->find (name);
        path += name;
        names += name + '/';
        if (const auto chosen = node == nullptr ? std::nullopt : instanceOf (*node, names)) path += '[' + std::to_string (chosen->number) + ']';
        path += '/';
        in = document.graph().find (subgraph);
    }
    return path + port;
}

std::optional<Canvas::Instance> Canvas::instanceOf (const graph::Node& node, const std::string& names) const
{
    const auto count = graph::countOf (node);
    if (! count || *count < 1) return {};
    const auto chosen = chosen_instances.find (names);
    return Instance { chosen == chosen_instances.end() ? 0 : std::clamp (chosen->second, 0, *count - 1), *count };
}

std::optional<Canvas::Instance> Canvas::instance() const
{
    std::string names;
    const auto* in = &document.graph().root;
    const graph::Node* node = nullptr;
    for (const auto& [name, subgraph] : entered)
    {
        node = in == nullptr ? nullptr : in->find (name);
        names += name + '/';
        in = document.graph().find (subgraph);
    }
    return node == nullptr ? std::nullopt : instanceOf (*node, names);
}

SeenPatch Canvas::seen() const
{
    SeenPatch now (patch());
    for (const auto& [name, subgraph] : entered)
        now.path += name + '/';
    return now;
}

void Canvas::chooseInstance (int number)
{
    chosen_instances[seen().path] = number;
    point ({});
    if (onBreadcrumbs) onBreadcrumbs();
}

void Canvas::breadcrumbsChanged()
{
    highlights = {};
    point ({});
    closeEditor (false);
    rebuild();
    frameStart();   // repaints
    if (onBreadcrumbs) onBreadcrumbs();
    if (onSelection) onSelection();
}

void Canvas::leaveTo (std::size_t depth)
{
    if (depth >= entered.size()) return;
    const auto left = entered[depth].first;
    entered.resize (depth);
    breadcrumbsChanged();
    for (const auto& n : shown->nodes())
        if (n.name == left) select ({ n.id });
}

void Canvas::enter (const SceneNode& node)
{
    if (! node.type.starts_with ("graph:") || document.graph().find (node.type.substr (6)) == nullptr) return;
    entered.emplace_back (node.name, node.type.substr (6));
    breadcrumbsChanged();
}

void Canvas::show (const std::string& patch_name, graph::Id id)
{
    if (patch() != patch_name)
    {
        const auto path = breadcrumbsTo (document.graph(), patch_name);
        if (! path) return;
        entered = *path;
        breadcrumbsChanged();
    }
    if (id == 0) return;
    select ({ id });
    auto at = window.toCanvas (getLocalBounds().getCentre().toFloat());
    if (const auto* node = shown->find (id)) at = node->bounds().getCentre();
    if (const auto* wire = shown->findWire (id)) at = (wire->from + wire->to) / 2.0f;
    if (! getLocalBounds().toFloat().contains (window.toPixels (at))) window.centreOn (at, getLocalBounds().toFloat());
    repaint();
}

}   // namespace tactus::host
