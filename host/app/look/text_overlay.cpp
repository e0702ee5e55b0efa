// SPDX-License-Identifier: GPL-3.0-or-later
#include "text_overlay.hpp"

#include <host/app/look/focus.hpp>
#include <host/app/look/look.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host
{

void TextOverlay::open (juce::Rectangle<int> area, const juce::String& text, Kind kind, std::function<bool (const juce::String&)> done,
                        std::function<void (int)> next)
{
    close (true);
    const bool is_value = kind == Kind::value;
    on_edited = std::move (done);
    on_tab = std::move (next);
    editor = std::make_unique<juce::TextEditor>();
    editor->setMultiLine (kind == Kind::lines);
    editor->setReturnKeyStartsNewLine (false);
    editor->setFont (lookOf (owner).font (13.0f));
    editor->setText (text, false);
    editor->setBounds (area.withWidth (std::max (120, area.getWidth())).withHeight (std::max (24, area.getHeight())));
    editor->onFocusLost = [this] { close (true); };
    editor->onReturnKey = [this] {   // JUCE calls it later: the editor may be gone
        if (! editor) return;
        const auto apply = on_edited;
        if (apply (editor->getText())) return close (false);
        if (! editor) return;
        editor->setColour (juce::TextEditor::focusedOutlineColourId, themeOf (owner).stop);
        editor->selectAll();
    };
    editor->onEscapeKey = [this, is_value] {
        close (! is_value);
        if (onEscape) onEscape();
    };
    if (! is_value)
        typing.emplace (*editor, [this] {
            const auto apply = on_edited;
            apply (editor->getText());
        });
    owner.addAndMakeVisible (*editor);
    takeFocus (*editor);
    editor->selectAll();
}

void TextOverlay::close (bool keeps_text)
{
    const std::shared_ptr<juce::TextEditor> ended = std::move (editor);
    if (! ended) return;
    typing.reset();
    ended->onTextChange = nullptr;
    ended->onFocusLost = nullptr;
    owner.removeChildComponent (ended.get());
    juce::MessageManager::callAsync ([ended] {});   // deletes the editor after the current event, which may come from the editor itself
    const auto done = std::exchange (on_edited, nullptr);
    if (keeps_text) done (ended->getText());
}

void TextOverlay::tab (int step)
{
    const auto next = on_tab;
    close (true);
    takeFocus (owner);
    if (next) next (step);
}

}   // namespace tactus::host
