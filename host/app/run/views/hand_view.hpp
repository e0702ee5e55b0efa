// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/look.hpp>
#include <host/app/run/playback.hpp>

#include <deque>

namespace tactus::host
{

/// The surface from above, with the mouse as the stylus: moving hovers, a button presses, the wheel sets the depth. A bar on the right
/// shows the height of the tool. Without the mouse, the tool is shown as its device, gesture or recording moves it.
class HandView final : public juce::Component
{
public:
    static constexpr double half_width_m = 0.06, height_range_m = 0.012;
    static constexpr double least_depth_m = 0.2e-3, most_depth_m = 8e-3;

    explicit HandView (Playback&);

    void refresh();   ///< call many times a second

    double depth() const noexcept { return press_depth; }   ///< depth of a press, in m

    /// Holds the tool pressed where it is, so that the pointer is free to turn a knob; or releases the tool.
    void hold();
    bool isHeld() const noexcept { return held; }
    void letGo()
    {
        if (held) hold();
    }

    /// Moves the tool as the pointer on this view does, to a place in m. A press takes the tool from its device, gesture or recording.
    void steer (double x, double y, bool presses);
    void pressDeeper (double octaves);

    void paint (juce::Graphics&) override;
    void mouseMove (const juce::MouseEvent&) override;
    void mouseDown (const juce::MouseEvent&) override;
    void mouseDrag (const juce::MouseEvent&) override;
    void mouseUp (const juce::MouseEvent&) override;
    bool keyPressed (const juce::KeyPress&) override;
    void mouseWheelMove (const juce::MouseEvent&, const juce::MouseWheelDetails&) override;

private:
    static constexpr double hover_m = 3e-3;
    static constexpr std::size_t longest_trail = 240;

    juce::Rectangle<float> surface() const;
    juce::Point<float> toPixels (const Vec3&) const;
    void paintHeight (juce::Graphics&) const;
    void point (const juce::MouseEvent&);
    void takeTool();
    void moveTool() { playback.run().point (target); }

    Playback& playback;
    bool by_pointer = false, pressed = false, held = false;
    double press_depth = 1.5e-3;   // m
    Vec3 target = Vec3::Zero();
    std::optional<LiveRun::Tool> tool;
    std::deque<Vec3> trail;
    std::uint64_t last_tick = 0;   // of the run, at the last refresh
};

}   // namespace tactus::host
