// SPDX-License-Identifier: GPL-3.0-or-later
#include "take_plot.hpp"

#include <host/app/look/component_colour.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/model/with_prefix.hpp>
#include <host/app/text/filled.hpp>
#include <host/tools/figures/axis.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
constexpr float edge_grip = 6.0f;   // pixels beside an edge
constexpr double key_step = 0.01;   // s, less in a zoomed view
}   // namespace

TakePlot::TakePlot()
{
    setTitle (TRANS ("Recording; arrow keys move the stretch, with Shift its end"));
    setWantsKeyboardFocus (true);
}

void TakePlot::show (Stretch s)
{
    const bool is_other = s.ticks() != shown.ticks();
    const bool was_whole = view_from <= 0.0 && view_until >= length();
    shown = std::move (s);
    findRange();
    if (is_other) mark (0.0, length());
    was_whole || view_until > length() ? setView (0.0, length()) : setView (view_from, view_until);
}

/// Shows a part, in s.
void TakePlot::setView (double from, double until)
{
    view_from = from;
    view_until = until;
    columnsOf();
    repaint();
}

void TakePlot::findRange()
{
    low = high = 0.0;
    const auto include = [this] (const Stretch& s) {
        for (const double v : s.values)
            if (std::isfinite (v))
            {
                low = std::min (low, v);
                high = std::max (high, v);
            }
    };
    include (shown);
    if (showsPinned()) include (pinned);
    if (high - low < 1e-12) high = low + 1.0;
}

void TakePlot::pin (const juce::String& name)
{
    pinned = shown;
    pinned_name = name;
    findRange();
    repaint();
}

void TakePlot::unpin()
{
    pinned = {};
    findRange();
    repaint();
}

void TakePlot::setText (const juce::String& t)
{
    if (t == text) return;
    text = t;
    repaint();
}

void TakePlot::mark (double from, double until)
{
    if (from > until) std::swap (from, until);
    from_s = std::clamp (from, 0.0, length());
    until_s = std::clamp (until, 0.0, length());
    if (onMark) onMark();
    repaint();
}

float TakePlot::xAt (double s) const { return area().getX() + static_cast<float> ((s - view_from) / viewLength()) * area().getWidth(); }

double TakePlot::timeAt (float x) const
{
    return view_from + std::clamp (static_cast<double> ((x - area().getX()) / area().getWidth()), 0.0, 1.0) * (view_until - view_from);
}

TakePlot::Edge TakePlot::edgeAt (float x) const
{
    const float to_from = std::abs (x - xAt (from_s)), to_until = std::abs (x - xAt (until_s));
    if (std::min (to_from, to_until) > edge_grip) return Edge::none;
    return to_from < to_until ? Edge::from : Edge::until;
}

void TakePlot::columnsOf()
{
    columns.assign (shown.names.size(), {});
    const auto width = static_cast<std::size_t> (std::max (1.0f, area().getWidth()));
    const auto ticks = shown.ticks();
    if (ticks == 0) return;
    const auto tickAt = [&] (std::size_t x) {
        const double s = view_from + viewLength() * static_cast<double> (x) / static_cast<double> (width);
        return std::min (ticks, static_cast<std::size_t> (s * shown.rate_hz + 1e-6));
    };
    for (std::size_t c = 0; c < columns.size(); ++c)
        for (std::size_t x = 0; x < width; ++x)
        {
            const auto begin = std::min (ticks - 1, tickAt (x)), next = std::min (ticks - 1, tickAt (x + 1)), end = std::max (begin + 1, next);
            double least = shown.value (begin, c), most = least;
            for (auto k = begin; k < (next > begin ? std::min (end + 1, ticks) : end); ++k)   // one more, so that columns of other ticks join
            {
                least = std::min (least, shown.value (k, c));
                most = std::max (most, shown.value (k, c));
            }
            columns[c].emplace_back (least, most);
        }
}

juce::Colour TakePlot::colourOf (std::size_t component) const
{
    const auto& theme = themeOf (*this);
    return componentColour (theme, theme.of (shown.quantity), component, columns.size());
}

/// The largest and smallest value, and the names of the components.
void TakePlot::paintScale (juce::Graphics& g) const
{
    const auto& look = lookOf (*this);
    const auto box = area().reduced (6.0f, 3.0f).toNearestInt();
    g.setFont (look.font (11.0f));
    g.setColour (look.theme().dim);
    g.drawText (juce::String::fromUTF8 (withPrefix (high, shown.unit).c_str()), box, juce::Justification::topLeft, false);
    g.drawText (juce::String::fromUTF8 (withPrefix (low, shown.unit).c_str()), box, juce::Justification::bottomLeft, false);
    if (columns.size() != 3) return;
    auto names = box.withHeight (14);
    for (std::size_t c = 3; c-- > 0;)
    {
        g.setColour (colourOf (c));
        g.drawText (juce::String::charToString (static_cast<juce::juce_wchar> ('x' + static_cast<int> (c))), names.removeFromRight (14),
                    juce::Justification::centred, false);
    }
}

float TakePlot::yAt (double value) const
{
    const auto box = area().reduced (0.0f, 4.0f);
    return box.getBottom() - static_cast<float> ((value - low) / (high - low)) * box.getHeight();
}

/// The pinned curve, in grey.
void TakePlot::paintPinned (juce::Graphics& g) const
{
    const auto box = area();
    const auto width = static_cast<std::size_t> (std::max (1.0f, box.getWidth()));
    const auto tickAt = [&] (std::size_t x) {   // counted from its first tick
        const double s = begins() + view_from + viewLength() * static_cast<double> (x) / static_cast<double> (width);
        return s * pinned.rate_hz - static_cast<double> (pinned.from);
    };
    g.setColour (themeOf (*this).dim.withAlpha (0.7f));
    for (std::size_t c = 0; c < pinned.names.size(); ++c)
        for (std::size_t x = 0; x < width; ++x)
        {
            const double begin = std::floor (tickAt (x)), next = std::floor (tickAt (x + 1));
            if (begin < 0.0) continue;                                                                                     // before what is kept of it
            const double end = std::min (static_cast<double> (pinned.ticks()), next > begin ? next + 1.0 : begin + 1.0);   // one more, as above
            Extent all;
            for (auto k = static_cast<std::size_t> (begin); static_cast<double> (k) < end; ++k)
                if (std::isfinite (pinned.value (k, c))) all.include (pinned.value (k, c));
            if (! all.isEmpty()) g.fillRect (box.getX() + static_cast<float> (x), yAt (all.high), 1.2f, std::max (1.2f, yAt (all.low) - yAt (all.high)));
        }
}

/// The name of the pinned curve, on a ground of its own: the curves are behind it.
void TakePlot::paintPinnedName (juce::Graphics& g) const
{
    const auto& look = lookOf (*this);
    const auto name = filled (TRANS ("grey: %1"), pinned_name);
    const auto box = area().reduced (6.0f, 3.0f);
    g.setFont (look.font (11.0f));
    const auto ground = box.withTop (box.getBottom() - 14.0f).removeFromRight (std::min (box.getWidth(), g.getCurrentFont().getStringWidthFloat (name) + 8.0f));
    g.setColour (look.theme().canvas);
    g.fillRoundedRectangle (ground, 2.0f);
    g.setColour (look.theme().text);
    g.drawText (name, ground.toNearestInt(), juce::Justification::centred, false);
}

void TakePlot::paintCurves (juce::Graphics& g) const
{
    const auto& theme = themeOf (*this);
    const auto box = area().reduced (0.0f, 4.0f);
    g.setColour (theme.hairline);
    g.drawHorizontalLine (juce::roundToInt (yAt (0.0)), box.getX(), box.getRight());
    for (std::size_t c = columns.size(); c-- > 0;)
    {
        g.setColour (colourOf (c));
        for (std::size_t x = 0; x < columns[c].size(); ++x)
        {
            const auto [least, most] = columns[c][x];
            if (! std::isfinite (least) || ! std::isfinite (most)) continue;
            const float top = yAt (most), bottom = std::max (yAt (least), top + 1.2f);
            g.fillRect (box.getX() + static_cast<float> (x), top, 1.2f, bottom - top);
        }
    }
}

void TakePlot::paintMark (juce::Graphics& g) const
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    const auto box = area();
    const auto within = [&] (float x) { return std::clamp (x, box.getX(), box.getRight()); };
    const float a = within (xAt (from_s)), b = within (xAt (until_s));
    const auto paintEdge = [&] (double s) {
        if (s >= view_from && s <= view_until) g.fillRect (xAt (s) - 1.0f, box.getY(), 2.0f, box.getHeight());
    };
    g.setColour (theme.canvas.withAlpha (0.45f));
    g.fillRect (box.withRight (a));
    g.fillRect (box.withLeft (b));
    g.setColour (theme.accent.withAlpha (0.10f));
    g.fillRect (box.withLeft (a).withRight (b));
    g.setColour (theme.accent);
    paintEdge (from_s);
    paintEdge (until_s);
    g.setColour (theme.dim);
    g.setFont (look.font (11.0f));
    const auto low_edge = getLocalBounds().removeFromBottom (15).reduced (2, 0);
    const double begin = begins() + view_from;
    const auto ends = juce::String (begins() + view_until, 2) + " s";
    g.drawText (begin > 0.0 ? juce::String (begin, 2) + " s" : "0 s", low_edge, juce::Justification::centredLeft, false);
    g.drawText (ends, low_edge, juce::Justification::centredRight, false);
    const float room = g.getCurrentFont().getStringWidthFloat (ends) + 24.0f;
    for (const auto& tick : ticksWithin ({ begin, begins() + view_until }, std::max (2, low_edge.getWidth() / 100)))
    {
        const float x = xAt (tick.at - begins());
        if (x < box.getX() + room || x > box.getRight() - room) continue;
        g.drawVerticalLine (juce::roundToInt (x), box.getBottom(), box.getBottom() + 3.0f);
        g.drawText (fromUtf8 (tick.text), juce::Rectangle<float> (x - 40.0f, static_cast<float> (low_edge.getY()), 80.0f, 15.0f),
                    juce::Justification::centred, false);
    }
}

void TakePlot::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    g.setColour (theme.canvas);
    g.fillRoundedRectangle (area(), 4.0f);
    if (shown.ticks() == 0)
    {
        g.setColour (theme.dim);
        g.setFont (look.font (13.0f));
        g.drawFittedText (text, area().reduced (16.0f, 8.0f).toNearestInt(), juce::Justification::centred, 5, 1.0f);
    }
    else
    {
        if (showsPinned()) paintPinned (g);
        paintCurves (g);
        paintMark (g);
        paintScale (g);
        if (showsPinned()) paintPinnedName (g);
    }
    g.setColour (hasKeyboardFocus (false) ? theme.accent : theme.hairline);
    g.drawRoundedRectangle (area(), 4.0f, 1.0f);
}

void TakePlot::mouseDown (const juce::MouseEvent& e)
{
    if (shown.ticks() == 0) return;
    held = edgeAt (e.position.x);
    pressed_s = timeAt (e.position.x);
    if (held == Edge::from) pressed_s = until_s;
    if (held == Edge::until) pressed_s = from_s;
}

void TakePlot::mouseDrag (const juce::MouseEvent& e)
{
    if (shown.ticks() == 0 || (held == Edge::none && ! e.mouseWasDraggedSinceMouseDown())) return;
    mark (pressed_s, timeAt (e.position.x));
}

void TakePlot::mouseDoubleClick (const juce::MouseEvent&)
{
    mark (0.0, length());
    setView (0.0, length());
}

/// Zooms around the pointer. Sideways, or with Shift, it moves along the take.
void TakePlot::mouseWheelMove (const juce::MouseEvent& e, const juce::MouseWheelDetails& wheel)
{
    constexpr double least_s = 5e-3;
    if (shown.ticks() == 0) return;
    const double before = view_until - view_from, about = timeAt (e.position.x);
    const bool moves = e.mods.isShiftDown() || std::abs (wheel.deltaX) > std::abs (wheel.deltaY);
    const double turned = static_cast<double> (std::abs (wheel.deltaX) > std::abs (wheel.deltaY) ? wheel.deltaX : wheel.deltaY);
    const double now = moves ? before : std::clamp (before * std::exp2 (-2.0 * turned), std::min (least_s, length()), length());
    const double from = moves ? view_from - 0.5 * turned * before : about - (about - view_from) * now / std::max (1e-9, before);
    const double begin = std::clamp (from, 0.0, length() - now);
    setView (begin, begin + now);
}

void TakePlot::mouseMove (const juce::MouseEvent& e)
{
    const bool on_edge = shown.ticks() > 0 && edgeAt (e.position.x) != Edge::none;
    if (onHint && shown.ticks() > 0) onHint (TRANS ("Drag to mark a stretch, or to move its edge; the wheel zooms. Double-click to mark and see all. "
                                                    "The arrow keys move the stretch."));
    setMouseCursor (on_edge ? juce::MouseCursor::LeftRightResizeCursor : juce::MouseCursor::NormalCursor);
}

void TakePlot::mouseExit (const juce::MouseEvent&)
{
    if (onHint) onHint ({});
}

bool TakePlot::keyPressed (const juce::KeyPress& key)
{
    const bool left = key.getKeyCode() == juce::KeyPress::leftKey, right = key.getKeyCode() == juce::KeyPress::rightKey;
    if ((! left && ! right) || shown.ticks() == 0) return false;
    const double step = std::min (key_step, 0.02 * viewLength()), by = left ? -step : step;
    if (key.getModifiers().isShiftDown())
        mark (from_s, std::max (from_s, until_s + by));
    else if (from_s + by >= 0.0 && until_s + by <= length())
        mark (from_s + by, until_s + by);
    return true;
}

}   // namespace tactus::host
