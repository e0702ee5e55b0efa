// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "performance.hpp"

#include <host/app/look/look.hpp>

#include <deque>
#include <functional>

namespace tactus::host
{

/// The surface from above, with the mouse as the stylus: it hovers, a button presses, the wheel says how deep. Beside it how
/// high the tool is. While nobody points, the gesture or recording of the graph is shown as it moves.
class HandView final : public juce::Component
{
public:
    static constexpr double half_width_m = 0.06, height_range_m = 0.012;
    static constexpr double least_depth_m = 0.2e-3, most_depth_m = 8e-3;

    HandView();

    void show (const Performance&);   ///< many times a second

    double depth() const noexcept { return press_depth; }   ///< m, of a press

    /// Leaves the tool pressed where it is, so that the pointer is free for a knob; or lets it go.
    void hold();
    bool isHeld() const noexcept { return held; }

    std::function<void (const Vec3&)> onPoint;   ///< m; where the mouse wants the tool
    std::function<void()> onTakesOver;           ///< the mouse wants to be the hand

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
    void pressDeeper (double octaves);

    bool by_pointer = false, pressed = false, held = false, running = false;
    double press_depth = 1.5e-3;   // m
    Vec3 target = Vec3::Zero();
    std::optional<Performance::Tool> tool;
    std::deque<Vec3> trail;
};

}   // namespace tactus::host
