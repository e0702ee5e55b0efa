// SPDX-License-Identifier: GPL-3.0-or-later
#include "modulation.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/model/param_value.hpp>
#include <host/app/model/patch.hpp>
#include <host/app/model/quantity_text.hpp>
#include <host/app/text/filled.hpp>

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/endpoints.hpp>
#include <tactus/plan/values.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/read_number.hpp>
#include <tactus/text/units.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::host
{

namespace
{
/// The unit of a gain as it is written, and its value in SI units.
struct GainUnit
{
    std::string text {};
    double si = 1.0;
};

GainUnit unitOf (const Json& gain)
{
    if (! gain.is_string()) return {};
    const auto written = gain.asString();
    const auto start = std::min (written.find_first_not_of (' '), written.size());
    auto unit = written.substr (start + readNumber (std::string_view (written).substr (start)).size);
    unit.erase (0, unit.find_first_not_of (' '));
    const auto one = parseMeasure ("1 " + unit);
    return unit.empty() || ! one ? GainUnit {} : GainUnit { unit, one->value };
}

/// A full swing of a source: its value, its dimension, and whether it is never below 0.
struct Swing
{
    double size = 1.0;
    bool is_one_sided = false;
    Dimension dimension {};
};

Dimension dimensionOf (const Json& value)
{
    const auto number = plan::readNumber (value);
    return number ? number->dimension.value_or (Dimension {}) : Dimension {};
}

Swing swingOf (const graph::Graph& g, const graph::Patch& patch, const graph::Endpoint& from, const Catalogue& catalogue)
{
    constexpr double slow = 0.1;   // m/s, as in depthOf()
    const auto* node = patch.find (graph::firstNameOf (from.node));
    if (node == nullptr) return {};
    const auto face = faceOf (g, patch, *node, catalogue);
    const auto* out = face.startOf (from);
    if (out != nullptr && out->quantity() == Quantity::speed) return { slow, true, unit::speed.dimension };
    const auto* amplitude = face.find (Role::param, "amplitude");
    if (amplitude == nullptr || amplitude->sheet == nullptr) return { 1.0, node->type == "signal.envelope" };
    const auto written = writtenValue (*node, *amplitude);
    return { std::abs (siOf (written.is_null() ? initialValue (g, *node, *amplitude) : written, *amplitude->sheet, 1.0)), false, dimensionOf (written) };
}

/// The SI unit of a param: that of its datasheet, else that of what a wire adds to it, or that of its stored value. Empty if none is known.
std::string unitOf (const graph::Graph& g, const graph::Node& node, const FacePort& param, Dimension added)
{
    if (param.unit.kind == UnitRule::Kind::fixed) return std::string (param.unit.unit.symbol);
    const auto written = writtenValue (node, param);
    const auto unit = added == Dimension {} ? dimensionOf (written.is_null() ? initialValue (g, node, param) : written) : added;
    return unit == Dimension {} ? std::string() : symbolOf (unit);
}
}   // namespace

std::vector<Modulation> modulationsOf (const graph::Graph& g, const std::string& patch_name, const std::string& node, const FacePort& param,
                                       const Catalogue& catalogue)
{
    std::vector<Modulation> found;
    const auto* patch = findPatch (g, patch_name);
    const auto* driven = patch == nullptr ? nullptr : patch->find (node);
    if (driven == nullptr || param.width != 1 || param.isChoice()) return found;
    const auto entry = entryOf (param.id);
    for (const auto& w : patch->wires)
    {
        if (! w.add || ! w.enabled.value_or (true) || w.to.node != node || w.to.port != baseOf (param.id)) continue;
        if (w.to.index != (entry ? static_cast<int> (*entry) : -1)) continue;
        const auto gain = plan::readNumber (w.gain.is_null() ? Json (1.0) : w.gain);
        if (! gain) continue;
        const auto swing = swingOf (g, *patch, w.from, catalogue);
        found.push_back ({ patch_name, w.id, graph::toText (w.from), gain->value * swing.size, swing.is_one_sided, unitOf (w.gain).si * swing.size,
                           unitOf (g, *driven, param, gain->dimension.value_or (Dimension {}) * swing.dimension) });
    }
    return found;
}

std::vector<Modulation> modulationsAt (const graph::Graph& g, const std::string& path, const Catalogue& catalogue)
{
    const auto end = graph::parseEndpoint (path);
    if (! end || end->component >= 0 || end->node.find ('[') != std::string::npos) return {};
    std::vector<std::pair<std::string, std::string>> around;   // patches and their nodes on the path, the outermost first
    std::string patch, rest = end->node;
    for (auto slash = rest.find ('/'); slash != std::string::npos; slash = rest.find ('/'))
    {
        around.emplace_back (patch, rest.substr (0, slash));
        const auto* in = findPatch (g, patch);
        const auto* node = in == nullptr ? nullptr : in->find (around.back().second);
        if (node == nullptr || ! node->type.starts_with ("graph:")) return {};
        patch = node->type.substr (6);
        rest.erase (0, slash + 1);
    }
    std::vector<Modulation> found;
    auto id = end->index < 0 ? end->port : end->port + '[' + std::to_string (end->index) + ']';
    for (graph::Endpoint at { rest, end->port, end->index };;)
    {
        const auto* in = findPatch (g, patch);
        const auto* node = in == nullptr ? nullptr : in->find (at.node);
        if (node == nullptr) return found;
        const auto face = faceOf (g, *in, *node, catalogue);
        if (const auto* port = face.find (Role::param, id))
            for (auto& m : modulationsOf (g, patch, at.node, *port, catalogue))
                found.push_back (std::move (m));
        // Wires also reach it through the port that its subgraph exposes.
        const auto exposed = std::ranges::find (in->expose.params, at, &std::pair<std::string, graph::Endpoint>::second);
        if (around.empty() || exposed == in->expose.params.end()) return found;
        id = exposed->first;
        patch = around.back().first;
        at = { around.back().second, exposed->first };
        around.pop_back();
    }
}

juce::String sizeOf (const Modulation& m)
{
    const auto sign = m.is_one_sided ? fromUtf8 (m.depth < 0.0 ? "\xe2\x88\x92" : "+") : fromUtf8 ("\xc2\xb1");
    return sign + fromUtf8 (shownQuantity (rounded (std::abs (m.depth)), m.unit));
}

juce::String textOf (const Modulation& m) { return filled (TRANS ("%1 by %2"), sizeOf (m), m.from); }

std::optional<graph::Command> changeDepth (const graph::Graph& g, const Modulation& m, double to)
{
    const auto* patch = findPatch (g, m.patch);
    if (patch == nullptr || m.of_one == 0.0) return std::nullopt;
    const auto wire = std::ranges::find (patch->wires, m.wire, &graph::Wire::id);
    if (wire == patch->wires.end()) return std::nullopt;
    auto changed = *wire;
    const auto unit = unitOf (wire->gain).text;
    const double number = rounded (to / m.of_one);
    changed.gain = unit.empty() ? Json (number) : Json (numberText (number) + " " + unit);
    return graph::Batch { NEEDS_TRANS ("change depth"), { graph::ChangeWire { m.patch, m.wire, std::move (changed) } } };
}

Result<double> readDepth (const std::string& typed, const Modulation& m, const PortSheet& sheet)
{
    auto any = sheet;
    any.limits = {};   // they are those of the parameter
    if (const auto one = parseMeasure ("1 " + m.unit); one && ! m.unit.empty() && any.unit.kind != UnitRule::Kind::fixed)
        any.unit = Unit { Quantity::any, one->dimension, m.unit };   // in which the depth is shown
    const auto shown = withBestPrefix ({ rounded (std::abs (m.depth)), {}, 1.0 }, any);
    const auto read = readTyped (typed, shown, any);
    if (! read) return read.error();
    return read->si();
}

graph::Command removeModulation (const Modulation& m)
{
    return graph::Batch { NEEDS_TRANS ("end modulation"), { graph::RemoveWire { m.patch, m.wire } } };
}

double draggedDepth (double from, double span, double pixels)
{
    constexpr double whole = 200.0, catches = 4.0;   // pixels
    const double to = from + pixels / whole * span;
    return std::abs (to) < catches / whole * span ? 0.0 : to;
}

}   // namespace tactus::host
