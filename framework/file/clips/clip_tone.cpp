// SPDX-License-Identifier: MIT
#include "clip_tone.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::readers
{

double heldAt (const std::vector<ClipPoint>& points, double t, bool before, double otherwise)
{
    if (points.empty()) return otherwise;
    const auto next = before ? std::ranges::lower_bound (points, t, {}, &ClipPoint::time) : std::ranges::upper_bound (points, t, {}, &ClipPoint::time);
    if (next == points.begin()) return points.front().value;
    if (next == points.end()) return points.back().value;
    const auto& a = *(next - 1);
    if (t == next->time) return next->value;   // to the bit
    return next->time > a.time ? a.value + (next->value - a.value) * (t - a.time) / (next->time - a.time) : next->value;
}

std::vector<ClipTone> tonesOf (const ClipTrack& track)
{
    std::vector<ClipTone> tones;
    bool is_open = false;
    auto cut = track.phases.begin();
    const auto add = [&] (ClipPoint p) {
        if (! is_open) tones.emplace_back();
        is_open = true;
        auto& points = tones.back().amplitude;
        if (points.empty() || points.back() != p) points.push_back (p);
    };
    for (std::size_t i = 1; i < track.amplitude.size(); ++i)
    {
        const auto &p = track.amplitude[i - 1], &q = track.amplitude[i];
        if (! (q.time > p.time))
        {
            if (is_open) add (q);
            continue;
        }
        if (p.value == 0.0 && q.value == 0.0)
        {
            is_open = false;
            continue;
        }
        add (p);
        while (cut != track.phases.end() && cut->time <= p.time)
            ++cut;
        for (; cut != track.phases.end() && cut->time <= q.time; ++cut)
        {
            const ClipPoint here { cut->time, p.value + (q.value - p.value) * (cut->time - p.time) / (q.time - p.time) };
            add (here);
            is_open = false;
            if (cut->time < q.time) add (here);
        }
        if (is_open) add (q);
    }
    for (auto& t : tones)
    {
        t.from = t.amplitude.front().time;
        t.to = t.amplitude.back().time;
        t.sharpness.push_back ({ t.from, heldAt (track.sharpness, t.from, false, 0.5) });
        for (auto p = std::ranges::upper_bound (track.sharpness, t.from, {}, &ClipPoint::time); p != track.sharpness.end() && p->time < t.to; ++p)
            t.sharpness.push_back (*p);
        t.sharpness.push_back ({ t.to, heldAt (track.sharpness, t.to, true, 0.5) });
    }
    return tones;
}

double cyclesAt (const std::vector<ClipScore::Sweep>& sweeps, double time)
{
    const auto& s = *(std::ranges::upper_bound (sweeps, time, {}, &ClipScore::Sweep::at) - 1);
    const double since = time - s.at, cycles = s.cycles + since * (s.hertz + 0.5 * s.slope * since);
    return cycles - std::floor (cycles);
}

}   // namespace tactus::readers
