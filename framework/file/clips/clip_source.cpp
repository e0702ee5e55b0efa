// SPDX-License-Identifier: MIT
#include "clip_source.hpp"
#include "clip_json.hpp"

#include <tactus/kit/signal/clip_score.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

namespace tactus::readers
{

namespace
{
constexpr double pi = std::numbers::pi;

const Json* member (const Json* object, std::string_view key)
{
    if (object == nullptr || ! object->is_object()) return nullptr;
    for (const auto& [name, value] : object->items())
        if (name == key) return &value;
    return nullptr;
}

std::optional<double> numberIn (const Json* object, std::string_view key)
{
    const auto* v = member (object, key);
    return v != nullptr && v->is_number() ? std::optional (v->get<double>()) : std::nullopt;
}

std::string textIn (const Json* object, std::string_view key)
{
    const auto* v = member (object, key);
    return v != nullptr && v->is_string() ? v->asString() : std::string {};
}

/// The elements of a list; none if it is something else.
std::vector<const Json*> elements (const Json* list)
{
    std::vector<const Json*> all;
    if (list != nullptr && list->is_array())
        for (const auto& e : *list)
            all.push_back (&e);
    return all;
}

/// The samples from a time on, until another.
struct Part
{
    std::size_t begin, end;
};

Part between (const SampleTimes& times, double from, double to)
{
    const auto at = [&] (double t) {
        const double k = std::ceil (t * times.rate_hz - times.offset);
        return static_cast<std::size_t> (std::clamp (k, 0.0, static_cast<double> (times.count)));
    };
    return { at (from), at (to) };
}

double fraction (double cycles) { return cycles - std::floor (cycles); }

//==============================================================================
/// MPEG HJIF.
class HjifSound
{
public:
    HjifSound (const Json& root, const SampleTimes& t, bool m) : file (root), times (t), is_mixed (m) {}

    ChannelSamples render()
    {
        timescale = numberIn (&file, "timescale").value_or (1000.0);
        const auto perceptions = elements (member (&file, "perceptions"));
        int number = 0;
        for (const auto* perception : perceptions)
        {
            const double unit = std::pow (10.0, numberIn (perception, "perception_unit_exponent").value_or (0.0));
            const auto* list = member (perception, "channels") != nullptr ? member (perception, "channels") : member (perception, "tracks");
            for (const auto* channel : elements (list))
            {
                ++number;
                int id = perceptions.size() == 1 ? static_cast<int> (numberIn (channel, "id").value_or (number - 1.0)) + 1 : number;
                if (id < 1 || id > most_clip_channels) id = number;
                std::vector<double> sum (times.count);
                for (const auto* band : elements (member (channel, "bands")))
                    addBand (band, perception, sum);
                const double gain = numberIn (channel, "gain").value_or (1.0) * unit;
                weights[id] = numberIn (channel, "mixing_coefficient").value_or (numberIn (channel, "mixing_weight").value_or (1.0));
                auto& out = made[id];
                out.resize (times.count);
                for (std::size_t k = 0; k < sum.size(); ++k)
                    out[k] += gain * std::clamp (sum[k], -1.0, 1.0);
            }
        }
        if (is_mixed && made.size() > 1)
            for (auto& [id, samples] : made)
                for (double& v : samples)
                    v *= weights[id];
        return std::move (made);
    }

private:
    struct Key
    {
        double at;
        std::optional<double> amplitude, hertz;
    };

    void addBand (const Json* band, const Json* perception, std::vector<double>& sum)
    {
        const auto type = textIn (band, "band_type");
        std::vector<double> before;   // the positions of the effects so far that are what they seem
        for (const auto* effect : elements (member (band, "effects")))
        {
            const double written = numberIn (effect, "position").value_or (0.0), start = follows (before, written) ? written : narrow (written);
            if (start == written) before.push_back (start);
            const auto kind = textIn (effect, "effect_type");
            if (kind == "Composite") continue;
            const Json* source = effect;
            if (kind == "Reference")
            {
                source = nullptr;
                const auto* id = member (effect, "id");
                for (const auto* other : elements (member (perception, "effect_library")))
                    if (const auto* its = member (other, "id"); source == nullptr && id != nullptr && its != nullptr && *its == *id) source = other;
            }
            const auto keys = keysOf (source);
            if (keys.empty()) continue;
            if (type == "Curve")
                addCurve (keys, textIn (band, "curve_type"), start, sum);
            else if (type == "Transient")
                addTransients (keys, start, sum);
            else if (type == "VectorialWave" || (type == "Wave" && textIn (band, "encoding_modality") != "Wavelet"))
                addTone (keys, source, start, sum);
        }
    }

    static bool follows (const std::vector<double>& before, double ticks)
    {
        return std::ranges::any_of (before, [ticks] (double b) { return b < ticks; });
    }

    /// Numbers of 16 bits that are meant as negative ones.
    static double narrow (double ticks) { return ticks >= 65472.0 && ticks < 65536.0 ? ticks - 65536.0 : ticks; }

    std::vector<Key> keysOf (const Json* effect) const
    {
        std::vector<Key> keys;
        for (const auto* frame : elements (member (effect, "keyframes")))
            keys.push_back ({ numberIn (frame, "relative_position").value_or (0.0), numberIn (frame, "amplitude_modulation"),
                              numberIn (frame, "frequency_modulation") });
        if (keys.size() == 1) keys[0].at = narrow (keys[0].at);
        for (std::size_t i = keys.size(); i-- > 1;)
            if (keys[i - 1].at > keys[i].at) keys[i - 1].at -= 65536.0;
        return keys;
    }

    void addTransients (const std::vector<Key>& keys, double start, std::vector<double>& sum) const
    {
        constexpr double length = 0.022;
        for (const auto& key : keys)
        {
            if (! key.amplitude) continue;
            const double from = (start + key.at) / timescale;
            const auto part = between (times, from, from + length);
            for (auto k = part.begin; k < part.end; ++k)
                sum[k] += *key.amplitude * std::sin (4.0 * pi * (times[k] - from) / length);
        }
    }

    void addCurve (const std::vector<Key>& keys, const std::string& type, double start, std::vector<double>& sum) const
    {
        std::vector<Key> set;
        for (const auto& key : keys)
            if (key.amplitude) set.push_back (key);
        if (set.empty()) return;
        const double begin = (start + std::min (0.0, keys.front().at)) / timescale;
        const auto before = between (times, begin, (start + set.front().at) / timescale);
        for (auto k = before.begin; k < before.end; ++k)
            sum[k] += *set.front().amplitude;
        bool is_akima = type == "Akima" && set.size() > 2;
        for (std::size_t i = 1; i < set.size(); ++i)
            is_akima = is_akima && set[i].at > set[i - 1].at;
        for (std::size_t i = 1; i < set.size(); ++i)
        {
            const double from = (start + set[i - 1].at) / timescale, to = (start + set[i].at) / timescale, a = *set[i - 1].amplitude, b = *set[i].amplitude;
            const auto part = between (times, from, to);
            for (auto k = part.begin; k < part.end; ++k)
            {
                const double x = (times[k] - from) / (to - from);
                if (is_akima)
                    sum[k] += akima (set, i, x);
                else if (type == "Linear" || type == "Bezier" || type == "Bspline")
                    sum[k] += a + (b - a) * x;
                else
                    sum[k] += a + (b - a) * (3.0 - 2.0 * x) * x * x;
            }
        }
    }

    /// Akima's curve between the keyframes i - 1 and i, by Hermite's four polynomials.
    static double akima (const std::vector<Key>& set, std::size_t i, double x)
    {
        const auto n = static_cast<long> (set.size());
        const auto rise = [&] (long k) { return (*set[at (k + 1)].amplitude - *set[at (k)].amplitude) / (set[at (k + 1)].at - set[at (k)].at); };
        const auto m = [&] (long k) {
            if (k >= 0 && k < n - 1) return rise (k);
            return k < 0 ? rise (0) + static_cast<double> (-k) * (rise (0) - rise (1))
                         : rise (n - 2) + static_cast<double> (k - n + 2) * (rise (n - 2) - rise (n - 3));
        };
        const auto slope = [&] (long k) {
            const double w = std::abs (m (k + 1) - m (k)), v = std::abs (m (k - 1) - m (k - 2));
            return w + v > 0.0 ? (w * m (k - 1) + v * m (k)) / (w + v) : 0.5 * (m (k - 1) + m (k));
        };
        const auto right = static_cast<long> (i);
        const double h = set[i].at - set[i - 1].at, x2 = x * x, x3 = x2 * x;
        return (2.0 * x3 - 3.0 * x2 + 1.0) * *set[i - 1].amplitude + (x3 - 2.0 * x2 + x) * h * slope (right - 1) + (3.0 * x2 - 2.0 * x3) * *set[i].amplitude
               + (x3 - x2) * h * slope (right);
    }

    static double signalOf (const std::string& base, double cycles)
    {
        const double x = fraction (cycles);
        if (base == "Square") return x < 0.5 ? 1.0 : -1.0;
        if (base == "Triangle") return std::asin (std::sin (2.0 * pi * x)) * 2.0 / pi;
        if (base == "SawToothUp") return 2.0 * (x - std::floor (x + 0.5));
        if (base == "SawToothDown") return 2.0 * (std::floor (x + 0.5) - x);
        return std::sin (2.0 * pi * x);
    }

    /// The last keyframe before these ticks, and the first one from there on. A null pointer where there is none.
    static std::pair<const Key*, const Key*> around (const std::vector<const Key*>& keys, double ticks)
    {
        const auto after = std::ranges::lower_bound (keys, ticks, {}, [] (const Key* k) { return k->at; });
        return { after == keys.begin() ? nullptr : *(after - 1), after == keys.end() ? nullptr : *after };
    }

    void addTone (const std::vector<Key>& keys, const Json* effect, double start, std::vector<double>& sum) const
    {
        const auto amplitude = [] (const Key& k) { return k.amplitude; };
        const auto hertz = [] (const Key& k) { return k.hertz; };
        const double begin = start + std::min (0.0, keys.front().at);
        const double phase = numberIn (effect, "phase").value_or (0.0) / (2.0 * pi);
        const auto base = textIn (effect, "base_signal");

        std::vector<double> cuts { begin - start, keys.back().at };
        std::vector<const Key*> with_amplitude, with_hertz;
        for (const auto& key : keys)
        {
            cuts.push_back (key.at);
            if (key.amplitude) with_amplitude.push_back (&key);
            if (key.hertz) with_hertz.push_back (&key);
        }
        std::ranges::sort (cuts);
        double cycles = phase;
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
        {
            const double from = cuts[i], to = cuts[i + 1], middle = 0.5 * (from + to);
            if (! (to > from)) continue;
            const auto [a, b] = around (with_amplitude, middle);
            const auto [f, g] = around (with_hertz, middle);
            const auto line = [&] (const Key* p, const Key* q, auto value, double otherwise, double ticks) {
                if (p == nullptr && q == nullptr) return otherwise;
                if (p == nullptr) return *value (*q);
                if (q == nullptr || ! (q->at > p->at)) return *value (*p);
                return *value (*p) + (*value (*q) - *value (*p)) * (ticks - p->at) / (q->at - p->at);
            };
            const double f0 = line (f, g, hertz, 0.0, from), f1 = line (f, g, hertz, 0.0, to), seconds = (to - from) / timescale;
            const auto part = between (times, (start + from) / timescale, (start + to) / timescale);
            for (auto k = part.begin; k < part.end; ++k)
            {
                const double since = times[k] - (start + from) / timescale, ticks = from + since * timescale;
                const double at = f0 == 0.0 && f1 == 0.0 ? 0.0 : cycles + since * (f0 + 0.5 * (f1 - f0) * since / seconds);
                sum[k] += line (a, b, amplitude, 1.0, ticks) * signalOf (base, at);
            }
            cycles = fraction (cycles + 0.5 * (f0 + f1) * seconds);
        }
    }

    const Json& file;
    const SampleTimes& times;
    bool is_mixed;
    ChannelSamples made;
    std::map<int, double> weights;
    double timescale = 1000.0;
};

//==============================================================================
/// Apple AHAP. One channel of vibration, and those of its recordings.
class AhapSound
{
public:
    AhapSound (const Json& root, const ClipVoice& v, const SampleTimes& t, const ClipSounds& s) : file (root), voice (v), times (t), sounds (s) {}

    ChannelSamples render()
    {
        const auto pattern = elements (member (&file, "Pattern"));
        for (const auto* entry : pattern)
        {
            if (const auto* p = member (entry, "Parameter"); p != nullptr)
                addControl (p, { { timeIn (p), valueIn (p) } });
            if (const auto* c = member (entry, "ParameterCurve"); c != nullptr)
            {
                std::vector<ClipPoint> points;
                for (const auto* point : elements (member (c, "ParameterCurveControlPoints")))
                    points.push_back ({ timeIn (c) + timeIn (point), valueIn (point, textIn (c, "ParameterID")) });
                if (! points.empty()) addControl (c, std::move (points));
            }
        }
        for (auto* list : { &gains, &shifts, &volumes })
            std::ranges::stable_sort (*list, {}, [] (const auto& points) { return points.front().time; });
        for (const auto& points : shifts)
            for (const auto& p : points)
                corners.push_back (p.time);
        std::ranges::sort (corners);
        sum.resize (times.count);
        for (const auto* entry : pattern)
            if (const auto* event = member (entry, "Event")) addEvent (event);
        made[1] = std::move (sum);
        return std::move (made);
    }

private:
    using Curves = std::vector<std::vector<ClipPoint>>;

    static double timeIn (const Json* object) { return std::clamp (numberIn (object, "Time").value_or (0.0), 0.0, longest_clip_s); }
    double valueIn (const Json* object, std::string id = {}) const
    {
        if (id.empty()) id = textIn (object, "ParameterID");
        const bool is_gain = id == "HapticIntensityControl" || id == "AudioVolumeControl";
        return std::clamp (numberIn (object, "ParameterValue").value_or (is_gain ? 1.0 : 0.0), is_gain ? 0.0 : -1.0, 1.0);
    }

    void addControl (const Json* object, std::vector<ClipPoint> points)
    {
        const auto id = textIn (object, "ParameterID");
        if (id == "HapticIntensityControl") gains.push_back (std::move (points));
        if (id == "AudioVolumeControl") volumes.push_back (points);
        if (id == "HapticSharpnessControl") shifts.push_back (std::move (points));
    }

    /// The value of the curve that began last.
    static double valueAt (const Curves& curves, double t, double initial)
    {
        auto next = std::ranges::upper_bound (curves, t, {}, [] (const auto& points) { return points.front().time; });
        if (next == curves.begin()) return initial;
        const auto& points = *(next - 1);
        const auto after = std::ranges::upper_bound (points, t, {}, &ClipPoint::time);
        if (after == points.end()) return points.back().value;
        const auto& before = *(after - 1);
        return before.value + (after->value - before.value) * (t - before.time) / (after->time - before.time);
    }

    double frequency (double sharpness, double t) const
    {
        const double s = std::clamp (sharpness + valueAt (shifts, t, 0.0), 0.0, 1.0);
        return voice.lowest + s * s * (voice.highest - voice.lowest);
    }

    void addEvent (const Json* event)
    {
        const auto type = textIn (event, "EventType");
        double intensity = 1.0, sharpness = 0.5, attack = 0.0, decay = 0.0, release = 0.0, loudness = 1.0;
        bool sustained = true;
        for (const auto* p : elements (member (event, "EventParameters")))
        {
            const auto v = numberIn (p, "ParameterValue");
            if (! v) continue;
            const double used = std::clamp (*v, 0.0, 1.0);
            const auto id = textIn (p, "ParameterID");
            if (id == "AudioVolume") loudness = used;
            if (id == "HapticIntensity") intensity = used;
            if (id == "HapticSharpness") sharpness = used;
            if (id == "AttackTime") attack = used;
            if (id == "DecayTime") decay = used;
            if (id == "ReleaseTime") release = used;
            if (id == "Sustained") sustained = used >= 0.5;
        }
        const double start = timeIn (event);
        if (type == "HapticTransient")
        {
            const double strength = intensity * valueAt (gains, start, 1.0), sharp = std::clamp (sharpness + valueAt (shifts, start, 0.0), 0.0, 1.0);
            const double hertz = voice.tap_lowest + sharp * (voice.tap_highest - voice.tap_lowest);
            const auto part = between (times, start, start + 2.0 / hertz);
            for (auto k = part.begin; k < part.end; ++k)
                sum[k] += strength * strength * std::sin (2.0 * pi * hertz * (times[k] - start));
        }
        const double duration = std::clamp (numberIn (event, "EventDuration").value_or (0.0), 0.0, type == "AudioCustom" ? longest_clip_s : 30.0);
        const auto shapeAt = [&] (double since, double whole) {
            double shape = attack > 0.0 && since < attack ? since / attack : 1.0;
            if (! sustained && since >= attack) shape = decay > 0.0 ? std::max (0.0, 1.0 - (since - attack) / decay) : 0.0;
            if (release > 0.0 && whole - since < release) shape *= (whole - since) / release;
            return shape;
        };
        if (type == "AudioCustom")
        {
            const auto isTrue = [&] (std::string_view key, bool otherwise) {
                const auto* v = member (event, key);
                return v != nullptr && v->is_boolean() ? v->get<bool>() : otherwise;
            };
            const bool has_shape = isTrue ("EventWaveformUseVolumeEnvelope", true);
            addSound (textIn (event, "EventWaveformPath"), start, duration, isTrue ("EventWaveformLoopEnabled", false),
                      [&] (double t, double whole) { return loudness * valueAt (volumes, t, 1.0) * (has_shape ? shapeAt (t - start, whole) : 1.0); });
        }
        if (type != "HapticContinuous") return;
        const auto part = between (times, start, start + duration);
        double cycles = 0.0, last = start;
        for (auto k = part.begin; k < part.end; ++k)
        {
            const double t = times[k], since = t - start;
            cycles = fraction (cycles + phaseBetween (sharpness, last, t));
            last = t;
            const double i = intensity * valueAt (gains, t, 1.0) * shapeAt (since, duration);
            sum[k] += i * i * std::sin (2.0 * pi * cycles);
        }
    }

    /// A recording, as a sound card plays it: straight between its samples.
    template <typename Gain>
    void addSound (const std::string& path, double start, double duration, bool loops, Gain gain)
    {
        const auto found = sounds.find (path);
        if (found == sounds.end()) return;
        const double rate = found->second.rate_hz;
        const auto& channels = found->second.channels;
        const auto n = channels.front().size();
        const double own = static_cast<double> (n) / rate, whole = duration > 0.0 && (loops || duration < own) ? duration : own;
        const auto part = between (times, start, start + whole);
        for (std::size_t c = 0; c < channels.size(); ++c)
        {
            auto& out = made[static_cast<int> (c) + 2];
            out.resize (times.count);
            const auto sample = [&] (double k) {
                const double last = std::ceil (whole * rate - 1e-6) - 1.0, v = channels[c][static_cast<std::size_t> (std::min (k, last)) % n];
                return std::isfinite (v) ? v : 0.0;
            };
            for (auto k = part.begin; k < part.end; ++k)
            {
                const double at = (times[k] - start) * rate, left = std::floor (at), v = sample (left) + (at - left) * (sample (left + 1.0) - sample (left));
                out[k] += std::clamp (v * gain (times[k], whole), -1.0, 1.0);
            }
        }
    }

    /// The integral of the frequency between two near times, by Simpson's rule from corner to corner of the curves.
    double phaseBetween (double sharpness, double from, double to) const
    {
        if (shifts.empty()) return (to - from) * frequency (sharpness, from);
        double whole = 0.0;
        for (auto corner = std::ranges::upper_bound (corners, from); from < to; ++corner)
        {
            const double until = corner != corners.end() && *corner < to ? *corner : to, h = until - from, little = 1e-6 * h;   // off the steps at its ends
            whole += h / 6.0 * (frequency (sharpness, from + little) + 4.0 * frequency (sharpness, from + 0.5 * h) + frequency (sharpness, until - little));
            from = until;
            if (corner == corners.end()) break;
        }
        return whole;
    }

    const Json& file;
    const ClipVoice& voice;
    const SampleTimes& times;
    const ClipSounds& sounds;
    Curves gains, shifts, volumes;
    std::vector<double> corners;   // times of the points of `shifts`
    std::vector<double> sum;
    ChannelSamples made;
};

//==============================================================================
/// Meta .haptic. One channel.
ChannelSamples renderHaptic (const Json& root, const ClipVoice& voice, const SampleTimes& times)
{
    std::vector<double> sum (times.count);
    const auto* envelopes = member (member (member (&root, "signals"), "continuous"), "envelopes");
    const auto amplitude = elements (member (envelopes, "amplitude")), frequency = elements (member (envelopes, "frequency"));
    const auto hertz = [&] (double f) { return voice.lowest + f * (voice.highest - voice.lowest); };
    std::vector<std::pair<double, double>> taps;   // time and length
    for (const auto* point : amplitude)
        if (const auto* emphasis = member (point, "emphasis"); emphasis != nullptr && emphasis->is_object())
        {
            const double from = numberIn (point, "time").value_or (0.0), strength = numberIn (emphasis, "amplitude").value_or (0.0);
            const double f = voice.tap_lowest + numberIn (emphasis, "frequency").value_or (0.0) * (voice.tap_highest - voice.tap_lowest);
            taps.emplace_back (from, 2.0 / f);
            const auto part = between (times, from, from + 2.0 / f);
            for (auto k = part.begin; k < part.end; ++k)
                sum[k] += strength * std::sin (2.0 * pi * f * (times[k] - from));
        }
    const auto duck = [&] (double t) {
        double gain = 1.0;
        for (const auto& [from, length] : taps)
            if (t >= from && t < from + length)
            {
                const double x = (t - from) / length, s = std::min ({ 1.0, 4.0 * x, 4.0 * (1.0 - x) });
                gain *= 1.0 - (1.0 - voice.ducking) * s * s * (3.0 - 2.0 * s);
            }
        return gain;
    };
    double cycles = 0.0, last = 0.0;
    std::size_t next = 0, sharp = 0;
    for (std::size_t k = 0; k < times.count; ++k)
    {
        const double t = times[k];
        // The phase, corner by corner.
        while (last < t)
        {
            while (sharp < frequency.size() && numberIn (frequency[sharp], "time").value_or (0.0) <= last)
                ++sharp;
            const auto at = [&] (std::size_t i) {
                return std::pair { numberIn (frequency[i], "time").value_or (0.0), numberIn (frequency[i], "frequency").value_or (0.5) };
            };
            const double until = sharp < frequency.size() ? std::min (t, at (sharp).first) : t;
            const auto f = [&] (double when) {
                if (frequency.empty()) return hertz (0.5);
                if (sharp == 0) return hertz (at (0).second);
                if (sharp == frequency.size()) return hertz (at (sharp - 1).second);
                const auto [t0, f0] = at (sharp - 1);
                const auto [t1, f1] = at (sharp);
                return hertz (f0 + (f1 - f0) * (when - t0) / (t1 - t0));
            };
            cycles = fraction (cycles + 0.5 * (f (last) + f (until)) * (until - last));
            last = until;
        }
        while (next < amplitude.size() && numberIn (amplitude[next], "time").value_or (0.0) <= t)
            ++next;
        if (next == 0 || next == amplitude.size()) continue;
        const double t0 = numberIn (amplitude[next - 1], "time").value_or (0.0), t1 = numberIn (amplitude[next], "time").value_or (0.0);
        const double a0 = numberIn (amplitude[next - 1], "amplitude").value_or (0.0), a1 = numberIn (amplitude[next], "amplitude").value_or (0.0);
        sum[k] += (voice.ducking < 1.0 ? duck (t) : 1.0) * (a0 + (a1 - a0) * (t - t0) / (t1 - t0)) * std::sin (2.0 * pi * cycles);
    }
    return { { 1, std::move (sum) } };
}
}   // namespace

std::optional<ChannelSamples> renderFile (std::string_view text, std::string_view name, const ClipVoice& voice, const SampleTimes& times,
                                          const SourceParts& parts)
{
    try
    {
        const ClipJson file (text, name);
        const Json& root = *file.root().json;
        if (textIn (&root, "format") == "tactus-clip") return {};
        if (member (&root, "Pattern") != nullptr) return AhapSound (root, voice, times, parts.sounds).render();
        if (member (&root, "perceptions") != nullptr) return HjifSound (root, times, parts.is_mixed).render();
        if (member (&root, "signals") != nullptr) return renderHaptic (root, voice, times);
    }
    catch (const ClipProblem&)
    {
    }
    return {};
}

ChannelSamples renderSamples (const Clip& clip, const SampleTimes& times)
{
    ChannelSamples made;
    for (const auto& t : clip.tracks)
        made[t.channel];
    for (auto& [channel, samples] : made)
    {
        const ClipScore score (clip, channel);
        std::vector<ClipScore::Cursor> cursors (score.size());
        for (std::size_t k = 0; k < times.count; ++k)
            samples.push_back (score (times[k], 0.0, cursors.data()).value);
    }
    return made;
}

}   // namespace tactus::readers
