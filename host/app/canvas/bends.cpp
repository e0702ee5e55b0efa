// SPDX-License-Identifier: GPL-3.0-or-later
// The bends that lead a wire where the user wants it.
#include "canvas.hpp"
#include "drags.hpp"

#include <host/app/model/patch.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
const graph::Wire* wireIn (const graph::Graph& g, const std::string& patch, graph::Id id)
{
    const auto* in = findPatch (g, patch);
    if (in == nullptr) return nullptr;
    const auto found = std::ranges::find (in->wires, id, &graph::Wire::id);
    return found == in->wires.end() ? nullptr : &*found;
}

/// The number of bends of a wire before a place on it.
std::size_t bendsBefore (const SceneWire& wire, juce::Point<float> at)
{
    if (! wire.has_bends) return 0;
    const auto path = wire.path();
    juce::Point<float> on_path;
    const float along = path.getNearestPoint (at, on_path);
    return static_cast<std::size_t> (std::ranges::count_if (wire.waypoints, [&] (juce::Point<float> p) { return path.getNearestPoint (p, on_path) < along; }));
}

class MoveBend final : public Drag
{
public:
    MoveBend (Canvas& c, const Bend& b, bool is_new) : canvas (c), bend (b), begun (is_new) {}

    void move (const juce::MouseEvent& e) override
    {
        auto to = canvas.view().toCanvas (e.position);
        if (! e.mods.isAltDown() || e.mods.isShiftDown()) to = (to / Box::grid).roundToInt().toFloat() * Box::grid;
        const auto* wire = wireIn (canvas.edited().graph(), canvas.patch(), bend.wire);
        auto bends = wire == nullptr ? std::vector<juce::Point<double>>() : bendsOf (*wire);
        if (bend.number >= bends.size() || bends[bend.number] == to.toDouble()) return;
        bends[bend.number] = to.toDouble();
        canvas.commands().perform (bendWire (canvas.edited().graph(), canvas.patch(), bend.wire, bends), begun ? graph::Step::joined : graph::Step::own);
        begun = true;
    }

private:
    Canvas& canvas;
    Bend bend;
    bool begun;
};
}   // namespace

graph::Command bendWire (const graph::Graph& g, const std::string& patch, graph::Id id, const std::vector<juce::Point<double>>& bends)
{
    graph::Batch batch { NEEDS_TRANS ("bend wire"), {} };
    if (const auto* wire = wireIn (g, patch, id)) batch.commands.push_back (graph::ChangeWire { patch, id, withBends (*wire, bends) });
    return batch;
}

MovedParts movedParts (const graph::Graph& g, const std::string& patch, const Scene& scene, const Selection& nodes)
{
    MovedParts parts;
    for (const auto& n : scene.nodes())
        if (nodes.contains (n.id)) parts.nodes.emplace_back (n.id, n.at);
    const auto isMoved = [&] (int i) { return i >= 0 && nodes.contains (scene.nodes()[static_cast<std::size_t> (i)].id); };
    for (const auto& w : scene.wires())
        if (w.has_bends && isMoved (w.start) && isMoved (w.end))
            if (const auto* wire = wireIn (g, patch, w.id)) parts.bends.emplace_back (w.id, bendsOf (*wire));
    return parts;
}

graph::Batch moved (const graph::Graph& g, const std::string& patch, const MovedParts& parts, juce::Point<float> by)
{
    graph::Batch all { NEEDS_TRANS ("move"), {} };
    auto places = parts.nodes;
    for (auto& [id, at] : places)
        at += by;
    if (! places.empty()) all.commands.push_back (placeNodes (g, patch, places));
    for (auto [id, bends] : parts.bends)
    {
        for (auto& b : bends)
            b += by.toDouble();
        all.commands.push_back (bendWire (g, patch, id, bends));
    }
    return all;
}

std::unique_ptr<Drag> moveBend (Canvas& c, const Bend& bend, bool is_new) { return std::make_unique<MoveBend> (c, bend, is_new); }

std::optional<Bend> CanvasCommands::addBend (graph::Id id, juce::Point<float> at)
{
    const auto* shown = canvas.scene().findWire (id);
    const auto* wire = wireIn (document.graph(), canvas.patch(), id);
    if (shown == nullptr || wire == nullptr) return std::nullopt;
    auto bends = bendsOf (*wire);
    const Bend made { id, bendsBefore (*shown, at) };
    bends.insert (bends.begin() + static_cast<std::ptrdiff_t> (made.number), at.toDouble());
    if (! perform (bendWire (document.graph(), canvas.patch(), id, bends))) return std::nullopt;
    canvas.selectBend (made);
    return made;
}

void CanvasCommands::bendSelection()
{
    for (const auto& w : canvas.scene().wires())
    {
        if (! canvas.selection().contains (w.id)) continue;
        const auto path = w.path();
        const auto pointer = canvas.getMouseXYRelative().toFloat();
        juce::Point<float> nearest;
        path.getNearestPoint (canvas.view().toCanvas (pointer), nearest);
        const bool is_pointed_at = canvas.view().toPixels (nearest).getDistanceFrom (pointer) <= Canvas::wire_reach;
        (void)addBend (w.id, is_pointed_at ? nearest : path.getPointAlongPath (path.getLength() / 2));
        return;
    }
}

void CanvasCommands::removeBend (const Bend& bend)
{
    const auto* wire = wireIn (document.graph(), canvas.patch(), bend.wire);
    auto bends = wire == nullptr ? std::vector<juce::Point<double>>() : bendsOf (*wire);
    if (bend.number >= bends.size()) return;
    bends.erase (bends.begin() + static_cast<std::ptrdiff_t> (bend.number));
    auto command = bendWire (document.graph(), canvas.patch(), bend.wire, bends);
    std::get<graph::Batch> (command.edit).name = NEEDS_TRANS ("remove bend");
    canvas.select (Selection { bend.wire });
    perform (std::move (command));
}

void CanvasCommands::nudgeBend (const Bend& bend, juce::Point<float> by)
{
    const auto* wire = wireIn (document.graph(), canvas.patch(), bend.wire);
    auto bends = wire == nullptr ? std::vector<juce::Point<double>>() : bendsOf (*wire);
    if (bend.number >= bends.size()) return;
    bends[bend.number] += by.toDouble();
    perform (bendWire (document.graph(), canvas.patch(), bend.wire, bends));
}

}   // namespace tactus::host
