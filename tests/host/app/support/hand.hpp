// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_gui_basics/juce_gui_basics.h>

namespace tactus::host::test
{

/// A simulated mouse and keyboard for one component. Needs no display.
class Hand
{
public:
    explicit Hand (juce::Component& c) : component (c) {}

    static juce::ModifierKeys left (int keys = 0) { return juce::ModifierKeys (juce::ModifierKeys::leftButtonModifier | keys); }

    juce::MouseEvent event (juce::Point<float> at, juce::ModifierKeys mods, int clicks = 1) const
    {
        const auto now = juce::Time::getCurrentTime();
        const auto mouse = juce::Desktop::getInstance().getMainMouseSource();
        constexpr float pressure = juce::MouseInputSource::defaultPressure;
        return { mouse, at, mods, pressure, 0.0f, 0.0f, 0.0f, 0.0f, &component, &component, now, pressed_at, now, clicks, dragged };
    }

    void move (juce::Point<float> at) { component.mouseMove (event (at, {})); }

    void press (juce::Point<float> at, juce::ModifierKeys mods = left())
    {
        pressed_at = at;
        dragged = false;
        component.mouseDown (event (at, mods));
    }

    void dragTo (juce::Point<float> at, juce::ModifierKeys mods = left())
    {
        dragged = true;
        component.mouseDrag (event (at, mods));
    }

    void release (juce::Point<float> at, juce::ModifierKeys mods = left()) { component.mouseUp (event (at, mods)); }

    void click (juce::Point<float> at, juce::ModifierKeys mods = left())
    {
        press (at, mods);
        release (at, mods);
    }

    void doubleClick (juce::Point<float> at)
    {
        click (at);
        press (at);
        component.mouseDoubleClick (event (at, left(), 2));
        release (at);
    }

    void drag (juce::Point<float> from, juce::Point<float> to, juce::ModifierKeys mods = left())
    {
        press (from, mods);
        for (const float part : { 0.3f, 0.7f, 1.0f })
            dragTo (from + (to - from) * part, mods);
        release (to, mods);
    }

    void wheel (juce::Point<float> at, float up)
    {
        juce::MouseWheelDetails details {};
        details.deltaY = up;
        component.mouseWheelMove (event (at, {}), details);
    }

    bool key (const char* description) { return component.keyPressed (juce::KeyPress::createFromDescription (description)); }

private:
    juce::Component& component;
    juce::Point<float> pressed_at;
    bool dragged = false;
};

}   // namespace tactus::host::test
