// SPDX-License-Identifier: GPL-3.0-or-later
#include "variation.hpp"

#include <host/app/layers/mixer_parts.hpp>
#include <host/app/model/controlled_param.hpp>
#include <host/app/model/param_now.hpp>
#include <host/app/model/param_value.hpp>
#include <host/app/model/patch.hpp>
#include <host/app/model/quantity_text.hpp>
#include <host/app/model/value_in_effect.hpp>
#include <host/app/storage/snapshots.hpp>
#include <host/app/text/filled.hpp>

#include <tactus/kit/random.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

namespace tactus::host
{

namespace
{
bool isNumber (const FacePort& p) { return p.sheet != nullptr && p.width == 1 && ! p.isChoice(); }

/// The value of a param as it is, or would be, written.
Json valueOf (const graph::Graph& g, const graph::Node& n, const FacePort& p)
{
    auto written = writtenValue (n, p);
    return written.is_null() ? initialValue (g, n, p) : written;
}

bool isSetElsewhere (const graph::Graph& g, const std::string& path) { return ! driverAt (g, path).empty() || controlOf (g, path).has_value(); }

/// The graph with the values of a snapshot.
graph::Graph at (graph::Graph g, int snapshot)
{
    if (const auto recalled = recallSnapshot (g, snapshot)) static_cast<void> (graph::apply (g, *recalled));
    return g;
}

/// The graph with the controls of another one, and with what they set stored in the nodes. What differs in such graphs is not set by a control.
graph::Graph withControls (graph::Graph g, const std::vector<graph::Control>& controls, const Catalogue& catalogue)
{
    g.controls = controls;
    return withValuesInEffect (g, {}, catalogue);
}

/// Removes controls, whose parameters keep their values.
graph::Command withoutControls (graph::Graph g, const std::vector<std::string>& ids, const Catalogue& catalogue)
{
    graph::Batch all { {}, {} };
    for (const auto& id : ids)
    {
        all.commands.push_back (removeControl (g, id, catalogue));
        static_cast<void> (graph::apply (g, all.commands.back()));
    }
    return all;
}

/// A length on both sides of 0 is a place, such as the offset of a wall. At random, it would be out of reach, or jump into the hand.
bool isPlace (const PortSheet& sheet)
{
    const bool is_length = sheet.unit.kind == UnitRule::Kind::fixed && sheet.unit.unit.quantity == Quantity::length;
    return is_length && sheet.limits.usual.min < 0.0 && sheet.limits.usual.max > 0.0;
}

/// A switch is a number that means on or off.
bool isSwitch (const PortSheet& sheet) { return sheet.unit.kind == UnitRule::Kind::fixed && sheet.unit.unit.quantity == Quantity::state; }

/// True if a limit would be set or taken away between two values: 0 means that there is none, so nothing lies between.
bool setsLimit (const PortSheet& sheet, const Json& from, const Json& to)
{
    const auto isOff = [&] (const Json& value) { const auto q = readQuantity (value, sheet); return q && q->si() == 0.0; };
    return sheet.limits.off_at_zero && (isOff (from) || isOff (to));
}

/// Gives nodes random numbers, and those inside of subgraphs, each of which it changes once.
struct Randomiser
{
    /// `path`: of the node, as controls name it; empty if it is not known.
    void change (const graph::Patch& in, const std::string& patch, const graph::Node& node, const std::optional<std::string>& path)
    {
        constexpr std::string_view subgraph = "graph:";
        if (node.type.starts_with (subgraph)) enter (node.type.substr (subgraph.size()), path);
        auto changed = node;
        for (const auto& p : faceOf (g, in, node, catalogue).params)
        {
            if (! isNumber (p) || isSwitch (*p.sheet) || isPlace (*p.sheet)) continue;
            const auto& hard = p.sheet->limits.hard;
            const auto& usual = p.sheet->limits.usual;
            const double low = std::max (hard.min, usual.min), high = std::min (hard.max, usual.max);
            const double share = random.uniform();   // taken even if it is not used, so that a value depends on the seed alone
            if (! std::isfinite (low) || ! std::isfinite (high) || low >= high || node.type.starts_with (subgraph)) continue;
            const auto isDriving = [&, id = baseOf (p.id)] (const graph::Wire& w) { return w.to.node == node.name && w.to.port == id; };
            if (std::ranges::any_of (in.wires, isDriving) || (path && isSetElsewhere (g, *path + '.' + p.id))) continue;
            const auto now = readQuantity (valueOf (g, node, p), *p.sheet);
            if (! now) continue;
            const double wanted = low > 0.0 && high >= 10.0 * low ? low * std::pow (high / low, share) : low + share * (high - low);
            const auto moved = now->moved (wanted);
            const auto value = withValue (changed, p, (moved.si() < low || moved.si() > high ? now->exactly (std::clamp (wanted, low, high)) : moved).toJson());
            if (value) changed.params[baseOf (p.id)] = *value;
        }
        for (const auto& [key, value] : changed.params.items())
            if (! node.params.contains (key) || *node.params.find (key) != value) batch.commands.push_back (graph::SetParam { patch, node.name, key, value });
    }

    void enter (const std::string& patch, const std::optional<std::string>& path)
    {
        const auto* in = findPatch (g, patch);
        if (in == nullptr || ! entered.insert (patch).second) return;
        for (const auto& node : in->nodes)
            if (! mixing::isMixer (node.type)) change (*in, patch, node, path ? std::optional (*path + '/' + node.name) : std::nullopt);
    }

    const graph::Graph& g;
    const Catalogue& catalogue;
    Random random;
    graph::Batch& batch;
    std::set<std::string> entered {};   // subgraphs
};
}   // namespace

Result<Morph> morphBetween (const graph::Graph& g, int from, int to, const Catalogue& catalogue)
{
    for (const int n : { from, to })
        if (! hasSnapshot (g, n))
            return Message::error ("morph/empty", {}, filled (TRANS ("snapshot %1 is empty"), n).toStdString(), TRANS ("store a snapshot there").toStdString());
    const auto first = at (g, from), last = at (g, to);
    const auto held_first = withControls (first, g.controls, catalogue), held_last = withControls (last, g.controls, catalogue);
    graph::Control control;
    int left_out = 0;
    for (const auto& node : g.root.nodes)
    {
        const auto *a = held_first.root.find (node.name), *b = held_last.root.find (node.name);
        if (a == nullptr || b == nullptr || (a->params == b->params && a->overrides == b->overrides)) continue;
        if (a->overrides != b->overrides) ++left_out;
        const auto face = faceOf (held_first, held_first.root, *a, catalogue);
        for (const auto& p : face.params)
        {
            const auto low = valueOf (held_first, *a, p), high = valueOf (held_last, *b, p);
            if (low == high) continue;
            const auto path = node.name + '.' + p.id;
            if (isNumber (p) && ! isSwitch (*p.sheet) && ! setsLimit (*p.sheet, low, high) && ! isSetElsewhere (g, path))
                control.to.push_back ({ path, low, high });
            else
                ++left_out;
        }
    }
    for (const auto& [name, patch] : held_first.graphs)
        if (const auto* other = held_last.find (name))
            left_out += static_cast<int> (std::ranges::count_if (patch.nodes, [&] (const graph::Node& n) {
                const auto* m = other->find (n.name);
                return m != nullptr && (m->params != n.params || m->overrides != n.overrides);
            }));
    std::vector<std::string> ended;
    Morph made;
    for (const auto& c : first.controls)
    {
        if (c.value == findControl (last, c.id)->value) continue;
        const auto before = control.to.size();
        for (const auto& t : c.to)
            if (driverAt (g, t.path).empty()) control.to.push_back ({ t.path, controlOf (first, t.path)->value, controlOf (last, t.path)->value });
        if (control.to.size() == before)
        {
            ++left_out;
            continue;
        }
        ended.push_back (c.id);
        made.replaced.push_back (c.name.empty() ? c.id : c.name);
    }
    if (control.to.empty())
        return Message::error ("morph/same", {}, filled (TRANS ("snapshots %1 and %2 differ in no number that a control can move"), from, to).toStdString(),
                               TRANS ("change a number that no wire sets, and store a snapshot again").toStdString());

    const auto id = "morph_" + std::to_string (from) + "_" + std::to_string (to);
    control.id = id;
    for (int i = 2; findControl (g, control.id) != nullptr; ++i)
        control.id = id + "_" + std::to_string (i);
    control.name = filled (TRANS ("Morph %1-%2"), from, to).toStdString();
    control.value = 0.0;
    graph::Batch batch { filled (NEEDS_TRANS ("morph from snapshot %1 to %2"), from, to).toStdString(), {} };
    if (auto recalled = recallSnapshot (g, from)) batch.commands.push_back (std::move (*recalled));
    for (const auto& id : ended)
        batch.commands.push_back (graph::RemoveControl { id });
    auto ui = *g.extra.find ("ui");
    auto& snapshots = ui["snapshots"];
    if (! made.replaced.empty()) snapshots = snapshotsAfter (g, [&] (const graph::Graph& held) { return withoutControls (held, ended, catalogue); });
    for (const auto& [number, end] : { std::pair { from, 0.0 }, std::pair { to, 1.0 } })
        snapshots[std::to_string (number)]["controls"][control.id] = end;
    batch.commands.push_back (graph::SetHeader { .ui = std::move (ui) });
    made.control = control.id;
    made.params = static_cast<int> (control.to.size());
    made.left_out = left_out;
    batch.commands.push_back (graph::AddControl { std::move (control) });
    made.command = std::move (batch);
    return made;
}

graph::Batch randomised (const graph::Graph& g, const std::string& patch, std::span<const graph::Id> nodes, const Catalogue& catalogue, std::uint64_t seed)
{
    graph::Batch batch { filled (NEEDS_TRANS ("randomise, seed %1"), juce::String (seed)).toStdString(), {} };
    Randomiser randomiser { g, catalogue, Random { seed }, batch };
    const auto* in = findPatch (g, patch);
    for (const auto& node : in == nullptr ? std::vector<graph::Node> {} : in->nodes)
        if (std::ranges::count (nodes, node.id) > 0) randomiser.change (*in, patch, node, patch.empty() ? std::optional (node.name) : std::nullopt);
    return batch;
}

}   // namespace tactus::host
