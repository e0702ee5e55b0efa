// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::nodes
{

/// Triggers a hit each time a signal rises through a threshold.
///
///     hit    speed, on the tick where `in` rises above threshold + hysteresis / 2
///     gate   1 from there until `in` is back at threshold - hysteresis / 2 or below, which arms the next hit
///
/// A signal that is already high on the first sample, or on the first sample after a non-finite one, opens the gate without a
/// hit. The hysteresis should be wider than the noise on the signal, or one crossing makes many hits.
///
/// Source: Schmitt 1938.
struct SignalTrigger
{
    using Inputs = In<double>;

    struct Params
    {
        double threshold = 0.0;
        double hysteresis = 0.0;
        double speed = 1.0;
    };

    struct Outputs
    {
        double hit = 0.0;
        double gate = 0.0;
    };

    static constexpr Info info {
        .id = "signal.trigger",
        .name = "Trigger",
        .summary = "Triggers a hit when a signal rises through a threshold.",
        .source = "Schmitt trigger (1938)",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "signal"),
        param (&Params::threshold, "threshold", sameAs ("in"), "middle of the two levels", { .usual = { -1, 1 } }),
        param (&Params::hysteresis, "hysteresis", sameAs ("in"), "distance between the two levels", { .hard = { 0, inf }, .usual = { 0, 1 } }),
        param (&Params::speed, "speed", unit::speed, "impact speed of each hit", { .hard = { 0, inf }, .usual = { 0, 5 } }),
        output (&Outputs::hit, "hit", unit::hit, "speed on the tick of the hit, else 0"),
        output (&Outputs::gate, "gate", unit::gain, "1 while the signal is high, else 0"),
    };

    Params params;

    Outputs tick (const Inputs& in) noexcept
    {
        if (! isFinite (in.in))
        {
            seen = Seen::nothing;
            return {};
        }

        const double half = 0.5 * params.hysteresis;
        const Seen before = seen;
        if (in.in > params.threshold + half)
            seen = Seen::high;
        else if (in.in <= params.threshold - half || before == Seen::nothing)
            seen = Seen::low;

        const bool rose = before == Seen::low && seen == Seen::high;
        return { .hit = rose ? finiteOrZero (params.speed) : 0.0, .gate = seen == Seen::high ? 1.0 : 0.0 };
    }

    Claims claims() const { return { .amplitude = std::max (1.0, std::abs (params.speed)) }; }

private:
    enum class Seen
    {
        nothing,
        low,
        high
    };

    Seen seen = Seen::nothing;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::SignalTrigger);
