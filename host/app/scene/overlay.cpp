// SPDX-License-Identifier: GPL-3.0-or-later
#include "overlay.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/model/with_prefix.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/kit/geometry/rotation.hpp>

#include <cmath>
#include <numbers>

namespace tactus::host::scene
{

namespace
{
constexpr float gizmo_reach = 22.0f, gizmo_dot = 8.0f;   // pixels
constexpr double least_force = 5e-3;                     // N; smaller ones have no arrow

juce::String lengthText (double metres, int digits = 3) { return fromUtf8 (withPrefix (metres, "m", digits)); }

/// The part of a line that is inside of a rectangle; empty: none.
std::optional<juce::Line<float>> clipped (juce::Line<float> line, juce::Rectangle<float> area)
{
    const auto from = line.getStart(), way = line.getEnd() - from;
    float begin = 0.0f, end = 1.0f;                       // as parts of the line
    const auto keep = [&] (float way_out, float room) {   // the part where way_out * t <= room
        if (way_out < 0.0f) begin = std::max (begin, room / way_out);
        if (way_out > 0.0f) end = std::min (end, room / way_out);
        if (way_out == 0.0f && room < 0.0f) end = -1.0f;
    };
    keep (-way.x, from.x - area.getX());
    keep (way.x, area.getRight() - from.x);
    keep (-way.y, from.y - area.getY());
    keep (way.y, area.getBottom() - from.y);
    if (! (begin < end)) return std::nullopt;
    return juce::Line<float> (from + way * begin, from + way * end);
}

}   // namespace

double Overlay::arrowLength (double newtons, double height) noexcept { return std::min (48.0 * newtons, 0.42 * height); }

juce::String Overlay::forceText (double newtons) { return fromUtf8 (withPrefix (newtons, "N")); }

void Overlay::backdrop (juce::Rectangle<float> box) const
{
    graphics.setColour (look.theme().panel.withAlpha (0.82f));
    graphics.fillRoundedRectangle (box, 4.0f);
}

void Overlay::label (const juce::String& text, juce::Point<float> at, Side side, juce::Colour ink)
{
    constexpr float height = 18.0f;
    const auto font = look.font (12.0f, true);
    const float width = font.getStringWidthFloat (text) + 10.0f;
    auto box = juce::Rectangle<float> (side == Side::left ? at.x - width : at.x, at.y - 0.5f * height, width, height);
    box = box.constrainedWithin (area.reduced (2.0f));
    for (const auto& other : labels)
        if (box.intersects (other)) box.setY (other.getY() - height - 2.0f);
    labels.push_back (box);
    backdrop (box);
    graphics.setColour (ink);
    graphics.setFont (font);
    graphics.drawText (text, box, juce::Justification::centred, false);
}

void Overlay::drawGround (const Scene& scene)
{
    const auto box = scene.bounds();
    if (box.isEmpty() || camera.pitch <= 0.0) return;
    const double step = Scene::gridFor (camera), z = scene.hasSolid() ? box.low.z() : 0.0;
    const Vec3 middle = box.centre();
    const int lines = std::clamp (static_cast<int> (std::ceil (0.8 * box.radius() / step)) + 2, 4, 40);
    const double x0 = step * std::round (middle.x() / step), y0 = step * std::round (middle.y() / step), reach = step * lines;
    const auto draw = [&] (const Vec3& from, const Vec3& to) {
        const auto a = camera.see (from), b = camera.see (to);
        if (a.depth > camera.near() && b.depth > camera.near()) graphics.drawLine (a.x, a.y, b.x, b.y, 1.0f);
    };
    graphics.setColour (look.theme().dots);
    for (int i = -lines; i <= lines; ++i)
    {
        draw ({ x0 + i * step, y0 - reach, z }, { x0 + i * step, y0 + reach, z });
        draw ({ x0 - reach, y0 + i * step, z }, { x0 + reach, y0 + i * step, z });
    }
}

void Overlay::drawForce (const Tool& tool, bool names_role)
{
    const double newtons = tool.force.norm();
    const auto seen = camera.see (tool.position);
    if (! (seen.depth > camera.near()) || ! isFinite (tool.force) || newtons < least_force) return;
    const double metres = arrowLength (newtons, static_cast<double> (area.getHeight())) / camera.scaleAt (seen.depth);
    const auto from = juce::Point<float> (seen.x, seen.y), to = camera.pixel (tool.position + metres / newtons * tool.force);
    const auto colour = look.theme().of (Quantity::force);
    const float length = from.getDistanceFrom (to);
    if (length > 4.0f)
    {
        const float head = std::min (11.0f, 0.6f * length);
        graphics.setColour (look.theme().canvas.withAlpha (0.55f));   // a rim, so that the arrow is visible on any surface
        graphics.drawArrow ({ from, to }, 5.5f, head + 3.0f, head + 3.0f);
        graphics.setColour (colour);
        graphics.drawArrow ({ from, to }, 3.0f, head, head);
    }
    label ((names_role ? juce::String (tool.role) + "  " : juce::String()) + forceText (newtons), to.translated (to.x < from.x ? -8.0f : 8.0f, -4.0f),
           to.x < from.x ? Side::left : Side::right, colour);
}

std::optional<juce::Line<float>> Overlay::plumb (const Camera& camera, juce::Rectangle<float> area, const Tool& tool, const Body& plane)
{
    const Vec3 n = direction (plane.vector (&Appearance::normal, Vec3::UnitZ()));
    const double height = n.dot (tool.position) - plane.number (&Appearance::offset, 0.0);
    if (! isFinite (tool.position) || ! (height > 1e-4)) return std::nullopt;
    const auto top = camera.see (tool.position), foot = camera.see (tool.position - height * n);
    if (! (top.depth > camera.near() && foot.depth > camera.near())) return std::nullopt;
    return clipped ({ top.x, top.y, foot.x, foot.y }, area);
}

bool Overlay::isInFront (const Vec3& p) const { return camera.see (p).depth > camera.near(); }

/// Shows how far above the surface a hovering tool is.
void Overlay::drawPlumb (const Tool& tool, const Scene& scene, const std::vector<Touch>& touches)
{
    if (std::ranges::find (touches, tool.role, &Touch::role) != touches.end()) return;
    const auto plane = std::ranges::find_if (scene.bodies(), [&] (const Body& b) { return b.kind == Appearance::Kind::plane && b.role == tool.role; });
    if (plane == scene.bodies().end()) return;
    const auto line = plumb (camera, area, tool, *plane);
    if (! line) return;
    const float dashes[] { 3.0f, 3.0f };
    graphics.setColour (look.theme().text.withAlpha (0.6f));
    graphics.drawDashedLine (*line, dashes, 2, 1.0f);
    graphics.drawEllipse (juce::Rectangle<float> (7.0f, 4.0f).withCentre (line->getEnd()), 1.2f);
}

/// The circle within which a contact sticks.
void Overlay::drawRing (const StuckBound& bound)
{
    constexpr int corners = 48;
    const Vec3 x = perpendicularTo (bound.normal), y = bound.normal.cross (x);
    juce::Path ring;
    for (int i = 0; i < corners; ++i)
    {
        const double angle = 2.0 * std::numbers::pi * i / corners;
        const Vec3 p = bound.centre + bound.radius * (std::cos (angle) * x + std::sin (angle) * y);
        if (! isInFront (p)) return;
        i == 0 ? ring.startNewSubPath (camera.pixel (p)) : ring.lineTo (camera.pixel (p));
    }
    ring.closeSubPath();
    graphics.setColour (look.theme().of (Quantity::length));
    graphics.strokePath (ring, juce::PathStrokeType (1.2f));
}

void Overlay::drawMarks (const Scene& scene, const SceneState& now)
{
    const auto& theme = look.theme();
    const auto touches = scene.touches (now);
    for (const auto& crack : scene.cracks (now))
    {
        const std::array corners { crack.begin, crack.end, Vec3 (crack.end + crack.down), Vec3 (crack.begin + crack.down) };
        if (! std::ranges::all_of (corners, [this] (const Vec3& p) { return isInFront (p); })) continue;
        juce::Path wall;
        wall.startNewSubPath (camera.pixel (corners[0]));
        for (std::size_t i = 1; i < corners.size(); ++i)
            wall.lineTo (camera.pixel (corners[i]));
        wall.closeSubPath();
        graphics.setColour (theme.of (Quantity::length).withAlpha (0.22f));
        graphics.fillPath (wall);
        graphics.setColour (theme.of (Quantity::length));
        graphics.strokePath (wall, juce::PathStrokeType (1.2f));
        const Vec3 tip = 0.5 * (crack.begin + crack.end) + crack.down;
        label (filled (TRANS ("crack %1"), lengthText (crack.down.norm())), camera.pixel (tip).translated (10.0f, 10.0f), Side::right,
               theme.of (Quantity::length));
    }
    for (const auto& bound : scene.stuckBounds (now))
        drawRing (bound);
    for (const auto& tool : scene.roundTools (now))
    {
        const auto seen = camera.see (tool.centre);
        if (! (seen.depth > camera.near())) continue;
        const auto across = static_cast<float> (2.0 * tool.radius * camera.scaleAt (seen.depth));
        const auto circle = juce::Rectangle<float> (across, across).withCentre ({ seen.x, seen.y });
        graphics.setColour (theme.text.withAlpha (0.08f));
        graphics.fillEllipse (circle);
        graphics.setColour (theme.text.withAlpha (0.55f));
        graphics.drawEllipse (circle, 1.2f);
    }
    for (const auto& touch : touches)
    {
        if (! isInFront (touch.at) || ! isInFront (touch.tool)) continue;
        const auto at = camera.pixel (touch.at), tool = camera.pixel (touch.tool);
        const auto colour = theme.of (Quantity::length);
        graphics.setColour (colour);
        if (at.getDistanceFrom (tool) > 2.0f) graphics.drawLine ({ at, tool }, 2.0f);
        graphics.setColour (theme.canvas);
        graphics.fillEllipse (juce::Rectangle<float> (7.0f, 7.0f).withCentre (at));
        graphics.setColour (colour);
        graphics.drawEllipse (juce::Rectangle<float> (7.0f, 7.0f).withCentre (at), 1.6f);
    }
    for (const auto& tool : now.tools)
    {
        drawPlumb (tool, scene, touches);
        drawForce (tool, now.tools.size() > 1);
    }
}

void Overlay::drawScale (const Scene& scene, const SceneState& now)
{
    const auto& theme = look.theme();
    const double step = Scene::gridFor (camera);
    auto line = area.reduced (8.0f, 6.0f).removeFromBottom (18.0f);
    const auto grid = line.removeFromLeft (76.0f);
    backdrop (grid);
    graphics.setFont (look.font (11.0f));
    graphics.setColour (theme.text);
    graphics.drawText (filled (TRANS ("Grid %1"), lengthText (step, 1)), grid, juce::Justification::centred, false);
    double depth = 0.0;
    for (const auto& t : scene.touches (now))
        depth = std::max (depth, t.depth);
    const bool is_touched = depth > 0.0;
    const double full = scene.hasSolid() ? Solid::full_colour_m : 2e-3;
    auto bar = line.removeFromRight (158.0f);
    backdrop (bar);
    bar.removeFromRight (6.0f);
    const auto text = bar.removeFromRight (80.0f);
    bar = bar.withSizeKeepingCentre (64.0f, 6.0f);
    const auto rest = theme.is_dark ? juce::Colour (0xff788593) : juce::Colour (0xffb4bfcb);
    graphics.setGradientFill ({ rest, bar.getTopLeft(), theme.of (Quantity::length), bar.getTopRight(), false });
    graphics.fillRoundedRectangle (bar, 3.0f);
    graphics.setColour (theme.text);
    if (is_touched)
    {
        const float x = bar.getX() + bar.getWidth() * static_cast<float> (std::min (1.0, depth / full));
        graphics.fillRect (juce::Rectangle<float> (2.0f, 12.0f).withCentre ({ x, bar.getCentreY() }));
    }
    const bool is_unfelt = ! is_touched && scene.hasUnfeltTool (now);
    graphics.setColour (is_touched ? theme.text : is_unfelt ? theme.warning
                                                            : theme.dim);
    drawNumber (graphics, is_touched ? filled (TRANS ("%1 deep"), lengthText (depth)) : is_unfelt ? TRANS ("inside, unfelt")
                                                                                                  : TRANS ("no contact"),
                text);
}

/// The motion of the middle of a box in the picture, when it moves along an axis.
juce::Point<float> Overlay::pixelsPerMetre (const Camera& camera, const Reach& reach, int axis)
{
    const double step = 1e-3 * camera.distance;
    const auto way = camera.pixel (reach.middle + step * Vec3::Unit (axis)) - camera.pixel (reach.middle);
    return way * static_cast<float> (1.0 / step);
}

std::optional<juce::Line<float>> Overlay::handle (const Camera& camera, juce::Rectangle<float> area, const Reach& reach, int axis)
{
    constexpr float begin = 9.0f, end = 44.0f;
    constexpr double flattest = 0.25;   // of the length that the axis has when it is seen from the side
    const auto seen = camera.see (reach.middle);
    const juce::Point<float> at (seen.x, seen.y);
    if (! isFinite (reach.middle) || ! (seen.depth > camera.near()) || ! area.contains (at)) return std::nullopt;
    const auto way = pixelsPerMetre (camera, reach, axis);
    const float length = way.getDistanceFromOrigin();
    if (! (static_cast<double> (length) > flattest * camera.scaleAt (seen.depth))) return std::nullopt;
    const auto unit = way / length;
    return juce::Line<float> (at + unit * begin, at + unit * end);
}

std::optional<int> Overlay::handleAt (const Camera& camera, juce::Rectangle<float> area, const Reach& reach, juce::Point<float> at)
{
    std::optional<int> nearest;
    float least = 9.0f;
    for (int axis = 0; axis < 3; ++axis)
        if (const auto line = handle (camera, area, reach, axis))
        {
            juce::Point<float> foot;
            if (const float away = line->getDistanceFromPoint (at, foot); away < least)
            {
                least = away;
                nearest = axis;
            }
        }
    return nearest;
}

double Overlay::dragged (const Camera& camera, const Reach& reach, int axis, juce::Point<float> pixels)
{
    const auto way = pixelsPerMetre (camera, reach, axis);
    const float square = way.getDotProduct (way);
    return square > 0.0f ? static_cast<double> (pixels.getDotProduct (way) / square) : 0.0;
}

void Overlay::drawReach (const Reach& reach, bool names_role, std::optional<Dragged> moved)
{
    const auto& theme = look.theme();
    const auto colour = moved ? theme.accent : theme.dim;
    const auto corners = reach.corners();
    const auto draw = [&] (const Vec3& from, const Vec3& to) {
        if (isInFront (from) && isInFront (to)) graphics.drawLine (juce::Line<float> (camera.pixel (from), camera.pixel (to)), 1.0f);
    };
    graphics.setColour (colour.withAlpha (0.8f));
    if (reach.hasBox())
        for (std::size_t i = 0; i < corners.size(); ++i)
            for (const std::size_t bit : { 1u, 2u, 4u })
                if ((i & bit) == 0) draw (corners[i], corners[i | bit]);
    if (isInFront (reach.middle))
    {
        graphics.setColour (colour);
        graphics.fillEllipse (juce::Rectangle<float> (5.0f, 5.0f).withCentre (camera.pixel (reach.middle)));
    }
    for (int axis = 0; axis < 3; ++axis)
    {
        const auto line = handle (camera, area, reach, axis);
        if (! line) continue;
        const bool is_lit = moved && moved->axis == axis;
        graphics.setColour (theme.canvas.withAlpha (0.55f));
        graphics.drawArrow (*line, 5.0f, 14.0f, 12.0f);
        graphics.setColour (is_lit ? theme.accent : theme.axes[static_cast<std::size_t> (axis)]);
        graphics.drawArrow (*line, is_lit ? 3.0f : 2.0f, 11.0f, 10.0f);
        if (! is_lit) continue;
        const auto sign = moved->metres < 0.0 ? juce::String::fromUTF8 ("\xe2\x88\x92") : juce::String ("+");
        label (juce::String::charToString (static_cast<juce::juce_wchar> ('x' + axis)) + " " + sign + lengthText (std::abs (moved->metres)),
               line->getEnd().translated (8.0f, 0.0f), Side::right, theme.accent);
    }
    if (names_role && ! moved && isInFront (reach.middle))
        label (fromUtf8 (reach.role), camera.pixel (reach.middle).translated (8.0f, 12.0f), Side::right, colour);
}

juce::Point<float> Overlay::gizmoEnd (const Camera& camera, juce::Rectangle<float> area, int axis)
{
    const Vec3 a = Vec3::Unit (axis);
    return gizmoCentre (area) + juce::Point<float> (static_cast<float> (a.dot (camera.right())), -static_cast<float> (a.dot (camera.up()))) * gizmo_reach;
}

std::optional<int> Overlay::axisAt (const Camera& camera, juce::Rectangle<float> area, juce::Point<float> at)
{
    std::optional<int> nearest;
    float least = 12.0f;
    for (int i = 0; i < 3; ++i)
        if (const float away = gizmoEnd (camera, area, i).getDistanceFrom (at); away < least)
        {
            least = away;
            nearest = i;
        }
    return nearest;
}

void Overlay::drawAxes()
{
    std::array order { 0, 1, 2 };   // the farthest first
    std::ranges::sort (order, [&] (int a, int b) { return Vec3::Unit (a).dot (camera.view()) > Vec3::Unit (b).dot (camera.view()); });
    const auto& theme = look.theme();
    const auto centre = gizmoCentre (area);
    graphics.setFont (look.font (10.0f, true));
    for (const int axis : order)
    {
        const auto end = gizmoEnd (camera, area, axis);
        const auto colour = theme.axes[static_cast<std::size_t> (axis)];
        graphics.setColour (colour);
        graphics.drawLine ({ centre, end }, 2.0f);
        const auto dot = juce::Rectangle<float> (2.0f * gizmo_dot, 2.0f * gizmo_dot).withCentre (end);
        graphics.fillEllipse (dot);
        graphics.setColour (theme.is_dark ? theme.canvas : juce::Colours::white);
        graphics.drawText (juce::String::charToString (static_cast<juce::juce_wchar> ('x' + axis)).toUpperCase(), dot, juce::Justification::centred, false);
    }
}

}   // namespace tactus::host::scene
