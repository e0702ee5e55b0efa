// SPDX-License-Identifier: GPL-3.0-or-later
#include "top_bar.hpp"

namespace tactus::host
{

namespace
{
juce::Path turnBack (bool forth)
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
    if (forth) p.applyTransform (juce::AffineTransform (-1.0f, 0.0f, 16.0f, 0.0f, 1.0f, 0.0f));
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
}   // namespace

/// One snapshot: filled if there is something in it.
class TopBar::Slot final : public juce::Button
{
public:
    explicit Slot (int n) : Button ("Snapshot " + juce::String (n)), number (n) { setWantsKeyboardFocus (false); }

    void setStored (bool s)
    {
        is_stored = s;
        setTooltip (s ? "Snapshot " + juce::String (number) + ": click or press " + juce::String (number) + " to bring its values back, Shift-click or Ctrl+" + juce::String (number) + " to store over it"
                      : "Snapshot " + juce::String (number) + " is empty: click or press Ctrl+" + juce::String (number) + " to store all values in it");
        repaint();
    }
    bool isStored() const noexcept { return is_stored; }

    void paintButton (juce::Graphics& g, bool over, bool down) override
    {
        const auto& look = lookOf (*this);
        const auto& theme = look.theme();
        const auto area = getLocalBounds().toFloat().reduced (1.5f);
        if (is_stored)
        {
            g.setColour (theme.accent.withAlpha (down ? 0.6f : over ? 0.45f
                                                                    : 0.3f));
            g.fillRoundedRectangle (area, 4.0f);
        }
        g.setColour (over ? theme.dim : theme.hairline);
        g.drawRoundedRectangle (area, 4.0f, 1.0f);
        g.setColour (is_stored ? theme.text : theme.dim);
        g.setFont (look.font (12.0f, is_stored));
        g.drawText (juce::String (number), getLocalBounds(), juce::Justification::centred, false);
    }

private:
    int number;
    bool is_stored = false;
};

TopBar::TopBar()
    : undo (std::make_unique<IconButton> ("Undo", turnBack (false))), redo (std::make_unique<IconButton> ("Redo", turnBack (true))), help (std::make_unique<IconButton> ("Help (F1)", questionMark())), menu (std::make_unique<IconButton> ("Menu", bars()))
{
    for (int n = 1; n <= snapshot_count; ++n)
    {
        auto& slot = slots[static_cast<std::size_t> (n - 1)];
        slot = std::make_unique<Slot> (n);
        slot->onClick = [this, n, s = slot.get()]
        {
            const bool stores = ! s->isStored() || juce::ModifierKeys::currentModifiers.isShiftDown() || juce::ModifierKeys::currentModifiers.isCtrlDown();
            if (const auto& act = stores ? onStore : onRecall) act (n);
        };
        addAndMakeVisible (*slot);
    }
    const auto calls = [] (const std::function<void()>& f)
    {
        return [&f]
        {
            if (f) f();
        };
    };
    undo->onClick = calls (onUndo);
    redo->onClick = calls (onRedo);
    help->onClick = calls (onHelp);
    menu->onClick = [this]
    {
        if (onMenu) onMenu (*menu);
    };
    for (auto* b : { undo.get(), redo.get(), help.get(), menu.get() })
        addAndMakeVisible (*b);
    show ({});
}

TopBar::~TopBar() = default;

void TopBar::show (State s)
{
    state = std::move (s);
    for (std::size_t i = 0; i < slots.size(); ++i)
        slots[i]->setStored (state.snapshots[i]);
    undo->setEnabled (state.undo.isNotEmpty());
    undo->setTooltip (state.undo.isEmpty() ? juce::String ("Nothing to undo") : "Undo: " + state.undo + " (Ctrl+Z)");
    redo->setEnabled (state.redo.isNotEmpty());
    redo->setTooltip (state.redo.isEmpty() ? juce::String ("Nothing to redo") : "Redo: " + state.redo + " (Ctrl+Y)");
    repaint();
}

void TopBar::resized()
{
    auto area = getLocalBounds().withTrimmedRight (8);
    const auto put = [&area] (juce::Component& c, int width, int gap)
    {
        c.setBounds (area.removeFromRight (width).withSizeKeepingCentre (width, width));
        area.removeFromRight (gap);
    };
    put (*menu, 28, 0);
    put (*help, 28, 12);
    put (*redo, 28, 0);
    put (*undo, 28, 12);
    for (auto s = slots.rbegin(); s != slots.rend(); ++s)
        put (**s, 26, 0);
    room = area.getWidth() - 8;
}

std::vector<juce::Rectangle<float>> TopBar::places() const
{
    std::vector<juce::Rectangle<float>> all;
    const auto font = lookOf (*this).font (14.0f, true);
    float x = 16.0f;
    for (const auto& name : state.way)
    {
        const float width = std::min (font.getStringWidthFloat (name), std::max (0.0f, static_cast<float> (room) - x - 60.0f));
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
        g.drawText (state.way[i], all[i].expanded (4.0f, 0.0f), juce::Justification::centred, true);
        if (i + 1 == all.size()) continue;
        juce::Path arrow;
        const auto at = juce::Point<float> (all[i].getRight() + 12.0f, all[i].getCentreY());
        arrow.startNewSubPath (at.translated (0.0f, -4.0f));
        arrow.lineTo (at.translated (4.0f, 0.0f));
        arrow.lineTo (at.translated (0.0f, 4.0f));
        g.strokePath (arrow, juce::PathStrokeType (1.3f));
    }
    if (! state.changed || all.empty()) return;
    g.setFont (look.font (12.0f));
    g.setColour (theme.dim);
    g.drawText ("edited", all.back().withX (all.back().getRight() + 14.0f).withWidth (60.0f), juce::Justification::centredLeft, false);
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
