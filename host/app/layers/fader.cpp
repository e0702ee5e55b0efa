// SPDX-License-Identifier: GPL-3.0-or-later
#include "fader.hpp"
#include "gain_text.hpp"
#include "strip_view.hpp"
#include "taper.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::host
{

namespace
{
/// Rounds a gain to the precision with which a drag sets it.
double roundedGain (double gain) { return gain < 0.1 ? std::round (gain * 1e4) * 1e-4 : std::round (gain * 1e3) * 1e-3; }
/// The value of a fader, as a screen reader says and sets it, in dB.
class FaderValue final : public juce::AccessibilityValueInterface
{
public:
    FaderValue (const double& g, std::function<void (double)> f) : gain (g), set (std::move (f)) {}

    bool isReadOnly() const override { return false; }
    double getCurrentValue() const override { return decibelsOf (gain); }
    void setValue (double db) override { set (gainOf (db)); }
    void setValueAsString (const juce::String& text) override
    {
        if (const auto db = readGain (text.toStdString(), {})) setValue (*db);
    }
    juce::String getCurrentValueAsString() const override { return juce::String (getCurrentValue(), 1) + " dB"; }
    AccessibleValueRange getRange() const override { return { { silent_db, decibelsOf (Taper::most) }, 0.1 }; }

private:
    const double& gain;
    std::function<void (double)> set;
};
}   // namespace

Fader::Fader()
{
    setMouseCursor (juce::MouseCursor::UpDownResizeCursor);
    setWantsKeyboardFocus (true);
    setMouseClickGrabsKeyboardFocus (false);   // the canvas keeps the keyboard focus during a drag
}

void Fader::show (double g)
{
    if (g == gain) return;
    gain = g;
    repaint();
}

void Fader::moveTo (double position)
{
    const double to = roundedGain (Taper::gain (position));
    if (to == gain) return;
    gain = to;
    repaint();
    const bool goes_on = std::exchange (dragged, true);
    if (onChange) onChange (to, goes_on);
}

void Fader::mouseDown (const juce::MouseEvent& e)
{
    dragged = false;
    turned_at = 0;
    grabbed = Taper::position (gain);
    way = DragWay (DragWay::Along::up);
    if (e.mods.isAltDown() && onChange) onChange (std::nullopt, false);
}

void Fader::mouseDrag (const juce::MouseEvent& e)
{
    if (e.mods.isAltDown()) return;
    moveTo (grabbed + way.to (e) / static_cast<double> (std::max (1.0f, slot().getHeight())));
}

void Fader::mouseUp (const juce::MouseEvent&) { dragged = false; }

void Fader::mouseDoubleClick (const juce::MouseEvent& e)
{
    if (! e.mods.isAltDown() && onChange) onChange (1.0, false);
}

bool Fader::keyPressed (const juce::KeyPress& key)
{
    const double step = key.getModifiers().isShiftDown() ? 0.1 : 1.0;
    if (key.isKeyCode (juce::KeyPress::upKey))
        nudge (step);
    else if (key.isKeyCode (juce::KeyPress::downKey))
        nudge (-step);
    else if (key.isKeyCode (juce::KeyPress::homeKey))
        nudge (-decibelsOf (gain));
    else
        return false;
    return true;
}

void Fader::nudge (double decibels)
{
    turned_at = 0;
    const double before = std::max (decibelsOf (gain), -60.0);   // from off, it starts at the bottom of the usual range
    const double sign = gain < 0.0 ? -1.0 : 1.0;
    if (onChange) onChange (sign * roundedGain (std::min (gainOf (before + decibels), Taper::most)), false);
}

std::unique_ptr<juce::AccessibilityHandler> Fader::createAccessibilityHandler()
{
    const auto set = [this] (double to) {
        if (onChange) onChange (to, false);
    };
    return std::make_unique<juce::AccessibilityHandler> (*this, juce::AccessibilityRole::slider, juce::AccessibilityActions(),
                                                         juce::AccessibilityHandler::Interfaces { std::make_unique<FaderValue> (gain, set) });
}

void Fader::mouseWheelMove (const juce::MouseEvent& e, const juce::MouseWheelDetails& wheel)
{
    const auto* view = findParentComponentOfClass<StripView>();
    if (view != nullptr && view->isScrolling()) return juce::Component::mouseWheelMove (e, wheel);
    const auto now = juce::Time::getMillisecondCounter();
    const auto before = gain;
    dragged = now - turned_at < 500;   // one turn of the wheel is one step of the history
    moveTo (Taper::position (gain) + static_cast<double> (wheel.deltaY) * (e.mods.isShiftDown() ? 0.02 : 0.1));
    dragged = false;
    if (gain != before) turned_at = now;
}

void Fader::paint (juce::Graphics& g)
{
    const auto& theme = themeOf (*this);
    const auto area = slot();
    const auto yOf = [&] (double position) { return area.getBottom() - area.getHeight() * static_cast<float> (position); };

    const auto groove = area.withSizeKeepingCentre (4.0f, area.getHeight());
    g.setColour (theme.hairline);
    g.fillRoundedRectangle (groove, 2.0f);
    const float y = yOf (Taper::position (gain)), unity = yOf (Taper::unity);
    g.setColour (theme.accent.withAlpha (0.6f));
    g.fillRoundedRectangle (groove.withTop (y), 2.0f);
    g.setColour (theme.dim);
    g.fillRect (area.getX() + 2.0f, unity - 0.5f, 5.0f, 1.0f);
    g.fillRect (area.getRight() - 7.0f, unity - 0.5f, 5.0f, 1.0f);

    const auto knob = juce::Rectangle<float> (area.getWidth() - 4.0f, 12.0f).withCentre ({ area.getCentreX(), y });
    const bool beyond = gain > Taper::most || gain < 0.0;
    g.setColour (theme.raised.interpolatedWith (theme.text, isMouseOverOrDragging() ? 0.35f : 0.2f));
    g.fillRoundedRectangle (knob, 3.0f);
    if (hasKeyboardFocus (false))
    {
        g.setColour (theme.accent);
        g.drawRoundedRectangle (knob, 3.0f, 1.5f);
    }
    g.setColour (beyond ? theme.warning : theme.text);
    g.fillRect (knob.withSizeKeepingCentre (knob.getWidth() - 6.0f, 1.5f));
}

}   // namespace tactus::host
