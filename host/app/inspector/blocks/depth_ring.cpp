// SPDX-License-Identifier: GPL-3.0-or-later
#include "depth_ring.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/model/drag_number.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr double scale_start = 1.25, scale_end = 2.75;   // half turns from the top, as on the knobs of controls
}   // namespace

void paintDepth (juce::Graphics& g, juce::Point<float> centre, float radius, float thickness, double from, double to, juce::Colour colour)
{
    const auto angle = [] (double part) {
        return static_cast<float> ((scale_start + (scale_end - scale_start) * std::clamp (part, 0.0, 1.0)) * juce::MathConstants<double>::pi);
    };
    juce::Path p;
    p.addCentredArc (centre.x, centre.y, radius, radius, 0.0f, angle (std::min (from, to)), angle (std::max (from, to)), true);
    g.setColour (colour);
    g.strokePath (p, juce::PathStrokeType (thickness, juce::PathStrokeType::beveled, juce::PathStrokeType::butt));
}

DepthRing::DepthRing()
{
    setMouseCursor (juce::MouseCursor::UpDownResizeCursor);
    setWantsKeyboardFocus (true);
    setMouseClickGrabsKeyboardFocus (false);   // the canvas keeps the keyboard focus
}

void DepthRing::show (const Modulation& m, double v, const PortSheet& sheet, const juce::String& name)
{
    modulation = m;
    value = v;
    const auto& usual = sheet.limits.usual;
    const bool has_range = std::isfinite (usual.min) && std::isfinite (usual.max) && usual.max > usual.min;
    const double around = std::max ({ std::abs (value), std::abs (m.depth), 1e-12 });
    low = has_range ? std::min (usual.min, value) : value - 2.0 * around;
    high = has_range ? std::max (usual.max, value) : value + 2.0 * around;
    is_logarithmic = has_range && isLogarithmic (sheet) && low > 0.0;
    span = is_logarithmic || ! has_range ? around : high - low;
    setTitle (filled (TRANS ("Depth of %1 by %2"), name, m.from));
    const auto text = textOf (m);
    setDescription (text);
    setTooltip (filled (TRANS ("%1 moves %2: %3. Drag up or down to change the depth, Shift+drag for fine steps; double-click to type it; drag it to 0, or press Delete, to end this."),
                        m.from, name, text));
    repaint();
}

void DepthRing::paint (juce::Graphics& g)
{
    const auto& theme = themeOf (*this);
    const auto centre = getLocalBounds().toFloat().getCentre();
    const auto partOf = [&] (double v) {
        if (is_logarithmic) return std::log (std::max (v, low) / low) / std::log (high / low);
        return (v - low) / (high - low);
    };
    const auto lit = theme.of (Quantity::energy);
    paintDepth (g, centre, 8.0f, 3.0f, 0.0, 1.0, theme.hairline);
    paintDepth (g, centre, 8.0f, 3.0f, partOf (modulation.is_one_sided ? value : value - modulation.depth), partOf (value + modulation.depth), lit);
    paintDepth (g, centre, 8.0f, 5.0f, partOf (value) - 0.015, partOf (value) + 0.015, theme.text);
    if (! hasKeyboardFocus (false) && ! isMouseOverOrDragging()) return;
    g.setColour (hasKeyboardFocus (false) ? theme.accent : theme.dim);
    g.drawRoundedRectangle (getLocalBounds().toFloat().reduced (0.5f), 4.0f, 1.0f);
}

void DepthRing::mouseDown (const juce::MouseEvent& e)
{
    is_held = ! e.mods.isPopupMenu();
    grabbed = modulation.depth;
    way = DragWay { DragWay::Along::up };
    has_moved = false;
}

void DepthRing::mouseDrag (const juce::MouseEvent& e)
{
    if (is_held) moveTo (draggedDepth (grabbed, span, way.to (e)));
}

void DepthRing::mouseUp (const juce::MouseEvent& e)
{
    if (! std::exchange (is_held, false)) return;
    const bool ends = has_moved && modulation.depth == 0.0;
    const bool is_click = ! e.source.hasMovedSignificantlySincePressed();
    if (is_click) takeFocus (*this);
    if (is_click && ! has_moved && e.getNumberOfClicks() == 2 && onType) return onType ({});
    if (ends && onEnd) onEnd (true);   // last, because the row and this ring may be replaced
}

bool DepthRing::keyPressed (const juce::KeyPress& key)
{
    const bool is_digit = isTypedNumber (key);
    if (onType && (is_digit || key.isKeyCode (juce::KeyPress::returnKey)))
    {
        onType (is_digit ? juce::String::charToString (key.getTextCharacter()) : juce::String());
        return true;
    }
    if (isErasing (key))
    {
        if (onEnd) onEnd (false);
        return true;
    }
    if (! isArrow (key)) return false;
    constexpr double step = 4.0, fine = 0.1;   // pixels of a drag; fine: with Shift
    const bool is_up = key.isKeyCode (juce::KeyPress::upKey) || key.isKeyCode (juce::KeyPress::rightKey);
    const double by = (is_up ? step : -step) * (key.getModifiers().isShiftDown() ? fine : 1.0);
    has_moved = false;
    moveTo (modulation.depth + by / 200.0 * span);
    return true;
}

void DepthRing::moveTo (double depth)
{
    if (depth == modulation.depth || ! onChange) return;
    onChange (depth, std::exchange (has_moved, true));
    modulation.depth = depth;   // the gain of the wire is rounded to three digits
    if (onHint) onHint (depth == 0.0 ? filled (TRANS ("%1: release to end the modulation"), modulation.from) : textOf (modulation));
}

}   // namespace tactus::host
