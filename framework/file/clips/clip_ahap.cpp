// SPDX-License-Identifier: MIT
// Reads Apple AHAP. Sources: developer.apple.com, "Representing haptic patterns in AHAP files"; the scale of intensity and sharpness is
// that of Meta's converter: amplitude = intensity squared, and frequency = sharpness squared, except for transients
// (facebook/meta-haptics-sdk, core/haptic_data, MIT).
#include "clip_formats.hpp"

#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace tactus::readers
{

namespace
{
/// A value that curves and parameters change while a pattern plays. Linear between its points, constant before and after them.
struct Control
{
    double initial = 0.0;
    std::vector<std::vector<ClipPoint>> curves;
    std::vector<ClipPoint> points;

    /// Joins the curves. A later one cuts off an earlier one.
    void join()
    {
        std::ranges::stable_sort (curves, {}, [] (const auto& c) { return c.front().time; });
        for (const auto& curve : curves)
        {
            const double start = curve.front().time, held = points.empty() ? initial : at (start);
            while (! points.empty() && points.back().time > start)
                points.pop_back();
            points.push_back ({ start, held });
            points.insert (points.end(), curve.begin(), curve.end());
        }
    }

    double at (double t) const
    {
        const auto after = std::ranges::upper_bound (points, t, {}, &ClipPoint::time);
        if (after == points.begin()) return initial;
        if (after == points.end()) return points.back().value;
        const auto& a = *(after - 1);
        return a.value + (after->value - a.value) * (t - a.time) / (after->time - a.time);
    }
};

struct Event
{
    double time = 0.0, duration = 0.0, intensity = 1.0, sharpness = 0.5;
    double attack = 0.0, decay = 0.0, release = 0.0;   // s
    bool is_sustained = true;

    bool hasShape() const { return attack > 0.0 || release > 0.0 || ! is_sustained; }

    /// The gain of its intensity: rises within the attack, falls within the decay unless it is sustained, and falls within the release at its end.
    double shape (double since) const
    {
        double gain = attack > 0.0 ? std::min (1.0, since / attack) : 1.0;
        if (! is_sustained && since >= attack) gain = decay > 0.0 ? std::max (0.0, 1.0 - (since - attack) / decay) : 0.0;
        if (release > 0.0) gain *= std::clamp ((duration - since) / release, 0.0, 1.0);
        return gain;
    }
};

/// A recording that is played within an event.
struct Sound
{
    Event event {};
    const Signal* signal = nullptr;
};

class AhapReader
{
public:
    AhapReader (ClipJson& f, const ReadSound& r, ClipSounds& s) : file (f), read_sound (r), sounds (s)
    {
        intensity.initial = 1.0;
        volume.initial = 1.0;
    }

    Clip read()
    {
        const auto& root = file.root();
        const auto pattern = file.need (root, "Pattern");
        file.list (pattern);
        file.noteOthers (root, { "Version", "Metadata", "Pattern" });
        for (std::size_t i = 0; i < pattern.json->size(); ++i)
        {
            const auto entry = ClipJson::entry (pattern, i);
            file.object (entry);
            file.noteOthers (entry, { "Event", "Parameter", "ParameterCurve" });
            const auto event = file.find (entry, "Event"), parameter = file.find (entry, "Parameter"), curve = file.find (entry, "ParameterCurve");
            if (event) readEvent (*event);
            if (parameter) readParameter (*parameter);
            if (curve) readCurve (*curve);
            if (! event && ! parameter && ! curve)
                file.refuse (entry, "clip/missing", "it is neither an Event, nor a Parameter, nor a ParameterCurve", "correct or remove it");
        }
        if (const auto data = file.find (root, "Metadata"))
        {
            for (const auto& [key, value] : data->json->items())
                if (value.is_string())
                    clip.notes.emplace_back (lower (key), value.asString());
                else
                    file.note ({ &value, &*data, key }, "clip/not_carried", "the metadata " + quote (key) + " are left out: a clip holds texts only",
                               "keep the original file");
        }
        intensity.join();
        sharpness.join();
        volume.join();
        makeTracks();
        return std::move (clip);
    }

private:
    static std::string lower (std::string text)
    {
        for (char& c : text)
            if (c >= 'A' && c <= 'Z') c = static_cast<char> (c - 'A' + 'a');
        return text;
    }

    /// A number that Apple's engine limits to its range.
    double limited (const Spot& spot, double min, double max)
    {
        const double v = file.number (spot), used = std::clamp (v, min, max);
        if (used != v)
            file.note (spot, "clip/clamped", numberText (v) + " is limited to " + numberText (used), "correct it, to be sure of what other programs do");
        return used;
    }

    double timeOf (const Spot& spot)
    {
        const auto time = file.find (spot, "Time");
        return time ? limited (*time, 0.0, longest_clip_s) : 0.0;
    }

    void readEvent (const Spot& spot)
    {
        const auto type = file.need (spot, "EventType");
        const auto& kind = file.text (type);
        const bool is_tap = kind == "HapticTransient";
        file.noteOthers (spot, { "Time", "EventType", "EventDuration", "EventParameters", "EventWaveformPath", "EventWaveformUseVolumeEnvelope",
                                 "EventWaveformLoopEnabled" });
        if (kind == "AudioContinuous") return leaveOut (spot, type, "a clip holds recordings, and this is a tone of the phone");
        if (kind == "AudioCustom") return readSound (spot, type);
        if (! is_tap && kind != "HapticContinuous")
            file.refuse (type, "clip/range", "there is no event type " + quote (kind),
                         "types are HapticTransient, HapticContinuous, AudioContinuous and AudioCustom");
        Event event { .time = timeOf (spot) };
        const auto duration = is_tap ? std::nullopt : file.find (spot, "EventDuration");
        if (duration) event.duration = limited (*duration, 0.0, 30.0);
        if (! is_tap && ! (event.duration > 0.0))
            return file.note (spot, "clip/not_carried",
                              std::string ("the continuous event is left out: ") + (duration ? "its EventDuration is 0" : "it has no EventDuration"),
                              "give it one, in seconds");
        readEventParameters (spot, event, is_tap ? Kind::tap : Kind::tone);
        (is_tap ? taps : events).push_back (event);
    }

    /// The sound of an event is left out, for a reason that is a part of a sentence.
    void leaveOut (const Spot& event, const Spot& type, const std::string& why)
    {
        const auto path = file.find (event, "EventWaveformPath");
        file.note (type, "clip/not_carried",
                   "the sound " + (path && path->json->is_string() ? quote (path->json->asString()) : "event") + " is left out: " + why,
                   "play it alongside the clip");
    }

    /// A recording that the phone plays with the pattern. It sounds on channels of its own, after that of the vibration.
    void readSound (const Spot& spot, const Spot& type)
    {
        const auto path = file.find (spot, "EventWaveformPath");
        if (! path || ! path->json->is_string()) return leaveOut (spot, type, "it has no EventWaveformPath");
        if (! read_sound) return leaveOut (spot, type, "sounds are not read here");
        const auto& name = path->json->asString();
        auto known = sounds.find (name);
        if (known == sounds.end())
        {
            auto made = read_sound (name);
            if (! made) return leaveOut (spot, type, made.error().text);
            if (made->channels.empty() || made->channels.front().empty() || ! (made->rate_hz > 0.0)) return leaveOut (spot, type, "it has no samples");
            known = sounds.emplace (name, std::move (*made)).first;
            countNumbers (static_cast<double> (known->second.channels.size() * known->second.channels.front().size()));
        }
        const auto& signal = known->second;
        const double whole = static_cast<double> (signal.channels.front().size()) / signal.rate_hz;
        Sound sound { .event = { .time = timeOf (spot), .duration = whole }, .signal = &signal };
        const auto isTrue = [&] (std::string_view key, bool otherwise) {
            const auto value = file.find (spot, key);
            return value && value->json->is_boolean() ? value->json->get<bool>() : otherwise;
        };
        const bool loops = isTrue ("EventWaveformLoopEnabled", false), has_shape = isTrue ("EventWaveformUseVolumeEnvelope", true);
        if (const auto duration = file.find (spot, "EventDuration"))
            if (const double wanted = limited (*duration, 0.0, longest_clip_s); wanted > 0.0)
                sound.event.duration = loops ? wanted : std::min (wanted, whole);
        if (loops && sound.event.duration == whole)
            file.note (spot, "clip/changed", "the sound loops without an EventDuration; it is played once", "give it an EventDuration, in seconds");
        sound.event.intensity = 1.0;
        readEventParameters (spot, sound.event, has_shape ? Kind::sound : Kind::bare_sound);
        countNumbers (sound.event.duration * signal.rate_hz * static_cast<double> (signal.channels.size()));
        played.push_back (sound);
    }

    void countNumbers (double more)
    {
        if ((numbers += more) > budgets().numbers) tooLarge();
    }

    /// Kind of an event: what its parameters act on.
    enum class Kind
    {
        tap,
        tone,
        sound,
        bare_sound   ///< without an attack, decay and release
    };

    void readEventParameters (const Spot& spot, Event& event, Kind kind)
    {
        const auto list = file.find (spot, "EventParameters");
        if (! list) return;
        file.list (*list);
        for (std::size_t i = 0; i < list->json->size(); ++i)
        {
            const auto entry = ClipJson::entry (*list, i);
            file.noteOthers (entry, { "ParameterID", "ParameterValue" });
            readEventParameter (entry, event, kind);
        }
        if (event.hasShape())
            file.note (spot, "clip/changed",
                       "its attack, decay and release are straight lines of as many seconds within its duration: Apple does not publish their shape",
                       "draw them into a curve of HapticIntensityControl");
    }

    void readEventParameter (const Spot& spot, Event& event, Kind kind)
    {
        const auto id = file.need (spot, "ParameterID");
        const auto& name = file.text (id);
        const auto value = file.find (spot, "ParameterValue");
        if (! value) return file.note (spot, "clip/habit", quote (name) + " has no ParameterValue; its default is used", "give it one");
        const bool is_sound = kind == Kind::sound || kind == Kind::bare_sound, has_shape = kind == Kind::tone || kind == Kind::sound;
        if (name == (is_sound ? "AudioVolume" : "HapticIntensity"))
            event.intensity = limited (*value, 0.0, 1.0);
        else if (name == "HapticSharpness" && ! is_sound)
            event.sharpness = limited (*value, 0.0, 1.0);
        else if (name == "Sustained" && has_shape)
            event.is_sustained = limited (*value, 0.0, 1.0) >= 0.5;
        else if (name == "AttackTime" && has_shape)
            event.attack = limited (*value, 0.0, 1.0);
        else if (name == "DecayTime" && has_shape)
            event.decay = limited (*value, 0.0, 1.0);
        else if (name == "ReleaseTime" && has_shape)
            event.release = limited (*value, 0.0, 1.0);
        else if (const double v = file.number (*value); v != neutral (name, is_sound))
            file.note (spot, "clip/not_carried", quote (name) + " of " + numberText (v) + " is left out",
                       is_sound ? "change the recording itself" : "draw it into a curve of HapticIntensityControl");
    }

    /// The value of a parameter that changes nothing; NaN if every value would change something.
    static double neutral (const std::string& name, bool is_sound)
    {
        if (name == "Sustained" || (is_sound && name == "AudioBrightness")) return 1.0;
        if (is_sound && (name == "AudioPan" || name == "AudioPitch")) return 0.0;
        return std::numeric_limits<double>::quiet_NaN();
    }

    Control* controlOf (const Spot& spot)
    {
        const auto id = file.need (spot, "ParameterID");
        const auto& name = file.text (id);
        if (name == "HapticIntensityControl") return &intensity;
        if (name == "HapticSharpnessControl") return &sharpness;
        if (name == "AudioVolumeControl") return &volume;
        file.note (id, "clip/not_carried", "changes of " + quote (name) + " are left out",
                   "no action is needed if it is of a sound; else draw it into a curve of HapticIntensityControl");
        return nullptr;
    }

    double controlValue (const Spot& spot, const Control& control)
    {
        const auto value = file.find (spot, "ParameterValue");
        if (! value)
        {
            file.note (spot, "clip/habit", "there is no ParameterValue; its default is used", "give it one");
            return control.initial;
        }
        return limited (*value, &control == &sharpness ? -1.0 : 0.0, 1.0);
    }

    void readParameter (const Spot& spot)
    {
        file.noteOthers (spot, { "ParameterID", "Time", "ParameterValue" });
        if (auto* control = controlOf (spot)) control->curves.push_back ({ { timeOf (spot), controlValue (spot, *control) } });
    }

    void readCurve (const Spot& spot)
    {
        file.noteOthers (spot, { "ParameterID", "Time", "ParameterCurveControlPoints" });
        auto* control = controlOf (spot);
        if (control == nullptr) return;
        const auto list = file.need (spot, "ParameterCurveControlPoints");
        file.list (list);
        const double start = timeOf (spot);
        std::vector<ClipPoint> curve;
        for (std::size_t i = 0; i < list.json->size(); ++i)
        {
            const auto point = ClipJson::entry (list, i);
            file.noteOthers (point, { "Time", "ParameterValue" });
            const double time = start + timeOf (point);
            if (! curve.empty() && time < curve.back().time)
                file.refuse (point, "clip/order", "its time is before that of the previous point", "sort the points by time");
            curve.push_back ({ time, controlValue (point, *control) });
        }
        if (! curve.empty()) control->curves.push_back (std::move (curve));
    }

    /// The squares of a straight line as straight pieces, off by at most 0.01 %. Their mean is that of the squares, so that the phase of a tone
    /// does not drift.
    static void addSquares (std::vector<ClipPoint>& out, double from, double to, double a, double b)
    {
        constexpr double off = 1e-4;
        const int pieces = std::max (1, static_cast<int> (std::ceil (std::abs (b - a) / (2.0 * std::sqrt (off)))));
        const double width = (b - a) / pieces, above = width * width / 6.0;   // how far the pieces are above the squares, on average
        for (int i = 0; i <= pieces; ++i)
        {
            const double share = static_cast<double> (i) / pieces, v = std::lerp (a, b, share);
            const ClipPoint p { std::lerp (from, to, share), std::max (0.0, v * v - above) };
            if (out.empty() || out.back() != p) out.push_back (p);
        }
    }

    /// The same of a line times the shape of an event.
    static void addShaped (std::vector<ClipPoint>& out, double from, double to, double a, double b, const Event& e)
    {
        constexpr int pieces = 64;
        std::vector<double> corners { from, to };
        for (const double since : { e.attack, e.attack + e.decay, e.duration - e.release })
            if (const double t = e.time + since; t > from && t < to) corners.push_back (t);
        std::ranges::sort (corners);
        for (std::size_t i = 0; i + 1 < corners.size(); ++i)
            for (int k = 0; k <= pieces; ++k)
            {
                // Just within its ends, where the shape may step.
                const double share = static_cast<double> (k) / pieces, inside = std::clamp (share, 1e-9, 1.0 - 1e-9);
                const double t = std::lerp (corners[i], corners[i + 1], share), v = std::lerp (a, b, (t - from) / (to - from));
                const double shaped = v * e.shape (std::lerp (corners[i], corners[i + 1], inside) - e.time);
                const ClipPoint p { t, shaped * shaped };
                if (out.empty() || out.back() != p) out.push_back (p);
            }
    }

    /// Calls take (from, to, value at from, value at to) for each straight stretch of a control within an event.
    template <typename Take>
    static void stretches (const Control& control, double from, double to, Take take)
    {
        const auto& points = control.points;
        auto next = std::ranges::upper_bound (points, from, {}, &ClipPoint::time);
        double time = from, value = control.at (from);
        for (; next != points.end() && next->time < to; ++next)
        {
            if (next->time > time) take (time, next->time, value, next->value);
            time = next->time;
            value = next->value;
        }
        const bool moves = next != points.end() && next != points.begin() && next->time > time;
        const double end = moves ? value + (next->value - value) * (to - time) / (next->time - time) : value;
        if (to > time) take (time, to, value, end);
    }

    /// The envelope of one event.
    void addEvent (const Event& e, ClipTrack& track) const
    {
        const double end = e.time + e.duration;
        if (e.time > 0.0) track.phases.push_back ({ e.time, 0.0 });   // Apple defines no phase: each event begins at 0
        stretches (intensity, e.time, end, [&] (double from, double to, double a, double b) {
            if (e.hasShape())
                addShaped (track.amplitude, from, to, e.intensity * a, e.intensity * b, e);
            else
                addSquares (track.amplitude, from, to, e.intensity * a, e.intensity * b);
        });
        stretches (sharpness, e.time, end, [&] (double from, double to, double a, double b) {
            // The sum is limited to 0…1: corners where it reaches a limit.
            a += e.sharpness;
            b += e.sharpness;
            std::array<double, 4> corners { 0.0, 1.0, 1.0, 1.0 };
            std::size_t n = 1;
            for (const double limit : a < b ? std::array { 0.0, 1.0 } : std::array { 1.0, 0.0 })
                if ((a - limit) * (b - limit) < 0.0) corners[n++] = (limit - a) / (b - a);
            for (std::size_t i = 0; i < n; ++i)
            {
                const double p = corners[i], q = i + 1 < n ? corners[i + 1] : 1.0;
                const auto at = [&] (double share) { return std::clamp (a + (b - a) * share, 0.0, 1.0); };
                addSquares (track.sharpness, std::lerp (from, to, p), std::lerp (from, to, q), at (p), at (q));
            }
        });
    }

    /// The first track that is free at this time, with a gap of silence before it.
    ClipTrack& freeTrack (double time, int channel = 1)
    {
        constexpr double rounding = 1e-9;   // of the sum of a time and a duration
        for (auto& track : clip.tracks)
            if (track.channel == channel && (track.amplitude.empty() || track.amplitude.back().time <= time + rounding))
            {
                if (! track.amplitude.empty() && track.amplitude.back().time < time)
                {
                    track.amplitude.push_back ({ track.amplitude.back().time, 0.0 });
                    track.amplitude.push_back ({ time, 0.0 });
                }
                return track;
            }
        if (clip.tracks.size() >= at (most_clip_tracks))
            file.refuse (file.root(), "clip/too_large", "more than " + std::to_string (most_clip_tracks) + " events sound together", "remove some");
        return clip.tracks.emplace_back (ClipTrack { .channel = channel, .is_wave = channel > 1 });
    }

    void makeTracks()
    {
        std::ranges::stable_sort (events, {}, &Event::time);
        std::ranges::stable_sort (taps, {}, &Event::time);
        for (const auto& e : events)
        {
            if (! (e.duration > 0.0)) continue;
            auto& track = freeTrack (e.time);
            auto placed = e;
            if (! track.amplitude.empty()) placed.time = std::max (e.time, track.amplitude.back().time);
            placed.duration -= placed.time - e.time;
            addEvent (placed, track);
            if (static_cast<double> (clip.events()) > budgets().numbers) tooLarge();
        }
        if (clip.tracks.empty()) clip.tracks.emplace_back();
        for (const auto& e : taps)
        {
            const double strength = e.intensity * intensity.at (e.time);
            clip.tracks.front().taps.push_back ({ e.time, strength * strength, std::clamp (e.sharpness + sharpness.at (e.time), 0.0, 1.0) });
        }
        std::ranges::stable_sort (played, {}, [] (const Sound& s) { return s.event.time; });
        for (const auto& sound : played)
            for (std::size_t c = 0; c < sound.signal->channels.size(); ++c)
                addSound (sound, c);
    }

    /// One channel of a recording, as a wave.
    void addSound (const Sound& sound, std::size_t c)
    {
        const auto& e = sound.event;
        const auto& samples = sound.signal->channels[c];
        auto& points = freeTrack (e.time, static_cast<int> (std::min<std::size_t> (c + 2, at (most_clip_channels)))).amplitude;
        const double start = points.empty() ? e.time : std::max (e.time, points.back().time), rate = sound.signal->rate_hz;
        const auto count = static_cast<std::size_t> (std::ceil (e.duration * rate - 1e-6));
        std::size_t limited_ones = 0, odd = 0;
        double last = 0.0;
        for (std::size_t k = 0; k < count; ++k)
        {
            const double since = static_cast<double> (k) / rate, sample = samples[k % samples.size()];
            const double v = std::isfinite (sample) ? sample * e.intensity * volume.at (e.time + since) * e.shape (since) : 0.0;
            last = std::clamp (v, -1.0, 1.0);
            if (! std::isfinite (sample)) ++odd;
            if (last != v) ++limited_ones;
            points.push_back ({ start + since, last });
        }
        points.push_back ({ start + static_cast<double> (count) / rate, last });   // the last sample lasts as long as the others
        const auto noteCount = [&] (std::size_t n, const char* id, const std::string& what) {
            if (n > 0) file.note (file.root(), id, std::to_string (n) + " samples of a sound " + what, "change the recording");
        };
        noteCount (limited_ones, "clip/clamped", "are limited to 1");
        noteCount (odd, "clip/not_finite", "are not finite numbers; 0 is used instead");
    }

    [[noreturn]] void tooLarge() const
    {
        file.refuse (file.root(), "clip/too_large", "its events and curves make more points than the budget allows", "shorten it");
    }

    ClipJson& file;
    const ReadSound& read_sound;
    ClipSounds& sounds;
    Clip clip;
    Control intensity, sharpness, volume;
    std::vector<Event> events, taps;
    std::vector<Sound> played;
    double numbers = 0.0;   // samples of sounds, as read and as played
};
}   // namespace

Clip readAhap (ClipJson& file, const ReadSound& read_sound, ClipSounds& sounds) { return AhapReader (file, read_sound, sounds).read(); }

}   // namespace tactus::readers
