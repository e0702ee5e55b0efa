// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/inspector/modulation.hpp>
#include <host/app/look/drag_way.hpp>
#include <host/app/look/look.hpp>

#include <functional>

namespace tactus::host
{

/// A small dial that shows how far a modulator moves a parameter around its value. Drag up or down to change the depth (shift: fine), also with the arrow
/// keys. Double-click or press Return to type it. A drag to 0, or Delete, ends the modulation.
class DepthRing final : public juce::Component, public juce::SettableTooltipClient
{
public:
    static constexpr int width = 26;

    DepthRing();

    /// `value`: of the parameter, in SI; `name`: of the parameter.
    void show (const Modulation&, double value, const PortSheet&, const juce::String& name);
    const Modulation& shown() const noexcept { return modulation; }

    std::function<void (double depth, bool continues)> onChange;
    std::function<void (bool continues)> onEnd;
    std::function<void (const juce::String& begun)> onType;   ///< opens a field for the depth; `begun`: what is typed already
    std::function<void (const juce::String&)> onHint;

    void paint (juce::Graphics&) override;
    void mouseDown (const juce::MouseEvent&) override;
    void mouseDrag (const juce::MouseEvent&) override;
    void mouseUp (const juce::MouseEvent&) override;
    void mouseEnter (const juce::MouseEvent&) override { repaint(); }
    void mouseExit (const juce::MouseEvent&) override { repaint(); }
    void focusGained (FocusChangeType) override { repaint(); }
    void focusLost (FocusChangeType) override { repaint(); }
    bool keyPressed (const juce::KeyPress&) override;

private:
    void moveTo (double depth);

    Modulation modulation;
    double value = 0.0, low = 0.0, high = 1.0, span = 1.0, grabbed = 0.0;
    bool is_logarithmic = false, is_held = false, has_moved = false;
    DragWay way { DragWay::Along::up };
};

/// Paints the part of a dial that a modulator covers: from one part of its scale to another, 0 to 1.
void paintDepth (juce::Graphics&, juce::Point<float> centre, float radius, float thickness, double from, double to, juce::Colour);

}   // namespace tactus::host
