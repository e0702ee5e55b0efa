// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.hpp"

#include <host/base/assets/file_assets.hpp>
#include <host/base/files/clip_io.hpp>
#include <host/base/files/clip_samples.hpp>
#include <host/base/files/wav.hpp>
#include <tactus/file/csv.hpp>
#include <tactus/text/number_text.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

using namespace tactus;
using test::checkRefused;
using test::runTactus;
using test::Scratch;

namespace
{
constexpr auto effect = R"({ "version": { "major": 1 }, "signals": { "continuous": { "envelopes": {
    "amplitude": [ { "time": 0, "amplitude": 0.5 },
        { "time": 0.25, "amplitude": 1, "emphasis": { "amplitude": 1, "frequency": 0.5 } }, { "time": 0.5, "amplitude": 0 } ],
    "frequency": [ { "time": 0, "frequency": 0.5 } ], } } } })";

bool has (const std::string& text, const std::string& words) { return text.find (words) != std::string::npos; }

test::Ran converted (const std::vector<std::string>& arguments)
{
    auto all = arguments;
    all.insert (all.begin(), "convert");
    const auto ran = runTactus (all);
    INFO (ran.out << ran.err);
    CHECK (ran.status == 0);
    return ran;
}
}   // namespace

TEST_CASE ("convert: a clip goes through every format, and each says what it lost", "[cli][clips]")
{
    const Scratch scratch;
    const auto haptic = scratch.write ("a.haptic", effect);
    auto ran = converted ({ haptic, scratch.path ("a.json") });
    CHECK (has (ran.err, "a.haptic:4:53: warning: the file has commas before a closing bracket"));
    CHECK (has (ran.out, "1 track, 5 points and transients, 0.5 s"));
    CHECK (has (ran.out, "loss: none in the rendered envelope and frequency"));

    ran = converted ({ scratch.path ("a.json"), scratch.path ("a.ahap") });
    CHECK (has (ran.err, "the envelope is 20 % lower at each"));
    CHECK (has (ran.out, "loss: all channels, as a phone plays the file: the envelope differs by "));
    ran = converted ({ scratch.path ("a.json"), scratch.path ("a.hjif") });
    CHECK (has (ran.out, "loss: "));
    ran = converted ({ scratch.path ("a.json"), scratch.path ("a.csv") });
    CHECK (has (ran.out, "loss: none"));
    converted ({ scratch.path ("a.csv"), scratch.path ("b.json") });
    converted ({ scratch.path ("a.hjif"), scratch.path ("b.haptic") });
    converted ({ scratch.path ("b.json"), scratch.path ("b.csv") });
    CHECK (test::textOf (scratch.path ("b.csv")) == test::textOf (scratch.path ("a.csv")));
}

TEST_CASE ("convert: --split keeps the curves of an AHAP off its transients", "[cli][clips]")
{
    const Scratch scratch;
    const auto ran = converted ({ scratch.write ("a.haptic", effect), scratch.path ("a.ahap"), "--split" });
    CHECK (has (test::textOf (scratch.path ("a.ahap")), "HapticContinuous"));
    CHECK (! has (test::textOf (scratch.path ("a.ahap")), "HapticTransient"));
    CHECK (has (test::textOf (scratch.path ("a_transients.ahap")), "HapticTransient"));
    CHECK (! has (test::textOf (scratch.path ("a_transients.ahap")), "ParameterCurve"));
}

TEST_CASE ("convert: a WAV is the rendered clip, and comes back as it was", "[cli][clips]")
{
    const Scratch scratch;
    const auto haptic = scratch.write ("a.haptic", effect);
    const auto ran = converted ({ haptic, scratch.path ("a.wav"), "--rate", "4000" });
    CHECK (has (ran.out, "loss: channel 1: the envelope differs by "));
    const auto wav = host::readWav (scratch.path ("a.wav"));
    REQUIRE (wav);
    CHECK (wav->rate_hz == 4000.0);
    REQUIRE (wav->channels.at (0).size() == 2000);
    double peak = 0.0;   // the signal exceeds 1, and is divided by its largest value
    const auto rendered = host::renderClip (host::loadClip (haptic)->clip, 4000.0);
    for (const double v : rendered.value[0])
        peak = std::max (peak, std::abs (v));
    CHECK (peak * wav->channels[0][3] == Approx (0.506 * std::sin (2.0 * 3.14159265358979 * 127.5 * 3.0 / 4000.0)).epsilon (0.01));

    converted ({ scratch.path ("a.wav"), scratch.path ("wave.json") });
    CHECK (has (converted ({ scratch.path ("wave.json"), scratch.path ("b.wav") }).out, "loss: none"));
    const auto back = host::readWav (scratch.path ("b.wav"));
    REQUIRE (back);
    CHECK (back->rate_hz == 4000.0);
    REQUIRE (back->channels.at (0).size() == 2000);
    CHECK (back->channels == wav->channels);
}

TEST_CASE ("convert: a clip whose parts add up to more than 1 becomes a WAV that a clip node plays, and a warning names the gain", "[cli][clips]")
{
    const Scratch scratch;
    const auto loud = scratch.write ("loud.json", R"({ "format": "tactus-clip", "version": 1, "tracks": [
        { "channel": 1, "amplitude": [[0, 1], [1, 1]], "sharpness": [[0, 0.5]] },
        { "channel": 1, "amplitude": [[0, 0.75], [1, 0.75]], "sharpness": [[0, 0.6]] } ] })");
    const auto wav = scratch.path ("loud.wav");
    const auto ran = converted ({ loud, wav, "--rate", "4000" });
    CHECK (has (ran.err, "[clip/changed]"));
    const auto written = host::readWav (wav);
    REQUIRE (written);
    const auto read = host::loadClip (loud);
    REQUIRE (read);
    const auto rendered = host::renderClip (read->clip, 4000.0);
    double peak = 0.0, largest = 0.0;
    for (std::size_t i = 0; i < rendered.value[0].size(); ++i)
    {
        peak = std::max (peak, std::abs (rendered.value[0][i]));
        largest = std::max (largest, std::abs (written->channels[0][i]));
    }
    REQUIRE (peak > 1.5);
    CHECK (largest == 1.0);
    CHECK (has (ran.err, "by " + roundedText (peak)));
    for (std::size_t i = 0; i < rendered.value[0].size(); ++i)
        REQUIRE (peak * written->channels[0][i] == Approx (rendered.value[0][i]).margin (1e-6));
    host::FileAssets assets;
    CHECK (assets.table (wav));
    const auto again = converted ({ wav, scratch.path ("again.wav") });   // the round trip changes nothing
    CHECK (again.err == "");
    CHECK (test::textOf (scratch.path ("again.wav")) == test::textOf (wav));
}

TEST_CASE ("convert: a clip of Meta loses almost nothing in an AHAP, and the report says apart what a phone makes of it", "[cli][clips][data]")
{
    const auto folder = test::sharedData ("haptic_meta");
    if (folder.empty()) return;
    const Scratch scratch;
    const auto ran = converted ({ folder + "/multiple_emphasis.haptic", scratch.path ("a.ahap") });
    INFO (ran.out);
    CHECK (has (ran.out, "all channels, as a phone plays the file: the envelope differs by"));
    CHECK (has (ran.out, "as in files of Meta's converter"));
    const auto saved = host::saveClip (host::loadClip (folder + "/multiple_emphasis.haptic")->clip, scratch.path ("b.ahap"));
    REQUIRE (saved);
    REQUIRE (saved->differences.size() == 3);
    CHECK (saved->differences[0].difference.part() < 0.06);   // between its points, intensity is straight, not amplitude
    CHECK (saved->differences[1].difference.part() < 0.01);
    CHECK (saved->differences[2].difference.part() > 0.3);
}

TEST_CASE ("convert: tables of envelopes and of samples are clips", "[cli][clips]")
{
    const Scratch scratch;
    const auto envelope = scratch.write ("e.csv", "t,amplitude,sharpness,value_2\n0,0.5,0.2,1\n1,1,0.4,-3\n");
    const auto ran = converted ({ envelope, scratch.path ("e.json") });
    CHECK (has (ran.err, "the values are divided by 3"));
    CHECK (has (ran.out, "2 tracks, 6 points"));
    converted ({ scratch.path ("e.json"), scratch.path ("e2.csv"), "--rate", "1000" });
    const auto samples = readTable (std::filesystem::path (scratch.path ("e2.csv")));
    REQUIRE (samples);
    CHECK (samples->rows() == 1000);
    CHECK (samples->columns == std::vector<std::string> { "t", "value", "amplitude", "frequency", "value_2", "amplitude_2", "frequency_2" });
}

TEST_CASE ("convert: a calibration sets the frequencies of a clip", "[cli][clips]")
{
    const Scratch scratch;
    const auto acf = scratch.write ("a.acf", R"({ continuous: { frequency_min: 20, frequency_max: 250 }, emphasis: {
        frequency_min: { output_frequency: 50, duration_ms: 40, shape: 'sine' },
        frequency_max: { output_frequency: 100, duration_ms: 20, shape: 'sine' }, }, })");
    converted ({ scratch.write ("a.haptic", effect), scratch.path ("a.json"), "--calibration", acf });
    CHECK (has (test::textOf (scratch.path ("a.json")), "\"lowest\": 20.0"));
}

TEST_CASE ("convert: what is wrong is refused, and nothing is written", "[cli][clips]")
{
    const Scratch scratch;
    const auto haptic = scratch.write ("a.haptic", effect), broken = scratch.write ("b.haptic", "{ \"version\": { \"major\": 2 } }");
    checkRefused ({ "convert", broken, scratch.path ("o.ahap") }, 1, "b.haptic:1:16: error: /version/major: version 2 is not known", scratch.path ("o.ahap"));
    checkRefused ({ "convert", haptic, scratch.path ("o.xyz") }, 1, "clip/unknown_kind", scratch.path ("o.xyz"));
    checkRefused ({ "convert", scratch.path ("none.ahap"), scratch.path ("o.ahap") }, 1, "none.ahap", scratch.path ("o.ahap"));
    checkRefused ({ "convert", haptic, scratch.path ("o.json"), "--split" }, 2, "--split", scratch.path ("o.json"));
    checkRefused ({ "convert", scratch.write ("c.csv", "a,b\n1,2\n"), scratch.path ("o.json") }, 1, "clip/columns", scratch.path ("o.json"));
    checkRefused ({ "convert", haptic, scratch.path ("o.json"), "--lift", "3 mm" }, 2, "--lift", scratch.path ("o.json"));
    const auto pen = scratch.write ("pen.events", "E: x\n");
    checkRefused ({ "convert", pen, scratch.path ("o.csv") }, 1, "pen.events, line 1: error: not an event", scratch.path ("o.csv"));
    checkRefused ({ "convert", pen, scratch.path ("o.wav") }, 2, "a .csv", scratch.path ("o.wav"));
    checkRefused ({ "convert", pen, scratch.path ("o.csv"), "--split" }, 2, "--split", scratch.path ("o.csv"));
    const auto ran = runTactus ({ "convert", haptic, haptic });
    CHECK (ran.status == 1);
    CHECK (has (ran.err, "output/is_input"));
}

TEST_CASE ("convert: what the reader left out is a loss, and two tones that become one are too", "[cli][clips]")
{
    const Scratch scratch;
    const auto event = [] (const std::string& sharpness) {
        return R"({ "Event": { "Time": 0, "EventType": "HapticContinuous", "EventDuration": 2, "EventParameters": [
            { "ParameterID": "HapticIntensity", "ParameterValue": 0.6 }, { "ParameterID": "HapticSharpness", "ParameterValue": )"
               + sharpness + " } ] } }";
    };
    const auto beat = scratch.write ("beat.ahap", "{ \"Pattern\": [ " + event ("0.8") + ", " + event ("0.82") + " ] }");
    CHECK (has (converted ({ beat, scratch.path ("b.haptic") }).out, "loss: all channels: the samples differ by "));
    auto ran = converted ({ beat, scratch.path ("b.ahap") });
    CHECK (
        has (ran.out,
             "loss: none in the rendered envelope and frequency; the samples differ by less than 0.1 % from an independent rendering of beat.ahap"));

    const auto sound = scratch.write ("sound.ahap", "{ \"Pattern\": [ " + event ("0.8") + R"(, { "Event": { "Time": 0, "EventType": "AudioCustom",
        "EventWaveformPath": "x.wav" } } ] })");
    ran = converted ({ sound, scratch.path ("s.json") });
    CHECK (has (ran.out, "the sound 'x.wav' is left out"));
    CHECK (has (ran.out, "loss: nothing else in the rendered envelope and frequency"));
    CHECK (! has (ran.out, "loss: none"));
    CHECK (has (ran.err, "the sound 'x.wav' is left out"));
}
