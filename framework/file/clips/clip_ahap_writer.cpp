// SPDX-License-Identifier: MIT
// Writes Apple AHAP by the rules of Meta's converter: at most 16 points in a curve, curves chained by repeating a point, continuous
// events of at most 30 s, intensity and sharpness the square roots of amplitude and frequency, and an envelope 20 % lower at a
// transient (facebook/meta-haptics-sdk, core/haptic_data, MIT).
#include "clip_ahap_events.hpp"
#include "clip_formats.hpp"

#include <tactus/text/json_writer.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace tactus::readers
{

namespace
{
constexpr std::size_t most_points = 16;
constexpr double longest_event_s = 30.0, ducking = 0.8;

/// Times of all points count from the start of the pattern, so each curve begins at 0.
void addCurves (Json& pattern, const char* id, const std::vector<ClipPoint>& points)
{
    for (std::size_t first = 0; first < points.size(); first += most_points - 1)
    {
        if (first > 0 && first + 1 >= points.size()) break;   // the previous curve ended with the last point
        Json list = Json::array();
        for (std::size_t i = first; i < std::min (first + most_points, points.size()); ++i)
            list.push_back (Json { { "Time", points[i].time }, { "ParameterValue", points[i].value } });
        pattern.push_back (Json { { "ParameterCurve", Json { { "ParameterID", id }, { "Time", 0 }, { "ParameterCurveControlPoints", std::move (list) } } } });
    }
}

Json parameters (double intensity, double sharpness)
{
    const auto parameter = [] (const char* id, double v) { return Json { { "ParameterID", id }, { "ParameterValue", v } }; };
    return Json::array ({ parameter ("HapticIntensity", intensity), parameter ("HapticSharpness", sharpness) });
}

Json event (const char* type, double time, double duration, Json given)
{
    Json made { { "EventType", type }, { "Time", time } };
    if (duration > 0.0) made["EventDuration"] = duration;
    made["EventParameters"] = std::move (given);
    return Json { { "Event", std::move (made) } };
}

/// The square roots of an envelope, lower where a transient sounds.
std::vector<ClipPoint> roots (const std::vector<ClipPoint>& points, const std::vector<ClipTap>& taps)
{
    std::vector<ClipPoint> made;
    for (const auto& p : points)
    {
        const auto tap = std::ranges::lower_bound (taps, p.time, {}, &ClipTap::time);
        const bool ducks = tap != taps.end() && tap->time == p.time;
        made.push_back ({ p.time, std::sqrt (p.value) * (ducks ? ducking : 1.0) });
    }
    return made;
}
/// One event for each tone, which may sound together. Empty if the curves of the format, which act on all events, do not allow it.
std::optional<Json> eventsOf (const Clip& clip)
{
    const auto all = ahapEvents (clip.tracks);
    if (! all) return {};
    Json pattern = Json::array();
    addCurves (pattern, "HapticIntensityControl", all->gain);
    addCurves (pattern, "HapticSharpnessControl", all->shift);
    for (const auto& e : all->events)
        for (double from = e.from; from < e.to; from += longest_event_s)
            pattern.push_back (event ("HapticContinuous", from, std::min (longest_event_s, e.to - from), parameters (e.intensity, e.sharpness)));
    std::vector<ClipTap> taps;
    for (const auto& t : clip.tracks)
        taps.insert (taps.end(), t.taps.begin(), t.taps.end());
    std::ranges::stable_sort (taps, {}, &ClipTap::time);
    constexpr double rounding = 1e-9;
    for (const auto& tap : taps)
    {
        // The curves act on the transients too, so they are taken out of their numbers. Before the first point a curve does nothing.
        const auto curve = [&] (const std::vector<ClipPoint>& points, double nothing) {
            return points.empty() || tap.time < points.front().time ? nothing : heldAt (points, tap.time, false, nothing);
        };
        const double gain = curve (all->gain, 1.0), root = std::sqrt (tap.amplitude), sharpness = tap.sharpness - curve (all->shift, 0.0);
        if (root > gain + rounding || sharpness < -rounding || sharpness > 1.0 + rounding) return {};
        pattern.push_back (event ("HapticTransient", tap.time, 0.0,
                                  parameters (gain > 0.0 ? std::min (1.0, root / gain) : 0.0, std::clamp (sharpness, 0.0, 1.0))));
    }
    return pattern;
}

/// One continuous event with curves, as Meta's converter writes it.
Json curvesOf (const Clip& clip, Messages& losses)
{
    const auto track = oneTrack (clip, losses);
    Json pattern = Json::array();
    const auto envelope = roots (track.amplitude, track.taps);
    if (! envelope.empty())
    {
        addCurves (pattern, "HapticIntensityControl", envelope);
        addCurves (pattern, "HapticSharpnessControl", roots (track.sharpness, {}));
        const double end = envelope.back().time;
        const double base = track.sharpness.empty() ? std::sqrt (0.5) : 0.0;
        for (double from = envelope.front().time; from < end; from += longest_event_s)
            pattern.push_back (event ("HapticContinuous", from, std::min (longest_event_s, end - from), parameters (1.0, base)));
    }
    for (const auto& tap : track.taps)
        pattern.push_back (event ("HapticTransient", tap.time, 0.0, parameters (std::sqrt (tap.amplitude), tap.sharpness)));

    if (! envelope.empty() && ! track.taps.empty())
        lose (losses, "transients",
              "the engine of the phone applies the curves of the envelope to the " + std::to_string (track.taps.size())
                  + " transients too, and the envelope is 20 % lower at each",
              "write two files with --split, and play them together");
    return pattern;
}
}   // namespace

ClipText writeAhap (const Clip& given)
{
    ClipText made;
    const auto clip = weighted (given, made.losses);
    const auto isApart = [] (const ClipTrack& t) { return ! t.phases.empty(); };
    std::optional<Json> pattern;
    if (clip.tracks.size() > 1 || std::ranges::any_of (clip.tracks, isApart)) pattern = eventsOf (clip);
    if (! pattern) pattern = curvesOf (clip, made.losses);
    const auto differs = [&] (const ClipTrack& t) { return t.channel != clip.tracks.front().channel; };
    if (made.losses.empty() && std::ranges::any_of (clip.tracks, differs))
        lose (made.losses, "channels", "they are added up: the format has one", "write a .json or .hjif, or each channel alone");
    if (clip.voice != ClipVoice {})
        lose (made.losses, "voice", "the frequencies of 0 and 1, and the ducking, are left out: the phone chooses its own", "no action is needed");

    Json file { { "Version", 1.0 } };
    Json data = Json::object();
    for (const auto& [key, value] : clip.notes)
        if (key == "project" || key == "created" || key == "description")
            data[key == "project" ? "Project" : key == "created" ? "Created"
                                                                 : "Description"] = value;
        else
            lose (made.losses, "notes/" + key, "the " + key + " of the clip is left out: the format has no place for it", "keep the original file");
    if (! data.empty()) file["Metadata"] = std::move (data);
    file["Pattern"] = std::move (*pattern);
    made.text = writeJson (file);
    return made;
}

}   // namespace tactus::readers
