// SPDX-License-Identifier: MIT
#pragma once

#include "gestures.hpp"
#include "trace.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace tactus
{

/// Offset and scale of a gesture or a recording: offset + scale p.
struct Placement
{
    Vec3 offset = Vec3::Zero();   ///< m
    double scale = 1.0;
};

/// The path of a hand: a position as a continuous function of time. The hand pulls a simulated device along; a GestureDevice
/// follows the path exactly.
class Path
{
public:
    struct Point
    {
        Vec3 position = Vec3::Zero();   ///< m
        Vec3 velocity = Vec3::Zero();   ///< m/s
    };

    virtual ~Path() = default;

    virtual Point at (double t) const noexcept = 0;   // [tick thread]
    virtual double duration() const noexcept = 0;     ///< time until the path repeats or ends, in s
};

/// A gesture, repeated indefinitely.
class GesturePath final : public Path
{
public:
    GesturePath (const Gesture& what, const Placement& where) : gesture (what), placement (where) {}

    Point at (double t) const noexcept override;
    double duration() const noexcept override { return gesture.duration_s; }

private:
    Gesture gesture;
    Placement placement;
};

/// A recording, interpolated linearly from row to row so that it has a velocity. After the end, the last position is held. Rows
/// that are not finite are skipped: a hand does not vanish just because tracking was lost.
class TracePath final : public Path
{
public:
    TracePath (const TraceData&, const Placement&);

    Point at (double t) const noexcept override;
    double duration() const noexcept override { return lasts; }

private:
    struct Knot
    {
        double t;
        Vec3 position;
    };

    std::vector<Knot> knots;
    double lasts;
};

}   // namespace tactus
