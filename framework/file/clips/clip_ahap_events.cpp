// SPDX-License-Identifier: MIT
#include "clip_ahap_events.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::readers
{

namespace
{
constexpr double close_enough = 2e-3;   // the pieces with which a reader draws squares are as good as this

std::vector<ClipPoint> rootsOf (std::vector<ClipPoint> points)
{
    for (auto& p : points)
        p.value = std::sqrt (p.value);
    return points;
}

/// A curve that grows with each event, and what is known about it so far.
struct SharedCurve
{
    std::vector<ClipPoint> points {};
    double until = -1.0;   // known to here
    bool adds = false;     // the event's number is added to it, and not multiplied

    double apply (double own, double curve) const { return adds ? own + curve : own * curve; }
    double remove (double own, double value) const { return adds ? value - own : own > 0.0 ? value / own
                                                                                           : 1.0; }

    /// The number of an event whose line is `line`. Empty if the curve does not fit.
    std::optional<double> join (const std::vector<ClipPoint>& line)
    {
        const double from = line.front().time, to = line.back().time;
        double own = adds ? line.front().value : std::ranges::max (line, {}, &ClipPoint::value).value;
        if (from < until)
        {
            own = ownIn (line, from, std::min (to, until));
            if (! (own >= 0.0 && own <= 1.0 + close_enough)) return {};
            own = std::min (own, 1.0);
            if (! fits (line, own, from, std::min (to, until))) return {};
        }
        for (const auto& p : line)
            if (p.time >= until) points.push_back ({ p.time, remove (own, p.value) });
        until = std::max (until, to);
        return own;
    }

    /// The number with which the line follows the curve where the curve is strongest.
    double ownIn (const std::vector<ClipPoint>& line, double from, double to) const
    {
        double best = from, strongest = -1.0;
        for (const double t : timesIn (line, from, to))
            if (const double c = adds ? 1.0 : heldAt (points, t, false, 1.0); c > strongest && t < to)
            {
                strongest = c;
                best = t;
            }
        const double c = heldAt (points, best, false, 1.0), v = heldAt (line, best, false, 1.0);
        return adds ? v - c : c > 0.0 ? v / c
                                      : 0.0;
    }

    std::vector<double> timesIn (const std::vector<ClipPoint>& line, double from, double to) const
    {
        std::vector<double> times { from, 0.5 * (from + to), to };
        for (const auto* list : { &line, &points })
            for (auto p = std::ranges::lower_bound (*list, from, {}, &ClipPoint::time); p != list->end() && p->time <= to; ++p)
                times.push_back (p->time);
        return times;
    }

    bool fits (const std::vector<ClipPoint>& line, double own, double from, double to) const
    {
        for (const double t : timesIn (line, from, to))
            for (const bool before : { false, true })
            {
                if (before ? t <= from : t >= to) continue;
                const double made = std::clamp (apply (own, heldAt (points, t, before, 1.0)), 0.0, 1.0);
                if (! (std::abs (made - heldAt (line, t, before, 1.0)) <= close_enough)) return false;
            }
        return true;
    }
};
}   // namespace

std::optional<AhapEvents> ahapEvents (const std::vector<ClipTrack>& tracks)
{
    std::vector<ClipTone> tones;
    for (const auto& t : tracks)
    {
        if (t.is_wave) return {};
        const auto more = tonesOf (t);
        tones.insert (tones.end(), more.begin(), more.end());
    }
    std::ranges::stable_sort (tones, {}, &ClipTone::from);
    AhapEvents made;
    SharedCurve gain, shift { .adds = true };
    for (const auto& tone : tones)
    {
        const auto intensity = gain.join (rootsOf (tone.amplitude)), sharpness = shift.join (rootsOf (tone.sharpness));
        if (! intensity || ! sharpness) return {};
        made.events.push_back ({ tone.from, tone.to, *intensity, *sharpness });
    }
    const auto isOutside = [] (double least) { return [least] (const ClipPoint& p) { return ! (p.value >= least && p.value <= 1.0 + close_enough); }; };
    if (std::ranges::any_of (gain.points, isOutside (0.0)) || std::ranges::any_of (shift.points, isOutside (-1.0))) return {};
    for (auto& p : gain.points)
        p.value = std::min (p.value, 1.0);
    constexpr double none = 1e-9;
    if (std::ranges::any_of (gain.points, [] (const ClipPoint& p) { return std::abs (p.value - 1.0) > none; })) made.gain = std::move (gain.points);
    if (std::ranges::any_of (shift.points, [] (const ClipPoint& p) { return std::abs (p.value) > none; })) made.shift = std::move (shift.points);
    return made;
}

}   // namespace tactus::readers
