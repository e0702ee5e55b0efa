// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scope_plot.hpp"

#include <deque>

namespace tactus::host
{

/// Friction at the tool from above, as Fig. 4 of the chapter draws it: the tool, the anchor it holds on to, the stretch
/// between them, the circle within which it sticks, and the force.
class ToolPlot final : public ScopePlot
{
public:
    using ScopePlot::ScopePlot;

    void show (const Signals&) override;
    const std::optional<ToolPicture>& picture() const noexcept { return now; }

private:
    static constexpr std::size_t longest_trail = 45;

    void paintLane (juce::Graphics&, const Lane&, std::size_t) override;
    void paintOver (juce::Graphics&) override;
    juce::String emptyWords() const override;
    void zoomX (double, const Lane&, float) override {}

    std::optional<ToolPicture> now;
    std::deque<Vec3> tool_trail, anchor_trail;
    Vec3 centre = Vec3::Zero();
    double half_width = 0.0;   // m, eased
    double most_force = 0.0;   // N, eased
};

}   // namespace tactus::host
