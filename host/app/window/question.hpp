// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "plain_button.hpp"

#include <functional>
#include <memory>
#include <vector>

namespace tactus::host
{

/// A question over the window that has to be answered before anything else is done in it. Return takes the first choice
/// or the one that the arrows lead to; Esc, which the window passes on, the last.
class Question final : public juce::Component
{
public:
    struct Choice
    {
        juce::String words;
        std::function<void()> act;
    };

    Question();

    void ask (const juce::String& title, const juce::String& text, std::vector<Choice>);
    bool isOpen() const { return isVisible(); }
    void cancel();                      ///< the last choice
    void answer (std::size_t choice);   ///< as a click on its button
    const juce::String& title() const noexcept { return heading; }
    std::size_t size() const noexcept { return choices.size(); }

    void paint (juce::Graphics&) override;
    void resized() override;
    bool keyPressed (const juce::KeyPress&) override;

private:
    void mark (std::size_t choice);
    juce::TextLayout layout (int width) const;

    static constexpr int width = 560, margin = 24;
    juce::String heading, words;
    std::vector<Choice> choices;
    std::vector<std::unique_ptr<PlainButton>> buttons;
    std::size_t marked = 0;
    juce::Rectangle<int> box;
};

}   // namespace tactus::host
