// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "block.hpp"
#include "plot_box.hpp"

#include <host/app/look/fitted_text.hpp>
#include <tactus/text/result.hpp>

#include <functional>

namespace tactus::host
{

/// A plot of the value of a setting, or the reason why there is none.
class PlotBlock final : public Block
{
public:
    explicit PlotBlock (std::function<Result<PlotData>()> g) : get (std::move (g)) {}

    int heightFor (int) override { return 132; }

    void refresh (const graph::Node*) override
    {
        shown = get();
        repaint();
    }

    const Result<PlotData>& plot() const noexcept { return shown; }

    void paint (juce::Graphics& g) override
    {
        const auto& look = lookOf (*this);
        const auto area = getLocalBounds().reduced (0, 4).toFloat();
        paintPlot (g, area, shown ? *shown : PlotData {}, look);
        if (shown) return;
        juce::AttributedString s;
        s.append (fromUtf8 (shown.error().text), look.font (12.0f), look.theme().dim);
        s.setJustification (juce::Justification::centred);
        s.draw (g, area.reduced (12.0f));
    }

private:
    std::function<Result<PlotData>()> get;
    Result<PlotData> shown { PlotData {} };
};

}   // namespace tactus::host
