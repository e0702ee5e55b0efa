// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "graph_argument.hpp"
#include "overwriting.hpp"
#include "progress.hpp"
#include "render/figure_size.hpp"
#include "report.hpp"
#include "run_options.hpp"

#include <host/base/assets/file_assets.hpp>
#include <host/base/platform/signals.hpp>
#include <host/tools/figures/plot.hpp>
#include <host/tools/reports/boundary.hpp>
#include <host/tools/reports/limits_report.hpp>
#include <tactus/check/report.hpp>
#include <tactus/file/csv.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/text/json_writer.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>
#include <tactus/text/rounded_bound.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

namespace tactus::host
{

namespace
{
struct LimitsCommandOptions : LimitsOptions, FigureSize
{
    std::string graph, file;
    std::vector<std::string> devices, sets;
    double rate_hz = 0.0;
    bool json = false;
};

std::string number (double v) { return roundedText (v, 3); }

std::string padded (std::string text, std::size_t width)
{
    text.resize (std::max (width, text.size() + 1), ' ');
    return text;
}

std::string describe (const std::optional<Range>& r, bool is_least)
{
    constexpr double slack = 5e-6;   // the search ends inside, so that 4000 N/m is found as a little less
    if (! r) return "nowhere";
    const auto least = (r->is_low_known ? "at least " : "unknown below ") + number (roundedBound (r->low, true, slack));
    if (is_least) return least;
    if (std::isinf (r->high)) return r->is_lowest ? "any" : least;
    return (r->is_high_known ? "at most " : "unknown above ") + number (roundedBound (r->high, false, slack)) + (r->is_lowest ? "" : ", " + least);
}

void print (const LimitsReport& report, const LimitsCommandOptions& options)
{
    const auto& contact = report.contact;
    const auto& passive = report.passive;
    const auto& stable = report.stable;
    const auto& here = report.regions.workingPoint();
    const auto& device = contact.device().device;
    const double B = contact.damping();
    std::cout << printableName (options.graph) << " at " << numberText (contact.rate()) << " Hz, " << printableName (device.role) << " on "
              << printableName (device.name) << ": " << check::describe (device.numbers) << '\n';
    std::cout << "the heaviest contact" << (contact.axis().empty() ? "" : " of the axis " + quote (contact.axis())) << " is at " << number (contact.time())
              << " s" << (contact.node().empty() ? "" : ", steepest along the force of " + quote (contact.node())) << ": stiffness "
              << number (here.stiffness) << " N/m, virtual damping " << number (here.damping) << " N*s/m; "
              << (here.passive (B) < 0.0 ? "passive"
                  : here.rests() < 0.0   ? "stable, but not passive"
                  : here.radius          ? "it swings"
                                         : "not passive; its loop is not known")
              << "\n\n";
    const auto row = [] (const std::string& what, const std::string& now, const std::string& is_passive, const std::string& is_stable) {
        std::cout << "  " << padded (what, 26) << padded (now, 12) << padded (is_passive, 34) << is_stable << '\n';
    };
    const auto rests = [&] (const std::optional<Range>& r, bool is_least) { return here.radius ? describe (r, is_least) : std::string ("unknown"); };
    row ("", "now", "passive (sufficient)", "stable");
    row ("stiffness (N/m)", number (here.stiffness), describe (passive.stiffness, false), rests (stable.stiffness, false));
    row ("virtual damping (N*s/m)", number (here.damping), describe (passive.damping, false), rests (stable.damping, false));
    row ("rate (Hz)", number (contact.rate()), describe (passive.rate, true), rests (stable.rate, true));
    std::cout << "  varied: " << (contact.stiffnessParam().empty() ? "the whole response" : printableName (contact.stiffnessParam())) << ", "
              << (contact.dampingParam().empty() ? "a damper along the steepest direction, or all that are as steep" : printableName (contact.dampingParam()))
              << "; the slopes at one place of the motion, without quanta and dry friction: `tactus check` lets go of the tool\n";
    if (! contact.controller().empty())
        std::cout << "  " << quote (contact.controller()) << " (safety.passivity) brakes by what was before, so the contact's limits are not known: "
                  << "these are of its state at this place\n";
    if (const auto& w = contact.weakest())
        std::cout << "  the weakest other loop there is that of " << quote (w->node) << ": "
                  << (w->may_grow < 1.0 ? "it swings, and would rest with " : "it rests up to ")
                  << number (w->may_grow) << " times its response; what is varied may not change it\n";
    if (const auto& n = device.numbers; std::isfinite (here.stiffest_held))
        std::cout << "  sensor of " << number (1e6 * n.quantum->value) << " um and dry friction of " << number (n.coulomb->value)
                  << " N: rests where it is held up to " << number (here.stiffest_held) << " N/m (2 f_f/delta), without blows up to a damping of "
                  << number (here.quietest_damper) << " N*s/m over one tick (f_f T/delta); both are sufficient (Abbott & Okamura 2005; Diolaiti et al. 2006)\n";
    std::cout << "\nfootnote 2 of the chapter: b < 2M/T + 4B/3 " << (here.damperHolds() < 0.0 ? "holds" : "is broken") << " ("
              << check::describe (here.damping, here.largest_damper) << " N*s/m); sigma T < b + B " << (here.footnote (B) < 0.0 ? "holds" : "is broken") << " ("
              << check::describe (here.stiffness * here.period_s, here.damping + B) << " N*s/m)\n";
}

bool isTable (const std::string& file) { return file.ends_with (".csv"); }
bool isJson (const std::string& file) { return file.ends_with (".json"); }

Axes draw (LimitsReport& report, const View& view, Progress& progress, std::size_t& done)
{
    auto& contact = report.contact;
    const auto& regions = report.regions;
    const auto axis = [&] (const Varied& v) {
        GridAxis a { .values = {}, .is_cheap = v.what == Varied::What::stiffness || v.what == Varied::What::damping };
        for (int i = 0; i <= regions.steps; ++i)
            a.values.push_back (v.from + (v.to - v.from) * i / regions.steps);
        return a;
    };
    const auto x = axis (view.x), y = axis (view.y);
    const auto line = [&] (std::string label, double (*f) (const Standing&, double), std::size_t colour) {
        const auto boundary = boundaryOf (
            [&] (double at_x, double at_y) {
                regions.checkOn();
                return f (contact.at (regions.conditions ({ &view.x, &view.y }, { at_x, at_y })), contact.damping());
            },
            x, y);
        progress (done++);
        return Series { .label = std::move (label), .x = boundary.x, .y = boundary.y, .colour = colourFor ("position", colour) };
    };
    Axes panel { .title = view.title, .x = { view.x.name, view.x.unit }, .y = { view.y.name, view.y.unit } };
    panel.x_shown = { view.x.from, view.x.to };
    panel.y_shown = { view.y.from, view.y.to };
    panel.series.push_back (line (
        "stable: the sampled loop", [] (const Standing& s, double) { return s.rests(); }, 0));
    panel.series.push_back (line (
        "passive: Colgate (sufficient)", [] (const Standing& s, double b) { return s.passive (b); }, 1));
    panel.series.push_back (line (
        "b < 2M/T + 4B/3", [] (const Standing& s, double) { return s.damperHolds(); }, 2));
    panel.series.push_back (line (
        "sigma T < b + B", [] (const Standing& s, double b) { return s.footnote (b); }, 3));
    if (const auto& s = regions.workingPoint(); std::isfinite (s.stiffest_held))   // steps of the sensor, and dry friction that holds the tool
    {
        panel.series.push_back (line (
            "K < 2 f_f/delta (sufficient)", [] (const Standing& at, double) { return at.isHeld(); }, 4));
        panel.series.push_back (line (
            "b < f_f T/delta (sufficient)", [] (const Standing& at, double) { return at.isQuiet(); }, 5));
    }
    panel.series.push_back ({ .label = "working point", .x = { view.x.now }, .y = { view.y.now }, .colour = Colour {}, .style = Series::Style::points });
    return panel;
}

void run (LimitsCommandOptions& options)
{
    if (! options.file.empty() && ! isTable (options.file) && ! isJson (options.file) && ! isFigureFile (options.file))
        throw UsageError ("--out", quotePath (options.file) + " should end in " + figure_kinds + ", in .csv or in .json");
    if (options.file.empty() && ! (options.x.empty() && options.y.empty()))
        throw UsageError (options.x.empty() ? "--y" : "--x", "only a file shows what varies along two axes: name one with -o");
    options.readSize();
    refuseOverwriting ({ options.file }, { options.graph });
    options.checkOn = [] {
        if (stopRequested()) fail ("run/interrupted", "stopped; nothing was written", "run it again, or with fewer --steps");
    };
    watchForStop();
    FileAssets assets;
    CheckedGraph graph { loadGraph (options.graph), options.graph, assets, { options.devices, readSets (options.sets), options.rate_hz } };
    LimitsReport limits { graph, options };
    report (graph.takeWarnings());
    if (options.json)
        std::cout << writeJson (limits.json());
    else
        print (limits, options);
    if (options.file.empty()) return;

    if (isFigureFile (options.file))
    {
        const auto views = limits.views();
        Figure figure { .title = graph.loaded.graph.name + ": limits of the heaviest contact",
                        .panels = {},
                        .width = options.width,
                        .height = options.height,
                        .dpi = options.dpi };
        Progress progress { (std::isfinite (limits.regions.workingPoint().stiffest_held) ? 6u : 4u) * views.size() };
        std::size_t done = 0;
        for (const auto& view : views)
            figure.panels.push_back (draw (limits, view, progress, done));
        return orFail (writeFigure (figure, options.file));
    }
    if (isTable (options.file))
    {
        const auto rows = limits.regions.rows (limits.views());
        auto table = orFail (TableWriter::create (options.file, limits.regions.columns()));
        for (const auto& row : rows)
            orFail (table.row (row));
        return orFail (table.commit());
    }
    orFail (writeTextFile (options.file, writeJson (limits.jsonWithRows())));
}
}   // namespace

void addLimitsOf (const Command& app)
{
    const auto options = std::make_shared<LimitsCommandOptions>();
    const auto command =
        app.add ("limits", "Find how stiff, damped and slow the heaviest contact of a graph may be to stay passive or stable, and plot it");
    command
        .addOption (
            "graph", [options] (const std::string& given) { options->graph = graphArgument (given); }, "The graph file, or the name of a preset")
        .required();
    command.addOption ("--device", options->devices, "The device or the hand of a role, as for `tactus check`; may be given more than once").oneValueEach();
    command.addOption ("--role", options->role, "The role whose contact is examined; default: the one with the heaviest contact");
    command.addOption ("--x", options->x, "What varies along x, in SI units: stiffness=FROM:TO, damping=FROM:TO, rate=FROM:TO or NODE.PARAM=FROM:TO");
    command.addOption ("--y", options->y, "What varies along y; without --x and --y: the damping over the stiffness, and the stiffness over the rate");
    command.addOption ("-o,--out", options->file,
                       std::string ("The file to write: ") + figure_kinds + " for a picture, .csv for a table, .json for all numbers");
    command.addOption ("--steps", options->steps, "Steps along each axis; default: 40").check (within (2, 400));
    options->addSize (command);
    command.addOption ("--rate", options->rate_hz, "Ticks per second; default: the graph's rate").check (finiteWithin (10.0, 1e5));
    command.addOption ("--duration", options->duration_s, "Length of the motion in s").check (finiteWithin (1e-3, 60.0));
    command.addOption ("--set", options->sets, "Set a parameter, NODE.PARAM=VALUE, or a control, CONTROL=0…1; may be given more than once").oneValueEach();
    command.addFlag ("--json", options->json, "Print JSON, for use by programs");
    addLimits (command);
    addPlugins (command);
    command.footer ("passive: sup of T/2 Re[(1 - e^-jwT) H]/(1 - cos wT) <= B (Colgate), which is sufficient. "
                    "stable: the sampled loop comes to rest without a hand and with the usual hands (docs/check.md).\n\n"
                    "Examples:\n"
                    "  tactus limits granite_wall\n"
                    "  tactus limits granite_wall -o wall.pdf\n"
                    "  tactus limits soft_pad --x stiffness=0:20000 --y damping=0:20 -o pad.png\n"
                    "  tactus limits granite_wall --x wall.stiffness=100:5000 --y rate=500:4000 --steps 20 -o wall.csv");
    command.callback ([options] { run (*options); });
}

}   // namespace tactus::host
