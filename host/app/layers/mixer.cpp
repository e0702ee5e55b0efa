// SPDX-License-Identifier: GPL-3.0-or-later
#include "mixer.hpp"

#include <host/app/model/face.hpp>
#include <host/app/model/fragment.hpp>
#include <tactus/graph/endpoints.hpp>
#include <tactus/graph/text.hpp>

#include <algorithm>
#include <memory>
#include <numeric>
#include <set>

namespace tactus::host
{

namespace
{
constexpr std::string_view mixer_type = "layer.mix", window_type = "contact.window";
constexpr int removed = 1'000'000;   // a list index that cannot exist: marks what is removed
constexpr int deepest = 32;

const graph::Patch* patchOf (const graph::Graph& g, const std::string& name) { return name.empty() ? &g.root : g.find (name); }

void collect (const graph::Graph& g, const std::string& patch, const std::string& path, int depth, std::vector<MixerPlace>& found)
{
    const auto* in = patchOf (g, patch);
    if (in == nullptr || depth > deepest) return;
    for (const auto& n : in->nodes)
    {
        if (n.type == mixer_type && std::ranges::count (found, n.id, &MixerPlace::id) == 0) found.push_back ({ n.id, patch, n.name, path + n.name });
        if (n.type.starts_with ("graph:")) collect (g, n.type.substr (6), path + n.name + '/', depth + 1, found);
    }
}

const PortSheet* listSheet (const Catalogue& c, const std::string& param)
{
    const auto* type = c.find (mixer_type);
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

std::string joined (std::vector<std::string> names)
{
    while (! names.empty() && names.back().empty())
        names.pop_back();
    std::string all;
    for (std::size_t i = 0; i < names.size(); ++i)
        all += (i == 0 ? "" : ", ") + names[i];
    return all;
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
    if (node.settings.contains ("names")) node.settings["names"] = joined (renamed);
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

/// An edit of the whole mixer: `to` is the new position of each layer, or -1 to remove it.
Result<graph::Command> permuted (const graph::Graph& g, const MixerPlace& at, const Catalogue& catalogue, const std::vector<int>& to, int layers,
                                 const std::string& name)
{
    const auto after = std::make_shared<graph::Graph> (g);
    auto* patch = at.patch.empty() ? &after->root : const_cast<graph::Patch*> (std::as_const (*after).find (at.patch));
    permuteValues (*std::ranges::find (patch->nodes, at.id, &graph::Node::id), catalogue, to, layers);
    graph::forEachEndpoint (*after, [&] (graph::Endpoint& e, const graph::Waypoint& w) {
        if (w.patch == patch && w.name == at.node && w.end == e.node.size() && e.index >= 0 && e.index < static_cast<int> (to.size()))
            if (const int i = to[static_cast<std::size_t> (e.index)]; i != e.index) e.index = i < 0 ? removed : i;
        return true;
    });

    for (const auto* shown : { &patch->expose.inputs, &patch->expose.params, &patch->expose.outputs })
        for (const auto& [port, e] : *shown)
            if (isRemoved (e))
                return Message::error ("mixer/exposed", {}, "the subgraph exposes this layer as its port '" + port + "'", "hide that port first");
    sweep (*after);
    return graph::Command (graph::Batch { name, { graph::ReplaceGraph { after } } });
}

/// A node and everything downstream of it.
std::set<std::string> downstreamOf (const graph::Patch& patch, const std::string& node)
{
    std::set<std::string> reached { node };
    for (bool more = true; more;)
    {
        more = false;
        for (const auto& w : patch.wires)
            if (reached.contains (graph::firstNameOf (w.from.node))) more = reached.insert (graph::firstNameOf (w.to.node)).second || more;
    }
    return reached;
}

graph::Endpoint endOf (const std::string& node, std::string_view port, int index = -1, int component = -1)
{
    return { node, std::string (port), index, component };
}

graph::Wire wire (graph::Endpoint from, graph::Endpoint to)
{
    graph::Wire w;
    w.from = std::move (from);
    w.to = std::move (to);
    return w;
}

/// How well an output suits an input: the tool itself is best, then an output of the same name, then the resistance of a surface.
int rankOf (const graph::Node& node, const FacePort& out, const PortSheet& input)
{
    if (node.type == "device.position") return 4;
    if (out.id == input.id) return 3;
    return out.id == "resistance" ? 2 : 1;
}

/// The best source in the patch for an input. Nodes downstream of the mixer are excluded.
std::optional<graph::Endpoint> sourceFor (const PortSheet& input, const graph::Graph& g, const graph::Patch& patch, const std::set<std::string>& excluded,
                                          const Catalogue& catalogue)
{
    const auto fits = [&] (const FacePort& out) {
        const bool is_list = out.id.find ('[') != std::string::npos;
        return ! is_list && out.width == input.width && out.quantity() == input.unit.unit.quantity && out.quantity() != Quantity::any;
    };
    std::optional<graph::Endpoint> found;
    int best = 0;
    for (const auto& n : patch.nodes)
    {
        if (excluded.contains (n.name)) continue;
        const auto face = faceOf (g, patch, n, catalogue);
        for (const auto& out : face.outputs)
            if (const int rank = rankOf (n, out, input); fits (out) && rank > best)
            {
                best = rank;
                found = endOf (n.name, out.id);
            }
    }
    return found;
}

const PortSheet* layerOutput (const NodeType& type)
{
    const auto at = std::ranges::find_if (type.outputs, [] (const PortSheet& o) {
        const bool is_force = o.unit.kind == UnitRule::Kind::fixed && o.unit.unit.quantity == Quantity::force;
        return is_force && o.width == 1 && ! o.list;
    });
    return at == type.outputs.end() ? nullptr : &*at;
}

/// The wires into one endpoint.
struct Stream
{
    graph::Endpoint to;
    std::vector<const graph::Wire*> wires;
};

/// The largest stream of scalar forces into a sink, directly or through a vector.join.
Stream streamInto (const graph::Patch& patch, const graph::Node& sink)
{
    std::vector<Stream> streams;
    const auto add = [&] (const graph::Wire& w) {
        auto at = std::ranges::find (streams, w.to, &Stream::to);
        if (at == streams.end()) at = streams.insert (at, Stream { w.to, {} });
        at->wires.push_back (&w);
    };
    for (const auto& w : patch.wires)
    {
        if (w.to.node != sink.name) continue;
        if (sink.type != "device.force" || w.to.component >= 0) add (w);
        const auto* from = patch.find (w.from.node);
        if (sink.type != "device.force" || w.to.component >= 0 || w.to.port != "force" || from == nullptr || from->type != "vector.join") continue;
        for (const auto& into : patch.wires)
            if (into.to.node == from->name) add (into);
    }
    const auto best = std::ranges::max_element (streams, {}, [] (const Stream& s) { return s.wires.size(); });
    return best == streams.end() ? Stream {} : *best;
}

/// The gain of the contact, 0 while the tool does not touch: of a window that the patch has, or of a new one behind the depth of a surface.
/// Empty if the patch has no depth.
std::optional<graph::Endpoint> touchGain (const graph::Graph& g, const MixerPlace& at, const std::set<std::string>& excluded, const Catalogue& catalogue,
                                          graph::Batch& batch)
{
    const auto& patch = *patchOf (g, at.patch);
    const auto* window = catalogue.find (window_type);
    for (const auto& n : patch.nodes)
        if (n.type == window_type && ! excluded.contains (n.name)) return endOf (n.name, "gain");
    auto depth = window == nullptr ? std::nullopt : sourceFor (window->inputs.front(), g, patch, excluded, catalogue);
    if (! depth || depth->port != "depth") return std::nullopt;
    graph::Node touch;
    touch.name = freeName (patch, {}, "touch");
    touch.type = window_type;
    const auto name = touch.name;
    batch.commands.push_back (graph::AddNode { at.patch, std::move (touch) });
    batch.commands.push_back (graph::AddWire { at.patch, wire (std::move (*depth), endOf (name, "depth")) });
    return endOf (name, "gain");
}

/// Multiplies an output by the gain of the contact. Returns the product, or the output itself if there is no such gain.
graph::Endpoint gated (graph::Endpoint out, const graph::Graph& g, const MixerPlace& at, const std::set<std::string>& excluded, const Catalogue& catalogue,
                       graph::Batch& batch)
{
    auto gain = touchGain (g, at, excluded, catalogue, batch);
    if (! gain) return out;
    graph::Node product;
    product.name = freeName (*patchOf (g, at.patch), {}, out.node + "_felt");
    product.type = "signal.multiply";
    const auto name = product.name;
    batch.commands.push_back (graph::AddNode { at.patch, std::move (product) });
    batch.commands.push_back (graph::AddWire { at.patch, wire (std::move (out), endOf (name, "in", 0)) });
    batch.commands.push_back (graph::AddWire { at.patch, wire (std::move (*gain), endOf (name, "in", 1)) });
    return endOf (name, "out");
}

Message mixerIsGone() { return Message::error ("mixer/gone", {}, "the mixer no longer exists"); }

Message noMotor (const graph::Graph& g)
{
    for (const auto& [subgraph, patch] : g.graphs)
        for (const auto& n : patch.nodes)
            if (n.type == "device.force")
                return Message::error ("mixer/in_subgraph", {}, "the motor of this graph is inside the subgraph " + subgraph,
                                       "enter the subgraph, and add a layer.mix before " + n.name);
    return Message::error ("mixer/no_motor", {}, "this graph has no motor yet", "add a device.force node, which the mixer can then drive");
}
}   // namespace

std::vector<MixerPlace> mixersOf (const graph::Graph& g)
{
    std::vector<MixerPlace> found;
    collect (g, {}, {}, 0, found);
    return found;
}

const graph::Node* findMixer (const graph::Graph& g, const MixerPlace& at)
{
    const auto* patch = patchOf (g, at.patch);
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
    if (const auto* patch = patchOf (g, at.patch))
        for (const auto& w : patch->wires)
            if (w.to.node == at.node && w.to.port == "in" && w.to.index == layer) return &w;
    return nullptr;
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
    if (auto text = joined (names); ! text.empty()) setting = std::move (text);
    return graph::Batch { "rename a layer", { graph::SetSetting { at.patch, at.node, "names", std::move (setting) } } };
}

std::vector<const NodeType*> layerTypes (const Catalogue& catalogue)
{
    std::vector<const NodeType*> all;
    for (const auto& t : catalogue)
        if ((t.info.id.starts_with ("texture.") || t.info.id.starts_with ("vibration.")) && layerOutput (t) != nullptr) all.push_back (&t);
    return all;
}

Result<AddedLayer> addLayer (const graph::Graph& g, const MixerPlace& at, const Catalogue& catalogue, const std::string& type)
{
    const auto* mixer = findMixer (g, at);
    const auto* patch = patchOf (g, at.patch);
    if (mixer == nullptr) return mixerIsGone();
    const int layers = layersOf (*mixer, catalogue);
    const bool fills = layers == 1 && ! type.empty() && wireInto (g, at, 0) == nullptr;   // the only layer is still empty
    if (layers >= list_capacity)
        return Message::error ("mixer/full", {}, "a mixer has at most " + std::to_string (list_capacity) + " layers", "add a second mixer");

    const int place = fills ? 0 : layers;
    graph::Batch batch { "add a layer", {} };
    if (! fills) batch.commands.push_back (graph::SetSetting { at.patch, at.node, "inputs", Json (layers + 1) });
    if (type.empty()) return AddedLayer { std::move (batch), {} };
    const auto* sheet = catalogue.find (type);
    if (sheet == nullptr || layerOutput (*sheet) == nullptr)
        return Message::error ("mixer/type", {}, type + " has no scalar force output, so it cannot be a layer");

    graph::Node node;
    node.name = freeName (*patch, {}, type.substr (type.find ('.') + 1));
    node.type = type;
    const auto name = node.name;
    batch.commands.push_back (graph::AddNode { at.patch, std::move (node) });
    const auto later = downstreamOf (*patch, at.node);
    std::string missing;
    for (const auto& input : sheet->inputs)
        if (auto from = sourceFor (input, g, *patch, later, catalogue))
            batch.commands.push_back (graph::AddWire { at.patch, wire (std::move (*from), endOf (name, input.id)) });
        else if (missing.empty())
            missing = "Wire something into " + name + '.' + std::string (input.id) + ": " + std::string (input.about);
    auto out = endOf (name, layerOutput (*sheet)->id);
    if (type.starts_with ("texture.")) out = gated (std::move (out), g, at, later, catalogue, batch);   // or it would be felt in the air
    batch.commands.push_back (graph::AddWire { at.patch, wire (std::move (out), endOf (at.node, "in", place)) });
    auto names = layerNames (*mixer, place + 1);
    names.back() = name;
    for (std::size_t i = 0; i + 1 < names.size(); ++i)   // the position of a name is the number of commas before it
        if (names[i].empty()) names[i] = "layer " + std::to_string (i + 1);
    batch.commands.push_back (graph::SetSetting { at.patch, at.node, "names", Json (joined (names)) });
    return AddedLayer { std::move (batch), std::move (missing) };
}

Result<graph::Command> removeLayer (const graph::Graph& g, const MixerPlace& at, const Catalogue& catalogue, int layer)
{
    const auto* mixer = findMixer (g, at);
    if (mixer == nullptr) return mixerIsGone();
    const int layers = layersOf (*mixer, catalogue);
    if (layers < 2) return Message::error ("mixer/last_layer", {}, "a mixer needs at least one layer", "delete the mixer on the canvas");
    std::vector<int> to (static_cast<std::size_t> (layers));
    for (int i = 0; i < layers; ++i)
        to[static_cast<std::size_t> (i)] = i < layer ? i : i - 1;
    to[static_cast<std::size_t> (layer)] = -1;
    return permuted (g, at, catalogue, to, layers - 1, "remove a layer");
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
    return permuted (g, at, catalogue, places, layers, "move a layer").value();
}

Result<AddedMixer> addMixer (const graph::Graph& g, const Catalogue&)
{
    const graph::Node* motor = nullptr;
    Stream stream;
    for (const std::string_view type : { "device.force", "device.effort", "device.signal_out" })
        for (const auto& n : g.root.nodes)
        {
            if (n.type != type || ! stream.wires.empty()) continue;
            if (motor == nullptr) motor = &n;
            if (auto s = streamInto (g.root, n); ! s.wires.empty())
            {
                motor = &n;
                stream = std::move (s);
            }
        }
    if (motor == nullptr) return noMotor (g);
    const bool is_beside = stream.wires.empty();
    if (is_beside && motor->type != "device.force")
        return Message::error ("mixer/no_forces", {}, "nothing is wired into " + motor->name + " yet",
                               "wire something into it first; the mixer is then inserted into that wire");

    graph::Node mixer;
    mixer.name = freeName (g.root, {}, "desk");
    mixer.type = mixer_type;
    const auto name = mixer.name;
    std::vector<std::string> names;
    for (const auto* w : stream.wires)
        names.push_back (graph::firstNameOf (w->from.node));
    mixer.settings["inputs"] = std::max<std::size_t> (1, names.size());
    if (! names.empty()) mixer.settings["names"] = joined (names);
    graph::Batch batch { "add a layer mixer", { graph::AddNode { {}, std::move (mixer) } } };
    for (std::size_t i = 0; i < stream.wires.size(); ++i)
    {
        auto to = *stream.wires[i];
        to.to = endOf (name, "in", static_cast<int> (i));
        batch.commands.push_back (graph::ChangeWire { {}, stream.wires[i]->id, std::move (to) });
    }
    const auto into = is_beside ? endOf (motor->name, "force", -1, 2) : stream.to;
    batch.commands.push_back (graph::AddWire { {}, wire (endOf (name, "out"), into) });
    auto description = "Inserts a mixer between " + joined (names) + " and " + graph::toText (into) + '.';
    if (is_beside)
        description = "All wires into " + motor->name
                      + " carry vectors, but a mixer mixes scalars. This adds a mixer next to those wires; its output pushes along z.";
    return AddedMixer { std::move (batch), std::move (description) };
}

}   // namespace tactus::host
