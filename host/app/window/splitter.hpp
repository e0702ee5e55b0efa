// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/look.hpp>

#include <functional>

namespace tactus::host
{

/// The edge between two panels: a hairline that can be dragged, wider to the pointer than to the eye. A double click folds
/// the panel away and back.
class Splitter final : public juce::Component
{
public:
    static constexpr int thickness = 6;

    enum class Edge
    {
        left,    ///< of a panel at the right
        right,   ///< of a panel at the left
        top      ///< of a panel at the bottom
    };

    Splitter (Edge e, int initial, int least) : edge (e), extent (initial), least_extent (least), unfolded (initial)
    {
        setMouseCursor (edge == Edge::top ? juce::MouseCursor::UpDownResizeCursor : juce::MouseCursor::LeftRightResizeCursor);
        setTitle ("Edge of a panel");
    }

    /// How wide, or high, the panel is; 0 if it is folded away.
    int size() const noexcept { return extent; }
    void setSize (int s) { extent = s <= 0 ? 0 : std::max (s, least_extent); }
    bool isFolded() const noexcept { return extent == 0; }

    std::function<void()> onMove;

    /// Takes the panel's part of an area, and puts itself on the edge.
    juce::Rectangle<int> take (juce::Rectangle<int>& area, int left_for_others)
    {
        const int room = edge == Edge::top ? area.getHeight() : area.getWidth();
        const int n = std::clamp (extent, 0, std::max (0, room - left_for_others));
        const auto panel = edge == Edge::left ? area.removeFromRight (n) : edge == Edge::right ? area.removeFromLeft (n)
                                                                                               : area.removeFromBottom (n);
        if (edge == Edge::top)
            setBounds (panel.getX(), panel.getY() - thickness / 2, panel.getWidth(), thickness);
        else
            setBounds ((edge == Edge::left ? panel.getX() : panel.getRight()) - thickness / 2, panel.getY(), thickness, panel.getHeight());
        return panel;
    }

    void paint (juce::Graphics& g) override
    {
        const auto& theme = themeOf (*this);
        g.setColour (isMouseOverOrDragging() ? theme.accent : theme.hairline);
        g.fillRect (edge == Edge::top ? getLocalBounds().withSizeKeepingCentre (getWidth(), isMouseOverOrDragging() ? 2 : 1) : getLocalBounds().withSizeKeepingCentre (isMouseOverOrDragging() ? 2 : 1, getHeight()));
    }

    void mouseEnter (const juce::MouseEvent&) override { repaint(); }
    void mouseExit (const juce::MouseEvent&) override { repaint(); }
    void mouseDown (const juce::MouseEvent&) override { grabbed = extent; }

    void mouseDrag (const juce::MouseEvent& e) override
    {
        const auto way = e.getEventRelativeTo (getParentComponent()).getOffsetFromDragStart();
        const int wanted = grabbed + (edge == Edge::left ? -way.x : edge == Edge::right ? way.x
                                                                                        : -way.y);
        setSize (wanted < least_extent / 2 ? 0 : wanted);
        if (onMove) onMove();
    }

    void mouseDoubleClick (const juce::MouseEvent&) override
    {
        if (isFolded())
            setSize (unfolded);
        else
        {
            unfolded = extent;
            setSize (0);
        }
        if (onMove) onMove();
    }

private:
    const Edge edge;
    int extent, least_extent, unfolded, grabbed = 0;
};

}   // namespace tactus::host
