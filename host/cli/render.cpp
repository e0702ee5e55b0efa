// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "plotter.hpp"
#include "progress.hpp"
#include "recorder.hpp"
#include "report.hpp"
#include "session.hpp"

#include <host/io/atomic_file.hpp>
#include <host/platform/signals.hpp>

#include <memory>
#include <optional>

namespace tactus::host
{

namespace
{
struct Options : SessionOptions
{
    std::string plot, over;
};

void run (const Options& options)
{
    if (! options.plot.empty() && ! options.plot.ends_with (".png"))
        throw CLI::ValidationError ("--plot", "'" + options.plot + "' should end in .png");
    watchForStop();
    Session session { options, Session::Pace::offline };
    if (! session.ticks())
        fail ("run/no_length", "nothing says how long to run: there is no feed, trace or gesture", "give --duration S, --feed IN.csv, or --device ROLE=gesture:NAME");

    const auto& taps = session.engine().plan().taps;
    Recorder recorder { options.outputs, taps, session.rate(), options.plot.empty() };
    std::optional<Plotter> plotter;
    if (! options.plot.empty()) orFail (createFile (options.plot));   // refused now, not after an hour
    if (! options.plot.empty()) plotter.emplace (options.plot, taps, options.over, session.rate(), options.records.empty());

    std::vector<double> values (recorder.width());
    Progress progress { *session.ticks() };
    for (std::size_t k = 0; k < *session.ticks(); ++k)
    {
        session.tick();
        recorder.note (taps, values);
        recorder.frame (values);
        if (plotter) plotter->frame (std::span (values).last (taps.size()));
        progress (k);
        if (stopRequested()) fail ("run/interrupted", "stopped after " + std::to_string (k + 1) + " of " + std::to_string (*session.ticks()) + " ticks; nothing was written", "run it again, or with a shorter --duration");
    }
    recorder.commit();
    if (plotter) plotter->draw (session.name());
    session.reportRun();
}
}   // namespace

void addRender (CLI::App& app)
{
    const auto options = std::make_shared<Options>();
    auto* command = app.add_subcommand ("render", "Run a graph offline: deterministic, faster than real time, the same engine as live");
    options->addTo (*command);
    command->add_option ("--plot", options->plot, "Draw what is recorded into a .png");
    command->add_option ("--over", options->over, "Plot over this recorded port instead of time")->needs ("--plot");
    command->footer ("Without --out and --plot, CSV goes to the standard output.\n\n"
                     "Examples:\n"
                     "  tactus render graphs/dry_wood.json --out wood.csv --plot wood.png\n"
                     "  tactus render graphs/dry_wood.json --device stylus=gesture:circle --out wood.wav\n"
                     "  tactus render graphs/dry_wood.json --device stylus=trace:pen.csv --record drag.force,drag.state\n"
                     "  tactus render rub.json --feed positions.csv --record drag.force --set drag.mu=0.3 --set drag.d_max=\"20 um\"\n"
                     "  tactus render rub.json --feed loop.csv --record drag.position.x,drag.force.x --plot loop.png --over drag.position.x");
    command->callback ([options]
                       { run (*options); });
}

}   // namespace tactus::host
