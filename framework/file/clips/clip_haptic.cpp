// SPDX-License-Identifier: MIT
// Meta .haptic 1.0. Source: facebook/meta-haptics-sdk, resources/haptic-file-spec.md (MIT).
#include "clip_formats.hpp"

#include <tactus/text/json_writer.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>

namespace tactus::readers
{

namespace
{
/// Reads a time that is not before the previous one.
double timeOf (const ClipJson& file, const Spot& point, double before)
{
    const auto at = file.need (point, "time");
    const double time = file.number (at, 0.0, longest_clip_s);
    if (time < before)
        file.refuse (at, "clip/order", "the time " + numberText (time) + " is before the previous one, " + numberText (before), "sort the points by time");
    return time;
}

void readEmphasis (ClipJson& file, const Spot& point, double time, double amplitude, ClipTrack& track)
{
    constexpr double rounding = 1e-6;
    const auto emphasis = file.find (point, "emphasis");
    if (! emphasis) return;
    file.object (*emphasis);
    file.noteOthers (*emphasis, { "amplitude", "frequency" });
    const auto hard = file.need (*emphasis, "amplitude"), sharp = file.need (*emphasis, "frequency");
    const ClipTap tap { time, file.number (hard, 0.0, 1.0), file.number (sharp, 0.0, 1.0) };
    if (tap.amplitude < amplitude - rounding)
        file.refuse (hard, "clip/range",
                     "the emphasis of " + numberText (tap.amplitude) + " is weaker than the amplitude of its point, " + numberText (amplitude),
                     "make it at least as strong");
    track.taps.push_back (tap);
}

void readNotes (ClipJson& file, Clip& clip)
{
    const auto data = file.find (file.root(), "metadata");
    if (! data) return;
    for (const auto& [key, value] : data->json->items())
        if (! value.is_string() && ! (value.is_array() && value.size() == 0))
            file.note ({ &value, &*data, key }, "clip/not_carried", "the metadata " + quote (key) + " are left out: a clip holds texts only",
                       "keep the original file");
        else if (value.is_string() && ! value.asString().empty())
            clip.notes.emplace_back (key, value.asString());
}
}   // namespace

Clip readHaptic (ClipJson& file)
{
    const auto& root = file.root();
    const auto version = file.need (root, "version");
    const auto major = file.need (version, "major");
    if (const double v = file.number (major); v != 1.0)
        file.refuse (major, "clip/version", "version " + numberText (v) + " is not known", "save it as version 1, for example with Meta Haptics Studio");
    const auto signals = file.need (root, "signals");
    const auto continuous = file.need (signals, "continuous");
    const auto envelopes = file.need (continuous, "envelopes");
    const auto amplitude = file.need (envelopes, "amplitude");
    file.list (amplitude);
    file.noteOthers (root, { "version", "metadata", "signals" });
    file.noteOthers (signals, { "continuous" });
    file.noteOthers (continuous, { "envelopes" });
    file.noteOthers (envelopes, { "amplitude", "frequency" });
    if (amplitude.json->size() < 2)
        file.refuse (amplitude, "clip/too_few", "the envelope has " + std::to_string (amplitude.json->size()) + " points; it needs at least 2", "add points");

    Clip clip;
    auto& track = clip.tracks.emplace_back();
    double before = 0.0;
    for (std::size_t i = 0; i < amplitude.json->size(); ++i)
    {
        const auto point = ClipJson::entry (amplitude, i);
        file.object (point);
        file.noteOthers (point, { "time", "amplitude", "emphasis" });
        before = timeOf (file, point, before);
        const auto value = file.need (point, "amplitude");
        track.amplitude.push_back ({ before, file.number (value, 0.0, 1.0) });
        readEmphasis (file, point, before, track.amplitude.back().value, track);
    }
    if (! (track.amplitude.back().time > track.amplitude.front().time))
        file.refuse (amplitude, "clip/range", "the envelope has no duration", "move its last point");

    if (const auto frequency = file.find (envelopes, "frequency"); frequency && ! frequency->json->is_null())
    {
        file.list (*frequency);
        before = 0.0;
        for (std::size_t i = 0; i < frequency->json->size(); ++i)
        {
            const auto point = ClipJson::entry (*frequency, i);
            file.object (point);
            file.noteOthers (point, { "time", "frequency" });
            before = timeOf (file, point, before);
            const auto value = file.need (point, "frequency");
            track.sharpness.push_back ({ before, file.number (value, 0.0, 1.0) });
        }
        if (before > track.amplitude.back().time)
            file.note (*frequency, "clip/habit", "the frequencies outlast the amplitudes by " + numberText (before - track.amplitude.back().time) + " s",
                       "no action is needed: the rest is not heard");
    }
    readNotes (file, clip);
    return clip;
}

namespace
{
Json metadataOf (const Clip& clip, Messages& losses)
{
    Json data = Json::object();
    for (const auto& [key, value] : clip.notes)
        if (key == "author" || key == "editor" || key == "source" || key == "project" || key == "description")
            data[key] = value;
        else
            lose (losses, "notes/" + key, "the " + key + " of the clip is left out: the format has no place for it", "keep the original file");
    if (! data.contains ("editor")) data["editor"] = "Tactus";
    return data;
}

/// The points of the envelope, with one at each transient that has none.
std::vector<ClipPoint> pointsFor (const ClipTrack& track)
{
    auto points = track.amplitude;
    constexpr double after_tap_s = 0.04;   // as long as the longest transient, so that the clip does not end in it
    const double end = points.empty() ? 0.0 : points.back().time;
    if (points.empty() || (! track.taps.empty() && track.taps.back().time > end))
    {
        if (! points.empty()) points.push_back ({ end, 0.0 });
        points.push_back ({ track.taps.empty() ? 0.1 : track.taps.back().time + after_tap_s, 0.0 });
    }
    if (points.front().time > 0.0) points.insert (points.begin(), { { 0.0, 0.0 }, { points.front().time, 0.0 } });
    if (! (points.back().time > points.front().time)) points.push_back ({ points.back().time + 0.1, 0.0 });   // an envelope needs a duration
    return points;
}
}   // namespace

ClipText writeHaptic (const Clip& given)
{
    ClipText made;
    const auto clip = weighted (given, made.losses);
    const auto track = oneTrack (clip, made.losses);
    const auto points = pointsFor (track);
    Json amplitude = Json::array(), frequency = Json::array();
    std::size_t next = 0, raised = 0;
    const auto add = [&] (double time, double value, const ClipTap* tap) {
        Json point { { "time", time }, { "amplitude", value } };
        if (tap != nullptr)
        {
            if (tap->amplitude < value) ++raised;
            point["emphasis"] = Json { { "amplitude", std::max (tap->amplitude, value) }, { "frequency", tap->sharpness } };
        }
        amplitude.push_back (std::move (point));
    };
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const auto& p = points[i];
        // The taps since the previous point; one at the time of a point belongs to the last point of that time.
        while (next < track.taps.size() && track.taps[next].time < p.time)
        {
            const auto& tap = track.taps[next++];
            const auto& a = points[i - 1];
            add (tap.time, a.value + (p.value - a.value) * (tap.time - a.time) / (p.time - a.time), &tap);
        }
        const bool is_last_here = i + 1 == points.size() || points[i + 1].time > p.time;
        const bool has_tap = is_last_here && next < track.taps.size() && track.taps[next].time == p.time;
        add (p.time, p.value, has_tap ? &track.taps[next] : nullptr);
        if (has_tap) ++next;
        while (is_last_here && next < track.taps.size() && track.taps[next].time == p.time)
            add (p.time, p.value, &track.taps[next++]);
    }
    for (const auto& p : track.sharpness)
        frequency.push_back (Json { { "time", p.time }, { "frequency", p.value } });
    if (raised > 0)
        lose (made.losses, "transients", std::to_string (raised) + " are weaker than the envelope and were raised to it: an emphasis may not be weaker",
              "lower the envelope there");
    if (clip.voice != ClipVoice {})
        lose (made.losses, "voice", "the frequencies of 0 and 1, and the ducking, are left out: the format has none", "give the device an .acf file");

    Json envelopes { { "amplitude", std::move (amplitude) } };
    if (! track.sharpness.empty()) envelopes["frequency"] = std::move (frequency);
    Json file { { "version", Json { { "major", 1 }, { "minor", 0 }, { "patch", 0 } } }, { "metadata", metadataOf (clip, made.losses) } };
    file["signals"] = Json { { "continuous", Json { { "envelopes", std::move (envelopes) } } } };
    made.text = writeJson (file);
    return made;
}

}   // namespace tactus::readers
