// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/plain_button.hpp>

#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

namespace tactus::host
{

/// A modal question over the window. A question that is asked while another one is open waits until that is answered. Return picks the marked
/// choice: the first one, or the one the arrow keys moved to. Esc, which
/// the window passes on, picks the last one. A double click, or a key that is held, answers only one question: the next one has to be seen.
class Question final : public juce::Component
{
public:
    struct Choice
    {
        juce::String label;
        std::function<void()> act;
    };

    Question();

    static constexpr std::size_t most_listed = 20;

    /// The names of files for the text of a question, a line each; of more than most_listed, the first ones and how many more there are.
    static juce::String listOf (const std::vector<std::filesystem::path>& names);

    void ask (const juce::String& title, const juce::String& text, std::vector<Choice>);
    void say (const juce::String& text);   ///< replaces the text of the question that is open
    bool isOpen() const { return isVisible(); }
    void cancel();                      ///< picks the last choice
    void answer (std::size_t choice);   ///< like a click on its button
    const juce::String& title() const noexcept { return heading; }
    const juce::String& text() const noexcept { return body; }
    std::size_t size() const noexcept { return choices.size(); }

    void paint (juce::Graphics&) override;
    void resized() override;
    bool keyPressed (const juce::KeyPress&) override;
    bool keyStateChanged (bool is_down) override;
    void mouseDown (const juce::MouseEvent&) override;   ///< of its buttons, too
    void mouseUp (const juce::MouseEvent&) override;

private:
    struct PendingQuestion
    {
        juce::String title, text;
        std::vector<Choice> choices;
    };

    void mark (std::size_t choice);
    juce::TextLayout layout (int width) const;
    juce::TextLayout layoutOfTitle (int width) const;
    int titleHeight (int width) const;

    static constexpr int width = 560, margin = 24;
    juce::String heading, body;
    std::vector<Choice> choices;
    std::vector<std::unique_ptr<PlainButton>> buttons;
    std::size_t marked = 0;
    bool is_begun = false;      // a click has begun since the question was asked
    bool is_late = false;       // the press is the second of a click that had begun before
    bool is_key_held = false;   // the key that has answered the question before
    std::deque<PendingQuestion> waiting;
    juce::Rectangle<int> box;
};

}   // namespace tactus::host
