// SPDX-License-Identifier: GPL-3.0-or-later
#include "param_value.hpp"
#include "quantity_text.hpp"

#include <tactus/graph/endpoints.hpp>
#include <tactus/graph/inside.hpp>

#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string_view>

namespace tactus::host
{

namespace
{
Json entryIn (const Json& all, const std::optional<std::size_t>& entry)
{
    if (! entry) return all;
    return all.is_array() && *entry < all.size() ? Json (all[*entry]) : Json();
}

/// The value stored inside a subgraph for a param that it exposes. Null if none is stored.
Json inside (const graph::Graph& g, const graph::Node& node, const std::string& param, int depth)
{
    const auto [owner, patch] = graph::insideOf (g, node);
    if (patch == nullptr || depth > deepest_subgraph) return {};
    const auto shown = std::ranges::find (patch->expose.params, param, &std::pair<std::string, graph::Endpoint>::first);
    if (shown == patch->expose.params.end()) return {};
    const auto& e = shown->second;
    const auto* inner = e.node.find ('/') == std::string::npos ? patch->find (graph::firstNameOf (e.node)) : nullptr;
    if (inner == nullptr) return {};
    const auto own = inner->params.find (e.port);
    if (own == inner->params.end()) return inside (*owner, *inner, e.port, depth + 1);
    const auto part = e.component >= 0 ? e.component : e.index;
    return entryIn (*own, part >= 0 ? std::optional (static_cast<std::size_t> (part)) : std::nullopt);
}
}   // namespace

std::optional<std::size_t> entryOf (const std::string& id)
{
    const auto bracket = id.find ('[');
    return bracket == std::string::npos ? std::nullopt : std::optional (static_cast<std::size_t> (std::strtol (id.c_str() + bracket + 1, nullptr, 10)));
}

std::string baseOf (const std::string& id) { return id.substr (0, id.find ('[')); }

Json writtenValue (const graph::Node& node, const FacePort& port)
{
    const auto own = node.params.find (baseOf (port.id));
    return own == node.params.end() ? Json() : entryIn (*own, entryOf (port.id));
}

Json initialValue (const graph::Graph& g, const graph::Node& node, const FacePort& port)
{
    if (auto value = inside (g, node, port.id, 0); ! value.is_null()) return value;
    if (port.sheet == nullptr) return 0.0;
    if (port.isChoice()) return std::string (port.sheet->choices[static_cast<std::size_t> (port.sheet->initial[0])]);
    if (port.width == 3) return Json::array ({ port.sheet->initial[0], port.sheet->initial[1], port.sheet->initial[2] });
    return port.sheet->initial[0];
}

std::optional<Json> withValue (const graph::Node& node, const FacePort& port, const std::optional<Json>& value)
{
    const auto entry = entryOf (port.id);
    if (! entry) return value;
    auto all = Json::array();
    if (const auto own = node.params.find (baseOf (port.id)); own != node.params.end() && own->is_array()) all = *own;
    while (all.size() <= *entry)
        all.push_back (port.sheet->initial[0]);
    all[*entry] = value ? *value : Json (port.sheet->initial[0]);
    const bool plain = std::ranges::all_of (all, [&] (const Json& v) { return v == Json (port.sheet->initial[0]); });
    return plain ? std::nullopt : std::optional (std::move (all));
}

namespace
{
struct Sweep
{
    QuantityText value;
    double low, high;
};

Sweep usualSweep (const Json& now, const PortSheet& sheet)
{
    const auto read = readQuantity (now, sheet);
    const auto value = read ? *read : QuantityText { sheet.initial[0], {}, 1.0 };
    const auto& usual = sheet.limits.usual;
    const double low = std::isfinite (usual.min) ? usual.min : std::min (0.0, value.si());
    const double above = value.si() > low ? low + 2.0 * (value.si() - low) : low + 1.0;
    const double high = std::isfinite (usual.max) ? usual.max : above;
    return { value, std::min (low, value.si()), std::max (high, value.si()) };
}
}   // namespace

std::pair<Json, Json> sweepOf (const Json& now, const PortSheet& sheet)
{
    const auto [value, low, high] = usualSweep (now, sheet);
    const auto end = [v = value] (double si) { return (si == v.si() ? v : v.moved (si)).toJson(); };
    return { end (low), end (high) };
}

std::pair<Json, Json> sweepThrough (const Json& now, const PortSheet& sheet, double at)
{
    const auto [value, low, high] = usualSweep (now, sheet);
    const double si = value.si(), whole = high - low;
    const auto widest = [at] (double down, double up) {
        constexpr double any = std::numeric_limits<double>::max();
        return std::min (at > 0.0 ? down / at : any, at < 1.0 ? up / (1.0 - at) : any);
    };
    const auto& hard = sheet.limits.hard;
    const double least = std::max (hard.min, si - whole), most = std::min (hard.max, si + whole);
    double a = si, b = si;
    for (const auto& [from, to] : { std::pair (low, high), std::pair (least, most) })
        for (const bool is_up : { true, false })
            if (const double span = is_up ? widest (si - from, to - si) : widest (to - si, si - from); a == b && span > 0.0)
            {
                a = is_up ? si - at * span : si + at * span;
                b = is_up ? si + (1.0 - at) * span : si - (1.0 - at) * span;
                const auto settle = [&, begin = from, last = to] (double& end) {
                    if (std::abs (end - begin) < 1e-12 * span || end < begin) end = begin;
                    if (std::abs (end - last) < 1e-12 * span || end > last) end = last;
                };
                settle (a);
                settle (b);
            }
    return { value.exactly (a).toJson(), value.exactly (b).toJson() };
}

std::vector<std::pair<std::string, Json>> valuesOfSource (const Face& source, const Json& now, const PortSheet& sheet)
{
    constexpr double part_of_value = 0.1, part_of_range = 0.05;
    const auto [value, low, high] = usualSweep (now, sheet);
    const auto& hard = sheet.limits.hard;
    const double si = value.si(), room = hard.max - hard.min;
    const double swing = std::min (si == 0.0 ? part_of_range * (high - low) : part_of_value * std::abs (si), 0.5 * room);
    const double middle = std::clamp (si, hard.min + swing, hard.max - swing);
    const auto text = withBestPrefix (value, sheet);
    std::vector<std::pair<std::string, Json>> values;
    const auto give = [&] (const char* id, double to) {
        const auto* own = source.find (Role::param, id);
        if (own != nullptr && own->width == 1 && own->quantity() == Quantity::any) values.emplace_back (id, (to == si ? text : text.moved (to)).toJson());
    };
    give ("value", si);
    give ("amplitude", swing);
    give ("offset", middle);
    return values;
}

std::optional<Json> depthOf (const graph::Node& source, const Face& face, Quantity carried, const Json& now, const PortSheet& sheet, const std::string& symbol,
                             double depth)
{
    constexpr std::array<std::string_view, 4> modulators { "signal.lfo", "signal.envelope", "signal.noise", "signal.sample_hold" };
    constexpr double part_of_value = 0.1, part_of_range = 0.05, slow = 0.1;   // m/s
    const bool is_speed = carried == Quantity::speed;
    if (! is_speed && std::ranges::count (modulators, source.type) == 0) return std::nullopt;
    const auto [value, low, high] = usualSweep (now, sheet);
    const double si = value.si();
    if (depth == 0.0) depth = si == 0.0 ? part_of_range * (high - low) : part_of_value * std::abs (si);
    if (is_speed) depth /= slow;
    bool has_unit = carried != Quantity::any && carried != Quantity::gain;
    if (const auto* amplitude = face.find (Role::param, "amplitude"); amplitude != nullptr && amplitude->sheet != nullptr)
    {
        const auto written = writtenValue (source, *amplitude);
        const auto size = readQuantity (written.is_null() ? Json (amplitude->sheet->initial[0]) : written, *amplitude->sheet);
        if (! size || size->si() == 0.0) return std::nullopt;
        depth /= std::abs (size->si());
        has_unit = has_unit || ! size->unit.empty();
    }
    const bool is_number = symbol.empty() || symbol == "1" || symbol == unit::decibel.symbol;   // a factor has no dB
    if (is_speed && symbol != unit::speed.symbol)
        return Json (numberText (rounded (value.moved (depth).si())) + " " + (is_number ? "" : symbol + "*") + "s/m");
    const bool is_fixed = sheet.unit.kind == UnitRule::Kind::fixed;
    if (has_unit && is_fixed && carried != Quantity::any && carried != sheet.unit.unit.quantity) return std::nullopt;
    if (has_unit || is_number) return Json (QuantityText { 0.0, {}, 1.0 }.moved (depth).number);
    auto text = withBestPrefix (value.moved (depth), sheet);
    if (text.unit.empty()) text.unit = symbol;
    return text.toJson();
}

}   // namespace tactus::host
