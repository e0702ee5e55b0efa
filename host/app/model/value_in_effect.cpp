// SPDX-License-Identifier: GPL-3.0-or-later
#include "value_in_effect.hpp"
#include "controlled_param.hpp"
#include "param_value.hpp"
#include "quantity_text.hpp"

#include <host/app/storage/snapshots.hpp>
#include <host/app/text/filled.hpp>

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/param_edit.hpp>
#include <tactus/plan/flat/flatten.hpp>
#include <tactus/plan/rules/unit_check.hpp>
#include <tactus/plan/values.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host
{

namespace
{
/// The value to which a control at `at` sets a target, in the unit of its low end.
Json valueBetween (const Json& low, const Json& high, double at)
{
    if (low.is_array() && high.is_array() && low.size() == high.size())
    {
        auto all = Json::array();
        for (std::size_t i = 0; i < low.size(); ++i)
            all.push_back (valueBetween (low[i], high[i], at));
        return all;
    }
    const auto a = plan::readNumber (low), b = plan::readNumber (high);
    if (! a || ! b) return low;
    const double si = at == 0.0 ? a->value : a->value + at * (b->value - a->value);   // as the plan does
    const auto& written = low.is_string() ? low : high;
    if (! written.is_string()) return si;
    const PortSheet any { Role::param, {}, UnitRule (UnitRule::Kind::open), {}, {}, {}, 1, false, 0, {} };
    const auto read = readQuantity (written, any);
    return read ? read->exactly (si).toJson() : Json (si);
}

/// Stores a value for the parameter that a path leads to from the root: as graph::paramEdit, and also for one entry or component.
std::optional<graph::Command> stored (const graph::Graph& g, const std::string& path, const Json& value, const Catalogue& catalogue)
{
    if (auto edit = graph::paramEdit (g, path, value)) return *std::move (edit);
    const auto end = graph::parseEndpoint (path);
    const auto* node = end ? g.root.find (end->node) : nullptr;
    if (node == nullptr) return std::nullopt;
    const auto face = faceOf (g, g.root, *node, catalogue);
    const auto* port = face.endOf (*end);
    if (port == nullptr || port->sheet == nullptr) return std::nullopt;
    if (end->component < 0) return graph::SetParam { {}, node->name, end->port, withValue (*node, *port, value) };
    auto whole = writtenValue (*node, *port);
    if (! whole.is_array() || whole.size() != 3) whole = initialValue (g, *node, *port);
    if (! whole.is_array() || whole.size() != 3) return std::nullopt;
    whole[static_cast<std::size_t> (end->component)] = value;
    return graph::SetParam { {}, node->name, end->port, whole };
}

/// Stores what a control sets a target to, in `g` too: several targets may be entries of one list.
void keep (graph::Graph& g, const graph::Control& control, const graph::Control::Target& target, const std::string& path, const Catalogue& catalogue,
           std::vector<graph::Command>& edits)
{
    auto edit = stored (g, path, valueBetween (target.low, target.high, control.value), catalogue);
    if (edit && graph::apply (g, *edit)) edits.push_back (std::move (*edit));
}
}   // namespace

std::optional<double> valueInEffect (const graph::Graph& g, const std::string& address, const Catalogue& catalogue)
{
    auto flattened = plan::flatten (g, catalogue, {}, nullptr, plan::SettingFiles::left_out);
    plan::Ports found;
    if (! plan::find (address, plan::Side::param, *flattened.top, nullptr, flattened.flat, found) || found.empty()) return std::nullopt;
    std::optional<double> all;
    for (const auto& p : found)
    {
        const auto values = std::as_const (flattened.flat).param (p.node, static_cast<std::size_t> (p.port));
        const auto at = static_cast<std::size_t> (std::max (0, p.index) + std::max (0, p.component));
        if (at >= values.size() || (all && *all != values[at])) return std::nullopt;
        all = values[at];
    }
    return all;
}

std::string unitInEffect (const graph::Graph& g, const std::string& address, const Catalogue& catalogue)
{
    auto flattened = plan::flatten (g, catalogue, {}, nullptr, plan::SettingFiles::left_out);
    plan::Ports found;
    if (! plan::find (address, plan::Side::param, *flattened.top, nullptr, flattened.flat, found) || found.empty()) return {};
    return plan::checkUnits (flattened.flat).symbol (found.front());
}

graph::Graph withValuesInEffect (const graph::Graph& g, const SeenPatch& seen, const Catalogue& catalogue)
{
    auto kept = g;
    std::vector<graph::Command> edits;
    if (seen.name.empty())
    {
        for (const auto& c : g.controls)
            for (const auto& t : c.to)
                keep (kept, c, t, t.path, catalogue, edits);
        return kept;
    }
    const auto inside = std::ranges::find (kept.graphs, seen.name, &std::pair<std::string, graph::Patch>::first);
    if (seen.path.empty() || inside == kept.graphs.end()) return kept;
    // As if the patch were the graph itself: a path from the root begins with the path of the patch.
    auto alone = g;
    alone.root = inside->second;
    for (const auto& c : g.controls)
        for (const auto& t : c.to)
            if (t.path.starts_with (seen.path)) keep (alone, c, t, t.path.substr (seen.path.size()), catalogue, edits);
    inside->second = std::move (alone.root);
    return kept;
}

graph::Command removeControl (const graph::Graph& g, const std::string& id, const Catalogue& catalogue)
{
    const auto removalFrom = [&] (const graph::Graph& from) {
        const graph::RemoveControl removal { id };
        graph::Batch all { graph::nameOf (removal), { removal } };
        auto kept = from;
        if (const auto* control = findControl (from, id))
            for (const auto& t : control->to)
                keep (kept, *control, t, t.path, catalogue, all.commands);
        return all;
    };
    auto all = removalFrom (g);
    if (auto snapshots = snapshotsAfter (g, removalFrom); snapshots.is_object())
    {
        auto ui = *g.extra.find ("ui");
        ui["snapshots"] = std::move (snapshots);
        all.commands.push_back (graph::SetHeader { .ui = std::move (ui) });
    }
    return all;
}

std::optional<graph::Command> removeTarget (const graph::Graph& g, const std::string& id, const std::string& path, const Catalogue& catalogue)
{
    const auto* control = findControl (g, id);
    if (control == nullptr) return std::nullopt;
    const auto target = std::ranges::find (control->to, path, &graph::Control::Target::path);
    if (target == control->to.end()) return std::nullopt;
    auto to = *control;
    std::erase_if (to.to, [&] (const auto& t) { return t.path == path; });
    graph::Batch all { filled (TRANS ("release %1"), path).toStdString(), { graph::ChangeControl { id, std::move (to) } } };
    auto kept = g;
    keep (kept, *control, *target, path, catalogue, all.commands);
    return all;
}

std::optional<graph::Command> addTarget (const graph::Graph& g, const std::string& id, const std::string& path, const Json& now, const PortSheet& sheet)
{
    const auto* control = findControl (g, id);
    if (control == nullptr) return std::nullopt;
    auto to = *control;
    if (to.to.empty())
    {
        auto [low, high] = sweepOf (now, sheet);
        const double a = siOf (low, sheet), b = siOf (high, sheet);
        to.value = a == b ? to.value : std::clamp ((siOf (now, sheet) - a) / (b - a), 0.0, 1.0);
        to.to.push_back ({ path, std::move (low), std::move (high) });
    }
    else
    {
        auto [low, high] = sweepThrough (now, sheet, to.value);
        to.to.push_back ({ path, std::move (low), std::move (high) });
    }
    const auto step = filled (TRANS ("assign %1 to %2"), path, to.name.empty() ? id : to.name).toStdString();
    return graph::Batch { step, { graph::ChangeControl { id, std::move (to) } } };
}

}   // namespace tactus::host
