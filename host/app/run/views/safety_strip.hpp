// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/limits/limit_light.hpp>
#include <host/app/look/look.hpp>
#include <host/app/run/playback.hpp>

namespace tactus::host
{

/// The strip at the top of the window, which is always visible: the state of the run, whether it is fused, its guards, the current and peak force, missed
/// ticks, the delay with the stiffness that it allows, the light of the limits, and the STOP button.
class SafetyStrip final : public juce::Component, public juce::TooltipClient
{
public:
    static constexpr int height = 44;

    explicit SafetyStrip (Playback&);
    ~SafetyStrip() override;

    void refresh();   ///< call many times a second

    /// The part of the strip where a click is a stop. Empty while there is nothing to stop.
    juce::Rectangle<int> stopPlace() const;

    /// The state of the run, as the strip shows it.
    const juce::String& text() const noexcept { return shown.state; }

    /// The text about what the guards have stopped or limited, and whether it is shown as an alarm.
    const juce::String& guardText() const noexcept { return shown.guard; }
    bool isAlarmed() const noexcept { return shown.alarmed; }

    /// The force now, and the largest one since the start.
    const juce::String& forceText() const noexcept { return shown.force; }

    /// A click on the state while the graph has errors.
    std::function<void()> onProblems;

    LimitLight& limitLight() noexcept { return limits; }

    void paint (juce::Graphics&) override;
    void resized() override;
    juce::String getTooltip() override { return tooltipAt (getMouseXYRelative()); }
    juce::String tooltipAt (juce::Point<int>) const;   ///< what the part that is painted there means
    void mouseMove (const juce::MouseEvent&) override;
    void mouseUp (const juce::MouseEvent&) override;

private:
    struct Status
    {
        juce::String state, guard, force, misses, delay, walls;
        bool running = false, alarmed = false, warned = false, stopped_for_good = false, has_errors = false;

        bool operator== (const Status&) const = default;
    };

    class StopButton;

    static Status stateOf (LiveRun&);
    static void showGuards (const LiveRun&, const RunStatus&, Status&);

    Playback& playback;
    Status shown;
    juce::Rectangle<int> state_place;                                      // where the state is painted
    std::vector<std::pair<juce::Rectangle<int>, juce::String>> meanings;   // of the parts, where they are painted
    std::unique_ptr<StopButton> button, rearm;
    LimitLight limits;
};

}   // namespace tactus::host
