// SPDX-License-Identifier: GPL-3.0-or-later
#include "patch.hpp"

#include <cmath>

namespace tactus::host
{

namespace
{
std::optional<juce::Point<double>> pointOf (const Json& pair)
{
    if (! pair.is_array() || pair.size() != 2 || ! pair[0].is_number() || ! pair[1].is_number()) return std::nullopt;
    const juce::Point<double> p { pair[0].get<double>(), pair[1].get<double>() };
    constexpr double furthest = 1e6;
    if (! (std::abs (p.x) < furthest && std::abs (p.y) < furthest)) return std::nullopt;
    return p;
}
}   // namespace

std::optional<juce::Point<double>> readPoint (const Json& object, const char* key)
{
    const auto pair = object.find (key);
    return pair == object.end() ? std::nullopt : pointOf (*pair);
}

std::optional<juce::Point<double>> positionOf (const graph::Node& node)
{
    const auto ui = node.extra.find ("ui");
    return ui != node.extra.end() && ui->is_object() ? readPoint (*ui, "at") : std::nullopt;
}

std::vector<juce::Point<double>> bendsOf (const graph::Wire& wire)
{
    const auto ui = wire.extra.find ("ui");
    if (ui == wire.extra.end() || ! ui->is_object()) return {};
    const auto all = ui->find ("bends");
    if (all == ui->end() || ! all->is_array()) return {};
    std::vector<juce::Point<double>> bends;
    for (const auto& pair : *all)
    {
        const auto p = pointOf (pair);
        if (! p) return {};
        bends.push_back (*p);
    }
    return bends;
}

graph::Wire withBends (graph::Wire wire, const std::vector<juce::Point<double>>& bends)
{
    auto ui = wire.extra.value ("ui", Json::object());
    if (! ui.is_object()) ui = Json::object();
    auto all = Json::array();
    for (const auto& b : bends)
        all.push_back (Json::array ({ std::round (b.x), std::round (b.y) }));
    if (bends.empty())
        ui.erase ("bends");
    else
        ui["bends"] = std::move (all);
    if (ui.empty())
        wire.extra.erase ("ui");
    else
        wire.extra["ui"] = std::move (ui);
    return wire;
}

}   // namespace tactus::host
