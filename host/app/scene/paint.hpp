// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/theme.hpp>
#include <tactus/kit/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace tactus::host::scene
{

/// A colour as three numbers from 0 to 255, which light may scale.
using Ink = std::array<float, 3>;

inline Ink inkOf (juce::Colour c) noexcept
{
    return { static_cast<float> (c.getRed()), static_cast<float> (c.getGreen()), static_cast<float> (c.getBlue()) };
}

inline Ink mixed (const Ink& a, const Ink& b, float share_of_b) noexcept
{
    const float t = std::clamp (share_of_b, 0.0f, 1.0f);
    return { a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]) };
}

inline std::uint32_t pixelOf (const Ink& ink, float light) noexcept
{
    const auto part = [light] (float v) { return static_cast<std::uint32_t> (std::clamp (v * light, 0.0f, 255.0f)); };
    return 0xff000000u | part (ink[0]) << 16 | part (ink[1]) << 8 | part (ink[2]);
}

/// The colours and the light of a scene, from the theme of the window.
struct Paint
{
    Ink material, lines, depth, metal, slit, tool;

    explicit Paint (const Theme& theme)
        : material (inkOf (theme.is_dark ? juce::Colour (0xff788593) : juce::Colour (0xffdbe2ea))),
          lines (inkOf (theme.is_dark ? theme.canvas : theme.dim)), depth (inkOf (theme.of (Quantity::length))),
          metal (inkOf (theme.is_dark ? juce::Colour (0xffc9d2dc) : juce::Colour (0xff98a4b3))),
          slit (inkOf (theme.is_dark ? juce::Colour (0xff0a0c0f) : juce::Colour (0xff3a424c))),
          tool (inkOf (theme.text)), ambient (theme.is_dark ? 0.30f : 0.52f)
    {
    }

    /// The brightness of a surface whose normal points this way, from 0 to about 1. The light comes from the upper left, in front.
    float light (float nx, float ny, float nz) const noexcept
    {
        constexpr float lx = -0.45f, ly = -0.35f, lz = 0.82f;
        const float cosine = (nx * lx + ny * ly + nz * lz) / std::max (1e-6f, std::sqrt (nx * nx + ny * ny + nz * nz));
        return ambient + (1.0f - ambient) * std::max (0.0f, cosine);
    }

private:
    float ambient;
};

}   // namespace tactus::host::scene
