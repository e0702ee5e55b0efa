// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/math/math.hpp>
#include <tactus/kit/signal/biquad.hpp>

#include <numbers>
#include <optional>

namespace tactus::host::audio
{

/// Removes frequencies that a speaker cannot play and that would only push its cone: a second-order Butterworth high-pass,
/// the same as a filter.biquad of kind high. A cutoff of 0 turns it off. [tick thread, after construction]
class HighPass
{
public:
    HighPass (double cutoff_hz, double rate_hz)
    {
        if (cutoff_hz <= 0.0) return;
        const double w = 2.0 * std::numbers::pi * usableCutoff (cutoff_hz, rate_hz) / rate_hz;
        const double c = math::cos (w), alpha = math::sin (w) / (2.0 * 0.7071), a0 = 1.0 + alpha;
        const double b0 = 0.5 * (1.0 + c), b1 = -(1.0 + c);
        filter = Biquad { b0 / a0, b1 / a0, b0 / a0, -2.0 * c / a0, (1.0 - alpha) / a0 };
    }

    bool isOn() const noexcept { return filter.has_value(); }
    void reset() noexcept { state = {}; }   ///< forgets earlier input

    double operator() (double in) noexcept { return filter ? state (*filter, in) : in; }

private:
    std::optional<Biquad> filter;
    BiquadState state;
};

}   // namespace tactus::host::audio
