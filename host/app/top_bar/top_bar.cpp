// SPDX-License-Identifier: GPL-3.0-or-later
#include "top_bar.hpp"

#include <host/app/compose/variation.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host
{

namespace
{
juce::Path curvedArrow (bool to_the_right)
{
    juce::Path p;
    p.startNewSubPath (3.0f, 6.0f);
    p.lineTo (10.0f, 6.0f);
    p.quadraticTo (13.5f, 6.0f, 13.5f, 9.5f);
    p.quadraticTo (13.5f, 13.0f, 10.0f, 13.0f);
    p.lineTo (5.0f, 13.0f);
    p.startNewSubPath (6.0f, 2.5f);
    p.lineTo (2.5f, 6.0f);
    p.lineTo (6.0f, 9.5f);
    if (to_the_right) p.applyTransform (juce::AffineTransform (-1.0f, 0.0f, 16.0f, 0.0f, 1.0f, 0.0f));
    return p;
}

juce::Path questionMark()
{
    juce::Path p;
    p.startNewSubPath (5.0f, 5.0f);
    p.cubicTo (5.0f, 0.5f, 11.5f, 0.5f, 11.2f, 5.0f);
    p.cubicTo (11.0f, 7.5f, 8.0f, 7.5f, 8.0f, 10.5f);
    p.addEllipse (7.7f, 13.2f, 0.6f, 0.6f);
    return p;
}

juce::Path bars()
{
    juce::Path p;
    for (const float y : { 4.0f, 8.0f, 12.0f })
    {
        p.startNewSubPath (2.0f, y);
        p.lineTo (14.0f, y);
    }
    return p;
}

juce::String captionText() { return TRANS ("Snapshots"); }

/// True if a wire moves a parameter around its value.
bool isModulated (const graph::Graph& g)
{
    const auto has = [] (const graph::Patch& p) { return std::ranges::any_of (p.wires, &graph::Wire::add); };
    return has (g.root) || std::ranges::any_of (g.graphs, [&] (const auto& inner) { return has (inner.second); });
}
}   // namespace

/// A snapshot button, filled if the snapshot has been stored, and brightly if all values are those of the snapshot.
class TopBar::Slot final : public Button
{
public:
    explicit Slot (int n) : Button (filled (TRANS ("Snapshot %1"), n)), number (n) { setWantsKeyboardFocus (false); }

    void show (bool s, bool is_at)
    {
        is_stored = s;
        setToggleState (is_at, juce::dontSendNotification);
        const auto stored = is_at ? TRANS ("Snapshot %1: all values are those that it holds")
                                  : TRANS ("Snapshot %1: click or press %1 to recall it, Shift+click or press Ctrl+%1 to overwrite it");
        setTooltip (filled (s ? stored : TRANS ("Snapshot %1 is empty: click or press Ctrl+%1 to store all values in it"), number));
        repaint();
    }
    bool isStored() const noexcept { return is_stored; }

    void mouseDown (const juce::MouseEvent& e) override
    {
        Button::mouseDown (e);
        if (e.mods.isPopupMenu() && onMenu) onMenu();
    }

    std::function<void()> onMenu;

    void paintButton (juce::Graphics& g, bool over, bool down) override
    {
        const auto& look = lookOf (*this);
        const auto& theme = look.theme();
        const auto area = getLocalBounds().toFloat().reduced (1.5f);
        if (is_stored)
        {
            const float alpha = over ? 0.45f : 0.3f;
            g.setColour (getToggleState() ? theme.accent : theme.accent.withAlpha (down ? 0.6f : alpha));
            g.fillRoundedRectangle (area, 4.0f);
        }
        g.setColour (over ? theme.dim : theme.hairline);
        g.drawRoundedRectangle (area, 4.0f, 1.0f);
        const auto text = is_stored ? theme.text : theme.dim;
        g.setColour (getToggleState() ? theme.canvas : text);
        g.setFont (look.font (12.0f, is_stored));
        g.drawText (juce::String (number), getLocalBounds(), juce::Justification::centred, false);
    }

private:
    int number;
    bool is_stored = false;
};

TopBar::TopBar (Desk& d)
    : desk (d),
      undo (std::make_unique<IconButton> (TRANS ("Undo"), curvedArrow (false))),
      redo (std::make_unique<IconButton> (TRANS ("Redo"), curvedArrow (true))),
      help (std::make_unique<IconButton> (TRANS ("Help (F1)"), questionMark())),
      menu (std::make_unique<IconButton> (TRANS ("Menu"), bars()))
{
    for (int n = 1; n <= snapshot_count; ++n)
    {
        auto& slot = slots[static_cast<std::size_t> (n - 1)];
        slot = std::make_unique<Slot> (n);
        slot->onClick = [this, n, s = slot.get()] {
            const bool stores = ! s->isStored() || juce::ModifierKeys::currentModifiers.isShiftDown() || juce::ModifierKeys::currentModifiers.isCtrlDown();
            stores ? store (n) : recall (n);
        };
        slot->onMenu = [this, n, s = slot.get()] { openSnapshots (*s, n, n); };
        addAndMakeVisible (*slot);
    }
    instance.setTitle (TRANS ("Instance"));
    instance.onClick = [this] { openInstances(); };
    addChildComponent (instance);
    all_slots.onClick = [this] { openSnapshots (all_slots, 1, snapshot_count); };
    addChildComponent (all_slots);
    undo->onClick = [this] { document.undo(); };
    redo->onClick = [this] { document.redo(); };
    help->onClick = [this] {
        if (onHelp) onHelp();
    };
    menu->onClick = [this] {
        if (onMenu) onMenu (*menu);
    };
    for (auto* b : { undo.get(), redo.get(), help.get(), menu.get() })
        addAndMakeVisible (*b);
}

TopBar::~TopBar() = default;

juce::String TopBar::graphName() const
{
    const auto& name = document.graph().name;
    return name.empty() ? TRANS ("Untitled graph") : juce::String (printableName (name));
}

void TopBar::show()
{
    trail = { graphName() };
    for (const auto& [node, subgraph] : desk.canvas.breadcrumbs())
        trail.emplace_back (printableName (node));
    showSaved();
    shown = desk.canvas.instance();
    instance.setVisible (shown.has_value());
    if (shown) instance.setButtonText (filled (TRANS ("Instance [%1] of %2"), shown->number, shown->count));
    resized();
    for (int n = 1; n <= snapshot_count; ++n)
        slots[static_cast<std::size_t> (n - 1)]->show (hasSnapshot (document.graph(), n), isAtSnapshot (document.graph(), n));
    const auto done = document.history().position(), steps = document.history().size();
    undo->setEnabled (done > 0);
    undo->setTooltip (done == 0 ? TRANS ("Nothing to undo") : filled (TRANS ("Undo: %1 (Ctrl+Z)"), document.stepName (done - 1)));
    redo->setEnabled (done < steps);
    redo->setTooltip (done == steps ? TRANS ("Nothing to redo") : filled (TRANS ("Redo: %1 (Ctrl+Y)"), document.stepName (done)));
    repaint();
}

void TopBar::resized()
{
    auto area = getLocalBounds().withTrimmedRight (8);
    const auto put = [&area] (juce::Component& c, int width, int gap) {
        c.setBounds (area.removeFromRight (width).withSizeKeepingCentre (width, width));
        area.removeFromRight (gap);
    };
    put (*menu, 28, 0);
    put (*help, 28, 12);
    put (*redo, 28, 0);
    put (*undo, 28, 12);
    constexpr int slot_width = 26, least_trail = 160;
    const bool has_room = area.getWidth() - slot_width * snapshot_count >= least_trail;
    for (auto s = slots.rbegin(); s != slots.rend(); ++s)
    {
        (*s)->setVisible (has_room);
        if (has_room) put (**s, slot_width, 0);
    }
    all_slots.setVisible (! has_room);
    if (! has_room) all_slots.setBounds (area.removeFromRight (all_slots.bestWidth()).withSizeKeepingCentre (all_slots.bestWidth(), 24));
    if (instance.isVisible()) instance.setBounds (area.removeFromRight (instance.bestWidth()).withSizeKeepingCentre (instance.bestWidth(), 24));
    placeCaption (has_room ? area : area.withWidth (0));
    room = (caption.isEmpty() ? area.getRight() : caption.getX()) - 8;
}

void TopBar::placeCaption (juce::Rectangle<int> area)
{
    constexpr int for_trail = 300;   // the trail comes first
    const int width = juce::roundToInt (std::ceil (lookOf (*this).font (12.0f).getStringWidthFloat (captionText()))) + 2;
    caption = area.getWidth() - width - 8 < for_trail ? juce::Rectangle<int>() : area.removeFromRight (width + 8).withTrimmedRight (8);
}

void TopBar::fillSnapshotMenu (juce::PopupMenu& list, int first, int last)
{
    const auto add = [&] (const char* stored, const char* empty, const std::function<void (int)>& act) {
        for (int n = first; n <= last; ++n)
            if (const auto* text = hasSnapshot (document.graph(), n) ? stored : empty; text != nullptr)
                list.addItem (filled (juce::translate (text), n), [act, n] { act (n); });
        list.addSeparator();
    };
    add (NEEDS_TRANS ("Recall snapshot %1"), nullptr, [this] (int n) { recall (n); });
    add (NEEDS_TRANS ("Overwrite snapshot %1"), NEEDS_TRANS ("Store in snapshot %1"), [this] (int n) { store (n); });
    add (NEEDS_TRANS ("Clear snapshot %1"), nullptr, [this] (int n) { document.perform (clearSnapshot (document.graph(), n)); });
    for (int n = first; n <= last; ++n)
        for (int to = 1; to <= snapshot_count && first == last && hasSnapshot (document.graph(), n); ++to)
            if (to != n && hasSnapshot (document.graph(), to))
                list.addItem (filled (TRANS ("Morph from snapshot %1 to %2"), n, to), [this, n, to] { morph (n, to); });
}

void TopBar::openSnapshots (juce::Component& at, int first, int last)
{
    juce::PopupMenu list;
    fillSnapshotMenu (list, first, last);
    list.showMenuAsync (juce::PopupMenu::Options().withTargetComponent (at));
}

void TopBar::openInstances()
{
    constexpr int most_items = 64;
    juce::PopupMenu list;
    for (int i = 0; shown && i < std::min (shown->count, most_items); ++i)
        list.addItem (i + 1, filled (TRANS ("Instance [%1]"), i), true, i == shown->number);
    list.showMenuAsync (juce::PopupMenu::Options().withTargetComponent (instance), [safe = juce::Component::SafePointer (this)] (int item) {
        if (safe != nullptr && item > 0) safe->desk.canvas.chooseInstance (item - 1);
    });
}

std::vector<juce::Rectangle<float>> TopBar::places() const
{
    std::vector<juce::Rectangle<float>> all;
    const auto font = lookOf (*this).font (14.0f, true);
    float x = 16.0f;
    const float for_saved = std::min (200.0f, lookOf (*this).font (12.0f).getStringWidthFloat (savedText())) + 14.0f;
    for (const auto& name : trail)
    {
        const float width = std::min (font.getStringWidthFloat (name), std::max (0.0f, static_cast<float> (room) - x - for_saved));
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
        g.drawText (trail[i], all[i].expanded (4.0f, 0.0f), juce::Justification::centred, true);
        if (i + 1 == all.size()) continue;
        juce::Path arrow;
        const auto at = juce::Point<float> (all[i].getRight() + 12.0f, all[i].getCentreY());
        arrow.startNewSubPath (at.translated (0.0f, -4.0f));
        arrow.lineTo (at.translated (4.0f, 0.0f));
        arrow.lineTo (at.translated (0.0f, 4.0f));
        g.strokePath (arrow, juce::PathStrokeType (1.3f));
    }
    g.setFont (look.font (12.0f));
    g.setColour (theme.dim);
    g.drawText (captionText(), caption, juce::Justification::centredRight, false);
    if (all.empty()) return;
    const float x = all.back().getRight() + 14.0f;
    g.drawText (savedText(), all.back().withX (x).withRight (static_cast<float> (room)), juce::Justification::centredLeft, true);
}

void TopBar::showSaved()
{
    const auto file = fromUtf8 (printableName (document.file().filename().string()));
    const auto is_edited = document.isChanged() ? TRANS ("edited") : juce::String();
    const auto now = file + (file.isEmpty() || is_edited.isEmpty() ? "" : ", ") + is_edited;
    if (now == saved) return;
    saved = now;
    repaint();
}

void TopBar::mouseMove (const juce::MouseEvent& e)
{
    const auto all = places();
    const bool over = std::any_of (all.begin(), all.empty() ? all.end() : std::prev (all.end()), [&] (const auto& r) { return r.contains (e.position); });
    setMouseCursor (over ? juce::MouseCursor::PointingHandCursor : juce::MouseCursor::NormalCursor);
}

void TopBar::mouseUp (const juce::MouseEvent& e)
{
    const auto all = places();
    for (std::size_t i = 0; i + 1 < all.size(); ++i)
        if (all[i].contains (e.position) && e.mods.isLeftButtonDown()) desk.canvas.leaveTo (i);
}

//==============================================================================
bool TopBar::snapshotKey (const juce::KeyPress& key)
{
    const int digit = key.getKeyCode() - '0';
    const bool is_digit = digit >= 1 && digit <= snapshot_count && ! key.getModifiers().isAltDown();
    if (is_digit)
        key.getModifiers().isAnyModifierKeyDown() ? store (digit) : recall (digit);
    else if (key == juce::KeyPress::createFromDescription ("v"))
        compare();
    else
        return false;
    return true;
}

/// Remembers which snapshot was recalled or stored last, and which one before it.
void TopBar::note (int number)
{
    if (std::exchange (compared_in, document.identity()) != document.identity()) compared = {};
    if (compared[1] != number) compared = { compared[1], number };
}

void TopBar::recall (int number)
{
    const juce::String n (number);
    if (! hasSnapshot (document.graph(), number)) return desk.notify (filled (TRANS ("Snapshot %1 is empty. Ctrl+%1 stores all values in it."), n));
    if (auto command = recallSnapshot (document.graph(), number)) document.perform (std::move (*command));
    note (number);
    const auto missing = missingNodes (document.graph(), number), later = laterControls (document.graph(), number);
    if (missing.empty() && later.empty()) return desk.notify (filled (TRANS ("Recalled snapshot %1."), n));
    if (missing.empty()) return desk.notify (filled (TRANS ("Recalled snapshot %1. What later knobs set stays: %2."), n, listText (later)));
    juce::StringArray names;
    for (std::size_t i = 0; i < std::min<std::size_t> (3, missing.size()); ++i)
        names.add (valueText (missing[i]));
    const juce::String more = missing.size() > 3 ? fromUtf8 (", …") : juce::String();
    desk.notify (filled (TRANS ("Recalled snapshot %1, except for nodes that the graph no longer has: %2."), n, names.joinIntoString (", ") + more));
}

void TopBar::store (int number)
{
    const juce::String n (number);
    if (! document.perform (storeSnapshot (document.graph(), number))) return;
    auto said = filled (TRANS ("Stored snapshot %1. Press %1 to recall it."), n);
    if (isModulated (document.graph())) said << ' ' << TRANS ("It does not hold the depths of modulation.");
    desk.notify (said);
    note (number);
}

/// The snapshot before the last one, or else one of the first two that are stored. 0 if there are no two.
int TopBar::otherSnapshot() const
{
    const auto& g = document.graph();
    const auto [before, last] = compared_in == document.identity() ? compared : std::array<int, 2> {};
    if (before != 0 && hasSnapshot (g, before)) return before;
    std::vector<int> stored;
    for (int n = 1; n <= snapshot_count; ++n)
        if (hasSnapshot (g, n)) stored.push_back (n);
    if (stored.size() < 2) return 0;
    const bool is_at_first = last == 0 ? isAtSnapshot (g, stored[0]) : last == stored[0];
    return stored[is_at_first ? 1 : 0];
}

void TopBar::compare()
{
    const int other = otherSnapshot();
    if (other == 0) return desk.notify (TRANS ("V switches between the last two snapshots: store one with Ctrl+1 and another with Ctrl+2 first."));
    recall (other);
}

void TopBar::morph (int from, int to)
{
    auto made = morphBetween (document.graph(), from, to, desk.types);
    if (! made) return desk.notify (fromUtf8 (messageText (made.error())));
    auto text = filled (TRANS ("Numbers that the new control moves from snapshot %2 to snapshot %3: %1. It begins with the graph as in snapshot %2."),
                        made->params, from, to);
    if (! made->replaced.empty())
        text << " "
             << filled (TRANS ("It takes the place of the knobs %1: until it is removed, other snapshots do not move what they set. Undo brings them back."),
                        listText (made->replaced));
    const auto make = [this, command = std::move (made->command), text] {
        if (document.perform (command)) desk.notify (text);
    };
    if (made->left_out == 0 && made->replaced.empty()) return make();
    const auto left = made->left_out == 0 ? juce::String()
                                          : " "
                                                + filled (TRANS ("Differences that stay as in snapshot %2: %1 (choices, switches, vectors, values in "
                                                                 "subgraphs, and what a wire sets). To change these as well, recall snapshot %3."),
                                                          made->left_out, from, to);
    desk.question.ask (filled (TRANS ("Morph from snapshot %1 to %2?"), from, to), text + left,
                       { { TRANS ("Make the control"), make }, { TRANS ("Cancel"), {} } });
}

}   // namespace tactus::host
