// SPDX-License-Identifier: MIT
#pragma once

/// A haptic clip: what a designer drew or recorded, without a device. Files of several formats hold clips; the nodes see this.

#include <tactus/kit/assets.hpp>
#include <tactus/kit/at.hpp>
#include <tactus/kit/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace tactus
{

/// A point of an envelope, which is straight between its points. Two points at the same time are a step.
struct ClipPoint
{
    double time = 0.0, value = 0.0;   ///< s; 0…1

    bool operator== (const ClipPoint&) const = default;
};

/// A transient: a short burst on top of the envelope.
struct ClipTap
{
    double time = 0.0, amplitude = 1.0, sharpness = 0.5;   ///< s; 0…1; 0…1

    bool operator== (const ClipTap&) const = default;
};

/// One line of a clip. Its amplitude is 0 before its first point and after its last one. Its sharpness is held there, and is 0.5
/// without any point. The phase of its tone is the integral of its frequency from 0 s on, or from the last of its phases on, if it has
/// any. Times do not decrease.
struct ClipTrack
{
    int channel = 1;        ///< from 1
    bool is_wave = false;   ///< `amplitude` is the signal itself, from -1 to 1, and not the envelope of a tone
    std::vector<ClipPoint> amplitude {}, sharpness {};
    std::vector<ClipTap> taps {};
    std::vector<ClipPoint> phases {};   ///< at this time the tone has this phase, in cycles

    bool operator== (const ClipTrack&) const = default;
};

/// The meaning of the numbers 0 and 1 of a clip on a device. The defaults are those of Meta's MetaQuest.acf, without ducking.
struct ClipVoice
{
    double lowest = 55.0, highest = 200.0;           ///< frequency of the tone at sharpness 0 and 1, Hz
    double tap_lowest = 55.0, tap_highest = 165.0;   ///< the same of a transient, which is two cycles long
    double ducking = 1.0;                            ///< gain of the envelope while a transient sounds

    bool operator== (const ClipVoice&) const = default;
};

struct Clip
{
    ClipVoice voice {};
    std::vector<ClipTrack> tracks {};
    std::vector<std::pair<std::string, std::string>> notes {};   ///< author, description and so on; no node sees them

    bool operator== (const Clip&) const = default;

    /// The time of the last point or transient, s.
    double lastEvent() const noexcept
    {
        double last = 0.0;
        for (const auto& t : tracks)
        {
            if (! t.amplitude.empty()) last = std::max (last, t.amplitude.back().time);
            if (! t.taps.empty()) last = std::max (last, t.taps.back().time);
        }
        return last;
    }

    /// Number of points and transients.
    std::size_t events() const noexcept
    {
        std::size_t n = 0;
        for (const auto& t : tracks)
            n += t.amplitude.size() + t.sharpness.size() + t.taps.size();
        return n;
    }
};

/// A node receives a clip as a table, so plugins, exported code and every other program that supplies tables can supply clips. Its
/// rows hold five numbers:
///
///     kind            track   then
///     0  voice        0       lowest, highest, ducking
///     1  of the taps  0       lowest, highest, 0
///     2  track        n       channel, 1 if it is a wave, 0
///     3  amplitude    n       time, amplitude, 0
///     4  sharpness    n       time, sharpness, 0
///     5  transient    n       time, amplitude, sharpness
///     6  phase        n       time, cycles, 0
///
/// Tracks are numbered from 1 in the order of their rows.
enum class ClipRow
{
    voice,
    tap_voice,
    track,
    amplitude,
    sharpness,
    tap,
    phase
};

inline constexpr int clip_columns = 5;
inline constexpr double longest_clip_s = 86400.0;
inline constexpr int most_clip_tracks = 256, most_clip_channels = 1024;

/// [main thread]
Grid gridOf (const Clip&);

/// Reads a clip from a table. If the table is not a clip, returns a sentence that says why. An empty table is an empty clip. [main thread]
struct ClipOrProblem
{
    Clip clip {};
    std::string problem {};
};
ClipOrProblem clipOf (const Grid&);

/// The problem of a clip, as a sentence; empty if there is none. [main thread]
std::string problemOf (const Clip&);

//==============================================================================
// Implementation below.

inline Grid gridOf (const Clip& clip)
{
    Grid grid { .rows = 0, .columns = clip_columns, .values = {} };
    const auto row = [&] (ClipRow kind, std::size_t track, double a, double b, double c) {
        for (const double v : { static_cast<double> (kind), static_cast<double> (track), a, b, c })
            grid.values.push_back (v);
        ++grid.rows;
    };
    row (ClipRow::voice, 0, clip.voice.lowest, clip.voice.highest, clip.voice.ducking);
    row (ClipRow::tap_voice, 0, clip.voice.tap_lowest, clip.voice.tap_highest, 0.0);
    for (std::size_t i = 0; i < clip.tracks.size(); ++i)
    {
        const auto& t = clip.tracks[i];
        row (ClipRow::track, i + 1, t.channel, t.is_wave ? 1.0 : 0.0, 0.0);
        for (const auto& p : t.amplitude)
            row (ClipRow::amplitude, i + 1, p.time, p.value, 0.0);
        for (const auto& p : t.sharpness)
            row (ClipRow::sharpness, i + 1, p.time, p.value, 0.0);
        for (const auto& p : t.taps)
            row (ClipRow::tap, i + 1, p.time, p.amplitude, p.sharpness);
        for (const auto& p : t.phases)
            row (ClipRow::phase, i + 1, p.time, p.value, 0.0);
    }
    return grid;
}

namespace detail
{
inline bool isWithin (double v, double low, double high) noexcept { return v >= low && v <= high; }

/// Points of an envelope: times in order, values in their range.
inline std::string problemOfEnvelope (const std::vector<ClipPoint>& points, const char* what, double least)
{
    double before = 0.0;
    for (const auto& p : points)
    {
        if (! isWithin (p.time, 0.0, longest_clip_s)) return std::string ("a time of its ") + what + " is not between 0 and a day";
        if (p.time < before) return std::string ("the times of its ") + what + " go back";
        if (! isWithin (p.value, least, 1.0)) return std::string ("its ") + what + " has a value outside its range";
        before = p.time;
    }
    return {};
}

inline std::string problemOfTaps (const std::vector<ClipTap>& taps)
{
    double before = 0.0;
    for (const auto& p : taps)
    {
        if (! isWithin (p.time, 0.0, longest_clip_s)) return "the time of a transient is not between 0 and a day";
        if (p.time < before) return "the times of its transients go back";
        if (! isWithin (p.amplitude, 0.0, 1.0) || ! isWithin (p.sharpness, 0.0, 1.0)) return "a transient has a value outside 0 to 1";
        before = p.time;
    }
    return {};
}

/// Takes one row of a table; returns what is wrong with it.
inline std::string takeClipRow (Clip& clip, const double* row)
{
    const double kind = row[0], track = row[1], a = row[2], b = row[3], c = row[4];
    if (kind == 0.0 || kind == 1.0)
    {
        auto& v = clip.voice;
        (kind == 0.0 ? v.lowest : v.tap_lowest) = a;
        (kind == 0.0 ? v.highest : v.tap_highest) = b;
        if (kind == 0.0) v.ducking = c;
        return {};
    }
    if (kind == 2.0)
    {
        if (track != static_cast<double> (clip.tracks.size() + 1) || track > most_clip_tracks) return "a track has a wrong number";
        if (! isWithin (a, 1, most_clip_channels) || a != static_cast<int> (a)) return "the channel of a track is not a whole number from 1";
        clip.tracks.emplace_back().channel = static_cast<int> (a);
        clip.tracks.back().is_wave = b != 0.0;
        return {};
    }
    if (clip.tracks.empty() || track != static_cast<double> (clip.tracks.size())) return "a row does not follow the row of its track";
    if (kind == 3.0)
        clip.tracks.back().amplitude.push_back ({ a, b });
    else if (kind == 4.0)
        clip.tracks.back().sharpness.push_back ({ a, b });
    else if (kind == 5.0)
        clip.tracks.back().taps.push_back ({ a, b, c });
    else if (kind == 6.0)
        clip.tracks.back().phases.push_back ({ a, b });
    else
        return "a row has an unknown kind";
    return {};
}
}   // namespace detail

inline std::string problemOf (const Clip& clip)
{
    const auto& v = clip.voice;
    for (const double hertz : { v.lowest, v.highest, v.tap_lowest, v.tap_highest })
        if (! detail::isWithin (hertz, 0.1, 1e5)) return "a frequency is not between 0.1 Hz and 100 kHz";
    if (! detail::isWithin (v.ducking, 0.0, 1.0)) return "the ducking is not between 0 and 1";
    if (clip.tracks.size() > at (most_clip_tracks)) return "it has more than " + std::to_string (most_clip_tracks) + " tracks";
    for (std::size_t i = 0; i < clip.tracks.size(); ++i)
    {
        const auto& t = clip.tracks[i];
        auto what = detail::problemOfEnvelope (t.amplitude, "amplitude", t.is_wave ? -1.0 : 0.0);
        if (what.empty()) what = detail::problemOfEnvelope (t.sharpness, "sharpness", 0.0);
        if (what.empty()) what = detail::problemOfEnvelope (t.phases, "phases", 0.0);
        if (what.empty()) what = detail::problemOfTaps (t.taps);
        if (what.empty() && (t.channel < 1 || t.channel > most_clip_channels)) what = "its channel is not between 1 and 1024";
        if (! what.empty()) return "track " + std::to_string (i + 1) + ": " + what;
    }
    return {};
}

inline ClipOrProblem clipOf (const Grid& grid)
{
    ClipOrProblem made;
    if (grid.values.empty()) return made;
    if (grid.columns != clip_columns || grid.values.size() != at (grid.rows) * at (clip_columns))
        return { {}, "the table is not a clip: a clip has " + std::to_string (clip_columns) + " columns" };
    for (std::size_t i = 0; i + clip_columns <= grid.values.size(); i += clip_columns)
        if (auto what = detail::takeClipRow (made.clip, &grid.values[i]); ! what.empty())
            return { {}, "the table is not a clip: row " + std::to_string (i / clip_columns + 1) + ": " + what };
    made.problem = problemOf (made.clip);
    return made;
}

}   // namespace tactus
