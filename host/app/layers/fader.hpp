// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/drag_way.hpp>
#include <host/app/look/look.hpp>

#include <functional>
#include <optional>

namespace tactus::host
{

/// A gain fader. Dragging with Shift moves it in fine steps, a double click sets 0 dB, and an Alt-click restores the default. The
/// wheel and the arrow keys change it in small steps.
class Fader final : public juce::Component, public juce::SettableTooltipClient
{
public:
    Fader();

    void show (double gain);

    /// Without a gain: resets to the default. `goes_on`: continues the previous change of the same drag.
    std::function<void (std::optional<double> gain, bool goes_on)> onChange;
    void paint (juce::Graphics&) override;
    void mouseDown (const juce::MouseEvent&) override;
    void mouseDrag (const juce::MouseEvent&) override;
    void mouseUp (const juce::MouseEvent&) override;
    void mouseDoubleClick (const juce::MouseEvent&) override;
    void mouseWheelMove (const juce::MouseEvent&, const juce::MouseWheelDetails&) override;
    bool keyPressed (const juce::KeyPress&) override;
    void focusGained (FocusChangeType) override { repaint(); }
    void focusLost (FocusChangeType) override { repaint(); }
    std::unique_ptr<juce::AccessibilityHandler> createAccessibilityHandler() override;
    void mouseEnter (const juce::MouseEvent&) override { repaint(); }
    void mouseExit (const juce::MouseEvent&) override { repaint(); }

private:
    juce::Rectangle<float> slot() const { return getLocalBounds().toFloat().reduced (0.0f, 8.0f); }
    void moveTo (double position);
    void nudge (double decibels);

    double gain = 1.0, grabbed = 0.0;   // grabbed: the fader position at the start of a drag
    DragWay way { DragWay::Along::up };
    bool dragged = false;
    std::uint32_t turned_at = 0;   // by the wheel, in ms
};

}   // namespace tactus::host
