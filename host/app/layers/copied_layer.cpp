// SPDX-License-Identifier: GPL-3.0-or-later
#include "mixer.hpp"
#include "mixer_parts.hpp"

#include <host/app/model/face.hpp>
#include <host/app/model/fragment.hpp>
#include <host/app/model/patch.hpp>
#include <host/app/text/filled.hpp>

#include <tactus/graph/endpoints.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
struct FreeOutput
{
    std::size_t node;   ///< the number of the copied node
    wiring::ForceOutput out;
};

/// The outputs of a node that may carry a force. An oscillator or a constant has a number, which is no force unless its graph makes one of it; a node that
/// no copied wire feeds makes nothing of anything.
std::vector<wiring::ForceOutput> forceOutputs (const graph::Graph& g, const graph::Node& n, bool vectors, const Catalogue& catalogue)
{
    if (n.type.starts_with ("device.")) return {};
    const auto* type = catalogue.find (n.type);
    if (const auto own = type == nullptr ? std::nullopt : wiring::forceOutput (*type, vectors)) return { *own };
    const auto isFed = [&] (const graph::Wire& w) { return w.to.node == n.name; };
    if (type != nullptr && std::ranges::none_of (g.root.wires, isFed)) return {};
    std::vector<wiring::ForceOutput> found;
    for (const auto& p : faceOf (g, g.root, n, catalogue).outputs)
        if (const auto q = p.quantity(); (q == Quantity::force || q == Quantity::any) && p.id.find ('[') == std::string::npos && (p.width == 1 || p.width == 3))
            found.push_back ({ p.id, p.width == 3 });
    return found;
}

/// The only output that no copied wire takes and that fits the mixer. Empty if there is none, or more than one.
std::optional<FreeOutput> freeOutput (const graph::Graph& copied, bool vectors, const Catalogue& catalogue)
{
    std::vector<FreeOutput> found;
    for (std::size_t i = 0; i < copied.root.nodes.size(); ++i)
        for (auto& out : forceOutputs (copied, copied.root.nodes[i], vectors, catalogue))
        {
            const auto takes = [&, &name = copied.root.nodes[i].name] (const graph::Wire& w) {
                return graph::firstNameOf (w.from.node) == name && w.from.port == out.port;
            };
            if ((vectors || ! out.is_vector) && std::ranges::none_of (copied.root.wires, takes)) found.push_back ({ i, std::move (out) });
        }
    return found.size() == 1 ? std::optional (std::move (found.front())) : std::nullopt;
}

/// Wires the inputs of copied nodes as those of the nodes of the same names and types, or, where the patch has none, as far as it has sources. Returns
/// what is missing. `names`: of the copies. `with`: the graph with the copies, which gets the wires, too.
std::string wireCopies (graph::Graph& with, const MixerPlace& at, const graph::Patch& copied, const std::vector<std::string>& names,
                        const Catalogue& catalogue, graph::Batch& batch)
{
    const auto isCopied = [&] (const std::string& node) { return copied.find (graph::firstNameOf (node)) != nullptr; };
    std::string missing;
    for (std::size_t i = 0; i < names.size(); ++i)
    {
        const auto& patch = *findPatch (with, at.patch);
        const auto& node = copied.nodes[i];
        graph::Batch own;
        const auto* original = names[i] == node.name ? nullptr : patch.find (node.name);
        if (original != nullptr && original->type == node.type)
        {
            for (const auto& w : patch.wires)
            {
                if (w.to.node != node.name || isCopied (w.from.node)) continue;
                auto in = w;
                in.id = graph::newId();
                in.to.node = names[i];
                own.commands.push_back (graph::AddWire { at.patch, withBends (std::move (in), {}) });
            }
        }
        else if (const auto* type = catalogue.find (node.type))
            if (auto wanted = wiring::wireInputs (*type, names[i], with, at.patch, wiring::downstreamOf (patch, at.node), catalogue, own); ! wanted.empty())
                missing += (missing.empty() ? "" : ". ") + wanted;
        for (auto& command : own.commands)   // the next node finds what this one has brought
            if (graph::apply (with, command)) batch.commands.push_back (std::move (command));
    }
    return missing;
}
}   // namespace

Result<AddedLayer> addCopiedLayer (const graph::Graph& g, const std::string& patch, const Catalogue& catalogue, const graph::Graph& copied,
                                   std::set<graph::Id>& made)
{
    const auto mixers = mixersOf (g);
    if (std::ranges::find (mixers, patch, &MixerPlace::patch) == mixers.end())
        return Message::error ("mixer/none", {}, TRANS ("there is no mixer here that could take a layer").toStdString(),
                               TRANS ("add a layer or mix the signals first, in the Layers tab; Ctrl+V pastes the nodes as they are").toStdString());
    const auto fits = [&] (const MixerPlace& m) { return m.patch == patch && freeOutput (copied, m.vectors, catalogue); };
    const auto at = std::ranges::find_if (mixers, fits);
    if (at == mixers.end())
        return Message::error ("mixer/type", {}, TRANS ("the copied nodes do not have exactly one free output that a mixer here can take").toStdString(),
                               TRANS ("copy one effect, with a force that goes to no other copied node").toStdString());
    const auto& mixer = *findMixer (g, *at);
    const int layers = layersOf (mixer, catalogue), place = layers == 1 && wireInto (g, *at, 0) == nullptr ? 0 : layers;
    if (place >= list_capacity) return mixing::mixerIsFull();

    auto pasted = paste (g, patch, copied, { 32.0, 32.0 }, made);
    if (! pasted) return std::move (pasted).error();
    std::vector<std::string> names;   // in the order of the copied nodes
    for (const auto& c : std::get<graph::Batch> (pasted->edit).commands)
        if (const auto* add = std::get_if<graph::AddNode> (&c.edit)) names.push_back (add->node.name);
    auto with = g;
    if (auto done = graph::apply (with, *pasted); ! done) return std::move (done).error();

    const auto [node, out] = *freeOutput (copied, at->vectors, catalogue);
    graph::Batch batch { filled (TRANS ("add the layer '%1'"), names[node]).toStdString(), { *std::move (pasted) } };
    auto missing = wireCopies (with, *at, copied.root, names, catalogue, batch);
    auto from = wiring::endOf (names[node], out.port);
    if (wiring::isTexture (copied.root.nodes[node].type))   // or it would be felt in the air
        from = wiring::gated (std::move (from), out.is_vector, with, patch, wiring::downstreamOf (*findPatch (g, patch), at->node), catalogue, batch);
    const int component = at->vectors && ! out.is_vector ? wiring::z_component : -1;
    batch.commands.push_back (graph::SetSetting { patch, at->node, "inputs", Json (place + 1) });
    batch.commands.push_back (graph::AddWire { patch, wiring::wire (std::move (from), wiring::endOf (at->node, "in", place, component)) });
    batch.commands.push_back (graph::SetSetting { patch, at->node, "names", Json (mixing::namesWith (mixer, place + 1, names[node])) });
    return AddedLayer { std::move (batch), std::move (missing), findPatch (with, patch)->find (names[node])->id };
}

}   // namespace tactus::host
