// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "energy_meter.hpp"
#include "trace_drawing.hpp"

namespace tactus::host
{

/// Plots the dissipated energy, the stored energy stacked on top, and the work of the hand as a line. Where the line is on the upper edge,
/// all energy is accounted for.
class EnergyPlot final : public ScopePlot
{
public:
    using ScopePlot::ScopePlot;

    void show (const Signals&) override;
    std::vector<Action> actions() override;
    TraceList made() const override { return meter.traces(); }

    const EnergyBalance& balance() const noexcept { return meter.balance(); }

private:
    void paintLane (juce::Graphics&, const Lane&, std::size_t) override;
    void paintOver (juce::Graphics&) override;
    juce::String emptyText() const override;
    juce::TextLayout layout() const;   // of the text

    static constexpr float margin = 8.0f;   // at the left and the right of the text

    EnergyMeter meter;
    bool is_reset = false;   // and nothing has been counted since
    MovingColumns work, stored, dissipated;
    double rate_hz = 1.0, zero = 0.0;
    juce::String text;   // what is said about the balance
    bool has_legend = true;
};

}   // namespace tactus::host
