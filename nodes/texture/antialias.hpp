// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/node.hpp>

#include <cmath>
#include <numbers>

namespace tactus::nodes
{

/// Fades a texture out before the hand moves too fast for it. Multiply a grating by `gain`.
///
///     v = (s_n - s_(n-1)) / T,   s = x cos (angle) + y sin (angle)      speed along the grating
///     f = k |v|                                                        the frequency it sounds at, Hz
///     gain = 1 up to f_max / 2, then half a cosine down to 0 at f_max
///
/// A grating scanned above half the sampling rate would alias to a slower one, and above the first resonance of the device it
/// would buzz. So f_max should be the lower of that resonance F_0 and 1 / (alpha T) with alpha >= 2, better 10 (Table 1).
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 5, Table 1; Campion & Hayward 2005.
///
/// Good to know
///  - The speed is the difference between two samples, and 0 on the first sample and after a fault. A position quantum q
///    shows up as a speed of q / T. Where q k / T is near f_max the gain flutters: use a finer encoder or a smoothed position.
///  - gain times force is no longer the gradient of a potential: during the fade it depends on speed.
///  - A change of angle adds no speed: both samples are measured along the new angle.
struct AntiAlias
{
    struct Inputs
    {
        Vec3 position = Vec3::Zero();
    };

    struct Params
    {
        double spatial_frequency = 200.0;
        double angle = 0.0;
        double f_max = 100.0;
    };

    struct Outputs
    {
        double gain = 0.0;
        double speed = 0.0;
    };

    static constexpr Info info {
        .id = "texture.antialias",
        .name = "Anti-alias guard",
        .summary = "Fades a texture out where the hand moves too fast for it.",
        .source = "Hayward 2007, section 5, Table 1",
    };

    static constexpr std::tuple ports {
        input (&Inputs::position, "position", unit::metre, "tool position"),
        param (&Params::spatial_frequency, "spatial_frequency", unit::per_metre, "highest spatial frequency k of the texture",
               { .hard = { 0, inf }, .usual = { 10, 5000 } }),
        param (&Params::angle, "angle", unit::radian, "angle of the wave in the xy plane, from x towards y",
               { .usual = { -std::numbers::pi, std::numbers::pi } }),
        param (&Params::f_max, "f_max", unit::hertz, "the gain is 0 from this frequency up; the fade begins at half of it",
               { .hard = { 0, inf }, .usual = { 0, 1000 } }),
        output (&Outputs::gain, "gain", unit::gain, "factor on the texture"),
        output (&Outputs::speed, "speed", unit::speed, "signed speed along the grating"),
    };

    Params params;

    void prepare (const Setup& setup) noexcept
    {
        dt = setup.dt_s();
        last = {};
    }

    void update() noexcept { along = { std::cos (params.angle), std::sin (params.angle), 0.0 }; }

    void adopt (const AntiAlias& old) noexcept { last = old.last; }

    Outputs tick (const Inputs& in) noexcept
    {
        const double speed = last.known ? along.dot (in.position - last.p) / dt : 0.0;
        if (! isFinite (in.position, speed))
        {
            last = {};
            return {};
        }
        last = { .p = in.position, .known = true };
        return { .gain = fade (params.spatial_frequency * std::abs (speed)), .speed = speed };
    }

private:
    double fade (double f) const noexcept
    {
        const double half = 0.5 * params.f_max;
        if (f <= half) return 1.0;
        if (! (f < params.f_max)) return 0.0;
        return 0.5 * (1.0 + std::cos (std::numbers::pi * ((f - half) / half)));
    }

    struct Sample
    {
        Vec3 p = Vec3::Zero();
        bool known = false;   // false until the first finite sample
    };

    Vec3 along = Vec3::UnitX();
    double dt = 1.0 / Setup {}.rate_hz;   // s
    Sample last;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::AntiAlias);
