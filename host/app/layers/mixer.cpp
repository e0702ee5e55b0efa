// SPDX-License-Identifier: GPL-3.0-or-later
#include "mixer.hpp"
#include "mixer_parts.hpp"

#include <host/app/model/face.hpp>
#include <host/app/model/patch.hpp>
#include <host/app/storage/snapshots.hpp>
#include <host/app/text/filled.hpp>

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/endpoints.hpp>

#include <algorithm>
#include <memory>
#include <numeric>
#include <set>

namespace tactus::host
{

namespace
{
constexpr int removed = 1'000'000;   // a list index that cannot exist: marks what is removed

/// Finds the mixers of a patch and of the subgraphs in it. Looks into each subgraph only once: its instances have the same mixers, and a broken graph
/// may contain itself.
void collect (const graph::Graph& g, const std::string& patch, const std::string& path, std::set<std::string>& seen, std::vector<MixerPlace>& found,
              int depth = 0)
{
    const auto* in = findPatch (g, patch);
    if (in == nullptr || depth > deepest_subgraph || ! seen.insert (patch).second) return;
    for (const auto& n : in->nodes)
    {
        if (mixing::isMixer (n.type)) found.push_back ({ n.id, patch, n.name, path + n.name, n.type == mixing::vector_mixer });
        if (n.type.starts_with ("graph:")) collect (g, n.type.substr (6), path + n.name + '/', seen, found, depth + 1);
    }
}

const PortSheet* listSheet (const Catalogue& c, const std::string& param)
{
    const auto* type = c.find (mixing::number_mixer);   // the params of both types are the same
    if (type == nullptr) return nullptr;
    const auto at = std::ranges::find (type->params, param, &PortSheet::id);
    return at == type->params.end() ? nullptr : &*at;
}

std::string trimmed (std::string s)
{
    s.erase (0, s.find_first_not_of (" \t"));
    s.erase (s.find_last_not_of (" \t") + 1);
    return s;
}

bool isRemoved (const graph::Endpoint& e) { return e.index == removed; }

/// Moves the params and names of the layers to their new positions.
void permuteValues (graph::Node& node, const Catalogue& catalogue, const std::vector<int>& to, int layers)
{
    const auto moved = [&] (const Json& before, const Json& initial) {
        auto list = Json::array();
        for (int i = 0; i < layers; ++i)
            list.push_back (initial);
        for (std::size_t i = 0; i < before.size() && i < to.size(); ++i)
            if (to[i] >= 0) list[static_cast<std::size_t> (to[i])] = before[i];
        return list;
    };
    for (auto& [key, value] : node.params.asObject())
        if (const auto* sheet = listSheet (catalogue, key); sheet != nullptr && sheet->list && value.is_array()) value = moved (value, sheet->initial[0]);
    const auto names = layerNames (node, static_cast<int> (to.size()));
    std::vector<std::string> renamed (static_cast<std::size_t> (layers));
    for (std::size_t i = 0; i < names.size(); ++i)
        if (to[i] >= 0) renamed[static_cast<std::size_t> (to[i])] = names[i];
    if (node.settings.contains ("names")) node.settings["names"] = mixing::joined (renamed);
    node.settings["inputs"] = layers;
}

/// Removes all wires, overrides and control targets of removed layers.
void sweep (graph::Graph& g)
{
    const auto index = '[' + std::to_string (removed) + ']';
    const auto sweepPatch = [&] (graph::Patch& p) {
        std::erase_if (p.wires, [] (const graph::Wire& w) { return isRemoved (w.from) || isRemoved (w.to); });
        for (auto& n : p.nodes)
        {
            auto left = Json::object();
            for (const auto& [key, value] : n.overrides.items())
                if (key.find (index) == std::string::npos) left[key] = value;
            n.overrides = std::move (left);
        }
    };
    sweepPatch (g.root);
    for (auto& [id, p] : g.graphs)
        sweepPatch (p);
    for (auto& c : g.controls)
        std::erase_if (c.to, [] (const graph::Control::Target& t) {
            const auto e = graph::parseEndpoint (t.path);
            return e && isRemoved (*e);
        });
}

/// Moves the layers of a mixer, with all that belongs to them: `to` is the new position of each layer, or -1 to remove it. If this fails, the graph is of
/// no use.
Result<> permute (graph::Graph& g, const MixerPlace& at, const Catalogue& catalogue, const std::vector<int>& to, int layers)
{
    auto* patch = at.patch.empty() ? &g.root : const_cast<graph::Patch*> (std::as_const (g).find (at.patch));
    permuteValues (*std::ranges::find (patch->nodes, at.id, &graph::Node::id), catalogue, to, layers);
    graph::forEachEndpoint (g, [&] (graph::Endpoint& e, const graph::Waypoint& w) {
        if (w.patch == patch && w.name == at.node && w.end == e.node.size() && e.index >= 0 && e.index < static_cast<int> (to.size()))
            if (const int i = to[static_cast<std::size_t> (e.index)]; i != e.index) e.index = i < 0 ? removed : i;
        return true;
    });

    for (const auto* shown : { &patch->expose.inputs, &patch->expose.params, &patch->expose.outputs })
        for (const auto& [port, e] : *shown)
            if (isRemoved (e))
                return Message::error ("mixer/exposed", {}, filled (TRANS ("the subgraph exposes this layer as its port '%1'"), port).toStdString(),
                                       TRANS ("hide that port first").toStdString());
    sweep (g);
    return {};
}

/// An edit of the whole mixer, and of what the snapshots hold of it.
Result<graph::Command> permuted (const graph::Graph& g, const MixerPlace& at, const Catalogue& catalogue, const std::vector<int>& to, int layers,
                                 const std::string& name)
{
    const auto after = std::make_shared<graph::Graph> (g);
    if (auto done = permute (*after, at, catalogue, to, layers); ! done) return std::move (done).error();
    auto snapshots = snapshotsAfter (g, [&] (const graph::Graph& held) {
        const auto moved = std::make_shared<graph::Graph> (held);
        (void)permute (*moved, at, catalogue, to, layers);   // possible, as above
        return graph::Command (graph::ReplaceGraph { moved });
    });
    if (snapshots.is_object()) after->extra["ui"]["snapshots"] = std::move (snapshots);
    return graph::Command (graph::Batch { name, { graph::ReplaceGraph { after } } });
}

}   // namespace

std::vector<MixerPlace> mixersOf (const graph::Graph& g)
{
    std::vector<MixerPlace> found;
    std::set<std::string> seen;
    collect (g, {}, {}, seen, found);
    return found;
}

const graph::Node* findMixer (const graph::Graph& g, const MixerPlace& at)
{
    const auto* patch = findPatch (g, at.patch);
    const auto* node = patch == nullptr ? nullptr : patch->find (at.node);
    return node != nullptr && node->id == at.id ? node : nullptr;
}

int layersOf (const graph::Node& node, const Catalogue& catalogue)
{
    const auto* type = catalogue.find (node.type);
    if (type == nullptr) return 0;
    const auto sheet = std::ranges::find (type->settings, std::string_view ("inputs"), &SettingSheet::id);
    const auto given = node.settings.find ("inputs");
    const double n = given != node.settings.end() && given->is_number() ? given->get<double>() : std::get<double> (sheet->initial);
    return static_cast<int> (std::clamp (n, 1.0, static_cast<double> (list_capacity)));
}

const PortSheet& mixerSheet (const Catalogue& catalogue, std::string_view param)
{
    const auto& params = catalogue.find (mixing::number_mixer)->params;   // the params of both types are the same
    return *std::ranges::find (params, param, &PortSheet::id);
}

std::vector<std::string> layerNames (const graph::Node& node, int layers)
{
    std::vector<std::string> names (static_cast<std::size_t> (layers));
    const auto given = node.settings.find ("names");
    if (given == node.settings.end() || ! given->is_string()) return names;
    const auto text = given->get<std::string>();
    std::size_t from = 0;
    for (auto& n : names)
    {
        const auto comma = std::min (text.find (',', from), text.size());
        n = trimmed (text.substr (from, comma - from));
        if (comma == text.size()) break;
        from = comma + 1;
    }
    return names;
}

Json layerValue (const graph::Node& node, const Catalogue& catalogue, const std::string& param, int layer)
{
    const auto own = node.params.find (param);
    if (own != node.params.end() && own->is_array() && static_cast<std::size_t> (layer) < own->size()) return (*own)[static_cast<std::size_t> (layer)];
    const auto* sheet = listSheet (catalogue, param);
    return sheet == nullptr ? Json (0.0) : Json (sheet->initial[0]);
}

const graph::Wire* wireInto (const graph::Graph& g, const MixerPlace& at, int layer)
{
    if (const auto* patch = findPatch (g, at.patch))
        for (const auto& w : patch->wires)
            if (w.to.node == at.node && w.to.port == "in" && w.to.index == layer) return &w;
    return nullptr;
}

std::string_view unitOfLayer (const graph::Graph& g, const MixerPlace& at, const Catalogue& catalogue, int layer)
{
    if (at.vectors) return unit::newton.symbol;
    const auto* patch = findPatch (g, at.patch);
    const auto* w = wireInto (g, at, layer);
    const auto* from = w == nullptr ? nullptr : patch->find (graph::firstNameOf (w->from.node));
    if (from == nullptr) return {};
    const auto face = faceOf (g, *patch, *from, catalogue);
    const auto* port = face.startOf (w->from);
    return port != nullptr && port->quantity() != Quantity::any ? port->unit.unit.symbol : std::string_view();
}

graph::Command setLayerValue (const graph::Node& node, const MixerPlace& at, const Catalogue& catalogue, const std::string& param, int layer,
                              const std::optional<Json>& value)
{
    const auto* sheet = listSheet (catalogue, param);
    const Json initial = sheet == nullptr ? Json (0.0) : Json (sheet->initial[0]);
    auto all = Json::array();
    if (const auto own = node.params.find (param); own != node.params.end() && own->is_array()) all = *own;
    while (all.size() <= static_cast<std::size_t> (layer))
        all.push_back (initial);
    all[static_cast<std::size_t> (layer)] = value.value_or (initial);
    const bool plain = std::ranges::all_of (all, [&] (const Json& v) { return v == initial; });
    return graph::SetParam { at.patch, at.node, param, plain ? std::nullopt : std::optional (all) };
}

graph::Command renameLayer (const graph::Node& node, const MixerPlace& at, int layers, int layer, std::string name)
{
    auto names = layerNames (node, layers);
    std::ranges::replace (name, ',', ' ');
    names[static_cast<std::size_t> (layer)] = trimmed (name);
    std::optional<Json> setting;
    if (auto text = mixing::joined (names); ! text.empty()) setting = std::move (text);
    return graph::Batch { NEEDS_TRANS ("rename a layer"), { graph::SetSetting { at.patch, at.node, "names", std::move (setting) } } };
}

Result<graph::Command> removeLayer (const graph::Graph& g, const MixerPlace& at, const Catalogue& catalogue, int layer)
{
    const auto* mixer = findMixer (g, at);
    if (mixer == nullptr) return mixing::mixerIsGone();
    const int layers = layersOf (*mixer, catalogue);
    if (layers < 2)
        return Message::error ("mixer/last_layer", {}, TRANS ("a mixer needs at least one layer").toStdString(),
                               TRANS ("delete the mixer on the canvas").toStdString());
    std::vector<int> to (static_cast<std::size_t> (layers));
    for (int i = 0; i < layers; ++i)
        to[static_cast<std::size_t> (i)] = i < layer ? i : i - 1;
    to[static_cast<std::size_t> (layer)] = -1;
    return permuted (g, at, catalogue, to, layers - 1, NEEDS_TRANS ("remove a layer"));
}

graph::Command moveLayer (const graph::Graph& g, const MixerPlace& at, const Catalogue& catalogue, int layer, int to)
{
    const int layers = layersOf (*findMixer (g, at), catalogue);
    std::vector<int> order (static_cast<std::size_t> (layers)), places (order.size());
    std::iota (order.begin(), order.end(), 0);
    order.erase (order.begin() + layer);
    order.insert (order.begin() + to, layer);
    for (int i = 0; i < layers; ++i)
        places[static_cast<std::size_t> (order[static_cast<std::size_t> (i)])] = i;
    return permuted (g, at, catalogue, places, layers, NEEDS_TRANS ("move a layer")).value();
}

}   // namespace tactus::host
