// SPDX-License-Identifier: GPL-3.0-or-later
#include "stem_options.hpp"

#include <host/base/platform/signals.hpp>
#include <host/cli/amount.hpp>
#include <host/cli/check_each.hpp>
#include <host/cli/command_run.hpp>
#include <host/cli/progress.hpp>
#include <host/cli/report.hpp>
#include <tactus/plan/flat/flatten.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <system_error>
#include <vector>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

std::string amountText (double value, const std::string& unit) { return roundedText (value, 4) + (unit.empty() ? "" : " " + unit); }

void say (const fs::path& folder, const WrittenStems& written)
{
    std::map<std::string, int> kinds;
    for (const auto& f : written.files)
        ++kinds[f.kind];
    const auto counted = [&] (const char* kind, const char* one, const char* many) {
        const int n = kinds[kind];
        return n == 0 ? std::string() : ", " + std::to_string (n) + " " + (n == 1 ? one : many);
    };
    std::cout << quotePath (folder.string()) << ": " << written.files.size() << " files of " << written.frames << " samples at "
              << roundedText (written.rate_hz, 9) << " Hz" << counted ("mix", "mix", "mixes") << counted ("axis", "axis", "axes")
              << counted ("layer", "layer", "layers") << counted ("not_mixed", "signal that is not mixed", "signals that are not mixed")
              << counted ("clip", "clip", "clips") << "\n";
    for (const auto& f : written.files)
        if (! f.not_applied.empty() && f.kind == "not_mixed")
            std::cout << "    " << printableName (f.file) << " is the signal of " << printableName (f.from) << ", without "
                      << printableName (listText (f.not_applied)) << ", through which it reaches the motor\n";
    for (const auto& m : written.losses)
        std::cout << "    clips as " << m.where << ": " << m.text << "\n";
    for (const auto& s : written.sums)
        std::cout << "    the layers of " << printableName (s.mixer) << " add up to its mix within " << amountText (s.difference, s.unit) << ", at a peak of "
                  << amountText (s.peak, s.unit) << "\n";
    for (const auto& f : written.files)
        if (f.clipped > 0)
            warn ((folder / f.file).string(), Message::warning ("stems/clipped", {}, std::to_string (f.clipped) + " samples are beyond full scale",
                                                                "give a larger --stem-scale, or --stem-scale together"));
}

void renderOne (const RunOptions& options, const StemOptions& how, const fs::path& folder)
{
    CommandRun command { options, CommandRun::Pace::offline };
    const auto ticks = command.ticksOrFail();
    auto& run = command.run();
    Stems stems { run.engine().plan(), how };
    Progress progress { ticks };
    for (std::size_t k = 0; k < ticks; ++k)
    {
        run.tick();
        orFail (stems.frame());
        if (stopRequested()) fail ("run/interrupted", "stopped after " + std::to_string (k + 1) + " ticks; nothing was written", "run it again");
        progress (k);
    }
    say (folder, orFail (stems.write (folder, command.name())));
    command.reportRun();
}

/// The graphs of a folder; clips and other files are left out.
std::vector<std::string> graphsIn (const fs::path& folder)
{
    std::vector<std::string> files;
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator (folder, failed))
        if (entry.path().extension() == ".json") files.push_back (entry.path().string());
    std::ranges::sort (files);
    return files;
}
}   // namespace

void StemCommand::addTo (const Command& command)
{
    const auto stems = command.addOption (
        "--stems", folder, "Write the mix, each axis or actuator, each layer, and each unmixed signal as WAV files into this folder; the graph may be a "
                           "folder of graphs");
    const auto formats = oneOf ({ "float", "pcm16", "pcm24" });
    const auto needing = { command.addOption ("--stem-format", format, "The samples of the files; default: float").check (formats),
                           command.addOption ("--stem-rate", rate_hz, "Samples per second; default: those of the run").check (finiteWithin (1.0, 768e3)),
                           command.addOption ("--stem-scale", scale,
                                              "The value of a sample of 1: an amount such as \"4 N\" (default for float: 1); `together`: the loudest sample "
                                              "of all files is at -1 dBFS (default for integers); `each`: that of each file"),
                           command.addFlag ("--stem-mono", is_mono, "Vectors become their component in the direction in which the mix moves most"),
                           command.addOption ("--stem-loop", loop,
                                              "Blend the end into the start over this time, as in \"20 ms\", so that the files can be repeated"),
                           command.addOption ("--stem-clips", clips,
                                              "Write each layer and each unmixed signal as a clip, too: haptic, ahap, hjif, or several of them")
                               .separatedBy (',')
                               .oneValueEach(),
                           command.addFlag ("--no-dither", has_no_dither, "Round to integers without noise") };
    for (const auto& option : needing)
        option.needs (stems);
    for (const auto* other : { "--replay", "--record", "--out", "--plot", "--listen" })
        stems.excludes (command.get (other));
}

StemOptions StemCommand::options() const
{
    StemOptions to { .rate_hz = rate_hz, .is_mono = is_mono, .has_dither = ! has_no_dither };
    for (const auto& c : clips)
    {
        if (std::ranges::count (stemClipFormats(), c) == 0) throw UsageError ("--stem-clips", "a clip is one of " + listText (stemClipFormats()));
        if (std::ranges::count (to.clips, c) == 0) to.clips.push_back (c);
    }
    if (! format.empty()) to.format = format == "pcm16" ? SampleFormat::pcm16 : format == "pcm24" ? SampleFormat::pcm24
                                                                                                  : SampleFormat::float32;
    if (! loop.empty()) to.loop_s = readAmount ("--stem-loop", loop, "s", "20 ms");
    if (scale == "each" || scale == "together" || (scale.empty() && to.format != SampleFormat::float32))
        to.scale = scale == "each" ? StemOptions::Scale::each : StemOptions::Scale::together;
    else if (! scale.empty())
        to.full_scale = readAmount ("--stem-scale", scale, "N", "4 N");
    return to;
}

void StemCommand::run (RunOptions each) const
{
    const auto how = options();
    watchForStop();
    const auto render = [&] (const std::string& file, const fs::path& into) {
        orFail (Stems::check (into));
        each.graph = file;
        const auto loaded = loadGraph (file);
        each.records = Stems::portsOf (plan::flatten (loaded.graph, catalogue(), {}, nullptr, plan::SettingFiles::left_out).flat);
        renderOne (each, how, into);
    };
    std::error_code failed;
    if (! fs::is_directory (each.graph, failed)) return render (each.graph, folder);
    const auto files = graphsIn (each.graph);
    if (files.empty()) fail (Message::error ("stems/no_graphs", each.graph, "there is no graph in this folder", "name a folder with files that end in .json"));
    fs::create_directories (folder, failed);
    checkEach (files, "graphs were rendered", [&] (const std::string& file) {
        try
        {
            render (file, fs::path (folder) / fs::path (file).stem());
            return true;
        }
        catch (const Stop&)
        {
            if (stopRequested()) throw;
            return false;
        }
    });
}

}   // namespace tactus::host
