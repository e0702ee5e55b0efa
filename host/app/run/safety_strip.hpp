// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "performance.hpp"

#include <host/app/look/look.hpp>

#include <functional>

namespace tactus::host
{

/// What runs and whether it is safe, always in sight: running or why not, force now and the largest so far, ticks that were
/// missed and what took so long, the delay and the stiffness it leaves, and the stop.
class SafetyStrip final : public juce::Component
{
public:
    static constexpr int height = 44;

    SafetyStrip();
    ~SafetyStrip() override;

    void show (Performance&);   ///< many times a second

    std::function<void()> onStop, onStart, onRearm;

    void paint (juce::Graphics&) override;
    void resized() override;

private:
    struct Shown
    {
        juce::String state, guard, force, misses, delay;
        bool running = false, alarmed = false, warned = false, stopped_for_good = false;

        bool operator== (const Shown&) const = default;
    };

    class StopButton;

    Shown shown;
    std::unique_ptr<StopButton> button, rearm;
};

}   // namespace tactus::host
