// SPDX-License-Identifier: GPL-3.0-or-later
#include "hand_view.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::host
{

HandView::HandView()
{
    setTitle ("The hand");
    setMouseCursor (juce::MouseCursor::CrosshairCursor);
}

void HandView::show (const Performance& p)
{
    by_pointer = p.hand() == Performance::Hand::pointer;
    running = p.isRunning();
    tool = p.tool();
    if (tool)
    {
        trail.push_back (tool->position);
        if (trail.size() > longest_trail) trail.pop_front();
    }
    else
        trail.clear();
    repaint();
}

juce::Rectangle<float> HandView::surface() const { return getLocalBounds().toFloat().withTrimmedTop (28.0f).withTrimmedRight (64.0f).reduced (8.0f, 0.0f).withTrimmedBottom (8.0f); }

juce::Point<float> HandView::toPixels (const Vec3& p) const
{
    const auto area = surface();
    const float scale = area.getWidth() / static_cast<float> (2.0 * half_width_m);
    return { area.getCentreX() + static_cast<float> (p.x()) * scale, area.getCentreY() - static_cast<float> (p.y()) * scale };
}

void HandView::point (const juce::MouseEvent& e)
{
    const auto area = surface();
    const double scale = 2.0 * half_width_m / static_cast<double> (area.getWidth());
    target = { static_cast<double> (e.position.x - area.getCentreX()) * scale, static_cast<double> (area.getCentreY() - e.position.y) * scale, pressed ? -press_depth : hover_m };
    if (! by_pointer && pressed && onTakesOver) onTakesOver();
    if (onPoint) onPoint (target);
    repaint();
}

void HandView::mouseMove (const juce::MouseEvent& e) { point (e); }
void HandView::mouseDrag (const juce::MouseEvent& e) { point (e); }

void HandView::mouseDown (const juce::MouseEvent& e)
{
    pressed = true;
    point (e);
}

void HandView::mouseUp (const juce::MouseEvent& e)
{
    pressed = false;
    point (e);
}

void HandView::mouseWheelMove (const juce::MouseEvent& e, const juce::MouseWheelDetails& wheel)
{
    press_depth = std::clamp (press_depth * std::exp2 (-2.0 * static_cast<double> (wheel.deltaY)), least_depth_m, most_depth_m);
    point (e);
}

void HandView::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    g.fillAll (theme.panel);
    const auto area = surface();
    g.setColour (theme.canvas);
    g.fillRoundedRectangle (area, 4.0f);

    auto title = getLocalBounds().toFloat().removeFromTop (28.0f).reduced (12.0f, 0.0f);
    g.setFont (look.font (12.0f, true));
    g.setColour (theme.text);
    g.drawText ("The hand", title, juce::Justification::centredLeft, false);
    g.setFont (look.font (12.0f));
    g.setColour (theme.dim);
    const auto words = ! running ? juce::String ("nothing runs") : by_pointer ? "press " + juce::String (1000.0 * press_depth, 1) + " mm deep; the wheel changes it"
                                                                              : juce::String ("moved as the graph says; press here to take over");
    g.drawText (words, title.withTrimmedLeft (72.0f), juce::Justification::centredLeft, true);

    // A grid of centimetres, and how long one is.
    const juce::Graphics::ScopedSaveState clipped (g);
    g.reduceClipRegion (area.toNearestInt());
    g.setColour (theme.dots);
    for (double x = -0.10; x < 0.101; x += 0.01)
    {
        g.drawVerticalLine (juce::roundToInt (toPixels (Vec3 (x, 0, 0)).x), area.getY(), area.getBottom());
        g.drawHorizontalLine (juce::roundToInt (toPixels (Vec3 (0, x, 0)).y), area.getX(), area.getRight());
    }
    g.setColour (theme.dim);
    g.setFont (look.font (11.0f));
    const float centimetre = toPixels (Vec3 (0.01, 0, 0)).x - toPixels (Vec3::Zero()).x;
    const juce::Point<float> ruler { area.getX() + 10.0f, area.getBottom() - 10.0f };
    g.drawLine ({ ruler, ruler.translated (centimetre, 0.0f) }, 2.0f);
    g.drawText ("10 mm", juce::Rectangle<float> (ruler.x + centimetre + 6.0f, ruler.y - 8.0f, 50.0f, 16.0f), juce::Justification::centredLeft, false);

    if (by_pointer)
    {
        g.setColour (theme.dim);
        g.drawEllipse (juce::Rectangle<float> (14.0f, 14.0f).withCentre (toPixels (target)), 1.0f);
    }
    if (! tool) return;
    juce::Path way;
    for (std::size_t i = 0; i < trail.size(); ++i)
        i == 0 ? way.startNewSubPath (toPixels (trail[i])) : way.lineTo (toPixels (trail[i]));
    g.setColour (theme.of (Quantity::length).withAlpha (0.5f));
    g.strokePath (way, juce::PathStrokeType (1.5f));

    const auto at = toPixels (tool->position);
    constexpr float pixels_per_newton = 40.0f;
    const juce::Point<float> push { static_cast<float> (tool->force.x()) * pixels_per_newton, -static_cast<float> (tool->force.y()) * pixels_per_newton };
    g.setColour (theme.of (Quantity::force));
    if (push.getDistanceFromOrigin() > 2.0f) g.drawArrow ({ at, at + push }, 2.5f, 9.0f, 9.0f);
    const bool touches = tool->force.norm() > 1e-6;
    g.setColour (touches ? theme.of (Quantity::force) : theme.of (Quantity::length));
    g.fillEllipse (juce::Rectangle<float> (9.0f, 9.0f).withCentre (at));
}

void HandView::paintOverChildren (juce::Graphics& g)
{
    // How high the tool is, and what pushes it up.
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    const auto bar = getLocalBounds().toFloat().removeFromRight (56.0f).withTrimmedTop (28.0f).withTrimmedBottom (8.0f).withTrimmedRight (8.0f);
    g.setColour (theme.canvas);
    g.fillRoundedRectangle (bar, 4.0f);
    const auto heightOf = [&] (double z)
    { return bar.getCentreY() - static_cast<float> (std::clamp (z / height_range_m, -1.0, 1.0)) * (bar.getHeight() / 2 - 8.0f); };
    g.setColour (theme.dots);
    g.fillRect (bar.withTop (heightOf (0.0)));
    g.setFont (look.font (11.0f));
    g.setColour (theme.dim);
    g.drawText ("z = 0", bar.withTop (heightOf (0.0)).withHeight (16.0f), juce::Justification::centred, false);
    if (! tool) return;
    const float z = heightOf (tool->position.z());
    g.setColour (tool->force.norm() > 1e-6 ? theme.of (Quantity::force) : theme.of (Quantity::length));
    g.fillEllipse (juce::Rectangle<float> (9.0f, 9.0f).withCentre ({ bar.getCentreX(), z }));
    g.setColour (theme.text);
    drawNumber (g, juce::String (1000.0 * tool->position.z(), 2) + " mm", bar.withTop (bar.getBottom() - 18.0f).withTrimmedRight (4.0f));
}

}   // namespace tactus::host
