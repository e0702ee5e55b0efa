// SPDX-License-Identifier: GPL-3.0-or-later
#include "panel_layout.hpp"

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

PanelLayout::PanelLayout (juce::Component& w, const Desk& d, HandPanel& h, juce::Component& i) : window (w), desk (d), hand (h), inspector (i)
{
    pages.setTitle (TRANS ("Pages"));
    for (const auto& [name, part] : pageParts())
        pages.add (juce::translate (name), std::make_unique<juce::Component>());
    pages.onShow = [this] {
        if (! isSmall()) return;
        window.resized();
        if (desk.canvas.isShowing()) takeFocus (desk.canvas);
    };
    for (const auto& [name, edge] : edges())
    {
        edge->onMove = [this] { edgeMoved(); };
        edge->onMoved = [this] { noteMoves(); };
    }
}

PanelLayout::Edges PanelLayout::edges()
{
    return { { { "left", &left_edge }, { "right", &right_edge }, { "bottom", &bottom_edge }, { "hand", &hand_edge }, { "page", &page_edge } } };
}

PanelLayout::Parts PanelLayout::pageParts()
{
    return { { { NEEDS_TRANS ("Canvas"), &desk.canvas },
               { NEEDS_TRANS ("Hand"), &hand },
               { NEEDS_TRANS ("Inspector"), &inspector },
               { NEEDS_TRANS ("Presets"), &left } } };
}

PanelLayout::Shares PanelLayout::shares()
{
    Shares all;
    std::ranges::transform (edges(), all.begin(), [] (const auto& e) { return e.second->share(); });
    return all;
}

void PanelLayout::readSettings()
{
    for (const auto& [name, edge] : edges())
        if (const auto share = desk.settings.panels.find (name); share != desk.settings.panels.end()) edge->setShare (share->second);
    shares_before = shares();
}

void PanelLayout::edgeMoved()
{
    if (! is_canvas_alone)   // the next start shows the panels
    {
        desk.settings.panels.clear();
        for (const auto& [name, edge] : edges())
            if (const auto share = edge->share()) desk.settings.panels[name] = *share;
        desk.settingsChanged();
    }
    window.resized();
}

void PanelLayout::restore (const Shares& to)
{
    shares_before = to;
    for (std::size_t i = 0; const auto& [name, edge] : edges())
        edge->restore (to[i++]);
    is_canvas_alone = is_canvas_alone && left_edge.isFolded() && right_edge.isFolded() && bottom_edge.isFolded();
    edgeMoved();
}

void PanelLayout::noteMoves()
{
    const auto before = std::exchange (shares_before, shares()), now = shares_before;
    if (before == now) return;
    const auto restored = [this, open = juce::Component::SafePointer (&window)] (const Shares& to) {
        return [this, open, to] {
            if (open != nullptr) restore (to);
        };
    };
    desk.document.addWindowStep (NEEDS_TRANS ("move panels"), restored (before), restored (now));
}

void PanelLayout::foldPanels()
{
    const std::array folding { &left_edge, &right_edge, &bottom_edge };
    if (is_canvas_alone || std::ranges::all_of (folding, &Splitter::isFolded))
    {
        // A panel that was opened meanwhile stays open.
        for (std::size_t i = 0; i < folding.size(); ++i)
            folding[i]->fold (folding[i]->isFolded() && folded_before[i]);
        folded_before = {};
        is_canvas_alone = false;
    }
    else
    {
        std::ranges::transform (folding, folded_before.begin(), &Splitter::isFolded);
        for (auto* edge : folding)
            edge->fold (true);
        is_canvas_alone = true;
    }
    edgeMoved();
    noteMoves();
    if (is_canvas_alone) desk.notify (TRANS ("The panels are hidden. Z shows them again."));
}

bool PanelLayout::isSmall() const { return window.getWidth() < least_width || window.getHeight() < least_height; }

void PanelLayout::turnTo (const juce::Component& part)
{
    if (! isSmall()) return;
    for (int i = 0; const auto& [name, shown] : pageParts())
    {
        if (shown == &part && pages.shown() != i) pages.show (i);
        ++i;
    }
}

void PanelLayout::toFront (const juce::Component& panel)
{
    for (auto* tabs : { &left, &bottom })
        if (tabs->isParentOf (&panel)) tabs->show (panel);
}

void PanelLayout::rename (const juce::Component& panel, const Panel::Title& title)
{
    for (auto* tabs : { &left, &bottom })
        if (tabs->isParentOf (&panel)) tabs->rename (panel, title.text, title.alarms);
}

void PanelLayout::reveal (const juce::Component& panel)
{
    const bool is_left = left.isParentOf (&panel);
    if (auto& edge = is_left ? left_edge : bottom_edge; edge.isFolded())
    {
        edge.fold (false);
        edgeMoved();
        noteMoves();
    }
    if (is_left) turnTo (left);
    toFront (panel);
}

void PanelLayout::nextPart (int step)
{
    const std::initializer_list<juce::Component*> parts { &desk.canvas, &inspector, &bottom, &hand, &left };
    std::vector<juce::Component*> open;
    for (auto* p : parts)
        if ((isSmall() && p != &bottom) || (p->isShowing() && ! p->getBounds().isEmpty())) open.push_back (p);
    const auto now = std::ranges::find_if (open, [] (const juce::Component* p) { return p->hasKeyboardFocus (true); });
    const auto count = static_cast<int> (open.size()), at = now == open.end() ? (step > 0 ? -1 : 0) : static_cast<int> (now - open.begin());
    for (int i = 1; i <= count; ++i)
    {
        auto& next = *open[static_cast<std::size_t> (((at + i * step) % count + count) % count)];
        turnTo (next);
        takeFocus (next);   // or the first part of it that takes keys
        if (next.hasKeyboardFocus (true)) return;
    }
}

juce::Rectangle<int> PanelLayout::layOut (juce::Rectangle<int> area)
{
    if (! isSmall()) return layOutPanels (area).withRight (window.getWidth());
    layOutPages (area);
    return area;
}

/// The page at the left, and the lower panels at the right of it.
void PanelLayout::layOutPages (juce::Rectangle<int> area)
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

juce::Rectangle<int> PanelLayout::layOutPanels (juce::Rectangle<int> area)
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
    desk.canvas.setBounds (area);
    desk.canvas.setVisible (! hand.isEnlarged());
    if (hand.isEnlarged()) hand.setBounds (area);
    return area;
}

}   // namespace tactus::host
