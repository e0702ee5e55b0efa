// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scope_plot.hpp"
#include "spectrogram_image.hpp"

namespace tactus::host
{

/// Shows the frequencies of a signal while the graph runs: time to the right, frequency upwards, amplitude as colour.
class SpectrogramPlot final : public ScopePlot
{
public:
    SpectrogramPlot (ScopeSpec&, ScopeContext&);

    void show (const Signals&) override;
    std::vector<Action> actions() override;

    const SpectrogramImage& picture() const noexcept { return scrolling; }

private:
    void paintLane (juce::Graphics&, const Lane&, std::size_t) override;
    void paintOver (juce::Graphics&) override;
    juce::String emptyText() const override;
    void zoomX (double factor, const Lane&, float) override { spec.seconds = std::clamp (spec.seconds * factor, 1.0, Trace::seconds); }
    Extent frequencies (double rate_hz) const;
    Action rangeAction();
    void describe (const std::string& unit);

    static constexpr float bar_room = 58.0f;   // for the colours and their numbers

    SpectrogramImage scrolling;
    std::string unit;
    int since_described = 0;
};

}   // namespace tactus::host
