// SPDX-License-Identifier: GPL-3.0-or-later
#include "patch.hpp"

#include <cmath>

namespace tactus::host
{

std::optional<juce::Point<double>> readPoint (const Json& object, const char* key)
{
    const auto pair = object.find (key);
    if (pair == object.end() || ! pair->is_array() || pair->size() != 2 || ! (*pair)[0].is_number() || ! (*pair)[1].is_number()) return std::nullopt;
    const juce::Point<double> p { (*pair)[0].get<double>(), (*pair)[1].get<double>() };
    constexpr double furthest = 1e6;
    if (! (std::abs (p.x) < furthest && std::abs (p.y) < furthest)) return std::nullopt;
    return p;
}

std::optional<juce::Point<double>> positionOf (const graph::Node& node)
{
    const auto ui = node.extra.find ("ui");
    return ui != node.extra.end() && ui->is_object() ? readPoint (*ui, "at") : std::nullopt;
}

}   // namespace tactus::host
