// SPDX-License-Identifier: GPL-3.0-or-later
#include "amount.hpp"
#include "commands.hpp"
#include "overwriting.hpp"
#include "report.hpp"
#include "run_options.hpp"

#include <host/base/files/clip_io.hpp>
#include <host/base/files/clip_samples.hpp>
#include <host/base/files/evemu.hpp>
#include <host/tools/fitting/surface_preset.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <filesystem>
#include <iostream>
#include <memory>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

struct ConvertOptions
{
    std::string in, out, calibration;
    double rate_hz = 0.0;
    bool split = false;
    EvemuOptions pen {};
    std::string pen_option {};   // one that was given
};

/// Prints a warning with its place and its remedy.
void say (const Message& m)
{
    std::cerr << inOneLine (m.where) << ": warning: " << inOneLine (m.text) << "\n    " << inOneLine (m.remedy) << " [" << m.id << "]\n";
}

void sayAll (const Messages& messages)
{
    for (const auto& m : messages)
        say (m);
}

std::string bytesOf (const std::string& file)
{
    auto bytes = readFile (file);
    if (bytes) return std::move (*bytes);
    const auto& why = bytes.error();
    fail (Message::error (why.id, file, why.text, why.remedy.empty() ? "check the path and its permissions" : why.remedy));
}

/// Prints how far the written clip is from the one that was read. Always prints something, even if nothing was lost.
void print (const SavedClip& saved, std::size_t said)
{
    for (std::size_t i = 0; i < saved.losses.size(); ++i)
        if (i >= said) say (saved.losses[i]);   // the notes of the reader were said when it was read
    for (const auto& m : saved.losses)
        std::cout << "  loss: " << inOneLine (m.where) << ": " << inOneLine (m.text) << "\n";
    for (const auto& sentence : differenceReport (saved))
        std::cout << "  loss: " << sentence << "\n";
}

void wrote (const std::string& file) { std::cout << "wrote " << printableName (file) << "\n"; }

void writeSamples (const ConvertOptions& options, const Clip& clip, const readers::ClipFile& source)
{
    orFail (checkRendered (clip, options.rate_hz, "lower --rate"));
    const auto all = renderClip (clip, options.rate_hz);
    std::vector<std::string> columns { "t" };
    for (std::size_t c = 0; c < all.channels.size(); ++c)
        for (const auto* name : { "value", "amplitude", "frequency" })
            columns.push_back (c == 0 ? name : name + ("_" + std::to_string (c + 1)));
    auto file = orFail (TableWriter::create (options.out, columns));
    std::vector<double> row;
    for (std::size_t k = 0; ! all.channels.empty() && k < all.value.front().size(); ++k)
    {
        row = { static_cast<double> (k) / options.rate_hz };
        for (std::size_t c = 0; c < all.channels.size(); ++c)
            row.insert (row.end(), { all.value[c][k], all.amplitude[c][k], all.frequency[c][k] });
        orFail (file.row (row));
    }
    orFail (file.commit());
    wrote (options.out);
    for (const auto& m : source.leftOut())
        std::cout << "  loss: " << inOneLine (m.where) << ": " << inOneLine (m.text) << "\n";
    std::cout << "  loss: samples at " << roundedText (options.rate_hz, 9) << " Hz instead of envelopes; leave --rate out for the rows of the clip\n";
}

void writeFile (const std::string& out, const Clip& clip, double rate_hz, const readers::ClipFile& source)
{
    const auto saved = orFail (saveClip (clip, out, rate_hz, &source));
    wrote (out);
    print (saved, source.leftOut().size());
}

/// Continuous events into one file, transients into another: the engine of the phone then does not apply the curves of one file to the
/// events of the other.
void writeSplit (const ConvertOptions& options, const Clip& clip, const readers::ClipFile& source)
{
    const auto path = fs::path (options.out);
    const auto second = (path.parent_path() / (path.stem().string() + "_transients" + path.extension().string())).string();
    Clip continuous = clip, taps = clip;
    for (auto& t : continuous.tracks)
        t.taps.clear();
    for (auto& t : taps.tracks)
        t.amplitude.clear();
    refuseOverwriting ({ options.out, second }, { options.in });
    writeFile (options.out, continuous, 0.0, source);
    writeFile (second, taps, 0.0, source);
}

bool isPenRecording (const std::string& file) { return extensionOf (file) == ".events" || extensionOf (file) == ".evemu"; }

void convertPen (const ConvertOptions& options)
{
    if (extensionOf (options.out) != ".csv") throw UsageError ("out", "a pen recording is converted to a trace, which is a .csv");
    if (options.split) throw UsageError ("--split", "only clips are split");
    if (! options.calibration.empty()) throw UsageError ("--calibration", "only clips have a calibration");
    refuseOverwriting ({ options.out }, { options.in });

    auto pen = options.pen;
    if (options.rate_hz > 0.0) pen.rate_hz = options.rate_hz;
    const auto read = readEvemu (bytesOf (options.in), pen);
    if (! read) fail (Message::error (read.error().id, options.in + ", " + read.error().where, read.error().text, read.error().remedy));
    const auto& trace = *read;
    auto file = orFail (TableWriter::create (options.out, std::vector<std::string> { "t", "x", "y", "z", "pressure" }));
    for (const auto& row : trace.rows)
        orFail (file.row (std::vector { row.t, row.position.x(), row.position.y(), row.position.z(), row.pressure }));
    orFail (file.commit());
    std::cout << printableName (options.in) << ": " << trace.rows.size() << " rows, " << roundedText (trace.duration(), 3) << " s\n";
    wrote (options.out);
}

void run (const ConvertOptions& options)
{
    if (isPenRecording (options.in)) return convertPen (options);
    if (! options.pen_option.empty()) throw UsageError (options.pen_option, "only pen recordings, .events or .evemu, have this option");
    const auto extension = extensionOf (options.out);
    if (options.split && extension != ".ahap") throw UsageError ("--split", "only .ahap files are split");
    std::vector<fs::path> inputs { options.in };
    if (! options.calibration.empty()) inputs.emplace_back (options.calibration);
    refuseOverwriting ({ options.out }, inputs);

    const auto read = orFail (loadClip (options.in));
    sayAll (read.notes);
    auto clip = read.clip;
    if (! options.calibration.empty()) sayAll (orFail (readers::readCalibration (bytesOf (options.calibration), options.calibration, clip.voice)));
    std::cout << printableName (options.in) << ": " << clip.tracks.size() << (clip.tracks.size() == 1 ? " track, " : " tracks, ") << clip.events()
              << " points and transients, " << roundedText (clip.lastEvent(), 3) << " s\n";
    if (extension == ".csv" && options.rate_hz > 0.0)
        writeSamples (options, clip, read);
    else if (options.split)
        writeSplit (options, clip, read);
    else
        writeFile (options.out, clip, options.rate_hz, read);
}
}   // namespace

void addConvert (const Command& app)
{
    const auto options = std::make_shared<ConvertOptions>();
    const auto command = app.add ("convert", "Convert a haptic clip (AHAP, .haptic, HJIF, WAV, CSV, clips of Tactus), or a pen recording to a trace");
    command.addOption ("in", options->in, "The file to read: .haptic, .ahap, .hjif, .json, .wav or .csv; or a pen recording, .events or .evemu")
        .required();
    command.addOption ("out", options->out, "The file to write; its extension selects the format").required();
    command.addOption ("--calibration", options->calibration, "What 0 and 1 mean on the device: an actuator calibration file of Meta (.acf)");
    command
        .addOption ("--rate", options->rate_hz,
                    "Samples per second of a .wav, by default 8000 or those of the recording; of a .csv, instead of rows of the clip; "
                    "or of a trace, by default 1000")
        .check (finiteWithin (1.0, 1e6));
    command.addFlag ("--split", options->split, "Write continuous events and transients into two .ahap files, OUT and OUT_transients");
    const auto addPenAmount = [&] (const std::string& option, const char* si_unit, const char* example, auto field, const char* about) {
        command.addOption (
            option,
            [options, option, si_unit, example, field] (const std::string& text) {
                options->pen.*field = readAmount (option, text, si_unit, example);
                options->pen_option = option;
            },
            about);
    };
    addPenAmount ("--pitch", "m", "5 um", &EvemuOptions::pitch, "Pen: length of one unit of the tablet; default: as recorded, else 5 um");
    addPenAmount ("--force", "N", "3 N", &EvemuOptions::full_force, "Pen: force at full pressure; default 3 N");
    addPenAmount ("--depth", "m", "2 mm", &EvemuOptions::full_depth, "Pen: depth below the surface at full pressure; default 2 mm");
    addPenAmount ("--lift", "m", "5 mm", &EvemuOptions::lift, "Pen: height above the surface while the pen is up; default 5 mm");
    addPenAmount ("--full-pressure", "", "2047", &EvemuOptions::full_pressure, "Pen: units at full pressure; default: as recorded, else 2047");
    addLimits (command);
    command.footer ("Prints the parts that the format cannot hold, and the rms difference of the rendered envelope. See docs/clips.md.\n\n"
                    "Examples:\n"
                    "  tactus convert effect.haptic effect.ahap\n"
                    "  tactus convert effect.haptic effect.json --calibration MetaQuest.acf\n"
                    "  tactus convert effect.ahap effect.wav --rate 48000\n"
                    "  tactus convert pen.events pen.csv --force \"2 N\"");
    command.callback ([options] { run (*options); });
}

}   // namespace tactus::host
