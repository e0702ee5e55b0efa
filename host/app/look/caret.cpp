// SPDX-License-Identifier: GPL-3.0-or-later
#include "caret.hpp"

namespace tactus::host
{

namespace
{
constexpr int blink_ms = 380, width = 2;   // as JUCE has them
}

Caret::Caret (juce::Component* f) : CaretComponent (f), field (f)
{
    setVisible (false);
    juce::Desktop::getInstance().addFocusChangeListener (this);
}

Caret::~Caret() { juce::Desktop::getInstance().removeFocusChangeListener (this); }

void Caret::setCaretPosition (const juce::Rectangle<int>& character)
{
    setBounds (character.withWidth (width));
    show (true);
}

void Caret::show (bool is_lit)
{
    const bool is_used = field->hasKeyboardFocus (false) && ! field->isCurrentlyBlockedByAnotherModalComponent();
    setVisible (is_used && is_lit);
    if (! is_used)
        blink.stopTimer();
    else if (is_lit)
        blink.startTimer (blink_ms);
}

}   // namespace tactus::host
