// SPDX-License-Identifier: GPL-3.0-or-later
#include "sends.hpp"
#include "mixer_parts.hpp"

#include <host/app/model/fragment.hpp>
#include <host/app/model/patch.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> send_sinks { {
    { "device.force", "force" },
    { "device.effort", "effort" },
    { "device.signal_out", "in" },
} };

/// The input of an output node that takes its signal; empty if the node is not an output.
std::string_view inputOf (const graph::Node& n)
{
    const auto at = std::ranges::find (send_sinks, std::string_view (n.type), [] (const auto& s) { return s.first; });
    return at == send_sinks.end() ? std::string_view {} : at->second;
}

/// The mixer before an output, apart from the mixer whose layers are sent.
const graph::Node* busBefore (const graph::Patch& patch, const std::string& sink, const MixerPlace& at)
{
    for (const auto& w : patch.wires)
        if (const auto* from = patch.find (w.from.node); w.to.node == sink && from != nullptr && mixing::isMixer (from->type) && from->id != at.id) return from;
    return nullptr;
}

MixerPlace placeOf (const graph::Node& bus, const MixerPlace& at)
{
    const auto path = at.path.substr (0, at.path.size() - at.node.size()) + bus.name;
    return { bus.id, at.patch, bus.name, path, bus.type == mixing::vector_mixer };
}

/// Wires a layer into a layer of a bus.
void wireSend (const graph::Wire& layer, bool is_vector, const MixerPlace& bus, int place, graph::Batch& batch)
{
    const auto add = [&] (graph::Endpoint from, int component) {
        batch.commands.push_back (graph::AddWire { bus.patch, wiring::wire (std::move (from), wiring::endOf (bus.node, "in", place, component)) });
    };
    if (is_vector == bus.vectors) return add (layer.from, -1);
    if (bus.vectors) return add (layer.from, 2);
    for (int component = 0; component < 3; ++component)
    {
        auto from = layer.from;
        from.component = component;
        add (std::move (from), -1);
    }
}

/// Like addSend(), but an earlier command of the batch may have to add the output first.
Result<graph::Command> sendInto (const graph::Graph& g, const MixerPlace& at, const Catalogue& catalogue, int layer, const graph::Node& sink,
                                 graph::Batch batch)
{
    const auto* patch = findPatch (g, at.patch);
    const auto* mixer = findMixer (g, at);
    if (patch == nullptr || mixer == nullptr) return mixing::mixerIsGone();
    const auto* w = wireInto (g, at, layer);
    if (w == nullptr)
        return Message::error ("mixer/empty", {}, TRANS ("nothing is wired into this layer").toStdString(),
                               TRANS ("wire something into it first").toStdString());
    const bool is_vector = at.vectors && w->to.component < 0;
    auto label = layerNames (*mixer, layersOf (*mixer, catalogue))[static_cast<std::size_t> (layer)];
    if (label.empty()) label = w->from.node;

    if (const auto* bus = busBefore (*patch, sink.name, at))
    {
        const int layers = layersOf (*bus, catalogue);
        if (layers >= list_capacity) return Message::error ("mixer/full", {}, filled (TRANS ("a bus has at most %1 layers"), list_capacity).toStdString());
        batch.commands.push_back (graph::SetSetting { at.patch, bus->name, "inputs", Json (layers + 1) });
        batch.commands.push_back (graph::SetSetting { at.patch, bus->name, "names", Json (mixing::namesWith (*bus, layers + 1, label)) });
        wireSend (*w, is_vector, placeOf (*bus, at), layers, batch);
        return graph::Command (std::move (batch));
    }

    graph::Node bus;
    bus.name = freeName (*patch, {}, "to_" + (sink.role.empty() ? sink.name : sink.role));
    bus.type = sink.type == "device.force" ? mixing::vector_mixer : mixing::number_mixer;
    bus.settings["inputs"] = 1;
    bus.settings["names"] = label;
    const auto place = placeOf (bus, at);
    batch.commands.push_back (graph::AddNode { at.patch, std::move (bus) });
    wireSend (*w, is_vector, place, 0, batch);
    batch.commands.push_back (graph::AddWire { at.patch, wiring::wire (wiring::endOf (place.node, "out"), wiring::endOf (sink.name, inputOf (sink))) });
    return graph::Command (std::move (batch));
}
}   // namespace

std::vector<SendTarget> sendTargets (const graph::Graph& g, const MixerPlace& at)
{
    std::vector<SendTarget> all;
    const auto* patch = findPatch (g, at.patch);
    if (patch == nullptr) return all;
    const auto driven = wiring::downstreamOf (*patch, at.node);
    for (const auto& n : patch->nodes)
        if (! inputOf (n).empty() && ! driven.contains (n.name)) all.push_back ({ n.name, n.role.empty() ? n.name : n.role });
    return all;
}

std::vector<Send> sendsOf (const graph::Graph& g, const MixerPlace& at, const Catalogue& catalogue, int layer)
{
    std::vector<Send> all;
    const auto* patch = findPatch (g, at.patch);
    const auto* w = wireInto (g, at, layer);
    if (patch == nullptr || w == nullptr) return all;
    for (auto& target : sendTargets (g, at))
    {
        const auto* bus = busBefore (*patch, target.sink, at);
        if (bus == nullptr) continue;
        const auto place = placeOf (*bus, at);
        for (int i = 0; i < layersOf (*bus, catalogue); ++i)
            if (const auto* sent = wireInto (g, place, i); sent != nullptr && sent->from.node == w->from.node && sent->from.port == w->from.port)
                all.push_back ({ target, place, i });
    }
    return all;
}

Result<graph::Command> addSend (const graph::Graph& g, const MixerPlace& at, const Catalogue& catalogue, int layer, const std::string& sink)
{
    const auto* patch = findPatch (g, at.patch);
    const auto* to = patch == nullptr ? nullptr : patch->find (sink);
    if (to == nullptr || inputOf (*to).empty()) return mixing::mixerIsGone();
    return sendInto (g, at, catalogue, layer, *to, { filled (TRANS ("send a layer to %1"), sink).toStdString(), {} });
}

Result<graph::Command> addSendToNewMotor (const graph::Graph& g, const MixerPlace& at, const Catalogue& catalogue, int layer)
{
    const auto* patch = findPatch (g, at.patch);
    if (patch == nullptr) return mixing::mixerIsGone();
    graph::Node motor;
    motor.name = freeName (*patch, {}, "shaker");
    motor.type = "device.signal_out";
    motor.role = motor.name;
    graph::Batch batch { filled (TRANS ("send a layer to %1"), motor.name).toStdString(), { graph::AddNode { at.patch, motor } } };
    auto simulated = Json::object();   // until the user binds a device to the role
    simulated["driver"] = "sim";
    simulated["signal_outputs"] = 1;
    if (g.device (motor.role) == nullptr) batch.commands.push_back (graph::SetDevice { motor.role, simulated });
    return sendInto (g, at, catalogue, layer, motor, std::move (batch));
}

Result<graph::Command> removeSend (const graph::Graph& g, const Send& send, const Catalogue& catalogue)
{
    const auto* bus = findMixer (g, send.bus);
    if (bus == nullptr) return mixing::mixerIsGone();
    if (layersOf (*bus, catalogue) > 1) return removeLayer (g, send.bus, catalogue, send.layer);
    return graph::Command (graph::Batch { NEEDS_TRANS ("remove a send"), { graph::RemoveNode { send.bus.patch, send.bus.node } } });
}

}   // namespace tactus::host
