// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/device.hpp>
#include <tactus/plan/sum.hpp>

#include <algorithm>
#include <cstddef>
#include <span>

namespace tactus
{

/// The sum of the efforts of all sinks of a role. Its bits do not depend on the order of the sinks. `numbers` is memory for as many
/// numbers as there are efforts. [tick thread]
inline Effort sumOfEfforts (std::span<const Effort> efforts, double* numbers) noexcept
{
    int axes = 0, signals = 0;
    for (const auto& e : efforts)
    {
        axes = std::max (axes, e.axes.size());
        signals = std::max (signals, e.signals.size());
    }
    const auto sum = [efforts, numbers] (auto part) noexcept {
        for (std::size_t i = 0; i < efforts.size(); ++i)
            numbers[i] = part (efforts[i]);
        return plan::sum (numbers, static_cast<int> (efforts.size()));
    };
    Effort all;
    for (int c = 0; c < 3; ++c)
    {
        all.force[c] = sum ([c] (const Effort& e) { return e.force[c]; });
        all.torque[c] = sum ([c] (const Effort& e) { return e.torque[c]; });
    }
    all.brake = sum ([] (const Effort& e) { return e.brake; });
    for (int i = 0; i < axes; ++i)
        all.axes.set (i, sum ([i] (const Effort& e) { return e.axes[i]; }));
    for (int i = 0; i < signals; ++i)
        all.signals.set (i, sum ([i] (const Effort& e) { return e.signals[i]; }));
    return all;
}

}   // namespace tactus
