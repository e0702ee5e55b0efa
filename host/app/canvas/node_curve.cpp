// SPDX-License-Identifier: GPL-3.0-or-later
#include "node_curve.hpp"
#include "trial_node.hpp"

#include <host/app/model/clip_graph.hpp>
#include <host/app/model/param_now.hpp>
#include <host/app/text/file_path.hpp>
#include <host/base/files/clip_io.hpp>
#include <tactus/kit/signal/clip_score.hpp>
#include <tactus/node/node_fault.hpp>
#include <tactus/plan/settings.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace tactus::host
{

namespace
{
constexpr int curve_points = 96;

std::string symbolIn (const UnitRule& r) { return r.kind == UnitRule::Kind::fixed ? std::string (r.unit.symbol) : std::string(); }
Quantity quantityIn (const UnitRule& r) { return r.kind == UnitRule::Kind::fixed ? r.unit.quantity : Quantity::any; }

/// The value of a setting; empty if it cannot be read.
std::optional<SettingValue> settingNow (const graph::Node& node, const SettingSheet& sheet)
{
    const auto written = node.settings.find (std::string (sheet.id));
    if (written == node.settings.end()) return sheet.initial;
    std::string where;
    auto value = plan::readSetting (*written, sheet, {}, where);
    return value ? std::optional (std::move (*value)) : std::nullopt;
}

/// A curve is not in use if a choice with the same name has another value: `adhesion_curve` counts if `adhesion` is "curve".
bool isInUse (const graph::Graph& graph, const SeenPatch& patch, const graph::Node& node, const Face& face, std::string_view setting)
{
    constexpr std::string_view ending = "_curve";
    if (! setting.ends_with (ending)) return true;
    const auto* choice = face.find (Role::param, setting.substr (0, setting.size() - ending.size()));
    return choice == nullptr || ! choice->isChoice() || paramNow (graph, patch, node, *choice).value == Json ("curve");
}

/// Stems of frequency and amplitude, from records that have both.
std::optional<PlotData> modesIn (const SettingSheet& sheet, const SettingValue& value)
{
    if (const auto* record = std::get_if<Values> (&value); record != nullptr && sheet.kind == SettingSheet::Kind::record)
    {
        for (std::size_t i = 0; i < sheet.fields.size() && i < record->size(); ++i)
            if (auto inside = modesIn (sheet.fields[i], (*record)[i])) return inside;
        return std::nullopt;
    }
    const auto* records = std::get_if<Records> (&value);
    if (records == nullptr || records->empty() || sheet.kind != SettingSheet::Kind::records) return std::nullopt;
    const auto fieldOf = [&] (std::string_view id) { return std::ranges::find (sheet.fields, id, &SettingSheet::id); };
    const auto along = fieldOf ("frequency"), up = fieldOf ("amplitude");
    if (along == sheet.fields.end() || up == sheet.fields.end()) return std::nullopt;
    PlotData plot { .kind = PlotData::Kind::stems, .x_unit = symbolIn (along->unit), .y_unit = symbolIn (up->unit), .quantity = Quantity::force };
    for (const auto& r : *records)
    {
        const auto numberIn = [&] (auto field) {
            const auto i = static_cast<std::size_t> (field - sheet.fields.begin());
            const auto* number = i < r.size() ? std::get_if<double> (&r[i]) : nullptr;
            return number == nullptr ? 0.0 : *number;
        };
        plot.x.push_back (numberIn (along));
        plot.y.push_back (std::abs (numberIn (up)));
    }
    return plot;
}

std::optional<PlotData> curveInSettings (const graph::Graph& graph, const SeenPatch& patch, const graph::Node& node, const Face& face)
{
    for (const auto& sheet : face.type->settings)
    {
        using Kind = SettingSheet::Kind;
        if (sheet.kind != Kind::law && sheet.kind != Kind::curve && sheet.kind != Kind::record && sheet.kind != Kind::records) continue;
        if (! isInUse (graph, patch, node, face, sheet.id)) continue;
        const auto value = settingNow (node, sheet);
        if (! value) continue;
        PlotData plot;
        if (const auto* law = std::get_if<Law> (&*value)) plot = plotOf (*law, sheet.x_unit, sheet.unit);
        if (const auto* curve = std::get_if<Curve> (&*value)) plot = plotOf (*curve, sheet.x_unit, sheet.unit);
        if (auto modes = modesIn (sheet, *value)) plot = std::move (*modes);
        if (plot.x.size() > 1 || (plot.kind == PlotData::Kind::stems && ! plot.x.empty())) return plot;
    }
    return std::nullopt;
}

/// The envelope of a clip over its time: the largest amplitude in each part.
std::optional<PlotData> envelopeOf (const graph::Graph& graph, const graph::Node& node)
{
    const auto written = node.settings.find ("clip");
    if (node.type != clip_type || written == node.settings.end() || ! written->is_string() || written->asString().empty()) return std::nullopt;
    const auto file = loadClip (resolved (written->asString(), graph.folder), true);
    if (! file) return std::nullopt;
    const ClipScore score (file->clip);
    std::vector<ClipScore::Cursor> cursors (file->clip.tracks.size());
    constexpr int samples_per_point = 64;
    const double step = score.duration() / (curve_points * samples_per_point);
    if (! (step > 0.0)) return std::nullopt;
    PlotData plot { .x_unit = "s", .y_unit = "1" };
    for (int i = 0; i < curve_points; ++i)
    {
        double most = 0.0;
        for (int k = 0; k < samples_per_point; ++k)
            most = std::max (most, std::abs (score ((i * samples_per_point + k) * step, 0.0, cursors.data()).amplitude));
        plot.x.push_back (i * samples_per_point * step);
        plot.y.push_back (most);
    }
    return plot;
}

const PortSheet* outputOf (const NodeType& type, Quantity quantity, int width)
{
    const auto fits = [&] (const PortSheet& p) { return p.width == width && ! p.list && quantityIn (p.unit) == quantity; };
    const auto found = std::ranges::find_if (type.outputs, fits);
    return found == type.outputs.end() ? nullptr : &*found;
}

/// The force along a stroke in a direction, at evenly spaced places up to a distance.
PlotData strokeOf (TrialNode& trial, const PortSheet& force, std::string_view tool, const Vec3& direction, double distance)
{
    PlotData plot { .x_unit = "m", .y_unit = symbolIn (force.unit), .quantity = quantityIn (force.unit) };
    for (int i = 0; i <= curve_points; ++i)
    {
        const double at = distance * i / curve_points;
        trial.set (tool, at * direction);
        trial.tick();
        plot.x.push_back (at);
        const auto along = [&] { return trial.output (force.id, 0) * direction.x() + trial.output (force.id, 1) * direction.y(); };
        plot.y.push_back (force.width == 1 ? trial.output (force.id) : -along());
    }
    return plot;
}

std::optional<PlotData> ridgeCurve (TrialNode& trial, const NodeType& type)
{
    constexpr double periods = 3.0;
    const auto& look = *type.appearance;
    const double frequency = trial.param (look.frequency, 0.0), angle = trial.param (look.angle, 0.0);
    const auto* force = outputOf (type, Quantity::force, 1);
    if (! (frequency > 0.0) || force == nullptr || look.tool.empty()) return std::nullopt;
    return strokeOf (trial, *force, look.tool, { std::cos (angle), std::sin (angle), 0.0 }, periods / frequency);
}

std::optional<PlotData> dragCurve (TrialNode& trial, const NodeType& type)
{
    constexpr double lengths = 5.0;
    const auto* force = outputOf (type, Quantity::force, 3);
    const auto scale = std::ranges::find_if (type.params, [] (const PortSheet& p) { return p.width == 1 && quantityIn (p.unit) == Quantity::length; });
    if (force == nullptr || scale == type.params.end() || type.appearance->tool.empty()) return std::nullopt;
    return strokeOf (trial, *force, type.appearance->tool, Vec3::UnitX(), lengths * trial.param (scale->id, 0.0));
}

/// The end of a useful sweep of a node's input: somewhat beyond the largest param that is compared with it.
double reachOf (const TrialNode& trial, const NodeType& type, const PortSheet& input)
{
    const bool is_fixed = input.unit.kind == UnitRule::Kind::fixed;
    double reach = 0.0;
    for (const auto& p : type.params)
    {
        const bool is_same_unit = p.unit.kind == UnitRule::Kind::fixed && p.unit.unit == input.unit.unit;
        const bool is_comparable = is_fixed ? is_same_unit : p.unit.kind == UnitRule::Kind::same;
        const double value = std::abs (trial.param (p.id, 0.0));
        if (is_comparable && p.width == 1 && std::isfinite (value)) reach = std::max (reach, 1.5 * value);
    }
    return reach > 0.0 || is_fixed ? reach : 1.0;
}

bool isStraight (const PlotData& plot)
{
    const double height = std::ranges::max (plot.y) - std::ranges::min (plot.y);
    const auto n = static_cast<double> (plot.y.size() - 1);
    for (std::size_t i = 0; i < plot.y.size(); ++i)
        if (std::abs (plot.y[i] - (plot.y.front() + (plot.y.back() - plot.y.front()) * static_cast<double> (i) / n)) > 0.01 * height) return false;
    return true;
}

/// The output over the only input. Empty if the output depends on anything earlier, or is a straight line.
std::optional<PlotData> characteristic (TrialNode& trial, const NodeType& type)
{
    if (type.inputs.size() != 1 || type.inputs.front().width != 1 || type.outputs.empty() || type.outputs.front().width != 1) return std::nullopt;
    const auto &input = type.inputs.front(), &output = type.outputs.front();
    const double reach = reachOf (trial, type, input);
    if (! (reach > 0.0)) return std::nullopt;
    const double low = quantityIn (input.unit) == Quantity::length ? -0.25 * reach : -reach;
    const auto answer = [&] (double x) {
        trial.set (input.id, Vec3 (x, 0.0, 0.0));
        trial.tick();
        return trial.output (output.id);
    };
    PlotData plot { .x_unit = symbolIn (input.unit), .y_unit = symbolIn (output.unit), .quantity = quantityIn (output.unit) };
    for (int i = 0; i <= curve_points; ++i)
    {
        plot.x.push_back (low + (reach - low) * i / curve_points);
        plot.y.push_back (answer (plot.x.back()));
        if (answer (plot.x.back()) != plot.y.back()) return std::nullopt;
    }
    for (std::size_t i = plot.x.size(); i-- > 0;)
        if (answer (plot.x[i]) != plot.y[i]) return std::nullopt;
    return isStraight (plot) ? std::nullopt : std::optional (std::move (plot));
}

/// The answer of the node itself. A plugin's node that fails has no curve; compile() says so.
std::optional<PlotData> answerOf (const graph::Graph& graph, const SeenPatch& patch, const graph::Node& node, const Face& face)
{
    try
    {
        auto trial = TrialNode::make (graph, patch, node, face);
        if (! trial) return std::nullopt;
        const auto& type = *face.type;
        if (! type.appearance) return characteristic (*trial, type);
        if (type.appearance->kind == Appearance::Kind::ridges) return ridgeCurve (*trial, type);
        return type.appearance->kind == Appearance::Kind::contact ? dragCurve (*trial, type) : std::nullopt;
    }
    catch (const NodeFault&)
    {
        return std::nullopt;
    }
}
}   // namespace

std::shared_ptr<const PlotData> curveOf (const graph::Graph& graph, const SeenPatch& patch, const graph::Node& node, const Face& face)
{
    if (face.kind != Face::Kind::node || face.type == nullptr) return nullptr;
    auto plot = envelopeOf (graph, node);
    if (! plot) plot = curveInSettings (graph, patch, node, face);
    if (! plot) plot = answerOf (graph, patch, node, face);
    if (! plot || ! std::ranges::all_of (plot->y, [] (double y) { return std::isfinite (y); })) return nullptr;
    return std::make_shared<const PlotData> (std::move (*plot));
}

std::string NodeCurves::keyOf (const graph::Graph& graph, const SeenPatch& patch, const graph::Node& node, const Face& face)
{
    auto key = node.type + node.settings.dump();
    for (const auto& port : face.params)
        if (port.sheet != nullptr && ! port.sheet->list) key += '|' + paramNow (graph, patch, node, port).value.dump();
    return key;
}

std::shared_ptr<const PlotData> NodeCurves::of (const graph::Graph& graph, const SeenPatch& patch, const graph::Node& node, const Face& face)
{
    if (face.kind != Face::Kind::node || face.type == nullptr) return nullptr;
    const auto& type = *face.type;
    const bool may_have_one = ! type.settings.empty() || type.appearance || (type.inputs.size() == 1 && type.inputs.front().width == 1);
    if (! may_have_one) return nullptr;
    auto key = keyOf (graph, patch, node, face);
    auto& entry = known[node.id];
    if (entry.key != key) entry = { std::move (key), curveOf (graph, patch, node, face) };
    return entry.curve;
}

void paintSmallCurve (juce::Graphics& g, juce::Rectangle<float> area, const PlotData& plot, const Theme& theme, float alpha)
{
    if (plot.x.empty()) return;
    constexpr float thickness = 1.25f;
    const bool has_stems = plot.kind == PlotData::Kind::stems;
    const double last = std::ranges::max (plot.x);
    const double left = has_stems ? 0.0 : std::ranges::min (plot.x), right = has_stems ? 1.1 * last : last;
    const double low = std::min (0.0, std::ranges::min (plot.y)), high = std::max (0.0, std::ranges::max (plot.y));
    if (! (right > left) || ! (high > low)) return;
    const auto inner = area.reduced (0.0f, thickness);
    const auto toX = [&] (double x) { return inner.getX() + inner.getWidth() * static_cast<float> ((x - left) / (right - left)); };
    const auto toY = [&] (double y) { return inner.getBottom() - inner.getHeight() * static_cast<float> ((y - low) / (high - low)); };
    g.setColour (theme.hairline.withMultipliedAlpha (alpha));
    g.fillRect (juce::Rectangle<float> (area.getX(), toY (0.0) - 0.5f, area.getWidth(), 1.0f));
    g.setColour ((plot.quantity == Quantity::any ? theme.dim : theme.of (plot.quantity)).withMultipliedAlpha (alpha));
    if (has_stems)
    {
        for (std::size_t i = 0; i < plot.x.size(); ++i)
            g.fillRect (juce::Rectangle<float> (toX (plot.x[i]) - 1.0f, toY (plot.y[i]), 2.0f, toY (0.0) - toY (plot.y[i])));
        return;
    }
    juce::Path line;
    for (std::size_t i = 0; i < plot.x.size(); ++i)
    {
        const juce::Point<float> p { toX (plot.x[i]), toY (plot.y[i]) };
        i == 0 ? line.startNewSubPath (p) : line.lineTo (p);
    }
    g.strokePath (line, juce::PathStrokeType (thickness, juce::PathStrokeType::beveled));   // curved joints fail an assertion of JUCE where a line turns back
}

}   // namespace tactus::host
