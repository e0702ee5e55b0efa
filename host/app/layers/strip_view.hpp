// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_gui_basics/juce_gui_basics.h>

#include <utility>

namespace tactus::host
{

/// Scrolls strips. A turn of the wheel that scrolls keeps scrolling: a fader that arrives under the pointer leaves it alone.
class StripView final : public juce::Viewport
{
public:
    bool isScrolling() const { return scrolled_at != 0 && juce::Time::getMillisecondCounter() - scrolled_at < 500; }

private:
    void visibleAreaChanged (const juce::Rectangle<int>& area) override
    {
        if (std::exchange (at, area.getPosition()) != area.getPosition()) scrolled_at = juce::Time::getMillisecondCounter();
    }

    juce::Point<int> at;
    std::uint32_t scrolled_at = 0;   // in ms; 0: never
};

}   // namespace tactus::host
