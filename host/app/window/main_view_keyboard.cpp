// SPDX-License-Identifier: GPL-3.0-or-later
// Which part of the window has the keyboard.
#include "main_view.hpp"

#include <host/app/look/focus.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host
{

/// The component that has the keyboard unless the user has given it to another one.
juce::Component& MainView::keyboardHome()
{
    if (question.isOpen()) return question;
    if (const auto* cover = openCover()) return cover->component;
    if (welcome.isVisible()) return welcome;
    return patching.isShowing() ? static_cast<juce::Component&> (patching) : *this;
}

/// The keyboard is never lost: after a menu, a dialog, a field or a start, JUCE leaves it with nothing, or with a part of the window that has no keys.
void MainView::keepKeyboard()
{
    dialogs.attendNewFolder();
    const auto* peer = getPeer();
    if (peer == nullptr || ! peer->isFocused()) return;
    if (auto* modal = juce::Component::getCurrentlyModalComponent()) return dialogs.keepKeyboard (*modal);
    auto& home = keyboardHome();
    const bool is_over = question.isOpen() || openCover() != nullptr;   // nothing else may have the keyboard
    const auto* now = juce::Component::getCurrentlyFocusedComponent();
    const bool is_kept = is_over ? home.hasKeyboardFocus (true) : now != nullptr && isParentOf (now) && now->isShowing();
    if (! is_kept && now != &home) takeFocus (home);
}

void MainView::nextPanel (int step)
{
    const std::initializer_list<juce::Component*> panels { &patching, &inspector, &bottom, &hand, &left };
    std::vector<juce::Component*> open;
    for (auto* p : panels)
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

/// True while the canvas or the scene has the keyboard focus, in a window that has it, too. Elsewhere, the window does not learn when the key comes up.
bool MainView::hasClutchFocus()
{
    const auto* peer = getPeer();
    return peer != nullptr && peer->isFocused() && (patching.hasKeyboardFocus (true) || hand.scene().hasKeyboardFocus (true) || hasKeyboardFocus (false));
}

/// While S is down, the workspace of the hand's device moves with the hand. A key that is held comes again and again.
bool MainView::clutchKey (const juce::KeyPress& key)
{
    if (key != juce::KeyPress::createFromDescription ("s") || ! hasClutchFocus()) return false;
    clutch_ends = false;
    if (! playback.current().holdWorkspace (true))
        status.hint (TRANS ("S moves the workspace of a device that runs. The tool has none: bind one in the Devices panel, and press START."));
    else if (! std::exchange (holds_clutch, true))
        status.hint (TRANS ("The workspace moves with the hand until you release S. There is no force."));
    return true;
}

/// Ends the clutch when a key comes up. It is not known which key that is, so any key ends it, unless S comes again at once: between two repetitions
/// of a held key, the system may report that it is up.
bool MainView::keyStateChanged (bool is_down)
{
    clutch_ends = clutch_ends || ! is_down;
    return false;
}

void MainView::attendClutch()
{
    if (! holds_clutch || (! clutch_ends && hasClutchFocus())) return;
    holds_clutch = false;
    for (auto* each : { &playback.run(), &playback.current() })   // the second is that of a preview, if there is one
        static_cast<void> (each->holdWorkspace (false));
    status.hint ({});
}

/// F6 goes from panel to panel, Ctrl+K finds everything, and F5 starts. The other keys are those of the panels.
bool MainView::panelKey (const juce::KeyPress& key)
{
    for (const auto& p : panels)
        for (const auto& k : p.panel.keys)
            if (k.act && key == juce::KeyPress::createFromDescription (k.key))
            {
                k.act();
                return true;
            }
    if (key.isKeyCode (juce::KeyPress::F6Key))
        nextPanel (key.getModifiers().isShiftDown() ? -1 : 1);
    else if (key == juce::KeyPress::createFromDescription ("ctrl + k") || key == juce::KeyPress::createFromDescription ("F3"))
        findAction();
    else if (key.isKeyCode (juce::KeyPress::F5Key))
    {
        endTyping();
        if (! playback.current().isRunning()) playback.restart();   // as START does
    }
    else
        return false;
    return true;
}

}   // namespace tactus::host
