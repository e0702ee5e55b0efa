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

class AhapReader
{
public:
    explicit AhapReader (ClipJson& f) : file (f) { intensity.initial = 1.0; }

    Clip read()
    {
        const auto& root = file.root();
        const auto pattern = file.need (root, "Pattern");
        file.list (pattern);
        for (std::size_t i = 0; i < pattern.json->size(); ++i)
        {
            const auto entry = ClipJson::entry (pattern, i);
            file.object (entry);
            if (const auto event = file.find (entry, "Event"))
                readEvent (*event);
            else if (const auto parameter = file.find (entry, "Parameter"))
                readParameter (*parameter);
            else if (const auto curve = file.find (entry, "ParameterCurve"))
                readCurve (*curve);
            else
                file.refuse (entry, "clip/missing", "it is neither an Event, nor a Parameter, nor a ParameterCurve", "correct or remove it");
        }
        if (const auto data = file.find (root, "Metadata"))
            for (const auto& [key, value] : data->json->items())
                if (value.is_string()) clip.notes.emplace_back (lower (key), value.asString());
        intensity.join();
        sharpness.join();
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
        if (! is_tap && kind != "HapticContinuous")
        {
            if (kind != "AudioContinuous" && kind != "AudioCustom")
                file.refuse (type, "clip/range", "there is no event type " + quote (kind),
                             "types are HapticTransient, HapticContinuous, AudioContinuous and AudioCustom");
            const auto sound = file.find (spot, "EventWaveformPath");
            return file.note (type, "clip/not_carried",
                              "the sound " + (sound && sound->json->is_string() ? quote (sound->json->asString()) : "event")
                                  + " is left out: a clip holds no sounds",
                              "play it alongside the clip");
        }
        Event event { .time = timeOf (spot) };
        const auto duration = is_tap ? std::nullopt : file.find (spot, "EventDuration");
        if (duration) event.duration = limited (*duration, 0.0, 30.0);
        if (! is_tap && ! (event.duration > 0.0))
            return file.note (spot, "clip/not_carried", "the continuous event is left out: it has no EventDuration", "give it one, in seconds");
        if (const auto list = file.find (spot, "EventParameters"))
        {
            file.list (*list);
            for (std::size_t i = 0; i < list->json->size(); ++i)
            {
                const auto entry = ClipJson::entry (*list, i);
                readEventParameter (entry, event, is_tap);
            }
        }
        if (event.hasShape())
            file.note (spot, "clip/changed",
                       "its attack, decay and release are straight lines of as many seconds within its duration: Apple does not publish their shape",
                       "draw them into a curve of HapticIntensityControl");
        (is_tap ? taps : events).push_back (event);
    }

    void readEventParameter (const Spot& spot, Event& event, bool is_tap)
    {
        const auto id = file.need (spot, "ParameterID");
        const auto& name = file.text (id);
        const auto value = file.find (spot, "ParameterValue");
        if (! value) return file.note (spot, "clip/habit", quote (name) + " has no ParameterValue; its default is used", "give it one");
        if (name == "HapticIntensity")
            event.intensity = limited (*value, 0.0, 1.0);
        else if (name == "HapticSharpness")
            event.sharpness = limited (*value, 0.0, 1.0);
        else if (name == "Sustained" && ! is_tap)
            event.is_sustained = limited (*value, 0.0, 1.0) >= 0.5;
        else if (name == "AttackTime" && ! is_tap)
            event.attack = limited (*value, 0.0, 1.0);
        else if (name == "DecayTime" && ! is_tap)
            event.decay = limited (*value, 0.0, 1.0);
        else if (name == "ReleaseTime" && ! is_tap)
            event.release = limited (*value, 0.0, 1.0);
        else if (! (name == "Sustained" && file.number (*value) == 1.0))
            file.note (spot, "clip/not_carried", quote (name) + " of " + numberText (file.number (*value)) + " is left out",
                       "draw it into a curve of HapticIntensityControl");
    }

    Control* controlOf (const Spot& spot)
    {
        const auto id = file.need (spot, "ParameterID");
        const auto& name = file.text (id);
        if (name == "HapticIntensityControl") return &intensity;
        if (name == "HapticSharpnessControl") return &sharpness;
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
        return limited (*value, &control == &intensity ? 0.0 : -1.0, 1.0);
    }

    void readParameter (const Spot& spot)
    {
        if (auto* control = controlOf (spot)) control->curves.push_back ({ { timeOf (spot), controlValue (spot, *control) } });
    }

    void readCurve (const Spot& spot)
    {
        auto* control = controlOf (spot);
        if (control == nullptr) return;
        const auto list = file.need (spot, "ParameterCurveControlPoints");
        file.list (list);
        const double start = timeOf (spot);
        std::vector<ClipPoint> curve;
        for (std::size_t i = 0; i < list.json->size(); ++i)
        {
            const auto point = ClipJson::entry (list, i);
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
    ClipTrack& freeTrack (double time)
    {
        constexpr double rounding = 1e-9;   // of the sum of a time and a duration
        for (auto& track : clip.tracks)
            if (track.amplitude.empty() || track.amplitude.back().time <= time + rounding)
            {
                if (! track.amplitude.empty() && track.amplitude.back().time < time)
                {
                    track.amplitude.push_back ({ track.amplitude.back().time, 0.0 });
                    track.amplitude.push_back ({ time, 0.0 });
                }
                return track;
            }
        if (clip.tracks.size() >= at (most_clip_tracks))
            file.refuse (file.root(), "clip/too_large", "more than " + std::to_string (most_clip_tracks) + " continuous events sound together", "remove some");
        return clip.tracks.emplace_back();
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
    }

    [[noreturn]] void tooLarge() const
    {
        file.refuse (file.root(), "clip/too_large", "its events and curves make more points than the budget allows", "shorten it");
    }

    ClipJson& file;
    Clip clip;
    Control intensity, sharpness;
    std::vector<Event> events, taps;
};
}   // namespace

Clip readAhap (ClipJson& file) { return AhapReader (file).read(); }

}   // namespace tactus::readers
