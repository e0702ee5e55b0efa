// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot_options.hpp"
#include "plotter.hpp"
#include "stem_options.hpp"

#include <host/base/assets/file_assets.hpp>
#include <host/base/platform/signals.hpp>
#include <host/cli/command_run.hpp>
#include <host/cli/commands.hpp>
#include <host/cli/overwriting.hpp>
#include <host/cli/progress.hpp>
#include <host/cli/recorder.hpp>
#include <host/cli/report.hpp>
#include <host/devices/audio/listening.hpp>
#include <tactus/file/atomic_file.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/run/replay.hpp>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <span>

namespace tactus::host
{

namespace
{
struct RenderOptions : RunOptions
{
    std::string replay, listen;
    PlotOptions plot;
    StemCommand stems;

    /// The files that --plot and --listen name.
    std::vector<std::string> pictures() const
    {
        std::vector<std::string> files { plot.file, listen };
        std::erase (files, "");
        return files;
    }
};

void failIfAny (const std::vector<Message>& failed)
{
    if (! failed.empty()) fail (failed.front());
}

/// Passes the recording on to the outputs.
class Output
{
public:
    Output (const RenderOptions& o, const std::vector<Tap>& taps, double rate_hz)
        : options (o), recorder (o.outputs, taps, rate_hz, o.pictures().empty(), IfKilled::removed, ! o.listen.empty()), values (recorder.width())
    {
        if (! options.listen.empty())
        {
            orFail (Listening::check (options.listen));
            listening.emplace (options.listen, taps, rate_hz, recorder.samplesPerTick());
        }
        if (options.plot.file.empty()) return;
        orFail (AtomicFile::create (options.plot.file));   // fails now rather than after an hour of rendering
        plotter.emplace (options.plot, taps, rate_hz, options.records.empty());
    }

    void frame (const Plan& plan)
    {
        recorder.note (plan.taps(), values);
        failIfAny (recorder.frame (ticks++, values));
        if (listening) listening->frame (values);
        if (plotter) plotter->frame (std::span (values).last (plan.taps().size()));
        if (stopRequested())
            fail ("run/interrupted", "stopped after " + std::to_string (ticks) + " ticks; nothing was written", "run it again, or with a shorter --duration");
    }

    void commit (const std::string& name)
    {
        failIfAny (recorder.commit());
        if (plotter) plotter->draw (name);
        if (! listening) return;
        Messages warnings;
        orFail (listening->write (warnings));
        for (const auto& m : warnings)
            warn (m.where, m);
    }

private:
    const RenderOptions& options;
    Recorder recorder;
    std::optional<Plotter> plotter;
    std::optional<Listening> listening;
    std::vector<double> values;
    std::uint64_t ticks = 0;
};

void render (const RenderOptions& options)
{
    CommandRun command { options, CommandRun::Pace::offline };
    const auto ticks = command.ticksOrFail();
    auto outputs = options.outputs;
    std::ranges::copy (options.pictures(), std::back_inserter (outputs));
    refuseOverwriting (outputs, command.inputs());
    watchForStop();
    auto& run = command.run();
    Output output { options, run.engine().plan().taps(), run.rate() };
    Progress progress { ticks };
    for (std::size_t k = 0; k < ticks; ++k)
    {
        run.tick();
        output.frame (run.engine().plan());
        progress (k);
    }
    output.commit (command.name());
    command.reportRun();
}

void replay (const RenderOptions& options)
{
    auto outputs = options.outputs;
    std::ranges::copy (options.pictures(), std::back_inserter (outputs));
    refuseOverwriting (outputs, { options.replay, options.graph });

    FileAssets assets;
    Replay::Options how { .records = options.records,
                          .overrides = readSets (options.sets),
                          .assets = &assets,
                          .services = { .nearest_triangle = nearestByBoxes },
                          .duration_s = options.duration_s,
                          .program = TACTUS_VERSION };
    std::optional<LoadedGraph> own;
    if (! options.graph.empty())
    {
        own = loadGraph (options.graph);
        if (report (own->messages, *own, options.graph) > 0) throw Stop {};
        how.graph = &own->graph;
    }
    const auto replayed = orFail (Replay::open (options.replay, std::move (how)));
    watchForStop();
    auto& run = replayed->run();
    Output output { options, run.engine().plan().taps(), run.rate() };
    const auto warnAll = [&] {
        for (const auto& m : replayed->takeWarnings())
            warn (m.where.empty() ? options.graph : m.where, m);
    };
    for (warnAll(); orFail (replayed->tick()); warnAll())
        output.frame (run.engine().plan());
    output.commit (replayed->name());
    if (const auto why = replayed->end()) warn (why->where, *why);
}

void run (RenderOptions& options)
{
    options.plot.finish();
    if (options.graph.empty() && options.replay.empty()) throw UsageError ("graph is required");
    if (! options.stems.folder.empty()) return options.stems.run (options);
    options.replay.empty() ? render (options) : replay (options);
}
}   // namespace

void addRender (const Command& app)
{
    const auto options = std::make_shared<RenderOptions>();
    const auto command = app.add ("render", "Run a graph offline: deterministic and faster than real time, with the same engine as live");
    options->addTo (command);
    command.get ("graph").required (false);
    const auto replayed = command.addOption ("--replay", options->replay,
                                             "Repeat a run from a log written by `tactus play --log`; uses the graph of the log unless one is given");
    for (const auto* other : { "--feed", "--device", "--rate", "--ticks" })
        replayed.excludes (command.get (other));
    options->plot.addTo (command);
    command.addOption ("--listen", options->listen,
                       "Write what is recorded as a sound for loudspeakers: a mono .wav at 48 kHz, high-passed at 20 Hz, at -3 dBFS");
    options->stems.addTo (command);
    command.footer ("Without --out, --plot, --listen and --stems, CSV goes to the standard output.\n\n"
                    "Examples:\n"
                    "  tactus render graphs/dry_wood.json --out wood.csv --plot wood.png\n"
                    "  tactus render graphs/dry_wood.json --device stylus=gesture:circle --out wood.wav\n"
                    "  tactus render graphs/dry_wood.json --device stylus=trace:pen.csv --record drag.force,drag.state\n"
                    "  tactus render rub.json --feed positions.csv --record drag.force --set drag.mu=0.3 --set drag.d_max=\"20 um\"\n"
                    "  tactus render rub.json --feed loop.csv --record drag.position.x,drag.force.x --plot loop.png --over drag.position.x\n"
                    "  tactus render graphs/dry_wood.json --record drag.force --plot wood.pdf --size 85x60 --from 1 --until 2\n"
                    "  tactus render graphs/steel_bar.json --record ring.value --listen bar.wav\n"
                    "  tactus render graphs/bronze_bell.json --stems bell --stem-format pcm24 --stem-rate 48000\n"
                    "  tactus render graphs --stems all --duration 5\n"
                    "  tactus render --replay wood.jsonl --record drag.force,drag.state --out wood.csv");
    command.callback ([options] { run (*options); });
}

}   // namespace tactus::host
