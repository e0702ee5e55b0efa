// SPDX-License-Identifier: GPL-3.0-or-later
#include "clip_samples.hpp"
#include "commands.hpp"
#include "overwriting.hpp"
#include "report.hpp"
#include "run_options.hpp"
#include "surface_preset.hpp"

#include <host/io/wav.hpp>
#include <tactus/file/clips/clip_difference.hpp>
#include <tactus/file/clips/clip_file.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/text/budget.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cstdlib>
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
};

constexpr double usual_rate_hz = 8000.0;

std::string extensionOf (const std::string& file)
{
    auto extension = fs::path (file).extension().string();
    std::ranges::transform (extension, extension.begin(), [] (char c) { return c >= 'A' && c <= 'Z' ? static_cast<char> (c - 'A' + 'a') : c; });
    return extension;
}

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

Clip load (const std::string& file)
{
    const auto extension = extensionOf (file);
    Messages notes;
    Clip clip;
    if (extension == ".wav")
        clip = clipOfSignal (orFail (readWav (file)), notes);
    else if (extension == ".csv")
        clip = orFail (clipOfTable (orFail (readTable (fs::path (file))), file, notes));
    else if (readers::isClipName (file))
    {
        auto read = orFail (readers::readClip (bytesOf (file), file));
        clip = std::move (read.clip);
        notes = std::move (read.notes);
    }
    else
        fail (Message::error ("clip/unknown_kind", file, "there is no clip format with the extension " + quote (extension),
                              "clips are .haptic, .ahap, .hjif, .json, .wav and .csv"));
    sayAll (notes);
    return clip;
}

/// Prints how far the written clip is from the one that was read. Never silent: it also says that nothing was lost.
void reportLoss (const Clip& clip, const Clip& written, bool mixed)
{
    constexpr double none = 1e-9, little_hertz = 0.05;
    bool lost = false;
    for (const auto& d : readers::compareClips (clip, written, mixed))
    {
        if (d.difference <= none && d.frequency <= little_hertz) continue;
        lost = true;
        std::cout << "  loss: " << (mixed ? "all channels" : "channel " + std::to_string (d.channel)) << ": the envelope differs by " << rounded (d.difference)
                  << " rms, " << rounded (100.0 * d.part()) << " % of its " << rounded (d.rms) << "; the frequency by " << rounded (d.frequency) << " Hz rms\n";
    }
    if (! lost) std::cout << "  loss: none in the rendered envelope and frequency\n";
}

void wrote (const std::string& file) { std::cout << "wrote " << printableName (file) << "\n"; }

RenderedClip rendered (const Clip& clip, double rate_hz)
{
    const double numbers = (clip.lastEvent() + 1.0) * rate_hz * static_cast<double> (std::max<std::size_t> (1, clip.tracks.size()));
    if (numbers > budgets().numbers)
        fail (overBudget ("clip/too_large", &Budgets::numbers, "the rendered clip", numbers, "lower --rate"));
    return renderClip (clip, rate_hz);
}

/// The rate of the recording that a clip came from, else the usual one.
double rateOf (const ConvertOptions& options, const Clip& clip)
{
    if (options.rate_hz > 0.0) return options.rate_hz;
    for (const auto& [key, value] : clip.notes)
        if (key == "rate")
            if (const double rate = std::strtod (value.c_str(), nullptr); rate >= 1.0 && rate <= 1e6) return rate;
    return usual_rate_hz;
}

void writeWave (const ConvertOptions& options, const Clip& clip)
{
    const double rate_hz = rateOf (options, clip);
    const auto all = rendered (clip, rate_hz);
    if (all.channels.empty()) fail (Message::error ("clip/too_few", options.in, "it has no channel to render", "check that it is a clip"));
    auto file = orFail (WavWriter::create (options.out, rate_hz, all.channels.size()));
    std::vector<double> frame (all.channels.size());
    for (std::size_t k = 0; k < all.value.front().size(); ++k)
    {
        for (std::size_t c = 0; c < frame.size(); ++c)
            frame[c] = all.value[c][k];
        orFail (file.frame (frame));
    }
    orFail (file.commit());
    wrote (options.out);
    Messages ignored;
    Clip back = clipOfSignal ({ .rate_hz = rate_hz, .channels = all.value }, ignored);
    for (std::size_t c = 0; c < back.tracks.size(); ++c)
        back.tracks[c].channel = all.channels[c];
    reportLoss (clip, back, false);
}

void writeSamples (const ConvertOptions& options, const Clip& clip)
{
    const auto all = rendered (clip, options.rate_hz);
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
    std::cout << "  loss: samples at " << rounded (options.rate_hz) << " Hz instead of envelopes; leave --rate out for the rows of the clip\n";
}

void writeRows (const ConvertOptions& options, const Clip& clip)
{
    static const std::vector<std::string> columns { "kind", "track", "a", "b", "c" };
    const auto grid = gridOf (clip);
    auto file = orFail (TableWriter::create (options.out, columns));
    for (int r = 0; r < grid.rows; ++r)
        orFail (file.row (std::span (grid.values).subspan (at (r) * columns.size(), columns.size())));
    orFail (file.commit());
    wrote (options.out);
    for (const auto& [key, value] : clip.notes)
        say (Message::warning ("clip/not_carried", "notes/" + key, "the note is left out: a table holds numbers", "keep the original file"));
    reportLoss (clip, clipOf (grid).clip, false);
}

void writeText (const std::string& out, const Clip& clip)
{
    const auto made = orFail (readers::writeClip (clip, out));
    auto back = orFail (readers::readClip (made.text, out));
    orFail (writeTextFile (out, made.text));
    wrote (out);
    sayAll (made.losses);
    const auto extension = extensionOf (out);
    reportLoss (clip, back.clip, extension == ".haptic" || extension == ".ahap");
}

/// Continuous events into one file, transients into another: the engine of the phone then applies the curves of the one not to the other.
void writeSplit (const ConvertOptions& options, const Clip& clip)
{
    const auto path = fs::path (options.out);
    const auto second = (path.parent_path() / (path.stem().string() + "_transients" + path.extension().string())).string();
    Clip continuous = clip, taps = clip;
    for (auto& t : continuous.tracks)
        t.taps.clear();
    for (auto& t : taps.tracks)
        t.amplitude.clear();
    refuseOverwriting ({ options.out, second }, { options.in });
    writeText (options.out, continuous);
    writeText (second, taps);
}

void run (const ConvertOptions& options)
{
    const auto extension = extensionOf (options.out);
    if (options.split && extension != ".ahap") throw UsageError ("--split", "only .ahap files are split");
    std::vector<fs::path> inputs { options.in };
    if (! options.calibration.empty()) inputs.emplace_back (options.calibration);
    refuseOverwriting ({ options.out }, inputs);

    auto clip = load (options.in);
    if (! options.calibration.empty()) sayAll (orFail (readers::readCalibration (bytesOf (options.calibration), options.calibration, clip.voice)));
    std::cout << printableName (options.in) << ": " << clip.tracks.size() << (clip.tracks.size() == 1 ? " track, " : " tracks, ") << clip.events()
              << " points and transients, " << rounded (clip.lastEvent()) << " s\n";
    if (extension == ".wav")
        writeWave (options, clip);
    else if (extension == ".csv" && options.rate_hz > 0.0)
        writeSamples (options, clip);
    else if (extension == ".csv")
        writeRows (options, clip);
    else if (options.split)
        writeSplit (options, clip);
    else
        writeText (options.out, clip);
}
}   // namespace

void addConvert (const Command& app)
{
    const auto options = std::make_shared<ConvertOptions>();
    const auto command = app.add ("convert", "Convert a haptic clip: AHAP, .haptic, HJIF, WAV, CSV, and clips of Tactus");
    command.addOption ("in", options->in, "The file to read: .haptic, .ahap, .hjif, .json, .wav or .csv").required();
    command.addOption ("out", options->out, "The file to write; its extension selects the format").required();
    command.addOption ("--calibration", options->calibration, "What 0 and 1 mean on the device: an actuator calibration file of Meta (.acf)");
    command
        .addOption ("--rate", options->rate_hz,
                    "Samples per second of a .wav, by default 8000 or those of the recording; or of a .csv, instead of rows of the clip")
        .check (finiteWithin (1.0, 1e6));
    command.addFlag ("--split", options->split, "Write continuous events and transients into two .ahap files, OUT and OUT_transients");
    addLimits (command);
    command.footer ("What a format cannot carry is printed, with the rms difference of the rendered envelope. The page docs/clips.md says more.\n\n"
                    "Examples:\n"
                    "  tactus convert effect.haptic effect.ahap\n"
                    "  tactus convert effect.haptic effect.json --calibration MetaQuest.acf\n"
                    "  tactus convert effect.ahap effect.wav --rate 48000");
    command.callback ([options] { run (*options); });
}

}   // namespace tactus::host
