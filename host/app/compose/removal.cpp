// SPDX-License-Identifier: GPL-3.0-or-later
#include "removal.hpp"

#include <host/app/layers/mixer.hpp>
#include <host/app/model/patch.hpp>

#include <tactus/graph/endpoints.hpp>

#include <algorithm>
#include <optional>

namespace tactus::host::compose
{

namespace
{
/// The first wire into a layer, as it is without the gate that a contact opens.
std::optional<graph::Wire> wireWithoutGate (const graph::Graph& g, const MixerPlace& at, const Catalogue& catalogue, int layer)
{
    const auto* gated = wireInto (g, at, layer);
    if (! isGated (g, at, layer)) return gated != nullptr ? std::optional (*gated) : std::nullopt;
    auto open = g;
    const auto opening = setGate (g, at, catalogue, layer, false);
    const auto* wire = opening && graph::apply (open, *opening) ? wireInto (open, at, layer) : nullptr;
    return wire != nullptr ? std::optional (*wire) : std::nullopt;
}
}   // namespace

graph::Command withLeftovers (const graph::Graph& g, graph::Batch removal, const Catalogue& catalogue)
{
    auto after = g;
    if (! graph::apply (after, removal)) return removal;
    const auto add = [&] (graph::Command c) {
        if (graph::apply (after, c)) removal.commands.push_back (std::move (c));
    };
    const auto wasSubgraph = [&] (const std::string& patch, const std::string& name) {
        const auto* node = findPatch (g, patch)->find (name);
        return node != nullptr && node->type.starts_with ("graph:") && findPatch (after, patch)->find (name) == nullptr;
    };
    for (const auto& at : mixersOf (g))
        for (int i = layersOf (*findMixer (g, at), catalogue); i-- > 0 && findMixer (after, at) != nullptr;)
        {
            const auto wire = wireWithoutGate (g, at, catalogue, i);
            if (! wire || ! wasSubgraph (at.patch, graph::firstNameOf (wire->from.node)) || wireWithoutGate (after, at, catalogue, i)) continue;
            if (const auto* gate = wireInto (after, at, i)) add (graph::RemoveNode { at.patch, graph::firstNameOf (gate->from.node) });
            if (auto layer = removeLayer (after, at, catalogue, i)) add (*std::move (layer));
        }
    for (const auto& c : g.controls)
    {
        const auto left = std::ranges::find (after.controls, c.id, &graph::Control::id);
        if (! c.to.empty() && left != after.controls.end() && left->to.empty()) add (graph::RemoveControl { c.id });
    }
    return removal;
}

}   // namespace tactus::host::compose
