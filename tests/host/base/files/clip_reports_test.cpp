// SPDX-License-Identifier: MIT
// Random clips as other programs write them. The test knows how each one sounds, from the rules of its format, and so whether a report about what a conversion
// loses is true.
#include <host/base/files/clip_io.hpp>

#include "support/temporary_folder.hpp"

#include <tactus/text/json.hpp>
#include <tactus/text/json_writer.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

using namespace tactus;
using namespace tactus::host;

namespace
{
constexpr double pi = std::numbers::pi, rate = 7919.0;   // a prime, so that samples are not at the times of drawn points
constexpr int clips = 300;

struct Random
{
    std::mt19937 engine;

    int below (int n) { return static_cast<int> (engine() % static_cast<unsigned> (n)); }
    bool once_in (int n) { return below (n) == 0; }
    double real (double low, double high) { return low + (high - low) * (static_cast<double> (engine()) / 4294967296.0); }
};

/// A line through points: the value at t.
struct Line
{
    std::vector<std::pair<double, double>> points {};

    /// Held before the first point and after the last.
    double held (double t, double otherwise) const
    {
        if (points.empty()) return otherwise;
        if (t <= points.front().first) return points.front().second;
        for (std::size_t i = 1; i < points.size(); ++i)
            if (t < points[i].first)
            {
                const auto [t0, a] = points[i - 1];
                const auto [t1, b] = points[i];
                return a + (b - a) * (t - t0) / (t1 - t0);
            }
        return points.back().second;
    }

    bool isWithin (double t) const { return ! points.empty() && t >= points.front().first && t < points.back().first; }
};

/// A file, and its signal at a time, by channel.
struct Source
{
    std::string name {}, text {};
    std::map<int, std::vector<std::function<double (double)>>> sounds {};
    std::map<int, double> weights {};
    double limit = 1e9, gain = 1.0;   // of the sum in a channel; times the gain
    bool says_more = false;           // than a clip holds, so that no report may say "none"

    std::map<int, std::vector<double>> render (std::size_t count) const
    {
        std::map<int, std::vector<double>> made;
        for (const auto& [channel, parts] : sounds)
        {
            auto& samples = made[channel];
            for (std::size_t k = 0; k < count; ++k)
            {
                double sum = 0.0;
                for (const auto& part : parts)
                    sum += part (static_cast<double> (k) / rate);
                samples.push_back (gain * std::clamp (sum, -limit, limit));
            }
        }
        return made;
    }

    /// The channels added up, each times its mixing weight if there are several.
    std::vector<double> mixed (const std::map<int, std::vector<double>>& rendered) const
    {
        std::vector<double> sum (rendered.begin()->second.size());
        for (const auto& [channel, signal] : rendered)
            for (std::size_t k = 0; k < sum.size(); ++k)
                sum[k] += signal[k] * (rendered.size() > 1 && weights.contains (channel) ? weights.at (channel) : 1.0);
        return sum;
    }
};

/// A tone of an amplitude and a frequency that move, from the phase 0 at `start`. The frequency is integrated in small steps.
std::function<double (double)> tone (double start, double end, std::function<double (double)> amplitude, const std::function<double (double)>& hertz)
{
    constexpr int parts = 16;
    const double step = 1.0 / (rate * parts);
    std::vector<double> phases { 0.0 };   // at each step after the start, and one more
    for (double t = start; t < end + 2.0 * step; t += step)
        phases.push_back (phases.back() + step * hertz (t + 0.5 * step));
    return [=, amplitude = std::move (amplitude)] (double t) {
        if (t < start || t >= end) return 0.0;
        const double at = (t - start) / step;
        const auto i = static_cast<std::size_t> (at);
        const double phase = phases[i] + (at - static_cast<double> (i)) * (phases[i + 1] - phases[i]);
        return amplitude (t) * std::sin (2.0 * pi * phase);
    };
}

std::function<double (double)> burst (double start, double strength, double hertz)
{
    return [=] (double t) { return t >= start && t < start + 2.0 / hertz ? strength * std::sin (2.0 * pi * hertz * (t - start)) : 0.0; };
}

Source randomHaptic (Random& random)
{
    Source made { .name = "a.haptic" };
    Json amplitudes = Json::array(), frequencies = Json::array();
    Line amplitude, frequency;
    double t = random.once_in (2) ? 0.0 : random.real (0.01, 0.1);
    auto& sounds = made.sounds[1];
    for (int n = 2 + random.below (5); n > 0; --n, t += random.real (0.03, 0.15))
    {
        const double a = random.real (0.0, 0.9);
        amplitude.points.emplace_back (t, a);
        Json point { { "time", t }, { "amplitude", a } };
        if (random.once_in (5))
        {
            const double strength = random.real (a, 1.0), f = random.real (0.0, 1.0);
            point["emphasis"] = Json { { "amplitude", strength }, { "frequency", f } };
            sounds.push_back (burst (t, strength, 55.0 + 110.0 * f));
        }
        if (random.once_in (150)) point["duration"] = 1, made.says_more = true;
        amplitudes.push_back (std::move (point));
        if (random.once_in (2))
        {
            frequency.points.emplace_back (t, random.real (0.0, 1.0));
            frequencies.push_back (Json { { "time", t }, { "frequency", frequency.points.back().second } });
        }
    }
    // The tone runs on through silence, from 0 s.
    sounds.push_back (tone (
        0.0, amplitude.points.back().first, [amplitude] (double now) { return amplitude.isWithin (now) ? amplitude.held (now, 0.0) : 0.0; },
        [frequency] (double now) { return 55.0 + 145.0 * frequency.held (now, 0.5); }));
    Json envelopes { { "amplitude", std::move (amplitudes) } };
    if (! frequency.points.empty() || random.once_in (2)) envelopes["frequency"] = std::move (frequencies);
    Json signals { { "continuous", Json { { "envelopes", std::move (envelopes) } } } };
    if (random.once_in (12)) signals["discrete"] = Json::array(), made.says_more = true;
    Json file { { "version", Json { { "major", 1 }, { "minor", 0 }, { "patch", 0 } } } };
    file["signals"] = std::move (signals);
    made.text = file.dump();
    return made;
}

Json parameter (const char* id, double v) { return { { "ParameterID", id }, { "ParameterValue", v } }; }

void appendLittle (std::string& bytes, std::uint32_t v, int size)
{
    for (int i = 0; i < size; ++i)
        bytes += static_cast<char> (static_cast<unsigned char> (v >> 8 * i));
}

/// A WAV of 32-bit floats.
std::string wavOf (const std::vector<float>& samples, std::uint32_t hertz)
{
    std::string bytes = "RIFF";
    const auto size = static_cast<std::uint32_t> (4 * samples.size());
    appendLittle (bytes, 36 + size, 4);
    bytes += "WAVEfmt ";
    for (const auto& [v, n] : { std::pair { 16u, 4 }, { 3u, 2 }, { 1u, 2 }, { hertz, 4 }, { 4 * hertz, 4 }, { 4u, 2 }, { 32u, 2 } })
        appendLittle (bytes, v, n);
    bytes += "data";
    appendLittle (bytes, size, 4);
    for (const float v : samples)
        appendLittle (bytes, std::bit_cast<std::uint32_t> (v), 4);
    return bytes;
}

/// The shape of an event: it rises within the attack, and falls within the release.
double shapeOf (double since, double duration, double attack, double release)
{
    return (since < attack ? since / attack : 1.0) * (duration - since < release ? (duration - since) / release : 1.0);
}

Source randomAhap (Random& random, const std::vector<float>& hum, double hum_rate)
{
    Source made { .name = "a.ahap" };
    Json pattern = Json::array();
    const auto control = [&] (const char* id, double low, double high) {
        Line line;
        if (random.once_in (2)) return line;
        const double start = random.real (0.0, 0.2);
        Json points = Json::array();
        double at = 0.0;
        for (int n = 1 + random.below (4); n > 0; --n, at += random.real (0.02, 0.2))
        {
            line.points.emplace_back (start + at, random.real (low, high));
            points.push_back (Json { { "Time", at }, { "ParameterValue", line.points.back().second } });
        }
        Json curve { { "ParameterID", id }, { "Time", start } };
        curve["ParameterCurveControlPoints"] = std::move (points);
        pattern.push_back (Json { { "ParameterCurve", std::move (curve) } });
        return line;
    };
    const auto gain = control ("HapticIntensityControl", 0.1, 1.0), shift = control ("HapticSharpnessControl", -0.3, 0.5),
               volume = control ("AudioVolumeControl", 0.0, 1.0);
    // Before the first point of a curve, a control has its default.
    const auto at = [] (const Line& line, double t, double initial) {
        return ! line.points.empty() && t >= line.points.front().first ? line.held (t, 0.0) : initial;
    };
    made.sounds[1];
    for (int n = 1 + random.below (4); n > 0; --n)
    {
        const double start = random.real (0.0, 0.3), duration = random.real (0.05, 0.4), intensity = random.real (0.2, 1.0), sharpness = random.real (0.0, 1.0);
        Json given = Json::array(), event { { "Time", start } };
        const int kind = random.below (6);
        if (kind == 0)
        {
            event["EventType"] = "HapticTransient";
            const double sharp = std::clamp (sharpness + at (shift, start, 0.0), 0.0, 1.0);
            made.sounds[1].push_back (burst (start, std::pow (intensity * at (gain, start, 1.0), 2.0), 55.0 + 110.0 * sharp));
        }
        else if (kind == 1)
        {
            event["EventType"] = "AudioCustom";
            event["EventWaveformPath"] = "hum.wav";
            given.push_back (parameter ("AudioVolume", intensity));
            made.sounds[2].push_back ([=] (double t) {
                const double x = (t - start) * hum_rate;
                if (x < 0.0 || x >= static_cast<double> (hum.size())) return 0.0;
                const auto i = static_cast<std::size_t> (x);
                const double a = hum[i], b = hum[std::min (i + 1, hum.size() - 1)];
                return intensity * at (volume, t, 1.0) * (a + (b - a) * (x - static_cast<double> (i)));
            });
        }
        else if (kind == 2 && random.once_in (4))
        {
            event["EventType"] = random.once_in (2) ? "AudioContinuous" : "AudioCustom";
            event["EventDuration"] = duration;
            event["EventWaveformPath"] = "missing.wav";
            made.says_more = true;
        }
        else
        {
            event["EventType"] = "HapticContinuous";
            event["EventDuration"] = duration;
            const bool has_shape = random.once_in (6);
            const double attack = has_shape ? random.real (0.01, 0.5 * duration) : 0.0, release = has_shape ? random.real (0.01, 0.5 * duration) : 0.0;
            if (has_shape) given.push_back (parameter ("AttackTime", attack)), given.push_back (parameter ("ReleaseTime", release));
            made.says_more = made.says_more || has_shape;
            made.sounds[1].push_back (tone (
                start, start + duration,
                [=] (double t) { return std::pow (intensity * at (gain, t, 1.0) * shapeOf (t - start, duration, attack, release), 2.0); },
                [=] (double t) { return 55.0 + 145.0 * std::pow (std::clamp (sharpness + at (shift, t, 0.0), 0.0, 1.0), 2.0); }));
        }
        if (kind != 1) given.push_back (parameter ("HapticIntensity", intensity)), given.push_back (parameter ("HapticSharpness", sharpness));
        if (random.once_in (30)) given.push_back (parameter ("AudioPitch", 0.5)), made.says_more = true;
        if (random.once_in (30)) event["Loop"] = true, made.says_more = true;
        event["EventParameters"] = std::move (given);
        pattern.push_back (Json { { "Event", std::move (event) } });
    }
    Json file { { "Version", 1.0 } };
    file["Pattern"] = std::move (pattern);
    made.text = file.dump();
    return made;
}

/// A signal of period 1.
double baseSignal (const std::string& base, double cycles)
{
    const double x = cycles - std::floor (cycles);
    if (base == "Square") return x < 0.5 ? 1.0 : -1.0;
    if (base == "SawToothUp") return x < 0.5 ? 2.0 * x : 2.0 * x - 2.0;
    if (base == "SawToothDown") return x < 0.5 ? -2.0 * x : 2.0 - 2.0 * x;
    if (base == "Triangle") return x < 0.25 ? 4.0 * x : x < 0.75 ? 2.0 - 4.0 * x
                                                                 : 4.0 * x - 4.0;
    return std::sin (2.0 * pi * x);
}

Source randomHjif (Random& random)
{
    Source made { .name = "a.hjif" };
    Json channels = Json::array();
    const int many = 1 + random.below (2);
    const double loudest = random.once_in (8) ? 0.9 : 0.2;
    made.limit = 1.0;
    if (random.once_in (3)) made.gain = 0.5;
    for (int c = 1; c <= many; ++c)
    {
        Json bands = Json::array();
        made.sounds[c];
        made.weights[c] = random.once_in (3) ? random.real (0.2, 1.0) : 1.0;
        for (int b = 1 + random.below (3); b > 0; --b)
        {
            const int kind = random.below (4), start_ms = random.below (200);
            const double start = 1e-3 * start_ms, phase = random.once_in (2) ? 0.0 : random.real (0.0, 6.28);
            static const std::vector<const char*> bases { "Sine", "Sine", "Sine", "Square", "Triangle", "SawToothUp", "SawToothDown" };
            const std::string base = bases[static_cast<std::size_t> (random.below (static_cast<int> (bases.size())))];
            Json frames = Json::array();
            std::vector<int> at { 0 };
            for (int n = 1 + random.below (3); n > 0; --n)
                at.push_back (at.back() + 10 + random.below (120));
            Line amplitude, hertz;
            for (const int ms : at)
            {
                const double a = random.real (0.0, loudest);
                const int f = 60 + random.below (140);
                Json frame { { "relative_position", ms }, { "amplitude_modulation", a } };
                if (kind < 2) frame["frequency_modulation"] = f;
                frames.push_back (std::move (frame));
                amplitude.points.emplace_back (start + 1e-3 * ms, a);
                hertz.points.emplace_back (start + 1e-3 * ms, f);
            }
            const double end = start + 1e-3 * at.back();
            Json effect { { "effect_type", "Basis" }, { "position", start_ms }, { "phase", phase }, { "base_signal", base } };
            effect["keyframes"] = std::move (frames);
            if (random.once_in (40)) effect["semantic_keywords"] = "UX/Click", made.says_more = true;
            Json band { { "band_type", kind < 2 ? "VectorialWave" : kind == 2 ? "Curve"
                                                                              : "Transient" },
                        { "lower_frequency_limit", 55 },
                        { "upper_frequency_limit", 200 } };
            const bool is_linear = random.once_in (2);
            if (kind == 2) band["curve_type"] = is_linear ? "Linear" : "Cubic";
            band["effects"] = Json::array ({ std::move (effect) });
            bands.push_back (std::move (band));
            auto& sounds = made.sounds[c];
            if (kind < 2)
                sounds.push_back ([=] (double t) {
                    if (t < start || t >= end) return 0.0;
                    double cycles = phase / (2.0 * pi);
                    for (std::size_t i = 1; i < hertz.points.size() && hertz.points[i - 1].first < t; ++i)
                    {
                        const auto [t0, f0] = hertz.points[i - 1];
                        const double until = std::min (t, hertz.points[i].first);
                        cycles += 0.5 * (f0 + hertz.held (until, 0.0)) * (until - t0);
                    }
                    return amplitude.held (t, 0.0) * baseSignal (base, cycles);
                });
            else if (kind == 2)
                sounds.push_back ([=] (double t) {
                    if (! amplitude.isWithin (t)) return 0.0;
                    if (is_linear) return amplitude.held (t, 0.0);
                    std::size_t i = 1;
                    while (amplitude.points[i].first <= t)
                        ++i;
                    const auto [t0, a] = amplitude.points[i - 1];
                    const auto [t1, z] = amplitude.points[i];
                    const double x = (t - t0) / (t1 - t0);
                    return a + (z - a) * x * x * (3.0 - 2.0 * x);
                });
            else
                for (const auto& [t, a] : amplitude.points)
                    sounds.push_back (burst (t, a, 2.0 / 0.022));
        }
        if (random.once_in (10))
        {
            Json wavelets { { "band_type", "WaveletWave" }, { "block_length", 512 }, { "lower_frequency_limit", 0 }, { "upper_frequency_limit", 1000 } };
            wavelets["effects"] = Json::array ({ Json { { "effect_type", "Basis" }, { "position", 0 }, { "wavelet_stream", "AAAA" } } });
            bands.push_back (std::move (wavelets));
            made.says_more = true;
        }
        Json channel { { "id", c - 1 }, { "gain", made.gain }, { "mixing_coefficient", made.weights[c] }, { "body_part_mask", 0 } };
        if (random.once_in (20)) channel["direction"] = Json { { "X", 127 }, { "Y", 0 }, { "Z", 0 } }, made.says_more = true;
        channel["bands"] = std::move (bands);
        channels.push_back (std::move (channel));
    }
    Json perception { { "id", 0 }, { "avatar_id", 1 }, { "perception_modality", "Vibrotactile" } };
    perception["channels"] = std::move (channels);
    Json file { { "version", "2023" }, { "profile", "Main" }, { "timescale", 1000 } };
    file["perceptions"] = Json::array ({ std::move (perception) });
    if (random.once_in (20)) file["looping"] = true, made.says_more = true;
    made.text = file.dump();
    return made;
}

/// The samples of a WAV of Tactus: 32-bit floats, read by their places in the file.
std::vector<std::vector<double>> samplesOf (const std::filesystem::path& file)
{
    std::ifstream in (file, std::ios::binary);
    const std::string bytes { std::istreambuf_iterator (in), {} };
    const auto number = [&] (std::size_t at, std::size_t size) {
        std::uint32_t v = 0;
        for (std::size_t i = size; i-- > 0;)
            v = v << 8u | static_cast<unsigned char> (bytes[at + i]);
        return v;
    };
    const auto format = bytes.find ("fmt "), data = bytes.find ("data", format);
    REQUIRE (data != bytes.npos);
    REQUIRE (number (format + 8, 2) == 3);
    const std::size_t channels = number (format + 10, 2);
    std::vector<std::vector<double>> made (channels);
    for (std::size_t at = data + 8, k = 0; at + 4 <= bytes.size(); at += 4, ++k)
        made[k % channels].push_back (std::bit_cast<float> (number (at, 4)));
    return made;
}

double rms (const std::vector<double>& v)
{
    double sum = 0.0;
    for (const double x : v)
        sum += x * x;
    return std::sqrt (sum / static_cast<double> (std::max<std::size_t> (v.size(), 1)));
}

/// The difference relative to the first, in percent.
double distance (const std::vector<double>& a, const std::vector<double>& b)
{
    std::vector<double> d;
    for (std::size_t k = 0; k < std::max (a.size(), b.size()); ++k)
        d.push_back ((k < a.size() ? a[k] : 0.0) - (k < b.size() ? b[k] : 0.0));
    const double whole = rms (a);
    return 100.0 * (whole > 0.0 ? rms (d) / whole : rms (d));
}

/// A report of a conversion: what it says of the samples, by channel (0: all), and whether it says that nothing was lost.
struct Report
{
    std::map<int, double> percent {};
    double peak = 1.0;   // by which a WAV was divided
    bool says_none = false;
};

Report reportOf (const SavedClip& saved)
{
    Report made;
    for (const auto& s : lossReport (saved))
    {
        made.says_none = made.says_none || s.starts_with ("none ");
        if (const auto at = s.find ("the signal reaches "); at != s.npos) made.peak = std::stod (s.substr (at + 19));
        const auto at = s.find (": the samples differ by ");
        if (at == s.npos) continue;
        const auto percent = s.find ("rms, ", at) + 5;
        made.percent[s.starts_with ("channel ") ? std::stoi (s.substr (8)) : 0] = std::stod (s.substr (percent));
    }
    return made;
}

/// Converts to a WAV, and returns its samples, as loud as before.
std::vector<std::vector<double>> asWav (const std::filesystem::path& from, const std::filesystem::path& to, Report& report)
{
    const auto read = loadClip (from);
    INFO ((read ? "" : describe (read.error())));
    REQUIRE (read);
    const auto saved = saveClip (read->clip, to, rate, &*read);
    REQUIRE (saved);
    report = reportOf (*saved);
    auto samples = samplesOf (to);
    for (auto& channel : samples)
        for (double& v : channel)
            v *= report.peak;
    return samples;
}

void checkReports (const std::function<Source (Random&)>& write, const std::string& hum)
{
    const TemporaryFolder folder;
    folder.write ("hum.wav", hum);
    Random random { std::mt19937 { 63 } };
    int nones = 0, chains = 0;
    for (int n = 0; n < clips; ++n)
    {
        const auto source = write (random);
        INFO (source.text);
        folder.write (source.name, source.text);
        Report report;
        const auto samples = asWav (folder / source.name, folder / "b.wav", report);
        const auto wanted = source.render (samples.front().size());
        CHECK ((! report.says_none || ! source.says_more));
        REQUIRE (samples.size() == wanted.size());
        std::size_t place = 0;
        for (const auto& [channel, signal] : wanted)
        {
            INFO ("channel " << channel);
            const double off = distance (signal, samples[place++]);
            const auto said = report.percent.find (channel);
            if (said == report.percent.end())
                CHECK (off < 0.2);
            else
                CHECK (off == Approx (said->second).epsilon (0.1).margin (0.15));
        }

        // Through another format: if neither report names a difference, there is none.
        static const std::vector<std::string> formats { "c.json", "c.hjif", "c.ahap", "c.haptic" };
        const auto& between = formats[static_cast<std::size_t> (random.below (4))];
        INFO (between);
        const auto read = loadClip (folder / source.name);
        REQUIRE (read);
        const auto saved = saveClip (read->clip, folder / between, 0.0, &*read);
        REQUIRE (saved);
        const auto first = reportOf (*saved);
        CHECK ((! first.says_none || ! source.says_more));
        nones += first.says_none;
        if (read->clip.events() == 0) continue;   // nothing to render
        Report second;
        const auto again = asWav (folder / between, folder / "d.wav", second);
        // Where a format has moved the steps of a signal, single samples differ much, or not at all.
        const auto isMoved = [] (const Message& m) { return m.text.find ("half a tick") != m.text.npos; };
        if (! second.percent.empty() || std::ranges::any_of (saved->losses, isMoved)) continue;
        ++chains;
        const auto checkOne = [&] (int channel, const std::vector<double>& signal, const std::vector<double>& got) {
            INFO ("channel " << channel);
            const auto said = first.percent.find (channel);
            CHECK (distance (signal, got) == Approx (said == first.percent.end() ? 0.0 : said->second).epsilon (0.1).margin (0.5));
        };
        if (saved->is_mixed)
            checkOne (0, source.mixed (wanted), again.front());
        else
        {
            REQUIRE (again.size() == wanted.size());
            place = 0;
            for (const auto& [channel, signal] : wanted)
                checkOne (channel, signal, again[place++]);
        }
    }
    CHECK (nones >= 40);   // so that the claims were tried
    CHECK (chains >= 40);
}
}   // namespace

TEST_CASE ("each report about a clip is true: .haptic", "[clips]") { checkReports (randomHaptic, {}); }

TEST_CASE ("each report about a clip is true: .ahap, with sounds beside it", "[clips]")
{
    constexpr std::uint32_t hum_rate = 2000;
    std::vector<float> hum;
    for (int k = 0; k < 300; ++k)
        hum.push_back (static_cast<float> (0.8 * std::sin (0.21 * k) * std::cos (0.013 * k)));
    checkReports ([&] (Random& random) { return randomAhap (random, hum, hum_rate); }, wavOf (hum, hum_rate));
}

TEST_CASE ("each report about a clip is true: .hjif, with mixing weights", "[clips]") { checkReports (randomHjif, {}); }

TEST_CASE ("the channels of an .hjif are added up with their mixing weights", "[clips]")
{
    const auto channel = [] (int id, double weight, double amplitude, int hertz) {
        const auto at = [&] (int ms) {
            return Json { { "relative_position", ms }, { "amplitude_modulation", amplitude }, { "frequency_modulation", hertz } };
        };
        Json effect { { "effect_type", "Basis" }, { "position", 0 }, { "base_signal", "Sine" } };
        effect["keyframes"] = Json::array ({ at (0), at (500) });
        Json band { { "band_type", "VectorialWave" }, { "lower_frequency_limit", 55 }, { "upper_frequency_limit", 200 } };
        band["effects"] = Json::array ({ std::move (effect) });
        Json made { { "id", id }, { "gain", 1.0 }, { "mixing_coefficient", weight } };
        made["bands"] = Json::array ({ std::move (band) });
        return made;
    };
    Json perception { { "id", 0 }, { "perception_modality", "Vibrotactile" } };
    perception["channels"] = Json::array ({ channel (0, 0.5, 0.4, 100), channel (1, 1.0, 0.3, 150) });
    Json file { { "version", "2023" }, { "timescale", 1000 } };
    file["perceptions"] = Json::array ({ std::move (perception) });
    const TemporaryFolder folder;
    folder.write ("a.hjif", file.dump());
    const auto tone = [] (double t, double hertz) { return t < 0.5 ? std::sin (2.0 * pi * hertz * t) : 0.0; };

    // By themselves, they sound as MPEG's software plays them.
    Report report;
    const auto apart = asWav (folder / "a.hjif", folder / "a.wav", report);
    REQUIRE (apart.size() == 2);
    const auto read = loadClip (folder / "a.hjif");
    REQUIRE (read);
    CHECK (read->leftOut().empty());
    const auto saved = saveClip (read->clip, folder / "b.ahap", 0.0, &*read);
    REQUIRE (saved);
    CHECK (reportOf (*saved).percent.empty());
    const auto together = asWav (folder / "b.ahap", folder / "b.wav", report).front();
    std::vector<double> first, sum;
    for (std::size_t k = 0; k < together.size(); ++k)
    {
        const double t = static_cast<double> (k) / rate;
        first.push_back (0.4 * tone (t, 100.0));
        sum.push_back (0.2 * tone (t, 100.0) + 0.3 * tone (t, 150.0));
    }
    CHECK (distance (first, apart[0]) < 0.1);
    CHECK (distance (sum, together) < 0.2);

    // A file of the format keeps the weights.
    REQUIRE (saveClip (read->clip, folder / "c.hjif", 0.0, &*read));
    const auto again = loadClip (folder / "c.hjif");
    REQUIRE (again);
    CHECK (again->clip.notes == read->clip.notes);
}

TEST_CASE ("wavelets are left out and named, and a binary file of MPEG is refused, so that no report says none", "[clips]")
{
    const TemporaryFolder folder;
    folder.write ("a.hmpg", "\x01\x02");
    const auto binary = loadClip (folder / "a.hmpg");
    REQUIRE (! binary);
    CHECK (binary.error().text.find ("is not decoded") != std::string::npos);
    for (const auto* type : { R"("band_type": "WaveletWave", "block_length": 512)", R"("band_type": "Wave", "encoding_modality": "Wavelet")" })
    {
        folder.write ("a.hjif", R"({ "version": "2023", "perceptions": [ { "channels": [ { "id": 0, "bands": [ { )" + std::string (type)
                                    + R"(, "effects": [ { "effect_type": "Basis", "position": 0, "wavelet_stream": "AAAA" } ] } ] } ] } ] })");
        const auto read = loadClip (folder / "a.hjif");
        REQUIRE (read);
        for (const auto* out : { "b.json", "b.hjif", "b.ahap", "b.haptic", "b.csv" })
        {
            const auto saved = saveClip (read->clip, folder / out, 0.0, &*read);
            REQUIRE (saved);
            const auto report = lossReport (*saved);
            CHECK (std::ranges::any_of (report, [] (const std::string& s) { return s.find ("the wavelet band is left out") != s.npos; }));
            CHECK (std::ranges::none_of (report, [] (const std::string& s) { return s.starts_with ("none "); }));
        }
    }
}

TEST_CASE ("a recording that an .ahap names is read only below its folder, without links and dots; else the reason is named", "[clips]")
{
    const TemporaryFolder folder;
    const auto hum = wavOf ({ 0.1f, 0.2f, 0.3f, 0.4f }, 100);
    std::filesystem::create_directories (folder / "clip/sub");
    std::filesystem::create_directories (folder / "clip/.hidden");
    for (const auto* name : { "clip/a.wav", "clip/sub/b.WAV", "clip/.hidden/c.wav", "outside.wav", "clip/sub/.d.wav" })
        folder.write (name, hum);
    folder.write ("clip/e.caf", hum);
    folder.write ("clip/text.wav", "hello");
    std::filesystem::create_symlink (folder / "outside.wav", folder / "clip/link.wav");
    std::filesystem::create_directory_symlink (folder / "clip/sub", folder / "clip/way");
    for (const auto& [path, why] : std::vector<std::pair<std::string, std::string>> {
             { "a.wav", "" },
             { "sub/b.WAV", "" },
             { "../outside.wav", "begins with a dot" },
             { "sub/../a.wav", "begins with a dot" },
             { ".hidden/c.wav", "begins with a dot" },
             { "sub/.d.wav", "begins with a dot" },
             { (folder / "clip/a.wav").string(), "does not lead below" },
             { "", "does not lead below" },
             { "link.wav", "through a link" },
             { "way/b.WAV", "through a link" },
             { "e.caf", "only .wav" },
             { "sub", "only .wav" },
             { "none.wav", "no such file" },
             { "text.wav", "does not begin with 'RIFF'" },
         })
    {
        Json event { { "Time", 0.5 }, { "EventType", "AudioCustom" }, { "EventWaveformPath", path } };
        Json file { { "Version", 1.0 } };
        file["Pattern"] = Json::array ({ Json { { "Event", std::move (event) } } });
        folder.write ("clip/x.ahap", file.dump());
        const auto read = loadClip (folder / "clip/x.ahap");
        INFO (path);
        REQUIRE (read);
        if (why.empty())
        {
            CHECK (read->leftOut().empty());
            REQUIRE (read->clip.tracks.size() == 2);
            CHECK (read->clip.tracks[1].amplitude[2] == ClipPoint { 0.52, double { 0.3f } });
            continue;
        }
        REQUIRE (read->leftOut().size() == 1);
        CHECK (read->leftOut()[0].text.find (why) != std::string::npos);
        CHECK (read->sounds.empty());
    }
}
