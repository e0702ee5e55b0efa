// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>

namespace tactus
{

/// A limit that may be tightened while more than it allows is on a device. It then falls to its new value in equal steps, from what is
/// on the device, so that nothing steps and nothing rises.
class FallingLimit
{
public:
    double now() const noexcept { return value; }
    double goal() const noexcept { return end; }
    bool isFalling() const noexcept { return value > end; }

    /// True once no more than the new value is on the device: a slew limit may let it fall more slowly than the limit does.
    bool isReached (double level) const noexcept { return ! isFalling() && level <= end; }

    /// `level` is on the device now. A limit that is already falling does not fall more slowly than before, nor again from further up.
    void tighten (double to, double level, double steps) noexcept
    {
        end = std::min (end, to);
        value = std::max (end, std::min (value, level));
        fall = isFalling() ? std::max (fall, (value - end) / std::max (1.0, steps)) : 0.0;
    }

    /// One step, or as many as have passed. Less may be on the device than the limit allows; then the limit falls to that.
    void advance (double level, double steps = 1.0) noexcept
    {
        value = std::max (end, std::min (value - fall * steps, level));
        if (! isFalling()) fall = 0.0;
    }

private:
    double value = std::numeric_limits<double>::infinity(), end = value, fall = 0.0;
};

}   // namespace tactus
