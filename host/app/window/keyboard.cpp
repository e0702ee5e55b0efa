// SPDX-License-Identifier: GPL-3.0-or-later
#include "keyboard.hpp"

#include <host/app/look/focus.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>
#include <string_view>
#include <utility>

namespace tactus::host
{

namespace
{
/// A sign is a key by its text: which keys make it depends on the layout.
bool isKey (const juce::KeyPress& key, std::string_view description)
{
    if (description == "?") return key.getTextCharacter() == '?';
    return key == juce::KeyPress::createFromDescription (std::string (description));
}

bool isEsc (const juce::KeyPress& key) { return key.getKeyCode() == juce::KeyPress::escapeKey; }
bool isDialogOpen() { return juce::Component::getNumCurrentlyModalComponents() > 0; }
}   // namespace

Keyboard::Keyboard (WindowParts& p) : parts (p)
{
    juce::Desktop::getInstance().addFocusChangeListener (this);
    parts.menus.onKey = [this] (const juce::KeyPress& key) { return keyPressed (key, nullptr); };
}

Keyboard::~Keyboard()
{
    juce::Desktop::getInstance().removeFocusChangeListener (this);
    if (focused != nullptr) focused->removeKeyListener (this);
}

bool Keyboard::press (const juce::KeyPress& key)
{
    // A dialog for files or a menu, which is inside this window, has had the key. Its buttons may still want it.
    if (isDialogOpen()) return isEsc (key) && stopsBy (key);
    if (isEsc (key))
    {
        escape (key);
        return true;
    }
    if (parts.question.isOpen())
    {
        parts.question.keyPressed (key);   // even if the question does not have the focus
        return true;
    }
    if (parts.openCover() != nullptr) return true;                                            // it has had the key
    if (parts.help.isOpen() && ! isArrow (key) && parts.help.keyPressed (key)) return true;   // arrows are for the canvas below
    if (act (key) || pressClutch (key) || parts.top.snapshotKey (key)) return true;
    auto& canvas = parts.patching;
    // Elsewhere, Tab goes to the next field.
    if (key.isKeyCode (juce::KeyPress::tabKey) && ! parts.window.hasKeyboardFocus (false) && ! canvas.hasKeyboardFocus (true)) return false;
    // Keys that move or delete the selected nodes are for the canvas alone. In a panel, such a key is meant for a value.
    const bool is_in_panel = parts.inspector.hasKeyboardFocus (true) || parts.layout.bottom.hasKeyboardFocus (true);
    if (is_in_panel && (isErasing (key) || isArrow (key))) return false;
    const bool is_hidden = ! canvas.isVisible();   // you would not see what you edit
    return ! is_hidden && canvas.keyPressed (key);
}

bool Keyboard::act (const juce::KeyPress& key)
{
    const auto isDoneBy = [&key] (const auto& by) {
        const auto taker = std::ranges::find_if (by, [&key] (const auto& k) { return k.act && isKey (key, k.key); });
        const bool found = taker != by.end();
        if (found) taker->act();
        return found;
    };
    return std::ranges::any_of (parts.panels, [&] (const AttachedPanel& p) { return isDoneBy (p.panel.keys); }) || isDoneBy (keys);
}

/// True if Esc would close something: a question, the help, the palette, a menu, a dialog, or a field in which text is typed; or if it would
/// bring the keyboard from the inspector back to the canvas.
bool Keyboard::isAnythingOpen() const
{
    return parts.inspector.hasKeyboardFocus (true) || parts.question.isOpen() || parts.openCover() != nullptr || parts.help.isOpen() || parts.tour.isOpen()
           || parts.palette.isVisible() || isDialogOpen()
           || dynamic_cast<juce::TextEditor*> (juce::Component::getCurrentlyFocusedComponent()) != nullptr;
}

/// Esc closes a page, a dialog or a field before it stops, unless there are motors: then the user should not have to look first. While a graph runs, it
/// stops also if the palette or a menu is open.
bool Keyboard::escStops() const
{
    const auto* modal = juce::Component::getCurrentlyModalComponent();
    const bool is_menu_open = modal != nullptr && parts.menus.isParentOf (modal);
    return parts.playback.current().drivesDevice() || is_menu_open || parts.palette.isVisible() || ! isAnythingOpen();
}

/// Stops if Esc, with or without Shift, means that now. The palette and a menu, which are open only for a moment, close with it.
bool Keyboard::stopsBy (const juce::KeyPress& esc)
{
    const bool is_at_once = esc.getModifiers().isShiftDown();
    if (! parts.playback.current().isWanted() || ! (is_at_once || escStops())) return false;
    is_at_once ? parts.playback.emergencyStop() : parts.playback.stop();
    parts.palette.close();
    juce::PopupMenu::dismissAllActiveMenus();
    return true;
}

void Keyboard::escape (const juce::KeyPress& key)
{
    parts.status.clearNotice();
    if (stopsBy (key)) return;
    if (parts.question.isOpen()) return parts.question.cancel();
    if (const auto* cover = parts.openCover()) return cover->panel.escape();
    if (parts.help.isOpen()) return parts.help.close();
    if (parts.tour.isOpen() && ! parts.palette.isVisible()) return parts.tour.close();
    if (parts.hand.isEnlarged() && ! parts.palette.isVisible()) return parts.hand.enlarge (false);
    parts.palette.close();
    if (parts.inspector.hasKeyboardFocus (true)) parts.turnTo (parts.patching);
    takeFocus (home());
}

/// A stop must work whichever component has the focus: a text field or a menu would swallow the key.
void Keyboard::globalFocusChanged (juce::Component* now)
{
    if (focused != nullptr) focused->removeKeyListener (this);
    focused = now != &parts.window ? now : nullptr;
    if (focused != nullptr)
    {
        focused->addKeyListener (this);
        parts.inspector.reveal (*focused);
    }
    if (now == nullptr) endDrag();
    poll();
}

bool Keyboard::keyPressed (const juce::KeyPress& key, juce::Component*)
{
    if (! isEsc (key)) return false;
    const bool stops = stopsBy (key);
    if (parts.patching.cancelDrag() || stops) return true;   // the next Esc closes what is open
    const bool has_dialog = parts.question.isOpen() || parts.palette.isVisible() || isDialogOpen();
    if (! parts.help.isOpen() || parts.openCover() != nullptr || has_dialog) return false;
    parts.help.close();   // even while a field has the keyboard, which would keep the key
    return true;
}

/// Another program has the keyboard: it gets the release of a button, too, for example after the window was minimised. So a drag ends here, and the
/// mouse does not go on pressing the tool without a button.
void Keyboard::endDrag()
{
    auto* peer = parts.window.getPeer();
    const auto mouse = juce::Desktop::getInstance().getMainMouseSource();
    if (peer == nullptr || peer->isFocused() || ! mouse.isDragging()) return;
    const auto released = juce::ModifierKeys::currentModifiers = juce::ModifierKeys::currentModifiers.withoutMouseButtons();
    peer->handleMouseEvent (juce::MouseInputSource::InputSourceType::mouse, peer->globalToLocal (mouse.getScreenPosition()), released,
                            juce::MouseInputSource::defaultPressure, juce::MouseInputSource::defaultOrientation, juce::Time::currentTimeMillis());
}

/// `focused` is still the field: a press takes the focus at once, but tells of it later.
void Keyboard::pressed (const juce::Component& c)
{
    if (focused != nullptr && &c != focused && ! focused->isParentOf (&c)) endTyping (focused);
}

juce::Component& Keyboard::home()
{
    if (parts.question.isOpen()) return parts.question;
    if (const auto* cover = parts.openCover()) return cover->component;
    if (parts.welcome.isVisible()) return parts.welcome;
    return parts.patching.isShowing() ? static_cast<juce::Component&> (parts.patching) : parts.window;
}

void Keyboard::poll()
{
    pollClutch();
    parts.dialogs.attendNewFolder();
    const auto* peer = parts.window.getPeer();
    if (peer == nullptr || ! peer->isFocused()) return;
    if (auto* modal = juce::Component::getCurrentlyModalComponent()) return parts.dialogs.keepKeyboard (*modal);
    auto& kept = home();
    const bool is_over = parts.question.isOpen() || parts.openCover() != nullptr;   // nothing else may have the keyboard
    const auto* now = juce::Component::getCurrentlyFocusedComponent();
    const bool is_kept = is_over ? kept.hasKeyboardFocus (true) : now != nullptr && parts.window.isParentOf (now) && now->isShowing();
    if (! is_kept && now != &kept) takeFocus (kept);
}

/// True while the canvas or the scene has the keyboard focus, in a window that has it, too. Elsewhere, the window does not learn when the key comes up.
bool Keyboard::isForClutch() const
{
    const auto* peer = parts.window.getPeer();
    return peer != nullptr && peer->isFocused()
           && (parts.patching.hasKeyboardFocus (true) || parts.hand.scene().hasKeyboardFocus (true) || parts.window.hasKeyboardFocus (false));
}

/// While S is down, the workspace of the hand's device moves with the hand. A key that is held comes again and again. Any key that comes up ends it, because
/// it is not known which one that is, unless S comes again at once: between two repetitions of a held key, the system may report that it is up.
bool Keyboard::pressClutch (const juce::KeyPress& key)
{
    if (! isKey (key, "s") || ! isForClutch()) return false;
    clutch_ends = false;
    if (! parts.playback.current().holdWorkspace (true))
        parts.status.hint (TRANS ("S moves the workspace of a device that runs. The tool has none: bind one in the Devices panel, and press START."));
    else if (! std::exchange (holds_clutch, true))
        parts.status.hint (TRANS ("The workspace moves with the hand until you release S. There is no force."));
    return true;
}

void Keyboard::pollClutch()
{
    if (! holds_clutch || (! clutch_ends && isForClutch())) return;
    holds_clutch = false;
    for (auto* each : { &parts.playback.run(), &parts.playback.current() })   // the second is that of a preview, if there is one
        static_cast<void> (each->holdWorkspace (false));
    parts.status.hint ({});
}

}   // namespace tactus::host
