// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/file/clips/clip_difference.hpp>
#include <tactus/file/clips/clip_file.hpp>
#include <tactus/file/clips/relaxed_json.hpp>

#include <tactus/file/assets/file_assets.hpp>

#include "support/temporary_folder.hpp"
#include "support/with_limits.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace tactus;
using readers::readClip;
using readers::writeClip;

namespace
{
std::string problem (const std::string& text, const std::string& name)
{
    const auto read = readClip (text, name);
    return read ? "" : read.error().id + " at " + read.error().where;
}

std::vector<std::string> idsOf (const Messages& messages)
{
    std::vector<std::string> ids;
    for (const auto& m : messages)
        ids.push_back (m.id + " at " + m.where);
    return ids;
}

Clip read (const std::string& text, const std::string& name)
{
    const auto clip = readClip (text, name);
    INFO ((clip ? "" : describe (clip.error())));
    REQUIRE (clip);
    return clip->clip;
}

std::string haptic (const std::string& points, const std::string& frequency = "")
{
    return R"({ "version": { "major": 1 }, "signals": { "continuous": { "envelopes": {
"amplitude": [)"
           + points
           + "]" + (frequency.empty() ? "" : ",\n\"frequency\": [" + frequency + "]") + " } } } }";
}

/// Some track that every format can hold: times and values on a coarse grid, the first point at 0.
Clip randomClip()
{
    Clip clip;
    auto& track = clip.tracks.emplace_back();
    double time = 0.0;
    for (int n = *rc::gen::inRange (2, 40); n > 0; --n)
    {
        track.amplitude.push_back ({ time, 0.01 * *rc::gen::inRange (1, 101) });
        track.sharpness.push_back ({ time, 0.01 * *rc::gen::inRange (0, 101) });
        time += 0.001 * *rc::gen::inRange (5, 200);
    }
    for (const auto& p : track.amplitude)
        if (*rc::gen::inRange (0, 4) == 0)
            track.taps.push_back ({ p.time, std::max (p.value, 0.8), *rc::gen::inRange (0, 111) / 110.0 });   // whole Hz, as in HJIF
    return clip;
}

double lossOf (const Clip& clip, const Clip& back)
{
    double worst = 0.0;
    for (const auto& d : readers::compareClips (clip, back, false))
        worst = std::max (worst, d.part());
    return worst;
}
}   // namespace

TEST_CASE ("a .haptic file becomes an envelope, a sharpness and transients", "[clips]")
{
    const auto clip = read (haptic (R"({ "time": 0, "amplitude": 0.2 }, { "time": 0.5, "amplitude": 0.4, "emphasis": { "amplitude": 0.6, "frequency": 0.7 } },
                                       { "time": 1, "amplitude": 0 })",
                                    R"({ "time": 0.1, "frequency": 0.3 })"),
                            "a.haptic");
    REQUIRE (clip.tracks.size() == 1);
    const auto& track = clip.tracks[0];
    CHECK (track.amplitude == std::vector<ClipPoint> { { 0.0, 0.2 }, { 0.5, 0.4 }, { 1.0, 0.0 } });
    CHECK (track.sharpness == std::vector<ClipPoint> { { 0.1, 0.3 } });
    CHECK (track.taps == std::vector<ClipTap> { { 0.5, 0.6, 0.7 } });
}

TEST_CASE ("a .haptic file that breaks its rules is refused at its place", "[clips]")
{
    CHECK (problem (haptic (R"({ "time": 0, "amplitude": 0.2 })"), "a.haptic") == "clip/too_few at a.haptic:2:1");
    CHECK (problem (haptic (R"({ "time": 0, "amplitude": 0.2 }, { "time": 0, "amplitude": 0.2 })"), "a.haptic") == "clip/range at a.haptic:2:1");
    CHECK (problem (haptic ("{ \"time\": 1, \"amplitude\": 0.2 },\n{ \"time\": 0.5, \"amplitude\": 0.2 }"), "a.haptic") == "clip/order at a.haptic:3:3");
    CHECK (problem (haptic ("{ \"time\": 0, \"amplitude\": 0.2 },\n{ \"time\": 0.5, \"amplitude\": 1.2 }"), "a.haptic") == "clip/range at a.haptic:3:16");
    CHECK (
        problem (haptic ("{ \"time\": 0, \"amplitude\": 0.5, \"emphasis\": { \"amplitude\": 0.1, \"frequency\": 0 } },\n{ \"time\": 0.5, \"amplitude\": 0 }"),
                 "a.haptic")
        == "clip/range at a.haptic:2:60");
    CHECK (problem (R"({ "version": { "major": 2 } })", "a.haptic") == "clip/version at a.haptic:1:16");
    CHECK (problem (R"({ "version": { "major": 1 }, "sssignals": {} })", "a.haptic") == "clip/missing at a.haptic:1:1");
    CHECK (problem ("{ \"version\": ", "a.haptic") == "clip/syntax at a.haptic:1:14");
    CHECK (problem ("[]", "a.haptic") == "clip/kind at a.haptic:1:1");
    CHECK (problem ("{}", "a.xyz") == "clip/unknown_kind at a.xyz");
    CHECK (problem (R"({ "format": "tactus-graph" })", "a.json") == "clip/unknown_kind at a.json:1:1");
}

TEST_CASE ("habits of real clip files are accepted and said, and positions stay those of the file", "[clips]")
{
    const auto made = readers::readRelaxedJson ("// a comment\n{ name: 'it\\'s \"so\"', list: [1, +2, .5, 3.,],\n  \"last\": -7, }");
    REQUIRE (made.json.messages.empty());
    CHECK (made.json.root.at ("name").asString() == "it's \"so\"");
    CHECK (made.json.root.at ("list").get<std::vector<double>>() == std::vector<double> { 1, 2, 0.5, 3 });
    CHECK (made.json.positions.at ("/list") == TextPosition { 2, 23 });
    CHECK (made.json.positions.at ("/last") == TextPosition { 3, 3 });
    std::vector<std::string> whats;
    for (const auto& h : made.habits)
        whats.push_back (h.what);
    CHECK (whats
           == std::vector<std::string> { "comments", "keys without quotation marks", "text in single quotes", "plus signs",
                                         "numbers that begin or end with a point", "commas before a closing bracket" });

    const auto clip = readClip ("{ \"Pattern\": [\n{ \"Event\": { \"Time\": 0, \"EventType\": \"HapticTransient\" } },\n] }", "a.ahap");
    REQUIRE (clip);
    CHECK (idsOf (clip->notes) == std::vector<std::string> { "clip/habit at a.ahap:2:59" });
}

TEST_CASE ("an AHAP plays as intensity times its curves, squared", "[clips]")
{
    const auto clip = read (R"({ "Pattern": [
        { "Event": { "Time": 0, "EventType": "HapticContinuous", "EventDuration": 1, "EventParameters": [
            { "ParameterID": "HapticIntensity", "ParameterValue": 0.8 }, { "ParameterID": "HapticSharpness", "ParameterValue": 0.6 } ] } },
        { "ParameterCurve": { "ParameterID": "HapticIntensityControl", "Time": 0.2, "ParameterCurveControlPoints": [
            { "Time": 0, "ParameterValue": 1 }, { "Time": 0.6, "ParameterValue": 0 } ] } },
        { "ParameterCurve": { "ParameterID": "HapticSharpnessControl", "Time": 0, "ParameterCurveControlPoints": [
            { "Time": 0, "ParameterValue": 0 }, { "Time": 1, "ParameterValue": 1 } ] } },
        { "Event": { "Time": 0.5, "EventType": "HapticTransient", "EventParameters": [ { "ParameterID": "HapticIntensity", "ParameterValue": 1 } ] } } ] })",
                            "a.ahap");
    REQUIRE (clip.tracks.size() == 1);
    const auto& track = clip.tracks[0];
    const auto at = [] (const std::vector<ClipPoint>& points, double t) {
        std::size_t i = 1;
        while (points[i].time < t)
            ++i;
        return points[i - 1].value + (points[i].value - points[i - 1].value) * (t - points[i - 1].time) / (points[i].time - points[i - 1].time);
    };
    for (const double t : { 0.1, 0.25, 0.5, 0.77, 0.9 })
    {
        const double curve = t < 0.2 ? 1.0 : std::max (0.0, 1.0 - (t - 0.2) / 0.6), sharp = std::min (1.0, 0.6 + t);
        CHECK (at (track.amplitude, t) == Approx (0.64 * curve * curve).margin (6e-4));
        CHECK (at (track.sharpness, t) == Approx (sharp * sharp).margin (6e-4));
    }
    REQUIRE (track.taps.size() == 1);
    CHECK (track.taps[0].amplitude == Approx (0.25));
    CHECK (track.taps[0].sharpness == 1.0);
}

TEST_CASE ("a .haptic file goes to AHAP by the rules of Meta: square roots, 16 points, 30 s", "[clips]")
{
    Clip clip;
    auto& track = clip.tracks.emplace_back();
    for (int i = 0; i < 40; ++i)
        track.amplitude.push_back ({ 1.0 * i, 0.01 * i });
    track.sharpness = { { 0.0, 0.25 }, { 39.0, 1.0 } };
    track.taps = { { 4.0, 0.36, 0.7 } };
    const auto made = writeClip (clip, "a.ahap");
    REQUIRE (made);
    const auto pattern = Json::parse (made->text).at ("Pattern");
    std::vector<double> values, durations;
    std::size_t curves = 0;
    for (const auto& entry : pattern)
    {
        if (entry.contains ("Event") && entry.at ("Event").contains ("EventDuration"))
            durations.push_back (entry.at ("Event").at ("EventDuration").get<double>());
        if (! entry.contains ("ParameterCurve") || entry.at ("ParameterCurve").at ("ParameterID").asString() != "HapticIntensityControl") continue;
        const auto& points = entry.at ("ParameterCurve").at ("ParameterCurveControlPoints");
        CHECK (points.size() <= 16);
        if (curves++ > 0) CHECK (points[0].at ("ParameterValue").get<double>() == values.back());
        for (std::size_t i = curves > 1 ? 1 : 0; i < points.size(); ++i)
            values.push_back (points[i].at ("ParameterValue").get<double>());
    }
    CHECK (curves == 3);
    CHECK (durations == std::vector<double> { 30.0, 9.0 });
    REQUIRE (values.size() == 40);
    for (std::size_t i = 0; i < 40; ++i)
        CHECK (values[i] == Approx (std::sqrt (0.01 * static_cast<double> (i)) * (i == 4 ? 0.8 : 1.0)));
    const auto& tap = pattern.back().at ("Event");
    CHECK (tap.at ("EventParameters")[0].at ("ParameterValue").get<double>() == Approx (0.6));
    CHECK (tap.at ("EventParameters")[1].at ("ParameterValue").get<double>() == 0.7);
    CHECK (idsOf (made->losses) == std::vector<std::string> { "clip/not_carried at transients" });
}

TEST_CASE ("HJIF: waves, curves and transients are read, drafts too, and what is not decoded is said", "[clips]")
{
    const auto file = [] (const std::string& channels, const std::string& bands) {
        return R"({ "version": "2023", "timescale": 1000, "perceptions": [ { "perception_modality": "Vibrotactile", ")" + channels
               + R"(": [ { "id": 0, "gain": 0.5, "bands": [ )" + bands + " ] } ] } ] }";
    };
    const std::string frames = R"("effects": [ { "effect_type": "Basis", "position": 100, "keyframes": [
        { "relative_position": 0, "amplitude_modulation": 1.0, "frequency_modulation": 80 },
        { "relative_position": 200, "amplitude_modulation": 0.0, "frequency_modulation": 160 } ] } ])";
    const auto wave =
        read (file ("channels", R"({ "band_type": "VectorialWave", "lower_frequency_limit": 60, "upper_frequency_limit": 160, )" + frames + " }"), "a.hjif");
    REQUIRE (wave.tracks.size() == 1);
    CHECK (wave.voice.lowest == 60.0);
    CHECK (wave.voice.highest == 160.0);
    CHECK (wave.tracks[0].amplitude == std::vector<ClipPoint> { { 0.1, 0.5 }, { 0.3, 0.0 } });
    CHECK (wave.tracks[0].sharpness[0].value == Approx (0.2));

    const auto curve = read (file ("channels", R"({ "band_type": "Curve", "curve_type": "Linear", )" + frames + " }"), "a.hjif");
    CHECK (curve.tracks.at (0).is_wave);
    const auto taps =
        read (file ("channels", R"({ "band_type": "Transient", "lower_frequency_limit": 80, "upper_frequency_limit": 160, )" + frames + " }"), "a.hjif");
    CHECK (taps.tracks.at (0).taps == std::vector<ClipTap> { { 0.1, 0.5, 0.0 }, { 0.3, 0.0, 1.0 } });

    const auto draft = readClip (
        file ("tracks", R"({ "band_type": "Wave", "encoding_modality": "Vectorial", )" + frames + " }, { \"band_type\": \"WaveletWave\" }"), "a.hjif");
    REQUIRE (draft);
    CHECK (draft->clip.tracks.size() == 1);
    std::vector<std::string> ids;
    for (const auto& n : draft->notes)
        ids.push_back (n.id);
    CHECK (ids == std::vector<std::string> { "clip/habit", "clip/habit", "clip/not_carried" });
}

TEST_CASE ("a calibration says what 0 and 1 mean, and what of it is not played", "[clips]")
{
    ClipVoice voice;
    const auto read = readers::readCalibration (
        "{ metadata: { device: 'Board' }, continuous: { gain: 1.0, emphasis_ducking: 0.5, frequency_min: 20, frequency_max: 250, },\n"
        "  emphasis: { gain: 1, frequency_min: { output_frequency: 50, duration_ms: 40, shape: 'sine' },\n"
        "    frequency_max: { output_frequency: 100, duration_ms: 20, shape: 'square' } } }",
        "a.acf", voice);
    REQUIRE (read);
    CHECK (voice == ClipVoice { 20.0, 250.0, 50.0, 100.0, 0.5 });
    CHECK (std::ranges::count (*read, std::string ("clip/not_carried"), &Message::id) == 1);   // the square
}

TEST_CASE ("there and back, a clip of Tactus is the same, and other formats lose what they say", "[clips]")
{
    test::property ("random clips", [] {
        const auto clip = randomClip();
        for (const auto* name : { "a.json", "a.hjif", "a.haptic" })
        {
            const auto text = writeClip (clip, name);
            RC_ASSERT (bool (text));
            const auto back = readClip (text->text, name);
            RC_ASSERT (bool (back));
            if (std::string (name) == "a.json") RC_ASSERT (back->clip == clip);
            RC_ASSERT (lossOf (clip, back->clip) < 0.01);
        }
        Clip tones = clip;
        tones.tracks[0].taps.clear();
        const auto once = readClip (writeClip (tones, "a.ahap")->text, "a.ahap")->clip;
        const auto twice = readClip (writeClip (once, "a.ahap")->text, "a.ahap")->clip;
        RC_ASSERT (lossOf (once, twice) < 0.01);
    });
}

TEST_CASE ("several tracks and waves become one track where a format has one, and that is said", "[clips]")
{
    Clip clip;
    clip.tracks.push_back ({ .amplitude = { { 0.0, 0.25 }, { 1.0, 0.25 } }, .sharpness = { { 0.0, 0.1 } } });
    clip.tracks.push_back ({ .channel = 2, .amplitude = { { 0.5, 0.5 }, { 1.5, 0.5 } }, .sharpness = { { 0.0, 0.9 } }, .taps = { { 0.2, 1.0, 0.5 } } });
    const auto made = writeClip (clip, "a.haptic");
    REQUIRE (made);
    CHECK (idsOf (made->losses) == std::vector<std::string> { "clip/not_carried at channels", "clip/not_carried at tracks" });
    const auto back = read (made->text, "a.haptic");
    CHECK (readers::compareClips (clip, back, true)[0].part() < 1e-3);

    Clip wave;
    auto& track = wave.tracks.emplace_back (ClipTrack { .is_wave = true });
    for (int i = 0; i <= 8000; ++i)
        track.amplitude.push_back ({ i / 8000.0, 0.5 * std::sin (2.0 * 3.14159265358979 * 120.0 * i / 8000.0) });
    const auto drawn = read (writeClip (wave, "a.haptic")->text, "a.haptic");
    const auto middle = std::ranges::find_if (drawn.tracks[0].amplitude, [] (const ClipPoint& p) { return p.time > 0.5; });
    CHECK (middle->value == Approx (0.5).epsilon (0.01));
    const auto sharp = std::ranges::find_if (drawn.tracks[0].sharpness, [] (const ClipPoint& p) { return p.time > 0.5; });
    CHECK (55.0 + 145.0 * sharp->value == Approx (120.0).margin (5.0));
}

TEST_CASE ("a clip comes to a node as a table, and the budgets hold for it", "[clips]")
{
    const TemporaryFolder folder;
    const auto text = haptic (R"({ "time": 0, "amplitude": 0.2 }, { "time": 1, "amplitude": 0 })");
    folder.write ("a.haptic", text);
    folder.write ("b.json", "{}");
    readers::FileAssets files;
    const auto table = files.table ((folder / "a.haptic").string());
    REQUIRE (table);
    CHECK (clipOf (**table).clip.tracks[0].amplitude.size() == 2);
    const auto none = files.table ((folder / "b.json").string());
    REQUIRE (! none);
    CHECK (none.error().id == "clip/unknown_kind");
    const WithLimits limits ("values=5");
    CHECK (problem (text, "a.haptic").starts_with ("clip/too_large at "));
}
