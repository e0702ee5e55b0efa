// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/node/device.hpp>

#include <cstdint>

namespace tactus::host
{

/// A stroke along x at a constant speed, pressed to a constant depth below z = 0. Its middle is at x = 0.
struct Stroke
{
    double speed = 0.1, length = 0.06, depth = 1e-3;   ///< m/s, m, m

    /// The time for which the tool moves before the stroke begins, in s, so that transients of the first contact are over.
    static constexpr double lead_in_s = 0.2;
};

/// A hand that makes a stroke and does not yield to forces.
class StrokeDevice final : public Device
{
public:
    explicit StrokeDevice (const Stroke& s) : stroke (s) {}

    void prepare (double dt_s) override
    {
        dt = dt_s;
        tick = 0;
    }

    Reading read() noexcept override
    {
        constexpr double pad_stiffness = 500.0;   // N/m, as a gesture reports its pressure
        const double t = static_cast<double> (tick) * dt - Stroke::lead_in_s;
        Reading reading;
        reading.position = reading.true_position = Vec3 (stroke.speed * t - 0.5 * stroke.length, 0.0, -stroke.depth);
        reading.true_velocity = Vec3 (stroke.speed, 0.0, 0.0);
        reading.pressure = pad_stiffness * stroke.depth;
        return reading;
    }

    void write (const Effort&) noexcept override { ++tick; }

private:
    Stroke stroke;
    double dt = 1e-3;
    std::int64_t tick = 0;
};

}   // namespace tactus::host
