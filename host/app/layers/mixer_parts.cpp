// SPDX-License-Identifier: GPL-3.0-or-later
#include "mixer_parts.hpp"

#include <host/app/model/fragment.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/graph/endpoints.hpp>

#include <algorithm>

namespace tactus::host::mixing
{

namespace
{
constexpr std::string_view window_type = "contact.window";

/// How well an output suits an input: the tool itself is best, then an output of the same name, then the resistance of a surface.
int rankOf (const graph::Node& node, const FacePort& out, const PortSheet& input)
{
    if (node.type == "device.position") return 4;
    if (out.id == input.id) return 3;
    return out.id == "resistance" ? 2 : 1;
}

/// The gain of the contact. Empty if the patch has no depth.
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
}   // namespace

graph::Endpoint endOf (const std::string& node, std::string_view port, int index, int component)
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

std::string joined (std::vector<std::string> names)
{
    while (! names.empty() && names.back().empty())
        names.pop_back();
    std::string all;
    for (std::size_t i = 0; i < names.size(); ++i)
        all += (i == 0 ? "" : ", ") + names[i];
    return all;
}

std::string namesWith (const graph::Node& mixer, int layers, const std::string& last)
{
    auto names = layerNames (mixer, layers);
    names.back() = last;
    for (std::size_t i = 0; i + 1 < names.size(); ++i)
        if (names[i].empty()) names[i] = "layer " + std::to_string (i + 1);
    return joined (std::move (names));
}

Message mixerIsGone() { return Message::error ("mixer/gone", {}, TRANS ("the mixer no longer exists").toStdString()); }

const graph::Node* gateOf (const graph::Patch& patch, const graph::Wire& w)
{
    const auto* product = patch.find (w.from.node);
    if (product == nullptr || (product->type != "signal.multiply" && product->type != "vector.scale")) return nullptr;
    for (const auto& in : patch.wires)
        if (const auto* from = patch.find (in.from.node); in.to.node == product->name && from != nullptr && from->type == window_type && in.from.port == "gain")
            return product;
    return nullptr;
}

graph::Endpoint gated (graph::Endpoint source, bool is_vector, const graph::Graph& g, const MixerPlace& at, const std::set<std::string>& excluded,
                       const Catalogue& catalogue, graph::Batch& batch)
{
    auto gain = touchGain (g, at, excluded, catalogue, batch);
    if (! gain) return source;
    graph::Node product;
    product.name = freeName (*patchOf (g, at.patch), {}, graph::firstNameOf (source.node) + "_felt");
    product.type = is_vector ? "vector.scale" : "signal.multiply";
    const auto name = product.name;
    batch.commands.push_back (graph::AddNode { at.patch, std::move (product) });
    batch.commands.push_back (graph::AddWire { at.patch, wire (std::move (source), is_vector ? endOf (name, "in") : endOf (name, "in", 0)) });
    batch.commands.push_back (graph::AddWire { at.patch, wire (std::move (*gain), is_vector ? endOf (name, "gain") : endOf (name, "in", 1)) });
    return endOf (name, "out");
}

}   // namespace tactus::host::mixing
