// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool_plot.hpp"

#include <host/app/model/with_prefix.hpp>
#include <host/app/text/filled.hpp>

#include <cmath>

namespace tactus::host
{

namespace
{
constexpr double ease = 0.2, forget = 0.995;
constexpr double circles_in_view = 2.0;   // half the height of the view, in radii of the circle
constexpr float longest_arrow = 0.75f;    // as a fraction of half the height of the view

void arrow (juce::Graphics& g, juce::Point<float> from, juce::Point<float> to, float thickness)
{
    juce::Path path;
    const juce::Line<float> line (from, to);
    if (line.getLength() < 2.0f) return;
    path.addArrow (line, thickness, 4.0f * thickness, std::min (line.getLength(), 4.5f * thickness));
    g.fillPath (path);
}
}   // namespace

void ToolPlot::show (const Signals& signals)
{
    repaint();
    if (spec.node.empty() || spec.is_frozen) return;
    const auto before = now ? std::optional (now->tick) : std::nullopt;
    now = toolPicture (spec.node, signals);
    if (! now)
    {
        lanes.clear();
        return;
    }
    if (before == now->tick && lanes.size() == 1 && lanes.front().area == getLocalBounds().toFloat()) return;   // nothing has run since
    tool_trail.push_back (now->tool);
    anchor_trail.push_back (now->touches() ? now->anchor() : Vec3::Constant (std::nan ("")));
    if (tool_trail.size() > longest_trail)
    {
        tool_trail.pop_front();
        anchor_trail.pop_front();
    }

    // Keeps the anchor in the centre: it stays still while the tool sticks, and the ground moves past while the tool slides.
    const Vec3 wanted = now->touches() ? now->anchor() : now->tool;
    const double radius = std::max ({ now->d_stick, now->deflection.norm(), 1e-7 });
    const bool is_first = half_width == 0.0;
    half_width = is_first ? circles_in_view * radius : half_width + ease * (circles_in_view * radius - half_width);
    const double off = (wanted - centre).norm(), farthest = 0.4 * half_width;
    if (is_first) centre = wanted;
    centre += std::max (2.0 * ease, off > farthest ? 1.0 - farthest / off : 0.0) * (wanted - centre);
    most_force = std::max (forget * most_force, now->force.norm());

    lanes.resize (1);
    auto& lane = lanes.front();
    lane.area = getLocalBounds().toFloat();
    const PlaneView plane (now->normal);
    const double x = centre.dot (plane.right), y = centre.dot (plane.up);
    const double aspect = static_cast<double> (lane.area.getWidth() / std::max (1.0f, lane.area.getHeight()));
    const double tall = aspect >= 1.0 ? half_width : half_width / aspect;
    lane.x = { x - tall * aspect, x + tall * aspect };
    lane.y = { y - tall, y + tall };
    lane.unit = lane.x_unit = "m";
    lane.shows_x = lane.shows_y = false;
}

void ToolPlot::paintLane (juce::Graphics& g, const Lane& lane, std::size_t)
{
    const auto& p = *now;
    const PlaneView plane (p.normal);
    const auto pixel = [&] (const Vec3& v) { return lane.toPixels (v.dot (plane.right), v.dot (plane.up)); };
    const float per_metre = lane.area.getHeight() / static_cast<float> (lane.y.size());

    const auto trail = [&] (const std::deque<Vec3>& points, juce::Colour colour, float thickness) {
        for (std::size_t i = 1; i < points.size(); ++i)
        {
            if (! isFinite (points[i]) || ! isFinite (points[i - 1])) continue;
            g.setColour (colour.withAlpha (0.5f * static_cast<float> (i) / static_cast<float> (points.size())));
            g.drawLine ({ pixel (points[i - 1]), pixel (points[i]) }, thickness);
        }
    };
    trail (anchor_trail, theme().of (Quantity::force), 3.0f);
    trail (tool_trail, theme().of (Quantity::length), 1.5f);

    const auto tool = pixel (p.tool), anchor = pixel (p.anchor());
    if (p.touches())
    {
        const auto circle = [&] (double radius) {
            const float size = 2.0f * per_metre * static_cast<float> (radius);
            return juce::Rectangle<float> (size, size).withCentre (anchor);
        };
        const auto state = p.state == 2 ? theme().of (Quantity::force) : theme().of (Quantity::length);
        g.setColour (state.withAlpha (0.10f));
        g.fillEllipse (circle (p.d_max));
        g.setColour (state.withAlpha (0.8f));
        g.drawEllipse (circle (p.d_max), 1.5f);
        if (p.d_stick > 1.001 * p.d_max)
        {
            juce::Path outer, dashed;
            outer.addEllipse (circle (p.d_stick));
            const float dashes[] = { 4.0f, 4.0f };
            juce::PathStrokeType (1.0f).createDashedStroke (dashed, outer, dashes, 2);
            g.setColour (theme().dim.withAlpha (0.8f));
            g.fillPath (dashed);
        }
        g.setColour (theme().of (Quantity::length));
        g.drawLine ({ anchor, tool }, 5.0f);
        g.setColour (theme().text);
        g.drawLine (anchor.x - 5.0f, anchor.y - 5.0f, anchor.x + 5.0f, anchor.y + 5.0f, 2.0f);
        g.drawLine (anchor.x - 5.0f, anchor.y + 5.0f, anchor.x + 5.0f, anchor.y - 5.0f, 2.0f);
        if (most_force > 0.0)
        {
            const double reach = static_cast<double> (longest_arrow) * 0.5 * lane.y.size() / most_force;
            g.setColour (theme().of (Quantity::force));
            arrow (g, tool, pixel (p.tool + p.force * reach), 2.0f);
        }
    }
    const auto disc = juce::Rectangle<float> (11.0f, 11.0f).withCentre (tool);
    g.setColour (p.touches() ? theme().of (Quantity::length) : theme().canvas);
    g.fillEllipse (disc);
    g.setColour (theme().of (Quantity::length));
    g.drawEllipse (disc, 1.5f);
}

void ToolPlot::paintOver (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    const auto& p = *now;
    auto area = getLocalBounds().toFloat().reduced (8.0f, 6.0f);
    auto line = area.removeFromTop (16.0f);
    g.setFont (look.font (12.0f, true));
    const auto draw = [&] (const juce::String& state, juce::Colour colour) {
        g.setColour (colour);
        g.drawText (state, line, juce::Justification::centredLeft, true);
    };
    if (p.state < 0)
        draw (TRANS ("fault: an input is not a number"), theme().stop);
    else if (p.state == 0)
        draw (TRANS ("no contact"), theme().dim);
    else if (p.state == 1)
        draw (TRANS ("stuck: the anchor does not move"), theme().of (Quantity::length));
    else
        draw (TRANS ("sliding: the anchor is dragged"), theme().of (Quantity::force));

    const auto text = [] (double v, const char* unit) { return juce::String::fromUTF8 (withPrefix (v, unit).c_str()); };
    if (p.touches())
    {
        const Entry deflection { theme().of (Quantity::length), "z " + text (p.deflection.norm(), "m") };
        const Entry force { theme().of (Quantity::force), "f " + text (p.force.norm(), "N") };
        paintLegend (g, area.removeFromBottom (16.0f), { deflection, force });
    }
    g.setFont (look.font (11.0f));
    g.setColour (theme().dim);
    g.drawText ("d_max " + text (p.d_max, "m"), area.removeFromBottom (16.0f), juce::Justification::centredRight, false);
}

juce::String ToolPlot::emptyText() const
{
    return spec.node.empty() ? TRANS ("No friction node. Add friction.elasto_plastic to see its anchor and bristle here") : whyEmpty();
}

}   // namespace tactus::host
