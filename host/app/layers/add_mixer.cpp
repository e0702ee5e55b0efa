// SPDX-License-Identifier: GPL-3.0-or-later
#include "mixer.hpp"
#include "mixer_parts.hpp"

#include <host/app/canvas/notes.hpp>
#include <host/app/model/fragment.hpp>
#include <host/app/model/patch.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/endpoints.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
/// The wires into one endpoint.
struct Stream
{
    graph::Endpoint to;
    std::vector<const graph::Wire*> wires;
};

/// The largest stream of scalars into a sink, directly or through a vector.join.
Stream scalarsInto (const graph::Patch& patch, const graph::Node& sink)
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

/// The wires into the force of a device, if one of them carries a vector that is more than a scalar along one axis.
Stream vectorsInto (const graph::Patch& patch, const graph::Node& sink)
{
    Stream stream { wiring::endOf (sink.name, "force"), {} };
    bool has_vector = false;
    for (const auto& w : patch.wires)
    {
        if (sink.type != "device.force" || w.to.node != sink.name || w.to.port != "force") continue;
        const auto* from = patch.find (w.from.node);
        has_vector = has_vector || (w.to.component < 0 && (from == nullptr || from->type != "vector.join"));
        stream.wires.push_back (&w);
    }
    return has_vector ? stream : Stream {};
}

Message noMotor (const graph::Graph& g)
{
    for (const auto& [subgraph, patch] : g.graphs)
        for (const auto& n : patch.nodes)
            if (n.type == "device.force")
                return Message::error ("mixer/in_subgraph", {}, filled (TRANS ("the motor of this graph is inside the subgraph %1"), subgraph).toStdString(),
                                       filled (TRANS ("enter the subgraph, and add a layer.mix before %1"), n.name).toStdString());
    return Message::error ("mixer/no_motor", {}, TRANS ("this graph has no motor yet").toStdString(),
                           TRANS ("add a device.force node, which the mixer can then drive").toStdString());
}
/// The stream that the mixer mixes: the largest one into a motor. Vectors before scalars, because scalars reach the motor as a part of them.
Stream streamOf (const graph::Patch& patch, const graph::Node*& motor, bool& vectors)
{
    Stream found;
    for (const bool of_vectors : { true, false })
        for (const std::string_view type : { "device.force", "device.effort", "device.signal_out" })
            for (const auto& n : patch.nodes)
            {
                if (n.type != type || ! found.wires.empty()) continue;
                if (motor == nullptr) motor = &n;
                auto stream = of_vectors ? vectorsInto (patch, n) : scalarsInto (patch, n);
                if (stream.wires.empty()) continue;
                motor = &n;
                vectors = of_vectors;
                found = std::move (stream);
            }
    if (found.wires.empty() && motor != nullptr && motor->type == "device.force")   // an empty mixer before it
    {
        vectors = true;
        found.to = wiring::endOf (motor->name, "force");
    }
    return found;
}

/// Moves the destination of a stream, with all that is right of it, so far to the right that a mixer fits before it. Nodes without a stored position
/// stay without one: the canvas arranges them.
void makeRoom (const graph::Graph& g, const Stream& stream, graph::Batch& batch)
{
    constexpr double room = 448.0, reach = 48.0;   // two gaps, the mixer, and the node on its left; the margin of a region around a node
    const auto* motor = g.root.find (stream.to.node);
    const auto to = motor == nullptr ? std::nullopt : positionOf (*motor);
    if (! to) return;
    double by = 0.0;
    for (const auto* w : stream.wires)
        if (const auto* from = g.root.find (graph::firstNameOf (w->from.node)))
            if (const auto at = positionOf (*from); at && at->x < to->x) by = std::max (by, at->x + room - to->x);
    if (by <= 0.0) return;
    for (const auto& n : g.root.nodes)
    {
        const auto at = positionOf (n);
        if (! at || at->x < to->x) continue;
        auto ui = n.extra.at ("ui");
        ui["at"] = Json::array ({ at->x + by, at->y });
        batch.commands.push_back (graph::SetNodeKey { {}, n.name, "ui", std::move (ui) });
    }
    auto notes = notesOf (g, {});
    const auto way = static_cast<float> (by);
    for (auto& note : notes)
        if (note.area.getX() >= static_cast<float> (to->x - reach))
            note.area.translate (way, 0.0f);
        else if (note.isRegion() && note.area.contains (to->toFloat()))
            note.area.setWidth (note.area.getWidth() + way);
    if (! notes.empty()) batch.commands.push_back (setNotes (g, {}, notes, batch.name));
}
}   // namespace

Result<AddedMixer> addMixer (const graph::Graph& g, const Catalogue&)
{
    const graph::Node* motor = nullptr;
    bool vectors = false;
    const auto stream = streamOf (g.root, motor, vectors);
    if (motor == nullptr) return noMotor (g);
    const bool is_first = stream.wires.empty();
    if (is_first && ! vectors)
        return Message::error ("mixer/no_forces", {}, filled (TRANS ("nothing is wired into %1 yet"), motor->name).toStdString(),
                               TRANS ("wire something into it first; the mixer is then inserted into that wire").toStdString());

    graph::Node mixer;
    mixer.name = freeName (g.root, {}, "desk");
    mixer.type = vectors ? mixing::vector_mixer : mixing::number_mixer;
    const MixerPlace place { mixer.id, {}, mixer.name, mixer.name, vectors };
    std::vector<std::string> names;
    for (const auto* w : stream.wires)
        names.push_back (graph::firstNameOf (w->from.node));
    mixer.settings["inputs"] = std::max<std::size_t> (1, names.size());
    if (! names.empty()) mixer.settings["names"] = mixing::joined (names);
    graph::Batch batch { NEEDS_TRANS ("add a layer mixer"), { graph::AddNode { {}, std::move (mixer) } } };
    makeRoom (g, stream, batch);
    for (std::size_t i = 0; i < stream.wires.size(); ++i)
    {
        auto to = *stream.wires[i];
        to.to = wiring::endOf (place.node, "in", static_cast<int> (i), vectors ? to.to.component : -1);
        batch.commands.push_back (graph::ChangeWire { {}, stream.wires[i]->id, std::move (to) });
    }
    batch.commands.push_back (graph::AddWire { {}, wiring::wire (wiring::endOf (place.node, "out"), stream.to) });
    const auto description = is_first ? filled (TRANS ("Adds a mixer before %1."), motor->name)
                                      : filled (TRANS ("Inserts a mixer between %1 and %2."), mixing::joined (names), graph::toText (stream.to));
    return AddedMixer { std::move (batch), description.toStdString(), place };
}

}   // namespace tactus::host
