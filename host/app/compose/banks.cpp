// SPDX-License-Identifier: GPL-3.0-or-later
#include "banks.hpp"

#include <host/app/layers/mixer_parts.hpp>
#include <host/app/model/fragment.hpp>
#include <host/app/text/filled.hpp>
#include <host/tools/stems/sink_mixes.hpp>

#include <tactus/graph/endpoints.hpp>
#include <tactus/plan/flat/flatten.hpp>

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

namespace tactus::host::compose
{

namespace
{
bool leadsTo (const graph::Wire& w, const std::string& sink, const SinkPort& port) { return w.to.node == sink && w.to.port == port.port; }

/// The mixer whose whole mix goes into an input, and nowhere else; null if there is none.
const graph::Node* bankOf (const graph::Patch& root, const std::string& sink, const SinkPort& port)
{
    for (const auto& w : root.wires)
    {
        if (! leadsTo (w, sink, port)) continue;
        const auto* from = root.find (w.from.node);
        const bool is_mix = from != nullptr && ! from->bypass && from->type == (port.is_vector ? mixing::vector_mixer : mixing::number_mixer)
                            && w.from.port == "out" && w.from.component < 0;
        const bool is_whole = w.to.component < 0 && w.delay == 0 && w.gain.is_null() && w.enabled.value_or (true);
        const auto uses = std::ranges::count_if (root.wires, [&] (const graph::Wire& v) { return v.from.node == w.from.node && v.from.port == "out"; });
        if (is_mix && is_whole && uses == 1) return from;
    }
    return nullptr;
}

graph::Node& nodeOf (graph::Patch& root, const std::string& name) { return *std::ranges::find (root.nodes, name, &graph::Node::name); }

/// Makes a layer without a wire, and returns its number.
Result<int> newLayer (graph::Patch& root, const std::string& mixer, const std::string& label, const Catalogue& catalogue)
{
    auto& node = nodeOf (root, mixer);
    const int layers = layersOf (node, catalogue);
    const bool is_empty = layers == 1 && std::ranges::none_of (root.wires, [&] (const graph::Wire& w) { return w.to.node == mixer && w.to.port == "in"; });
    const int place = is_empty ? 0 : layers;
    if (place >= list_capacity) return mixing::mixerIsFull();
    node.settings["inputs"] = place + 1;
    auto called = label;
    std::ranges::replace (called, ',', ' ');
    node.settings["names"] = mixing::namesWith (node, place + 1, called);
    return place;
}

/// Inserts the first mixer before the forces of the graph as a click in the panel does, with room for it. Does nothing if there is one, or if nothing
/// that has a direction reaches a motor yet.
void addFirstMixer (graph::Graph& g, const Catalogue& catalogue)
{
    if (std::ranges::any_of (g.root.nodes, mixing::isMixer, &graph::Node::type)) return;
    const auto first = addMixer (g, catalogue);
    if (! first || ! first->place.vectors) return;
    auto with = g;
    if (graph::apply (with, first->command) && with.root.find (first->place.node)->settings.contains ("names")) g = std::move (with);
}
/// True if several wires end at the same input of a motor, in some patch.
bool hasJoinedWires (const graph::Graph& g)
{
    const auto isJoined = [] (const graph::Patch& patch) {
        std::set<std::pair<std::string, std::string>> ends;
        for (const auto& w : patch.wires)
        {
            const auto* to = patch.find (w.to.node);
            if (to != nullptr && ! sinkPortsOf (*to).empty() && ! ends.emplace (w.to.node, w.to.port).second) return true;
        }
        return false;
    };
    return isJoined (g.root) || std::ranges::any_of (g.graphs, [&] (const auto& subgraph) { return isJoined (subgraph.second); });
}

/// The number of effects among the signals that reach an input: groups of sources whose nodes are wired to each other. The devices join nothing.
int effectsInto (const plan::Flat& flat, const SinkMix& mix)
{
    std::vector<std::vector<int>> from (flat.nodes.size());
    const auto isDevice = [&] (int n) { return flat.node (n).type != nullptr && flat.node (n).type->info.id.starts_with ("device."); };
    for (const auto& w : flat.wires)
        if (w.from && w.to.role == Role::input && ! isDevice (w.from->node)) from[static_cast<std::size_t> (w.to.node)].push_back (w.from->node);
    std::vector<int> group (flat.nodes.size(), -1), joined;   // `joined`: by group, the one that it belongs to
    const auto whole = [&] (int k) {
        while (joined[static_cast<std::size_t> (k)] != k)
            k = joined[static_cast<std::size_t> (k)];
        return k;
    };
    for (const auto& u : mix.unmixed)
    {
        const auto& source = flat.wires[u.wire].from;
        if (! source) continue;
        const int mine = static_cast<int> (joined.size());
        joined.push_back (mine);
        if (isDevice (source->node)) continue;
        std::vector<int> next { source->node };
        while (! next.empty())
        {
            auto& of = group[static_cast<std::size_t> (next.back())];
            const int n = next.back();
            next.pop_back();
            if (of == mine) continue;
            if (of >= 0)
            {
                joined[static_cast<std::size_t> (whole (of))] = mine;
                continue;
            }
            of = mine;
            next.insert (next.end(), from[static_cast<std::size_t> (n)].begin(), from[static_cast<std::size_t> (n)].end());
        }
    }
    int count = 0;
    for (int k = 0; k < static_cast<int> (joined.size()); ++k)
        count += whole (k) == k ? 1 : 0;
    return count;
}
}   // namespace

Result<std::string> bankBefore (graph::Patch& root, const std::string& sink, const SinkPort& port, const Catalogue& catalogue)
{
    const auto* there = bankOf (root, sink, port);
    graph::Node made;
    const auto mixer = there != nullptr ? there->name : freeName (root, {}, "desk");
    if (there == nullptr)
    {
        made.name = mixer;
        made.type = port.is_vector ? mixing::vector_mixer : mixing::number_mixer;
        made.settings["inputs"] = 1;
        root.nodes.push_back (made);
    }
    for (auto& w : root.wires)
    {
        if (! leadsTo (w, sink, port) || w.from.node == mixer) continue;
        const auto place = newLayer (root, mixer, graph::firstNameOf (w.from.node), catalogue);
        if (! place) return place.error();
        w.to = { mixer, "in", *place, w.to.component };
    }
    if (there == nullptr)
    {
        graph::Wire out;
        out.from = { mixer, "out" };
        out.to = { sink, std::string (port.port) };
        root.wires.push_back (std::move (out));
    }
    return mixer;
}

Result<> addStrip (graph::Patch& root, const std::string& mixer, const graph::Endpoint& from, const std::string& label, const Catalogue& catalogue)
{
    const auto place = newLayer (root, mixer, label, catalogue);
    if (! place) return place.error();
    graph::Wire w;
    w.from = from;
    w.to = { mixer, "in", *place };
    root.wires.push_back (std::move (w));
    return {};
}

Result<> mixAll (graph::Graph& g, const Catalogue& catalogue)
{
    if (auto lifted = liftSinks (g); ! lifted) return lifted;
    addFirstMixer (g, catalogue);
    const auto nodes = g.root.nodes;
    for (const auto& n : nodes)
        for (const auto& port : sinkPortsOf (n))
            if (std::ranges::any_of (g.root.wires, [&] (const graph::Wire& w) { return leadsTo (w, n.name, port); }))
                if (auto bank = bankBefore (g.root, n.name, port, catalogue); ! bank) return bank.error();
    return {};
}

std::vector<Bypassed> bypassedBanks (const graph::Graph& g, const Catalogue& catalogue)
{
    if (mixersOf (g).empty() && ! hasJoinedWires (g)) return {};
    const auto flat = plan::flatten (g, catalogue, {}, nullptr, plan::SettingFiles::left_out).flat;
    const auto mixes = sinkMixes (flat);
    const bool has_bank = std::ranges::any_of (mixes, &SinkMix::is_direct);
    std::vector<Bypassed> found;
    std::set<std::pair<std::string, std::string>> known;
    for (const auto& m : mixes)
    {
        const bool goes_past = m.is_direct || (has_bank && m.mixers.empty());
        if (m.unmixed.empty() || ! (goes_past || (m.mixers.empty() && effectsInto (flat, m) > 1))) continue;
        const auto& path = flat.node (m.sink).path;
        if (! known.emplace (graph::firstNameOf (path), flat.sheet (m.input).id).second) continue;
        Bypassed b { path, std::string (flat.sheet (m.input).id), m.is_direct ? flat.node (m.mixers.front()).path : std::string(), {}, has_bank };
        for (const auto& u : m.unmixed)
            b.sources.push_back (u.from);
        found.push_back (std::move (b));
    }
    return found;
}

Result<graph::Command> mixIn (const graph::Graph& g, const std::string& sink, std::string_view port, const Catalogue& catalogue)
{
    const auto after = std::make_shared<graph::Graph> (g);
    const auto* node = after->root.find (sink);
    auto name = node == nullptr ? std::string (NEEDS_TRANS ("mix all layers")) : filled (NEEDS_TRANS ("mix into %1"), sink).toStdString();
    if (node == nullptr)
    {
        if (auto mixed = mixAll (*after, catalogue); ! mixed) return mixed.error();
    }
    else
        for (const auto& p : sinkPortsOf (*node))
            if (p.port == port)
                if (auto bank = bankBefore (after->root, sink, p, catalogue); ! bank) return bank.error();
    return graph::Command (graph::Batch { std::move (name), { graph::ReplaceGraph { after } } });
}

}   // namespace tactus::host::compose
