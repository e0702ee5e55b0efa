// SPDX-License-Identifier: MIT
// Reads MPEG HJIF (ISO/IEC 23090-31). Source: MPEGGroup/HapticReferenceSoftware, source/IOHaptics (licensed under BSD-3; none of its code
// is used here). Drafts called channels tracks, and gave wave bands an encoding_modality.
#include "clip_formats.hpp"
#include "hjif_effect.hpp"

#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace tactus::readers
{

namespace
{
constexpr double transient_hertz = 2.0 / 0.022;   // two cycles in 22 ms

/// A band of one channel, before its frequencies are put on the scale of the clip.
struct Band
{
    enum class Kind
    {
        wave,
        curve,
        transient
    };

    Kind kind = Kind::wave;
    int channel = 1;
    double low = 0.0, high = 0.0;                                // Hz
    double earliest = std::numeric_limits<double>::infinity();   // ticks, of the effects so far
    HjifCurve curve = HjifCurve::cubic;
    std::vector<HjifEffect> effects {};
};

class HjifReader
{
public:
    explicit HjifReader (ClipJson& f) : file (f) {}

    Clip read()
    {
        const auto& root = file.root();
        timescale = file.numberOr (root, "timescale", 1000.0, 1.0, 1e9);
        if (const auto text = file.find (root, "description"); text && text->json->is_string() && ! text->json->asString().empty())
            clip.notes.emplace_back ("description", text->json->asString());
        file.noteOthers (root, { "version", "profile", "level", "date", "description", "timescale", "avatars", "perceptions", "syncs" });
        const auto isLonger = [] (const std::optional<Spot>& list, std::size_t most) { return list && list->json->is_array() && list->json->size() > most; };
        if (const auto avatars = file.find (root, "avatars"); isLonger (avatars, 0))
        {
            const auto first = ClipJson::entry (*avatars, 0);
            if (isLonger (avatars, 1) || file.find (first, "mesh")) leaveOut (*avatars, "the avatars are", "which avatar feels it, and where");
        }
        if (const auto syncs = file.find (root, "syncs"); syncs && syncs->json->is_array())
            for (std::size_t i = 0; i < syncs->json->size(); ++i)
            {
                const auto sync = ClipJson::entry (*syncs, i);   // one at 0 s says nothing
                if (const auto at = file.find (sync, "timestamp"); at && at->json->is_number() && at->json->get<double>() != 0.0)
                    leaveOut (sync, "the sync point is", "when other media begin");
            }
        const auto perceptions = file.need (root, "perceptions");
        file.list (perceptions);
        perceptions_count = perceptions.json->size();
        for (std::size_t i = 0; i < perceptions.json->size(); ++i)
        {
            const auto perception = ClipJson::entry (perceptions, i);
            file.object (perception);
            readPerception (perception);
        }
        scale();
        for (auto& band : bands)
            addBand (band);
        return std::move (clip);
    }

private:
    /// Notes a part of the file for which a clip has no place.
    void leaveOut (const Spot& spot, const std::string& what, const std::string& of)
    {
        file.note (spot, "clip/not_carried", what + " left out: a clip does not say " + of, "keep the original file");
    }

    /// Notes those of the keys that are there, and say something.
    void leaveOutKeys (const Spot& object, std::initializer_list<std::string_view> keys, const std::string& of)
    {
        for (const auto& key : keys)
            if (const auto found = file.find (object, key))
            {
                const auto& v = *found->json;
                const bool is_empty = (v.is_number() && v.get<double>() == 0.0) || (v.is_string() && v.asString().empty()) || (v.is_array() && v.size() == 0)
                                      || v.is_null();
                if (! is_empty) leaveOut (*found, quote (key) + " is", of);
            }
    }

    void readPerception (const Spot& spot)
    {
        file.noteOthers (spot, { "id", "avatar_id", "description", "perception_modality", "priority", "unit_exponent", "perception_unit_exponent",
                                 "effect_semantic_scheme", "reference_devices", "effect_library", "channels", "tracks" });
        leaveOutKeys (spot, { "reference_devices" }, "on which device it was made");
        leaveOutKeys (spot, { "priority" }, "what matters more");
        leaveOutKeys (spot, { "description" }, "what its parts are called");
        if (const auto modality = file.find (spot, "perception_modality"); modality && modality->json->is_string())
        {
            const auto& name = modality->json->asString();
            if (name == "Texture" || name == "Vibrotactile Texture" || name == "Stiffness" || name == "Friction")
                file.note (*modality, "clip/not_carried", quote (name) + " is laid out along a path; its positions are read as times",
                           "play it with drive position, and set the length of the path");
            else if (name != "Vibrotactile" && name != "Vibration" && name != "Acceleration" && name != "Force" && name != "Kinesthetic" && name != "Other")
                file.note (*modality, "clip/not_carried", quote (name) + " is read as a vibration", "no action is needed, or leave this perception out");
        }
        const double exponent = file.numberOr (spot, "perception_unit_exponent", 0.0, -12.0, 12.0);
        const auto library = file.find (spot, "effect_library");
        auto channels = file.find (spot, "channels");
        if (! channels && (channels = file.find (spot, "tracks")))
            file.note (*channels, "clip/habit", "channels are called tracks, as in the drafts of the standard", "no action is needed");
        if (! channels) file.refuse (spot, "clip/missing", "there is no 'channels'", "add it, or check its spelling");
        file.list (*channels);
        for (std::size_t i = 0; i < channels->json->size(); ++i)
        {
            const auto channel = ClipJson::entry (*channels, i);
            file.object (channel);
            file.noteOthers (channel, { "id", "description", "gain", "mixing_coefficient", "mixing_weight", "body_part_mask", "priority", "reference_device_id",
                                        "frequency_sampling", "sample_count", "direction", "actuator_resolution", "body_part_target", "actuator_target",
                                        "vertices", "bands" });
            leaveOutKeys (channel, { "body_part_mask", "body_part_target", "actuator_target", "actuator_resolution", "vertices" }, "where it is felt");
            leaveOutKeys (channel, { "direction" }, "in which direction it pushes");
            leaveOutKeys (channel, { "priority" }, "what matters more");
            leaveOutKeys (channel, { "description" }, "what its parts are called");
            if (++channel_count > most_clip_channels) file.refuse (channel, "clip/too_large", "there are more than 1024 channels", "split the file");
            channel_now = perceptions_count == 1 ? static_cast<int> (file.numberOr (channel, "id", channel_count - 1.0, -1e9, 1e9)) + 1 : channel_count;
            if (channel_now < 1 || channel_now > most_clip_channels) channel_now = channel_count;
            gain = file.numberOr (channel, "gain", 1.0, -1e6, 1e6) * std::pow (10.0, exponent);
            for (const auto* key : { "mixing_coefficient", "mixing_weight" })
                if (const auto weight = file.find (channel, key); weight && file.number (*weight, 0.0, heaviest_mixing) != 1.0)
                    setMixingWeight (clip, channel_now, file.number (*weight));
            const auto all = file.find (channel, "bands");
            if (! all) continue;
            file.list (*all);
            for (std::size_t k = 0; k < all->json->size(); ++k)
            {
                const auto band = ClipJson::entry (*all, k);
                file.object (band);
                readBand (band, library);
            }
        }
    }

    /// The kind of a band; empty if it cannot be read.
    std::optional<Band::Kind> kindOf (const Spot& spot)
    {
        const auto type = file.need (spot, "band_type");
        const auto& name = file.text (type);
        if (name == "VectorialWave") return Band::Kind::wave;
        if (name == "Curve") return Band::Kind::curve;
        if (name == "Transient") return Band::Kind::transient;
        if (name == "Wave")
        {
            file.note (type, "clip/habit", "the band is a Wave with an encoding_modality, as in the drafts of the standard", "no action is needed");
            if (! file.isText (spot, "encoding_modality", "Wavelet")) return Band::Kind::wave;
        }
        else if (name != "WaveletWave")
            file.refuse (type, "clip/range", "there is no band type " + quote (name), "types are Transient, Curve, VectorialWave and WaveletWave");
        file.note (type, "clip/not_carried", "the wavelet band is left out: it is not decoded", "convert it to a WAV with the software of MPEG");
        return {};
    }

    void readBand (const Spot& spot, const std::optional<Spot>& library)
    {
        const auto kind = kindOf (spot);
        if (! kind) return;
        Band band { .kind = *kind, .channel = channel_now };
        file.noteOthers (spot, { "band_type", "lower_frequency_limit", "upper_frequency_limit", "curve_type", "block_length", "window_length",
                                 "encoding_modality", "priority", "effects" });
        leaveOutKeys (spot, { "priority" }, "what matters more");
        band.low = file.numberOr (spot, "lower_frequency_limit", 0.0, 0.0, 1e5);
        band.high = file.numberOr (spot, "upper_frequency_limit", 0.0, 0.0, 1e5);
        if (const auto type = file.find (spot, "curve_type"); band.kind == Band::Kind::curve && type) band.curve = curveType (spot, *type);
        const auto effects = file.need (spot, "effects");
        file.list (effects);
        for (std::size_t i = 0; i < effects.json->size(); ++i)
        {
            const auto effect = ClipJson::entry (effects, i);
            file.object (effect);
            readEffect (effect, library, band);
        }
        if (! band.effects.empty()) bands.push_back (std::move (band));
    }

    HjifCurve curveType (const Spot& spot, const Spot& type)
    {
        if (file.isText (spot, "curve_type", "Linear")) return HjifCurve::linear;
        if (file.isText (spot, "curve_type", "Akima")) return HjifCurve::akima;
        if (file.isText (spot, "curve_type", "Cubic") || file.isText (spot, "curve_type", "Unknown")) return HjifCurve::cubic;
        const auto name = type.json->is_string() ? quote (type.json->asString()) : std::string ("its type");
        file.note (type, "clip/changed", "the curve is drawn with straight lines: " + name + " is not decoded",
                   "no action is needed if its points are close together");
        return HjifCurve::linear;
    }

    /// The effect of the library with this id.
    std::optional<Spot> inLibrary (const Spot& effect, const Spot& library) const
    {
        const auto id = file.find (effect, "id");
        if (! id || ! library.json->is_array()) return {};
        for (std::size_t i = 0; i < library.json->size(); ++i)
            if (const auto found = ClipJson::entry (library, i); found.json->is_object())
                if (const auto other = file.find (found, "id"); other && *other->json == *id->json) return found;
        return {};
    }

    void readEffect (const Spot& spot, const std::optional<Spot>& library, Band& band)
    {
        double start = file.numberOr (spot, "position", 0.0, -longest_clip_s * timescale, longest_clip_s * timescale);
        if (mayBeNegative (start) && ! (band.earliest < start))
            start = wrapped (spot, "position", start);
        else
            band.earliest = std::min (band.earliest, start);
        file.noteOthers (spot, { "effect_type", "id", "position", "phase", "base_signal", "semantic", "semantic_keywords", "priority", "keyframes", "timeline",
                                 "composition", "wavelet_stream" });
        leaveOutKeys (spot, { "semantic", "semantic_keywords" }, "what it means");
        leaveOutKeys (spot, { "priority" }, "what matters more");
        if (file.isText (spot, "effect_type", "Composite") || file.isText (spot, "effect_type", "Timeline"))
            return file.note (spot, "clip/not_carried", "the composite effect is left out", "put its effects into the band");
        if (! file.isText (spot, "effect_type", "Reference")) return readKeyframes (spot, start, band);
        const auto found = library ? inLibrary (spot, *library) : std::nullopt;
        if (! found) return file.note (spot, "clip/not_carried", "the effect is left out: the library has none with its id", "correct the id");
        readKeyframes (*found, start, band);
    }

    /// MPEG's own decoder writes positions before its packet as unsigned numbers of 16 bits: 65534 is -2. The effects of a band are in order, so a position
    /// after another is really as large.
    double wrapped (const Spot& spot, std::string_view key, double ticks)
    {
        const double meant = ticks - 65536.0;
        file.note (*file.find (spot, key), "clip/changed", numberText (ticks) + " is read as " + numberText (meant) + ": a negative number of 16 bits",
                   "correct it if it is meant as it is written");
        return meant;
    }

    /// The positions of the keyframes, relative to the effect. They never decrease.
    std::vector<double> positionsOf (const Spot& list)
    {
        std::vector<double> ticks;
        for (std::size_t i = 0; i < list.json->size(); ++i)
        {
            const auto frame = ClipJson::entry (list, i);
            file.object (frame);
            file.noteOthers (frame, { "relative_position", "amplitude_modulation", "frequency_modulation" });
            ticks.push_back (file.numberOr (frame, "relative_position", 0.0, -longest_clip_s * timescale, longest_clip_s * timescale));
            if (++keyframes > budgets().numbers) file.refuse (frame, "clip/too_large", "the effects have more keyframes than the budget allows", "shorten it");
        }
        for (std::size_t i = ticks.size(); i-- > 0;)
        {
            const auto frame = ClipJson::entry (list, i);
            const bool goes_back = i + 1 < ticks.size() && ticks[i] > ticks[i + 1];
            const bool is_wrap = ticks[i] >= 32768.0 && ticks[i] < 65536.0 && goes_back && ticks[i] - 65536.0 <= ticks[i + 1];
            if (is_wrap || (i == 0 && ticks.size() == 1 && mayBeNegative (ticks[i])))
                ticks[i] = wrapped (frame, "relative_position", ticks[i]);
            else if (goes_back)
            {
                const auto later = ClipJson::entry (list, i + 1);
                file.refuse (later, "clip/order", "it is before the previous keyframe", "sort the keyframes by relative_position");
            }
        }
        return ticks;
    }

    HjifEffect::Base baseOf (const Spot& spot)
    {
        using Base = HjifEffect::Base;
        const auto base = file.find (spot, "base_signal");
        if (! base) return Base::sine;
        for (const auto& [name, value] : { std::pair { "Sine", Base::sine }, std::pair { "Square", Base::square }, std::pair { "Triangle", Base::triangle },
                                           std::pair { "SawToothUp", Base::saw_up }, std::pair { "SawToothDown", Base::saw_down } })
            if (file.isText (spot, "base_signal", name)) return value;
        file.refuse (*base, "clip/range", "there is no such base signal", "base signals are Sine, Square, Triangle, SawToothUp and SawToothDown");
    }

    void readKeyframes (const Spot& spot, double start, Band& band)
    {
        const auto list = file.find (spot, "keyframes");
        if (! list) return file.note (spot, "clip/not_carried", "the effect has no keyframes", "remove it");
        file.list (*list);
        if (list->json->size() == 0) return file.note (*list, "clip/not_carried", "the effect has no keyframes", "remove it");
        const auto ticks = positionsOf (*list);
        const double first = std::min (0.0, ticks.front());   // a keyframe before its effect: the effect begins there
        HjifEffect effect { .timescale = timescale, .start = start + first, .length = ticks.back() - first, .base = baseOf (spot) };
        const double radians = file.numberOr (spot, "phase", 0.0, -1e6, 1e6), cycles = radians / (2.0 * std::numbers::pi);
        effect.phase = cycles - std::floor (cycles);
        if (effect.seconds (effect.length) > longest_clip_s) file.refuse (*list, "clip/range", "it is more than a day after the start", "correct it");
        for (std::size_t i = 0; i < ticks.size(); ++i)
        {
            const auto frame = ClipJson::entry (*list, i);
            const double time = ticks[i] - first;
            if (const auto v = file.find (frame, "amplitude_modulation")) effect.amplitude.push_back ({ time, amplitude (*v) });
            if (const auto v = file.find (frame, "frequency_modulation")) effect.hertz.push_back ({ time, frequency (*v, band) });
        }
        if (band.kind != Band::Kind::transient && ! (effect.start + effect.length > std::max (0.0, effect.start)))
            return file.note (spot, "clip/not_carried", "the effect is left out: it has no duration after 0 s", "give it a keyframe at its end");
        if (band.kind == Band::Kind::wave)
        {
            // An effect without an amplitude plays at 1, times the gain of the channel.
            if (effect.amplitude.empty() && gain != 1.0) effect.amplitude.push_back ({ 0.0, limited (spot, gain) });
            if (effect.isSilent())
                return file.note (spot, "clip/not_carried", "the effect is left out: without a frequency, or at an amplitude of 0, it is silent",
                                  "give its keyframes a frequency_modulation");
        }
        else if (effect.amplitude.empty())
            return file.note (spot, "clip/not_carried", "the effect is left out: none of its keyframes has an amplitude", "give them an amplitude_modulation");
        band.effects.push_back (std::move (effect));
    }

    double limited (const Spot& spot, double v)
    {
        const double used = std::clamp (v, -1.0, 1.0);
        if (used != v) file.note (spot, "clip/clamped", numberText (v) + " with the gain of the channel is limited to " + numberText (used), "lower the gain");
        return used;
    }

    double amplitude (const Spot& spot) { return limited (spot, gain * file.number (spot)); }

    double frequency (const Spot& spot, const Band& band)
    {
        const double hertz = file.number (spot, 0.0, 1e5);
        if (band.kind == Band::Kind::transient && std::abs (hertz - transient_hertz) > 1.0)
            file.note (spot, "clip/changed",
                       "the transient is two cycles of " + numberText (hertz) + " Hz; MPEG's own software plays two cycles of 90.9 Hz instead",
                       "no action is needed");
        if (band.kind == Band::Kind::wave && band.high > band.low && (hertz < band.low || hertz > band.high))
            file.note (spot, "clip/changed", numberText (hertz) + " Hz is outside the limits of its band; it is played as it is",
                       "correct the limits of the band");
        return hertz;
    }

    /// Chooses what 0 and 1 mean, so that all frequencies are between them.
    void scale()
    {
        const auto over = [&] (Band::Kind kind, double& low, double& high, double otherwise) {
            bool known = false;
            const auto include = [&] (double hertz) {
                if (! (hertz >= 0.1)) return;
                low = known ? std::min (low, hertz) : hertz;
                high = known ? std::max (high, hertz) : hertz;
                known = true;
            };
            for (const auto& b : bands)
            {
                if (b.kind != kind) continue;
                include (b.low);
                include (b.high);
                for (const auto& e : b.effects)
                    for (const auto& p : e.hertz)
                        include (p.value);
                if (kind == Band::Kind::transient) include (otherwise);   // of keyframes without a frequency
            }
        };
        over (Band::Kind::wave, clip.voice.lowest, clip.voice.highest, 0.5 * (clip.voice.lowest + clip.voice.highest));
        over (Band::Kind::transient, clip.voice.tap_lowest, clip.voice.tap_highest, transient_hertz);
    }

    static double onScale (double hertz, double low, double high) { return high > low ? std::clamp ((hertz - low) / (high - low), 0.0, 1.0) : 0.5; }

    ClipTrack& trackFor (const Band& band, double start, bool is_wave)
    {
        for (auto i = first_track; i < clip.tracks.size(); ++i)
            if (auto& t = clip.tracks[i]; t.is_wave == is_wave && (t.amplitude.empty() || t.amplitude.back().time <= start))
            {
                if (! t.amplitude.empty() && t.amplitude.back().time < start)
                {
                    t.amplitude.push_back ({ t.amplitude.back().time, 0.0 });
                    t.amplitude.push_back ({ start, 0.0 });
                }
                return t;
            }
        if (clip.tracks.size() >= at (most_clip_tracks)) file.refuse (file.root(), "clip/too_large", "more than 256 effects sound together", "remove some");
        return clip.tracks.emplace_back (ClipTrack { .channel = band.channel, .is_wave = is_wave });
    }

    void addBand (Band& band)
    {
        first_track = clip.tracks.size();
        if (band.kind == Band::Kind::transient) return addTransients (band);
        std::ranges::stable_sort (band.effects, {}, &HjifEffect::start);
        for (const auto& e : band.effects)
            if (band.kind == Band::Kind::curve)
                addWave (band, curveOf (e, band.curve));
            else if (e.isTone())
                addTone (band, e);
            else
                addWave (band, e.wave());
    }

    void addWave (const Band& band, const std::vector<ClipPoint>& points)
    {
        if (points.empty()) return;
        auto& track = trackFor (band, points.front().time, true);
        track.amplitude.insert (track.amplitude.end(), points.begin(), points.end());
        if ((keyframes += static_cast<double> (points.size())) > budgets().numbers)
            file.refuse (file.root(), "clip/too_large", "the effects make more points than the budget allows", "shorten it");
    }

    void addTone (const Band& band, const HjifEffect& effect)
    {
        const auto stretches = effect.stretches();
        if (stretches.empty()) return;
        const auto& first = stretches.front();
        auto& track = trackFor (band, first.from, false);
        const auto sharpness = [&] (double hertz) { return onScale (hertz, clip.voice.lowest, clip.voice.highest); };
        const auto add = [] (std::vector<ClipPoint>& points, ClipPoint p) {
            if (points.empty() || points.back() != p) points.push_back (p);
        };
        if (first.from > 0.0 || first.cycles != 0.0) track.phases.push_back ({ first.from, first.cycles });
        for (const auto& s : stretches)
        {
            add (track.amplitude, { s.from, std::clamp (s.a, 0.0, 1.0) });
            add (track.amplitude, { s.to, std::clamp (s.b, 0.0, 1.0) });
            add (track.sharpness, { s.from, sharpness (s.hertz) });
            add (track.sharpness, { s.to, sharpness (s.hertz_end) });
        }
    }

    void addTransients (const Band& band)
    {
        ClipTrack taps { .channel = band.channel };
        for (const auto& e : band.effects)
            for (const auto& p : e.amplitude)
            {
                const auto f = std::ranges::find (e.hertz, p.time, &ClipPoint::time);
                const double hertz = f != e.hertz.end() && f->value >= 0.1 ? f->value : transient_hertz, time = e.seconds (p.time);
                if (p.value >= 0.0 && time >= 0.0)
                    taps.taps.push_back ({ time, p.value, onScale (hertz, clip.voice.tap_lowest, clip.voice.tap_highest) });
                else   // upside down, or cut off by the start
                    addWave (
                        band,
                        HjifEffect {
                            .timescale = 1.0, .start = time, .length = 2.0 / hertz, .amplitude = { { 0.0, p.value } }, .hertz = { { 0.0, hertz } } }
                            .wave());
            }
        std::ranges::stable_sort (taps.taps, {}, &ClipTap::time);
        if (! taps.taps.empty()) clip.tracks.push_back (std::move (taps));
    }

    ClipJson& file;
    Clip clip;
    std::vector<Band> bands;
    double timescale = 1000.0, gain = 1.0, keyframes = 0.0;
    int channel_count = 0, channel_now = 1;
    std::size_t perceptions_count = 0;
    std::size_t first_track = 0;   // of the band
};
}   // namespace

Clip readHjif (ClipJson& file) { return HjifReader (file).read(); }

}   // namespace tactus::readers
