// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_gui_basics/juce_gui_basics.h>

namespace tactus::host
{

/// The caret of a text field. Unlike JUCE's, it has a timer only while its field has the keyboard: a window has dozens of fields, and JUCE's
/// carets all blink, unseen, from the first layout on.
class Caret final : public juce::CaretComponent, private juce::FocusChangeListener
{
public:
    explicit Caret (juce::Component* field);
    ~Caret() override;

    bool isBlinking() const noexcept { return blink.isTimerRunning(); }
    void setCaretPosition (const juce::Rectangle<int>& character) override;

private:
    struct Blink final : juce::Timer
    {
        explicit Blink (Caret& c) : caret (c) {}
        void timerCallback() override { caret.show (! caret.isVisible()); }
        Caret& caret;
    };

    void globalFocusChanged (juce::Component*) override { show (true); }
    void show (bool is_lit);

    juce::Component* field;
    Blink blink { *this };
};

}   // namespace tactus::host
