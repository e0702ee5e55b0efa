// SPDX-License-Identifier: MIT
#pragma once

#include "clip.hpp"
#include <tactus/kit/math/math.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace tactus
{

/// The output of a clip at one moment. Amplitudes are 1 at the full amplitude of the device.
struct ClipMoment
{
    double value = 0.0;       ///< the signal
    double amplitude = 0.0;   ///< its envelope: that of the tones and transients, added up
    double frequency = 0.0;   ///< of the strongest tone or transient, Hz; 0 in silence and for a wave
};

/// A clip prepared for playing. Its signal is a function of the time in the clip, so it can be read forwards, backwards and in
/// leaps:
///
///     value (t) = sum over tracks  duck (t) A (t) sin (2 pi integral_0^t f)  +  sum over transients  a sin (2 pi f (t - t_i))
///     f = lowest + sharpness (highest - lowest)
///
/// The integral begins again where a track sets a phase, and the phase is added.
///
/// A is straight between its points, and so is f: the phase is a parabola in each stretch, and exact.
///
/// A transient is two cycles of a sine, so it begins and ends at 0 (MetaQuest.acf: 36.4 ms at 55 Hz, 12.1 ms at 165 Hz; the MPEG
/// reference software plays two cycles too). At most four transients of a track sound together. A fifth shortens the first to the
/// half cycles that fit, so it still ends at 0. While a transient sounds, `duck` falls to the clip's ducking and returns, each
/// within a quarter of the transient.
class ClipScore
{
public:
    static constexpr int together = 4;                     ///< most transients of a track that sound together
    static constexpr double whole = 0.25, silent = 0.45;   ///< cycles per sample below which a tone sounds in full, and from which it is silent

    /// The place of a reader in a track. It only speeds up the search: any value gives the same result.
    struct Cursor
    {
        std::size_t ramp = 0, sweep = 0, burst = 0;
    };

    /// The tracks of one channel, or of all if it is 0, and only this track, from 1, if `only` is not 0. [main thread]
    explicit ClipScore (const Clip& clip = {}, int channel = 0, int only = 0)
    {
        for (std::size_t i = 0; i < clip.tracks.size(); ++i)
            if ((channel == 0 || clip.tracks[i].channel == channel) && (only == 0 || at (only) == i + 1)) add (clip.tracks[i], clip.voice);
        ducking = clip.voice.ducking;
        fastest_hertz = std::max ({ clip.voice.lowest, clip.voice.highest, clip.voice.tap_lowest, clip.voice.tap_highest });
    }

    std::size_t size() const noexcept { return parts.size(); }
    double duration() const noexcept { return ends; }   ///< until the last tone and transient have ended, s
    double peak() const noexcept { return most; }       ///< upper bound of |value| and amplitude

    /// The output of the clip at time t. `step` is the time in the clip from one sample to the next: tones that would be faster than 0.45 cycles per
    /// sample are silent, those slower than 0.25 sound in full. One cursor per track. [tick thread]
    ClipMoment operator() (double t, double step, Cursor* cursors) const noexcept
    {
        ClipMoment now;
        double strongest = 0.0;
        for (std::size_t i = 0; i < parts.size(); ++i)
            addPart (parts[i], cursors[i], t, step, now, strongest);
        return now;
    }

    double fastest() const noexcept { return fastest_hertz; }   ///< upper bound of all frequencies, Hz

    /// The gain of a tone: 1 if it is slow, 0 near half the rate and above. [tick thread]
    static double audible (double cycles_per_sample) noexcept
    {
        if (cycles_per_sample <= whole) return 1.0;
        return cycles_per_sample < silent ? (silent - cycles_per_sample) / (silent - whole) : 0.0;
    }

    /// A stretch of a tone whose frequency is straight.
    struct Sweep
    {
        double at, hertz, slope, cycles;   ///< s, Hz, Hz/s, phase at `at` from 0 to 1
    };

    /// The stretches of a tone, of which the first begins at 0. [main thread]
    static std::vector<Sweep> sweepsOf (const std::vector<ClipPoint>& sharpness, const std::vector<ClipPoint>& phases, const ClipVoice&);

private:
    struct Ramp
    {
        double at, value, slope;
    };
    struct Burst
    {
        double at, amplitude, hertz, length;
    };
    struct Part
    {
        bool is_wave = false;
        std::vector<Ramp> ramps;
        std::vector<Sweep> sweeps;
        std::vector<Burst> bursts;
    };

    /// The last entry that has begun at t; `none` if there is none.
    static constexpr std::size_t none = static_cast<std::size_t> (-1);
    template <typename Entry>
    static std::size_t find (const std::vector<Entry>& all, double t, std::size_t& hint) noexcept
    {
        const std::size_t n = all.size();
        if (n == 0 || ! (t >= all.front().at)) return none;
        const auto holds = [&] (std::size_t i) { return i < n && all[i].at <= t && (i + 1 == n || t < all[i + 1].at); };
        if (holds (hint)) return hint;
        if (holds (hint + 1)) return ++hint;
        const auto after = std::upper_bound (all.begin(), all.end(), t, [] (double time, const Entry& e) { return time < e.at; });
        return hint = tactus::at (after - all.begin()) - 1;
    }

    static double sine (double cycles) noexcept { return math::sin (2.0 * std::numbers::pi * (cycles - std::floor (cycles))); }

    /// The share by which a transient has taken over, 0…1: it rises and falls, each within a quarter of its length.
    static double grip (double through) noexcept
    {
        const double x = std::min (1.0, 4.0 * std::min (through, 1.0 - through));
        return x * x * (3.0 - 2.0 * x);
    }

    static void count (ClipMoment& now, double& strongest, double value, double amplitude, double hertz) noexcept
    {
        now.value += value;
        now.amplitude += amplitude;
        if (! (amplitude > strongest)) return;
        strongest = amplitude;
        now.frequency = hertz;
    }

    void addPart (const Part& part, Cursor& cursor, double t, double step, ClipMoment& now, double& strongest) const noexcept
    {
        double duck = 1.0;
        if (const std::size_t last = find (part.bursts, t, cursor.burst); last != none)
            for (std::size_t i = 0; i < together && i <= last; ++i)
            {
                const Burst& b = part.bursts[last - i];
                const double since = t - b.at;
                if (! (since < b.length)) continue;
                const double gain = b.amplitude * audible (b.hertz * step);
                count (now, strongest, gain * sine (b.hertz * since), gain, b.hertz);
                duck *= 1.0 - (1.0 - ducking) * grip (since / b.length);
            }

        const std::size_t r = find (part.ramps, t, cursor.ramp);
        if (r == none) return;
        const double amplitude = duck * (part.ramps[r].value + part.ramps[r].slope * (t - part.ramps[r].at));
        if (part.is_wave) return count (now, strongest, amplitude, std::abs (amplitude), 0.0);
        if (amplitude == 0.0) return;
        const Sweep& s = part.sweeps[find (part.sweeps, t, cursor.sweep)];   // the first one begins at 0, as no point is before that
        const double since = t - s.at, hertz = s.hertz + s.slope * since;
        const double gain = amplitude * audible (hertz * step);
        count (now, strongest, gain * sine (s.cycles + since * (s.hertz + 0.5 * s.slope * since)), gain, hertz);
    }

    void add (const ClipTrack& track, const ClipVoice& voice)
    {
        Part part { .is_wave = track.is_wave, .ramps = rampsOf (track.amplitude), .sweeps = {}, .bursts = burstsOf (track.taps, voice) };
        if (! track.is_wave) part.sweeps = sweepsOf (track.sharpness, track.phases, voice);
        double loudest = 0.0, hardest = 0.0;
        for (const auto& p : track.amplitude)
            loudest = std::max (loudest, std::abs (p.value));
        for (const auto& b : part.bursts)
        {
            hardest = std::max (hardest, b.amplitude);
            ends = std::max (ends, b.at + b.length);
        }
        most += loudest + together * hardest;
        if (! track.amplitude.empty()) ends = std::max (ends, track.amplitude.back().time);
        parts.push_back (std::move (part));
    }

    static std::vector<Ramp> rampsOf (const std::vector<ClipPoint>& points)
    {
        std::vector<Ramp> ramps;
        for (std::size_t i = 0; i + 1 < points.size(); ++i)
            if (const double length = points[i + 1].time - points[i].time; length > 0.0)
                ramps.push_back ({ points[i].time, points[i].value, (points[i + 1].value - points[i].value) / length });
        if (! points.empty()) ramps.push_back ({ points.back().time, 0.0, 0.0 });
        return ramps;
    }

    static std::vector<Burst> burstsOf (const std::vector<ClipTap>& taps, const ClipVoice& voice)
    {
        constexpr double rounding = 1e-6;   // of a time, in half cycles
        std::vector<Burst> bursts;
        bursts.reserve (taps.size());
        for (std::size_t i = 0; i < taps.size(); ++i)
        {
            const double hertz = voice.tap_lowest + taps[i].sharpness * (voice.tap_highest - voice.tap_lowest);
            double length = 2.0 / hertz;
            if (i + together < taps.size())
                if (const double room = taps[i + together].time - taps[i].time; room < length)
                    length = std::floor (2.0 * hertz * room + rounding) / (2.0 * hertz);
            bursts.push_back ({ taps[i].time, taps[i].amplitude, hertz, length });
        }
        return bursts;
    }

    std::vector<Part> parts;
    double ends = 0.0, most = 0.0, ducking = 1.0, fastest_hertz = 0.0;
};

//==============================================================================
// Implementation below.

inline std::vector<ClipScore::Sweep> ClipScore::sweepsOf (const std::vector<ClipPoint>& points, const std::vector<ClipPoint>& phases, const ClipVoice& voice)
{
    const auto hertz = [&] (double sharpness) { return voice.lowest + sharpness * (voice.highest - voice.lowest); };
    std::vector<Sweep> sweeps { { 0.0, hertz (points.empty() ? 0.5 : points.front().value), 0.0, 0.0 } };
    const auto at = [&] (double time) {
        const Sweep& last = sweeps.back();
        const double length = time - last.at, cycles = last.cycles + length * (last.hertz + 0.5 * last.slope * length);
        return Sweep { time, last.hertz + last.slope * length, last.slope, cycles - std::floor (cycles) };
    };
    const auto put = [&] (Sweep s) {
        if (s.at > sweeps.back().at)
            sweeps.push_back (s);
        else
            sweeps.back() = { sweeps.back().at, s.hertz, s.slope, s.cycles };
    };
    auto phase = phases.begin();
    const auto setPhases = [&] (double until) {
        for (; phase != phases.end() && phase->time < until; ++phase)
        {
            auto s = at (phase->time);
            s.cycles = phase->value;
            put (s);
        }
    };
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const double length = i + 1 < points.size() ? points[i + 1].time - points[i].time : 0.0;
        const double to = length > 0.0 ? hertz (points[i + 1].value) : 0.0, from = hertz (points[i].value);
        setPhases (points[i].time);
        put ({ points[i].time, from, length > 0.0 ? (to - from) / length : 0.0, at (points[i].time).cycles });
    }
    setPhases (2.0 * longest_clip_s);
    return sweeps;
}

}   // namespace tactus
