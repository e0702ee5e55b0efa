// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <utility>

#include <juce_gui_basics/juce_gui_basics.h>

namespace tactus::host
{

/// Calls a function soon after each change of a longer text, so that it is in the document, and so in the autosave, before the field is left.
class TypingTimer final : private juce::Timer
{
public:
    TypingTimer (juce::TextEditor& editor, std::function<void()> f) : onChange (std::move (f))
    {
        editor.onTextChange = [this] {
            if (! isTimerRunning()) startTimer (delay_ms);
        };
    }

    void timerCallback() override
    {
        stopTimer();
        const auto call = onChange;   // a copy, because the field may be deleted
        call();
    }

private:
    static constexpr int delay_ms = 700;
    std::function<void()> onChange;
};

}   // namespace tactus::host
