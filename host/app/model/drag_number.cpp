// SPDX-License-Identifier: GPL-3.0-or-later
#include "drag_number.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace tactus::host
{

namespace
{
constexpr double pixels_over_range = 200.0, least_ratio = 100.0;   // of the ends of a range whose values a drag scales

bool isFinite (const Interval& i) { return std::isfinite (i.min) && std::isfinite (i.max) && i.max > i.min; }

/// The unit follows from the wires, and is not a multiple of another one.
bool followsWires (const UnitRule& rule)
{
    using Kind = UnitRule::Kind;
    return rule.kind == Kind::open || rule.kind == Kind::each || (rule.kind == Kind::same && rule.unit.symbol == unit::count.symbol);
}

/// A search along the wires from the outputs of a node, for a port with a unit of its own and a usual range.
struct Ends
{
    const graph::Graph& graph;
    const graph::Patch& patch;
    const Catalogue& catalogue;
    std::set<const graph::Node*> seen {};
    bool has_unit = false;
    std::optional<Interval> usual {};

    void follow (const graph::Node& node)
    {
        if (! seen.insert (&node).second) return;
        const auto face = faceOf (graph, patch, node, catalogue);
        for (const auto& w : patch.wires)
        {
            if (usual || w.from.node != node.name || ! w.enabled.value_or (true)) continue;
            const auto* start = face.startOf (w.from);
            const auto* to = patch.find (w.to.node);
            if (start == nullptr || to == nullptr || ! followsWires (start->unit)) continue;
            const auto target = faceOf (graph, patch, *to, catalogue);
            const auto* end = target.endOf (w.to);
            if (end == nullptr) continue;
            if (followsWires (end->unit) && w.gain.is_null()) follow (*to);
            if (end->unit.kind != UnitRule::Kind::fixed) continue;
            has_unit = true;
            if (end->sheet != nullptr && w.gain.is_null() && isFinite (end->sheet->limits.usual)) usual = end->sheet->limits.usual;
        }
    }
};
}   // namespace

bool isLogarithmic (const PortSheet& sheet) noexcept
{
    const auto& usual = sheet.limits.usual;
    return usual.min > 0.0 && std::isfinite (usual.max) && usual.max / usual.min >= least_ratio;
}

PortSheet sheetInUse (const graph::Graph& g, const graph::Patch& patch, const graph::Node& node, const FacePort& port, const Json& now,
                      const Catalogue& catalogue)
{
    auto sheet = *port.sheet;
    if (! followsWires (sheet.unit) || port.isChoice()) return sheet;
    Ends ends { g, patch, catalogue };
    ends.follow (node);
    auto& usual = sheet.limits.usual;
    if (ends.usual)
    {
        const bool is_size = usual.min >= 0.0;   // such as an amplitude, which begins at 0 wherever the range of the other param is
        const auto [low, high] = *ends.usual;
        usual = *ends.usual;
        if (is_size) usual = { low > 0.0 && high / low >= least_ratio ? low : 0.0, high - low };
        return sheet;
    }
    const auto read = readQuantity (now, sheet);
    if (ends.has_unit || (read && ! read->unit.empty())) usual = {};
    return sheet;
}

QuantityText dragged (const QuantityText& grabbed, const PortSheet& sheet, double pixels)
{
    if (pixels == 0.0) return grabbed;   // with all its digits
    const auto& usual = sheet.limits.usual;
    const double from = grabbed.si(), part = pixels / pixels_over_range;
    double to = from + std::max (std::abs (from), grabbed.scale) * 2.0 * part;
    if (isLogarithmic (sheet) && from > 0.0)
        to = from * std::pow (usual.max / usual.min, part);
    else if (std::isfinite (usual.min) && std::isfinite (usual.max))
        to = from + (usual.max - usual.min) * part;
    return grabbed.moved (sheet.limits.hard.clamp (to));
}

}   // namespace tactus::host
