// SPDX-License-Identifier: MIT
#include "gestures.hpp"

#include <tactus/kit/math/math.hpp>

#include <cstddef>
#include <numbers>

namespace tactus
{
namespace
{
constexpr double mm = 1e-3, um = 1e-6;
constexpr double turn = 2.0 * std::numbers::pi;

/// A position and time at which the hand is at rest.
struct Rest
{
    double t, value;
};

/// Moves from rest to rest with minimum jerk: 10 u^3 - 15 u^4 + 6 u^5 between two points. Before the first point and after the
/// last one, the value is constant.
template <std::size_t n>
double through (const Rest (&rests)[n], double t) noexcept
{
    if (! (t > rests[0].t)) return rests[0].value;

    for (std::size_t i = 1; i < n; ++i)
    {
        const auto& [t0, from] = rests[i - 1];
        const auto& [t1, to] = rests[i];
        if (t >= t1) continue;

        const double u = (t - t0) / (t1 - t0);
        return from + (to - from) * u * u * u * (10.0 + u * (6.0 * u - 15.0));
    }
    return rests[n - 1].value;
}

Vec3 stroke (double t)
{
    static constexpr Rest x[] { { 0.5, -30 * mm },
                                { 1.1, 30 * mm },
                                { 1.2, 30 * mm },
                                { 1.8, -30 * mm },
                                { 1.9, -30 * mm },
                                { 2.5, 30 * mm },
                                { 2.6, 30 * mm },
                                { 3.2, -30 * mm } };
    static constexpr Rest z[] { { 0.0, 10 * mm }, { 0.5, -2 * mm }, { 3.2, -2 * mm }, { 3.8, 10 * mm } };
    return { through (x, t), 0.0, through (z, t) };
}

Vec3 press (double t)
{
    static constexpr Rest z[] { { 0.0, 5 * mm }, { 1.0, -4 * mm }, { 2.0, -4 * mm }, { 3.0, 5 * mm } };
    return { 0.0, 0.0, through (z, t) };
}

Vec3 touch (double t)
{
    static constexpr Rest x[] { { 0.0, -10 * mm }, { 0.7, 0.0 }, { 1.2, 0.0 }, { 1.8, -10 * mm } };
    static constexpr Rest z[] { { 0.0, 10 * mm }, { 0.8, -1 * mm }, { 1.1, -1 * mm }, { 1.8, 10 * mm } };
    return { through (x, t), 0.0, through (z, t) };
}

Vec3 tap (double t)
{
    // The surface is four fifths of the way down, where the hand still has three quarters of its top speed.
    static constexpr Rest z[] { { 0.2, 8 * mm },
                                { 0.5, -2 * mm },
                                { 0.65, 8 * mm },
                                { 0.85, -2 * mm },
                                { 1.0, 8 * mm },
                                { 1.13, -2 * mm },
                                { 1.25, 8 * mm },
                                { 1.34, -2 * mm },
                                { 1.44, 8 * mm },
                                { 1.5, -2 * mm },
                                { 1.6, 8 * mm } };
    return { 0.0, 0.0, through (z, t) };
}

Vec3 circle (double t)
{
    static constexpr Rest angle[] { { 0.5, 0.0 }, { 4.0, 3.0 * turn } };
    static constexpr Rest z[] { { 0.0, 10 * mm }, { 0.5, -2 * mm }, { 4.0, -2 * mm }, { 4.6, 10 * mm } };
    const double a = through (angle, t);
    return { 15 * mm * math::cos (a), 15 * mm * math::sin (a), through (z, t) };
}

Vec3 sweep (double t)
{
    // Strokes of 30 mm with peaks of 10, 25, 60, 120, 240 and 400 mm/s: a stroke lasts 15/8 of its length divided by its peak
    // speed.
    static constexpr double pause = 0.1, start = 0.5;
    static constexpr auto lasts = [] (double peak) { return 15.0 / 8.0 * 30 * mm / peak; };
    static constexpr double t1 = start + lasts (0.010), t2 = t1 + pause + lasts (0.025), t3 = t2 + pause + lasts (0.060),
                            t4 = t3 + pause + lasts (0.120), t5 = t4 + pause + lasts (0.240), t6 = t5 + pause + lasts (0.400);
    static_assert (t6 + 0.4 < 11.2);

    static constexpr double left = -15 * mm, right = 15 * mm;
    static constexpr Rest x[] { { start, left },
                                { t1, right },
                                { t1 + pause, right },
                                { t2, left },
                                { t2 + pause, left },
                                { t3, right },
                                { t3 + pause, right },
                                { t4, left },
                                { t4 + pause, left },
                                { t5, right },
                                { t5 + pause, right },
                                { t6, left } };
    static constexpr Rest z[] { { 0.0, 10 * mm }, { start, -2 * mm }, { t6, -2 * mm }, { t6 + 0.4, 10 * mm } };
    return { through (x, t), 0.0, through (z, t) };
}

Vec3 hold (double t)
{
    static constexpr Rest z[] { { 0.0, 5 * mm }, { 0.6, -1 * mm }, { 5.4, -1 * mm }, { 6.0, 5 * mm } };
    static constexpr Rest amount[] { { 0.0, 0.0 }, { 1.0, 1.0 }, { 5.0, 1.0 }, { 6.0, 0.0 } };

    // Physiological tremor: 8 to 12 Hz, tens of micrometres, not the same in each direction, never quite periodic.
    const auto wave = [t] (double frequency, double phase) { return math::sin (turn * (frequency * t + phase)); };
    const Vec3 tremor { 30 * um * wave (8.7, 0.0) + 15 * um * wave (11.3, 0.3),
                        20 * um * wave (9.4, 0.6) + 15 * um * wave (10.9, 0.1),
                        15 * um * wave (8.3, 0.8) + 10 * um * wave (11.8, 0.5) };
    return through (amount, t) * tremor + Vec3 { 0.0, 0.0, through (z, t) };
}

Vec3 cut (double t)
{
    static constexpr Rest z[] { { 0.0, 10 * mm }, { 2.5, -25 * mm }, { 2.8, -25 * mm }, { 4.0, 10 * mm } };
    return { 0.0, 0.0, through (z, t) };
}

constexpr Gesture list[] {
    { "stroke", "Back and forth over 60 mm, twice, pressed 2 mm into the surface.", 4.0, stroke },
    { "press", "Slowly 4 mm into the surface, held there, and slowly out.", 3.2, press },
    { "touch", "A hand comes down, stays 1 mm deep for a moment, and leaves.", 2.0, touch },
    { "tap", "Five taps, each quicker than the one before.", 1.8, tap },
    { "circle", "Three circles, 30 mm across, pressed 2 mm into the surface.", 4.8, circle },
    { "sweep", "Strokes of 30 mm, with peak speeds that rise from 10 mm/s to 0.4 m/s.", 11.2, sweep },
    { "hold", "Resting 1 mm deep with the tremor of a hand, 8 to 12 Hz.", 6.2, hold },
    { "cut", "Steadily 25 mm down, and out again.", 4.2, cut },
};
}   // namespace

std::span<const Gesture> gestures() noexcept { return list; }

const Gesture* findGesture (std::string_view id) noexcept
{
    for (const auto& gesture : list)
        if (gesture.id == id) return &gesture;
    return nullptr;
}

}   // namespace tactus
