// SPDX-License-Identifier: GPL-3.0-or-later
#include "set_row.hpp"

#include <host/app/look/button.hpp>
#include <host/app/text/filled.hpp>

namespace tactus::host
{

class SetRow::Arrow final : public Button
{
public:
    Arrow() : Button (TRANS ("Reset"))
    {
        setTooltip (TRANS ("Reset to default"));
        setMouseCursor (juce::MouseCursor::PointingHandCursor);
    }

    void paintButton (juce::Graphics& g, bool over, bool) override
    {
        const auto at = getLocalBounds().toFloat().getCentre();
        constexpr float r = 4.5f, pi = juce::MathConstants<float>::pi;
        juce::Path p;
        p.addCentredArc (at.x, at.y, r, r, 0.0f, -0.4f * pi, 1.2f * pi, true);
        const auto& theme = themeOf (*this);
        g.setColour (over ? theme.text : theme.dim);
        g.strokePath (p, juce::PathStrokeType (1.4f));
        const auto tip = at.getPointOnCircumference (r, -0.4f * pi);
        juce::Path head;
        head.addTriangle (tip.translated (-3.2f, -0.5f), tip.translated (2.6f, -2.6f), tip.translated (0.6f, 3.2f));
        g.fillPath (head);
    }
};

/// Tracks the mouse over the row and its children.
class SetRow::Watch final : public juce::MouseListener
{
public:
    explicit Watch (SetRow& r) : row (r) {}
    void mouseEnter (const juce::MouseEvent&) override { row.hover(); }
    void mouseExit (const juce::MouseEvent&) override { row.hover(); }
    void mouseDown (const juce::MouseEvent& e) override
    {
        if (e.mods.isPopupMenu()) row.openMenu();
    }

private:
    SetRow& row;
};

SetRow::SetRow (juce::String l) : label_text (std::move (l)), arrow (std::make_unique<Arrow>()), watch (std::make_unique<Watch> (*this))
{
    arrow->onClick = [this] {
        if (onReset) onReset();
    };
    arrow->setTitle (filled (TRANS ("Reset %1"), label_text));
    addChildComponent (*arrow);
    addMouseListener (watch.get(), true);
}

void SetRow::childrenChanged()
{
    for (auto* child : getChildren())
        if (child != arrow.get() && child->getTitle().isEmpty()) child->setTitle (label_text);
}

SetRow::~SetRow() { removeMouseListener (watch.get()); }

void SetRow::setIsSet (bool now)
{
    is_set = now;
    hover();
    repaint();
}

void SetRow::setNote (const juce::String& n, juce::Colour colour)
{
    note = n;
    note_colour = colour;
    repaint();
}

void SetRow::hover()
{
    const bool was_shown = arrow->isVisible();
    arrow->setVisible (is_set && onReset != nullptr && isMouseOver (true));
    if (arrow->isVisible() != was_shown) repaint();   // the texts beside it have more or less space
}

void SetRow::openMenu()
{
    if (! onWantsMenu) return;
    juce::PopupMenu menu;
    onWantsMenu (menu);
    if (menu.getNumItems() > 0) menu.showMenuAsync (juce::PopupMenu::Options().withMousePosition());
}

void SetRow::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    auto area = getLocalBounds().removeFromTop (row_height).removeFromLeft (labelWidth()).withTrimmedRight (4);
    if (arrow->isVisible()) area.removeFromRight (20);
    if (note.isNotEmpty())
    {
        g.setFont (look.font (11.0f));
        g.setColour (note_colour);
        g.drawText (note, area.removeFromBottom (13), juce::Justification::centredLeft, true);
        area = area.withTrimmedTop (1);
    }
    g.setFont (look.font (12.0f, is_set));
    g.setColour (is_set ? look.theme().text : look.theme().dim);
    g.drawText (label_text, area, juce::Justification::centredLeft, true);
}

void SetRow::resized()
{
    auto area = getLocalBounds();
    const auto left = stacked ? area.removeFromTop (20) : area.removeFromLeft (labelWidth());
    arrow->setBounds (juce::Rectangle<int> (24, 24).withCentre ({ left.getRight() - 14, row_height / 2 }));
    place (area.withTrimmedTop (2).withTrimmedBottom (2));
}

}   // namespace tactus::host
