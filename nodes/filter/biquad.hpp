// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/math/math.hpp>
#include <tactus/kit/signal/biquad.hpp>
#include <tactus/node/generic.hpp>

#include <cmath>
#include <numbers>

namespace tactus::nodes
{

/// A general-purpose filter: seven responses from one second-order recursion.
///
///     low, high    -3 dB at the cutoff with q = 0.7071 (Butterworth); a higher q rings there
///     band         gain 1 at the cutoff, q = cutoff over bandwidth
///     notch        nothing at the cutoff, everything else passes
///     peak         gain_db at the cutoff, 0 dB far from it
///     low_shelf    gain_db below the cutoff, 0 dB above; high_shelf the other way round
///
/// Bilinear transform, prewarped. The cutoff is limited to 1e-6 … 0.4999 of the tick rate. The filter starts from rest, even after
/// a non-finite input. Parameters may move while it runs, slowly compared with the cutoff; a new kind takes effect immediately,
/// with a click if there is a signal. High and band give 0 at rest: in a force path they drop the force on a hand that holds
/// still.
///
/// Source: R. Bristow-Johnson, "Cookbook formulae for audio EQ biquad filter coefficients", with alpha from q.
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
        const double w = 2.0 * std::numbers::pi * usableCutoff (params.cutoff, rate) / rate;
        const double c = math::cos (w);
        const double rest = 2.0 * math::sin (0.5 * w) * math::sin (0.5 * w);   // 1 - cos w, without cancellation
        const double alpha = math::sin (w) / (2.0 * params.q);
        const double a = math::pow (10.0, params.gain_db / 40.0);
        const double s = 2.0 * std::sqrt (a) * alpha;

        switch (params.kind)
        {
        case Kind::low:
            return set (0.5 * rest, rest, 0.5 * rest, 1.0 + alpha, -2.0 * c, 1.0 - alpha);
        case Kind::high:
            return set (0.5 * (1.0 + c), -(1.0 + c), 0.5 * (1.0 + c), 1.0 + alpha, -2.0 * c, 1.0 - alpha);
        case Kind::band:
            return set (alpha, 0.0, -alpha, 1.0 + alpha, -2.0 * c, 1.0 - alpha);
        case Kind::notch:
            return set (1.0, -2.0 * c, 1.0, 1.0 + alpha, -2.0 * c, 1.0 - alpha);
        case Kind::peak:
            return set (1.0 + alpha * a, -2.0 * c, 1.0 - alpha * a, 1.0 + alpha / a, -2.0 * c, 1.0 - alpha / a);
        case Kind::low_shelf:
            return set (a * (a + 1.0 - (a - 1.0) * c + s), 2.0 * a * (a - 1.0 - (a + 1.0) * c), a * (a + 1.0 - (a - 1.0) * c - s),
                        a + 1.0 + (a - 1.0) * c + s, -2.0 * (a - 1.0 + (a + 1.0) * c), a + 1.0 + (a - 1.0) * c - s);
        case Kind::high_shelf:
            return set (a * (a + 1.0 + (a - 1.0) * c + s), -2.0 * a * (a - 1.0 + (a + 1.0) * c), a * (a + 1.0 + (a - 1.0) * c - s),
                        a + 1.0 - (a - 1.0) * c + s, 2.0 * (a - 1.0 - (a + 1.0) * c), a + 1.0 - (a - 1.0) * c - s);
        }
    }

    Outputs tick (const Inputs& in) noexcept { return { .out = state (filter, in.in) }; }

private:
    void set (double b0, double b1, double b2, double a0, double a1, double a2) noexcept
    {
        filter = { b0 / a0, b1 / a0, b2 / a0, a1 / a0, a2 / a0 };
    }

    double rate = 4000.0;   // Hz
    Biquad filter;
    BiquadState state;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::BiquadFilter);
