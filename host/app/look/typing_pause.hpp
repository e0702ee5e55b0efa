// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <utility>

#include <juce_gui_basics/juce_gui_basics.h>

namespace tactus::host
{

/// Calls a function when the user pauses while typing a longer text, so that it is in the document, and so in the autosave, before the field is left.
class TypingPause final : private juce::Timer
{
public:
    TypingPause (juce::TextEditor& editor, std::function<void()> f) : onPause (std::move (f))
    {
        editor.onTextChange = [this] { startTimer (pause_ms); };
    }

    void timerCallback() override
    {
        stopTimer();
        const auto call = onPause;   // a copy, because the field may be deleted
        call();
    }

private:
    static constexpr int pause_ms = 700;
    std::function<void()> onPause;
};

}   // namespace tactus::host
