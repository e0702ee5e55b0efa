// SPDX-License-Identifier: GPL-3.0-or-later
#include "scope_plot.hpp"

#include <host/app/look/component_colour.hpp>
#include <host/app/model/with_prefix.hpp>

#include <host/tools/figures/colours.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tactus::host
{

/// The place of a point in pixels. A point that is far outside a zoomed lane, or has no place in it, is drawn far outside: JUCE draws only finite
/// numbers.
juce::Point<float> Lane::toPixels (double at_x, double at_y) const noexcept
{
    const auto within = [far = 1e4] (double part) { return static_cast<float> (part > -far ? std::min (part, far) : -far); };
    const double part = is_logarithmic ? std::log (std::max (at_x, 1e-300) / x.low) / std::log (x.high / x.low) : (at_x - x.low) / x.size();
    return { area.getX() + within (part) * area.getWidth(), area.getBottom() - within ((at_y - y.low) / y.size()) * area.getHeight() };
}

double Lane::xAt (float pixel) const noexcept
{
    const double part = static_cast<double> ((pixel - area.getX()) / area.getWidth());
    return is_logarithmic ? x.low * std::pow (x.high / x.low, part) : x.low + part * x.size();
}

double Lane::yAt (float pixel) const noexcept { return y.low + static_cast<double> ((area.getBottom() - pixel) / area.getHeight()) * y.size(); }

ScopePlot::ScopePlot (ScopeSpec& s, ScopeContext& c) : spec (s), context (c)
{
    setMouseCursor (juce::MouseCursor::CrosshairCursor);
    setOpaque (true);
}

void ScopePlot::layOut (const std::vector<std::string>& units)
{
    auto area = getLocalBounds().toFloat().withTrimmedLeft (gutter).withTrimmedRight (10.0f).withTrimmedTop (8.0f).withTrimmedBottom (foot);
    lanes.resize (units.size());
    const float gap = 8.0f, each = (area.getHeight() + gap) / static_cast<float> (std::max<std::size_t> (1, units.size()));
    for (std::size_t i = 0; i < units.size(); ++i)
    {
        lanes[i].area = area.removeFromTop (each).withHeight (std::max (1.0f, each - gap));
        lanes[i].unit = units[i];
        lanes[i].shows_x = i + 1 == units.size();
    }
}

std::size_t ScopePlot::laneFor (std::vector<std::string>& units, const std::string& unit)
{
    const auto at = static_cast<std::size_t> (std::ranges::find (units, unit) - units.begin());
    if (at == units.size()) units.push_back (unit);
    return at;
}

Extent ScopePlot::rangeOf (const std::string& unit, const Extent& seen)
{
    const auto& followed = ranges[unit].update (seen);
    const auto zoomed = spec.zoomed.find (unit);
    return zoomed == spec.zoomed.end() ? followed : zoomed->second;
}

ScopePlot::Action ScopePlot::lengthAction (std::vector<double> seconds, const juce::String& about)
{
    const auto open = [this, seconds] (juce::Component& below) {
        juce::PopupMenu menu;
        for (const double s : seconds)
            menu.addItem (juce::String (withPrefix (s, "s", 1)), true, std::abs (spec.seconds - s) < 1e-6 * s, [safe = juce::Component::SafePointer (this), s] {
                if (safe == nullptr) return;
                safe->spec.seconds = s;
                if (safe->context.onChange) safe->context.onChange();
            });
        menu.showMenuAsync (juce::PopupMenu::Options().withTargetComponent (below));
    };
    return { juce::String::fromUTF8 (withPrefix (spec.seconds, "s", 2).c_str()), about, open };
}

void ScopePlot::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    g.fillAll (theme().canvas);
    if (lanes.empty())
    {
        g.setFont (look.font (12.0f));
        g.setColour (theme().dim);
        g.drawFittedText (emptyText(), getLocalBounds().reduced (16, 8), juce::Justification::centred, 4, 1.0f);
        return;
    }
    for (std::size_t i = 0; i < lanes.size(); ++i)
    {
        paintScales (g, lanes[i]);
        juce::Graphics::ScopedSaveState only_here (g);
        g.reduceClipRegion (lanes[i].area.expanded (0.0f, 1.0f).getSmallestIntegerContainer());
        paintLane (g, lanes[i], i);
    }
    paintCursors (g);
    paintOver (g);
}

namespace
{
/// Text to the left of a lane. What is too wide is squeezed, not cut.
void paintBeside (juce::Graphics& g, const juce::String& text, float right, float y)
{
    const float width = g.getCurrentFont().getStringWidthFloat (text) + 3.0f, room = right - 1.0f;
    const juce::Graphics::ScopedSaveState whole (g);
    if (width > room) g.addTransform (juce::AffineTransform::scale (room / width, 1.0f, right, y));
    drawNumber (g, text, { right - width, y - 8.0f, width, 16.0f });
}
}   // namespace

void ScopePlot::paintScales (juce::Graphics& g, const Lane& lane) const
{
    const auto& look = lookOf (*this);
    const auto font = look.font (11.0f);
    g.setFont (font);
    const auto down = axisScale (lane.y, "", lane.unit);
    const int rows = std::max (2, static_cast<int> (lane.area.getHeight() / 22.0f));
    for (const auto& tick : ticksWithin (down.shown (lane.y), rows))
    {
        const float y = lane.toPixels (lane.x.low, down.origin + tick.at * down.unit).y;
        g.setColour (tick.at == 0.0 ? theme().dim.withAlpha (0.5f) : theme().dots);
        g.fillRect (lane.area.getX(), y - 0.5f, lane.area.getWidth(), 1.0f);
        g.setColour (theme().dim);
        if (lane.shows_y && y > lane.area.getY() + 12.0f) paintBeside (g, juce::String::fromUTF8 (tick.text.c_str()), gutter - 6.0f, y);
    }
    auto label = juce::String::fromUTF8 (down.label.c_str()).trim();
    if (label.startsWithChar ('(')) label = label.fromFirstOccurrenceOf ("(", false, false).upToLastOccurrenceOf (")", false, false);
    g.setColour (theme().text);
    if (lane.shows_y) paintBeside (g, label, gutter - 6.0f, lane.area.getY() + 1.0f);

    float taken = 0.0f;   // where the label to the left ends
    const auto vertical = [&] (double at, const juce::String& text, bool strong, float free) {
        const float x = lane.toPixels (at, lane.y.low).x;
        g.setColour (strong ? theme().dim.withAlpha (0.5f) : theme().dots);
        g.fillRect (x - 0.5f, lane.area.getY(), 1.0f, lane.area.getHeight());
        if (! lane.shows_x || text.isEmpty()) return;
        g.setColour (theme().dim);
        const float width = font.getStringWidthFloat (text) + 2.0f;
        const float left = std::min (x - 0.5f * width, static_cast<float> (getWidth()) - width);
        if (left < taken || left + width > free) return;   // it would cover another one
        taken = left + width;
        g.drawText (text, juce::Rectangle<float> (left, lane.area.getBottom() + 2.0f, width, 14.0f), juce::Justification::centred, false);
    };
    if (lane.is_logarithmic)
    {
        for (double decade = std::pow (10.0, std::floor (std::log10 (lane.x.low))); decade <= lane.x.high; decade *= 10.0)
            for (int i = 1; i < 10; ++i)
                if (const double at = i * decade; at >= lane.x.low && at <= lane.x.high)
                    vertical (at, i == 1 ? juce::String::fromUTF8 (withPrefix (at, lane.x_unit, 1).c_str()) : juce::String(), i == 1,
                              std::numeric_limits<float>::max());
        return;
    }
    const auto along = axisScale (lane.x, "", lane.x_unit);
    auto unit = juce::String::fromUTF8 (along.label.c_str()).fromFirstOccurrenceOf ("(", false, false).upToLastOccurrenceOf (")", false, false);
    const auto ticks = ticksWithin (along.shown (lane.x), std::max (2, static_cast<int> (lane.area.getWidth() / 52.0f)));
    const auto textOf = [&] (std::size_t i) { return juce::String::fromUTF8 (ticks[i].text.c_str()) + (i + 1 == ticks.size() ? " " + unit : juce::String()); };
    const auto placeOf = [&] (std::size_t i) { return along.origin + ticks[i].at * along.unit; };
    for (std::size_t i = 0; i < ticks.size(); ++i)
    {
        // The last label, which has the unit, goes before the others.
        const auto last = ticks.size() - 1;
        const float width = font.getStringWidthFloat (textOf (last)) + 2.0f;
        const float begin = std::min (lane.toPixels (placeOf (last), lane.y.low).x - 0.5f * width, static_cast<float> (getWidth()) - width);
        vertical (placeOf (i), textOf (i), false, i == last ? std::numeric_limits<float>::max() : begin);
    }
}

void ScopePlot::paintCursors (juce::Graphics& g) const
{
    const auto& cursors = spec.cursors;
    for (const auto& c : cursors)
    {
        if (c.lane >= lanes.size()) return;
        const auto& lane = lanes[c.lane];
        const auto p = lane.toPixels (c.x, c.y);
        g.setColour (theme().text.withAlpha (0.6f));
        for (const auto& l : lanes)
            if (p.x >= l.area.getX() && p.x <= l.area.getRight()) g.fillRect (p.x - 0.5f, l.area.getY(), 1.0f, l.area.getHeight());
        if (lane.area.contains (p)) g.fillRect (lane.area.getX(), p.y - 0.5f, lane.area.getWidth(), 1.0f);
    }
    if (cursors.empty()) return;
    const auto& lane = lanes[cursors[0].lane];
    const auto x_unit = lane.x_unit, unit = lane.unit;
    const auto text = [] (double v, const std::string& u) { return juce::String::fromUTF8 (withPrefix (v, u).c_str()); };
    juce::StringArray lines;
    if (cursors.size() < 2)
        lines = { text (cursors[0].x, x_unit) + ", " + text (cursors[0].y, unit) };
    else
    {
        const double dx = cursors[1].x - cursors[0].x, dy = cursors[1].y - cursors[0].y;
        const bool is_time = x_unit == "s";
        lines.add (juce::String::fromUTF8 (is_time ? "Δt " : "Δx ") + text (dx, x_unit));
        if (is_time && dx != 0.0) lines.add (juce::String::fromUTF8 ("1/Δt ") + text (1.0 / std::abs (dx), "Hz"));
        lines.add (juce::String::fromUTF8 ("Δy ") + text (dy, unit));
    }
    paintReadout (g, lines, lane.area);
}

void ScopePlot::paintReadout (juce::Graphics& g, const juce::StringArray& lines, juce::Rectangle<float> area) const
{
    const auto font = lookOf (*this).font (12.0f);
    float width = 0.0f;
    for (const auto& l : lines)
        width = std::max (width, font.getStringWidthFloat (l));
    auto box = area.removeFromTop (16.0f * static_cast<float> (lines.size()) + 6.0f).removeFromRight (width + 18.0f).translated (-4.0f, 4.0f);
    g.setColour (theme().raised.withAlpha (0.92f));
    g.fillRoundedRectangle (box, 4.0f);
    g.setColour (theme().hairline);
    g.drawRoundedRectangle (box.reduced (0.5f), 4.0f, 1.0f);
    g.setColour (theme().text);
    g.setFont (font);
    box.reduce (8.0f, 3.0f);
    for (const auto& l : lines)
        drawNumber (g, l, box.removeFromTop (16.0f));
}

void ScopePlot::paintLegend (juce::Graphics& g, juce::Rectangle<float> line, const std::vector<Entry>& entries, bool at_right) const
{
    const auto font = lookOf (*this).font (11.0f);
    g.setFont (font);
    float width = 0.0f;
    for (const auto& e : entries)
        width += font.getStringWidthFloat (e.text) + 22.0f;
    if (width + 2.0f > line.getWidth())   // the plot is too narrow: over the scale, but not over its unit
        line = line.withLeft (std::max (2.0f, line.getRight() - width - 2.0f)).withTrimmedBottom (4.0f);
    auto box = at_right ? line.removeFromRight (width + 2.0f) : line.removeFromLeft (width + 2.0f);
    g.setColour (theme().canvas.withAlpha (0.8f));
    g.fillRoundedRectangle (box, 3.0f);
    box.removeFromLeft (6.0f);
    for (const auto& e : entries)
    {
        const float w = font.getStringWidthFloat (e.text);
        if (box.getWidth() < w + 12.0f) return;   // a colour without its word says nothing
        g.setColour (e.colour);
        g.fillRoundedRectangle (box.removeFromLeft (8.0f).withSizeKeepingCentre (8.0f, 8.0f), 2.0f);
        box.removeFromLeft (4.0f);
        g.setColour (theme().dim);
        g.drawText (e.text, box.removeFromLeft (w + 1.0f).expanded (1.0f, 0.0f), juce::Justification::centredLeft, false);
        box.removeFromLeft (9.0f);
    }
}

std::size_t ScopePlot::laneAt (juce::Point<float> p) const
{
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < lanes.size(); ++i)
        if (p.y >= lanes[i].area.getY()) nearest = i;
    return nearest;
}

void ScopePlot::followCurves (std::size_t curves)
{
    const bool are_others = std::exchange (followed, curves) != curves;   // their numbers mean others now
    for (auto& c : spec.cursors)
        if (are_others) c.curve.reset();
    for (auto& c : spec.cursors)
        if (c.curve && c.lane < lanes.size()) c = onCurve (c).value_or (c);
}

void ScopePlot::mouseDown (const juce::MouseEvent&) { dragged = false; }

void ScopePlot::mouseDrag (const juce::MouseEvent& e) { dragged = dragged || e.mouseWasDraggedSinceMouseDown(); }

void ScopePlot::mouseUp (const juce::MouseEvent& e)
{
    if (dragged || lanes.empty() || e.mods.isPopupMenu() || e.getNumberOfClicks() > 1) return;
    const auto i = laneAt (e.position);
    const auto at = lanes[i].area.getConstrainedPoint (e.position);
    const Cursor clicked { i, lanes[i].xAt (at.x), lanes[i].yAt (at.y) };
    click (spec.cursors, onCurve (clicked).value_or (clicked));
    repaint();
}

void ScopePlot::mouseDoubleClick (const juce::MouseEvent&)
{
    spec.zoomed.clear();
    spec.cursors.clear();
    spec.back_s = 0.0;
    repaint();
}

void ScopePlot::zoomX (double factor, const Lane&, float)
{
    spec.seconds = std::clamp (spec.seconds * factor, ScopeSpec::least_s, ScopeSpec::most_s);
}

void ScopePlot::mouseWheelMove (const juce::MouseEvent& e, const juce::MouseWheelDetails& wheel)
{
    if (lanes.empty()) return;
    // With Shift, some systems report the wheel as x.
    const float turned = std::abs (wheel.deltaY) > std::abs (wheel.deltaX) ? wheel.deltaY : wheel.deltaX;
    const double factor = std::exp2 (-2.0 * static_cast<double> (turned));
    const auto& lane = lanes[laneAt (e.position)];
    if (e.mods.isShiftDown())
    {
        const double about = lane.yAt (e.position.y);
        const Extent zoomed { about + (lane.y.low - about) * factor, about + (lane.y.high - about) * factor };
        if (isPlottable (zoomed.low) && isPlottable (zoomed.high) && zoomed.size() > 1e-15) spec.zoomed[lane.unit] = zoomed;
    }
    else
        zoomX (factor, lane, e.position.x);
    if (context.onChange) context.onChange();
}

juce::Colour traceColour (const Theme& theme, Quantity q, std::size_t nth_port, std::size_t component, std::size_t components)
{
    auto hue = theme.of (q);
    if (nth_port > 0)
    {
        auto c = colourFor (name (q), nth_port);
        if (! theme.is_dark) c = onPaper (c);
        hue = juce::Colour (c.red, c.green, c.blue);
    }
    const auto colour = componentColour (theme, hue, component, components);
    const bool is_paler = nth_port > 0 && components > 1;   // the components of another vector
    return is_paler ? colour.interpolatedWith (theme.text, 0.45f) : colour;
}

void choosePort (juce::Component& below, const std::vector<ScopePort>& ports, std::function<void (const std::string&)> chosen)
{
    juce::PopupMenu menu;
    for (std::size_t i = 0; i < ports.size();)
    {
        const auto& path = ports[i].path;
        juce::PopupMenu node;
        auto role = ports[i].port.role;
        for (; i < ports.size() && ports[i].path == path; ++i)
        {
            if (ports[i].port.role != role) node.addSeparator();
            role = ports[i].port.role;
            node.addItem (juce::String (ports[i].port.id), [chosen, port = ports[i].name] { chosen (port); });
        }
        menu.addSubMenu (juce::String (path), node);
    }
    menu.showMenuAsync (juce::PopupMenu::Options().withTargetComponent (below));
}

}   // namespace tactus::host
