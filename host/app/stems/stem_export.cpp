// SPDX-License-Identifier: GPL-3.0-or-later
#include "stem_export.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/model/quantity_text.hpp>
#include <host/app/presets/preset_list.hpp>
#include <host/app/text/filled.hpp>
#include <host/base/assets/file_assets.hpp>
#include <host/devices/live/live_session.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/plan/flat/flatten.hpp>
#include <tactus/run/device/gestures.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/text/list_text.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace tactus::host
{

namespace
{
/// "Dry wood stems 2" if the folder has "Dry wood stems": only a name that the user gives replaces stems.
std::string freeName (const std::filesystem::path& folder, const std::string& name)
{
    std::error_code failed;
    auto free = name;
    for (int n = 2; std::filesystem::exists (folder / free, failed); ++n)
        free = name + ' ' + std::to_string (n);
    return free;
}

/// The graph with the gesture or the recording that moves the tool now in place of its own. A recording moves the tool exactly, as in the window.
graph::Graph asMoved (graph::Graph g, const LiveRun& run)
{
    const auto& [kind, path] = run.hand();
    if (kind != LiveRun::Hand::Kind::path) return g;
    const auto role = run.handRole();
    auto device = std::ranges::find (g.devices, role, [] (const auto& d) { return d.first; });
    if (device == g.devices.end()) device = g.devices.insert (device, { role, Json::object() });
    auto& its = device->second;
    const bool is_gesture = findGesture (path) != nullptr;
    if (is_gesture && its.value ("driver", std::string()) == "sim" && its.contains ("hand"))
        its["hand"]["path"] = path;
    else
    {
        Json moved = is_gesture ? Json { { "driver", "sim" }, { "hand", { { "path", path } } } } : Json { { "driver", "trace" }, { "path", path } };
        if (its.contains ("guard")) moved["guard"] = its["guard"];
        its = std::move (moved);
    }
    return g;
}

/// The motion of each tool while the stems are rendered: "tool: stroke, 2 s".
juce::String motionsOf (const graph::Graph& g)
{
    juce::String text;
    for (const auto& [role, description] : g.devices)
    {
        Messages refused;
        const auto made = makeDevice (describedByGraph (&description, role, refused), g.folder);
        text << (text.isEmpty() ? "" : "; ") << fromUtf8 (role) << ": " << fromUtf8 (unitShown (made.about)).trimCharactersAtEnd (".");
    }
    return text.isEmpty() ? TRANS ("nothing moves the tool") : text;
}

const Message* errorIn (const Messages& messages)
{
    const auto found = std::ranges::find (messages, Message::Severity::error, &Message::severity);
    return found == messages.end() ? nullptr : &*found;
}

/// Renders the stems of a graph as `tactus render --stems` does: with its simulated devices, for the length of the longest path of a hand, or
/// 10 s. If it is cancelled, nothing is written, unless the run is over. Ids: those of Stems and LiveSession, and run/interrupted.
Result<WrittenStems> renderStems (const graph::Graph& g, const Catalogue& catalogue, const std::filesystem::path& folder, const StemOptions& options,
                                  JobCourse& course)
{
    if (auto fits = Stems::check (folder); ! fits) return fits.error();
    FileAssets assets;
    LiveSession::Options how;
    how.compile = { .records = Stems::portsOf (plan::flatten (g, catalogue, {}, nullptr, plan::SettingFiles::left_out).flat),
                    .assets = &assets,
                    .services = { .nearest_triangle = nearestByBoxes } };
    how.queries = Run::Queries::within_tick;
    LiveSession session (catalogue, {}, how);
    const auto loaded = session.load (g);
    if (const auto* error = errorIn (loaded)) return *error;
    const auto opened = session.openDevices();
    if (const auto* error = errorIn (opened)) return *error;

    auto& run = session.run();
    double seconds = 0.0;
    for (const auto& [role, d] : run.devices())
        seconds = std::max (seconds, d.device->duration());
    constexpr double usual_s = 10.0, most_s = 600.0;
    const auto ticks = static_cast<std::size_t> (std::ceil (run.rate() * (seconds > 0.0 ? std::min (seconds, most_s) : usual_s) - 1e-6));
    Stems stems (run.engine().plan(), options);
    for (std::size_t k = 0; k < ticks; ++k)
    {
        run.tick();
        if (auto taken = stems.frame(); ! taken) return taken.error();
        course.share = static_cast<double> (k) / static_cast<double> (ticks);
        if (course.cancelled) return Message::error ("run/interrupted", {}, "cancelled; nothing was written", "export the stems again to get them");
    }
    course.share = 1.0;
    return stems.write (folder, g.name);
}
}   // namespace

void StemExport::ask()
{
    const auto graph = std::make_shared<const graph::Graph> (asMoved (desk.document.graph(), desk.playback.run()));
    const auto& g = *graph;
    const auto name = g.name.empty() ? TRANS ("graph") : fromUtf8 (g.name);
    const auto choice = [&] (const juce::String& label, const StemOptions& options) {
        return Question::Choice { label, [this, graph, name, options] {
                                     // A point would begin the ending of another kind of file.
                                     const auto legal = juce::File::createLegalFileName (name).replaceCharacter ('.', '_').toStdString();
                                     const auto write = [this, graph, options] (const auto& into) { render (*graph, options, into); };
                                     desk.chooseOwnFile (freeName (desk.savingFolder(), legal + " stems"), write);
                                 } };
    };
    constexpr double rate_hz = 48000.0;
    const StemOptions integers { .format = SampleFormat::pcm24, .rate_hz = rate_hz, .scale = StemOptions::Scale::together };
    auto small = integers, looped = integers, with_clips = integers;
    small.format = SampleFormat::pcm16;
    looped.loop_s = 0.05;
    with_clips.clips = stemClipFormats();
    const auto about = TRANS ("WAV files of the mix, of each axis or actuator, of each layer, and of what is not mixed, as the simulated device "
                              "feels them. Motion: %1.\n\n24 and 16 bit: at 48 kHz, with the loudest sample of all files at -1 dBFS. Loop: its end "
                              "is blended into its start. With clips: 24 bit, and each layer as .haptic, AHAP and HJIF. Float: as many samples as the "
                              "run has, and 1 is 1 N.");
    std::vector<Question::Choice> choices { choice (TRANS ("24 bit"), integers), choice (TRANS ("16 bit"), small) };
    choices.push_back (choice (TRANS ("24 bit loop"), looped));
    choices.push_back (choice (TRANS ("With clips"), with_clips));
    choices.push_back (choice (TRANS ("Float"), {}));
    choices.push_back ({ TRANS ("Cancel"), {} });
    desk.question.ask (filled (TRANS ("Export the stems of %1"), name), filled (about, motionsOf (g)), std::move (choices));
}

void StemExport::render (const graph::Graph& g, const StemOptions& options, const std::filesystem::path& into)
{
    folder = into;
    job.start (into.string(), [g, &types = desk.types, into, options] (JobCourse& course) { return renderStems (g, types, into, options, course); });
    title = filled (TRANS ("Rendering stems into %1"), fromUtf8 (into.filename().string()));
    desk.question.ask (title, {}, { { TRANS ("Cancel"), [this] { job.cancel(); } } });
}

void StemExport::attend()
{
    if (! job.isRunning()) return;
    if (! desk.question.isOpen() || desk.question.title() != title) return;   // another question comes first
    const auto result = job.take();
    if (! result)
    {
        const double done = job.share();
        return desk.question.say (done < 1.0 ? filled (TRANS ("%1 %"), juce::roundToInt (100.0 * done)) : TRANS ("Writing the files"));
    }
    desk.question.cancel();
    if (! *result) return desk.notify (fromUtf8 (messageText (result->error())));
    auto text = filled (TRANS ("%1 files are in %2"), (*result)->files.size(), fromUtf8 (folder.string()));
    for (const auto& f : (*result)->files)
        if (! f.not_applied.empty() && f.kind == "not_mixed")
            text << ". " << filled (TRANS ("%1 is without %2, through which it reaches the motor"), f.file, listText (f.not_applied));
    const auto& losses = (*result)->losses;
    if (losses.empty()) return desk.notify (text);
    auto lost = TRANS ("What the clips do not hold, or hold differently:") + "\n";
    std::vector<std::pair<std::string, std::string>> lines;   // a text, and the formats that it is about
    for (const auto& m : losses)
    {
        const auto text = messageText (m);
        const auto known = std::ranges::find (lines, text, &std::pair<std::string, std::string>::first);
        known == lines.end() ? void (lines.emplace_back (text, m.where)) : void (known->second += ", " + m.where);
    }
    for (const auto& [loss, formats] : lines)
        lost << "\n- " << fromUtf8 (formats + ": " + loss) << ".";
    desk.tell (text, lost);
}

}   // namespace tactus::host
