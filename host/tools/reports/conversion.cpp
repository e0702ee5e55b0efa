// SPDX-License-Identifier: MIT
#include "conversion.hpp"
#include "refusal.hpp"

#include <host/base/command_line/command.hpp>
#include <host/base/files/clip_io.hpp>
#include <host/base/files/clip_samples.hpp>
#include <host/base/files/overwriting.hpp>
#include <tactus/file/csv.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/text/number_text.hpp>

#include <filesystem>
#include <iterator>
#include <utility>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

std::string bytesOf (const std::string& file)
{
    auto bytes = readFile (file);
    if (bytes) return std::move (*bytes);
    const auto& why = bytes.error();
    refuse (Message::error (why.id, file, why.text, why.remedy.empty() ? "check the path and its permissions" : why.remedy));
}

ConvertedFile writeSamples (const ConversionOptions& options, const Clip& clip, const readers::ClipFile& source)
{
    orRefuse (checkRendered (clip, options.rate_hz, "lower --rate"));
    const auto all = renderClip (clip, options.rate_hz);
    std::vector<std::string> columns { "t" };
    for (std::size_t c = 0; c < all.channels.size(); ++c)
        for (const auto* name : { "value", "amplitude", "frequency" })
            columns.push_back (c == 0 ? name : name + ("_" + std::to_string (c + 1)));
    auto file = orRefuse (TableWriter::create (options.out, columns));
    std::vector<double> row;
    for (std::size_t k = 0; ! all.channels.empty() && k < all.value.front().size(); ++k)
    {
        row = { static_cast<double> (k) / options.rate_hz };
        for (std::size_t c = 0; c < all.channels.size(); ++c)
            row.insert (row.end(), { all.value[c][k], all.amplitude[c][k], all.frequency[c][k] });
        orRefuse (file.row (row));
    }
    orRefuse (file.commit());
    auto left = source.leftOut();
    const auto said = left.size();
    const auto instead = "samples at " + roundedText (options.rate_hz, 9) + " Hz instead of envelopes; leave --rate out for the rows of the clip";
    return { options.out, std::move (left), said, { instead } };
}

ConvertedFile writeFile (const std::string& out, const Clip& clip, double rate_hz, const readers::ClipFile& source)
{
    auto saved = orRefuse (saveClip (clip, out, rate_hz, &source));
    auto differences = differenceReport (saved);
    return { out, std::move (saved.losses), source.leftOut().size(), std::move (differences) };
}

/// Continuous events into one file, transients into another: the engine of the phone then does not apply the curves of one file to the
/// events of the other.
std::vector<ConvertedFile> writeSplit (const ConversionOptions& options, const Clip& clip, const readers::ClipFile& source)
{
    const auto path = fs::path (options.out);
    const auto second = (path.parent_path() / (path.stem().string() + "_transients" + path.extension().string())).string();
    Clip continuous = clip, taps = clip;
    for (auto& t : continuous.tracks)
        t.taps.clear();
    for (auto& t : taps.tracks)
        t.amplitude.clear();
    orRefuse (checkOverwriting ({ options.out, second }, { options.in }));
    return { writeFile (options.out, continuous, 0.0, source), writeFile (second, taps, 0.0, source) };
}

bool isPenRecording (const std::string& file) { return extensionOf (file) == ".events" || extensionOf (file) == ".evemu"; }

Conversion convertPen (const ConversionOptions& options)
{
    if (extensionOf (options.out) != ".csv") throw UsageError ("out", "a pen recording is converted to a trace, which is a .csv");
    if (options.split) throw UsageError ("--split", "only clips are split");
    if (! options.calibration.empty()) throw UsageError ("--calibration", "only clips have a calibration");
    orRefuse (checkOverwriting ({ options.out }, { options.in }));

    auto pen = options.pen;
    if (options.rate_hz > 0.0) pen.rate_hz = options.rate_hz;
    const auto read = readEvemu (bytesOf (options.in), pen);
    if (! read) refuse (Message::error (read.error().id, options.in + ", " + read.error().where, read.error().text, read.error().remedy));
    const auto& trace = *read;
    auto file = orRefuse (TableWriter::create (options.out, std::vector<std::string> { "t", "x", "y", "z", "pressure" }));
    for (const auto& row : trace.rows)
        orRefuse (file.row (std::vector { row.t, row.position.x(), row.position.y(), row.position.z(), row.pressure }));
    orRefuse (file.commit());
    return { .is_pen = true, .rows = trace.rows.size(), .seconds = trace.duration(), .files = { { options.out } } };
}

Json jsonOf (const Messages& messages)
{
    Json all = Json::array();
    for (const auto& m : messages)
        all.push_back ({ { "id", m.id }, { "where", m.where }, { "text", m.text }, { "remedy", m.remedy } });
    return all;
}
}   // namespace

Conversion convert (const ConversionOptions& options)
{
    if (isPenRecording (options.in)) return convertPen (options);
    if (! options.pen_option.empty()) throw UsageError (options.pen_option, "only pen recordings, .events or .evemu, have this option");
    const auto extension = extensionOf (options.out);
    if (options.split && extension != ".ahap") throw UsageError ("--split", "only .ahap files are split");
    std::vector<fs::path> inputs { options.in };
    if (! options.calibration.empty()) inputs.emplace_back (options.calibration);
    orRefuse (checkOverwriting ({ options.out }, inputs));

    const auto read = orRefuse (loadClip (options.in));
    Conversion made { .notes = read.notes };
    auto clip = read.clip;
    if (! options.calibration.empty())
    {
        auto notes = orRefuse (readers::readCalibration (bytesOf (options.calibration), options.calibration, clip.voice));
        std::ranges::move (notes, std::back_inserter (made.notes));
    }
    made.tracks = clip.tracks.size();
    made.events = static_cast<std::size_t> (clip.events());
    made.seconds = clip.lastEvent();
    try
    {
        if (extension == ".csv" && options.rate_hz > 0.0)
            made.files = { writeSamples (options, clip, read) };
        else if (options.split)
            made.files = writeSplit (options, clip, read);
        else
            made.files = { writeFile (options.out, clip, options.rate_hz, read) };
    }
    catch (Refusal& why)
    {
        why.messages.insert (why.messages.begin(), made.notes.begin(), made.notes.end());
        throw;
    }
    return made;
}

Json Conversion::json() const
{
    Json all { { "notes", jsonOf (notes) }, { "seconds", seconds } };
    if (is_pen)
        all["rows"] = rows;
    else
        all.update ({ { "tracks", tracks }, { "events", events } });
    all["files"] = Json::array();
    for (const auto& f : files)
        all["files"].push_back ({ { "name", f.name }, { "losses", jsonOf (f.losses) }, { "differences", f.differences } });
    return all;
}

}   // namespace tactus::host
