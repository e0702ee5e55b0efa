// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/devices/path.hpp>
#include <host/runtime/snapshot.hpp>

#include <cmath>

namespace tactus::host
{

/// Where the mouse or pen wants the tool to be. It comes in 60 times a second, or so, and is made smooth for the tick: the hand
/// follows it as a critically damped spring does, which is solved exactly from tick to tick.
class PointerPath final : public Path
{
public:
    /// How fast the hand follows: it is nearly there after a twentieth of a second.
    static constexpr double follow_rate = 80.0;   // 1/s

    explicit PointerPath (const Vec3& start) : target (Target { { start.x(), start.y(), start.z() } }), now { start, Vec3::Zero() } {}

    void moveTo (const Vec3& p) noexcept { target.store ({ { p.x(), p.y(), p.z() } }); }   ///< [main thread]

    /// To be asked with a time that goes on from call to call. [tick thread]
    Point at (double t) const noexcept override
    {
        const double dt = t - last;
        last = t;
        if (! (dt > 0.0)) return now;
        const auto [wanted] = target.load();
        // x = (a + b t) e^(-w t) about the target.
        const Vec3 offset = now.position - Vec3 (wanted.data()), b = now.velocity + follow_rate * offset;
        const double decay = std::exp (-follow_rate * dt);
        now.position = Vec3 (wanted.data()) + decay * (offset + b * dt);
        now.velocity = decay * (b - follow_rate * (offset + b * dt));
        return now;
    }

    double duration() const noexcept override { return 0.0; }

private:
    struct Target
    {
        std::array<double, 3> position {};   // m
    };

    Snapshot<Target> target;
    mutable Point now;   // of the tick thread
    mutable double last = 0.0;
};

}   // namespace tactus::host
