// SPDX-License-Identifier: MIT
// Reads MPEG HJIF (ISO/IEC 23090-31). Source: MPEGGroup/HapticReferenceSoftware, source/IOHaptics (licensed under BSD-3; none of its code
// is used here). Drafts called channels tracks, and gave wave bands an encoding_modality.
#include "clip_formats.hpp"

#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

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

    struct Effect
    {
        std::vector<ClipPoint> amplitude, hertz;   // at absolute times
    };

    Kind kind = Kind::wave;
    int channel = 1;
    double low = 0.0, high = 0.0;   // Hz
    bool is_smooth = false;         // a curve without corners
    std::vector<Effect> effects {};
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
        for (const auto& band : bands)
            addBand (band);
        return std::move (clip);
    }

private:
    void readPerception (const Spot& spot)
    {
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
            if (++channel_count > most_clip_channels) file.refuse (channel, "clip/too_large", "there are more than 1024 channels", "split the file");
            channel_now = perceptions_count == 1 ? static_cast<int> (file.numberOr (channel, "id", channel_count - 1.0, -1e9, 1e9)) + 1 : channel_count;
            if (channel_now < 1 || channel_now > most_clip_channels) channel_now = channel_count;
            gain = file.numberOr (channel, "gain", 1.0, -1e6, 1e6) * std::pow (10.0, exponent);
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
        band.low = file.numberOr (spot, "lower_frequency_limit", 0.0, 0.0, 1e5);
        band.high = file.numberOr (spot, "upper_frequency_limit", 0.0, 0.0, 1e5);
        if (const auto type = file.find (spot, "curve_type"); band.kind == Band::Kind::curve && type)
        {
            band.is_smooth = file.isText (spot, "curve_type", "Cubic");
            if (! band.is_smooth && ! file.isText (spot, "curve_type", "Linear"))
                file.note (*type, "clip/changed", "the curve is drawn with straight lines", "no action is needed if its points are close together");
        }
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
        const double start = file.numberOr (spot, "position", 0.0, 0.0, longest_clip_s * timescale);
        if (file.isText (spot, "effect_type", "Composite"))
            return file.note (spot, "clip/not_carried", "the composite effect is left out", "put its effects into the band");
        if (! file.isText (spot, "effect_type", "Reference")) return readKeyframes (spot, start, band);
        const auto found = library ? inLibrary (spot, *library) : std::nullopt;
        if (! found) return file.note (spot, "clip/not_carried", "the effect is left out: the library has none with its id", "correct the id");
        readKeyframes (*found, start, band);
    }

    void readKeyframes (const Spot& spot, double start, Band& band)
    {
        if (const auto base = file.find (spot, "base_signal"); base && ! file.isText (spot, "base_signal", "Sine"))
            file.note (*base, "clip/not_carried", "the signal is played as a sine", "no action is needed");
        const auto list = file.find (spot, "keyframes");
        if (! list) return file.note (spot, "clip/not_carried", "the effect has no keyframes", "remove it");
        file.list (*list);
        Band::Effect effect;
        double before = 0.0;
        for (std::size_t i = 0; i < list->json->size(); ++i)
        {
            const auto frame = ClipJson::entry (*list, i);
            file.object (frame);
            const double place = start + file.numberOr (frame, "relative_position", 0.0, 0.0, longest_clip_s * timescale), time = place / timescale;
            if (time > longest_clip_s) file.refuse (frame, "clip/range", "it is more than a day after the start", "correct it");
            if (time < before) file.refuse (frame, "clip/order", "it is before the previous keyframe", "sort the keyframes by relative_position");
            before = time;
            if (const auto v = file.find (frame, "amplitude_modulation")) effect.amplitude.push_back ({ time, amplitude (*v, band) });
            if (const auto v = file.find (frame, "frequency_modulation")) effect.hertz.push_back ({ time, file.number (*v, 0.0, 1e5) });
            if (++keyframes > budgets().numbers) file.refuse (frame, "clip/too_large", "the effects have more keyframes than the budget allows", "shorten it");
        }
        band.effects.push_back (std::move (effect));
    }

    double amplitude (const Spot& spot, const Band& band)
    {
        const double v = gain * file.number (spot), used = std::clamp (v, band.kind == Band::Kind::curve ? -1.0 : 0.0, 1.0);
        if (used != v) file.note (spot, "clip/clamped", numberText (v) + " with the gain of the channel is limited to " + numberText (used), "lower the gain");
        return used;
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
            }
            if (! known && std::ranges::any_of (bands, [&] (const Band& b) { return b.kind == kind; })) low = high = otherwise;
        };
        over (Band::Kind::wave, clip.voice.lowest, clip.voice.highest, 0.5 * (clip.voice.lowest + clip.voice.highest));
        over (Band::Kind::transient, clip.voice.tap_lowest, clip.voice.tap_highest, transient_hertz);
    }

    static double onScale (double hertz, double low, double high) { return high > low ? std::clamp ((hertz - low) / (high - low), 0.0, 1.0) : 0.5; }

    ClipTrack& trackFor (const Band& band, double start)
    {
        for (auto i = first_track; i < clip.tracks.size(); ++i)
            if (auto& t = clip.tracks[i]; t.amplitude.empty() || t.amplitude.back().time <= start)
            {
                if (! t.amplitude.empty())
                {
                    t.amplitude.push_back ({ t.amplitude.back().time, 0.0 });
                    t.amplitude.push_back ({ start, 0.0 });
                }
                return t;
            }
        if (clip.tracks.size() >= at (most_clip_tracks)) file.refuse (file.root(), "clip/too_large", "more than 256 effects sound together", "remove some");
        return clip.tracks.emplace_back (ClipTrack { .channel = band.channel, .is_wave = band.kind == Band::Kind::curve });
    }

    void addBand (const Band& band)
    {
        if (band.kind == Band::Kind::transient) return addTransients (band);
        first_track = clip.tracks.size();
        auto effects = band.effects;
        std::erase_if (effects, [] (const auto& e) { return e.amplitude.empty(); });
        std::ranges::stable_sort (effects, {}, [] (const auto& e) { return e.amplitude.front().time; });
        for (const auto& e : effects)
        {
            auto& track = trackFor (band, e.amplitude.front().time);
            if (band.is_smooth)
                addSmooth (e.amplitude, track.amplitude);
            else
                track.amplitude.insert (track.amplitude.end(), e.amplitude.begin(), e.amplitude.end());
            if (track.is_wave) continue;
            auto hertz = e.hertz;
            if (hertz.empty()) hertz.push_back ({ e.amplitude.front().time, 0.5 * (band.low + band.high) });
            for (const auto& p : hertz)
                if (track.sharpness.empty() || p.time >= track.sharpness.back().time)
                    track.sharpness.push_back ({ p.time, onScale (p.value, clip.voice.lowest, clip.voice.highest) });
        }
    }

    /// The smooth step of the standard from keyframe to keyframe, in 16 straight pieces: off by at most 0.6 % of the step.
    static void addSmooth (const std::vector<ClipPoint>& points, std::vector<ClipPoint>& out)
    {
        constexpr int pieces = 16;
        out.push_back (points.front());
        for (std::size_t i = 1; i < points.size(); ++i)
            for (int k = 1; k <= pieces; ++k)
            {
                const double s = static_cast<double> (k) / pieces;
                out.push_back (
                    { std::lerp (points[i - 1].time, points[i].time, s), std::lerp (points[i - 1].value, points[i].value, s * s * (3.0 - 2.0 * s)) });
            }
    }

    void addTransients (const Band& band)
    {
        auto& track = clip.tracks.emplace_back (ClipTrack { .channel = band.channel });
        for (const auto& e : band.effects)
            for (const auto& p : e.amplitude)
            {
                const auto f = std::ranges::find (e.hertz, p.time, &ClipPoint::time);
                const double hertz = f != e.hertz.end() ? f->value : band.high > band.low ? 0.5 * (band.low + band.high)
                                                                                          : transient_hertz;
                track.taps.push_back ({ p.time, p.value, onScale (hertz, clip.voice.tap_lowest, clip.voice.tap_highest) });
            }
        std::ranges::stable_sort (track.taps, {}, &ClipTap::time);
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
