// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scope_plot.hpp"
#include "trace_window.hpp"

namespace tactus::host
{

/// One signal against another, such as force against displacement, with a tail that fades. If the state is known, sticking and
/// sliding have different colours, and the older part of the tail has neither.
class OverPlot final : public ScopePlot
{
public:
    using ScopePlot::ScopePlot;

    void show (const Signals&) override;
    std::vector<Action> actions() override;

private:
    enum class Part
    {
        plain,
        open,
        stuck,
        sliding,
        fault
    };
    static constexpr std::size_t ages = 8, fresh_ages = 3, parts = 5;   // the fresh ages have the colours of the states

    void paintLane (juce::Graphics&, const Lane&, std::size_t) override;
    void paintOver (juce::Graphics&) override;
    juce::String emptyText() const override;
    juce::Colour colourOf (Part) const;
    static Part partAt (const Trace* state, std::uint64_t tick);
    void zoomX (double factor, const Lane&, float at) override;
    void draw (const Trace& x, const Trace& y, const Trace* state, std::uint64_t from, std::uint64_t to);

    std::vector<MovingColumns> travels;   // by component of x; its extents
    MovingColumns heights;
    int component = 0;
    Quantity quantity = Quantity::force;
    bool has_state = false;
    /// The tail of one age and state: lines where a tick moves far, and vertical spans where many ticks share a column of pixels.
    struct Piece
    {
        juce::Path lines;
        juce::RectangleList<float> spans;
    };
    std::array<std::array<Piece, parts>, ages> tail;
    std::optional<juce::Point<float>> head;
};

/// The colour of what the tail of a plot with states shows of earlier passes.
juce::Colour colourOfPast (const Theme&);

}   // namespace tactus::host
