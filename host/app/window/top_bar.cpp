// SPDX-License-Identifier: GPL-3.0-or-later
#include "top_bar.hpp"

namespace tactus::host
{

void TopBar::show (std::vector<juce::String> w, bool c)
{
    way = std::move (w);
    changed = c;
    repaint();
}

std::vector<juce::Rectangle<float>> TopBar::places() const
{
    std::vector<juce::Rectangle<float>> all;
    float x = 16.0f;
    for (const auto& name : way)
    {
        const float width = lookOf (*this).font (14.0f, true).getStringWidthFloat (name);
        all.push_back ({ x, 0.0f, width, static_cast<float> (getHeight()) });
        x += width + 28.0f;
    }
    return all;
}

void TopBar::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    g.fillAll (theme.panel);
    g.setColour (theme.hairline);
    g.drawHorizontalLine (getHeight() - 1, 0.0f, static_cast<float> (getWidth()));
    const auto all = places();
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        g.setFont (look.font (14.0f, true));
        g.setColour (i + 1 == all.size() ? theme.text : theme.dim);
        g.drawText (way[i], all[i].expanded (4.0f, 0.0f), juce::Justification::centred, false);
        if (i + 1 == all.size()) continue;
        juce::Path arrow;
        const auto at = juce::Point<float> (all[i].getRight() + 12.0f, all[i].getCentreY());
        arrow.startNewSubPath (at.translated (0.0f, -4.0f));
        arrow.lineTo (at.translated (4.0f, 0.0f));
        arrow.lineTo (at.translated (0.0f, 4.0f));
        g.strokePath (arrow, juce::PathStrokeType (1.3f));
    }
    if (! changed || all.empty()) return;
    g.setFont (look.font (12.0f));
    g.setColour (theme.dim);
    g.drawText ("edited", all.back().withX (all.back().getRight() + 14.0f).withWidth (80.0f), juce::Justification::centredLeft, false);
}

void TopBar::mouseMove (const juce::MouseEvent& e)
{
    const auto all = places();
    const bool over = std::any_of (all.begin(), all.empty() ? all.end() : std::prev (all.end()), [&] (const auto& r)
                                   { return r.contains (e.position); });
    setMouseCursor (over ? juce::MouseCursor::PointingHandCursor : juce::MouseCursor::NormalCursor);
}

void TopBar::mouseUp (const juce::MouseEvent& e)
{
    const auto all = places();
    for (std::size_t i = 0; i + 1 < all.size(); ++i)
        if (all[i].contains (e.position) && onLeave) onLeave (i);
}

}   // namespace tactus::host
