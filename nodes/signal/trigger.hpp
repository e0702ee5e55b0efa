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
///     gate   1 from that tick until `in` has been at threshold - hysteresis / 2 or below for longer than `hold`, which arms the next hit
///
/// `hold` is for signals that come in pulses. The state of a friction or blade node is that of a single tick, so between two steps of
/// the encoder it says that nothing moves. With a hold, the gate says whether something has moved within the last `hold` seconds,
/// and this does not depend on the tick rate.
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
        double hold = 0.0;
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
        .keywords = "comparator threshold gate",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "signal"),
        param (&Params::threshold, "threshold", sameAs ("in"), "middle of the two levels", { .usual = { -1, 1 } }),
        param (&Params::hysteresis, "hysteresis", sameAs ("in"), "distance between the two levels", { .hard = { 0, inf }, .usual = { 0, 1 } }),
        param (&Params::speed, "speed", unit::speed, "impact speed of each hit", { .hard = { 0, inf }, .usual = { 0, 5 } }),
        param (&Params::hold, "hold", unit::second, "time for which the gate stays open after the signal has become low",
               { .hard = { 0, inf }, .usual = { 0, 0.1 } }),
        output (&Outputs::hit, "hit", unit::hit, "speed on the tick of the hit, else 0"),
        output (&Outputs::gate, "gate", unit::gain, "1 while the signal is high and during hold, else 0"),
    };

    Params params;

    void prepare (const Setup& setup) noexcept { dt = setup.dt_s(); }

    Outputs tick (const Inputs& in) noexcept
    {
        if (! isFinite (in.in))
        {
            seen = Seen::nothing;
            return {};
        }

        const double half = 0.5 * params.hysteresis;
        const bool is_low = in.in <= params.threshold - half;
        low_ticks = is_low ? low_ticks + 1.0 : 0.0;

        const Seen before = seen;
        const bool holds = low_ticks * dt <= params.hold * (1.0 + margin (1e-9));
        if (in.in > params.threshold + half)
            seen = Seen::high;
        else if (before == Seen::nothing || (is_low && ! holds))
            seen = Seen::low;

        const bool rose = before == Seen::low && seen == Seen::high;
        return { .hit = rose ? finiteOrZero (params.speed) : 0.0, .gate = seen == Seen::high ? 1.0 : 0.0 };
    }

    Claims claims() const { return { .amplitude = std::max (1.0, std::abs (params.speed)) }; }

    void serialize (auto& archive) { archive (seen, low_ticks); }

private:
    enum class Seen
    {
        nothing,
        low,
        high
    };

    Seen seen = Seen::nothing;
    double low_ticks = 0.0;               // ticks for which the signal has been low
    double dt = 1.0 / Setup {}.rate_hz;   // s
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::SignalTrigger);
