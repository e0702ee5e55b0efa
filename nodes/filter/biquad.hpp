// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/math/math.hpp>
#include <tactus/kit/signal/biquad.hpp>
#include <tactus/node/generic.hpp>

#include <cmath>

namespace tactus::nodes
{

/// A general-purpose filter: seven responses from one state variable filter.
///
///     low, high    -3 dB at the cutoff with q = 0.7071 (Butterworth); a higher q rings there
///     band         gain 1 at the cutoff, q = cutoff over bandwidth
///     notch        nothing at the cutoff, everything else passes
///     peak         gain_db at the cutoff, 0 dB far from it
///     low_shelf    gain_db below the cutoff, 0 dB above; high_shelf the other way round
///
/// Bilinear transform, prewarped. The cutoff is limited to 1e-6 … 0.4999 of the tick rate. The filter starts from rest, even after
/// a non-finite input. Parameters may move while it runs, at any speed: the filter is a trapezoidal state variable filter, which stays stable.
/// However its parameters move within ten times their usual ranges, the output stays below ten times the largest that it reaches while they stand
/// still; if gain_db moves, below that or twice its highest gain times the largest input. A new kind takes effect immediately, with a click if
/// there is a signal. High and band give 0 at rest: in a force path they drop the force on a hand that holds still.
///
/// Source: R. Bristow-Johnson, "Cookbook formulae for audio EQ biquad filter coefficients", with alpha from q (the responses); V. Zavalishin,
/// The Art of VA Filter Design, 2012 (the filter).
struct BiquadFilter
{
    enum class Kind
    {
        low,
        high,
        band,
        notch,
        peak,
        low_shelf,
        high_shelf
    };

    static constexpr std::string_view kind_names[] { "low", "high", "band", "notch", "peak", "low_shelf", "high_shelf" };

    using Inputs = In<double>;

    struct Params
    {
        double cutoff = 100.0;
        double q = 0.7071;
        double gain_db = 0.0;
        Kind kind = Kind::low;
    };

    using Outputs = Out<double>;

    static constexpr Info info {
        .id = "filter.biquad",
        .name = "Biquad",
        .summary = "Low-pass, high-pass, band-pass, notch, peak or shelf.",
        .source = "R. Bristow-Johnson, Audio EQ Cookbook",
        .keywords = "eq equalizer vcf",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "signal"),
        param (&Params::cutoff, "cutoff", unit::hertz, "corner or centre frequency", { .hard = { 0, inf }, .usual = { 1, 1000 } }),
        param (&Params::q, "q", unit::count, "sharpness", { .hard = { 1e-3, 1e3 }, .usual = { 0.1, 20 } }),
        param (&Params::gain_db, "gain_db", unit::decibel, "height of the peak or shelf", { .hard = { -120, 120 }, .usual = { -24, 24 } }),
        choice (&Params::kind, "kind", kind_names, "response"),
        output (&Outputs::out, "out", sameAs ("in"), "the filtered signal"),
    };

    Params params;

    void prepare (const Setup& setup) noexcept { rate = setup.rate_hz; }

    void update() noexcept
    {
        const double g = prewarped (params.cutoff, rate), k = 1.0 / params.q;
        const double a = math::pow (10.0, params.gain_db / 40.0);

        switch (params.kind)
        {
        case Kind::low:
            return set (g, k, 0.0, 0.0, 1.0);
        case Kind::high:
            return set (g, k, 1.0, -k, -1.0);
        case Kind::band:
            return set (g, k, 0.0, k, 0.0);
        case Kind::notch:
            return set (g, k, 1.0, -k, 0.0);
        case Kind::peak:
            return set (g, k / a, 1.0, k / a * (a * a - 1.0), 0.0);
        case Kind::low_shelf:
            return set (g / std::sqrt (a), k, 1.0, k * (a - 1.0), a * a - 1.0);
        case Kind::high_shelf:
            return set (g * std::sqrt (a), k, a * a, k * (1.0 - a) * a, 1.0 - a * a);
        }
    }

    Outputs tick (const Inputs& in) noexcept { return { .out = state (filter, in.in) }; }

    void serialize (auto& archive) { archive (state); }

private:
    void set (double g, double k, double direct, double band, double low) noexcept { filter = stateVariable (g, k, direct, band, low); }

    double rate = 4000.0;   // Hz
    StateVariable filter;
    StateVariableState state;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::BiquadFilter);
