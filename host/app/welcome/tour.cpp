// SPDX-License-Identifier: GPL-3.0-or-later
#include "tour.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>

#include <algorithm>
#include <array>
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
    back.setVisible (now > 0);
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

juce::TextLayout Tour::layout() const
{
    const auto& look = lookOf (*this);
    return wrapText (now < steps.size() ? steps[now].text : juce::String(), look.font (13.0f), look.theme().text, static_cast<float> (width - 2 * margin));
}

/// The card is beside the part, or else in a corner of it.
void Tour::resized()
{
    const int height = margin + 24 + 4 + static_cast<int> (std::ceil (layout().getHeight())) + 16 + 32 + margin;
    const auto part = framed();
    constexpr int gap = 12;
    const auto all = getLocalBounds().reduced (gap);
    const juce::Rectangle<int> size (std::min (width, all.getWidth()), std::min (height, all.getHeight()));
    card = size.withCentre (all.getCentre());
    if (! part.isEmpty())
    {
        const int x = std::max (all.getX(), part.getX()), y = std::max (all.getY(), part.getY());
        const std::array places { size.withPosition (part.getRight() + gap, y), size.withPosition (part.getX() - gap - size.getWidth(), y),
                                  size.withPosition (x, part.getY() - gap - size.getHeight()), size.withPosition (x, part.getBottom() + gap) };
        const auto free = std::ranges::find_if (places, [&] (const auto& p) { return all.contains (p); });
        card = (free != places.end() ? *free : size.withPosition (part.getRight() - gap - size.getWidth(), part.getY() + gap)).constrainedWithin (all);
    }
    auto row = card.reduced (margin).removeFromBottom (32);
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
    layout().draw (g, area.toFloat());
}

}   // namespace tactus::host
