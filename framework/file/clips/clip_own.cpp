// SPDX-License-Identifier: MIT
// The clip format of Tactus: everything that a Clip holds. docs/clips.md describes it.
#include "clip_formats.hpp"

#include <tactus/text/json_writer.hpp>
#include <tactus/text/number_text.hpp>

namespace tactus::readers
{

namespace
{
constexpr double version_now = 1.0;

/// Calls take (row, numbers) for each row of a list of rows of `width` numbers.
template <typename Take>
void rowsOf (const ClipJson& file, const Spot& track, std::string_view key, std::size_t width, Take take)
{
    const auto rows = file.find (track, key);
    if (! rows) return;
    file.list (*rows);
    double before = 0.0;
    for (std::size_t i = 0; i < rows->json->size(); ++i)
    {
        const auto row = ClipJson::entry (*rows, i);
        file.list (row);
        if (row.json->size() != width)
            file.refuse (row, "clip/kind", "it has " + std::to_string (row.json->size()) + " numbers instead of " + std::to_string (width), "correct it");
        double v[3] {};
        for (std::size_t k = 0; k < width; ++k)
        {
            const auto number = ClipJson::entry (row, k);
            v[k] = k == 0 ? file.number (number, 0.0, longest_clip_s) : file.number (number, -1.0, 1.0);
        }
        if (v[0] < before) file.refuse (row, "clip/order", "its time is before the previous one, " + numberText (before), "sort the rows by time");
        before = v[0];
        take (row, v);
    }
}

void readTrack (ClipJson& file, const Spot& spot, ClipTrack& track)
{
    file.object (spot);
    file.noteOthers (spot, { "channel", "wave", "amplitude", "sharpness", "transients", "phases" });
    track.channel = static_cast<int> (file.numberOr (spot, "channel", 1.0, 1.0, most_clip_channels));
    if (const auto wave = file.find (spot, "wave"); wave && wave->json->is_boolean()) track.is_wave = wave->json->get<bool>();
    const auto positive = [&] (const Spot& row, double v) {
        if (v < 0.0) file.refuse (row, "clip/range", "it has a negative number", "values are from 0 to 1");
    };
    rowsOf (file, spot, "amplitude", 2, [&] (const Spot& row, const double* v) {
        if (! track.is_wave) positive (row, v[1]);
        track.amplitude.push_back ({ v[0], v[1] });
    });
    rowsOf (file, spot, "sharpness", 2, [&] (const Spot& row, const double* v) {
        positive (row, v[1]);
        track.sharpness.push_back ({ v[0], v[1] });
    });
    rowsOf (file, spot, "transients", 3, [&] (const Spot& row, const double* v) {
        positive (row, v[1]);
        positive (row, v[2]);
        track.taps.push_back ({ v[0], v[1], v[2] });
    });
    rowsOf (file, spot, "phases", 2, [&] (const Spot& row, const double* v) {
        positive (row, v[1]);
        track.phases.push_back ({ v[0], v[1] });
    });
}
}   // namespace

Clip readOwnClip (ClipJson& file)
{
    const auto& root = file.root();
    const auto version = file.need (root, "version");
    if (const double v = file.number (version); v != version_now)
        file.refuse (version, "clip/version", "version " + numberText (v) + " is not known", "update Tactus, or save it as version 1");

    Clip clip;
    file.noteOthers (root, { "format", "version", "notes", "voice", "tracks" });
    if (const auto voice = file.find (root, "voice"))
    {
        file.noteOthers (*voice, { "lowest", "highest", "transient_lowest", "transient_highest", "ducking" });
        const auto hertz = [&] (std::string_view key, double& value) { value = file.numberOr (*voice, key, value, 0.1, 1e5); };
        hertz ("lowest", clip.voice.lowest);
        hertz ("highest", clip.voice.highest);
        hertz ("transient_lowest", clip.voice.tap_lowest);
        hertz ("transient_highest", clip.voice.tap_highest);
        clip.voice.ducking = file.numberOr (*voice, "ducking", 1.0, 0.0, 1.0);
    }
    if (const auto notes = file.find (root, "notes"))
        for (const auto& [key, value] : notes->json->items())
            if (value.is_string()) clip.notes.emplace_back (key, value.asString());
    const auto tracks = file.need (root, "tracks");
    file.list (tracks);
    if (tracks.json->size() > at (most_clip_tracks))
        file.refuse (tracks, "clip/too_large", "there are more than " + std::to_string (most_clip_tracks) + " tracks", "join some of them");
    for (std::size_t i = 0; i < tracks.json->size(); ++i)
    {
        const auto track = ClipJson::entry (tracks, i);
        readTrack (file, track, clip.tracks.emplace_back());
    }
    return clip;
}

ClipText writeOwnClip (const Clip& clip)
{
    Json file { { "format", "tactus-clip" }, { "version", 1 } };
    if (! clip.notes.empty())
    {
        Json notes = Json::object();
        for (const auto& [key, value] : clip.notes)
            notes[key] = value;
        file["notes"] = std::move (notes);
    }
    const auto& v = clip.voice;
    file["voice"] = Json { { "lowest", v.lowest },
                           { "highest", v.highest },
                           { "transient_lowest", v.tap_lowest },
                           { "transient_highest", v.tap_highest },
                           { "ducking", v.ducking } };
    Json tracks = Json::array();
    for (const auto& t : clip.tracks)
    {
        const auto rows = [] (const std::vector<ClipPoint>& points) {
            Json all = Json::array();
            for (const auto& p : points)
                all.push_back (Json::array ({ p.time, p.value }));
            return all;
        };
        Json track { { "channel", t.channel } };
        if (t.is_wave) track["wave"] = true;
        if (! t.amplitude.empty()) track["amplitude"] = rows (t.amplitude);
        if (! t.sharpness.empty()) track["sharpness"] = rows (t.sharpness);
        if (! t.taps.empty())
        {
            Json taps = Json::array();
            for (const auto& p : t.taps)
                taps.push_back (Json::array ({ p.time, p.amplitude, p.sharpness }));
            track["transients"] = std::move (taps);
        }
        if (! t.phases.empty()) track["phases"] = rows (t.phases);
        tracks.push_back (std::move (track));
    }
    file["tracks"] = std::move (tracks);
    return { writeJson (file), {} };
}

}   // namespace tactus::readers
