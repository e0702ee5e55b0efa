// SPDX-License-Identifier: MIT
#pragma once

#include "device.hpp"

#include <limits>

namespace tactus
{

/// What a guard allows. The defaults limit nothing, so that a simulated device is exact; a real device's profile
/// sets them, and a session may only tighten them.
struct GuardLimits
{
    static constexpr double none = std::numeric_limits<double>::infinity();

    double max_force = none;    ///< N, length of the vector
    double max_torque = none;   ///< N m, length of the vector
    double max_slew = none;     ///< N/s, length of the change of force
    double ramp = 0.0;          ///< s from 0 to full effort after enabling
    double watchdog = none;     ///< s without a fresh reading before the effort goes to 0

    bool operator== (const GuardLimits&) const = default;
};

/// The last thing before a device, one per role, always there. It passes efforts that are finite, short and smooth
/// enough, shortens the others without turning them, and brings everything to zero when the input is stale.
class Guard
{
public:
    enum class Stop
    {
        none,
        not_finite,
        stale
    };

    void prepare (const GuardLimits&, double dt_s) noexcept;             // [main thread]
    Effort operator() (const Effort& wanted, const Reading&) noexcept;   // [tick thread]

    /// Why the last effort was withheld. [any thread that owns the guard]
    Stop stop() const noexcept { return reason; }

private:
    GuardLimits limits;
    double dt = 0.0;
    double enabled = 1.0;   // 0…1, how far the enable ramp has come
    Vec3 last = Vec3::Zero();
    Stop reason = Stop::none;
};

}   // namespace tactus
