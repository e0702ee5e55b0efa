// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_graphics/juce_graphics.h>

#include <cstdint>
#include <string>

namespace tactus::host
{

/// An animated PNG, frame by frame (APNG specification 1.0, Mozilla): every browser and most viewers play it, and others show its first
/// frame. Each frame holds only the pixels that have changed. [any thread]
class AnimatedPng
{
public:
    /// A pixel stays as it is shown while its red, green and blue differ by at most `tolerance` (0…255) from those of the frame.
    explicit AnimatedPng (int t = 0) noexcept : tolerance (t) {}

    /// Adds a frame for this long. All frames must be opaque, and have the size of the first one. False if the frame cannot be encoded.
    bool add (const juce::Image& frame, std::uint16_t milliseconds);

    std::uint32_t frames() const noexcept { return count; }

    /// The file as a whole. It plays again and again, or only once.
    std::string file (bool repeats = true) const;

private:
    bool differs (const juce::PixelRGB&, const juce::PixelRGB&) const noexcept;
    juce::Rectangle<int> changed (const juce::Image& frame) const;
    std::string encoded (const juce::Image& frame, juce::Rectangle<int> part);

    int tolerance;
    std::string header, body;   // IHDR; the frames
    std::uint32_t count = 0, sequence = 0;
    juce::Image shown;          // what a player shows after the latest frame
};

}   // namespace tactus::host
