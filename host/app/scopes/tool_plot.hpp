// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scope_plot.hpp"

#include <deque>

namespace tactus::host
{

/// Friction at the tool seen from above, as in Fig. 4 of the chapter: the tool, its anchor, the bristle between them, the circle within which
/// it sticks, and the force.
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
    juce::String emptyText() const override;
    void zoomX (double, const Lane&, float) override {}

    std::optional<ToolPicture> now;
    std::deque<Vec3> tool_trail, anchor_trail;
    Vec3 centre = Vec3::Zero();
    double half_width = 0.0;   // half the width of the view, in m; follows changes gradually
    double most_force = 0.0;   // the largest recent force, in N, shown by the longest arrow; falls gradually
};

}   // namespace tactus::host
