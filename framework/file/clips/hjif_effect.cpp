// SPDX-License-Identifier: MIT
#include "hjif_effect.hpp"
#include "clip_tone.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tactus::readers
{

namespace
{
/// The signal at a phase, in cycles. Where it steps, `before` selects the value before the step.
double baseSignal (HjifEffect::Base base, double cycles, bool before)
{
    using Base = HjifEffect::Base;
    double x = cycles - std::floor (cycles);
    if (before && x == 0.0) x = 1.0;
    switch (base)
    {
    case Base::square:
        return x < 0.5 || (before && x == 0.5) ? 1.0 : -1.0;
    case Base::triangle:
        return x < 0.25 ? 4.0 * x : x < 0.75 ? 2.0 - 4.0 * x
                                             : 4.0 * x - 4.0;
    case Base::saw_up:
    case Base::saw_down:
    {
        const double up = x < 0.5 || (before && x == 0.5) ? 2.0 * x : 2.0 * x - 2.0;
        return base == Base::saw_up ? up : -up;
    }
    default:
        return std::sin (2.0 * std::numbers::pi * x);
    }
}

void add (std::vector<ClipPoint>& points, ClipPoint p)
{
    if (points.empty() || points.back() != p) points.push_back (p);
}
}   // namespace

std::vector<HjifEffect::Stretch> HjifEffect::stretches() const
{
    std::vector<double> times { 0.0, length };
    for (const auto* points : { &amplitude, &hertz })
        for (const auto& p : *points)
            times.push_back (std::clamp (p.time, 0.0, length));
    if (start < 0.0) times.push_back (std::clamp (-start, 0.0, length));
    std::ranges::sort (times);
    times.erase (std::unique (times.begin(), times.end()), times.end());

    std::vector<Stretch> all;
    double cycles = phase;
    for (std::size_t i = 0; i + 1 < times.size(); ++i)
    {
        const double from = times[i], to = times[i + 1];
        const Stretch s { .from = seconds (from),
                          .to = seconds (to),
                          .a = heldAt (amplitude, from, false, 1.0),
                          .b = heldAt (amplitude, to, true, 1.0),
                          .hertz = heldAt (hertz, from, false, 0.0),
                          .hertz_end = heldAt (hertz, to, true, 0.0),
                          .cycles = cycles - std::floor (cycles) };
        cycles += 0.5 * (s.hertz + s.hertz_end) * (to - from) / timescale;
        if (s.from >= 0.0 && s.to > s.from) all.push_back (s);
    }
    return all;
}

bool HjifEffect::isTone() const
{
    constexpr double slowest_hz = 0.1;
    const auto isSlow = [&] (const ClipPoint& p) { return p.value < slowest_hz; };
    const auto isNegative = [] (const ClipPoint& p) { return p.value < 0.0; };
    return base == Base::sine && ! hertz.empty() && std::ranges::none_of (hertz, isSlow) && std::ranges::none_of (amplitude, isNegative);
}

bool HjifEffect::isSilent() const
{
    const auto isNothing = [] (const ClipPoint& p) { return p.value == 0.0; };
    if (std::ranges::all_of (hertz, isNothing) && base != Base::square) return true;   // a phase is nothing without a frequency
    return ! amplitude.empty() && std::ranges::all_of (amplitude, isNothing);
}

std::vector<ClipPoint> HjifEffect::wave() const
{
    constexpr double points_of_cycle = 64.0, most_finer = 64.0;
    std::vector<ClipPoint> points;
    for (const auto& s : stretches())
    {
        const double length = s.to - s.from, slope = (s.hertz_end - s.hertz) / length, cycles = 0.5 * (s.hertz + s.hertz_end) * length;
        // Corners and steps are on the grid. A part of a cycle whose amplitude moves has as many points as a cycle.
        const double grid = points_of_cycle * (s.a == s.b ? 1.0 : std::clamp (std::ceil (1.0 / std::max (cycles, 1e-3)), 1.0, most_finer));
        const bool stands = s.hertz == 0.0 && s.hertz_end == 0.0;
        const auto put = [&] (double since, double at, bool before) {
            const double value = (s.a + (s.b - s.a) * since / length) * baseSignal (base, stands ? 0.0 : at, before);
            add (points, { since < length ? std::min (s.from + since, s.to) : s.to, std::clamp (value, -1.0, 1.0) });
        };
        put (0.0, s.cycles, false);
        for (double at = (std::floor (s.cycles * grid) + 1.0) / grid; at < s.cycles + cycles; at = (std::round (at * grid) + 1.0) / grid)
        {
            // The time at which the phase, a parabola, reaches `at`.
            const double more = at - s.cycles,
                         since =
                             std::clamp (2.0 * more / (s.hertz + std::sqrt (std::max (0.0, s.hertz * s.hertz + 2.0 * slope * more))), 0.0, length);
            put (since, at, true);
            put (since, at, false);
        }
        put (length, s.cycles + cycles, true);
    }
    return points;
}

namespace
{
/// The slopes of Akima's curve (H. Akima, J. ACM 17, 1970) at the points, whose times must increase.
std::vector<double> akimaSlopes (const std::vector<ClipPoint>& points)
{
    const std::size_t n = points.size();
    std::vector<double> m (n + 3);   // slopes of the intervals, with two more at each end
    for (std::size_t i = 0; i + 1 < n; ++i)
        m[i + 2] = (points[i + 1].value - points[i].value) / (points[i + 1].time - points[i].time);
    m[1] = 2.0 * m[2] - m[3];
    m[0] = 2.0 * m[1] - m[2];
    m[n + 1] = 2.0 * m[n] - m[n - 1];
    m[n + 2] = 2.0 * m[n + 1] - m[n];
    std::vector<double> slopes;
    for (std::size_t i = 0; i < n; ++i)
    {
        const double after = std::abs (m[i + 3] - m[i + 2]), before = std::abs (m[i + 1] - m[i]);
        slopes.push_back (after + before > 0.0 ? (after * m[i + 1] + before * m[i + 2]) / (after + before) : 0.5 * (m[i + 1] + m[i + 2]));
    }
    return slopes;
}
}   // namespace

std::vector<ClipPoint> curveOf (const HjifEffect& effect, HjifCurve curve)
{
    constexpr int pieces = 16;
    std::vector<ClipPoint> points = effect.amplitude, drawn;
    if (points.empty()) return {};
    const bool steps = std::ranges::adjacent_find (points, [] (const ClipPoint& a, const ClipPoint& b) { return ! (b.time > a.time); }) != points.end();
    const bool is_akima = curve == HjifCurve::akima && points.size() > 2 && ! steps;
    const auto slopes = is_akima ? akimaSlopes (points) : std::vector<double> {};
    add (drawn, { effect.seconds (0.0), points.front().value });
    add (drawn, { effect.seconds (points.front().time), points.front().value });
    for (std::size_t i = 1; i < points.size(); ++i)
    {
        const auto &a = points[i - 1], &b = points[i];
        const double h = b.time - a.time;
        const int count = curve == HjifCurve::linear || ! (h > 0.0) ? 1 : pieces;
        for (int k = 1; k <= count; ++k)
        {
            const double s = static_cast<double> (k) / count, step = s * s * (3.0 - 2.0 * s);
            double v = std::lerp (a.value, b.value, count == 1 ? s : step);
            if (is_akima) v += h * s * (1.0 - s) * (slopes[i - 1] * (1.0 - s) - slopes[i] * s);
            add (drawn, { effect.seconds (std::lerp (a.time, b.time, s)), std::clamp (v, -1.0, 1.0) });
        }
    }

    // Nothing before 0 s is played.
    if (drawn.front().time < 0.0)
    {
        const auto after = std::ranges::upper_bound (drawn, 0.0, {}, &ClipPoint::time);
        drawn.erase (drawn.begin(), after - 1);
        if (drawn.size() == 1) return {};
        const auto &a = drawn[0], &b = drawn[1];
        drawn[0] = { 0.0, a.value + (b.value - a.value) * (0.0 - a.time) / (b.time - a.time) };
    }
    return drawn;
}

}   // namespace tactus::readers
