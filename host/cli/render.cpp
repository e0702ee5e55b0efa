// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "overwriting.hpp"
#include "plotter.hpp"
#include "progress.hpp"
#include "recorder.hpp"
#include "replay.hpp"
#include "report.hpp"
#include "session.hpp"

#include <host/io/atomic_file.hpp>
#include <host/platform/signals.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace tactus::host
{

namespace
{
struct Options : SessionOptions
{
    std::string plot, over, replay;
};

void failIfAny (const std::vector<Error>& failed)
{
    if (! failed.empty()) fail (failed.front());
}

/// What is recorded, on its way to where it was asked for.
class Output
{
public:
    Output (const Options& o, const std::vector<Tap>& taps, double rate_hz) : options (o), recorder (o.outputs, taps, rate_hz, o.plot.empty()), values (recorder.width())
    {
        if (options.plot.empty()) return;
        orFail (createFile (options.plot));   // refused now, not after an hour
        plotter.emplace (options.plot, taps, options.over, rate_hz, options.records.empty());
    }

    void frame (const Plan& plan)
    {
        recorder.note (plan.taps, values);
        failIfAny (recorder.frame (ticks++, values));
        if (plotter) plotter->frame (std::span (values).last (plan.taps.size()));
        if (stopRequested()) fail ("run/interrupted", "stopped after " + std::to_string (ticks) + " ticks; nothing was written", "run it again, or with a shorter --duration");
    }

    void commit (const std::string& name)
    {
        failIfAny (recorder.commit());
        if (plotter) plotter->draw (name);
    }

private:
    const Options& options;
    Recorder recorder;
    std::optional<Plotter> plotter;
    std::vector<double> values;
    std::uint64_t ticks = 0;
};

void render (const Options& options)
{
    Session session { options, Session::Pace::offline };
    if (! session.ticks())
        fail ("run/no_length", "nothing says how long to run: there is no feed, trace or gesture", "give --duration S, --feed IN.csv, or --device ROLE=gesture:NAME");

    if (! options.plot.empty()) refuseOverwriting ({ options.plot }, session.inputs());
    watchForStop();
    Output output { options, session.engine().plan().taps, session.rate() };
    Progress progress { *session.ticks() };
    for (std::size_t k = 0; k < *session.ticks(); ++k)
    {
        session.tick();
        output.frame (session.engine().plan());
        progress (k);
    }
    output.commit (session.name());
    session.reportRun();
}

void replay (const Options& options)
{
    auto outputs = options.outputs;
    if (! options.plot.empty()) outputs.push_back (options.plot);
    refuseOverwriting (outputs, { options.replay, options.graph });
    Replay run { options, options.replay };
    watchForStop();
    Output output { options, run.engine().plan().taps, run.rate() };
    while (run.tick())
        output.frame (run.engine().plan());
    output.commit (run.name());
    run.reportEnd();
}

void run (const Options& options)
{
    if (! options.plot.empty() && ! options.plot.ends_with (".png"))
        throw CLI::ValidationError ("--plot", "'" + options.plot + "' should end in .png");
    if (options.graph.empty() && options.replay.empty()) throw CLI::RequiredError ("graph");
    options.replay.empty() ? render (options) : replay (options);
}
}   // namespace

void addRender (CLI::App& app)
{
    const auto options = std::make_shared<Options>();
    auto* command = app.add_subcommand ("render", "Run a graph offline: deterministic, faster than real time, the same engine as live");
    options->addTo (*command);
    command->get_option ("graph")->required (false);
    auto* replayed = command->add_option ("--replay", options->replay, "Repeat a run from what `tactus play --log` wrote; its own graph, unless one is given");
    for (const auto* other : { "--feed", "--device", "--rate" })
        replayed->excludes (command->get_option (other));
    command->add_option ("--plot", options->plot, "Draw what is recorded into a .png");
    command->add_option ("--over", options->over, "Plot over this recorded port instead of time")->needs ("--plot");
    command->footer ("Without --out and --plot, CSV goes to the standard output.\n\n"
                     "Examples:\n"
                     "  tactus render graphs/dry_wood.json --out wood.csv --plot wood.png\n"
                     "  tactus render graphs/dry_wood.json --device stylus=gesture:circle --out wood.wav\n"
                     "  tactus render graphs/dry_wood.json --device stylus=trace:pen.csv --record drag.force,drag.state\n"
                     "  tactus render rub.json --feed positions.csv --record drag.force --set drag.mu=0.3 --set drag.d_max=\"20 um\"\n"
                     "  tactus render rub.json --feed loop.csv --record drag.position.x,drag.force.x --plot loop.png --over drag.position.x\n"
                     "  tactus render --replay wood.jsonl --record drag.force,drag.state --out wood.csv");
    command->callback ([options]
                       { run (*options); });
}

}   // namespace tactus::host
