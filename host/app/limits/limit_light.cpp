// SPDX-License-Identifier: GPL-3.0-or-later
#include "limit_light.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host
{

namespace
{
juce::String labelOf (const LimitList& list)
{
    const auto broken = list.broken(), near = list.limits.size() - broken;
    if (broken > 0) return filled (broken == 1 ? TRANS ("%1 limit broken") : TRANS ("%1 limits broken"), broken);
    if (near > 0) return filled (near == 1 ? TRANS ("%1 limit near") : TRANS ("%1 limits near"), near);
    const auto open = list.unjudged.size();
    if (open == 0) return TRANS ("limits hold");
    return filled (open == 1 ? TRANS ("%1 limit not judged") : TRANS ("%1 limits not judged"), open);
}

/// The first few limits in full, and how many more there are.
juce::String tooltipOf (const LimitList& list)
{
    constexpr std::size_t most = 3;
    juce::String text;
    for (std::size_t i = 0; i < list.limits.size() && i < most; ++i)
    {
        const auto& l = list.limits[i];
        text << fromUtf8 (l.text) << ".\n"
             << fromUtf8 (l.details) << "\n\n";
    }
    if (const auto more = list.limits.size() - std::min (most, list.limits.size()); more > 0)
        text << filled (more == 1 ? TRANS ("And %1 more limit.") : TRANS ("And %1 more limits."), more) << "\n\n";
    if (list.limits.empty()) text << TRANS ("No limit of the devices is broken, and none is near.") << "\n\n";
    text << filled (list.held == 1 ? TRANS ("%1 other condition holds") : TRANS ("%1 other conditions hold"), list.held);
    if (list.unknown > 0) text << "; " << filled (TRANS ("%1 cannot be judged, because numbers of the device are not known"), list.unknown);
    if (list.not_reached > 0)
        text << "; "
             << filled (list.not_reached == 1 ? TRANS ("%1 node is not judged, because the hand does not reach it")
                                              : TRANS ("%1 nodes are not judged, because the hand does not reach them"),
                        list.not_reached);
    return text + ". " + TRANS ("Measured along the path of the hand that the graph describes. Click for the list.");
}
}   // namespace

void drawLimitLight (juce::Graphics& g, juce::Rectangle<float> area, bool is_broken, const Theme& theme)
{
    g.setColour (theme.canvas);
    g.fillEllipse (area.expanded (area.getWidth() * 0.2f));
    g.setColour (is_broken ? theme.stop : theme.warning);
    if (is_broken)
        g.fillEllipse (area);
    else
        g.drawEllipse (area.reduced (area.getWidth() * 0.15f), area.getWidth() * 0.3f);
}

void LimitLight::show (const LimitList& list, bool is_up_to_date)
{
    setVisible (list.is_checked);
    if (std::exchange (is_of_now, is_up_to_date) == is_up_to_date && list == shown) return;
    shown = list;
    setTooltip (is_of_now ? tooltipOf (shown) : TRANS ("The limits are being checked. Before the latest change:") + "\n\n" + tooltipOf (shown));
    setTitle (getTooltip());
    repaint();
}

void LimitLight::paintButton (juce::Graphics& g, bool over, bool)
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    auto area = getLocalBounds().toFloat();
    const auto lamp = juce::Rectangle<float> (10.0f, 10.0f).withCentre ({ area.getX() + 11.0f, area.getCentreY() });
    if (shown.limits.empty() || ! is_of_now)
    {
        g.setColour (! is_of_now || ! shown.unjudged.empty() ? theme.dim : theme.of (Quantity::energy).withMultipliedAlpha (0.6f));
        g.fillEllipse (lamp);
    }
    else
        drawLimitLight (g, lamp, shown.broken() > 0, theme);
    g.setColour (over || ! shown.limits.empty() ? theme.text : theme.dim);
    g.setFont (look.font (13.0f));
    g.drawText (is_of_now ? labelOf (shown) : TRANS ("checking limits"), area.withTrimmedLeft (24.0f), juce::Justification::centredLeft, false);
}

}   // namespace tactus::host
