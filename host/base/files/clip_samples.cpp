// SPDX-License-Identifier: MIT
#include "clip_samples.hpp"

#include <tactus/file/clips/clip_signal.hpp>
#include <tactus/kit/signal/clip_score.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace tactus::host
{

namespace
{
std::string columnName (const std::string& name, int channel) { return channel == 1 ? name : name + "_" + std::to_string (channel); }

Clip clipOfRows (const Table& table)
{
    return clipOf ({ .rows = static_cast<int> (table.rows()), .columns = clip_columns, .values = table.values }).clip;
}

/// The points of one column. Empty fields cannot occur; every row has a number.
std::vector<ClipPoint> pointsOf (const Table& table, std::size_t time, std::size_t column)
{
    std::vector<ClipPoint> points;
    for (std::size_t r = 0; r < table.rows(); ++r)
        points.push_back ({ table.at (r, time), table.at (r, column) });
    return points;
}
}   // namespace

Result<Clip> clipOfTable (const Table& table, const std::string& name, Messages& notes)
{
    const auto refuse = [&] (std::string id, std::string what, std::string remedy) {
        return Message::error (std::move (id), name, std::move (what), std::move (remedy));
    };
    if (table.columns == std::vector<std::string> { "kind", "track", "a", "b", "c" })
    {
        const auto rows = clipOf ({ .rows = static_cast<int> (table.rows()), .columns = clip_columns, .values = table.values });
        if (! rows.problem.empty()) return refuse ("clip/range", rows.problem, "correct the row");
        return clipOfRows (table);
    }

    auto time = table.column ("t");
    if (! time) time = table.column ("time");
    if (! time) return refuse ("clip/columns", "it has no column t", "give it columns t and amplitude or value, or the columns kind, track, a, b, c of a clip");
    Clip clip;
    for (int channel = 1; channel <= most_clip_tracks; ++channel)
    {
        const auto value = table.column (columnName ("value", channel)), amplitude = table.column (columnName ("amplitude", channel));
        if (! value && ! amplitude) break;
        auto& track = clip.tracks.emplace_back (ClipTrack { .channel = channel, .is_wave = ! amplitude });
        track.amplitude = pointsOf (table, *time, amplitude ? *amplitude : *value);
        if (const auto sharpness = table.column (columnName ("sharpness", channel))) track.sharpness = pointsOf (table, *time, *sharpness);
    }
    if (clip.tracks.empty()) return refuse ("clip/columns", "it has neither a column amplitude nor a column value", "give one of its columns this name");
    readers::scaleWaves (clip, name, notes);
    if (const auto what = problemOf (clip); ! what.empty()) return refuse ("clip/range", what, "correct the column");
    return clip;
}

RenderedClip renderClip (const Clip& clip, double rate_hz)
{
    RenderedClip made;
    std::set<int> channels;
    double duration = 0.0;
    for (const auto& t : clip.tracks)
        channels.insert (t.channel);
    std::vector<ClipScore> scores;
    for (const int channel : channels)
    {
        made.channels.push_back (channel);
        duration = std::max (duration, scores.emplace_back (clip, channel).duration());
    }
    const auto samples = static_cast<std::size_t> (std::ceil (duration * rate_hz - 1e-6));
    for (const auto& score : scores)
    {
        std::vector<ClipScore::Cursor> cursors (score.size());
        auto &value = made.value.emplace_back(), &amplitude = made.amplitude.emplace_back(), &frequency = made.frequency.emplace_back();
        for (std::size_t k = 0; k < samples; ++k)
        {
            const auto now = score (static_cast<double> (k) / rate_hz, 1.0 / rate_hz, cursors.data());
            value.push_back (now.value);
            amplitude.push_back (now.amplitude);
            frequency.push_back (now.frequency);
        }
    }
    return made;
}

}   // namespace tactus::host
