// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

namespace tactus::host
{

/// Maps data to pixels: `low` to `first`, `high` to `last`.
struct PixelMap
{
    double low = 0.0, high = 1.0;
    float first = 0.0f, last = 1.0f;

    float operator() (double value) const noexcept
    {
        return first + static_cast<float> ((value - low) / (high - low)) * (last - first);
    }
};

struct PixelPoint
{
    float x = 0.0f, y = 0.0f;

    bool operator== (const PixelPoint&) const = default;
};

using Polyline = std::vector<PixelPoint>;

/// The lines through the points, broken where a coordinate cannot be plotted.
///
/// Of consecutive points within one column of pixels, only the first, lowest, highest and last are kept, in order. The
/// drawing still covers the same pixels, and no peak is lost. Pixels that the curve retraces, as in a loop, are drawn once.
std::vector<Polyline> linesThrough (std::span<const double> x, std::span<const double> y, const PixelMap& to_x, const PixelMap& to_y);

/// The dots to draw, at most one per half pixel.
std::vector<PixelPoint> dotsAt (std::span<const double> x, std::span<const double> y, const PixelMap& to_x, const PixelMap& to_y);

}   // namespace tactus::host
