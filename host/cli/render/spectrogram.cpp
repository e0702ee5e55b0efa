// SPDX-License-Identifier: GPL-3.0-or-later
#include "spectrum_options.hpp"

#include <host/base/platform/signals.hpp>
#include <host/cli/command_run.hpp>
#include <host/cli/commands.hpp>
#include <host/cli/progress.hpp>
#include <host/cli/report.hpp>

#include <memory>

namespace tactus::host
{

namespace
{
struct SpectrogramOptions : RunOptions
{
    SpectrumOptions picture;
    double window_s = 0.1;
};

void drawSpectrogram (SpectrogramOptions& options)
{
    options.picture.finish();
    options.records = options.picture.records();
    options.outputs = { options.picture.file };
    CommandRun command { options, CommandRun::Pace::offline };
    const auto ticks = command.ticksOrFail();
    watchForStop();
    auto& run = command.run();
    PortSamples samples { run.engine().plan().taps(), run.rate() };
    Progress progress { ticks };
    for (std::size_t k = 0; k < ticks; ++k)
    {
        run.tick();
        samples.frame (run.engine().plan());
        progress (k);
        if (stopRequested()) fail ("run/interrupted", "stopped; nothing was written", "run it again, or with a shorter --duration");
    }
    const auto spectrogram = spectrogramOf (samples.all(), samples.rate(), options.window_s, options.picture.up_to_hz);
    if (spectrogram.columns.empty())
        fail ("spectrum/too_short", "the run is shorter than the --window of " + std::to_string (options.window_s) + " s",
              "give a longer --duration or a shorter --window");
    options.picture.write (command.name() + ": " + samples.name(), { "time", "s" }, spectrogram, samples.unit());
    command.reportRun();
}
}   // namespace

void addSpectrogram (const Command& app)
{
    const auto options = std::make_shared<SpectrogramOptions>();
    const auto command = app.add ("spectrogram", "Render a graph, and plot the frequencies of a port against time as a map");
    options->addTo (command, RunOptions::Files::fixed);
    options->picture.addTo (command);
    command
        .addOption ("--window", options->window_s,
                    "Length of the signal that each column of the map analyses, in s; a longer one separates closer frequencies; default: 0.1")
        .check (finiteWithin (1e-4, 100.0));
    command.footer ("The colour is the amplitude in decibels: a sine of 1 N is 0 dB re 1 N. The amplitude of a vector is the root of the\n"
                    "sum of the squares of its components' amplitudes. A table has a row for each time, and a column for each frequency.\n\n"
                    "Examples:\n"
                    "  tactus spectrogram dry_wood -o wood.png\n"
                    "  tactus spectrogram dry_wood --device stylus=gesture:sweep --port drag.force --up-to 500 -o wood.pdf\n"
                    "  tactus spectrogram steel_bar --port ring.value --up-to 2000 --window 0.05 -o bar.csv");
    command.callback ([options] { drawSpectrogram (*options); });
}

}   // namespace tactus::host
