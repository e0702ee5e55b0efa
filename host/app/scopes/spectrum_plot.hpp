// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scope_plot.hpp"

#include <host/tools/figures/spectrum.hpp>

namespace tactus::host
{

/// Plots the spectra of signals, from 1 Hz to half the rate.
class SpectrumPlot final : public ScopePlot
{
public:
    using ScopePlot::ScopePlot;

    void show (const Signals&) override;
    std::vector<Action> actions() override;

    const std::optional<Peak>& peak() const noexcept { return highest; }

private:
    struct Line
    {
        std::size_t lane = 0;
        juce::Colour colour;
        Spectrum spectrum;
        juce::Path path;
    };
    static constexpr int every = 3;   // every third refresh updates the plot; faster updates could not be read
    static constexpr double lowest_hz = 1.0, decades_down = 5.0, most_s = 4.0;

    void paintLane (juce::Graphics&, const Lane&, std::size_t) override;
    void paintOver (juce::Graphics&) override;
    juce::String emptyText() const override;
    std::optional<Cursor> onCurve (const Cursor&) const override;
    double readLines (const Signals&);
    void scale (Lane&, std::size_t index, double rate);
    double height (double amplitude) const;
    juce::Path pathOf (const Spectrum&, const Lane&) const;
    void zoomX (double factor, const Lane&, float) override { spec.seconds = std::clamp (spec.seconds * factor, 0.1, most_s); }

    std::vector<Line> lines;
    std::vector<std::string> units;
    std::optional<Peak> highest;
    std::size_t missing = 0;
    int refreshes = 0;
};

}   // namespace tactus::host
