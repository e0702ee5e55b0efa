// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/at.hpp>

#include <vector>

namespace tactus
{

/// Equidistant points from 0, mirrored at both ends: beyond an end, the points repeat in reverse order.
struct MirroredAxis
{
    int intervals = 0;      ///< intervals between points; 0: a single point
    double spacing = 1.0;   ///< in m

    int points() const noexcept { return intervals + 1; }

    /// The point that index i falls on. Accepts any int.
    int mirrored (int i) const noexcept
    {
        if (intervals == 0) return 0;
        i %= 2 * intervals;
        if (i < 0) i += 2 * intervals;
        return i <= intervals ? i : 2 * intervals - i;
    }

    /// An axis of the same length with a different number of intervals. A single point stays a single point.
    MirroredAxis with (int n) const noexcept { return intervals == 0 ? *this : MirroredAxis { n, spacing * intervals / n }; }
};

/// Numbers over a plane that is continued by mirroring in x and y.
struct MirroredGrid
{
    MirroredAxis x, y;
    std::vector<double> values;   ///< row after row, each along x

    double& operator() (int row, int column) noexcept { return values[at (row) * at (x.points()) + at (column)]; }
    double operator() (int row, int column) const noexcept { return values[at (row) * at (x.points()) + at (column)]; }
};

/// The mean over the mirrored plane, where the end points occur once a period and the points between them twice. [main thread]
double meanOf (const MirroredGrid&);

/// The values at the points of other axes, low-passed: nothing is left above `cutoff`, in 1/m, along x or y. The filter is a
/// sinc with a Kaiser window of 60 dB, with `zeros` zero crossings on either side. [main thread]
MirroredGrid resampled (const MirroredGrid&, const MirroredAxis& to_x, const MirroredAxis& to_y, double cutoff, double zeros);

}   // namespace tactus
