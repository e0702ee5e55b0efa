// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_gui_basics/juce_gui_basics.h>

namespace tactus::host
{

/// Gives a component the keyboard focus if it is on screen.
inline void takeFocus (juce::Component& c)
{
    if (c.isShowing()) c.grabKeyboardFocus();
}

/// Call it before a component is hidden or deleted: JUCE would give its focus to a neighbour. The window gives it to the canvas.
inline void letGoOfFocus (const juce::Component& c)
{
    if (c.hasKeyboardFocus (true)) juce::Component::unfocusAllComponents();
}

/// True for a key that begins to type a number. Not for Ctrl and a digit, which X11 reports with the text of the digit.
inline bool isTypedNumber (const juce::KeyPress& key)
{
    const auto c = key.getTextCharacter();
    return ((c >= '0' && c <= '9') || c == '-' || c == '.') && ! key.getModifiers().isCommandDown() && ! key.getModifiers().isAltDown();
}

/// A key that erases a value, so that another one can be typed.
inline bool isErasing (const juce::KeyPress& key) { return key == juce::KeyPress::deleteKey || key == juce::KeyPress::backspaceKey; }

inline bool isArrow (const juce::KeyPress& key)
{
    using K = juce::KeyPress;
    return key.isKeyCode (K::upKey) || key.isKeyCode (K::downKey) || key.isKeyCode (K::leftKey) || key.isKeyCode (K::rightKey);
}

/// Applies what is being typed into this component if it is a field, as Return does. JUCE tells a field only later that it has lost the focus, when the
/// graph may have been saved, replaced or started without it.
inline void endTyping (juce::Component* in = juce::Component::getCurrentlyFocusedComponent())
{
    const auto* field = dynamic_cast<juce::TextEditor*> (in);
    if (field == nullptr) return;
    if (const auto apply = field->onFocusLost) apply();   // a copy, because what is applied may delete the field
}

}   // namespace tactus::host
