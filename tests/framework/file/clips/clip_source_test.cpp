// SPDX-License-Identifier: MIT
// A clip sounds like the file that it was read from: the samples of the clip against a rendering of the file that shares no rule with the reader.
#include <support/property.hpp>
#include <tactus/file/clips/clip_difference.hpp>
#include <tactus/file/clips/clip_file.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/json_writer.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace tactus;
using readers::readClip;
using readers::SampleTimes;

namespace
{
constexpr double pi = std::numbers::pi;
const SampleTimes usual { .rate_hz = 8000.0, .offset = 0.4142, .count = 8 * 1500 };

int pick (int low, int high) { return *rc::gen::inRange (low, high + 1); }
double part (double low, double high) { return low + (high - low) * pick (0, 1000) / 1000.0; }

readers::ClipFile read (const std::string& text, const std::string& name)
{
    auto clip = readClip (text, name);
    INFO (text << (clip ? "" : describe (clip.error())));
    REQUIRE (clip);
    return std::move (*clip);
}

/// The differences of the clip from its file, and of the written file from that file, relative to the file.
double distance (const readers::ChannelSamples& a, const readers::ChannelSamples& b, bool mixed = false)
{
    double worst = 0.0;
    for (const auto& d : readers::compareSamples (a, b, mixed))
        worst = std::max (worst, d.part());
    return worst;
}

double distanceFromFile (const std::string& text, const std::string& name)
{
    return distance (*readers::renderFile (text, name, {}, usual), readers::renderSamples (read (text, name).clip, usual));
}

std::string hjif (Json bands, Json library = Json::array(), double gain = 1.0)
{
    Json channel { { "id", 0 }, { "gain", gain } };
    channel["bands"] = std::move (bands);
    Json perception { { "id", 0 }, { "perception_modality", "Vibrotactile" } };
    perception["effect_library"] = std::move (library);
    perception["channels"] = Json::array ({ std::move (channel) });
    Json file { { "version", "2023" }, { "timescale", 1000 } };
    file["perceptions"] = Json::array ({ std::move (perception) });
    return file.dump();
}

Json keyframe (int at, std::optional<double> amplitude, std::optional<int> hertz)
{
    Json made { { "relative_position", at } };
    if (amplitude) made["amplitude_modulation"] = *amplitude;
    if (hertz) made["frequency_modulation"] = *hertz;
    return made;
}

Json effect (int position, Json frames, double phase = 0.0, const char* base = "Sine")
{
    Json made { { "effect_type", "Basis" }, { "position", position }, { "phase", phase }, { "base_signal", base } };
    made["keyframes"] = std::move (frames);
    return made;
}

Json band (const char* type, Json effects)
{
    Json made { { "band_type", type }, { "lower_frequency_limit", 20 }, { "upper_frequency_limit", 400 } };
    made["effects"] = std::move (effects);
    return made;
}

/// Keyframes of an effect. One that sounds alone may have no amplitudes, and then plays at 1.
Json randomKeyframes (bool is_curve, bool is_alone = false)
{
    Json frames = Json::array();
    const bool has_amplitude = ! is_alone || pick (0, 1) == 0;
    int at = pick (0, 2) == 0 ? pick (0, 30) : 0;
    for (int n = pick (1, 6); n >= 0; --n)
    {
        std::optional<double> amplitude;
        std::optional<int> hertz;
        if (is_curve || (has_amplitude && pick (0, 2) > 0)) amplitude = part (is_curve || pick (0, 5) == 0 ? -0.1 : 0.0, 0.15);
        if (! is_curve && (frames.size() == 0 || pick (0, 1) == 0)) hertz = pick (20, 400);
        frames.push_back (keyframe (at, amplitude, hertz));
        at += pick (is_curve ? 20 : 0, 150);   // a curve of Akima between close points may swing beyond 1
    }
    frames.push_back (keyframe (at + 5, has_amplitude ? std::optional (0.1) : std::nullopt, std::nullopt));
    return frames;
}

/// Effects of any kind, one after the other or together, so quiet that their sum stays below 1.
std::string randomHjif()
{
    Json bands = Json::array(), library = Json::array();
    library.push_back (effect (0, randomKeyframes (false), part (-10.0, 10.0)));
    library[0]["id"] = 7;
    const int count = pick (1, 2);
    for (int b = count; b > 0; --b)
    {
        Json effects = Json::array();
        const int kind = pick (0, 3), many = pick (1, 3);
        int at = pick (-40, 60);
        for (int n = many; n > 0; --n)
        {
            static const std::vector<const char*> bases { "Sine", "Square", "Triangle", "SawToothUp", "SawToothDown" };
            if (kind == 0)   // transients
                effects.push_back (effect (
                    std::max (0, at), Json::array ({ keyframe (0, part (-0.15, 0.15), std::nullopt), keyframe (pick (30, 90), 0.1, std::nullopt) })));
            else if (kind == 1 && pick (0, 3) == 0)
                effects.push_back (Json { { "effect_type", "Reference" }, { "position", at }, { "id", 7 } });
            else
                effects.push_back (effect (at, randomKeyframes (kind == 3, kind != 3 && count == 1 && many == 1), part (-7.0, 7.0),
                                           bases[static_cast<std::size_t> (pick (0, 1) * pick (0, 4))]));
            at += pick (100, 500);
        }
        auto made = band (kind == 0 ? "Transient" : kind == 3 ? "Curve"
                                                              : "VectorialWave",
                          std::move (effects));
        if (kind == 3) made["curve_type"] = std::vector { "Linear", "Cubic", "Akima", "Unknown" }[static_cast<std::size_t> (pick (0, 3))];
        bands.push_back (std::move (made));
    }
    return hjif (std::move (bands), std::move (library), pick (0, 2) == 0 ? 0.5 : 1.0);
}

Json parameter (const char* id, double v) { return { { "ParameterID", id }, { "ParameterValue", v } }; }

std::string randomAhap()
{
    Json pattern = Json::array();
    for (int n = pick (1, 4); n > 0; --n)
    {
        Json given = Json::array ({ parameter ("HapticIntensity", part (0.1, 1.0)) });
        if (pick (0, 3) > 0) given.push_back (parameter ("HapticSharpness", part (0.0, 1.0)));
        const bool is_tap = pick (0, 3) == 0;
        for (const auto* id : { "AttackTime", "DecayTime", "ReleaseTime" })
            if (! is_tap && pick (0, 4) == 0) given.push_back (parameter (id, part (0.0, 0.4)));
        if (! is_tap && pick (0, 4) == 0) given.push_back (parameter ("Sustained", 0.0));
        Json event { { "Time", part (0.0, 0.6) }, { "EventType", is_tap ? "HapticTransient" : "HapticContinuous" } };
        if (! is_tap) event["EventDuration"] = part (0.05, 0.8);
        event["EventParameters"] = std::move (given);
        pattern.push_back (Json { { "Event", std::move (event) } });
    }
    for (int n = pick (0, 2); n > 0; --n)
    {
        const bool is_gain = pick (0, 1) == 0;
        const auto* id = is_gain ? "HapticIntensityControl" : "HapticSharpnessControl";
        if (pick (0, 2) == 0)
        {
            auto p = parameter (id, part (is_gain ? 0.0 : -0.4, 1.0));
            p["Time"] = part (0.0, 0.8);
            pattern.push_back (Json { { "Parameter", std::move (p) } });
            continue;
        }
        Json points = Json::array();
        double at = 0.0;
        for (int k = pick (1, 4); k >= 0; --k)
        {
            points.push_back (Json { { "Time", at }, { "ParameterValue", part (is_gain ? 0.0 : -0.4, 1.0) } });
            at += part (0.02, 0.3);
        }
        Json curve { { "ParameterID", id }, { "Time", part (0.0, 0.3) } };
        curve["ParameterCurveControlPoints"] = std::move (points);
        pattern.push_back (Json { { "ParameterCurve", std::move (curve) } });
    }
    Json file { { "Version", 1.0 } };
    file["Pattern"] = std::move (pattern);
    return file.dump();
}

std::string randomHaptic()
{
    Json amplitude = Json::array(), frequency = Json::array();
    double at = pick (0, 1) * part (0.0, 0.1);
    for (int n = pick (2, 8); n > 0; --n)
    {
        const double a = part (0.0, 0.8);
        Json point { { "time", at }, { "amplitude", a } };
        if (pick (0, 5) == 0) point["emphasis"] = Json { { "amplitude", part (a, 1.0) }, { "frequency", part (0.0, 1.0) } };
        amplitude.push_back (std::move (point));
        if (pick (0, 2) > 0) frequency.push_back (Json { { "time", at }, { "frequency", part (0.0, 1.0) } });
        at += part (0.05, 0.2);
    }
    Json envelopes { { "amplitude", std::move (amplitude) } };
    envelopes["frequency"] = std::move (frequency);
    Json file { { "version", Json { { "major", 1 } } } };
    file["signals"] = Json { { "continuous", Json { { "envelopes", std::move (envelopes) } } } };
    return file.dump();
}

bool mentions (const Messages& notes, const std::string& words)
{
    return std::ranges::any_of (notes, [&] (const Message& m) { return m.text.find (words) != std::string::npos; });
}
}   // namespace

TEST_CASE ("HJIF: a keyframe belongs to its own effect, and what has no amplitude plays at 1", "[clips]")
{
    // Two tones, each with one frequency: 100 Hz throughout the first second, 300 Hz throughout the third.
    const auto tones = hjif (Json::array ({ band ("VectorialWave", Json::array ({
                                                                       effect (0, Json::array ({ keyframe (0, 0.5, 100), keyframe (400, 0.5, {}) })),
                                                                       effect (800, Json::array ({ keyframe (0, 0.5, 300), keyframe (400, 0.5, {}) })),
                                                                   })) }));
    const auto samples = readers::renderSamples (read (tones, "a.hjif").clip, usual).at (1);
    for (std::size_t k = 0; k < usual.count; ++k)
    {
        const double t = usual[k], wanted = t < 0.4 ? std::sin (2.0 * pi * 100.0 * t) : t > 0.8 && t < 1.2 ? std::sin (2.0 * pi * 300.0 * (t - 0.8))
                                                                                                           : 0.0;
        REQUIRE (samples[k] == Approx (0.5 * wanted).margin (1e-9));
    }

    const auto sweep = hjif (
        Json::array ({ band ("VectorialWave", Json::array ({ effect (0, Json::array ({ keyframe (0, {}, 100), keyframe (1000, {}, 200) })) })) }));
    const auto swept = readers::renderSamples (read (sweep, "a.hjif").clip, usual).at (1);
    for (std::size_t k = 0; k < usual.count; ++k)
        REQUIRE (swept[k] == Approx (usual[k] < 1.0 ? std::sin (2.0 * pi * (100.0 * usual[k] + 50.0 * usual[k] * usual[k])) : 0.0).margin (1e-9));
}

TEST_CASE ("HJIF: the amplitude is held at both ends, signals are those of the file, and a phase is kept", "[clips]")
{
    const auto at = [] (const std::string& text, double t) {
        const SampleTimes one { .rate_hz = 1.0, .offset = t, .count = 1 };
        return readers::renderSamples (read (text, "a.hjif").clip, one).at (1)[0];
    };
    const auto one = [] (Json e, const char* type = "VectorialWave") { return hjif (Json::array ({ band (type, Json::array ({ std::move (e) })) })); };
    const auto held = one (effect (0, Json::array ({ keyframe (0, {}, 50), keyframe (300, 0.2, {}), keyframe (500, 0.4, {}), keyframe (1000, {}, {}) })));
    CHECK (at (held, 0.105) == Approx (0.2));
    CHECK (at (held, 0.405) == Approx (0.3 + 0.1 * 0.005 / 0.1));
    CHECK (at (held, 0.905) == Approx (0.4));
    const auto frames = [] { return Json::array ({ keyframe (0, 0.5, 50), keyframe (1000, 0.5, {}) }); };
    CHECK (at (one (effect (0, frames(), 0.5 * pi)), 0.2) == Approx (0.5));
    CHECK (at (one (effect (0, frames(), 0.0, "Square")), 0.2044) == Approx (0.5));
    CHECK (at (one (effect (0, frames(), 0.0, "Square")), 0.2144) == Approx (-0.5));
    CHECK (at (one (effect (0, frames(), 0.0, "SawToothUp")), 0.205) == Approx (0.25));
    CHECK (at (one (effect (0, frames(), 0.0, "SawToothDown")), 0.205) == Approx (-0.25));
    CHECK (at (one (effect (0, frames(), 0.0, "Triangle")), 0.205) == Approx (0.5));
    CHECK (at (one (effect (0, Json::array ({ keyframe (0, -0.5, 50), keyframe (1000, -0.5, {}) }))), 0.205) == Approx (-0.5));
    // A sine without a frequency is silent, and the report says so.
    const auto still = read (one (effect (0, Json::array ({ keyframe (0, 0.5, {}), keyframe (1000, 0.5, {}) }))), "a.hjif");
    CHECK (still.clip.tracks.empty());
    CHECK (mentions (still.leftOut(), "it is silent"));
}

TEST_CASE ("HJIF: positions that wrapped at 16 bits are negative, with a note, and many notes of a kind are one", "[clips]")
{
    const auto file = read (hjif (Json::array ({ band ("VectorialWave", Json::array ({
                                                                            effect (65534, Json::array ({ keyframe (0, 0.5, 100), keyframe (102, 0.5, {}) })),
                                                                            effect (200, Json::array ({ keyframe (65534, 0.5, 100), keyframe (100, 0.5, {}) })),
                                                                        })) })),
                            "a.hjif");
    REQUIRE (file.clip.tracks.size() == 1);
    CHECK (file.clip.lastEvent() == 0.3);
    CHECK (file.clip.tracks[0].amplitude.front().time == 0.0);
    CHECK (std::ranges::any_of (file.clip.tracks[0].amplitude, [] (const ClipPoint& p) { return p.time == 0.198; }));
    CHECK (mentions (file.leftOut(), "65534 is read as -2"));

    Json frames = Json::array();
    for (int k = 0; k < 901; ++k)
        frames.push_back (keyframe (k, 1.1 + 0.001 * k, 100));
    const auto loud = read (hjif (Json::array ({ band ("VectorialWave", Json::array ({ effect (0, std::move (frames)) })) })), "a.hjif");
    REQUIRE (loud.notes.size() == 1);
    CHECK (mentions (loud.notes, "and 900 more like it"));
}

TEST_CASE ("HJIF: a position just below 65536 after another one is what it seems, and Tactus writes none that could be taken for a negative one", "[clips]")
{
    const auto file = read (hjif (Json::array ({ band ("Transient", Json::array ({ effect (100, Json::array ({ keyframe (0, 0.5, {}) })),
                                                                                   effect (65500, Json::array ({ keyframe (0, 0.5, {}) })) })) })),
                            "a.hjif");
    REQUIRE (file.clip.tracks.size() == 1);
    REQUIRE (file.clip.tracks[0].taps.size() == 2);
    CHECK (file.clip.tracks[0].taps[1].time == 65.5);

    for (int tick = 65460; tick < 65546; ++tick)
    {
        Clip clip;
        clip.tracks.push_back ({ .amplitude = {}, .taps = { { tick / 48000.0, 0.5, 0.5 } } });
        clip.tracks.push_back ({ .amplitude = { { (tick + 7) / 48000.0, 0.5 }, { 2.0, 0.5 } } });
        const auto back = read (readers::writeClip (clip, "b.hjif")->text, "b.hjif");
        REQUIRE (back.clip.tracks.size() == 2);
        for (const auto& t : back.clip.tracks)
            CHECK ((t.taps.empty() ? t.amplitude.front().time - 7.0 / 48000.0 : t.taps.front().time) == Approx (tick / 48000.0).margin (2e-5));
    }
}

TEST_CASE ("random files sound as they are read", "[clips]")
{
    test::property ("HJIF", [] {
        for (int n = 0; n < 3; ++n)
        {
            const auto text = randomHjif();
            RC_LOG (text);
            RC_ASSERT (distanceFromFile (text, "a.hjif") < 0.02);   // waves in straight pieces
        }
    });
    test::property ("AHAP", [] {
        for (int n = 0; n < 3; ++n)
            RC_ASSERT (distanceFromFile (randomAhap(), "a.ahap") < 0.03);   // squares in straight pieces
    });
    test::property (".haptic", [] {
        for (int n = 0; n < 3; ++n)
            RC_ASSERT (distanceFromFile (randomHaptic(), "a.haptic") < 1e-6);
    });
}

TEST_CASE ("random files sound the same in the formats that hold them", "[clips]")
{
    const auto through = [] (const std::string& text, const std::string& name, const std::string& to) {
        RC_LOG (text);
        const auto clip = read (text, name);
        const auto written = readers::writeClip (clip.clip, to);
        RC_ASSERT (written);
        const auto out = readers::renderFile (written->text, to, {}, usual);
        return distance (*readers::renderFile (text, name, {}, usual), out ? *out : readers::renderSamples (read (written->text, to).clip, usual));
    };
    // An .hjif has whole Hz and ticks: tests/host/base/files/clip_reports_test.cpp checks what the report says of one.
    test::property ("HJIF in a clip of Tactus", [&] { RC_ASSERT (through (randomHjif(), "a.hjif", "b.json") < 0.02); });
    test::property ("AHAP in a clip of Tactus", [&] { RC_ASSERT (through (randomAhap(), "a.ahap", "b.json") < 0.03); });
    test::property (".haptic in a clip of Tactus", [&] { RC_ASSERT (through (randomHaptic(), "a.haptic", "b.json") < 1e-6); });
}

TEST_CASE ("AHAP: events that sound together stay so, and beat", "[clips]")
{
    const auto event = [] (double time, double duration, double intensity, double sharpness) {
        Json made { { "Time", time }, { "EventType", "HapticContinuous" }, { "EventDuration", duration } };
        made["EventParameters"] = Json::array ({ parameter ("HapticIntensity", intensity), parameter ("HapticSharpness", sharpness) });
        return Json { { "Event", std::move (made) } };
    };
    const auto file = [] (Json pattern) {
        Json made { { "Version", 1.0 } };
        made["Pattern"] = std::move (pattern);
        return made.dump();
    };
    Json curve { { "ParameterID", "HapticIntensityControl" }, { "Time", 0.1 } };
    curve["ParameterCurveControlPoints"] =
        Json::array ({ Json { { "Time", 0 }, { "ParameterValue", 1 } }, Json { { "Time", 0.9 }, { "ParameterValue", 0.2 } } });
    for (const auto& text :
         { file (Json::array ({ event (0.0, 1.2, 0.7, 0.8), event (0.0, 1.2, 0.7, 0.82) })),
           file (Json::array ({ event (0.0, 0.8, 0.7, 0.8), event (0.3, 0.9, 0.5, 0.4), Json { { "ParameterCurve", std::move (curve) } } })) })
    {
        const auto written = readers::writeClip (read (text, "a.ahap").clip, "b.ahap");
        REQUIRE (written);
        CHECK (written->losses.empty());
        CHECK (distance (*readers::renderFile (text, "a.ahap", {}, usual), *readers::renderFile (written->text, "b.ahap", {}, usual)) < 0.02);
    }
}

TEST_CASE ("AHAP: what is missing has its default, and attack, decay and release are within the duration", "[clips]")
{
    const auto clip = read (R"({ "Pattern": [ { "Event": { "EventType": "HapticContinuous", "EventDuration": 1, "EventParameters": [
        { "ParameterID": "AttackTime", "ParameterValue": 0.2 }, { "ParameterID": "ReleaseTime", "ParameterValue": 0.5 } ] } },
        { "Event": { "EventType": "HapticContinuous" } }, { "Event": { "EventType": "AudioCustom", "EventWaveformPath": "x.wav" } } ] })",
                            "a.ahap");
    REQUIRE (clip.clip.tracks.size() == 1);
    CHECK (clip.clip.lastEvent() == 1.0);
    const auto& points = clip.clip.tracks[0].amplitude;
    const auto at = [&] (double t) { return std::ranges::find_if (points, [&] (const ClipPoint& p) { return p.time >= t - 1e-9; })->value; };
    CHECK (at (0.1) == Approx (0.25).margin (0.01));
    CHECK (at (0.2) == Approx (1.0).margin (0.01));
    CHECK (at (0.75) == Approx (0.25).margin (0.01));
    CHECK (mentions (clip.leftOut(), "straight lines of as many seconds"));
    CHECK (mentions (clip.leftOut(), "it has no EventDuration"));
    CHECK (mentions (clip.leftOut(), "'x.wav'"));
}
