// SPDX-License-Identifier: GPL-3.0-or-later
#include "tour.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::host
{

Tour::Tour()
{
    setTitle (TRANS ("Guided tour"));
    setWantsKeyboardFocus (true);
    next.setFirst (true);
    next.onClick = [this] { go (1); };
    back.onClick = [this] { go (-1); };
    skip.onClick = [this] { close(); };
    for (auto* b : { &next, &back, &skip })
        addAndMakeVisible (b);
    setVisible (false);
}

void Tour::begin (std::vector<Step> all)
{
    steps = std::move (all);
    now = 0;
    if (steps.empty()) return;
    setVisible (true);
    toFront (false);
    go (0);
}

void Tour::go (int by)
{
    if (! isOpen()) return;
    const auto to = static_cast<int> (now) + by;
    if (to >= static_cast<int> (steps.size())) return close();
    now = static_cast<std::size_t> (std::max (0, to));
    if (onStep) onStep (steps[now]);
    setDescription (steps[now].title + ". " + steps[now].text);
    next.setButtonText (now + 1 < steps.size() ? TRANS ("Next") : TRANS ("Done"));
    skip.setVisible (now + 1 < steps.size());
    resized();
    repaint();
    takeFocus (*this);
}

void Tour::close()
{
    if (! isOpen()) return;
    setVisible (false);
    if (auto* parent = getParentComponent()) takeFocus (*parent);
    if (onEnd) onEnd();
}

bool Tour::keyPressed (const juce::KeyPress& key)
{
    if (key == juce::KeyPress::returnKey || key == juce::KeyPress::rightKey)
        go (1);
    else if (key == juce::KeyPress::leftKey)
        go (-1);
    else
        return false;
    return true;
}

juce::Rectangle<int> Tour::framed() const
{
    const auto* part = now < steps.size() ? steps[now].part : nullptr;
    if (part == nullptr || ! part->isShowing()) return {};
    return getLocalArea (part, part->getLocalBounds()).getIntersection (getLocalBounds()).reduced (2);
}

juce::TextLayout Tour::layout (int card_width) const
{
    const auto& look = lookOf (*this);
    const auto text = now < steps.size() ? steps[now].text : juce::String();
    return wrapText (text, look.font (13.0f), look.theme().text, static_cast<float> (card_width - 2 * margin));
}

int Tour::heightFor (int card_width) const { return 3 * margin + 24 + 4 + 32 + static_cast<int> (std::ceil (layout (card_width).getHeight())); }

/// A card of this width beside the part, which it leaves free: the part is there to be tried. Empty if there is no room.
juce::Rectangle<int> Tour::besidePart (int card_width) const
{
    const auto part = framed();
    const auto all = getLocalBounds().reduced (gap);
    const juce::Rectangle<int> size (card_width, heightFor (card_width));
    const int x = std::max (all.getX(), part.getX()), y = std::max (all.getY(), part.getY());
    const int lowest = std::max (all.getY(), std::min (y, all.getBottom() - size.getHeight()));
    for (const auto& place : { size.withPosition (part.getRight() + gap, lowest), size.withPosition (part.getX() - gap - card_width, lowest),
                               size.withPosition (x, part.getY() - gap - size.getHeight()), size.withPosition (x, part.getBottom() + gap) })
        if (all.contains (place)) return place;
    return {};
}

/// The card is beside the part, narrower in a small window, or else in a corner of the part.
void Tour::resized()
{
    if (! isOpen()) return;
    const auto part = framed();
    const auto all = getLocalBounds().reduced (gap);
    card = {};
    if (! part.isEmpty())
        for (int w = width; card.isEmpty() && w >= least_width; w -= 8)
            card = besidePart (w);
    if (card.isEmpty())
    {
        const int w = std::min (width, all.getWidth());
        const juce::Rectangle<int> size (w, std::min (heightFor (w), all.getHeight()));
        card = part.isEmpty() ? size.withCentre (all.getCentre())
                              : size.withPosition (part.getRight() - gap - w, part.getY() + gap).constrainedWithin (all);
    }
    auto row = card.reduced (margin).removeFromBottom (32);
    const int others = next.widthFor() + (skip.isVisible() ? skip.widthFor() + 8 : 0);
    back.setVisible (now > 0 && others + 8 + back.widthFor() <= row.getWidth());   // the left arrow goes back, too
    for (auto* b : { &next, &back })
    {
        b->setBounds (row.removeFromRight (b->widthFor()));
        row.removeFromRight (8);
    }
    skip.setBounds (row.removeFromLeft (skip.widthFor()));
}

void Tour::paint (juce::Graphics& g)
{
    if (now >= steps.size()) return;
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    g.setColour (theme.accent);
    g.drawRoundedRectangle (framed().toFloat(), 6.0f, 2.0f);
    drawCard (g, theme, card);
    g.setColour (theme.accent);
    g.drawRoundedRectangle (card.toFloat().reduced (0.5f), 8.0f, 1.5f);
    auto area = card.reduced (margin);
    auto first = area.removeFromTop (24);
    g.setColour (theme.dim);
    g.setFont (look.font (12.0f));
    g.drawText (filled (TRANS ("%1 of %2"), now + 1, steps.size()), first.removeFromRight (52), juce::Justification::centredRight, false);
    g.setColour (theme.text);
    g.setFont (look.font (15.0f, true));
    g.drawText (steps[now].title, first, juce::Justification::centredLeft, true);
    area.removeFromTop (4);
    layout (card.getWidth()).draw (g, area.toFloat());
}

}   // namespace tactus::host
