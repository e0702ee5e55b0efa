// SPDX-License-Identifier: MIT
// Writes MPEG HJIF (ISO/IEC 23090-31) as profile Main, level 1. Source: MPEGGroup/HapticReferenceSoftware, source/IOHaptics.
#include "clip_formats.hpp"
#include "clip_tone.hpp"
#include "hjif_effect.hpp"

#include <tactus/text/json_writer.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace tactus::readers
{

namespace
{
constexpr double finest = 48000.0;   // ticks per second of the profile

long long ticks (double time, double rate) { return std::llround (time * rate); }
long long whole (double hertz) { return std::llround (hertz); }

Json band (const char* type, double low, double high)
{
    return { { "band_type", type }, { "lower_frequency_limit", whole (std::floor (low)) }, { "upper_frequency_limit", whole (std::ceil (high)) } };
}

Json effect (long long position, Json keyframes, double cycles = 0.0)
{
    Json made { { "effect_type", "Basis" }, { "position", position }, { "phase", 2.0 * std::numbers::pi * cycles }, { "base_signal", "Sine" } };
    made["keyframes"] = std::move (keyframes);
    return made;
}

/// One keyframe for each point of the envelope and of the sharpness, in order. The amplitude is held beyond its ends until the last keyframe, so
/// no keyframe may be after its last point.
Json keyframesOf (const ClipTone& tone, const ClipVoice& voice, double rate)
{
    Json frames = Json::array();
    std::size_t next = 0;
    const auto hertz = [&] (double until) {
        for (; next < tone.sharpness.size() && tone.sharpness[next].time <= until; ++next)
        {
            const auto& p = tone.sharpness[next];
            const double f = voice.lowest + p.value * (voice.highest - voice.lowest);
            frames.push_back (Json { { "relative_position", ticks (p.time, rate) - ticks (tone.from, rate) }, { "frequency_modulation", whole (f) } });
        }
    };
    for (const auto& p : tone.amplitude)
    {
        hertz (p.time);
        frames.push_back (Json { { "relative_position", ticks (p.time, rate) - ticks (tone.from, rate) }, { "amplitude_modulation", p.value } });
    }
    return frames;
}

/// One effect for each stretch that sounds.
Json tones (const ClipTrack& track, const ClipVoice& voice, double rate)
{
    Json effects = Json::array();
    const auto sweeps = ClipScore::sweepsOf (track.sharpness, track.phases, voice);
    for (const auto& tone : tonesOf (track))
    {
        const auto start = ticks (tone.from, rate);
        effects.push_back (effect (start, keyframesOf (tone, voice, rate), cyclesAt (sweeps, static_cast<double> (start) / rate)));
    }
    return effects;
}

/// Warns of points of a wave that are not on a tick. Envelopes and frequencies move too little to be felt; a wave may step at such a point.
void checkTicks (const Clip& clip, double rate, Messages& losses)
{
    constexpr double close_enough = 1e-6;
    std::size_t moved = 0;
    for (const auto& track : clip.tracks)
        for (const auto& p : track.amplitude)
            if (const double at = p.time * rate; track.is_wave && std::abs (at - std::round (at)) > close_enough) ++moved;
    if (moved > 0)
        lose (losses, "tracks",
              std::to_string (moved) + " points of waves are moved by up to half a tick of 1/" + std::to_string (std::llround (rate))
                  + " s: the finest that the format allows",
              "write a .json or .wav");
}

Json curve (const ClipTrack& track, double rate)
{
    Json frames = Json::array();
    const auto start = ticks (track.amplitude.front().time, rate);
    for (const auto& p : track.amplitude)
        frames.push_back (Json { { "relative_position", ticks (p.time, rate) - start }, { "amplitude_modulation", p.value } });
    return effect (start, std::move (frames));
}

void addTrack (Json& bands, const ClipTrack& track, const ClipVoice& voice, double rate)
{
    if (! track.amplitude.empty() && track.is_wave)
    {
        auto made = band ("Curve", 0.0, 1000.0);
        made["curve_type"] = "Linear";
        made["effects"] = Json::array ({ curve (track, rate) });
        bands.push_back (std::move (made));
    }
    else if (! track.amplitude.empty())
    {
        auto made = band ("VectorialWave", std::min (voice.lowest, voice.highest), std::max (voice.lowest, voice.highest));
        made["effects"] = tones (track, voice, rate);
        bands.push_back (std::move (made));
    }
    if (track.taps.empty()) return;
    auto made = band ("Transient", std::min (voice.tap_lowest, voice.tap_highest), std::max (voice.tap_lowest, voice.tap_highest));
    Json effects = Json::array();
    for (const auto& tap : track.taps)
    {
        const double f = voice.tap_lowest + tap.sharpness * (voice.tap_highest - voice.tap_lowest);
        Json frame { { "relative_position", 0 }, { "amplitude_modulation", tap.amplitude }, { "frequency_modulation", whole (f) } };
        effects.push_back (effect (ticks (tap.time, rate), Json::array ({ std::move (frame) })));
    }
    made["effects"] = std::move (effects);
    bands.push_back (std::move (made));
}
/// The finest rate at which no band begins just below 65536 ticks, where MPEG's own decoder writes negative positions (clip_hjif.cpp).
double rateFor (const Clip& clip)
{
    std::vector<double> begins;
    for (const auto& track : clip.tracks)
    {
        if (! track.taps.empty()) begins.push_back (track.taps.front().time);
        if (track.is_wave && ! track.amplitude.empty()) begins.push_back (track.amplitude.front().time);
        if (! track.is_wave)
            if (const auto sounding = tonesOf (track); ! sounding.empty()) begins.push_back (sounding.front().from);
    }
    constexpr double step = 100.0, coarsest = 8000.0;
    double rate = finest;
    while (rate > coarsest && std::ranges::any_of (begins, [&] (double t) { return mayBeNegative (static_cast<double> (ticks (t, rate))); }))
        rate -= step;
    return rate;
}
}   // namespace

ClipText writeHjif (const Clip& clip)
{
    ClipText made;
    const double rate = rateFor (clip);
    std::map<int, Json> channels;
    for (const auto& track : clip.tracks)
    {
        auto& channel = channels[track.channel];
        if (channel.is_null())
        {
            channel = Json { { "id", track.channel - 1 },
                             { "description", "" },
                             { "gain", 1.0 },
                             { "mixing_coefficient", mixingWeight (clip, track.channel) },
                             { "body_part_mask", 0 } };
            channel["bands"] = Json::array();
        }
        addTrack (channel["bands"], track, clip.voice, rate);
    }
    Json all = Json::array();
    for (auto& [number, channel] : channels)
        all.push_back (std::move (channel));

    checkTicks (clip, rate, made.losses);
    std::string description;
    for (const auto& [key, value] : clip.notes)
        if (key == "description")
            description = value;
        else if (! isMixingNote (key))
            lose (made.losses, "notes/" + key, "the " + key + " of the clip is left out: the format has no place for it", "keep the original file");
    if (clip.voice.ducking != 1.0) lose (made.losses, "voice", "the ducking is left out: the format has none", "draw it into the envelopes");

    Json file { { "version", "2023" }, { "profile", "Main" }, { "level", 1 }, { "date", "2023-01-01" }, { "description", description } };
    file["timescale"] = whole (rate);
    file["avatars"] = Json::array ({ Json { { "id", 1 }, { "lod", 0 }, { "type", "Vibration" } } });
    Json perception { { "id", 0 }, { "avatar_id", 1 }, { "description", "" }, { "perception_modality", "Vibrotactile" } };
    perception["reference_devices"] = Json::array();
    perception["effect_library"] = Json::array();
    perception["channels"] = std::move (all);
    file["perceptions"] = Json::array ({ std::move (perception) });
    file["syncs"] = Json::array();
    made.text = writeJson (file);
    return made;
}

}   // namespace tactus::readers
