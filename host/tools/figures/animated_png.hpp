// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_graphics/juce_graphics.h>

#include <cstdint>
#include <string>

namespace tactus::host
{

/// Writes an animated PNG, frame by frame (APNG specification 1.0, Mozilla). Every browser and most viewers play it; others show its first
/// frame. Each frame holds only the pixels that have changed. [any thread]
class AnimatedPng
{
public:
    /// A pixel is not redrawn as long as its red, green and blue are within `tolerance` (0 to 255) of those of the new frame.
    explicit AnimatedPng (int t = 0) noexcept : tolerance (t) {}

    /// Adds a frame that is shown for this time. All frames must be opaque, and have the size of the first one. False if it cannot be encoded.
    bool add (const juce::Image& frame, std::uint16_t milliseconds);

    std::uint32_t frames() const noexcept { return count; }

    /// The complete file. It plays in a loop, or only once.
    std::string file (bool repeats = true) const;

private:
    bool differs (const juce::PixelRGB&, const juce::PixelRGB&) const noexcept;
    juce::Rectangle<int> changed (const juce::Image& frame) const;
    std::string encoded (const juce::Image& frame, juce::Rectangle<int> part);

    int tolerance;
    std::string header, body;   // IHDR; the frames
    std::uint32_t count = 0, sequence = 0;
    juce::Image shown;   // what a player shows after the latest frame
};

}   // namespace tactus::host
