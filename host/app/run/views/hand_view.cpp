// SPDX-License-Identifier: GPL-3.0-or-later
#include "hand_view.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/model/with_prefix.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::host
{

HandView::HandView (Playback& p) : playback (p)
{
    setTitle (TRANS ("Surface"));
    setMouseCursor (juce::MouseCursor::CrosshairCursor);
    setWantsKeyboardFocus (true);
}

void HandView::refresh()
{
    const auto& run = playback.current();
    const bool was_moved_by_pointer = by_pointer, was_shown = tool.has_value();
    const auto before = tool.value_or (LiveRun::Tool {});
    by_pointer = run.hand().kind == LiveRun::Hand::Kind::pointer;
    held = held && by_pointer;
    if (held && ! run.isWanted()) letGo();   // the next START must not press
    tool = run.tool();
    if (tool && ! (isFinite (tool->position) && isFinite (tool->force))) tool.reset();   // an unstable loop may throw the tool anywhere
    const auto status = run.status();
    const auto ticks = status ? status->ticks : 0;
    if (ticks < std::exchange (last_tick, ticks)) trail.clear();   // another run, perhaps of another tool
    if (by_pointer && (pressed || held)) moveTool();               // a run that began meanwhile does not know where the pointer is
    if (tool)
    {
        trail.push_back (tool->position);
        if (trail.size() > longest_trail) trail.pop_front();
    }
    else
        trail.clear();
    const auto now = tool.value_or (LiveRun::Tool {});
    const bool is_still = was_shown == tool.has_value() && before.position == now.position && before.force == now.force
                          && std::ranges::all_of (trail, [&] (const Vec3& p) { return p == now.position; });
    if (! is_still || was_moved_by_pointer != by_pointer) repaint();
}

juce::Rectangle<float> HandView::surface() const { return getLocalBounds().toFloat().withTrimmedRight (64.0f); }

juce::Point<float> HandView::toPixels (const Vec3& p) const
{
    const auto area = surface();
    const float scale = area.getWidth() / static_cast<float> (2.0 * half_width_m);
    const auto near = [] (double m) { return static_cast<float> (std::clamp (m, -100.0, 100.0)); };
    return { area.getCentreX() + near (p.x()) * scale, area.getCentreY() - near (p.y()) * scale };
}

void HandView::point (const juce::MouseEvent& e)
{
    // A pen reports its own pressure.
    if (pressed && e.isPressureValid() && e.pressure > 0.0f && e.pressure < 1.0f)
        press_depth = least_depth_m + (most_depth_m - least_depth_m) * static_cast<double> (e.pressure);
    const auto area = surface();
    const double scale = 2.0 * half_width_m / static_cast<double> (area.getWidth());
    const auto from_centre = e.position - area.getCentre();
    target = { static_cast<double> (from_centre.x) * scale, -static_cast<double> (from_centre.y) * scale, pressed ? -press_depth : hover_m };
    const bool has_nothing = playback.current().edited().root.nodes.empty();   // there is no tool to move, as on the welcome page
    if (! has_nothing) takeTool();
    moveTool();
    repaint();
}

void HandView::steer (double x, double y, bool presses)
{
    pressed = presses;
    held = held && ! presses;
    target = { x, y, pressed || held ? -press_depth : hover_m };
    takeTool();
    moveTool();
}

/// `by_pointer` is of the last refresh, so with it each event until the next one would restart the run.
void HandView::takeTool()
{
    if (pressed && playback.current().hand() != LiveRun::Hand::pointer()) playback.moveBy (LiveRun::Hand::pointer());
}

void HandView::mouseMove (const juce::MouseEvent& e)
{
    if (! held) point (e);
}

void HandView::hold()
{
    if (! by_pointer) return;
    held = ! held;
    target.z() = held || pressed ? -press_depth : hover_m;
    moveTool();
    repaint();
}

void HandView::mouseDrag (const juce::MouseEvent& e) { point (e); }

void HandView::mouseDown (const juce::MouseEvent& e)
{
    takeFocus (*this);
    held = false;
    pressed = true;
    point (e);
}

void HandView::mouseUp (const juce::MouseEvent& e)
{
    pressed = false;
    if (! held) point (e);
}

void HandView::mouseWheelMove (const juce::MouseEvent& e, const juce::MouseWheelDetails& wheel)
{
    pressDeeper (-2.0 * static_cast<double> (wheel.deltaY));
    if (! held) point (e);
}

bool HandView::keyPressed (const juce::KeyPress& key)
{
    if (key != juce::KeyPress::pageDownKey && key != juce::KeyPress::pageUpKey) return false;
    pressDeeper (key == juce::KeyPress::pageDownKey ? 0.25 : -0.25);
    return true;
}

void HandView::pressDeeper (double octaves)
{
    press_depth = std::clamp (press_depth * std::exp2 (octaves), least_depth_m, most_depth_m);
    if (! pressed && ! held) return;
    target.z() = -press_depth;
    moveTool();
}

void HandView::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    paintHeight (g);
    const auto area = surface();
    g.setColour (theme.canvas);
    g.fillRoundedRectangle (area, 4.0f);

    // A centimetre grid, and a ruler.
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
    constexpr double longest = 100.0;   // N
    const auto pixels = [&] (double newton) { return static_cast<float> (std::clamp (newton, -longest, longest)) * pixels_per_newton; };
    const juce::Point<float> push { pixels (tool->force.x()), -pixels (tool->force.y()) };
    g.setColour (theme.of (Quantity::force));
    if (push.getDistanceFromOrigin() > 2.0f) g.drawArrow ({ at, at + push }, 2.5f, 9.0f, 9.0f);
    const bool touches = tool->force.norm() > 1e-6;
    g.setColour (touches ? theme.of (Quantity::force) : theme.of (Quantity::length));
    g.fillEllipse (juce::Rectangle<float> (9.0f, 9.0f).withCentre (at));
}

/// The height of the tool. Its colour shows whether a force acts on it.
void HandView::paintHeight (juce::Graphics& g) const
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    const auto bar = getLocalBounds().toFloat().removeFromRight (56.0f);
    g.setColour (theme.canvas);
    g.fillRoundedRectangle (bar, 4.0f);
    const auto heightOf = [&, reach = bar.getHeight() / 2 - 8.0f] (double z) {
        const auto part = std::clamp (z / height_range_m, -1.0, 1.0);
        return bar.getCentreY() - static_cast<float> (part) * reach;
    };
    g.setColour (theme.dots);
    g.fillRect (bar.withTop (heightOf (0.0)));
    g.setFont (look.font (11.0f));
    g.setColour (theme.dim);
    g.drawText ("z = 0", bar.withTop (heightOf (0.0)).withHeight (16.0f).withTrimmedLeft (4.0f), juce::Justification::centredLeft, false);
    if (! tool) return;
    const float z = heightOf (tool->position.z());
    g.setColour (tool->force.norm() > 1e-6 ? theme.of (Quantity::force) : theme.of (Quantity::length));
    g.fillEllipse (juce::Rectangle<float> (9.0f, 9.0f).withCentre ({ bar.getRight() - 12.0f, z }));   // beside "z = 0"
    g.setColour (theme.text);
    constexpr double least_shown = 0.5e-6;   // m; below, the digits only flicker
    const double height = tool->position.z();
    drawNumber (g, std::abs (height) < least_shown ? juce::String ("0 mm") : fromUtf8 (withPrefix (height, "m")),
                bar.withTop (bar.getBottom() - 18.0f).withTrimmedRight (4.0f));
}

}   // namespace tactus::host
