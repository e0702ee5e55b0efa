// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/look.hpp>
#include <tactus/run/log/stretch.hpp>

#include <functional>

namespace tactus::host
{

/// A recorded port over time, with a marked stretch. Dragging marks a stretch or moves its edge, a double-click marks and shows everything, the wheel
/// zooms, and the arrow keys move the stretch (with Shift: its end).
class TakePlot final : public juce::Component
{
public:
    TakePlot();

    void show (Stretch);   ///< keeps the zoomed part, if the recording is as long; if it has no ticks, shows the text
    void setText (const juce::String&);

    /// Draws a copy of the curve that is shown now behind those that are shown later, if they have its unit. Both begin with their takes.
    void pin (const juce::String& name);
    void unpin();
    bool hasPinned() const noexcept { return pinned.ticks() > 0; }

    void mark (double from_s, double until_s);
    double from() const noexcept { return from_s; }
    double until() const noexcept { return until_s; }
    double length() const noexcept { return shown.rate_hz > 0.0 ? static_cast<double> (shown.ticks()) / shown.rate_hz : 0.0; }

    std::function<void()> onMark;
    std::function<void (const juce::String&)> onHint;   ///< receives a description of what the mouse can do here, or ""

    void paint (juce::Graphics&) override;
    void resized() override { columnsOf(); }
    void mouseDown (const juce::MouseEvent&) override;
    void mouseDrag (const juce::MouseEvent&) override;
    void mouseDoubleClick (const juce::MouseEvent&) override;
    void mouseMove (const juce::MouseEvent&) override;
    void mouseWheelMove (const juce::MouseEvent&, const juce::MouseWheelDetails&) override;
    void mouseExit (const juce::MouseEvent&) override;
    bool keyPressed (const juce::KeyPress&) override;
    void focusGained (FocusChangeType) override { repaint(); }
    void focusLost (FocusChangeType) override { repaint(); }

private:
    enum class Edge
    {
        none,
        from,
        until
    };

    juce::Rectangle<float> area() const { return getLocalBounds().toFloat().reduced (1.0f).withTrimmedBottom (16.0f); }
    float xAt (double s) const;
    double begins() const noexcept { return shown.rate_hz > 0.0 ? static_cast<double> (shown.from) / shown.rate_hz : 0.0; }   ///< in the take, in s
    double timeAt (float x) const;
    void setView (double from, double until);
    double viewLength() const noexcept { return std::max (1e-9, view_until - view_from); }
    Edge edgeAt (float x) const;
    void columnsOf();
    bool showsPinned() const noexcept { return hasPinned() && pinned.unit == shown.unit && pinned.names.size() == shown.names.size(); }
    void findRange();
    void paintPinned (juce::Graphics&) const;
    void paintPinnedName (juce::Graphics&) const;
    void paintCurves (juce::Graphics&) const;
    void paintMark (juce::Graphics&) const;
    void paintScale (juce::Graphics&) const;
    juce::Colour colourOf (std::size_t component) const;

    float yAt (double value) const;

    Stretch shown, pinned;
    juce::String pinned_name;
    juce::String text;
    double from_s = 0.0, until_s = 0.0, pressed_s = 0.0;
    Edge held = Edge::none;
    double low = 0.0, high = 0.0;
    double view_from = 0.0, view_until = 0.0;                      // the part that the plot shows, in s
    std::vector<std::vector<std::pair<double, double>>> columns;   // by component: the lowest and highest value of each column of pixels
};

}   // namespace tactus::host
