// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trace_drawing.hpp"

namespace tactus::host
{

/// An oscilloscope, with a lane for each unit.
class TimePlot final : public ScopePlot
{
public:
    using ScopePlot::ScopePlot;

    void show (const Signals&) override;
    std::vector<Action> actions() override;
    void mouseDown (const juce::MouseEvent&) override;
    void mouseDrag (const juce::MouseEvent&) override;

    const TickWindow& window() const noexcept { return seen; }

private:
    struct Line
    {
        std::size_t lane = 0;
        juce::Colour colour;
        juce::String port;        // "stylus.position"
        juce::String component;   // the component of a vector, such as "x"
    };

    void paintLane (juce::Graphics&, const Lane&, std::size_t) override;
    std::vector<Entry> legendOf (std::size_t lane) const;
    void paintOver (juce::Graphics&) override;
    juce::String emptyText() const override;
    std::optional<Cursor> onCurve (const Cursor&) const override;
    bool hasTrigger() const noexcept { return spec.trigger.edge != ScopeTrigger::Edge::off; }
    float levelPixel() const { return lanes.front().toPixels (0.0, spec.trigger.level).y; }

    TickWindow seen;
    std::vector<Line> lines;
    std::vector<MovingColumns> columns;   // by line
    double rate_hz = 1.0, zero = 0.0, back_before = 0.0;
    bool drags_level = false;
};

}   // namespace tactus::host
