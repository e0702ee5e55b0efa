// SPDX-License-Identifier: GPL-3.0-or-later
// Where the panels are. A small window has no room for all of them side by side: there, a row of pages chooses what is at the left.
#include "main_view.hpp"

#include <host/app/look/focus.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
constexpr int hand_width = 420;
constexpr int least_column = 216, least_scopes_width = 320;
constexpr int least_canvas_width = 240, least_canvas_height = 200;    // in units of the window
constexpr int lowest_canvas_height = 80, least_bottom_height = 160;   // in a low window, the canvas gives way to the panels below it
constexpr int least_width = 680, least_height = 420;                  // of a window whose panels are side by side
}   // namespace

void MainView::addPages()
{
    pages.setTitle (TRANS ("Pages"));
    palette.getProperties().set ("space above", SafetyStrip::height);   // STOP stays within reach
    menus.setComponentID (Look::menu_area);
    menus.setInterceptsMouseClicks (false, true);
    menus.setAlwaysOnTop (true);
    for (const auto& [name, part] : pageParts())
        pages.add (juce::translate (name), std::make_unique<juce::Component>());
    pages.onShow = [this] {
        if (! isSmall()) return;
        resized();
        if (patching.isShowing()) takeFocus (patching);
    };
    addChildComponent (pages);
}

std::array<std::pair<const char*, juce::Component*>, 4> MainView::pageParts()
{
    return { { { NEEDS_TRANS ("Canvas"), &patching },
               { NEEDS_TRANS ("Hand"), &hand },
               { NEEDS_TRANS ("Inspector"), &inspector },
               { NEEDS_TRANS ("Presets"), &left } } };
}

bool MainView::isSmall() const { return getWidth() < least_width || getHeight() < least_height; }

/// In a small window, shows the page of this part.
void MainView::turnTo (const juce::Component& part)
{
    if (! isSmall()) return;
    for (int i = 0; const auto& [name, shown] : pageParts())
    {
        if (shown == &part && pages.shown() != i) pages.show (i);
        ++i;
    }
}

/// The page at the left, and the lower panels at the right of it.
void MainView::layOutPages (juce::Rectangle<int> area)
{
    for (auto* edge : { &left_edge, &right_edge, &bottom_edge, &hand_edge })
        edge->setVisible (false);
    if (hand.isEnlarged()) turnTo (hand);
    const bool is_alone = bottom_edge.isFolded() || hand.isEnlarged();
    page_edge.setVisible (! is_alone);
    page_edge.beginAt (area.getWidth() / 2);
    auto column = is_alone ? area : page_edge.take (area, least_column);
    bottom.setBounds (area);
    bottom.setVisible (! is_alone);
    pages.setBounds (column);
    pages.setVisible (true);
    column.removeFromTop (Tabs::row_height);
    for (int i = 0; const auto& [name, part] : pageParts())
    {
        part->setBounds (column);
        part->setVisible (i++ == pages.shown());
    }
}

void MainView::layOutPanels (juce::Rectangle<int>& area)
{
    pages.setVisible (false);
    page_edge.setVisible (false);
    for (auto* c : std::initializer_list<juce::Component*> { &left_edge, &right_edge, &bottom_edge, &left, &inspector, &hand, &bottom })
        c->setVisible (true);
    auto low = bottom_edge.take (area, std::clamp (area.getHeight() - least_bottom_height, lowest_canvas_height, least_canvas_height));
    left.setBounds (left_edge.take (area, least_canvas_width));
    inspector.setBounds (right_edge.take (area, least_canvas_width));
    hand_edge.setVisible (! hand.isEnlarged());
    hand_edge.beginAt (std::min (hand_width, low.getWidth() / 2));
    if (! hand.isEnlarged()) hand.setBounds (hand_edge.take (low, least_scopes_width));
    bottom.setBounds (low);
    patching.setBounds (area);
    patching.setVisible (! hand.isEnlarged());
    if (hand.isEnlarged()) hand.setBounds (area);
}

void MainView::resized()
{
    auto area = getLocalBounds();
    strip.setBounds (area.removeFromTop (SafetyStrip::height));
    top.setBounds (area.removeFromTop (TopBar::height));
    status.setBounds (area.removeFromBottom (StatusLine::height));
    isSmall() ? layOutPages (area) : layOutPanels (area);
    showBeginnings();
    welcome.setBounds (area.withRight (getWidth()));
    help.setArea (area.withRight (getWidth()).withBottom (isSmall() ? area.getBottom() : hand.getBottom()).reduced (isSmall() ? 4 : 16));
    for (const auto& p : panels)
        if (p.tabs == nullptr) p.component.setBounds (getLocalBounds().withTrimmedTop (SafetyStrip::height));
    tour.setBounds (getLocalBounds());
    tour.resized();   // what it frames may have moved
    for (auto* over : std::initializer_list<juce::Component*> { &question, &menus })
        over->setBounds (getLocalBounds().withTrimmedTop (SafetyStrip::height));   // STOP stays within reach
    shade.setBounds (question.getBounds());
}

}   // namespace tactus::host
