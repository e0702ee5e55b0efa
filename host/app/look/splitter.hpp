// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/look.hpp>
#include <host/app/text/filled.hpp>

#include <functional>
#include <optional>

namespace tactus::host
{

/// The draggable edge of a panel: drawn as a hairline, but wider for the mouse. A double click folds or unfolds the panel; if it cannot be folded,
/// it gets its initial size again. A panel has its initial size until it is dragged, at the bottom of a high window a larger one; from then on, it
/// keeps its share of the window.
class Splitter final : public juce::Component
{
public:
    static constexpr int thickness = 6;

    enum class Edge
    {
        left,    ///< the left edge of a panel on the right
        right,   ///< the right edge of a panel on the left
        top      ///< the top edge of a panel at the bottom
    };

    enum class Folds
    {
        yes,
        no
    };

    Splitter (Edge e, int initial, int least, Folds f = Folds::yes) : edge (e), folds (f == Folds::yes), initial_extent (initial), least_extent (least)
    {
        setMouseCursor (edge == Edge::top ? juce::MouseCursor::UpDownResizeCursor : juce::MouseCursor::LeftRightResizeCursor);
        setTitle (TRANS ("Panel edge"));
    }

    /// The panel's share of the width or height of the window; 0 if it is folded, nothing if it has its initial size.
    std::optional<double> share() const { return is_folded ? 0.0 : dragged; }
    void setShare (double s) { restore (s <= 0.0 ? 0.0 : s); }

    /// The panel as it was when share() returned this.
    void restore (std::optional<double> s)
    {
        is_folded = folds && s == 0.0;
        if (s != 0.0) dragged = s;
    }

    bool isFolded() const noexcept { return is_folded; }
    void fold (bool folded) { is_folded = folded; }
    void beginAt (int extent) { initial_extent = extent; }   ///< another initial size

    std::function<void()> onMove;
    std::function<void()> onMoved;   ///< called when a drag has ended, and after a double click

    /// Cuts the panel's part off an area, and moves the splitter to its edge. Leaves at least `least_rest` pixels of the area.
    juce::Rectangle<int> take (juce::Rectangle<int>& area, int least_rest)
    {
        const int room = edge == Edge::top ? area.getHeight() : area.getWidth();
        most_extent = std::max (0, room - least_rest);
        const int n = std::clamp (extent(), 0, most_extent);
        juce::Rectangle<int> panel;
        switch (edge)
        {
        case Edge::left:
            panel = area.removeFromRight (n);
            setBounds (panel.getX() - thickness / 2, panel.getY(), thickness, panel.getHeight());
            break;
        case Edge::right:
            panel = area.removeFromLeft (n);
            setBounds (panel.getRight() - thickness / 2, panel.getY(), thickness, panel.getHeight());
            break;
        case Edge::top:
            panel = area.removeFromBottom (n);
            setBounds (panel.getX(), panel.getY() - thickness / 2, panel.getWidth(), thickness);
            break;
        }
        return panel;
    }

    void paint (juce::Graphics& g) override
    {
        const auto& theme = themeOf (*this);
        const int line = isMouseOverOrDragging() ? 2 : 1;
        const bool is_level = edge == Edge::top;
        g.setColour (isMouseOverOrDragging() ? theme.accent : theme.hairline);
        const auto area = getLocalBounds();
        g.fillRect (is_level ? area.withSizeKeepingCentre (getWidth(), line) : area.withSizeKeepingCentre (line, getHeight()));
    }

    void mouseEnter (const juce::MouseEvent&) override { repaint(); }
    void mouseExit (const juce::MouseEvent&) override { repaint(); }
    void mouseDown (const juce::MouseEvent&) override { grabbed = std::min (extent(), most_extent); }

    void mouseDrag (const juce::MouseEvent& e) override
    {
        const auto way = e.getEventRelativeTo (getParentComponent()).getOffsetFromDragStart();
        const int grown = edge == Edge::top ? -way.y : way.x;
        const int wanted = grabbed + (edge == Edge::left ? -grown : grown);
        setShare (folds && wanted < least_extent / 2 ? 0.0 : static_cast<double> (std::max (std::min (wanted, most_extent), least_extent)) / whole());
        if (onMove) onMove();
    }

    void mouseUp (const juce::MouseEvent&) override
    {
        if (onMoved) onMoved();
    }

    void mouseDoubleClick (const juce::MouseEvent&) override
    {
        if (folds)
            is_folded = ! is_folded;
        else
            dragged.reset();
        if (onMove) onMove();
        if (onMoved) onMoved();
    }

private:
    int whole() const { return std::max (1, edge == Edge::top ? getParentHeight() : getParentWidth()); }

    int extent() const
    {
        if (is_folded) return 0;
        if (dragged) return std::max (juce::roundToInt (*dragged * whole()), least_extent);
        constexpr double least_share = 0.24;   // of a high window, for a panel at the bottom
        return edge == Edge::top ? std::max (initial_extent, juce::roundToInt (least_share * whole())) : initial_extent;
    }

    const Edge edge;
    const bool folds;
    int initial_extent;
    const int least_extent;
    std::optional<double> dragged;   // the share of the window
    bool is_folded = false;
    int most_extent = 0;   // that the rest of the window leaves, as of the last layout
    int grabbed = 0;
};

}   // namespace tactus::host
