// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/math/math.hpp>
#include <tactus/kit/signal/past_window.hpp>
#include <tactus/node/node.hpp>

#include <cmath>
#include <numbers>

namespace tactus::nodes
{

/// Fades a texture out before the hand moves too fast for it. Multiply a grating by `gain`.
///
///     v = (s_n - s_(n-m)) / (m T),   s = x cos (angle) + y sin (angle)  speed along the grating
///     f = k |v|                                                        the frequency it sounds at, Hz
///     gain = 1 up to f_max / 2, then half a cosine down to 0 at f_max
///
/// A grating scanned above half the sampling rate would alias to a slower one, and above the first resonance of the device it
/// would buzz. So f_max should be the lower of that resonance F_0 and 1 / (alpha T) with alpha >= 2, preferably 10 (Table 1).
///
/// m T is `window`, rounded to ticks. With `window` 0, m is 1.
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 5, Table 1; Campion & Hayward 2005.
///
/// Good to know
///  - A position quantum q makes the speed flutter by q / (m T), and the gain by up to pi q k / (m T f_max). With one tick, this grows
///    with the tick rate: for 20 um, 1600 1/m and 400 Hz, at 20 kHz, the gain jumps between 0 and 1. With a `window` of 5 ms, it flutters
///    by less than 0.06 at every rate, and follows a change of speed 2.5 ms late.
///  - The speed is 0 on the first sample and after a fault. Until a window has passed, the speed is the mean since the first sample.
///  - gain times force is no longer the gradient of a potential: during the fade it depends on speed.
///  - A change of angle adds no speed: both samples are measured along the new angle.
struct AntiAlias
{
    struct Inputs
    {
        Position position = Position::Zero();
    };

    struct Params
    {
        double spatial_frequency = 200.0;
        double angle = 0.0;
        double f_max = 100.0;
    };

    struct Settings
    {
        double window = 0.0;
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
        .keywords = "nyquist",
    };

    static constexpr std::tuple ports {
        input (&Inputs::position, "position", unit::metre, "tool position"),
        param (&Params::spatial_frequency, "spatial_frequency", unit::per_metre, "highest spatial frequency k of the texture",
               { .hard = { 0, inf }, .usual = { 10, 5000 } }),
        param (&Params::angle, "angle", unit::radian, "angle of the wave in the xy plane, from x towards y",
               { .usual = { -std::numbers::pi, std::numbers::pi } }),
        param (&Params::f_max, "f_max", unit::hertz, "the gain is 0 from this frequency up; the fade begins at half of it",
               { .hard = { 0, inf }, .usual = { 0, 1000 } }),
        setting (&Settings::window, "window", unit::second, "time over which the speed is measured; 0: one tick", { .hard = { 0, 0.1 }, .usual = { 0, 0.02 } }),
        output (&Outputs::gain, "gain", unit::gain, "factor on the texture"),
        output (&Outputs::speed, "speed", unit::speed, "signed speed along the grating"),
    };

    Params params;
    Settings settings;

    void prepare (const Setup& setup) { past.prepare (settings.window, setup.dt_s()); }

    void update() noexcept { along = { math::cos (params.angle), math::sin (params.angle), 0.0 }; }

    void adopt (const AntiAlias& old) noexcept { past.adopt (old.past); }

    Outputs tick (const Inputs& in) noexcept
    {
        const auto moved = past.to (in.position);
        const double speed = moved.time > 0.0 ? along.dot (Vec3 (moved.by)) / moved.time : 0.0;
        if (! isFinite (in.position, speed))
        {
            past.clear();
            return {};
        }
        past.remember (in.position);
        return { .gain = fade (params.spatial_frequency * std::abs (speed)), .speed = speed };
    }

    void serialize (auto& archive) { archive (past); }

private:
    double fade (double f) const noexcept
    {
        const double half = 0.5 * params.f_max;
        if (f <= half) return 1.0;
        if (! (f < params.f_max)) return 0.0;
        return 0.5 * (1.0 + math::cos (std::numbers::pi * ((f - half) / half)));
    }

    Vec3 along = Vec3::UnitX();
    PastWindow<Position> past { Setup {}.dt_s() };   // positions, in m
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::AntiAlias);
