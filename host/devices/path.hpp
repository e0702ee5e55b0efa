// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/devices/gestures.hpp>
#include <host/devices/trace.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace tactus::host
{

/// Where a gesture or a recording is put: offset + scale p.
struct Placement
{
    Vec3 offset = Vec3::Zero();   ///< m
    double scale = 1.0;
};

/// Where a hand wants to be, as a smooth function of time. What pulls the simulated device, and moves the kinematic one.
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
    virtual double duration() const noexcept = 0;     ///< s until it repeats or stands still
};

/// A gesture, repeated for ever.
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

/// A recording, straight from row to row so that it has a velocity, its end held. Rows that are not finite are left
/// out: a hand does not vanish because it was not seen.
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

}   // namespace tactus::host
