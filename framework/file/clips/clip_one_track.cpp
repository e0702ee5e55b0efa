// SPDX-License-Identifier: MIT
#include "clip_formats.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace tactus::readers
{

namespace
{
constexpr double window_s = 0.01;   // of a wave's envelope; one cycle of the lowest tones that a hand tells apart from pushes

/// The frequency of a wave, in cycles per second, from how often it crosses 0 within 0.11 s around each window.
std::vector<double> frequencies (const std::vector<int>& crossings)
{
    constexpr std::size_t around = 5;
    std::vector<double> hertz;
    for (std::size_t i = 0; i < crossings.size(); ++i)
    {
        const std::size_t from = i > around ? i - around : 0, to = std::min (i + around + 1, crossings.size());
        int sum = 0;
        for (std::size_t k = from; k < to; ++k)
            sum += crossings[k];
        hertz.push_back (0.5 * sum / (window_s * static_cast<double> (to - from)));
    }
    return hertz;
}

/// A wave as its envelope: the largest value of each window, and the frequency at which it crosses 0.
ClipTrack envelopeOf (const ClipTrack& wave, const ClipVoice& voice)
{
    ClipTrack made { .channel = wave.channel };
    const auto& points = wave.amplitude;
    if (points.empty()) return made;
    const double start = points.front().time, end = points.back().time;
    std::vector<int> crossings;
    std::size_t i = 0;
    for (double t = start; t < end; t += window_s)
    {
        const double until = std::min (t + window_s, end);
        double loudest = 0.0;
        int count = 0;
        for (; i < points.size() && points[i].time < until; ++i)
        {
            loudest = std::max (loudest, std::abs (points[i].value));
            if (i > 0 && (points[i].value > 0.0) != (points[i - 1].value > 0.0)) ++count;
        }
        made.amplitude.push_back ({ 0.5 * (t + until), loudest });
        crossings.push_back (count);
    }
    const auto hertz = frequencies (crossings);
    const double width = voice.highest - voice.lowest;
    for (std::size_t k = 0; k < hertz.size(); ++k)
        if (hertz[k] > 0.0)
            made.sharpness.push_back ({ made.amplitude[k].time, std::clamp (width != 0.0 ? (hertz[k] - voice.lowest) / width : 0.5, 0.0, 1.0) });
    if (! made.amplitude.empty())
    {
        made.amplitude.insert (made.amplitude.begin(), { start, made.amplitude.front().value });
        made.amplitude.push_back ({ end, made.amplitude.back().value });
    }
    return made;
}

/// Reads an envelope at times that never decrease.
struct EnvelopeReader
{
    const std::vector<ClipPoint>& points;
    std::size_t next = 0;

    /// The value just before t, or at t.
    double at (double t, bool before)
    {
        while (next < points.size() && (before ? points[next].time < t : points[next].time <= t))
            ++next;
        if (next == 0 || next == points.size()) return 0.0;
        const auto &a = points[next - 1], &b = points[next];
        return b.time > a.time ? a.value + (b.value - a.value) * (t - a.time) / (b.time - a.time) : b.value;
    }
};

/// The same for a sharpness, which is held beyond its ends.
double sharpnessAt (const std::vector<ClipPoint>& points, std::size_t& next, double t)
{
    if (points.empty()) return 0.5;
    while (next < points.size() && points[next].time <= t)
        ++next;
    if (next == 0) return points.front().value;
    if (next == points.size()) return points.back().value;
    const auto &a = points[next - 1], &b = points[next];
    return a.value + (b.value - a.value) * (t - a.time) / (b.time - a.time);
}

/// All times of all points, in order.
std::vector<double> timesOf (const std::vector<ClipTrack>& tracks)
{
    std::vector<double> times;
    for (const auto& t : tracks)
        for (const auto* points : { &t.amplitude, &t.sharpness })
            for (const auto& p : *points)
                times.push_back (p.time);
    std::ranges::sort (times);
    times.erase (std::unique (times.begin(), times.end()), times.end());
    return times;
}

void addEnvelopes (const std::vector<ClipTrack>& tracks, ClipTrack& sum, bool& clipped)
{
    const auto times = timesOf (tracks);
    struct Readers
    {
        EnvelopeReader before, after;
        const std::vector<ClipPoint>& sharpness;
        std::size_t next = 0;
    };
    std::vector<Readers> readers;
    for (const auto& t : tracks)
        readers.push_back ({ { t.amplitude }, { t.amplitude }, t.sharpness });
    const auto put = [&] (double time, double v) {
        if (v > 1.0) clipped = true;
        sum.amplitude.push_back ({ time, std::clamp (v, 0.0, 1.0) });
    };
    for (const double t : times)
    {
        double before = 0.0, after = 0.0, strongest = -1.0, sharpness = 0.5;
        for (auto& r : readers)
        {
            const double b = r.before.at (t, true), a = r.after.at (t, false);
            before += b;
            after += a;
            const double s = sharpnessAt (r.sharpness, r.next, t);
            if (std::max (a, b) > strongest)
            {
                strongest = std::max (a, b);
                sharpness = s;
            }
        }
        if (before != after && (before > 0.0 || ! sum.amplitude.empty())) put (t, before);
        put (t, after);
        sum.sharpness.push_back ({ t, sharpness });
    }
}
}   // namespace

Clip withoutWaves (Clip clip)
{
    for (auto& t : clip.tracks)
        if (t.is_wave)
        {
            auto taps = std::move (t.taps);
            t = envelopeOf (t, clip.voice);
            t.taps = std::move (taps);
        }
    return clip;
}

ClipTrack oneTrack (const Clip& clip, Messages& losses)
{
    std::vector<ClipTrack> tracks;
    std::set<int> channels;
    for (const auto& t : clip.tracks)
    {
        channels.insert (t.channel);
        if (t.is_wave) lose (losses, "track " + std::to_string (tracks.size() + 1), "the wave becomes its envelope, in steps of 10 ms", "write a .wav instead");
        tracks.push_back (t.is_wave ? envelopeOf (t, clip.voice) : t);
    }
    std::size_t phases = 0;
    for (const auto& t : tracks)
        phases += t.phases.size();
    if (phases > 0)
        lose (losses, "tracks", "the phases of " + std::to_string (phases) + " tones are left out: the format has one tone, which runs on through silence",
              "write a .json or .hjif");
    if (channels.size() > 1)
        lose (losses, "channels", "the " + std::to_string (channels.size()) + " channels are added up: the format has one",
              "write a .json or .hjif, or each channel alone");
    if (tracks.empty()) return {};
    if (tracks.size() == 1) return tracks.front();

    ClipTrack sum;
    bool clipped = false;
    addEnvelopes (tracks, sum, clipped);
    for (const auto& t : tracks)
        sum.taps.insert (sum.taps.end(), t.taps.begin(), t.taps.end());
    std::ranges::stable_sort (sum.taps, {}, &ClipTap::time);
    lose (losses, "tracks", "the " + std::to_string (tracks.size()) + " tracks become one: their envelopes add up, and the sharpness is that of the strongest",
          "write a .json, or each track alone");
    if (clipped) lose (losses, "tracks", "together they exceed 1 and are limited to it", "lower their amplitudes");
    return sum;
}

}   // namespace tactus::readers
