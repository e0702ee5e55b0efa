// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/typing_timer.hpp>

#include <juce_gui_basics/juce_gui_basics.h>

#include <functional>
#include <memory>
#include <optional>

namespace tactus::host
{

/// A text field over a part of a component, for as long as a text is being edited. [main thread]
class TextOverlay
{
public:
    /// Kinds of texts.
    enum class Kind
    {
        value,   ///< one line, which is used as a whole
        title,   ///< one line that is also passed on while it is being typed
        lines    ///< several such lines
    };

    explicit TextOverlay (juce::Component& over) : owner (over) {}

    /// Ends another edit first. If `done` refuses the text, by false, Return leaves the field for another try. Esc discards a value, but keeps a title
    /// or lines, which have been passed on. `next` is for tab().
    void open (juce::Rectangle<int> area, const juce::String& text, Kind kind, std::function<bool (const juce::String&)> done,
               std::function<void (int step)> next);
    void close (bool keeps_text);
    bool isOpen() const noexcept { return editor != nullptr; }
    void tab (int step);   ///< ends the edit, and goes to the next thing to edit, or with -1 to the previous one

    std::function<void()> onEscape;

private:
    juce::Component& owner;
    std::unique_ptr<juce::TextEditor> editor;
    std::optional<TypingTimer> typing;   // unless a value is edited
    std::function<bool (const juce::String&)> on_edited;
    std::function<void (int step)> on_tab;
};

}   // namespace tactus::host
