// SPDX-License-Identifier: GPL-3.0-or-later
#include "port_card.hpp"

#include <host/app/look/component_colour.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/tools/figures/axis.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace tactus::host
{

namespace
{
constexpr int card_padding = 8, title_height = 16, value_height = 24, gap_to_port = 16;

/// The range of the plot. It always contains 0, so that a small change of a large value looks small.
Extent plotRange (const PortCard& card)
{
    Extent all;
    all.include (0.0);
    for (const auto& column : *card.course)
        for (std::size_t i = 0; i < card.values.size(); ++i)
            for (const double v : { column.low[i], column.high[i] })
                if (isPlottable (v)) all.include (v);
    return widened (all, 0.05);
}

void paintCourse (juce::Graphics& g, const PortCard& card, juce::Rectangle<float> area, const Theme& theme)
{
    const auto range = plotRange (card);
    const auto toY = [&] (double v) { return area.getBottom() - area.getHeight() * static_cast<float> ((v - range.low) / range.size()); };
    g.setColour (theme.hairline);
    g.drawHorizontalLine (juce::roundToInt (toY (0.0)), area.getX(), area.getRight());
    const auto& course = *card.course;
    const float step = area.getWidth() / static_cast<float> (std::max<std::size_t> (1, card.columns));
    constexpr float thickness = 1.25f;
    for (std::size_t part = card.values.size(); part-- > 0;)
    {
        juce::RectangleList<float> spans;
        float x = area.getRight() - step * static_cast<float> (course.size());
        double low_before = 0.0, high_before = 0.0;
        for (std::size_t i = 0; i < course.size(); ++i, x += step)
        {
            double low = course[i].low[part], high = course[i].high[part];
            if (! isPlottable (low) || ! isPlottable (high)) continue;
            if (i > 0)   // joins the column before
            {
                low = std::min (low, high_before);
                high = std::max (high, low_before);
            }
            low_before = course[i].low[part];
            high_before = course[i].high[part];
            spans.addWithoutMerging ({ x, toY (high) - thickness / 2, std::max (1.0f, step), toY (low) - toY (high) + thickness });
        }
        g.setColour (componentColour (theme, theme.of (card.quantity), part, card.values.size()));
        g.fillRectList (spans);
    }
}

void paintValues (juce::Graphics& g, const PortCard& card, juce::Rectangle<float> area, const Look& look)
{
    const auto& theme = look.theme();
    if (card.values.size() == 1)
    {
        g.setFont (look.font (16.0f, true));
        g.setColour (theme.text);
        return g.drawText (fromUtf8 (card.values.front()), area, juce::Justification::centredLeft, false);
    }
    const float width = area.getWidth() / static_cast<float> (std::max<std::size_t> (1, card.values.size()));
    for (std::size_t i = 0; i < card.values.size(); ++i)
    {
        const auto cell = area.removeFromLeft (width);
        g.setColour (componentColour (theme, theme.of (card.quantity), i, card.values.size()));
        g.fillEllipse (juce::Rectangle<float> (5.0f, 5.0f).withCentre ({ cell.getX() + 3.0f, cell.getCentreY() }));
        g.setFont (look.font (12.0f, true));
        g.setColour (theme.text);
        g.drawText (fromUtf8 (card.values[i]), cell.withTrimmedLeft (10.0f), juce::Justification::centredLeft, false);
    }
}
}   // namespace

juce::Rectangle<int> boundsOf (const PortCard& card, juce::Point<float> pixel, juce::Rectangle<int> canvas)
{
    constexpr int height = 2 * card_padding + title_height + value_height + PortCard::plot_height;
    juce::Rectangle<int> card_area (PortCard::width, height);
    const auto at = pixel.toInt();
    const int level = at.y - height / 2, left = at.x - gap_to_port - PortCard::width, right = at.x + gap_to_port;
    const int above = at.y - gap_to_port - height, below = at.y + gap_to_port;
    const int beside = above < canvas.getY() ? below : above;   // if there is no room on its side: the port itself stays visible
    switch (card.where.side)
    {
    case PointedPort::Side::left:
        card_area.setPosition (left, left < canvas.getX() ? beside : level);
        break;
    case PointedPort::Side::right:
        card_area.setPosition (right, right + PortCard::width > canvas.getRight() ? beside : level);
        break;
    case PointedPort::Side::below:
        card_area.setPosition (right, below + height > canvas.getBottom() ? above : below);
        break;
    }
    return card_area.constrainedWithin (canvas.reduced (4));
}

void paintCard (juce::Graphics& g, const PortCard& card, juce::Rectangle<int> bounds, const Look& look)
{
    const auto& theme = look.theme();
    const auto area = bounds.toFloat();
    g.setColour (juce::Colours::black.withAlpha (theme.is_dark ? 0.35f : 0.12f));
    g.fillRoundedRectangle (area.translated (0.0f, 2.0f), 4.0f);
    g.setColour (theme.panel);
    g.fillRoundedRectangle (area, 4.0f);
    g.setColour (theme.hairline);
    g.drawRoundedRectangle (area.reduced (0.5f), 4.0f, 1.0f);

    auto inside = area.reduced (static_cast<float> (card_padding));
    const auto title = inside.removeFromTop (static_cast<float> (title_height));
    g.setFont (look.font (12.0f));
    g.setColour (theme.dim);
    g.drawText (fromUtf8 (card.title), title.withTrimmedRight (24.0f), juce::Justification::centredLeft, true);
    g.drawText (fromUtf8 (card.seconds), title, juce::Justification::centredRight, false);
    paintValues (g, card, inside.removeFromTop (static_cast<float> (value_height)), look);
    g.setFont (look.font (10.0f));
    g.setColour (theme.dim);
    if (! card.course) return;
    const auto scale = inside.removeFromRight (48.0f).withTrimmedLeft (6.0f);
    g.drawText (fromUtf8 (card.high), scale.withHeight (12.0f), juce::Justification::centredLeft, false);
    g.drawText (fromUtf8 (card.low), scale.withTrimmedTop (scale.getHeight() - 12.0f), juce::Justification::centredLeft, false);
    const juce::Graphics::ScopedSaveState clipped (g);
    g.reduceClipRegion (inside.toNearestInt());
    paintCourse (g, card, inside, theme);
}

}   // namespace tactus::host
