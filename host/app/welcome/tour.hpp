// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/plain_button.hpp>
#include <host/app/text/filled.hpp>

#include <functional>
#include <vector>

namespace tactus::host
{

/// A tour of the window, in steps. Each step frames a part of the window and says what one does there; the window stays usable meanwhile. Return and
/// the right arrow go on, the left arrow goes back, and Esc ends the tour.
class Tour final : public juce::Component
{
public:
    struct Step
    {
        juce::Component* part = nullptr;   ///< what is framed; must live as long as this object
        juce::String title, text;
    };

    Tour();

    void begin (std::vector<Step>);
    void go (int by);   ///< forwards or backwards; ends after the last step
    void close();
    bool isOpen() const { return isVisible(); }
    std::size_t step() const noexcept { return now; }

    std::function<void()> onEnd;                ///< called when the last step was read, and when the tour is ended before
    std::function<void (const Step&)> onStep;   ///< called before a step is shown, to bring its part into view

    void paint (juce::Graphics&) override;
    void resized() override;
    bool hitTest (int x, int y) override { return card.contains (x, y); }
    bool keyPressed (const juce::KeyPress&) override;

private:
    juce::Rectangle<int> framed() const;
    juce::TextLayout layout (int card_width) const;
    int heightFor (int card_width) const;
    juce::Rectangle<int> besidePart (int card_width) const;

    static constexpr int width = 360, least_width = 232, margin = 16, gap = 12;
    std::vector<Step> steps;
    std::size_t now = 0;
    juce::Rectangle<int> card;
    PlainButton next { {} }, back { TRANS ("Back") }, skip { TRANS ("End tour") };
};

}   // namespace tactus::host
