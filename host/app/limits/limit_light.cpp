// SPDX-License-Identifier: GPL-3.0-or-later
#include "limit_light.hpp"

#include <host/app/look/text.hpp>

namespace tactus::host
{

namespace
{
std::string counted (std::size_t n, const char* what) { return std::to_string (n) + ' ' + what + (n == 1 ? "" : "s"); }

juce::String labelOf (const LimitList& list)
{
    const auto broken = list.broken(), near = list.limits.size() - broken;
    if (broken > 0) return counted (broken, "limit") + " broken";
    if (near > 0) return counted (near, "limit") + " near";
    return list.unknown > 0 ? counted (list.unknown, "limit") + " unknown" : "limits hold";
}

/// The first few limits in full, and how many more there are.
juce::String tooltipOf (const LimitList& list)
{
    constexpr std::size_t most = 3;
    std::string text;
    for (std::size_t i = 0; i < list.limits.size() && i < most; ++i)
    {
        const auto& l = list.limits[i];
        text += l.text + ".\n" + (l.remedy.empty() ? "" : "Would help: " + l.remedy + ".\n") + '\n';
    }
    if (list.limits.size() > most) text += "And " + counted (list.limits.size() - most, "more limit") + ".\n\n";
    if (list.limits.empty()) text += "No limit of the devices is broken, and none is near.\n\n";
    text += counted (list.held, "other condition") + (list.held == 1 ? " holds" : " hold");
    if (list.unknown > 0) text += "; " + std::to_string (list.unknown) + " cannot be judged, because numbers of the device are not known";
    return fromUtf8 (text + ". Measured along the path of the hand that the graph describes. Click for the list.");
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

void LimitLight::show (const LimitList& list)
{
    setVisible (list.is_checked);
    if (list == shown) return;
    shown = list;
    setTooltip (tooltipOf (shown));
    setTitle (getTooltip());
    repaint();
}

void LimitLight::paintButton (juce::Graphics& g, bool over, bool)
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    auto area = getLocalBounds().toFloat();
    const auto lamp = juce::Rectangle<float> (10.0f, 10.0f).withCentre ({ area.getX() + 11.0f, area.getCentreY() });
    if (shown.limits.empty())
    {
        g.setColour (shown.unknown > 0 ? theme.dim : theme.of (Quantity::energy).withMultipliedAlpha (0.6f));
        g.fillEllipse (lamp);
    }
    else
        drawLimitLight (g, lamp, shown.broken() > 0, theme);
    g.setColour (over || ! shown.limits.empty() ? theme.text : theme.dim);
    g.setFont (look.font (13.0f));
    g.drawText (labelOf (shown), area.withTrimmedLeft (24.0f), juce::Justification::centredLeft, false);
}

}   // namespace tactus::host
