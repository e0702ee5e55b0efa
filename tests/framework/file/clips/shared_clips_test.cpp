// SPDX-License-Identifier: MIT
// Clip files made by others, if they are there: ../shared/data/haptic_*.
#include <tactus/file/clips/clip_difference.hpp>
#include <tactus/file/clips/clip_file.hpp>
#include <tactus/kit/signal/clip_score.hpp>
#include <tactus/text/json_text.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

using namespace tactus;
namespace fs = std::filesystem;

namespace
{
/// All files below the folders haptic_* with this extension, in order.
std::vector<fs::path> filesOf (const std::string& extension)
{
    std::vector<fs::path> files;
    const fs::path data = TACTUS_SHARED_DATA;
    if (fs::exists (data))
        for (const auto& entry : fs::recursive_directory_iterator (data))
            if (entry.path().extension() == extension && entry.path().generic_string().find ("/haptic_") != std::string::npos) files.push_back (entry.path());
    if (files.empty()) WARN ("skipped: there are no " << extension << " files in " << data.string());
    std::ranges::sort (files);
    return files;
}

std::string textOf (const fs::path& path)
{
    std::ostringstream text;
    text << std::ifstream (path, std::ios::binary).rdbuf();
    return text.str();
}

/// The files that break a rule of their format, by name.
bool isInvalid (const fs::path& path)
{
    static const std::set<std::string> names { "invalid_empty_amplitude_envelope", "invalid_fields_v1", "invalid_single_amplitude_breakpoint", "one_amp_bp",
                                               "one_amp_bp_multiple_freq_bps", "invalid_version_v1", "truncate_before_1_bp", "validation_v1_amplitude",
                                               "validation_v1_emphasis_amplitude", "validation_v1_emphasis_amplitude_range",
                                               "validation_v1_emphasis_frequency_range", "validation_v1_sequence" };
    return names.contains (path.stem().string());
}

/// Renders a clip, and writes it in every format. What a format changes in the envelope by more than 1 % must be among its losses.
void checkOut (const Clip& clip)
{
    const ClipScore score (clip);
    std::vector<ClipScore::Cursor> cursors (score.size());
    double loudest = 0.0;
    for (double t = 0.0; t < std::min (score.duration(), 60.0); t += 1e-3)
        loudest = std::max (loudest, score (t, 0.0, cursors.data()).amplitude);
    CHECK (loudest >= 0.0);
    CHECK (loudest <= score.peak() + 1e-12);
    for (const auto* name : { "a.haptic", "a.ahap", "a.hjif", "a.json" })
    {
        INFO (name);
        const auto made = readers::writeClip (clip, name);
        REQUIRE (made);
        const auto back = readers::readClip (made->text, name);
        INFO ((back ? "" : describe (back.error())));
        REQUIRE (back);
        const bool mixed = std::string (name) == "a.haptic" || std::string (name) == "a.ahap";
        const auto difference = readers::compareClips (clip, back->clip, mixed);
        if (std::string (name) != "a.ahap")
            for (const auto& d : difference)
                CHECK ((d.part() < 0.01 || ! made->losses.empty()));
        else if (std::ranges::all_of (clip.tracks, [] (const ClipTrack& t) { return t.taps.empty(); }))
        {
            // An AHAP is straight in the square root, so the clip changes once, which `tactus convert` measures. Further conversions change
            // nothing more.
            const auto again = readers::readClip (readers::writeClip (back->clip, name)->text, name);
            REQUIRE (again);
            CHECK (readers::compareClips (back->clip, again->clip, true)[0].part() < 0.01);
        }
    }
}
}   // namespace

TEST_CASE ("every .haptic file of others comes in, plays and goes out, and the broken ones are refused at their place", "[clips][data]")
{
    for (const auto& path : filesOf (".haptic"))
    {
        INFO (path.string());
        const auto read = readers::readClip (textOf (path), path.filename().string());
        INFO ((read ? "" : describe (read.error())));
        REQUIRE (bool (read) != isInvalid (path));
        if (read)
            checkOut (read->clip);
        else
            CHECK (std::ranges::count (read.error().where, ':') == 2);
    }
}

TEST_CASE ("every AHAP of others comes in, plays and goes out", "[clips][data]")
{
    for (const auto& path : filesOf (".ahap"))
    {
        INFO (path.string());
        const auto text = textOf (path);
        const auto read = readers::readClip (text, path.filename().string());
        INFO ((read ? "" : describe (read.error())));
        REQUIRE (read);
        CHECK (read->clip.events() > 0);
        const bool is_strict = readJson (text).messages.empty();
        CHECK (is_strict == std::ranges::none_of (read->notes, [] (const Message& m) { return m.id == "clip/habit"; }));
        checkOut (read->clip);
    }
}

TEST_CASE ("the calibrations of others come in", "[clips][data]")
{
    for (const auto& path : filesOf (".acf"))
    {
        INFO (path.string());
        ClipVoice voice;
        CHECK (readers::readCalibration (textOf (path), path.filename().string(), voice));
        CHECK (voice.lowest > 0.0);
    }
}

namespace
{
/// Points (time, value) of all curves of a pattern with this id, and the events of a type: times and parameters.
std::vector<ClipPoint> curveOf (const Json& file, const std::string& id)
{
    std::vector<ClipPoint> points;
    for (const auto& entry : file.at ("Pattern"))
        if (entry.contains ("ParameterCurve") && entry.at ("ParameterCurve").at ("ParameterID").asString() == id)
            for (const auto& p : entry.at ("ParameterCurve").at ("ParameterCurveControlPoints"))
                if (const ClipPoint point { p.at ("Time").get<double>(), p.at ("ParameterValue").get<double>() }; points.empty() || points.back() != point)
                    points.push_back (point);
    return points;
}

std::vector<double> eventsOf (const Json& file, const std::string& type)
{
    std::vector<double> numbers;
    for (const auto& entry : file.at ("Pattern"))
        if (entry.contains ("Event") && entry.at ("Event").at ("EventType").asString() == type)
        {
            const auto& event = entry.at ("Event");
            numbers.push_back (event.at ("Time").get<double>());
            if (event.contains ("EventDuration")) numbers.push_back (event.at ("EventDuration").get<double>());
            for (const auto& p : event.at ("EventParameters"))
                numbers.push_back (p.at ("ParameterValue").get<double>());
        }
    return numbers;
}
}   // namespace

TEST_CASE ("a .haptic file goes to AHAP as Meta's own converter writes it", "[clips][data]")
{
    int pairs = 0;
    for (const auto& path : filesOf (".ahap"))
    {
        auto haptic = path;
        haptic.replace_extension (".haptic");
        if (! fs::exists (haptic)) continue;
        ++pairs;
        INFO (path.string());
        const auto ours = Json::parse (readers::writeClip (readers::readClip (textOf (haptic), "a.haptic")->clip, "a.ahap")->text);
        const auto theirs = Json::parse (textOf (path));
        for (const auto* id : { "HapticIntensityControl", "HapticSharpnessControl" })
        {
            INFO (id);
            const auto a = curveOf (ours, id), b = curveOf (theirs, id);
            REQUIRE (a.size() == b.size());
            for (std::size_t i = 0; i < a.size(); ++i)
            {
                CHECK (a[i].time == Approx (b[i].time).margin (1e-6));
                CHECK (a[i].value == Approx (b[i].value).margin (1e-6));
            }
        }
        for (const auto* type : { "HapticContinuous", "HapticTransient" })
        {
            const auto a = eventsOf (ours, type), b = eventsOf (theirs, type);
            REQUIRE (a.size() == b.size());
            for (std::size_t i = 0; i < a.size(); ++i)
                CHECK (a[i] == Approx (b[i]).margin (1e-6));
        }
    }
    if (fs::exists (TACTUS_SHARED_DATA)) CHECK (pairs == 4);
}
